//Maya ASCII 2011 scene
requires maya "2011";
currentUnit -l centimeter -a degree -t film;
createNode mesh -n "bodyShape" -p "body";
	setAttr -k off ".v";
	setAttr ".scale" 9;
createNode HairShape -n "HairShape1" -p "hair1";
	setAttr -k off ".v" yes;
	setAttr ".gcnt" 25000;
	setAttr ".ints" 4;
	setAttr -s 2 ".sgc[0:1]"  6 6;
	setAttr ".dtxt" 1;
	setAttr ".clcn" no;
	setAttr ".rscl" 0.2;
	setAttr ".rthck" 0.05;
	setAttr ".tthck" 0.01;
	setAttr ".rcol" -type "float3" 0.25 0.125 0.0625 ;
	setAttr ".tcol" -type "float3" 0.5
		 0.25 0.125 ;
	setAttr ".hue" 12;
	setAttr ".pmh" 5;
	setAttr ".tfzz" 0.4;
	setAttr ".fzzYf" 2;
	setAttr ".twst" 3.141592653589793;
createNode HairShape -n "HairShape2" -p "hair2";
	setAttr ".gcnt" 7;

//! The command as a user types it.

// Clippy's exception for tests does not reach the helpers of an integration test.
#![allow(clippy::unwrap_used)]

mod bench;
mod fit;
mod groom;
mod import;
mod maps;
mod meshes;
mod sample;

use groom::{Folder, fails, pelage};

#[test]
fn any_threads_and_ranges_give_the_same_numpy_arrays() {
    let folder = Folder::with_ball();
    let one = folder.arrays("one.npz", &["--count", "3000", "--threads", "1"]);
    let two = folder.arrays("two.npz", &["--count", "3000", "--threads", "2"]);
    assert!(folder.bytes("one.npz") == folder.bytes("two.npz"));
    assert!(one == two);
    let mut halves = folder.arrays("a.npz", &["--count", "3000", "--range", "0..1234"]);
    halves.append(&folder.arrays("b.npz", &["--count", "3000", "--range", "1234.."]));
    assert!(halves == one);
}

#[test]
fn a_thousand_hairs_are_the_first_of_two_thousand() {
    let folder = Folder::with_ball();
    let few = folder.arrays("few.npz", &["--count", "1000"]);
    let first = folder.arrays("many.npz", &["--count", "2000", "--range", "0..1000"]);
    assert_eq!(few.hair_id, (0..1000).collect::<Vec<u64>>());
    assert!(few == first);
}

#[test]
fn statistics_on_standard_output_can_be_piped_to_a_program() {
    let printed = Folder::with_ball().generate("null", &["--count", "100", "--stats", "-"]);
    let stats: serde_json::Value = serde_json::from_str(&printed).unwrap();
    assert_eq!(stats["hairs"], 100);
}

#[test]
fn hairs_along_the_surface_are_the_same_hairs_for_any_number_of_threads() {
    let folder = Folder::with_ball();
    let by_index = folder.arrays("index.npz", &["--count", "3000"]);
    let along = |name: &str, threads: &str| {
        let order = [
            "--count",
            "3000",
            "--order",
            "surface",
            "--threads",
            threads,
        ];
        folder.arrays(name, &order)
    };
    let one = along("one.npz", "1");
    assert!(one == along("three.npz", "3"));
    assert!(one != by_index);
    for (i, &hair) in one.hair_id.iter().enumerate() {
        let hair = hair as usize;
        assert_eq!(one.strand_points(i), by_index.strand_points(hair));
    }
    let mut hairs = one.hair_id.clone();
    hairs.sort_unstable();
    assert_eq!(hairs, by_index.hair_id);
}

#[test]
fn every_format_is_sound_when_looked_into() {
    let folder = Folder::with_ball();
    for name in ["hair.usdc", "hair.usda", "hair.npz"] {
        folder.generate(name, &["--count", "500"]);
        let report = pelage(&["inspect", &folder.path(name)]);
        assert!(report.contains("500"), "{report}");
    }
    folder.generate("hair.rib", &["--count", "500"]);
    assert!(String::from_utf8_lossy(&folder.bytes("hair.rib")).contains("Curves \"cubic\""));
    folder.generate("null", &["--count", "500"]);
    assert!(!folder.exists("null"));
}

#[test]
fn a_posed_surface_carries_its_hair_and_frames_are_samples() {
    let folder = Folder::with_ball();
    folder.pose("ball.0001.obj", 0.0);
    folder.pose("ball.0002.obj", 3.0);
    folder.add_to_recipe("[surface]", "posed = \"ball.####.obj\"");
    let rest = folder.arrays("one.npz", &["--count", "50", "--frame", "1"]);
    let moved = folder.arrays("two.npz", &["--count", "50", "--frame", "2"]);
    for (p, q) in rest.points.iter().zip(&moved.points) {
        assert!((p[0] + 3.0 - q[0]).abs() < 1e-5 && (p[1] - q[1]).abs() < 1e-5);
    }
    folder.generate("hair.usdc", &["--count", "50", "--frames", "1-2"]);
    let last = pelage::io::read_curves(folder.path("hair.usdc").as_ref(), Some(2.0)).unwrap();
    let last = pelage::io::strands_through_vertices(&last.sets[0]);
    assert_eq!(last.points, moved.points);
    let words = fails(&["generate", &folder.path("groom.toml"), "-o", "null"]);
    assert!(words.contains("--frame"), "{words}");
}

#[test]
fn posed_guides_move_hair_frame_by_frame_from_a_sequence_or_time_samples() {
    let folder = Folder::new();
    folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let guides = |shift: f32| {
        let root = |x: f32, y: f32| format!("v {x} {y} 0\nv {x} {y} 1\nv {} {y} 2\n", x + shift);
        let roots = root(0.2, 0.2) + &root(0.6, 0.2) + &root(0.2, 0.6);
        roots + "l 1 2 3\nl 4 5 6\nl 7 8 9\n"
    };
    folder.write("g.obj", &guides(0.0));
    folder.write("g.0001.obj", &guides(0.0));
    folder.write("g.0002.obj", &guides(0.5));
    let recipe = |posed: &str| {
        format!(
            "surface.mesh = 't.obj'\nhair.count = 50\n\
             [guides]\ncurves = 'g.obj'\nposed = '{posed}'\n"
        )
    };
    folder.write("groom.toml", &recipe("g.####.obj"));
    let rest = folder.arrays("one.npz", &["--frame", "1"]);
    let bent = folder.arrays("two.npz", &["--frame", "2"]);
    for i in 0..50 {
        let (rest, bent) = (rest.strand_points(i), bent.strand_points(i));
        assert_eq!(rest[0], bent[0]);
        let tip = bent[bent.len() - 1] - rest[rest.len() - 1];
        assert!((tip.x - 0.5).abs() < 1e-4 && tip.y.abs() < 1e-4, "{tip}");
    }
    let words = fails(&["generate", &folder.path("groom.toml"), "-o", "null"]);
    assert!(
        words.contains("guides.posed") && words.contains("--frames"),
        "{words}"
    );

    // Hair of both frames in one file are guides with time samples.
    folder.generate("hair.usda", &["--frames", "1-2"]);
    folder.write(
        "groom.toml",
        &recipe("hair.usda").replace("'g.obj'", "'one.npz'"),
    );
    let again = folder.arrays("again.npz", &["--frame", "2"]);
    let tips = |strands: &pelage::StrandBuffer| {
        let all = 0..strands.len();
        let tip = |i| strands.strand_points(i).last().unwrap().x;
        all.map(tip).sum::<f32>() / strands.len() as f32
    };
    assert!((tips(&again) - tips(&rest) - 0.5).abs() < 0.01);

    folder.write("g.0002.obj", "v .2 .2 0\nv .2 .2 1\nl 1 2\n");
    folder.write("groom.toml", &recipe("g.####.obj"));
    let recipe = folder.path("groom.toml");
    let words = fails(&["generate", &recipe, "-o", "null", "--frame", "2"]);
    assert!(words.contains("1 guides, but 3 at rest"), "{words}");
}

#[test]
fn the_gallery_draws_the_strips_that_are_asked_for() {
    let folder = Folder::new();
    let gallery = folder.path("gallery");
    let small = [
        "--size",
        "16x16",
        "--only",
        "width.tip",
        "--only",
        "strand.count",
    ];
    pelage(&[&["gallery", "-o", &gallery][..], &small].concat());
    for name in ["width.tip", "strand.count"] {
        let strip = folder.bytes(&format!("gallery/{name}.jpg"));
        let strip = image::load_from_memory(&strip).unwrap();
        assert_eq!((strip.width(), strip.height()), (4 * 20 - 4, 16));
    }
    let words = fails(&["gallery", "-o", &gallery, "--only", "width.tipp"]);
    assert!(
        words.contains("width.tipp") && words.contains("width.tip,"),
        "{words}"
    );
}

#[test]
fn analyzing_helices_finds_their_curvature_torsion_and_length() {
    let folder = Folder::new();
    // Radius 2, rising 3 a radian, five turns; and a straight line, and a point twice.
    let mut text = String::new();
    for i in 0..=400 {
        let angle = i as f64 / 400.0 * 10.0 * std::f64::consts::PI;
        let (x, y) = (2.0 * libm::cos(angle), 2.0 * libm::sin(angle));
        text += &format!("v {x} {y} {}\n", 3.0 * angle);
    }
    text += "v 0 0 0\nv 0 0 1\nv 0 0 5\nv 1 1 1\nv 1 1 1\n";
    let line: Vec<String> = (1..=401).map(|i| i.to_string()).collect();
    text += &format!("l {}\nl 402 403 404\nl 405 406\n", line.join(" "));
    folder.write("curves.obj", &text);
    let (curves, report) = (folder.path("curves.obj"), folder.path("report"));
    let said = pelage(&[
        "analyze", &curves, "-o", &report, "--strand", "0", "--steps", "200",
    ]);
    assert!(said.contains("helicity"), "{said}");
    for name in ["curvature.svg", "torsion.svg", "strand.svg", "frames.svg"] {
        assert!(
            folder.bytes(&format!("report/{name}")).starts_with(b"<svg"),
            "{name}"
        );
    }
    let page = String::from_utf8(folder.bytes("report/report.md")).unwrap();
    assert!(page.contains("3 curves, 1 of them left out"), "{page}");
    let found: serde_json::Value =
        serde_json::from_slice(&folder.bytes("report/statistics.json")).unwrap();
    let most = |name: &str| {
        let all = found["statistics"].as_array().unwrap();
        let one = all.iter().find(|one| one["name"] == name).unwrap();
        one["quantiles"][4].as_f64().unwrap()
    };
    let near = |name: &str, expected: f64| {
        let error = (most(name) - expected).abs() / expected;
        assert!(error < 0.01, "{name}: {} for {expected}", most(name));
    };
    near("length", 10.0 * std::f64::consts::PI * 13f64.sqrt());
    near("curvature", 2.0 / 13.0);
    near("torsion", 3.0 / 13.0);
    near("helicity", 1.5);
    let words = fails(&["analyze", &curves, "-o", &report, "--strand", "3"]);
    assert!(words.contains("there are 3 curves"), "{words}");
}

#[test]
fn tubes_are_closed_solids_of_the_radius_and_length_asked_for() {
    let folder = Folder::new();
    folder.write(
        "curves.obj",
        "v 0 0 0\nv 0 0 1\nv 0 0 4\nv 9 0 0\nv 9 0 2\nl 1 2 3\nl 4 5\n",
    );
    let curves = folder.path("curves.obj");
    let volume = |name: &str, more: &[&str]| {
        let mesh = folder.path(name);
        pelage(&[&["tube", &curves, "-o", &mesh], more].concat());
        let mesh = pelage::io::read_mesh(mesh.as_ref(), None).unwrap().mesh;
        let corner = |i: usize| {
            let p = mesh.positions[mesh.corner_vertices[i] as usize];
            pelage::curves::Vec3::from(p).as_dvec3()
        };
        let faces = (0..mesh.face_sizes.len()).map(|f| [0, 1, 2].map(|k| corner(3 * f + k)));
        faces.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum::<f64>()
    };
    // A polygon of 64 sides has nearly the area of its circle.
    let area = 32.0 * 0.25 * libm::sin(std::f64::consts::TAU / 64.0);
    let straight = ["--radius", "0.5", "--sides", "64"];
    for name in ["tube.glb", "tube.obj", "tube.ply", "tube.usda"] {
        let found = volume(name, &straight);
        assert!((found - 6.0 * area).abs() < 1e-3, "{name}: {found}");
    }
    let cone = volume(
        "cone.ply",
        &[&straight[..], &["--tip-radius", "0"]].concat(),
    );
    assert!((cone - 2.0 * area).abs() < 1e-2, "{cone}");
    let words = fails(&["tube", &curves, "-o", &folder.path("a.glb")]);
    assert!(words.contains("--radius"), "{words}");
    let words = fails(&[
        "tube",
        &curves,
        "-o",
        &folder.path("a.stl"),
        "--radius",
        "1",
    ]);
    assert!(words.contains(".stl; there are .obj"), "{words}");
}

#[test]
fn a_pose_of_other_topology_is_refused_with_the_place() {
    let folder = Folder::with_ball();
    folder.write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.add_to_recipe("[surface]", "posed = \"other.obj\"");
    let words = fails(&["generate", &folder.path("groom.toml"), "-o", "null"]);
    assert!(
        words.contains("other.obj: number of vertices is 3"),
        "{words}"
    );
    assert!(words.contains("surface.posed"), "{words}");
}

#[test]
fn without_uvs_a_recipe_without_maps_works_and_one_with_a_map_is_refused_by_name() {
    let folder = Folder::new();
    folder.write(
        "t.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n",
    );
    folder.write(
        "groom.toml",
        "surface.mesh = 't.obj'\nguides.grow = { count = 5, length = 1 }\n",
    );
    folder.generate("hair.npz", &["--count", "100"]);
    folder.copy_ball_map("density.png");
    folder.write(
        "groom.toml",
        "surface.mesh = 't.obj'\nguides.grow = { length = 1 }\n\
         [roots]\ndensity = { map = 'density.png' }\n",
    );
    let words = fails(&["generate", &folder.path("groom.toml"), "-o", "null"]);
    assert!(
        words.contains("roots.density") && words.contains("no UVs"),
        "{words}"
    );
    assert!(words.contains("groom.toml:4"), "{words}");
}

#[test]
fn guides_off_the_surface_are_listed_with_their_distances() {
    let folder = Folder::new();
    folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder.write(
        "g.obj",
        "v .2 .2 0\nv .2 .2 1\nv .2 .2 .5\nv .2 .2 2\nl 1 2\nl 3 4\n",
    );
    folder.write(
        "groom.toml",
        "surface.mesh = 't.obj'\nguides.curves = 'g.obj'\n",
    );
    let words = fails(&["generate", &folder.path("groom.toml"), "-o", "null"]);
    assert!(words.contains("guide 1 by 0.5"), "{words}");
}

#[test]
fn a_failed_run_leaves_the_old_file_whole() {
    let folder = Folder::with_ball();
    folder.write("hair.usdc", "old");
    folder.write(
        "groom.toml",
        "surface.mesh = 'gone.obj'\nguides.grow = { length = 1 }\n",
    );
    fails(&[
        "generate",
        &folder.path("groom.toml"),
        "-o",
        &folder.path("hair.usdc"),
    ]);
    assert_eq!(folder.bytes("hair.usdc"), b"old");
}

#[test]
fn a_killed_run_leaves_the_old_file_whole() {
    let folder = Folder::with_ball();
    folder.write("hair.usdc", "old");
    let files = || std::fs::read_dir(folder.path("")).unwrap().count();
    let before = files();
    let (recipe, output) = (folder.path("groom.toml"), folder.path("hair.usdc"));
    // Far more hairs than can be written before the kill; the disk gets some of them.
    let arguments = [
        "generate",
        &recipe,
        "-o",
        &output,
        "--count",
        "1_000_000_000",
    ];
    let mut run = groom::start(&arguments);
    while files() == before {
        assert!(
            run.try_wait().unwrap().is_none(),
            "ended before it began to write"
        );
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    assert_eq!(folder.bytes("hair.usdc"), b"old");
}

#[test]
fn mistakes_are_answered_in_words() {
    let folder = Folder::with_ball();
    let recipe = folder.path("groom.toml");
    let words = fails(&["generate", &recipe, "-o", "hair.fbx"]);
    assert!(words.contains(".usdc"), "{words}");
    let words = fails(&[
        "generate", &recipe, "-o", "null", "--count", "5", "--range", "0..9",
    ]);
    assert!(words.contains("there are only 5 hairs"), "{words}");
    let words = fails(&["generate", "nowhere.toml", "-o", "null"]);
    assert!(words.contains("nowhere.toml"), "{words}");
    let words = fails(&["init", &folder.path("")]);
    assert!(words.contains("--force"), "{words}");
    let words = fails(&["inspect", &folder.path("")]);
    assert!(words.contains("folder"), "{words}");
    folder.add_to_recipe("[hair]", "cuont = 7");
    let words = fails(&["generate", &recipe, "-o", "null"]);
    assert!(
        words.contains("hair.cuont") && words.contains("count"),
        "{words}"
    );
}

#[test]
fn every_example_grows_sound_hair_and_shows_it() {
    for name in ["ball", "cyclone", "head", "grass", "tree"] {
        let folder = Folder::new();
        pelage(&["init", &folder.path(name), "--example", name]);
        let recipe = folder.path(&format!("{name}/groom.toml"));
        let (hair, picture) = (folder.path("hair.usdc"), folder.path("hair.png"));
        pelage(&[
            "generate",
            &recipe,
            "-o",
            &hair,
            "--count",
            "2000",
            "--picture",
            &picture,
            "--size",
            "64x36",
            "--samples",
            "2",
        ]);
        pelage(&["inspect", &hair]);
        assert!(pelage::io::read_image(picture.as_ref()).is_ok());
    }
}

#[test]
fn the_pages_for_editors_shells_and_readers_are_there() {
    assert!(pelage(&["schema"]).contains("json-schema.org"));
    assert!(pelage(&["schema", "--markdown"]).contains("## `[frizz.animation]`"));
    assert!(pelage(&["completions", "bash"]).contains("_pelage"));
    assert!(pelage(&["man"]).contains(".TH pelage"));
    assert!(pelage(&["generate", "--help"]).contains("Examples:"));
}

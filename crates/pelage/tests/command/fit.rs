//! Curves as Super-Helices, and back.

use crate::groom::{Folder, fails, pelage, run};
use pelage::StrandBuffer;
use pelage::curves::DVec3;
use pelage::curves::frenet::{CatmullRom, Measure, SpaceCurve};
use pelage::io::{read_curves, read_super_helices, strands_through_vertices};
use std::fmt::Write;

/// Curls that differ, a line, and a strand without length, as polylines.
fn curls(folder: &Folder) -> String {
    let (mut text, mut lines, mut vertices) = (String::new(), String::new(), 0);
    let mut line = |points: &[[f64; 3]]| {
        lines += "l";
        for [x, y, z] in points {
            vertices += 1;
            writeln!(text, "v {x} {y} {z}").unwrap();
            write!(lines, " {vertices}").unwrap();
        }
        lines += "\n";
    };
    for strand in 0..8 {
        let (phase, turns) = (strand as f64, 2.0 + strand as f64);
        let points = (0..50).map(|i| {
            let t = i as f64 / 49.0;
            let angle = phase + turns * t * (1.0 + 0.3 * t);
            let (x, y) = (libm::cos(angle), libm::sin(angle));
            [3.0 * phase + t * x, t * y, 8.0 * t]
        });
        line(&points.collect::<Vec<_>>());
    }
    line(&[[0.0, 9.0, 0.0], [0.0, 9.0, 2.0]]);
    line(&[[1.0, 9.0, 0.0], [1.0, 9.0, 0.0]]);
    folder.write("curls.obj", &(text + &lines));
    folder.path("curls.obj")
}

fn strands(path: &str) -> StrandBuffer {
    let file = read_curves(path.as_ref(), None).unwrap();
    strands_through_vertices(&file.sets[0])
}

/// The largest distance of a vertex of `decoded` from `target` at the same part of the
/// length, and that length.
fn error(target: &StrandBuffer, decoded: &StrandBuffer, strand: usize) -> (f64, f64) {
    let points = target.strand_points(strand).iter();
    let points: Vec<DVec3> = points.map(|p| p.as_dvec3()).collect();
    let curve = CatmullRom::new(&points).unwrap();
    let measure = Measure::new(&curve).unwrap();
    let decoded = decoded.strand_points(strand);
    let steps = (decoded.len() - 1) as f64;
    let off = decoded.iter().enumerate().map(|(i, place)| {
        let (piece, t) = measure.locate(&curve, measure.total() * (i as f64 / steps));
        curve.at(piece, t)[0].distance(place.as_dvec3())
    });
    (off.fold(0.0, f64::max), measure.total())
}

#[test]
fn decoded_fits_are_within_the_error_told_and_that_within_the_bound() {
    let folder = Folder::new();
    let curves = curls(&folder);
    let target = strands(&curves);
    for (name, bound) in [("1%", 0.01), ("0.1%", 0.001), ("0.02", f64::INFINITY)] {
        let fits = folder.path("fits.json");
        let said = pelage(&["fit", &curves, "-o", &fits, "--max-error", name]);
        assert!(said.contains("all strands keep it"), "{said}");
        let helices = read_super_helices(fits.as_ref()).unwrap();
        let decoded = strands(&fits);
        assert_eq!(decoded.offsets, target.offsets);
        for strand in 0..target.len() {
            let (off, length) = error(&target, &decoded, strand);
            let told = f64::from(helices.errors[strand]);
            // Coordinates of 32 bits.
            assert!(off <= told + 1e-5, "{strand}: {off} for {told}");
            assert!(
                told <= f64::min(bound * length, 0.02 / 0.001 * bound),
                "{strand}: {told}"
            );
            assert!(bound.is_finite() || told <= 0.02, "{strand}: {told}");
        }
        // The strand without length.
        assert_eq!(decoded.strand_points(9), target.strand_points(9));
    }
}

#[test]
fn every_form_decodes_to_the_same_bytes_by_any_threads() {
    let folder = Folder::new();
    let curves = curls(&folder);
    let mut decoded = Vec::new();
    for (form, threads) in [("json", "1"), ("usdc", "2"), ("npz", "3")] {
        let (fits, back) = (
            folder.path(&format!("fits.{form}")),
            folder.path("back.usda"),
        );
        pelage(&["fit", &curves, "-o", &fits, "--threads", threads]);
        pelage(&["fit", "--decode", &fits, "-o", &back]);
        decoded.push(folder.bytes("back.usda"));
        // It tells of the strand without length too.
        let report = run(&["inspect", &fits]);
        let report = String::from_utf8(report.stdout).unwrap();
        let mut lines = report.lines();
        let counts = lines.any(|line| line.split_whitespace().eq(["curves", "10"]));
        assert!(counts, "{report}");
    }
    assert!(decoded[0] == decoded[1] && decoded[0] == decoded[2]);
    let (fits, few) = (folder.path("fits.json"), folder.path("few.npz"));
    pelage(&["fit", "--decode", &fits, "-o", &few, "--vertices", "7"]);
    assert_eq!(strands(&few).vertex_count(3), 7);
}

/// Rounding to 32 bits moves their tips by a good part of the bound.
#[test]
fn strands_that_wind_much_keep_a_close_bound_as_they_are_written() {
    let folder = Folder::new();
    let points = (0..400).map(|i| {
        let t = i as f64 / 400.0;
        let angle = 20.0 * t * (1.0 + 0.2 * t);
        [0.3 * libm::cos(angle), 0.3 * libm::sin(angle), 8.0 * t]
    });
    let mut text = String::new();
    points.for_each(|[x, y, z]| writeln!(text, "v {x} {y} {z}").unwrap());
    let line: Vec<String> = (1..=400).map(|vertex| vertex.to_string()).collect();
    folder.write("wound.obj", &format!("{text}l {}\n", line.join(" ")));
    let (curves, fits) = (folder.path("wound.obj"), folder.path("fits.npz"));
    let said = pelage(&["fit", &curves, "-o", &fits, "--max-error", "0.001"]);
    assert!(said.contains("all strands keep it"), "{said}");
    assert!(read_super_helices(fits.as_ref()).unwrap().errors[0] <= 0.001);
}

#[test]
fn strands_that_miss_the_bound_are_named_and_the_exit_code_tells() {
    let folder = Folder::new();
    let curves = curls(&folder);
    let fits = folder.path("fits.json");
    // Closer than 32 bits can be.
    let output = run(&["fit", &curves, "-o", &fits, "--max-error", "1e-7%"]);
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("strands miss it: 0, 1"), "{said}");
    assert!(folder.exists("fits.json"));
    let said = pelage(&["fit", &curves, "-o", &fits, "--elements", "2"]);
    assert!(
        said.contains("2.0 a strand") && !said.contains("bound"),
        "{said}"
    );
    let notes = String::from_utf8(run(&["fit", &curves, "-o", &fits]).stderr).unwrap();
    assert!(notes.contains("1 strands have no length"), "{notes}");
}

#[test]
fn guides_given_as_fits_grow_the_hair_of_the_decoded_curves() {
    let folder = Folder::new();
    folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let root = |x: f32, y: f32, s: f32| {
        let vertex = |i: i32| {
            let t = i as f32 / 9.0;
            format!("v {} {} {t}\n", x + s * t * t, y + s * t * t * t)
        };
        (0..10).map(vertex).collect::<String>()
    };
    let text = root(0.2, 0.2, 0.3) + &root(0.6, 0.2, -0.2) + &root(0.2, 0.6, 0.5);
    folder.write(
        "g.obj",
        &(text
            + "l 1 2 3 4 5 6 7 8 9 10\nl 11 12 13 14 15 16 17 18 19 20\n\
                  l 21 22 23 24 25 26 27 28 29 30\n"),
    );
    let guides = folder.path("g.obj");
    let decoded = folder.path("decoded.npz");
    let mut grown = Vec::new();
    for form in ["json", "usdc", "npz"] {
        pelage(&["fit", &guides, "-o", &folder.path(&format!("fit.{form}"))]);
    }
    pelage(&["fit", "--decode", &folder.path("fit.json"), "-o", &decoded]);
    for file in ["decoded.npz", "fit.json", "fit.usdc", "fit.npz", "g.obj"] {
        folder.write(
            "groom.toml",
            &format!("surface.mesh = 't.obj'\nguides.curves = '{file}'\nhair.count = 40\n"),
        );
        grown.push(folder.arrays("hair.npz", &[]));
    }
    assert!(grown[1..4].iter().all(|hair| *hair == grown[0]));
    assert!(grown[4] != grown[0]);
    for (p, q) in grown[4].points.iter().zip(&grown[0].points) {
        let off = DVec3::from(p.map(f64::from)).distance(DVec3::from(q.map(f64::from)));
        assert!(off < 0.03, "{off}");
    }
}

#[test]
fn the_picture_shows_strands_fits_and_errors_side_by_side() {
    let folder = Folder::new();
    let curves = curls(&folder);
    let (fits, picture) = (folder.path("fits.json"), folder.path("fits.png"));
    let small = ["--size", "96x32", "--samples", "2", "--elements", "1"];
    let said = pelage(
        &[
            &["fit", &curves, "-o", &fits, "--picture", &picture],
            &small[..],
        ]
        .concat(),
    );
    assert!(said.contains("by error: blue none"), "{said}");
    let image = image::load_from_memory(&folder.bytes("fits.png"))
        .unwrap()
        .to_rgb8();
    assert_eq!(image.dimensions(), (96, 32));
    // Only the panel of errors has red in it.
    let red = |panel: u32| {
        let pixels = image.enumerate_pixels().filter(|(x, ..)| x / 32 == panel);
        let redness = pixels.map(|(.., p)| i32::from(p[0]) - i32::from(p[2]));
        redness.max().unwrap()
    };
    assert!(
        red(2) > 40 && red(0) < 30 && red(1) < 30,
        "{} {} {}",
        red(0),
        red(1),
        red(2)
    );
}

#[test]
fn what_cannot_be_fitted_is_answered_in_words() {
    let folder = Folder::new();
    let curves = curls(&folder);
    let words = fails(&["fit", &curves, "-o", &folder.path("fits.fbx")]);
    assert!(words.contains(".json, .usdc"), "{words}");
    let words = fails(&["fit", "--decode", &curves, "-o", &folder.path("a.npz")]);
    assert!(words.contains("OBJ holds no Super-Helices"), "{words}");
    folder.write(
        "bad.json",
        "{\"format\": \"super-helices\", \"version\": 7}",
    );
    let words = fails(&[
        "tube",
        &folder.path("bad.json"),
        "-o",
        &folder.path("a.ply"),
    ]);
    assert!(words.contains("version 7 is not read, only 1"), "{words}");
    folder.write("empty.obj", "v 0 0 0\n");
    fails(&[
        "fit",
        &folder.path("empty.obj"),
        "-o",
        &folder.path("a.json"),
    ]);
    let output = run(&["fit", &curves, "-o", "a.json", "--max-error", "-3"]);
    assert_eq!(output.status.code(), Some(2));
    let words = String::from_utf8(output.stderr).unwrap();
    assert!(!words.contains("panicked"), "{words}");
}

#[test]
fn usd_shows_the_curves_and_gives_the_numbers() {
    let Ok(python) = std::env::var("PELAGE_PYTHON") else {
        return;
    };
    let folder = Folder::new();
    let curves = curls(&folder);
    let fits = folder.path("fits.usdc");
    pelage(&["fit", &curves, "-o", &fits]);
    let script = "
import sys
from pxr import Usd, UsdGeom
stage = Usd.Stage.Open(sys.argv[1])
prim = stage.GetDefaultPrim().GetChild('hair')
curves = UsdGeom.BasisCurves(prim)
counts = list(curves.GetCurveVertexCountsAttr().Get())
assert len(counts) == 10 and sum(counts) == len(curves.GetPointsAttr().Get()), counts
value = lambda name: list(prim.GetAttribute('superHelix:' + name).Get())
assert value('version') == [1]
elements = sum(value('elements'))
assert all(len(value(n)) == elements for n in ['length', 'twist', 'curvature_1', 'curvature_2'])
assert all(len(value(n)) == 10 for n in ['vertices', 'root', 'tangent', 'normal', 'error'])
assert [v + 2 for v in value('vertices')] == counts
";
    let script_path = folder.path("look.py");
    folder.write("look.py", script);
    let output = std::process::Command::new(python)
        .args([&script_path, &fits])
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{words}");
}

//! `pelage sample`: roots without hair.

use crate::groom::{Folder, fails, pelage};
use pelage::StrandBuffer;
use pelage::io::{CurveSet, read_npz_curves};

impl Folder {
    fn sample(&self, name: &str, more: &[&str]) -> String {
        let (recipe, output) = (self.path("groom.toml"), self.path(name));
        let output = if name == "null" { name } else { &output };
        pelage(&[&["sample", &recipe, "-o", output], more].concat())
    }

    fn roots(&self, name: &str, more: &[&str]) -> CurveSet {
        self.sample(name, more);
        let file = read_npz_curves(self.path(name).as_ref(), None).unwrap();
        file.sets.into_iter().next().unwrap()
    }
}

/// One number of each root of a point cloud, at byte `at` of its 72.
fn column<T: bytemuck::AnyBitPattern>(ply: &[u8], at: usize) -> Vec<T> {
    let end = b"end_header\n";
    let start = ply.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    ply[start..]
        .chunks_exact(72)
        .map(|row| bytemuck::pod_read_unaligned(&row[at..at + size_of::<T>()]))
        .collect()
}

#[test]
fn roots_are_those_of_the_hairs() {
    let folder = Folder::with_ball();
    let hairs = folder.arrays("hair.npz", &["--count", "3000"]);
    let roots = folder.roots("roots.npz", &["-n", "3000"]).curves;
    assert_eq!(roots.len(), 3000);
    // Hairs without length are no hairs, but their roots are there.
    assert!(hairs.len() > 2000);
    for (k, &hair) in hairs.hair_id.iter().enumerate() {
        let i = hair as usize;
        assert_eq!(roots.hair_id[i], hair);
        assert_eq!(roots.triangle[i], hairs.triangle[k]);
        assert_eq!(roots.barycentric[i], hairs.barycentric[k]);
        assert_eq!(roots.root_rest[i], hairs.root_rest[k]);
        assert_eq!(roots.root_uv[i], hairs.root_uv[k]);
        assert_eq!(roots.group[i], hairs.group[k]);
        assert_eq!(roots.points[i], hairs.strand_points(k)[0].to_array());
    }
}

#[test]
fn numpy_arrays_have_the_names_of_the_main_job_and_one_entry_a_root() {
    let folder = Folder::with_ball();
    let set = folder.roots("roots.npz", &["-n", "1_000"]);
    let mut found: Vec<(&str, &str, usize)> = set
        .attributes
        .iter()
        .map(|a| (a.name.as_str(), a.kind.as_str(), a.count))
        .collect();
    found.sort();
    let expected = [
        ("barycentric", "<f4×3"),
        ("counts", "<u4"),
        ("group", "<u4"),
        ("hair_id", "<u8"),
        ("normals", "<f4×3"),
        ("points", "<f4×3"),
        ("root_rest", "<f4×3"),
        ("root_uv", "<f4×2"),
        ("triangle", "<u4"),
    ];
    assert_eq!(found, expected.map(|(name, kind)| (name, kind, 1000)));
    // On a sphere around the origin, normals point where points lie.
    for (p, n) in set.curves.points.iter().zip(&set.curves.normals) {
        assert!((0..3).all(|k| (p[k] - n[k]).abs() < 0.02), "{p:?} {n:?}");
    }
}

#[test]
fn any_threads_and_ranges_give_the_same_roots() {
    let folder = Folder::with_ball();
    // More than two blocks.
    let all = ["-n", "150_000"];
    for format in ["npz", "ply"] {
        let names = ["1", "3"].map(|threads| {
            let name = format!("{threads}.{format}");
            folder.sample(&name, &[&all[..], &["--threads", threads]].concat());
            name
        });
        assert!(
            folder.bytes(&names[0]) == folder.bytes(&names[1]),
            "{format}"
        );
    }
    let range = |name: &str, range: &str| {
        let range = ["--range", range];
        folder.roots(name, &[&all[..], &range].concat()).curves
    };
    let mut parts = range("a.npz", "..777");
    parts.append(&range("b.npz", "777..140000"));
    parts.append(&range("c.npz", "140_000.."));
    let whole: StrandBuffer = folder.roots("whole.npz", &all).curves;
    assert!(parts == whole);
}

#[test]
fn a_point_cloud_holds_the_roots() {
    let folder = Folder::with_ball();
    let roots = folder.roots("roots.npz", &["-n", "500"]).curves;
    folder.sample("roots.ply", &["-n", "500"]);
    let ply = folder.bytes("roots.ply");
    assert_eq!(column::<[f32; 3]>(&ply, 0), roots.points);
    assert_eq!(column::<[f32; 3]>(&ply, 12), roots.normals);
    assert_eq!(column::<[f32; 2]>(&ply, 24), roots.root_uv);
    assert_eq!(column::<u32>(&ply, 40), roots.triangle);
    let ids = (0..500).map(f64::from);
    assert!(column::<f64>(&ply, 32).into_iter().eq(ids));
    let header = String::from_utf8_lossy(&ply[..200]).into_owned();
    assert!(header.contains("element vertex 500\n"), "{header}");
    let words = folder.sample("null", &["-n", "500"]);
    assert!(words.starts_with("500 roots on ") && words.contains("roots/s"));
    assert!(!folder.exists("null"));
}

#[test]
fn guides_and_maps_that_roots_do_not_need_may_be_missing() {
    let folder = Folder::with_ball();
    let roots = folder.roots("all.npz", &["-n", "100"]).curves;
    for map in ["length.png", "root_color.png", "tip_color.png"] {
        std::fs::remove_file(folder.path(map)).unwrap();
    }
    folder.write(
        "groom.toml",
        "hair.seed = 7\nsurface.mesh = 'ball.obj'\nguides.curves = 'gone.usda'\n\
         scale.amount = { map = 'gone.png' }\nroots.density = { map = 'density.png' }\n",
    );
    assert!(folder.roots("few.npz", &["-n", "100"]).curves == roots);
    std::fs::remove_file(folder.path("density.png")).unwrap();
    let words = fails(&["sample", &folder.path("groom.toml"), "-o", "null"]);
    assert!(words.contains("roots.density"), "{words}");
}

#[test]
fn a_black_density_gives_no_roots_and_says_so() {
    let folder = Folder::with_ball();
    folder.write(
        "groom.toml",
        "surface.mesh = 'ball.obj'\nguides.grow = { length = 1 }\nroots.density = 0\n",
    );
    for name in ["none.npz", "none.ply"] {
        let said = folder.sample(name, &["-n", "100"]);
        assert!(said.starts_with("0 roots"), "{said}");
        assert!(folder.exists(name));
    }
    assert!(column::<f32>(&folder.bytes("none.ply"), 0).is_empty());
    for shown in ["density", "pieces", "roots"] {
        let picture = folder.path("none.png");
        let more = ["--picture", &picture, "--show", shown, "--size", "16x9"];
        folder.sample("null", &more);
    }
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_pelage"))
        .args(["sample", &folder.path("groom.toml"), "-o", "null"])
        .output()
        .unwrap();
    let words = String::from_utf8(output.stderr).unwrap();
    assert!(words.contains("no hair can grow"), "{words}");
}

#[test]
fn a_posed_surface_carries_its_roots() {
    let folder = Folder::with_ball();
    folder.pose("ball.0002.obj", 3.0);
    let rest = folder.roots("rest.npz", &["-n", "50"]).curves;
    folder.add_to_recipe("[surface]", "posed = \"ball.####.obj\"");
    let moved = folder
        .roots("moved.npz", &["-n", "50", "--frame", "2"])
        .curves;
    assert_eq!(moved.root_rest, rest.root_rest);
    for (p, q) in rest.points.iter().zip(&moved.points) {
        assert!((p[0] + 3.0 - q[0]).abs() < 1e-5 && (p[1] - q[1]).abs() < 1e-5);
    }
    let words = fails(&["sample", &folder.path("groom.toml"), "-o", "null"]);
    assert!(words.contains("--frame"), "{words}");
}

#[test]
fn density_pieces_and_roots_make_three_pictures() {
    let folder = Folder::with_ball();
    let pictures = ["density", "pieces", "roots"].map(|shown| {
        let (name, picture) = (format!("{shown}.png"), folder.path(&format!("{shown}.png")));
        let size = ["--size", "64x36", "--samples", "2"];
        let show = ["-n", "500", "--picture", &picture, "--show", shown];
        folder.sample("null", &[&show[..], &size].concat());
        assert!(pelage::io::read_image(picture.as_ref()).is_ok());
        folder.bytes(&name)
    });
    assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2]);
}

#[test]
fn mistakes_about_roots_are_answered_in_words() {
    let folder = Folder::with_ball();
    let recipe = folder.path("groom.toml");
    let words = fails(&["sample", &recipe, "-o", "roots.usdc"]);
    assert!(words.contains(".npz") && words.contains(".ply"), "{words}");
    let words = fails(&[
        "sample", &recipe, "-o", "null", "-n", "5", "--range", "0..9",
    ]);
    assert!(words.contains("raise -n"), "{words}");
}

/// The smallest distance between two points.
fn closest(points: &[[f32; 3]]) -> f32 {
    let between = |p: &[f32; 3], q: &[f32; 3]| (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum();
    let squares = points
        .iter()
        .enumerate()
        .flat_map(|(i, p)| points[..i].iter().map(move |q| between(p, q)));
    squares.fold(f32::INFINITY, f32::min).sqrt()
}

#[test]
fn patterns_spread_roots_the_better_the_more_they_cost() {
    let folder = Folder::new();
    pelage(&["init", &folder.path("ball"), "--example", "ball"]);
    let [random, stratified, blue_noise] = ["random", "stratified", "blue-noise"].map(|pattern| {
        folder.write(
            "groom.toml",
            &format!("surface.mesh = 'ball/ball.obj'\nguides.grow = {{ length = 1 }}\nroots.pattern = '{pattern}'\n"),
        );
        let roots = folder.roots("roots.npz", &["-n", "2000"]).curves;
        let first = folder.roots("first.npz", &["-n", "700"]).curves;
        assert_eq!(roots.points[..700], first.points[..], "{pattern}");
        closest(&roots.points)
    });
    assert!(
        random < stratified && 2.0 * stratified < blue_noise,
        "{random} {stratified} {blue_noise}"
    );
    let words = fails(&[
        "sample",
        &folder.path("groom.toml"),
        "-o",
        "null",
        "-n",
        "1_000_000_000",
    ]);
    assert!(
        words.contains("hair.count") && words.contains("stratified"),
        "{words}"
    );
}

#[test]
fn displaced_roots_stand_off_the_surface_and_have_its_new_normals() {
    let folder = Folder::with_ball();
    let plain = folder.roots("plain.npz", &["-n", "500"]).curves;
    folder.add_to_recipe(
        "[roots]",
        "displacement = { value = 0.2, map = \"length.png\" }",
    );
    let roots = folder.roots("roots.npz", &["-n", "500"]).curves;
    assert_eq!(roots.root_rest, plain.root_rest);
    let mut tilted = 0;
    for i in 0..500 {
        let off: Vec<f32> = (0..3)
            .map(|k| roots.points[i][k] - plain.points[i][k])
            .collect();
        let height: f32 = (0..3).map(|k| off[k] * plain.normals[i][k]).sum();
        assert!((0.0..=0.2001).contains(&height), "{height}");
        assert!((0..3).all(|k| (off[k] - height * plain.normals[i][k]).abs() < 1e-5));
        let cosine: f32 = (0..3)
            .map(|k| roots.normals[i][k] * plain.normals[i][k])
            .sum();
        assert!(cosine > 0.0);
        tilted += usize::from(cosine < 0.999);
    }
    assert!(tilted > 20, "{tilted}");
}

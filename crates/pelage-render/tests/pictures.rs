//! Whole pictures: what must hold for any of them.

use pelage_render::{
    Backdrop, Camera, Picture, Reflection, RenderError, Scene, Settings, Shape, UpAxis, render,
};
use pelage_strands::StrandBuffer;
use pelage_surface::{Mesh, PolygonMesh};

/// A strand from `points` of one `width`.
fn strand(points: &[[f32; 3]], width: f32) -> StrandBuffer {
    let mut strands = StrandBuffer::new();
    strands.points = points.to_vec();
    strands.widths = vec![width; points.len()];
    strands.colors = vec![[0.5; 3]; points.len()];
    strands.offsets = vec![0, points.len() as u32];
    strands
}

/// A ball of `count` hairs around the origin, spiralled by the golden angle.
fn hair_ball(count: usize) -> StrandBuffer {
    let mut all = StrandBuffer::new();
    for i in 0..count {
        let y = 1.0 - 2.0 * (i as f32 + 0.5) / count as f32;
        let (sin, cos) = libm::sincosf(i as f32 * 2.399_963);
        let r = (1.0 - y * y).sqrt();
        let (x, z) = (r * cos, r * sin);
        let lean = 0.25 + 0.1 * libm::sinf(i as f32 * 0.7);
        let at = |t: f32| {
            let out = 1.0 + 0.45 * t;
            let turn = lean * t * t;
            [
                out * x + turn * z,
                out * y - 0.2 * t * t,
                out * z - turn * x,
            ]
        };
        let points: Vec<[f32; 3]> = (0..6).map(|k| at(k as f32 / 5.0)).collect();
        let mut hair = strand(&points, 0.012);
        hair.widths[5] = 0.0;
        let shade = 0.8 + 0.2 * libm::sinf(i as f32 * 1.3);
        hair.colors = vec![[0.55 * shade, 0.27 * shade, 0.1 * shade]; 6];
        all.append(&hair);
    }
    all
}

/// A ball of radius 1 in `rings` of latitude.
fn ball(rings: u32) -> Mesh {
    let mut mesh = PolygonMesh::default();
    let columns = rings * 2;
    for ring in 0..=rings {
        for column in 0..columns {
            let (s, c) = libm::sincosf(std::f32::consts::PI * ring as f32 / rings as f32);
            let (sa, ca) = libm::sincosf(std::f32::consts::TAU * column as f32 / columns as f32);
            mesh.positions.push([s * ca, c, s * sa]);
        }
    }
    for ring in 0..rings {
        for column in 0..columns {
            let next = (column + 1) % columns;
            let corner = |r: u32, c: u32| (ring + r) * columns + c;
            let (a, b) = (corner(0, column), corner(0, next));
            let (c, d) = (corner(1, next), corner(1, column));
            for t in [[a, b, c], [a, c, d]] {
                mesh.face_sizes.push(3);
                mesh.corner_vertices.extend(t);
            }
        }
    }
    mesh.corner_normals = (mesh.corner_vertices.iter())
        .map(|&v| mesh.positions[v as usize])
        .collect();
    Mesh::new(mesh).expect("a ball is a surface")
}

fn small(width: u32, height: u32) -> Settings {
    Settings {
        width,
        height,
        samples: 4,
        grid: 32,
        ..Settings::default()
    }
}

fn picture(scene: &Scene, settings: &Settings) -> Picture {
    let camera = Camera::framing(&scene.bounds(), UpAxis::Y, settings.aspect());
    render(scene, &camera, settings, |_| ()).expect("a sound scene")
}

#[test]
fn a_ribbon_seen_face_on_covers_its_length_times_its_width() {
    let pixels = 64u32;
    // From far away and 2 high: a picture of 2 by 2 units, nearly parallel.
    let distance = 100.0f32;
    let camera = Camera {
        from: [0.0, 0.0, distance],
        to: [0.0; 3],
        up: [0.0, 1.0, 0.0],
        fov: 2.0 * libm::atanf(1.0 / distance).to_degrees(),
    };
    for shape in [Shape::Ribbon, Shape::Round] {
        for thinnest in [0.0, 0.7] {
            for samples in [4, 16, 64] {
                for width in [0.004f32, 0.02, 0.1, 0.4] {
                    let hair = strand(&[[-0.6, -0.3, 0.0], [0.0; 3], [0.6, 0.3, 0.0]], width);
                    let settings = Settings {
                        samples,
                        shape,
                        thinnest,
                        film_tone: false,
                        backdrop: Backdrop::Plain([1.0; 3]),
                        lights: pelage_render::LightRig {
                            lights: Vec::new(),
                            sky: pelage_render::Sky {
                                zenith: [0.0; 3],
                                horizon: [0.0; 3],
                                ground: [0.0; 3],
                            },
                        },
                        ..small(pixels, pixels)
                    };
                    let scene = Scene::of_strands(&hair);
                    let shown = render(&scene, &camera, &settings, |_| ()).unwrap();
                    let dark: f32 = shown.rgb.iter().map(|c| 1.0 - c[0]).sum();
                    let covered = dark * (2.0 / pixels as f32) * (2.0 / pixels as f32);
                    // Tubes reach past either end by a twentieth of their width.
                    let past = if shape == Shape::Round {
                        0.1 * width
                    } else {
                        0.0
                    };
                    let expected = width * ((1.2f32 * 1.2 + 0.6 * 0.6).sqrt() + past);
                    // Hairs far under a pixel without a thinnest width are found by chance.
                    let chance = if thinnest == 0.0 {
                        0.35 / (samples as f32).sqrt()
                    } else {
                        0.0
                    };
                    // 0.03 is what 4 samples a pixel leave to chance on the thinnest.
                    let allowed = 0.03 + chance * (0.02 / width).min(1.0);
                    let off = (covered / expected - 1.0).abs();
                    assert!(
                        off < allowed,
                        "{shape:?} {width} at {samples}, thinnest {thinnest}: off by {off}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let (hair, skin) = (hair_ball(3000), ball(24));
    let scene = Scene::of_strands(&hair).on(&skin);
    let by = |threads| {
        let settings = Settings {
            threads: Some(threads),
            ..small(96, 60)
        };
        picture(&scene, &settings)
    };
    let one = by(1);
    for threads in [2, 3, 7] {
        assert!(by(threads) == one, "{threads} threads differ from one");
    }
}

#[test]
fn strands_in_two_buffers_look_as_in_one() {
    let hair = hair_ball(400);
    let (mut first, mut second) = (StrandBuffer::new(), StrandBuffer::new());
    for s in 0..hair.len() {
        let mut one = StrandBuffer::new();
        let range = hair.vertices(s);
        one.points = hair.points[range.clone()].to_vec();
        one.widths = hair.widths[range.clone()].to_vec();
        one.colors = hair.colors[range].to_vec();
        one.offsets = vec![0, one.points.len() as u32];
        if s < 200 { &mut first } else { &mut second }.append(&one);
    }
    let settings = small(64, 40);
    let whole = picture(&Scene::of_strands(&hair), &settings);
    let mut parts = Scene::of_strands(&first);
    parts.strands.push(&second);
    let apart = picture(&parts, &settings);
    let off = mean_difference(&whole.to_rgb8(), &apart.to_rgb8());
    assert!(off < 1.5, "{off} of 255");
}

fn mean_difference(a: &[u8], b: &[u8]) -> f32 {
    assert_eq!(a.len(), b.len());
    let sum: u64 = a
        .iter()
        .zip(b)
        .map(|(x, y)| u64::from(x.abs_diff(*y)))
        .sum();
    sum as f32 / a.len() as f32
}

#[test]
fn no_scene_panics_or_shows_anything_but_numbers() {
    let wild = [
        f32::NAN,
        f32::INFINITY,
        -f32::INFINITY,
        f32::MAX,
        -f32::MAX,
        1e-40,
        0.0,
    ];
    let mut scenes = vec![StrandBuffer::new()];
    for a in wild {
        for b in wild {
            let mut hair = strand(&[[0.0; 3], [a, 0.5, b], [1.0, b, 0.0]], 0.1);
            hair.widths[1] = b;
            hair.colors[2] = [a, b, 0.5];
            hair.opacities = vec![1.0, a, b];
            scenes.push(hair);
        }
    }
    scenes.push(strand(&[[3.0; 3]; 6], 0.1));
    scenes.push(strand(&[[3.0; 3]], 0.1));
    scenes.push(strand(&[[0.0; 3], [0.0, 0.0, 1.0]], 0.0));
    scenes.push(strand(&[[1e30, 1e30, 1e30], [1.01e30, 1e30, 1e30]], 1e28));
    let skin = ball(4);
    for (k, hair) in scenes.iter().enumerate() {
        // Floors take longest; a few will do.
        let backdrop = if k % 12 == 0 {
            Backdrop::default()
        } else {
            Backdrop::Plain([0.5; 3])
        };
        for scene in [Scene::of_strands(hair), Scene::of_strands(hair).on(&skin)] {
            for reflection in [Reflection::Marschner, Reflection::KajiyaKay] {
                for shape in [Shape::Ribbon, Shape::Round] {
                    let settings = Settings {
                        reflection,
                        shape,
                        backdrop,
                        ..small(5, 3)
                    };
                    let camera = Camera::framing(&scene.bounds(), UpAxis::Y, settings.aspect());
                    let shown = match render(&scene, &camera, &settings, |_| ()) {
                        Ok(shown) => shown,
                        // Scenes as large as numbers go leave no place for a camera.
                        Err(error) => {
                            assert!(error.to_string().starts_with("camera is ["), "{error}");
                            continue;
                        }
                    };
                    let fine = |c: &f32| (0.0..=1.0).contains(c);
                    assert!(shown.rgb.iter().flatten().all(fine));
                }
            }
        }
    }
}

#[test]
fn strands_that_are_not_finite_are_counted_and_left_out() {
    let mut hair = hair_ball(50);
    hair.points[7][1] = f32::NAN;
    hair.points[100][0] = f32::INFINITY;
    assert_eq!(
        picture(&Scene::of_strands(&hair), &small(8, 8)).skipped_strands,
        2
    );
}

#[test]
fn one_pixel_is_a_picture() {
    let hair = hair_ball(50);
    let shown = picture(&Scene::of_strands(&hair), &small(1, 1));
    assert_eq!(shown.rgb.len(), 1);
    assert!(shown.to_png_bytes().unwrap().starts_with(b"\x89PNG"));
    assert!(shown.to_png16_bytes().unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn settings_out_of_range_are_refused_and_named() {
    let hair = hair_ball(5);
    let scene = Scene::of_strands(&hair);
    let camera = Camera::framing(&scene.bounds(), UpAxis::Y, 1.0);
    let refused = |settings: Settings| {
        render(&scene, &camera, &settings, |_| ())
            .unwrap_err()
            .to_string()
    };
    let none = Settings {
        samples: 0,
        ..small(4, 4)
    };
    assert_eq!(refused(none), "samples is 0; it must be in 1..=4096");
    assert_eq!(refused(small(0, 4)), "width is 0; it must be in 1..=16384");
    let nowhere = Camera {
        to: camera.from,
        ..camera
    };
    let error = render(&scene, &nowhere, &small(4, 4), |_| ()).unwrap_err();
    assert!(
        error
            .to_string()
            .ends_with("it must be two different finite points"),
        "{error}"
    );
    let mut broken = hair_ball(2);
    broken.widths.pop();
    let error = render(&Scene::of_strands(&broken), &camera, &small(4, 4), |_| ()).unwrap_err();
    assert_eq!(error.to_string(), "widths has 11 entries, not 12");
}

#[test]
fn progress_grows_from_nothing_to_all() {
    let hair = hair_ball(50);
    let scene = Scene::of_strands(&hair);
    let camera = Camera::framing(&scene.bounds(), UpAxis::Y, 1.0);
    let seen = std::sync::Mutex::new(Vec::new());
    let report = |share| seen.lock().unwrap().push(share);
    render(&scene, &camera, &small(40, 40), report).unwrap();
    let seen = seen.into_inner().unwrap();
    assert_eq!((seen[0], seen[seen.len() - 1]), (0.0, 1.0));
    assert!(seen.windows(2).all(|w| w[0] <= w[1]), "{seen:?}");
}

#[test]
fn a_png_appears_whole_and_nothing_is_left_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let shown = picture(&Scene::of_strands(&hair_ball(20)), &small(16, 9));
    let path = folder.path().join("ball.png");
    shown.write_png(&path).unwrap();
    let read = image::open(&path).unwrap().into_rgb8();
    assert_eq!(read.as_raw(), &shown.to_rgb8());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    let missing = folder.path().join("no/such/folder.png");
    let error = shown.write_png(&missing).unwrap_err();
    assert!(matches!(error, RenderError::Write { .. }));
}

/// Largest mean difference from a stored picture, of 255. Pictures are the same on
/// every machine; the room is for deliberate small changes of the code.
const TOLERANCE: f32 = 0.5;

/// [`TOLERANCE`], or none where `PELAGE_EXACT=1` asks whether machines agree.
fn tolerance() -> f32 {
    match std::env::var_os("PELAGE_EXACT") {
        Some(_) => 0.0,
        None => TOLERANCE,
    }
}

/// Compares with `tests/golden/NAME.png`; `PELAGE_BLESS=1` rewrites it instead.
fn compare(name: &str, shown: &Picture) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let path = folder.join(format!("{name}.png"));
    if std::env::var_os("PELAGE_BLESS").is_some() {
        std::fs::create_dir_all(&folder).expect("a folder");
        shown.write_png(&path).expect("a file");
    }
    let golden = image::open(&path).expect("the stored picture").into_rgb8();
    let off = mean_difference(golden.as_raw(), &shown.to_rgb8());
    assert!(
        off <= tolerance(),
        "{name}: {off} of 255 from the stored picture"
    );
}

#[test]
fn a_hair_ball_looks_as_it_did() {
    let (hair, skin) = (hair_ball(6000), ball(24));
    let scene = Scene::of_strands(&hair).on(&skin);
    let settings = Settings {
        samples: 8,
        grid: 64,
        ..small(160, 120)
    };
    compare("hair_ball", &picture(&scene, &settings));
    let settings = Settings {
        reflection: Reflection::KajiyaKay,
        ..settings
    };
    compare("hair_ball_kajiya_kay", &picture(&scene, &settings));
}

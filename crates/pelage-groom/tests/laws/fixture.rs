//! A small groom made in memory: a bumpy ball with a density, a length and a colour map.

use pelage_curves::Vec3;
use pelage_curves::glam::Mat3;
use pelage_groom::recipe::Recipe;
use pelage_groom::{Capture, Clock, Groom, Images, Order, Plan, Pose, Request, Scratch, generate};
use pelage_strands::{Collect, StrandBuffer, StreamInfo};
use pelage_surface::{ImageMap, Mesh, PolygonMesh};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// What to make the groom of.
pub struct Fixture<'a> {
    /// Hairs of the recipe.
    pub count: u64,
    /// Rings of the ball, twice as many columns.
    pub rings: u32,
    /// No maps.
    pub flat: bool,
    /// Texture turned by a quarter.
    pub turned_uvs: bool,
    /// More lines of the recipe.
    pub more: &'a str,
}

/// Displaced roots.
pub const DISPLACED: &str = "roots.displacement = { value = 0.1, map = 'length.png' }";

/// Displaced roots, and noise on all hairs.
const NOISY: &str = "
    roots.displacement = { value = 0.1, map = 'length.png' }
    frizz = { root = 0.1, tip = { value = 0.3, map = 'length.png' }, frequency = [2, 3, 2] }
    cut.length = { map = 'length.png' }
    output.skip_threshold = 0.9
    kink = { root = 0.01, tip = 0.05, frequency = [20, { value = 30, map = 'length.png' }, 20] }
";

/// What hairs can take from their guides and from chance.
const SHARED: &str = "interpolation = { method = 'natural-neighbor', facing = true }
    color.mutant = { percent = 20.0 }
    color.variation = { hue = 20.0, saturation = 0.1, value = 0.1 }";

/// Everything there is.
const EVERYTHING: &str = "frizz = { tip = 0.2, animation = { amount = 0.5, speed = 1.0 } }
    kink = { root = { ramp = [[0, 0], [0.3, 0.05]] }, frequency = [9, 9, 9] }
    cut.length = { map = 'length.png' }
    output.skip_threshold = 0.95
    roots.displacement = { value = 0.1, map = 'length.png' }
    interpolation = { space = 'frenet', method = 'natural-neighbor', facing = true }
    opacity = { root = { ramp = [[0, 1.0], [0.5, 0.7], [1, 0.1]] } }
    width = { root = 0.01, tip = { value = 0.001, map = 'length.png' } }
    [strand]
    count = 3
    splay = { root = 0.01, center = { value = 0.05, map = 'length.png' }, tip = 0.02 }
    twist = 90.0
    aspect = 0.5
    offset = 0.1
    randomize = 0.4
    [[clump.levels]]
    size = 0.5
    root = 0.2
    tip = { value = 0.9, map = 'length.png' }
    random = 0.3
    [[clump.levels]]
    around = 'guides'
    tip = 0.5
    preserve_length = true
    [flyaway]
    percent = 10.0
    [color.mutant]
    percent = 20.0
";

/// Hairs mixed by curvature and torsion, and all that comes after.
const FRENET: &str = "interpolation.space = 'frenet'
    frizz = { tip = 0.1, frequency = [2, 3, 2] }
    cut.length = { map = 'length.png' }
    output.skip_threshold = 0.98
";

/// Hairs mixed as Super-Helices, and all that comes after.
const HELIX: &str = "interpolation = { space = 'helix', elements = 3 }
    frizz = { tip = 0.1, frequency = [2, 3, 2] }
    cut.length = { map = 'length.png' }
    output.skip_threshold = 0.98
";

/// Every kind of roots, and of hairs.
pub fn kinds() -> impl Iterator<Item = Fixture<'static>> {
    let patterns = ["roots.pattern = 'random'", "roots.pattern = 'blue-noise'"];
    let [random, blue_noise] = patterns;
    let roots = ["", DISPLACED, NOISY, random, blue_noise];
    let all = roots.into_iter().chain([SHARED, FRENET, HELIX, EVERYTHING]);
    all.map(|more| Fixture {
        more,
        ..Fixture::default()
    })
}

impl Default for Fixture<'_> {
    fn default() -> Self {
        Self {
            count: 5000,
            rings: 24,
            flat: false,
            turned_uvs: false,
            more: "",
        }
    }
}

impl Fixture<'_> {
    /// The ball, with a seam along a meridian.
    pub fn mesh(&self) -> PolygonMesh {
        let (rows, columns) = (self.rings, self.rings * 2);
        let mut mesh = PolygonMesh::default();
        for row in 0..=rows {
            for column in 0..columns {
                let a = std::f32::consts::PI * row as f32 / rows as f32;
                let b = std::f32::consts::TAU * column as f32 / columns as f32;
                let r = 1.0 + 0.1 * libm::sinf(3.0 * b) * libm::sinf(a);
                mesh.positions.push([
                    r * libm::sinf(a) * libm::cosf(b),
                    r * libm::cosf(a),
                    r * libm::sinf(a) * libm::sinf(b),
                ]);
            }
        }
        for row in 0..rows {
            for column in 0..columns {
                mesh.face_sizes.push(4);
                for (r, c) in [(0, 0), (0, 1), (1, 1), (1, 0)] {
                    let at = (row + r) * columns + (column + c) % columns;
                    mesh.corner_vertices.push(at);
                    let u = (column + c) as f32 / columns as f32;
                    let v = 1.0 - (row + r) as f32 / rows as f32;
                    mesh.corner_uvs.push(if self.turned_uvs {
                        [v, 1.0 - u]
                    } else {
                        [u, v]
                    });
                }
            }
        }
        mesh
    }

    fn recipe(&self) -> Recipe {
        let maps = "
            roots.density = { map = 'density.png' }
            scale = { amount = { map = 'length.png' }, random = 0.3 }
            color.root = { value = [0.1, 0.05, 0.02], map = 'color.png' }
            color.tip = [0.9, 0.6, 0.3]
        ";
        let text = format!(
            "surface.mesh = 'ball.obj'
            hair = {{ count = {}, seed = 7 }}
            groups.segments = 6
            guides.grow = {{ count = 200, length = 0.4, lean = 40.0, comb = [0.3, -1.0, 0.2],
                curl = {{ radius = 0.02, turns = 1.5 }} }}
            ",
            self.count
        );
        let maps = if self.flat { "" } else { maps };
        // What is more comes last: it may have sections of its own.
        let text = format!("{maps}\n{text}\n{}", self.more);
        Recipe::parse(&text, Path::new("groom.toml")).unwrap()
    }

    /// The plan of the groom.
    pub fn plan(&self) -> Plan {
        let groom = Groom {
            recipe: self.recipe(),
            mesh: self.mesh(),
            keep_file_normals: true,
            images: images(),
            guides: Vec::new(),
        };
        Plan::new(groom).unwrap()
    }
}

/// Every map that recipes here name.
fn images() -> Images {
    let mut images = Images::new();
    let mut add = |name: &str, channels, f: &dyn Fn(usize, usize, usize) -> f32| {
        let size = 64;
        let texel = |i: usize| f(i / channels % size, i / channels / size, i % channels);
        let texels: Vec<f32> = (0..size * size * channels).map(texel).collect();
        let map = ImageMap::new(size as u32, size as u32, channels as u32, texels, false);
        images.insert(PathBuf::from(name), Arc::new(map.unwrap()));
    };
    add("density.png", 1, &|x, y, _| {
        if (x / 8 + y / 8) % 2 == 0 { 1.0 } else { 0.2 }
    });
    add("one.png", 1, &|_, _, _| 1.0);
    add("length.png", 1, &|x, _, _| 0.5 + x as f32 / 128.0);
    add("color.png", 3, &|x, y, k| [x, y, x + y][k] as f32 / 256.0);
    images
}

/// A plan of the ball with guides along its normals, which stay where they are whatever
/// the recipe says of roots; and those guides.
pub fn along_normals(count: u64, more: &str) -> (Plan, Vec<Vec<Vec3>>) {
    let mesh = Fixture::default().mesh();
    let along = |p: Vec3| (0..5).map(|i| p * (1.0 + 0.1 * i as f32)).collect();
    let places = mesh.positions.iter().step_by(7);
    let guides: Vec<Vec<Vec3>> = places.map(|&p| along(p.into())).collect();
    let text = format!(
        "surface.mesh = 'ball.obj'\nguides.curves = 'guides.usda'\nhair.count = {count}\n{more}"
    );
    let groom = Groom {
        recipe: Recipe::parse(&text, Path::new("groom.toml")).unwrap(),
        mesh,
        keep_file_normals: true,
        images: images(),
        guides: guides.clone(),
    };
    (Plan::new(groom).unwrap(), guides)
}

/// Asks for `hairs` on `threads` threads, as a still.
pub fn request(hairs: Range<u64>, threads: usize) -> Request {
    Request {
        order: Order::default(),
        hairs,
        threads,
        frame: 0.0,
        info: StreamInfo::default(),
    }
}

/// The strands of `hairs` by the threaded run.
pub fn collect(plan: &Plan, hairs: Range<u64>, threads: usize) -> StrandBuffer {
    collected(plan, &request(hairs, threads))
}

/// The strands that are asked for.
pub fn collected(plan: &Plan, request: &Request) -> StrandBuffer {
    let mut sink = Collect::default();
    generate(
        plan,
        request,
        &mut |_| Ok(Pose::default()),
        &mut sink,
        &mut |_| true,
    )
    .unwrap();
    sink.strands
}

/// The strands of a list of hairs on a pose, in one chunk.
pub fn strands(plan: &Plan, hairs: &[u64], pose: Option<&Mesh>) -> StrandBuffer {
    let (mut capture, mut clock) = (Capture::default(), Clock::default());
    let mut out = StrandBuffer::new();
    plan.capture_listed(hairs, &mut capture, &mut clock);
    let pose = Pose {
        surface: pose.map(|mesh| Arc::new(mesh.clone())),
        ..Pose::default()
    };
    plan.evaluate(
        &capture,
        &plan.posed(&pose).unwrap(),
        &mut Scratch::default(),
        &mut out,
        &mut clock,
    );
    out
}

/// Curves a hair in `strands`, where every hair has as many.
pub fn fibers(strands: &StrandBuffer) -> usize {
    1 + strands.strand_id.iter().max().copied().unwrap_or(0) as usize
}

/// A rotation and a shift.
pub fn motion() -> (Mat3, Vec3) {
    let (s, c) = (libm::sinf(1.1), libm::cosf(1.1));
    let about_y = Mat3::from_cols(Vec3::new(c, 0.0, -s), Vec3::Y, Vec3::new(s, 0.0, c));
    let about_x = Mat3::from_cols(Vec3::X, Vec3::new(0.0, c, s), Vec3::new(0.0, -s, c));
    (about_y * about_x, Vec3::new(0.5, -2.0, 1.5))
}

/// The mesh in another place.
pub fn moved(mesh: &PolygonMesh, turn: Mat3, shift: Vec3) -> PolygonMesh {
    let mut mesh = mesh.clone();
    for p in &mut mesh.positions {
        *p = (turn * Vec3::from(*p) + shift).to_array();
    }
    mesh
}

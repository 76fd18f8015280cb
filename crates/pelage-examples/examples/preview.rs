//! Draws an example: `preview NAME FOLDER` writes its files and pictures of it,
//! by a small z-buffer rasteriser, to look at while changing a shape.

use glam::DVec3;
use pelage_examples::{Example, example, write};
use pelage_surface::ImageMap;
use std::error::Error;
use std::path::Path;

const SIZE: usize = 720;

struct View {
    right: DVec3,
    up: DVec3,
    towards: DVec3,
    center: DVec3,
    scale: f64,
}

impl View {
    fn new(azimuth: f64, elevation: f64, low: DVec3, high: DVec3) -> Self {
        let (sa, ca) = libm_sincos(azimuth);
        let (se, ce) = libm_sincos(elevation);
        let towards = DVec3::new(sa * ce, se, ca * ce);
        let right = DVec3::Y.cross(towards).normalize();
        Self {
            right,
            up: towards.cross(right),
            towards,
            center: (low + high) * 0.5,
            scale: SIZE as f64 * 1.25 / (high - low).length(),
        }
    }

    fn project(&self, p: DVec3) -> DVec3 {
        let q = p - self.center;
        let half = SIZE as f64 * 0.5;
        DVec3::new(
            half + q.dot(self.right) * self.scale,
            half - q.dot(self.up) * self.scale,
            q.dot(self.towards),
        )
    }
}

fn libm_sincos(degrees: f64) -> (f64, f64) {
    libm::sincos(degrees.to_radians())
}

struct Picture {
    pixels: Vec<u8>,
    depth: Vec<f64>,
}

impl Picture {
    fn new() -> Self {
        Self {
            pixels: vec![40; SIZE * SIZE * 3],
            depth: vec![f64::MIN; SIZE * SIZE],
        }
    }

    fn put(&mut self, x: usize, y: usize, z: f64, color: [f64; 3]) {
        let i = y * SIZE + x;
        if z > self.depth[i] {
            self.depth[i] = z;
            let codes = color.map(|c| (c.clamp(0.0, 1.0) * 255.0) as u8);
            self.pixels[i * 3..i * 3 + 3].copy_from_slice(&codes);
        }
    }

    fn triangle(&mut self, p: [DVec3; 3], color: impl Fn([f64; 3]) -> [f64; 3]) {
        let q = p.map(|p| p.truncate());
        let doubled = (q[1] - q[0]).perp_dot(q[2] - q[0]);
        if doubled >= 0.0 {
            return;
        }
        let last = SIZE as f64 - 1.0;
        let low = q[0].min(q[1]).min(q[2]).max(glam::DVec2::ZERO);
        let high = q[0].max(q[1]).max(q[2]).min(glam::DVec2::splat(last));
        for y in low.y as usize..=high.y.max(0.0) as usize {
            for x in low.x as usize..=high.x.max(0.0) as usize {
                let at = glam::DVec2::new(x as f64, y as f64);
                let w = [1, 2, 0].map(|k| (q[(k + 1) % 3] - q[k]).perp_dot(at - q[k]) / doubled);
                if w.iter().all(|&w| w >= 0.0) {
                    let z = (0..3).map(|k| p[k].z * w[k]).sum();
                    self.put(x, y, z, color(w));
                }
            }
        }
    }

    fn line(&mut self, a: DVec3, b: DVec3, color: [f64; 3]) {
        let steps = ((b - a).truncate().abs().max_element().ceil() as usize).max(1);
        for k in 0..=steps {
            let p = a.lerp(b, k as f64 / steps as f64);
            if p.x >= 0.0 && p.y >= 0.0 && p.x < SIZE as f64 && p.y < SIZE as f64 {
                self.put(p.x as usize, p.y as usize, p.z + 1e-3, color);
            }
        }
    }
}

fn look_up(map: &ImageMap, uv: [f64; 2]) -> [f64; 3] {
    let at = |x: f64, n: u32| ((x * n as f64) as u32).min(n - 1);
    let (x, y) = (at(uv[0], map.width()), at(1.0 - uv[1], map.height()));
    [0, 1, 2].map(|c| map.texel(x, y, c.min(map.channels() - 1)) as f64)
}

fn picture(example: &Example, view: &View, map: Option<&ImageMap>, guides: bool) -> Picture {
    let mut out = Picture::new();
    let mesh = &example.mesh;
    let vector = |p: [f32; 3]| DVec3::new(p[0] as f64, p[1] as f64, p[2] as f64);
    let light = (view.towards + view.up * 0.8 + view.right * 0.6).normalize();
    let mut start = 0;
    for &n in &mesh.face_sizes {
        for k in 1..n as usize - 1 {
            let corners = [start, start + k, start + k + 1];
            let p = corners
                .map(|c| view.project(vector(mesh.positions[mesh.corner_vertices[c] as usize])));
            out.triangle(p, |w| {
                let normal: DVec3 = (0..3)
                    .map(|k| vector(mesh.corner_normals[corners[k]]) * w[k])
                    .sum();
                let shade = 0.35 + 0.65 * normal.normalize().dot(light).max(0.0);
                let uv = [0, 1].map(|a| {
                    (0..3)
                        .map(|k| mesh.corner_uvs[corners[k]][a] as f64 * w[k])
                        .sum()
                });
                let color = map.map_or([0.75, 0.72, 0.7], |map| look_up(map, uv));
                color.map(|c| c * (shade + 0.15))
            });
        }
        start += n as usize;
    }
    if let (true, Some((_, curves))) = (guides, &example.guides) {
        for s in 0..curves.len() {
            let range = curves.vertices(s);
            let n = range.len() as f64;
            for (k, i) in (range.start..range.end - 1).enumerate() {
                let t = k as f64 / n;
                let [a, b] = [i, i + 1].map(|i| view.project(vector(curves.points[i])));
                out.line(a, b, [1.0, 0.9 - 0.7 * t, 0.1 + 0.2 * t]);
            }
        }
    }
    out
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let name = arguments.next().ok_or("preview NAME FOLDER")?;
    let folder = arguments.next().ok_or("preview NAME FOLDER")?;
    let folder = Path::new(&folder);
    let started = std::time::Instant::now();
    let example = example(&name).ok_or("no such example")?;
    println!(
        "{name}: {} triangles, {} guides, {} maps, {:.2} s",
        example.mesh.face_sizes.len(),
        example.guides.as_ref().map_or(0, |g| g.1.len()),
        example.maps.len(),
        started.elapsed().as_secs_f64()
    );
    write(&example, folder)?;
    let points = || {
        example
            .mesh
            .positions
            .iter()
            .map(|p| DVec3::from(p.map(f64::from)))
    };
    let low = points().fold(DVec3::MAX, DVec3::min);
    let high = points().fold(DVec3::MIN, DVec3::max);
    let color = ["skin.png", "tip_color.png", "density.png"]
        .iter()
        .find_map(|n| example.maps.iter().find(|m| m.0 == *n))
        .map(|m| &m.1);
    let views = [
        (90.0, 5.0),
        (35.0, 12.0),
        (0.0, 5.0),
        (180.0, 15.0),
        (60.0, 50.0),
        (40.0, -35.0),
    ];
    for (title, map, guides) in [
        ("shape", None, false),
        ("map", color, false),
        ("guides", None, true),
    ] {
        // Six views on one sheet, three a row.
        let mut sheet = image::RgbImage::new(SIZE as u32 * 3, SIZE as u32 * 2);
        for (k, (azimuth, elevation)) in views.into_iter().enumerate() {
            let view = View::new(azimuth, elevation, low, high);
            let pixels = picture(&example, &view, map, guides).pixels;
            let tile = image::RgbImage::from_raw(SIZE as u32, SIZE as u32, pixels).ok_or("size")?;
            let (x, y) = ((k % 3 * SIZE) as i64, (k / 3 * SIZE) as i64);
            image::imageops::replace(&mut sheet, &tile, x, y);
        }
        sheet.save(folder.join(format!("preview_{title}.png")))?;
    }
    Ok(())
}

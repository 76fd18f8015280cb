//! Light from a textured lamp, by three ways of sampling its surface.
//!
//! A lamp shade with a bright pattern lights a point of the floor. The light is the
//! integral over the shade of radiance times the cosines at both ends over the squared
//! distance. It is estimated with roots that are uniform over the area, with roots that
//! rejection gives the density of the radiance, and with [`RootSampler`], whose density
//! is the same but whose roots are stratified. Prints the error of each for a growing
//! number of samples and plots it (document 004 names this use in section 2.1.8):
//!
//! ```text
//! cargo run --release --example luminaire -- luminaire.svg
//! ```

// Of the plots of the command only one kind is drawn here.
#[allow(dead_code)]
#[path = "../src/cli/plot.rs"]
mod plot;

use pelage::curves::Vec3;
use pelage::surface::{
    Density, ImageMap, Mesh, PolygonMesh, RootPdf, RootSampler, Spread, SurfacePoint, Wrap, hash,
};
use plot::{Axes, Line, logarithmic};
use std::error::Error;
use std::f64::consts::TAU;

/// Estimates of each kind whose errors are averaged.
const TRIALS: u64 = 64;

const NAMES: [&str; 3] = ["uniform", "rejection", "RootSampler"];

fn main() -> Result<(), Box<dyn Error>> {
    let output = std::env::args().nth(1).unwrap_or("luminaire.svg".into());
    let lamp = Lamp {
        mesh: shade()?,
        radiance: pattern()?,
        receiver: Vec3::new(1.2, -1.5, 0.4),
        up: Vec3::Y,
    };
    let truth = lamp.exact(|place| lamp.light(place));
    let flux = lamp.exact(|place| lamp.radiance(place));
    println!("light at the floor: {truth:.6}\n");
    println!("| samples | {} |\n|---|---|---|---|", NAMES.join(" | "));
    let mut lines = NAMES.map(|name| Line {
        name: name.into(),
        points: Vec::new(),
    });
    for samples in (4..=14).map(|k| 1u64 << k) {
        let errors = lamp.errors(samples, truth, flux)?;
        println!(
            "| {samples} | {} |",
            errors.map(|e| format!("{e:.5}")).join(" | ")
        );
        for (line, error) in lines.iter_mut().zip(errors) {
            line.points.push((samples as f64, error));
        }
    }
    let axes = Axes {
        title: "Light from a textured lamp",
        x: "samples",
        y: "relative error (root mean square)",
    };
    std::fs::write(&output, logarithmic(&axes, &lines)?)?;
    println!("\n{output}");
    Ok(())
}

/// A lamp and the floor that it lights.
struct Lamp {
    mesh: Mesh,
    radiance: ImageMap,
    receiver: Vec3,
    up: Vec3,
}

impl Lamp {
    fn radiance(&self, place: &SurfacePoint) -> f64 {
        let uv = self.mesh.uv(place);
        self.radiance.sample(uv.x, uv.y, 0, Wrap::Repeat) as f64
    }

    /// Light that a unit of area at `place` sends to the floor. The shade glows on both
    /// sides and hides nothing.
    fn light(&self, place: &SurfacePoint) -> f64 {
        let [a, b, c] = self.mesh.corners(place.triangle as usize);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let way = self.mesh.position(place) - self.receiver;
        let distance = way.length();
        let toward = way / distance;
        let cosines = toward.dot(self.up).max(0.0) * toward.dot(normal).abs();
        self.radiance(place) * (cosines / (distance * distance)) as f64
    }

    /// Root mean square of the relative error of the three estimates.
    fn errors(&self, samples: u64, truth: f64, flux: f64) -> Result<[f64; 3], Box<dyn Error>> {
        let density = Density {
            value: 1.0,
            map: Some((&self.radiance, 0, Wrap::Repeat)),
        };
        let even = Density {
            value: 1.0,
            map: None,
        };
        let mut squares = [0.0; 3];
        for seed in 0..TRIALS {
            let sampler = RootSampler::new(&self.mesh, &density, seed).ok_or("a dark lamp")?;
            let uniform = RootSampler::new(&self.mesh, &even, seed)
                .ok_or("no lamp")?
                .with_spread(Spread::Random);
            let estimates = [
                self.estimate(&uniform, samples, |p| self.light(p)),
                self.by_rejection(&uniform, flux, samples),
                self.estimate(&sampler, samples, |p| self.light(p)),
            ];
            for (square, estimate) in squares.iter_mut().zip(estimates) {
                let error = estimate / truth - 1.0;
                *square += error * error;
            }
        }
        Ok(squares.map(|s| (s / TRIALS as f64).sqrt()))
    }

    /// The mean of light over density at the sampler's roots.
    fn estimate(
        &self,
        sampler: &RootSampler,
        samples: u64,
        light: impl Fn(&SurfacePoint) -> f64,
    ) -> f64 {
        let pdf = RootPdf::new(sampler, &self.mesh);
        let mut roots = Vec::new();
        sampler.roots(0..samples, &mut roots);
        let sum: f64 = roots.iter().map(|r| light(r) / pdf.density(r)).sum();
        sum / samples as f64
    }

    /// The same with uniform roots of which as many are taken as the radiance says: their
    /// density is the radiance over `flux`, its integral.
    fn by_rejection(&self, uniform: &RootSampler, flux: f64, samples: u64) -> f64 {
        let brightest = self.radiance.texels().iter().fold(0.0, f32::max);
        let taken = (0..)
            .map(|i| (uniform.root(i), (hash(!i) >> 40) as f64 / (1 << 24) as f64))
            .filter(|(root, coin)| coin * (brightest as f64) < self.radiance(root))
            .take(samples as usize);
        let sum: f64 = taken
            .map(|(root, _)| self.light(&root) / self.radiance(&root))
            .sum();
        sum * flux / samples as f64
    }

    /// The integral of `light` over the lamp, by very many well-spread roots.
    fn exact(&self, light: impl Fn(&SurfacePoint) -> f64) -> f64 {
        let even = Density {
            value: 1.0,
            map: None,
        };
        RootSampler::new(&self.mesh, &even, 1)
            .map_or(0.0, |sampler| self.estimate(&sampler, 1 << 23, light))
    }
}

/// A shade: a bulging tube about the vertical.
fn shade() -> Result<Mesh, Box<dyn Error>> {
    let tube = PolygonMesh::sheet(96, 48, |u, v| {
        let radius = 0.3 + 0.25 * libm::sin(0.5 * TAU * v);
        [radius * libm::cos(TAU * u), v, radius * libm::sin(TAU * u)]
    });
    Ok(Mesh::new(tube)?)
}

/// A dim shade with some eighty bright holes.
fn pattern() -> Result<ImageMap, Box<dyn Error>> {
    let size = 256;
    let texel = |i: u32| {
        let (x, y) = (i % size, i / size);
        let hole = (x / 16 + y / 16 * 64) as u64;
        let lit = (hash(hole).is_multiple_of(3)) as u32 as f32;
        // Soft edges: where a piece is much darker at its centre than elsewhere, its few
        // bright samples count too much.
        let [x, y] = [x, y].map(|i| (i % 16) as f32 / 8.0 - 1.0);
        let near = (1.0 - x * x - y * y).max(0.0);
        1.0 + 60.0 * lit * near * near
    };
    let texels: Vec<f32> = (0..size * size).map(texel).collect();
    Ok(ImageMap::new(size, size, 1, texels, false)?)
}

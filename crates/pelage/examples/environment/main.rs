//! Light of the sky on a tilted plane, by several ways of sampling directions.
//!
//! A sky in latitude and longitude has a sun a million times as bright as the rest. The
//! light on the plane is the integral over the sky of luminance times the cosine. It is
//! estimated with directions that are uniform over the sphere, with directions in
//! proportion to the cosine, and with directions in proportion to the luminance
//! ([`Sky`], which is there to be copied; `sky.rs` has its tests): with independent
//! numbers, and with stratified ones whose texels lie row by row or along a curve. Prints
//! the error of each for a growing number of samples and plots it. The sky is made here,
//! or read from an HDR or EXR file:
//!
//! ```text
//! cargo run --release --example environment -- environment.svg [sky.exr]
//! ```

// Of the plots of the command only one kind is drawn here.
#[allow(dead_code)]
#[path = "../../src/cli/plot.rs"]
mod plot;
mod sky;

use pelage::curves::DVec3;
use pelage::io::read_image;
use pelage::surface::{ImageMap, RootSequence, Spread};
use plot::{Axes, Line, logarithmic};
use sky::Sky;
use std::error::Error;
use std::f64::consts::{PI, TAU};

/// Estimates of each kind whose errors are averaged.
const TRIALS: u64 = 64;

const NAMES: [&str; 5] = [
    "uniform",
    "cosine",
    "guided, random numbers",
    "guided, texels by rows",
    "guided",
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let output = arguments.next().unwrap_or("environment.svg".into());
    let image = match arguments.next() {
        Some(path) => read_image(path.as_ref())?,
        None => made_sky()?,
    };
    let plane = Plane {
        sky: Sky::new(&image).ok_or("a black sky")?,
        by_rows: Sky::ordered(&image, |column, row| row << 32 | column).ok_or("a black sky")?,
        normal: DVec3::new(0.3, 0.8, -0.5).normalize(),
    };
    let truth = plane.sky.integral(4, |d| plane.cosine(d));
    println!("light on the plane: {truth:.6}\n");
    println!("| samples | {} |", NAMES.join(" | "));
    println!("|---|{}", "---|".repeat(NAMES.len()));
    let mut lines = NAMES.map(|name| Line {
        name: name.into(),
        points: Vec::new(),
    });
    for samples in (4..=14).map(|k| 1u64 << k) {
        let errors = plane.errors(samples, truth);
        println!(
            "| {samples} | {} |",
            errors.map(|e| format!("{e:.2e}")).join(" | ")
        );
        for (line, error) in lines.iter_mut().zip(errors) {
            line.points.push((samples as f64, error));
        }
    }
    let axes = Axes {
        title: "Light of the sky on a tilted plane",
        x: "samples",
        y: "relative error (root mean square)",
    };
    std::fs::write(&output, logarithmic(&axes, &lines)?)?;
    println!("\n{output}");
    Ok(())
}

/// A plane under a sky.
struct Plane {
    sky: Sky,
    by_rows: Sky,
    normal: DVec3,
}

impl Plane {
    fn cosine(&self, direction: DVec3) -> f64 {
        direction.dot(self.normal).max(0.0)
    }

    /// Root mean square of the relative error of each kind of estimate.
    fn errors(&self, samples: u64, truth: f64) -> [f64; NAMES.len()] {
        let mut squares = [0.0; NAMES.len()];
        for seed in 0..TRIALS {
            let even = RootSequence::new(seed, Spread::Stratified);
            let dice = RootSequence::new(seed, Spread::Random);
            let estimates = [
                self.estimate(&even, samples, uniform),
                self.estimate(&even, samples, |x, y| self.by_cosine(x, y)),
                self.estimate(&dice, samples, |x, y| by_light(&self.sky, x, y)),
                self.estimate(&even, samples, |x, y| by_light(&self.by_rows, x, y)),
                self.estimate(&even, samples, |x, y| by_light(&self.sky, x, y)),
            ];
            for (square, estimate) in squares.iter_mut().zip(estimates) {
                let error = estimate / truth - 1.0;
                *square += error * error;
            }
        }
        squares.map(|s| (s / TRIALS as f64).sqrt())
    }

    /// The mean of light over density, at directions that `draw` makes of two numbers.
    fn estimate(
        &self,
        numbers: &RootSequence,
        samples: u64,
        draw: impl Fn(u64, u32) -> (DVec3, f64),
    ) -> f64 {
        let light = |i| {
            let (x, y) = numbers.sample(i);
            let (direction, pdf) = draw(x, y);
            match self.cosine(direction) {
                0.0 => 0.0,
                cosine => self.sky.luminance(direction) * cosine / pdf,
            }
        };
        (0..samples).map(light).sum::<f64>() / samples as f64
    }

    /// A direction in proportion to the cosine: a point of the disc below it, lifted.
    fn by_cosine(&self, x: u64, y: u32) -> (DVec3, f64) {
        let [up, turns] = fractions(x, y);
        let cosine = up.sqrt();
        let (sin, cos) = libm::sincos(TAU * turns);
        let (across, along) = self.normal.any_orthonormal_pair();
        let level = (across * cos + along * sin) * (1.0 - up).sqrt();
        (level + self.normal * cosine, cosine / PI)
    }
}

/// A direction in proportion to the luminance.
fn by_light(sky: &Sky, x: u64, y: u32) -> (DVec3, f64) {
    let direction = sky.sample(x, y);
    (direction, sky.pdf(direction))
}

/// A direction of the whole sphere.
fn uniform(x: u64, y: u32) -> (DVec3, f64) {
    let [up, turns] = fractions(x, y);
    let height = 2.0 * up - 1.0;
    let radius = (1.0 - height * height).max(0.0).sqrt();
    let (sin, cos) = libm::sincos(TAU * turns);
    let direction = DVec3::new(radius * cos, height, radius * sin);
    (direction, 1.0 / (4.0 * PI))
}

/// Two numbers of a sequence as fractions of 1.
fn fractions(x: u64, y: u32) -> [f64; 2] {
    [
        (x >> 11) as f64 / (1u64 << 53) as f64,
        y as f64 / (1u64 << 32) as f64,
    ]
}

/// A clear day: a sky that pales towards the horizon, dark ground, and a sun of half a
/// degree in radius, 10^6 times as bright as the horizon.
fn made_sky() -> Result<ImageMap, Box<dyn Error>> {
    let (width, height) = (1024, 512);
    let sun = DVec3::new(0.5, 0.7, -0.4).normalize();
    let texel = |i: u32| {
        let [across, down] = [i % width, i / width].map(|k| k as f64 + 0.5);
        let (sin, cos) = libm::sincos(TAU * across / width as f64);
        let (radius, up) = libm::sincos(PI * down / height as f64);
        let direction = DVec3::new(radius * cos, up, radius * sin);
        let sky = match up {
            up if up < 0.0 => 0.1,
            up => 0.2 + 0.8 * (1.0 - up) * (1.0 - up),
        };
        let in_sun = direction.dot(sun) > libm::cos(0.5f64.to_radians());
        sky + if in_sun { 1e6 } else { 0.0 }
    };
    let texels: Vec<f32> = (0..width * height).map(|i| texel(i) as f32).collect();
    Ok(ImageMap::new(width, height, 1, texels, false)?)
}

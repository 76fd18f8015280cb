//! A fox: fur combed over a body of blended cones, made here and rendered.
//!
//! `cargo run --release -p pelage-render --example fur_ball -- OUT.png [HAIRS] [WIDTH] [SAMPLES]`

#[path = "fox/mod.rs"]
mod fox;

use pelage_render::{Camera, RenderError, Scene, Settings, UpAxis, render};
use std::time::Instant;

fn main() -> Result<(), RenderError> {
    let arguments: Vec<String> = std::env::args().collect();
    let number = |k: usize, default: u32| {
        let given = arguments.get(k).and_then(|a| a.parse().ok());
        given.unwrap_or(default)
    };
    let path = arguments.get(1).map_or("fur_ball.png", String::as_str);
    let (hairs, width, samples) = (number(2, 100_000), number(3, 1280), number(4, 16));

    let start = Instant::now();
    let skin = fox::skin(0.03);
    let strands = fox::fur(hairs);
    println!("{} hairs made in {:.1?}", strands.len(), start.elapsed());

    let start = Instant::now();
    let scene = Scene {
        surface_color: [0.05, 0.035, 0.03],
        ..Scene::of_strands(&strands).on(&skin)
    };
    let settings = Settings {
        width,
        height: width * 9 / 16,
        samples,
        ..Settings::default()
    };
    let aspect = settings.aspect();
    let camera = Camera::portrait(&scene, UpAxis::Y, aspect, 50.0, 10.0);
    let picture = render(&scene, &camera, &settings, |_| ())?;
    println!("rendered in {:.1?}", start.elapsed());
    picture.write_png(path)
}

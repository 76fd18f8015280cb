//! A furry animal made of merged ellipsoids, combed from nose to tail.
//!
//! `cargo run --release -p pelage-render --example fur_ball -- OUT.png [HAIRS] [WIDTH] [SAMPLES]`

fn main() {}

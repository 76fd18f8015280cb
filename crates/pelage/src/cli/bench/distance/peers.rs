//! Roots that keep their distance by other programs, where Python has them.

use super::made;
use crate::cli::bench::methods::even_sampler;
use crate::cli::bench::python::answer;
use crate::cli::bench::surfaces::Surface;
use anyhow::Result;
use pelage::curves::Vec3;
use pelage::surface::quality::{Sample, smallest_distance_ratio};
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// See its first lines.
const SCRIPT: &str = include_str!("peers.py");

/// Roots that programs are asked for.
const ROOTS: u64 = 100_000;

/// First parts of the roots of which the smallest distance is told, in percent.
const PARTS: [usize; 4] = [1, 10, 50, 100];

/// What the table is.
const HEADING: &str = "
### Beside other programs

Roots of even density on the first surface, by what users have in Python, on one core. Open3D
and MeshLab are asked for 100,000 roots, the others for a distance of 0.7 of that in the
densest packing of so many. Columns on the right have the smallest distance among the first
part of the roots as they come. A set that is made whole may keep more of it in the end; then
fewer roots are another set, and none of the first parts keeps its distance.
";

/// What the script is told.
#[derive(Serialize)]
struct Task<'a> {
    positions: Vec<[f32; 3]>,
    triangles: &'a [[u32; 3]],
    area: f64,
    roots: u64,
}

/// What a program made.
#[derive(Deserialize)]
struct Made {
    program: String,
    seconds: f64,
    points: Vec<[f32; 3]>,
}

/// Roots by one program.
#[derive(Clone, Debug)]
pub struct Peer {
    program: String,
    roots: usize,
    /// Millions of roots a second.
    rate: f64,
    /// [`smallest_distance_ratio`] of [`PARTS`].
    ratios: [f64; PARTS.len()],
}

/// Ours on `surface`, and those of the programs that there are.
pub fn measure(surface: &Surface) -> Result<Vec<Peer>> {
    let mesh = &surface.mesh;
    let task = Task {
        positions: mesh.positions().iter().map(Vec3::to_array).collect(),
        triangles: mesh.triangles(),
        area: mesh.surface_area(),
        roots: ROOTS,
    };
    let others: Option<Vec<Made>> = answer(SCRIPT, &task)?;
    let all = std::iter::once(ours(surface)).chain(others.unwrap_or_default());
    Ok(all.map(|made| peer(made, task.area)).collect())
}

fn ours(surface: &Surface) -> Made {
    let mesh = &surface.mesh;
    let (seconds, places) = made(mesh, &even_sampler(mesh, 1), ROOTS);
    let position = |place| mesh.position(place).to_array();
    Made {
        program: "Pelage".into(),
        seconds,
        points: places.iter().map(position).collect(),
    }
}

fn peer(made: Made, area: f64) -> Peer {
    // The surface has no two sides near each other, so all that are near are neighbours.
    let sample = |&point| Sample {
        position: Vec3::from_array(point),
        normal: Vec3::Z,
        density: 1.0,
    };
    let samples: Vec<Sample> = made.points.iter().map(sample).collect();
    let roots = samples.len();
    Peer {
        program: made.program,
        roots,
        rate: roots as f64 / 1e6 / made.seconds,
        ratios: PARTS.map(|part| smallest_distance_ratio(&samples[..roots * part / 100], area)),
    }
}

/// Writes the table below its heading.
pub fn write_table(peers: &[Peer], text: &mut String) -> std::fmt::Result {
    writeln!(text, "{HEADING}")?;
    let parts = PARTS.map(|part| format!("{part} %")).join(" | ");
    writeln!(text, "| program | roots | M roots/s | {parts} |")?;
    writeln!(text, "|---|---|---|{}", "---|".repeat(PARTS.len()))?;
    for peer in peers {
        let Peer {
            program,
            roots,
            rate,
            ratios,
        } = peer;
        let ratios = ratios.map(|r| format!("{r:.2}")).join(" | ");
        writeln!(text, "| {program} | {roots} | {rate:.3} | {ratios} |")?;
    }
    if peers.len() == 1 {
        writeln!(
            text,
            "\nNot compared with others: set PELAGE_PYTHON to a Python that has bpy, open3d, \
            pymeshlab, libigl or vtk."
        )?;
    }
    Ok(())
}

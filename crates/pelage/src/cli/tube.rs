//! `pelage tube`: curves swept to solid meshes, for branches, cables, braids and printing.

use super::args::{CapKind, FramingKind, TubeArgs};
use super::curves;
use super::progress::Bar;
use super::say::{Say, grouped, spent};
use anyhow::{Context, Result, anyhow, bail};
use pelage::StrandBuffer;
use pelage::curves::frenet::CatmullRom;
use pelage::curves::tube::{Caps, Rings, Section, Tube, TubeMesh};
use pelage::curves::{DVec3, Framing, Vec3};
use pelage::io::{Triangles, write_mesh};
use std::process::ExitCode;
use std::time::Instant;

/// Most rings of a tube.
const MOST_RINGS: usize = 100_000;

/// Sides for each ring of a round cap, which is a quarter of a turn: as fine as the sides.
const SIDES_A_CAP_RING: usize = 4;

/// Sweeps every curve of a file and writes all tubes as one mesh.
pub fn run(args: &TubeArgs, say: &Say) -> Result<ExitCode> {
    let started = Instant::now();
    let (strands, _) = curves::read(&args.file, args.frame)?;
    if strands.is_empty() {
        bail!("{}: there are no curves in it", args.file.display());
    }
    if strands.widths.is_empty() && args.radius.is_none() {
        bail!(
            "{}: its curves have no widths: say how thick with --radius",
            args.file.display()
        );
    }
    let section = Section::circle(args.sides as usize)?;
    let bar = Bar::new(say, strands.len() as u64, "tubes");
    let mut all = TubeMesh::default();
    for strand in 0..strands.len() {
        let swept = sweep(&strands, strand, &section, args);
        append(&mut all, swept.with_context(|| format!("curve {strand}"))?)?;
        bar.set(strand as u64 + 1);
    }
    drop(bar);
    write_mesh(
        &args.output,
        &Triangles {
            positions: &all.positions,
            normals: &all.normals,
            uvs: &all.uvs,
            triangles: &all.triangles,
        },
    )?;
    say.line(format_args!(
        "{}: {} tubes, {} triangles ({})",
        args.output.display(),
        grouped(strands.len() as u64),
        grouped(all.triangles.len() as u64),
        spent(started.elapsed())
    ));
    Ok(ExitCode::SUCCESS)
}

fn sweep(
    strands: &StrandBuffer,
    strand: usize,
    section: &Section,
    args: &TubeArgs,
) -> Result<TubeMesh> {
    let points: Vec<DVec3> = strands
        .strand_points(strand)
        .iter()
        .map(|point| point.as_dvec3())
        .collect();
    let tube = Tube {
        framing: match args.framing {
            FramingKind::DoubleReflection => Framing::DoubleReflection,
            FramingKind::Propagated => Framing::Propagated,
            FramingKind::Frenet => Framing::Frenet,
            FramingKind::UpAxis => Framing::UpAxis(DVec3::Y),
        },
        rings: Rings::Bends {
            angle: (args.detail as f64).to_radians(),
            most: MOST_RINGS,
        },
        caps: match args.caps {
            CapKind::Open => Caps::Open,
            CapKind::Flat => Caps::Flat,
            CapKind::Round => Caps::Round((args.sides as usize).div_ceil(SIDES_A_CAP_RING)),
        },
        ..Tube::default()
    };
    let radii = Radii::new(strands, strand, args);
    let curve = CatmullRom::new(&points)?;
    Ok(tube.sweep(&curve, section, |t| radii.at(t))?)
}

/// Radius along a curve.
enum Radii {
    /// At root and tip.
    Ends([f64; 2]),
    /// At the vertices, whose places are fractions of the length.
    Vertices(Vec<(f64, f64)>),
}

impl Radii {
    fn new(strands: &StrandBuffer, strand: usize, args: &TubeArgs) -> Self {
        if let Some(root) = args.radius {
            let tip = args.tip_radius.unwrap_or(root);
            return Self::Ends([root, tip].map(f64::from));
        }
        let points = strands.strand_points(strand);
        let mut length = 0.0;
        let mut before = points.first().copied().unwrap_or(Vec3::ZERO);
        let places = points.iter().map(|&point| {
            length += point.distance(before) as f64;
            before = point;
            length
        });
        let places: Vec<f64> = places.collect();
        let widths = &strands.widths[strands.vertices(strand)];
        let whole = length.max(f64::MIN_POSITIVE);
        let vertices = places.iter().zip(widths);
        Self::Vertices(
            vertices
                .map(|(place, &width)| (place / whole, (width as f64 / 2.0).max(0.0)))
                .collect(),
        )
    }

    fn at(&self, t: f64) -> f64 {
        let line = |[from, to]: [f64; 2], t: f64| from + (to - from) * t;
        match self {
            Self::Ends(ends) => line(*ends, t),
            Self::Vertices(all) => {
                let next = all.partition_point(|(place, _)| *place <= t);
                match (all[..next].last(), all.get(next)) {
                    (Some((a, from)), Some((b, to))) => line([*from, *to], (t - a) / (b - a)),
                    (Some((_, radius)), None) | (None, Some((_, radius))) => *radius,
                    (None, None) => 0.0,
                }
            }
        }
    }
}

fn append(all: &mut TubeMesh, more: TubeMesh) -> Result<()> {
    let first = u32::try_from(all.positions.len());
    let fits = all.positions.len() + more.positions.len() <= u32::MAX as usize;
    let first = first.ok().filter(|_| fits).ok_or_else(|| {
        anyhow!("the mesh has more vertices than 32 bits count: take fewer curves or sides")
    })?;
    all.positions.extend(more.positions);
    all.normals.extend(more.normals);
    all.uvs.extend(more.uvs);
    let corners = more.triangles.iter();
    all.triangles
        .extend(corners.map(|triangle| triangle.map(|corner| first + corner)));
    Ok(())
}

//! Branches as curves with widths, and as the mesh swept along them.

use super::branches::{Branch, LEVELS};
use pelage_curves::Chain;
use pelage_curves::tube::{Caps, Rings, Section, Tube, TubeMesh};
use pelage_strands::{StrandBuffer, StrandMeta};
use pelage_surface::PolygonMesh;

/// Sides of the branches of each level.
const SIDES: [usize; LEVELS] = [20, 10, 7, 5];

/// Bend from ring to ring, in radians.
const DETAIL: f64 = 0.15;

/// Most rings of a branch.
const MOST_RINGS: usize = 1000;

/// Part of a level's place in the map that is left free, so that levels do not run together.
const EDGE: f32 = 0.06;

/// A strand for each branch.
pub fn curves(branches: &[Branch]) -> StrandBuffer {
    let mut out = StrandBuffer::new();
    for branch in branches {
        for (point, radius) in branch.points.iter().zip(&branch.radii) {
            out.points.push(point.as_vec3().to_array());
            out.widths.push(2.0 * *radius as f32);
        }
        out.push_meta(&StrandMeta::default());
    }
    out
}

/// All branches as one mesh. Across, texture coordinates have a part for each level.
pub fn mesh(branches: &[Branch]) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for branch in branches {
        let tube = tube(branch);
        let first = mesh.positions.len() as u32;
        mesh.positions
            .extend(tube.positions.iter().map(|p| p.to_array()));
        for corner in tube.triangles.iter().flatten() {
            let i = *corner as usize;
            mesh.corner_vertices.push(first + corner);
            mesh.corner_normals.push(tube.normals[i].to_array());
            let [u, v] = tube.uvs[i].to_array();
            let across = (branch.level as f32 + u.clamp(EDGE, 1.0 - EDGE)) / LEVELS as f32;
            mesh.corner_uvs.push([across, v.clamp(0.0, 1.0)]);
        }
        mesh.face_sizes.extend(tube.triangles.iter().map(|_| 3));
    }
    mesh
}

fn tube(branch: &Branch) -> TubeMesh {
    let sweep = || {
        let section = Section::circle(SIDES[branch.level])?;
        let curve = Chain::catmull_rom(&branch.points, 0.5)?;
        let tube = Tube {
            rings: Rings::Bends {
                angle: DETAIL,
                most: MOST_RINGS,
            },
            // The trunk stands on the ground.
            caps: if branch.level == 0 {
                Caps::Flat
            } else {
                Caps::Round(2)
            },
            ..Tube::default()
        };
        let last = branch.radii.len() - 1;
        let radius = |t: f64| {
            let place = t * last as f64;
            let at = (place as usize).min(last - 1);
            let (a, b) = (branch.radii[at], branch.radii[at + 1]);
            a + (b - a) * (place - at as f64)
        };
        Ok::<_, Box<dyn std::error::Error>>(tube.sweep(&curve, &section, radius)?)
    };
    // Branches have steps of some length and radii above 0.
    sweep().unwrap_or_else(|e| unreachable!("a branch is a tube: {e}"))
}

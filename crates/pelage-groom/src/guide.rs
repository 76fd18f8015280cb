//! Guides: bound to the surface at rest, kept in the local frame of their root.

use crate::PlanError;
use pelage_curves::{Basis, Curve, Vec3, Wrap};
use pelage_surface::{ClosestPoint, Mesh, RootFrame, SurfacePoint};
use rayon::prelude::*;

/// A guide on the surface at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    /// Where it grows.
    pub root: SurfacePoint,
    /// Position and frame of the root at rest.
    pub frame: RootFrame,
    /// Vertices in the root's local frame (tangent, binormal, normal); the first is
    /// the origin.
    pub local: Vec<Vec3>,
}

impl Guide {
    /// A guide at `root` whose vertices, relative to its root, are `offsets` in the
    /// space of `mesh` at rest.
    pub fn new(mesh: &Mesh, root: SurfacePoint, offsets: &[Vec3]) -> Self {
        let frame = mesh.frame(&root);
        Self {
            root,
            frame,
            local: offsets.iter().map(|&o| frame.local(o)).collect(),
        }
    }

    /// The guide that `curve` is at `root`: its vertices seen from the first.
    pub(crate) fn of_curve(mesh: &Mesh, root: SurfacePoint, curve: &[Vec3]) -> Self {
        let first = curve.first().copied().unwrap_or_default();
        let offsets: Vec<Vec3> = curve.iter().map(|&p| p - first).collect();
        Self::new(mesh, root, &offsets)
    }

    /// The same guide with `segments + 1` vertices at equal steps of arc length along
    /// the Catmull-Rom curve through its vertices.
    pub fn resampled(&self, segments: usize) -> Self {
        let local = match Curve::new(&self.local, Basis::CatmullRom, Wrap::Pinned) {
            Ok(curve) => curve.resample(segments),
            Err(_) => vec![Vec3::ZERO; segments + 1],
        };
        Self {
            local,
            ..self.clone()
        }
    }

    /// Unit vector in the space of the mesh at rest along which the guide leaves its
    /// root, its vertices as they came: the tangent of the Catmull-Rom curve with doubled
    /// ends. The normal for a guide without length.
    pub fn direction(&self) -> Vec3 {
        let next = self.local.iter().find(|&&v| v != Vec3::ZERO);
        next.and_then(|&v| self.frame.vector(v).try_normalize())
            .unwrap_or(self.frame.normal)
    }

    /// Length of the polygon through the vertices.
    pub fn length(&self) -> f32 {
        self.local.windows(2).map(|w| w[0].distance(w[1])).sum()
    }
}

/// A guide that lies off the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FarGuide {
    /// Its index in the file.
    pub index: usize,
    /// Distance of its first vertex from the surface.
    pub distance: f32,
}

/// Binds curves (vertices in the space of `mesh` at rest, root first) to the places of
/// `mesh` nearest to their first vertex. A guide farther away than `tolerance` is an
/// error that lists them all; so is one without two different vertices.
pub fn bind(mesh: &Mesh, curves: &[Vec<Vec3>], tolerance: f32) -> Result<Vec<Guide>, PlanError> {
    let closest = ClosestPoint::new(mesh);
    let bound: Vec<_> = curves
        .par_iter()
        .enumerate()
        .map(|(index, curve)| bind_one(mesh, &closest, index, curve))
        .collect::<Result<_, _>>()?;
    let far: Vec<FarGuide> = bound
        .iter()
        .enumerate()
        .filter(|(_, (_, distance))| *distance > tolerance)
        .map(|(index, &(_, distance))| FarGuide { index, distance })
        .collect();
    if far.is_empty() {
        Ok(bound.into_iter().map(|(guide, _)| guide).collect())
    } else {
        Err(PlanError::FarGuides { far, tolerance })
    }
}

fn bind_one(
    mesh: &Mesh,
    closest: &ClosestPoint,
    index: usize,
    curve: &[Vec3],
) -> Result<(Guide, f32), PlanError> {
    refuse_far(index, curve)?;
    let Some(&first) = curve.first() else {
        return Err(PlanError::GuideTooShort { index });
    };
    if curve.iter().all(|&p| p == first) {
        return Err(PlanError::GuideTooShort { index });
    }
    let (root, distance) = closest.query(first).ok_or(PlanError::NoSurface)?;
    Ok((Guide::of_curve(mesh, root, curve), distance))
}

/// Refuses guide number `index` if a vertex of it is not finite or too far away.
pub(crate) fn refuse_far(index: usize, curve: &[Vec3]) -> Result<(), PlanError> {
    let far = |p: &Vec3| !p.is_finite() || p.abs().max_element() > Mesh::FARTHEST;
    match curve.iter().position(far) {
        Some(vertex) => Err(PlanError::GuideNotFinite { index, vertex }),
        None => Ok(()),
    }
}

//! From a prim's own space to world space: the `xformOp`s of it and its parents.
//!
//! Source: OpenUSD `pxr/usd/usdGeom/xformable.h`. USD multiplies row vectors, so
//! its first operation is the outermost; columns here make that a plain product.

use super::names;
use super::stage::Scene;
use crate::ReadError;
use glam::{DMat3, DMat4, DQuat, DVec3};
use openusd::sdf;
use sdf::Value;

impl Scene {
    /// World space from the space of the prim at `path`, at `time`.
    pub(super) fn world_from(
        &self,
        path: &sdf::Path,
        time: Option<f64>,
    ) -> Result<DMat4, ReadError> {
        let mut world = DMat4::IDENTITY;
        let mut next = Some(path.clone());
        while let Some(prim) = next.filter(|p| !p.is_abs_root() && !p.is_empty()) {
            let (local, resets) = self.parent_from(&prim, time)?;
            world = local * world;
            next = if resets { None } else { prim.parent() };
        }
        Ok(world)
    }

    /// The parent's space from the prim's own, and whether the prim leaves the
    /// parents' transforms behind.
    fn parent_from(&self, prim: &sdf::Path, time: Option<f64>) -> Result<(DMat4, bool), ReadError> {
        let order = self.value(prim, "xformOpOrder", time)?;
        let Some(order) = order.and_then(|v| v.try_as_token_vec()) else {
            return Ok((DMat4::IDENTITY, false));
        };
        let (mut matrix, mut resets) = (DMat4::IDENTITY, false);
        for entry in &order {
            if entry.as_str() == "!resetXformStack!" {
                (matrix, resets) = (DMat4::IDENTITY, true);
                continue;
            }
            let (name, inverted) = match entry.as_str().strip_prefix("!invert!") {
                Some(name) => (name, true),
                None => (entry.as_str(), false),
            };
            if !names::is_property(name) {
                let message = format!("no property can have the name {name:?}");
                return Err(self.error(format!("{prim}.xformOpOrder"), message));
            }
            let Some(value) = self.value(prim, name, time)? else {
                let message = "xformOpOrder names it, but it has no value";
                return Err(self.error(format!("{prim}.{name}"), message));
            };
            let operation = operation(name, value).ok_or_else(|| {
                let message = "it is no transform that OpenUSD knows by this name and type";
                self.error(format!("{prim}.{name}"), message)
            })?;
            matrix *= if inverted {
                operation.inverse()
            } else {
                operation
            };
        }
        Ok((matrix, resets))
    }
}

/// The matrix of `xformOp:KIND` or `xformOp:KIND:SUFFIX`; `None` where kind and
/// type of value do not go together.
fn operation(name: &str, value: Value) -> Option<DMat4> {
    let kind = name.strip_prefix("xformOp:")?;
    let kind = kind.split(':').next().unwrap_or(kind);
    let along = |axis: char| match axis {
        'X' => Some(DVec3::X),
        'Y' => Some(DVec3::Y),
        'Z' => Some(DVec3::Z),
        _ => None,
    };
    if let Some(axis) = kind.strip_prefix("translate").and_then(single) {
        return Some(DMat4::from_translation(along(axis)? * number(&value)?));
    }
    if let Some(axis) = kind.strip_prefix("scale").and_then(single) {
        let axis = along(axis)?;
        return Some(DMat4::from_scale(
            DVec3::ONE + axis * (number(&value)? - 1.0),
        ));
    }
    match kind {
        "translate" => Some(DMat4::from_translation(vector(&value)?)),
        "scale" => Some(DMat4::from_scale(vector(&value)?)),
        "orient" => Some(DMat4::from_quat(quaternion(&value)?)),
        // USD's rows are glam's columns, so that the text order is the right one.
        "transform" => match value {
            Value::Matrix4d(m) => Some(DMat4::from_cols_array(&m.0)),
            _ => None,
        },
        _ => {
            let axes: Vec<char> = kind.strip_prefix("rotate")?.chars().collect();
            let angles = match (axes.len(), along(*axes.first()?)) {
                (1, Some(axis)) => axis * number(&value)?,
                (3, _) => vector(&value)?,
                _ => return None,
            };
            // The axis named first turns first.
            axes.iter().try_fold(DMat4::IDENTITY, |turned, &name| {
                let axis = along(name)?;
                Some(turn(axis, angles.dot(axis)) * turned)
            })
        }
    }
}

/// The turn about `axis` by an angle in degrees. glam's takes its sine from the
/// platform, whose last bit differs from machine to machine.
fn turn(axis: DVec3, angle: f64) -> DMat4 {
    let (sin, cos) = libm::sincos(angle.to_radians());
    let turned = |v: DVec3| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
    DMat4::from_mat3(DMat3::from_cols(
        turned(DVec3::X),
        turned(DVec3::Y),
        turned(DVec3::Z),
    ))
}

fn single(text: &str) -> Option<char> {
    let mut chars = text.chars();
    chars.next().filter(|_| chars.next().is_none())
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Double(x) => Some(*x),
        Value::Float(x) => Some(*x as f64),
        Value::Half(x) => Some((*x).into()),
        _ => None,
    }
}

fn vector(value: &Value) -> Option<DVec3> {
    match value {
        Value::Vec3d(v) => Some(DVec3::new(v.x, v.y, v.z)),
        Value::Vec3f(v) => Some(DVec3::new(v.x as f64, v.y as f64, v.z as f64)),
        Value::Vec3h(v) => Some(DVec3::new(v.x.into(), v.y.into(), v.z.into())),
        _ => None,
    }
}

fn quaternion(value: &Value) -> Option<DQuat> {
    let q = match value {
        Value::Quatd(q) => DQuat::from_xyzw(q.x, q.y, q.z, q.w),
        Value::Quatf(q) => DQuat::from_xyzw(q.x as f64, q.y as f64, q.z as f64, q.w as f64),
        Value::Quath(q) => DQuat::from_xyzw(q.x.into(), q.y.into(), q.z.into(), q.w.into()),
        _ => return None,
    };
    // A zero quaternion, which OpenUSD takes for no rotation.
    Some(match q.length_squared() > 0.0 {
        true => q.normalize(),
        false => DQuat::IDENTITY,
    })
}

/// Moves points by `matrix`.
pub(super) fn transform_points(points: &mut [[f32; 3]], matrix: &DMat4) {
    if *matrix == DMat4::IDENTITY {
        return;
    }
    for point in points {
        let moved = matrix.transform_point3(glam::Vec3::from(*point).as_dvec3());
        *point = moved.as_vec3().to_array();
    }
}

/// Turns normals as `matrix` turns the surface, to unit length.
pub(super) fn transform_normals(normals: &mut [[f32; 3]], matrix: &DMat4) {
    if *matrix == DMat4::IDENTITY {
        return;
    }
    let turn = matrix.inverse().transpose();
    for normal in normals {
        let turned = turn.transform_vector3(glam::Vec3::from(*normal).as_dvec3());
        *normal = turned.normalize_or_zero().as_vec3().to_array();
    }
}

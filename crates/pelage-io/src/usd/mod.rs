//! Reads USD: `.usda`, `.usdc`, `.usd` of either kind, and packages of them (`.usdz`).
//!
//! The stage is composed (sublayers, references, payloads, variants, instances)
//! by the crate `openusd`; files are checked before it sees them. Everything is
//! brought to world space. Prims of purpose `guide` and `proxy`, inactive and
//! abstract ones and the prototypes of point instancers are left out; invisible
//! ones are not.

mod arcs;
mod clips;
mod crate_guard;
mod crate_values;
mod cursor;
mod curves;
mod kind;
mod mesh;
mod names;
mod package;
mod resolver;
mod stage;
mod super_helices;
mod text_guard;
mod text_tokens;
mod text_tuples;
mod values;
mod xform;

pub(crate) use curves::{CurvesWithExtent, Extent, read_curves_with_extents};
pub(crate) use super_helices::read_super_helices;

use crate::{CurveFile, MeshFile, ReadError};
use openusd::sdf;
use stage::{Scene, with_scene};
use std::path::Path;

/// Items of a list that layers add to and take from; they are compared one by one.
const MAX_ITEMS: u32 = 4096;

/// Reads the meshes of `path` at `time`: those at or below the prim `prim`
/// (a path like `/World/body`), or all.
///
/// Without a time, the default values count, then the first samples. Between
/// samples points are interpolated, before the first and after the last they
/// hold. Fails where there is no mesh, an array does not fit the faces, or a
/// file that the stage refers to cannot be read.
pub fn read_usd_mesh(
    path: &Path,
    prim: Option<&str>,
    time: Option<f64>,
) -> Result<MeshFile, ReadError> {
    with_scene(path, |scene| {
        let prims = meshes(scene, prim)?;
        let metadata = scene.metadata()?;
        Ok(MeshFile {
            mesh: mesh::read(scene, &prims, time)?,
            up_axis: metadata.up_axis,
            meters_per_unit: metadata.meters_per_unit,
        })
    })
}

/// Times at which the meshes of `path` (see [`read_usd_mesh`]) are sampled,
/// ascending: samples of points and of the transforms above. Empty for a still.
pub fn usd_mesh_frames(path: &Path, prim: Option<&str>) -> Result<Vec<f64>, ReadError> {
    with_scene(path, |scene| frames(scene, &meshes(scene, prim)?))
}

/// Reads every `BasisCurves` prim of `path` at `time`, as [`read_usd_mesh`] does.
///
/// Attributes whose counts or types do not fit are left out and listed in
/// [`CurveSet::faults`](crate::CurveSet::faults); curves for which points are
/// missing are left out as well. A file without curves gives no set.
pub fn read_usd_curves(path: &Path, time: Option<f64>) -> Result<CurveFile, ReadError> {
    Ok(read_curves_with_extents(path, time)?.file)
}

/// Paths of the meshes at or below `prim`.
fn meshes(scene: &Scene, prim: Option<&str>) -> Result<Vec<sdf::Path>, ReadError> {
    let all = scene.prims("Mesh")?;
    if all.is_empty() {
        return Err(ReadError::file(&scene.path, "it has no Mesh prim"));
    }
    let Some(prim) = prim else { return Ok(all) };
    let wanted = prim.trim_end_matches('/');
    let below = |path: &&sdf::Path| {
        let rest = path.as_str().strip_prefix(wanted);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('/'))
    };
    let chosen: Vec<sdf::Path> = all.iter().filter(below).cloned().collect();
    if chosen.is_empty() {
        let names: Vec<&str> = all.iter().take(10).map(|p| p.as_str()).collect();
        let more = if all.len() > 10 { ", …" } else { "" };
        return Err(scene
            .error(prim, "there is no mesh at or below this prim")
            .help(format!("the meshes are {}{more}", names.join(", "))));
    }
    Ok(chosen)
}

/// Times at which points of `prims` or transforms above them are sampled.
fn frames(scene: &Scene, prims: &[sdf::Path]) -> Result<Vec<f64>, ReadError> {
    let mut times = Vec::new();
    for prim in prims {
        times.extend(scene.sample_times(prim, "points")?);
        let mut next = Some(prim.clone());
        while let Some(above) = next.filter(|p| !p.is_abs_root() && !p.is_empty()) {
            let order = scene.value(&above, "xformOpOrder", None)?;
            let order = order.and_then(|v| v.try_as_token_vec());
            for name in order.unwrap_or_default() {
                let name = name.as_str().trim_start_matches("!invert!").to_owned();
                if name.starts_with("xformOp:") && names::is_property(&name) {
                    times.extend(scene.sample_times(&above, &name)?);
                }
            }
            next = above.parent();
        }
    }
    times.retain(|t| t.is_finite());
    times.sort_by(f64::total_cmp);
    times.dedup();
    Ok(times)
}

//! Writing roots by themselves, as strands of one vertex.

use crate::RootPlan;
use crate::generate::{GenerateError, Request};
use crate::in_order::in_order;
use crate::order::Parts;
use pelage_strands::{Sink, StrandBuffer};
use pelage_surface::{Mesh, SurfacePoint};

/// Roots in a chunk, a power of two: drawing them is fastest in large aligned blocks,
/// and a chunk (some 5 MB) should not take much memory.
const CHUNK: u64 = 1 << 16;

/// Writes the roots of the hairs of `request` into `sink`, as one frame on `pose` (the
/// rest pose where it is `None`), and gives their number.
///
/// Roots are strands of one vertex: `points` on the posed surface, displaced as the recipe
/// says, `normals` of that surface, and what else strands tell of their roots. `progress`
/// is called as by [`generate`](crate::generate).
pub fn write_roots(
    plan: &RootPlan,
    request: &Request,
    pose: Option<&Mesh>,
    sink: &mut dyn Sink,
    progress: &mut dyn FnMut(u64) -> bool,
) -> Result<u64, GenerateError> {
    let parts = Parts::new(plan, request, sink, CHUNK)?;
    sink.begin(&request.info)?;
    sink.begin_frame(0)?;
    let mut done = 0;
    in_order(
        parts.count(),
        request.threads,
        |places: &mut Vec<SurfacePoint>, number, out: &mut StrandBuffer| {
            out.clear();
            places.clear();
            parts.list(plan, number, &mut out.hair_id, places);
            write(plan, places, pose, out);
        },
        |_, chunk: &StrandBuffer| {
            sink.write(chunk)?;
            done += chunk.len() as u64;
            match progress(done) {
                true => Ok(()),
                false => Err(GenerateError::Stopped),
            }
        },
    )?;
    sink.end_frame()?;
    sink.finish()?;
    Ok(done)
}

/// Writes the roots at `places` into `out`, which has their hairs and nothing else.
fn write(plan: &RootPlan, places: &[SurfacePoint], pose: Option<&Mesh>, out: &mut StrandBuffer) {
    let rest = &plan.rest;
    let surface = pose.unwrap_or(rest);
    // Array by array: neighbours in `places` may lie far apart on the surface, and so
    // only one array of the mesh at a time competes for the cache.
    out.offsets.extend(1..=places.len() as u32);
    let uv = |place| rest.uv(place).to_array();
    out.root_uv.extend(places.iter().map(uv));
    let group = |&uv: &[f32; 2]| plan.groups.at(uv.into());
    out.group.extend(out.root_uv.iter().map(group));
    out.triangle.extend(places.iter().map(|p| p.triangle));
    out.barycentric.extend(places.iter().map(|p| p.barycentric));
    let at_rest = |place| rest.position(place).to_array();
    out.root_rest.extend(places.iter().map(at_rest));
    if plan.is_displaced() {
        for (place, &uv) in places.iter().zip(&out.root_uv) {
            let frame = plan.frame(surface, place, uv.into());
            out.points.push(frame.position.to_array());
            out.normals.push(frame.normal.to_array());
        }
    } else {
        let point = |place| surface.position(place).to_array();
        out.points.extend(places.iter().map(point));
        let normal = |place| surface.normal(place).to_array();
        out.normals.extend(places.iter().map(normal));
    }
}

//! Lifting off what lies twofold.
//!
//! A flattened chart may still cover a few texels twice, in a crotch or an armpit.
//! The triangles that lie on top are lifted off, with those around them, and
//! become charts of their own.

use crate::charts::Chart;
use crate::raster::canvas;
use glam::DVec2;

/// Texels a side in which overlaps are sought, over the chart's own box: about as
/// many a triangle in small charts as in a large one.
fn texels(chart: &Chart) -> usize {
    let side = 15.0 * (chart.triangles.len() as f64).sqrt();
    (side as usize).clamp(128, 2048)
}

/// Splits `chart` into what stays (with the coordinates it has) and the pieces
/// lifted off it.
pub fn lift_overlaps(chart: &Chart, uv: &[DVec2]) -> Option<(Chart, Vec<DVec2>, Vec<Chart>)> {
    let low = uv.iter().copied().fold(DVec2::MAX, DVec2::min);
    let high = uv.iter().copied().fold(DVec2::MIN, DVec2::max);
    let scale = 1.0 / (high - low).max_element();
    let corners: Vec<[DVec2; 3]> = (chart.corners.iter())
        .map(|c| c.map(|v| (uv[v as usize] - low) * scale))
        .collect();
    let overlapping = canvas(&corners, texels(chart)).overlapping;
    if overlapping.is_empty() {
        return None;
    }
    // Whatever shares a vertex with a triangle on top goes with it.
    let mut lifted_vertex = vec![false; chart.vertices.len()];
    for [top, _] in overlapping {
        for v in chart.corners[top as usize] {
            lifted_vertex[v as usize] = true;
        }
    }
    let lifted: Vec<bool> = (chart.corners.iter())
        .map(|c| c.iter().any(|&v| lifted_vertex[v as usize]))
        .collect();
    let piece = pieces(chart, &lifted);
    let count = piece.iter().copied().max().map_or(0, |p| p + 1);
    let (kept, vertices) = part(chart, |t| piece[t] == 0);
    let kept_uv = vertices.iter().map(|&v| uv[v as usize]).collect();
    let pieces = (1..count)
        .map(|p| part(chart, |t| piece[t] == p).0)
        .collect();
    Some((kept, kept_uv, pieces))
}

impl Chart {
    /// The chart's triangles in two charts.
    pub fn halves(&self) -> [Chart; 2] {
        let middle = self.triangles.len() / 2;
        [part(self, |t| t < middle).0, part(self, |t| t >= middle).0]
    }
}

/// 0 for triangles that stay, from 1 on for each connected piece that is lifted.
fn pieces(chart: &Chart, lifted: &[bool]) -> Vec<usize> {
    let mut around = vec![Vec::new(); chart.vertices.len()];
    for (t, corners) in chart.corners.iter().enumerate() {
        corners.iter().for_each(|&v| around[v as usize].push(t));
    }
    let mut piece = vec![0; lifted.len()];
    let mut count = 0;
    for start in 0..lifted.len() {
        if !lifted[start] || piece[start] != 0 {
            continue;
        }
        count += 1;
        piece[start] = count;
        let mut stack = vec![start];
        while let Some(t) = stack.pop() {
            for &n in chart.corners[t].iter().flat_map(|&v| &around[v as usize]) {
                if lifted[n] && piece[n] == 0 {
                    piece[n] = count;
                    stack.push(n);
                }
            }
        }
    }
    piece
}

/// The triangles for which `wanted` holds, as a chart, and the old chart vertex of
/// each of its vertices.
fn part(chart: &Chart, wanted: impl Fn(usize) -> bool) -> (Chart, Vec<u32>) {
    let mut out = Chart {
        label: chart.label,
        ..Default::default()
    };
    let mut fresh = vec![u32::MAX; chart.vertices.len()];
    let mut old = Vec::new();
    for t in (0..chart.triangles.len()).filter(|&t| wanted(t)) {
        out.triangles.push(chart.triangles[t]);
        out.corners.push(chart.corners[t].map(|v| {
            let slot = &mut fresh[v as usize];
            if *slot == u32::MAX {
                *slot = old.len() as u32;
                old.push(v);
                out.vertices.push(chart.vertices[v as usize]);
            }
            *slot
        }));
    }
    (out, old)
}

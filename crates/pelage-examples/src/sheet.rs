//! The sheet that is flattened: a chart's vertices and triangles, its holes
//! spanned by membranes.
//!
//! Without them a hole on a dome (where an ear was cut off) would close up when
//! flattened and its rim would overlap itself.

use crate::charts::Chart;
use glam::DVec3;
use std::collections::BTreeMap;

/// A triangle mesh with a border.
#[derive(Clone, Debug, Default)]
pub struct Sheet {
    /// Positions: the chart's vertices, then one a hole.
    pub points: Vec<DVec3>,
    /// Triangles: the chart's, then the membranes'.
    pub corners: Vec<[u32; 3]>,
}

impl Sheet {
    /// The sheet of `chart`; every closed border but the longest gets a fan of
    /// triangles around its mean.
    pub fn new(chart: &Chart, positions: &[DVec3]) -> Self {
        let mut out = Self {
            points: (chart.vertices.iter())
                .map(|&v| positions[v as usize])
                .collect(),
            corners: chart.corners.clone(),
        };
        let mut rims = rims(&chart.corners);
        let length = |rim: &Vec<u32>| -> f64 {
            let p = |k: usize| out.points[rim[k % rim.len()] as usize];
            (0..rim.len()).map(|k| p(k).distance(p(k + 1))).sum()
        };
        rims.sort_by(|a, b| length(b).total_cmp(&length(a)));
        for rim in rims.iter().skip(1) {
            let sum: DVec3 = rim.iter().map(|&v| out.points[v as usize]).sum();
            let middle = out.points.len() as u32;
            out.points.push(sum / rim.len() as f64);
            for k in 0..rim.len() {
                let next = rim[(k + 1) % rim.len()];
                out.corners.push([next, rim[k], middle]);
            }
        }
        out
    }
}

/// The closed borders, each as its vertices in the triangles' sense.
fn rims(corners: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let mut inner = std::collections::HashSet::new();
    for c in corners {
        for k in 0..3 {
            inner.insert((c[k], c[(k + 1) % 3]));
        }
    }
    // Ordered, so that the walk does not depend on a hash map.
    let mut next: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for c in corners {
        for k in 0..3 {
            let (a, b) = (c[k], c[(k + 1) % 3]);
            if !inner.contains(&(b, a)) {
                next.entry(a).or_default().push(b);
            }
        }
    }
    let mut out = Vec::new();
    while let Some((&start, _)) = next.iter().next() {
        let mut rim = Vec::new();
        let mut at = start;
        while let Some(ways) = next.get_mut(&at) {
            let Some(to) = ways.pop() else { break };
            if ways.is_empty() {
                next.remove(&at);
            }
            rim.push(at);
            at = to;
        }
        out.push(rim);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_hole_in_a_frame_is_spanned_and_its_border_is_not() {
        // A square ring: outer vertices 0..4, inner 4..8.
        let mut chart = Chart {
            vertices: (0..8).collect(),
            ..Default::default()
        };
        let mut points = Vec::new();
        for r in [2.0, 1.0] {
            for (x, y) in [(-r, -r), (r, -r), (r, r), (-r, r)] {
                points.push(DVec3::new(x, y, 0.0));
            }
        }
        for k in 0..4 {
            let n = (k + 1) % 4;
            chart.corners.push([k, n, 4 + n]);
            chart.corners.push([k, 4 + n, 4 + k]);
        }
        let sheet = Sheet::new(&chart, &points);
        assert_eq!(sheet.points.len(), 9);
        assert_eq!(sheet.corners.len(), 12);
        let area = |c: &[u32; 3]| {
            let p = c.map(|v| sheet.points[v as usize]);
            (p[1] - p[0]).cross(p[2] - p[0]).z
        };
        assert!(sheet.corners.iter().all(|c| area(c) > 0.0));
    }
}

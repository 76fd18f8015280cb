//! Charts into the unit square: largest first, each at the lowest free place,
//! by the cells they cover rather than by their boxes, so that small charts find
//! room in the bays of a large one.

use crate::charts::Chart;
use glam::DVec2;

/// Cells a side of the grid in which places are sought.
const CELLS: usize = 192;

/// One bit a cell.
struct Cells {
    width: usize,
    height: usize,
    filled: Vec<bool>,
}

/// Moves and scales each chart's coordinates (all by one scale) into 0..1, at
/// least `gutter` (fraction of the square) apart. `uvs` has one entry a chart.
pub fn pack(charts: &[Chart], uvs: &mut [Vec<DVec2>], gutter: f64) {
    let mut order: Vec<usize> = (0..charts.len()).collect();
    for uv in uvs.iter_mut() {
        let low = uv.iter().copied().fold(DVec2::MAX, DVec2::min);
        uv.iter_mut().for_each(|p| *p -= low);
    }
    let area = |k: usize| {
        let high = uvs[k].iter().copied().fold(DVec2::ZERO, DVec2::max);
        high.x * high.y
    };
    let areas: Vec<f64> = order.iter().map(|&k| area(k)).collect();
    order.sort_by(|&a, &b| areas[b].total_cmp(&areas[a]));
    let mut scale = 1.0 / areas.iter().sum::<f64>().sqrt();
    scale *= 1.3;
    loop {
        if let Some(places) = places(charts, uvs, &order, scale, gutter) {
            for (uv, place) in uvs.iter_mut().zip(places) {
                uv.iter_mut().for_each(|p| *p = *p * scale + place);
            }
            return;
        }
        scale *= 0.96;
    }
}

/// Where each chart's lower left corner goes, or `None` if they do not all fit.
fn places(
    charts: &[Chart],
    uvs: &[Vec<DVec2>],
    order: &[usize],
    scale: f64,
    gutter: f64,
) -> Option<Vec<DVec2>> {
    let mut taken = vec![false; CELLS * CELLS];
    let mut places = vec![DVec2::ZERO; charts.len()];
    for &k in order {
        let shape = cells(&charts[k], &uvs[k], scale, gutter);
        let (x, y) = free_place(&taken, &shape)?;
        for row in 0..shape.height {
            for column in 0..shape.width {
                taken[(y + row) * CELLS + x + column] |= shape.filled[row * shape.width + column];
            }
        }
        places[k] = DVec2::new(x as f64, y as f64) / CELLS as f64 + DVec2::splat(gutter * 0.5);
    }
    Some(places)
}

/// The cells a chart covers, with half a gutter around it.
fn cells(chart: &Chart, uv: &[DVec2], scale: f64, gutter: f64) -> Cells {
    let margin = gutter * 0.5;
    let high = uv.iter().copied().fold(DVec2::ZERO, DVec2::max) * scale;
    let size = |x: f64| ((x + gutter) * CELLS as f64) as usize + 1;
    let mut out = Cells {
        width: size(high.x),
        height: size(high.y),
        filled: Vec::new(),
    };
    out.filled = vec![false; out.width * out.height];
    for corners in &chart.corners {
        let p = corners.map(|c| uv[c as usize] * scale);
        let low = p[0].min(p[1]).min(p[2]) * CELLS as f64;
        let top = (p[0].max(p[1]).max(p[2]) + DVec2::splat(2.0 * margin)) * CELLS as f64;
        for y in low.y as usize..=(top.y as usize).min(out.height - 1) {
            for x in low.x as usize..=(top.x as usize).min(out.width - 1) {
                out.filled[y * out.width + x] = true;
            }
        }
    }
    out
}

fn free_place(taken: &[bool], shape: &Cells) -> Option<(usize, usize)> {
    if shape.width > CELLS || shape.height > CELLS {
        return None;
    }
    for y in 0..=CELLS - shape.height {
        for x in 0..=CELLS - shape.width {
            let free = (0..shape.height).all(|row| {
                let own = &shape.filled[row * shape.width..(row + 1) * shape.width];
                let there = &taken[(y + row) * CELLS + x..][..shape.width];
                !own.iter().zip(there).any(|(a, b)| *a && *b)
            });
            if free {
                return Some((x, y));
            }
        }
    }
    None
}

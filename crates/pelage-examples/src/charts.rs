//! Cutting a mesh into charts along seams.

use crate::relax::Triangles;
use std::collections::HashMap;

/// A piece of the mesh that will be flattened in one go.
#[derive(Clone, Debug, Default)]
pub struct Chart {
    /// Triangles of the mesh.
    pub triangles: Vec<u32>,
    /// Chart vertices of each triangle; a mesh vertex on a cut is two of them.
    pub corners: Vec<[u32; 3]>,
    /// Mesh vertex of each chart vertex.
    pub vertices: Vec<u32>,
    /// Label of the chart's first triangle.
    pub label: u8,
}

/// Pieces smaller than this are glued to a neighbour: they are splinters of a
/// jagged cut.
const SPLINTER: usize = 40;

/// For each triangle and each of its edges `k → k + 1`, the triangle beyond.
pub fn across(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut owner = HashMap::with_capacity(triangles.len() * 3);
    for (t, tri) in triangles.iter().enumerate() {
        for k in 0..3 {
            owner.insert((tri[k], tri[(k + 1) % 3]), t as u32);
        }
    }
    triangles
        .iter()
        .map(|tri| {
            [0, 1, 2].map(|k| {
                owner
                    .get(&(tri[(k + 1) % 3], tri[k]))
                    .copied()
                    .unwrap_or(u32::MAX)
            })
        })
        .collect()
}

/// Replaces labels that most neighbours do not share, a few times over.
pub fn smooth_labels(beyond: &[[u32; 3]], labels: &mut [u8], rounds: usize) {
    for _ in 0..rounds {
        let old = labels.to_vec();
        for (t, label) in labels.iter_mut().enumerate() {
            let ring = beyond[t].map(|n| {
                if n == u32::MAX {
                    old[t]
                } else {
                    old[n as usize]
                }
            });
            for k in 0..3 {
                if ring[k] == ring[(k + 1) % 3] {
                    *label = ring[k];
                }
            }
        }
    }
}

/// Charts of triangles with one label, cut further where `cut` says so of two
/// neighbouring triangles.
pub fn cut_into_charts(
    mesh: &Triangles,
    labels: &[u8],
    cut: impl Fn(usize, usize) -> bool,
) -> Vec<Chart> {
    let beyond = across(&mesh.triangles);
    let mut seams: Vec<[bool; 3]> = (0..beyond.len())
        .map(|t| {
            beyond[t].map(|n| {
                let n = n as usize;
                n >= labels.len() || labels[t] != labels[n] || cut(t, n)
            })
        })
        .collect();
    glue_splinters(&beyond, &mut seams);
    let (piece, count) = pieces(&beyond, &seams);
    let corner_of = weld_corners(&mesh.triangles, &beyond, &seams);
    let mut charts = vec![Chart::default(); count];
    let mut local = HashMap::new();
    for (t, tri) in mesh.triangles.iter().enumerate() {
        let chart = &mut charts[piece[t] as usize];
        if chart.triangles.is_empty() {
            chart.label = labels[t];
        }
        let corners = [0, 1, 2].map(|k| {
            *local.entry(corner_of[t * 3 + k]).or_insert_with(|| {
                chart.vertices.push(tri[k]);
                chart.vertices.len() as u32 - 1
            })
        });
        chart.triangles.push(t as u32);
        chart.corners.push(corners);
    }
    charts
}

/// Connected pieces over edges that are no seam: piece of each triangle, count.
fn pieces(beyond: &[[u32; 3]], seams: &[[bool; 3]]) -> (Vec<u32>, usize) {
    let mut piece = vec![u32::MAX; beyond.len()];
    let mut count = 0;
    let mut stack = Vec::new();
    for start in 0..beyond.len() {
        if piece[start] != u32::MAX {
            continue;
        }
        stack.push(start);
        piece[start] = count;
        while let Some(t) = stack.pop() {
            for k in 0..3 {
                let n = beyond[t][k] as usize;
                if !seams[t][k] && piece[n] == u32::MAX {
                    piece[n] = count;
                    stack.push(n);
                }
            }
        }
        count += 1;
    }
    (piece, count as usize)
}

/// Opens the seams between each small piece and the neighbour it touches most.
fn glue_splinters(beyond: &[[u32; 3]], seams: &mut [[bool; 3]]) {
    let (piece, count) = pieces(beyond, seams);
    let mut size = vec![0usize; count];
    piece.iter().for_each(|&p| size[p as usize] += 1);
    let mut touching: HashMap<(u32, u32), usize> = HashMap::new();
    for (t, ring) in beyond.iter().enumerate() {
        for &n in ring.iter().filter(|&&n| n != u32::MAX) {
            if piece[t] != piece[n as usize] && size[piece[t] as usize] < SPLINTER {
                *touching.entry((piece[t], piece[n as usize])).or_default() += 1;
            }
        }
    }
    let mut into: HashMap<u32, (usize, u32)> = HashMap::new();
    for (&(from, to), &length) in &touching {
        let best = into.entry(from).or_default();
        // The order of a hash map must not decide a tie.
        *best = (*best).max((length, to));
    }
    for t in 0..beyond.len() {
        for k in 0..3 {
            let n = beyond[t][k];
            if n == u32::MAX {
                continue;
            }
            let (a, b) = (piece[t], piece[n as usize]);
            let glued = |x, y| into.get(&x).is_some_and(|&(_, to)| to == y);
            if a != b && (glued(a, b) || glued(b, a)) {
                seams[t][k] = false;
            }
        }
    }
}

/// One id for all corners of a vertex that are joined over edges without a seam.
fn weld_corners(triangles: &[[u32; 3]], beyond: &[[u32; 3]], seams: &[[bool; 3]]) -> Vec<u32> {
    let mut parent: Vec<u32> = (0..triangles.len() as u32 * 3).collect();
    fn find(parent: &mut [u32], mut x: u32) -> u32 {
        while parent[x as usize] != x {
            parent[x as usize] = parent[parent[x as usize] as usize];
            x = parent[x as usize];
        }
        x
    }
    for (t, tri) in triangles.iter().enumerate() {
        for k in (0..3).filter(|&k| !seams[t][k]) {
            let n = beyond[t][k] as usize;
            for own in [k, (k + 1) % 3] {
                let Some(other) = (0..3).find(|&c| triangles[n][c] == tri[own]) else {
                    continue;
                };
                let a = find(&mut parent, (t * 3 + own) as u32);
                let b = find(&mut parent, (n * 3 + other) as u32);
                parent[a.max(b) as usize] = a.min(b);
            }
        }
    }
    (0..parent.len() as u32)
        .map(|c| find(&mut parent, c))
        .collect()
}

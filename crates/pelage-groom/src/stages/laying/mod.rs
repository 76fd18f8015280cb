//! Hairs that were put together edge by edge, laid where the mean of their guides lies.
//!
//! Bends and twists say how a hair is shaped, not how it is turned at its root: a curl's first
//! tangent leans off its axis, and means of such tangents lean elsewhere (DESIGN.md, "Why are
//! curls mixed by bends and twists, and fitted?"). So each hair is [fitted](fit) to the mean
//! of its guides' vertices, end on end and rolled as the tangents agree best; where guides
//! say nothing of that it goes over into that mean, stretched to its length.
//!
//! Source: our own. Local space, unit of the mesh. Sixteen hairs side by side, lane by lane,
//! so a hair has the same bits whatever its neighbours.
//!
//! Limits: hairs all around three guides whose phases go round once cannot all be curls and
//! change smoothly; in the middle they go over into the mean.

mod fit;
#[cfg(test)]
pub(super) mod samples;

use crate::lanes::{LANES, Row, Rows};
use fearless_simd::{Level, dispatch};
use fit::{Fit, Lines, Sums, across};
use pelage_curves::Vec3;

/// Where the mean of directions is shorter than this they have hardly a common one.
const COMMON: f32 = 0.1;

/// An edge of each of the hairs, which lie as they were put together.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Edges {
    pub vector: Rows,
    /// The vector's.
    pub length: Row,
    /// How much it says of the hair's roll (0..=1): see [`says`].
    pub say: Row,
}

/// How hairs side by side are put together of parts `P`.
pub(super) trait Maker<P> {
    /// Forgets all hairs.
    fn clear(&mut self);

    /// Takes a hair of so many segments into a lane. Its edges may be written here or by
    /// [`unroll`](Self::unroll); of shorter hairs those behind the last stay as they are,
    /// without length.
    fn load(&mut self, lane: usize, parts: P, segments: usize, edges: &mut [Edges]);

    /// Writes the edges of all hairs.
    fn unroll(&mut self, edges: &mut [Edges]);
}

/// Memory for the hairs side by side. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(super) struct Scratch {
    edges: Vec<Edges>,
    /// The mean of the vertices, and in the end the hair's.
    vertices: Vec<Rows>,
}

/// Turns means of vertices into hairs that `maker` makes. Hair `i` has the vertices
/// `starts[i]..starts[i + 1]` of `vertices`, one at least, which hold what
/// [`interpolate`](super::interpolate) makes of its guides, and is made of `parts(i)`; `None`
/// leaves it as it is.
pub(super) fn lay<P>(
    parts: impl Fn(usize) -> Option<P>,
    starts: &[u32],
    maker: &mut impl Maker<P>,
    scratch: &mut Scratch,
    vertices: &mut [Vec3],
) {
    let hairs = 0..starts.len().saturating_sub(1);
    let mut hairs = hairs.filter_map(|i| parts(i).map(|p| (i, p)));
    dispatch!(Level::new(), simd => {
        let _ = simd;
        let mut block = [0; LANES];
        loop {
            scratch.clear();
            maker.clear();
            let mut lanes = 0;
            for (i, parts) in hairs.by_ref().take(LANES) {
                let range = starts[i] as usize..starts[i + 1] as usize;
                let mean = &vertices[range];
                scratch.load(lanes, mean);
                maker.load(lanes, parts, mean.len() - 1, &mut scratch.edges);
                block[lanes] = i;
                lanes += 1;
            }
            if lanes == 0 {
                break;
            }
            maker.unroll(&mut scratch.edges);
            let fit = scratch.fit();
            scratch.place(&fit);
            for (lane, &i) in block[..lanes].iter().enumerate() {
                let range = starts[i] as usize..starts[i + 1] as usize;
                for (vertex, row) in vertices[range].iter_mut().zip(&scratch.vertices) {
                    *vertex = row.get(lane);
                }
            }
        }
    });
}

/// How much an edge says of the roll where the hair has wound by so much before it, in
/// radians: guides that wind at different rates come to disagree.
#[inline(always)]
pub(super) fn says(wound: f32) -> f32 {
    let fades = 1.0 / (1.0 + 0.25 * wound * wound);
    fades * fades
}

impl Scratch {
    fn clear(&mut self) {
        self.edges.clear();
        self.vertices.clear();
    }

    /// Puts the mean of a hair into a lane. Shorter ones than the longest go on with edges
    /// without length.
    #[inline(always)]
    fn load(&mut self, lane: usize, mean: &[Vec3]) {
        let segments = mean.len() - 1;
        if self.edges.len() < segments || self.vertices.is_empty() {
            self.edges.resize(segments, Edges::default());
            // Hairs that are there already stay where they end.
            let last = self.vertices.last().copied().unwrap_or_default();
            self.vertices.resize(segments + 1, last);
        }
        let last = mean[segments];
        let vertices = mean.iter().chain(std::iter::repeat(&last));
        for (row, vertex) in self.vertices.iter_mut().zip(vertices) {
            row.set(lane, *vertex);
        }
    }

    /// Fits the edges to the mean of the vertices.
    #[inline(always)]
    fn fit(&self) -> [Fit; LANES] {
        let mut chord = Rows::default();
        let mut length = [0.0; LANES];
        for edge in &self.edges {
            for (lane, length) in length.iter_mut().enumerate() {
                chord.set(lane, chord.get(lane) + edge.vector.get(lane));
                *length += edge.length[lane];
            }
        }
        let (first, last) = (&self.vertices[0], &self.vertices[self.edges.len()]);
        let lines: [Lines; LANES] = std::array::from_fn(|lane| {
            let whole = last.get(lane) - first.get(lane);
            Lines::new(chord.get(lane), whole, length[lane])
        });
        let mut sums = Sums::default();
        let [a, b] = across(&lines, |l| l.from);
        let [c, d] = across(&lines, |l| l.onto);
        for (edge, pair) in self.edges.iter().zip(self.vertices.windows(2)) {
            let (edge, pair) = (*edge, [pair[0], pair[1]]);
            for lane in 0..LANES {
                let mean = pair[1].get(lane) - pair[0].get(lane);
                let own = edge.vector.get(lane);
                let own = [own.dot(a.get(lane)), own.dot(b.get(lane))];
                let mean = [mean.dot(c.get(lane)), mean.dot(d.get(lane))];
                sums.add(lane, own, mean, edge.say[lane], edge.length[lane]);
            }
        }
        std::array::from_fn(|lane| Fit::new(&lines[lane], &sums, lane))
    }

    /// Writes the vertices over those of the mean, edge by edge at full length.
    #[inline(always)]
    fn place(&mut self, fits: &[Fit; LANES]) {
        let [a, b, c] = [0, 1, 2].map(|k| Rows::of(fits, |fit| fit.from.0[k]));
        let [x, y, z] = [0, 1, 2].map(|k| Rows::of(fits, |fit| fit.onto.0[k]));
        let shares: Row = std::array::from_fn(|lane| fits[lane].share);
        let mut before = self.vertices[0];
        let mut end = before;
        for (edge, vertex) in self.edges.iter().zip(&mut self.vertices[1..]) {
            let (edges, mut made) = (*edge, *vertex);
            for (lane, share) in shares.iter().enumerate() {
                let here = made.get(lane);
                let mean = here - before.get(lane);
                before.set(lane, here);
                let edge = edges.vector.get(lane);
                let placed = x.get(lane) * edge.dot(a.get(lane))
                    + y.get(lane) * edge.dot(b.get(lane))
                    + z.get(lane) * edge.dot(c.get(lane));
                let mixed = mean * (1.0 - share) + placed * share;
                let next = end.get(lane) + stretched(mixed, edges.length[lane]);
                end.set(lane, next);
                made.set(lane, next);
            }
            *vertex = made;
        }
    }
}

/// `edge` at `length`, which it has already or falls short of; less where it is almost 0,
/// so that the result does not jump there.
#[inline(always)]
fn stretched(edge: Vec3, length: f32) -> Vec3 {
    let soft = COMMON * COMMON * length * length;
    let square = (edge.length_squared() + soft).max(f32::MIN_POSITIVE);
    edge * ((length * length + soft) / square).sqrt()
}

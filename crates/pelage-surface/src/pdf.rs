//! The probability density of roots, and the way back from a root to its numbers.
//!
//! Source: document 004, section 2.1.8. With the sampler they are the triple that
//! Monte-Carlo methods ask for: sample, density, inverse. Where hair only grows, none of
//! this is needed, so its table is made on request.

use crate::part::{MAX_DEPTH, Part};
use crate::{Mesh, RootSampler, SurfacePoint};

/// Answers how likely roots are on one surface.
///
/// ```
/// use pelage_surface::{Density, Mesh, PolygonMesh, RootPdf, RootSampler};
/// let triangle = PolygonMesh {
///     positions: vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]],
///     face_sizes: vec![3],
///     corner_vertices: vec![0, 1, 2],
///     ..PolygonMesh::default()
/// };
/// let mesh = Mesh::new(triangle).unwrap();
/// let density = Density { value: 1.0, map: None };
/// let sampler = RootSampler::new(&mesh, &density, 0).unwrap();
/// let pdf = RootPdf::new(&sampler, &mesh);
/// assert_eq!(pdf.density(&sampler.root(7)), 0.5); // an area of 2
/// ```
#[derive(Clone, Debug)]
pub struct RootPdf<'a> {
    sampler: &'a RootSampler,
    mesh: &'a Mesh,
    /// For each triangle, its pieces: where they start and how many there are.
    pieces: Vec<(u32, u32)>,
}

impl<'a> RootPdf<'a> {
    /// Prepares `sampler`, which was made of `mesh` (8 bytes a triangle).
    pub fn new(sampler: &'a RootSampler, mesh: &'a Mesh) -> Self {
        let mut pieces = vec![(0, 0); mesh.triangles().len()];
        for (i, (triangle, _)) in sampler.pieces().iter().enumerate() {
            let (first, count) = &mut pieces[triangle as usize];
            if *count == 0 {
                *first = i as u32;
            }
            *count += 1;
        }
        Self {
            sampler,
            mesh,
            pieces,
        }
    }

    /// The piece of constant density that holds `place`, by its index along the
    /// distribution, and the weights of the piece's corners there; `None` where no hair
    /// grows.
    pub fn piece_at(&self, place: &SurfacePoint) -> Option<(usize, [f32; 3])> {
        let (index, part) = self.piece(place)?;
        let [_, u, v] = place.barycentric;
        let [p, q] = [(u, 0), (v, 1)].map(|(x, k)| (x - part.origin[k]) / part.size);
        Some((index, [1.0 - p - q, p, q]))
    }

    /// Probability of a root at `place` for a unit of area of the rest surface; 0 where
    /// no hair grows. Its integral over the surface is 1.
    pub fn density(&self, place: &SurfacePoint) -> f64 {
        self.piece(place).map_or(0.0, |(index, part)| {
            let size = part.size as f64;
            let area = self.mesh.area(place.triangle as usize) * size * size;
            self.sampler.distribution().probability(index) / area
        })
    }

    /// The numbers that [`RootSampler::place`] leads to `place`, to rounding; `None`
    /// where no hair grows, or on a piece too dim beside the rest for any number.
    pub fn inverse(&self, place: &SurfacePoint) -> Option<(u64, u32)> {
        let (index, part) = self.piece(place)?;
        let [_, u, v] = place.barycentric;
        let [p, q] = [(u, 0), (v, 1)].map(|(x, k)| ((x - part.origin[k]) / part.size) as f64);
        let root = (1.0 - p).clamp(0.0, 1.0);
        let along = if root > 0.0 {
            (q / root).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let (start, end) = self.sampler.distribution().share(index);
        let width = (end - start as u128) as f64;
        let last = (end - start as u128).checked_sub(1)? as u64;
        // The casts saturate: a share may be all of 2^64.
        let inside = ((root * root * width) as u64).min(last);
        Some((start + inside, (along * (1u64 << 32) as f64) as u32))
    }

    /// The piece that holds `place`, by its index along the distribution.
    fn piece(&self, place: &SurfacePoint) -> Option<(usize, Part)> {
        let (first, count) = *self.pieces.get(place.triangle as usize)?;
        let [_, u, v] = place.barycentric;
        let at = path_to(u, v);
        let (mut low, mut high) = (first as usize, (first + count) as usize);
        // The pieces of a triangle lie in the order of their paths.
        while low < high {
            let middle = (low + high) / 2;
            let (_, part) = self.sampler.pieces().get(middle);
            let (start, end) = paths_of(part);
            if at < start {
                high = middle;
            } else if at >= end {
                low = middle + 1;
            } else {
                return Some((middle, part));
            }
        }
        None
    }
}

/// Which children lead to the smallest part that holds a place, two bits each.
fn path_to(mut u: f32, mut v: f32) -> u32 {
    let mut path = 0;
    for _ in 0..MAX_DEPTH {
        let child = if u >= 0.5 {
            2
        } else if v >= 0.5 {
            3
        } else if u + v <= 0.5 {
            0
        } else {
            1
        };
        // Into the child's own coordinates; all steps are exact.
        let Part { origin, size } = Part::WHOLE.children()[child];
        [u, v] = [(u - origin[0]) / size, (v - origin[1]) / size];
        path = path << 2 | child as u32;
    }
    path
}

/// The range of paths that lead into `part`.
fn paths_of(part: Part) -> (u32, u32) {
    let [_, u, v] = part.centre();
    let below = 2 * MAX_DEPTH - 2 * depth_of(part);
    let start = path_to(u, v) >> below << below;
    (start, start + (1 << below))
}

/// How often the whole was halved to make `part`.
fn depth_of(part: Part) -> u32 {
    (part.size.abs().recip() as u32).ilog2()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixture::{maps, sheet};
    use crate::{Density, ImageMap, Spread, Wrap};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_way_back_from_a_root_gives_its_numbers(x: u64, y: u32, map in 0usize..5) {
            let (mesh, maps) = (sheet(4), maps());
            let density = Density { value: 1.0, map: Some((&maps[map].1, 0, Wrap::Repeat)) };
            let sampler = RootSampler::new(&mesh, &density, 1).unwrap();
            let pdf = RootPdf::new(&sampler, &mesh);
            let place = sampler.place(x, y);
            prop_assert!(pdf.density(&place) > 0.0);
            let (x, y) = pdf.inverse(&place).unwrap();
            let again = sampler.place(x, y);
            let (_, inside) = pdf.piece_at(&place).unwrap();
            prop_assert!(inside.iter().all(|w| (-1e-3..=1.001).contains(w)), "{:?}", inside);
            prop_assert_eq!(again.triangle, place.triangle);
            for k in 0..3 {
                let apart = (again.barycentric[k] - place.barycentric[k]).abs();
                prop_assert!(apart < 2e-6, "{:?} {:?}", again, place);
            }
        }

        #[test]
        fn a_part_is_found_by_any_place_inside_it(
            digits in prop::collection::vec(0usize..4, 0..8), p in 0.01f32..0.98, q in 0.01f32..0.98,
        ) {
            let part = digits.iter().fold(Part::WHOLE, |part, &d| part.children()[d]);
            let (p, q) = if p + q > 0.99 { (0.99 - p, 0.99 - q) } else { (p, q) };
            let [_, u, v] = part.barycentric(p, q);
            let (start, end) = paths_of(part);
            prop_assert!((start..end).contains(&path_to(u, v)));
        }
    }

    #[test]
    fn a_piece_too_dim_for_any_number_has_no_way_back() {
        let mesh = sheet(2);
        let texels = (0..64).map(|i| if i == 9 { 1e30 } else { 1e-30 });
        let map = ImageMap::new(8, 8, 1, texels.collect::<Vec<f32>>(), false).unwrap();
        let density = Density {
            value: 1.0,
            map: Some((&map, 0, Wrap::Clamp)),
        };
        let sampler = RootSampler::new(&mesh, &density, 0).unwrap();
        let pdf = RootPdf::new(&sampler, &mesh);
        let dim = sampler.piece_centres().filter(|c| pdf.density(c) == 0.0);
        assert!(dim.inspect(|c| assert!(pdf.inverse(c).is_none())).count() > 0);
    }

    /// Independent roots in a grid of cells over the sheet, against the integral of the
    /// density over each cell.
    #[test]
    fn roots_are_as_frequent_as_their_density_says_on_every_map() {
        const CELLS: usize = 12;
        let mesh = sheet(7);
        for (name, map) in maps() {
            let density = Density {
                value: 1.0,
                map: Some((&map, 0, Wrap::Repeat)),
            };
            let sampler = RootSampler::new(&mesh, &density, 5).unwrap();
            let sampler = sampler.with_spread(Spread::Random);
            let pdf = RootPdf::new(&sampler, &mesh);
            let cell = |place: &SurfacePoint| {
                let uv = mesh.uv(place) * CELLS as f32;
                let [x, y] = [uv.x, uv.y].map(|c| (c as usize).min(CELLS - 1));
                y * CELLS + x
            };
            let drawn = 200_000;
            let mut found = vec![0.0; CELLS * CELLS];
            for i in 0..drawn {
                found[cell(&sampler.root(i))] += 1.0;
            }
            // Each triangle is integrated over the parts of a fine cut.
            let mut expected = vec![0.0; CELLS * CELLS];
            let finest = crate::part::parts(6);
            let finest = &finest[finest.len() - (1 << 12)..];
            for triangle in 0..mesh.triangles().len() as u32 {
                let area = mesh.area(triangle as usize) / finest.len() as f64;
                for part in finest {
                    let place = SurfacePoint {
                        triangle,
                        barycentric: part.centre(),
                    };
                    expected[cell(&place)] += pdf.density(&place) * area;
                }
            }
            let total: f64 = expected.iter().sum();
            assert!((total - 1.0).abs() < 1e-9, "{name}: {total}");
            let chi_square: f64 = found
                .iter()
                .zip(&expected)
                .filter(|(_, e)| **e > 0.0)
                .map(|(f, e)| (f, e * drawn as f64))
                .map(|(f, e)| (f - e) * (f - e) / e)
                .sum();
            // 143 degrees of freedom: 240 has a probability of 1e-6. Cells that cut
            // through pieces differ a little from the integral over whole parts.
            assert!(chi_square < 240.0, "{name}: {chi_square}");
            let outside = found
                .iter()
                .zip(&expected)
                .any(|(f, e)| *e == 0.0 && *f > 0.0);
            assert!(!outside, "{name}");
        }
    }
}

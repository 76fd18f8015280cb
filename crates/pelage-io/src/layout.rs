//! How many values an attribute of curves has in each domain, and which of them
//! belongs to which vertex.
//!
//! Counts: OpenUSD `pxr/usd/usdGeom/schema.usda`, class `BasisCurves`, and
//! `basisCurves.cpp` (`ComputeVaryingDataSize`) for curves of too few vertices.

use pelage_curves::{Basis, Wrap};

/// Curves of one primitive, and those of them that have all their vertices.
pub(crate) struct Layout {
    basis: Basis,
    wrap: Wrap,
    /// Vertices of each curve that is kept.
    counts: Vec<usize>,
    /// Curves, vertices and varying values that the file should have.
    file_curves: usize,
    file_vertices: u64,
    file_varying: u64,
}

/// A value that can be mixed with another.
pub(crate) trait Mix: Copy {
    /// `a` at `t` = 0, `b` at `t` = 1.
    fn mix(a: Self, b: Self, t: f32) -> Self;
}

impl Mix for f32 {
    fn mix(a: f32, b: f32, t: f32) -> f32 {
        a * (1.0 - t) + b * t
    }
}

impl Mix for [f32; 3] {
    fn mix(a: Self, b: Self, t: f32) -> Self {
        std::array::from_fn(|k| f32::mix(a[k], b[k], t))
    }
}

impl Layout {
    /// The layout of curves of `counts` vertices where there are `points` vertices:
    /// curves are kept from the first to the last that has all of its vertices.
    pub(crate) fn new(basis: Basis, wrap: Wrap, counts: &[usize], points: usize) -> Self {
        let mut layout = Self {
            basis,
            wrap,
            counts: Vec::new(),
            file_curves: counts.len(),
            file_vertices: 0,
            file_varying: 0,
        };
        for &count in counts {
            layout.file_vertices = layout.file_vertices.saturating_add(count as u64);
            let varying = varying_count(basis, wrap, count) as u64;
            layout.file_varying = layout.file_varying.saturating_add(varying);
            if layout.file_vertices <= points as u64 {
                layout.counts.push(count);
            }
        }
        layout
    }

    /// Vertices of each curve that is kept.
    pub(crate) fn counts(&self) -> &[usize] {
        &self.counts
    }

    /// Vertices of all curves that are kept.
    pub(crate) fn vertices(&self) -> usize {
        self.counts.iter().sum()
    }

    /// Vertices of all curves of the file.
    pub(crate) fn file_vertices(&self) -> u64 {
        self.file_vertices
    }

    /// Fails where `found` is not the number of values of `domain`.
    fn check(&self, found: usize, domain: &str) -> Result<(), String> {
        let expected = match domain {
            "constant" => 1,
            "uniform" => self.file_curves as u64,
            "varying" => self.file_varying,
            "vertex" | "faceVarying" => self.file_vertices,
            _ => return Err(format!("has the unknown interpolation {domain:?}")),
        };
        match found as u64 == expected {
            true => Ok(()),
            false => Err(format!("has {found} entries, not {expected} ({domain})")),
        }
    }

    /// Where each kept curve's vertices start: one entry more than curves. Vertices
    /// must be no more than fit in 32 bits.
    pub(crate) fn offsets(&self) -> Vec<u32> {
        let ends = self.counts.iter().scan(0u32, |end, &count| {
            *end += count as u32;
            Some(*end)
        });
        std::iter::once(0).chain(ends).collect()
    }

    /// Values of the domain `vertex` or `uniform` of the curves that are kept.
    pub(crate) fn deal<T: Copy>(&self, values: &[T], domain: &str) -> Result<Vec<T>, String> {
        self.check(values.len(), domain)?;
        let kept = match domain {
            "vertex" => self.vertices(),
            _ => self.counts.len(),
        };
        Ok(values[..kept].to_vec())
    }

    /// One value a vertex.
    pub(crate) fn per_vertex<T: Mix>(&self, values: &[T], domain: &str) -> Result<Vec<T>, String> {
        self.check(values.len(), domain)?;
        let mut all = Vec::with_capacity(self.vertices());
        let mut start = 0;
        for (curve, &count) in self.counts.iter().enumerate() {
            match domain {
                "constant" => all.extend(std::iter::repeat_n(values[0], count)),
                "uniform" => all.extend(std::iter::repeat_n(values[curve], count)),
                "varying" => {
                    let size = varying_count(self.basis, self.wrap, count);
                    let own = &values[start..start + size];
                    all.extend((0..count).map(|i| self.varying_at(own, i)));
                    start += size;
                }
                _ => {
                    all.extend_from_slice(&values[start..start + count]);
                    start += count;
                }
            }
        }
        Ok(all)
    }

    /// One value a curve; of values that vary along a curve, the one of its root.
    pub(crate) fn per_curve<T: Copy>(&self, values: &[T], domain: &str) -> Result<Vec<T>, String> {
        self.check(values.len(), domain)?;
        let mut start = 0;
        let mut all = Vec::with_capacity(self.counts.len());
        for (curve, &count) in self.counts.iter().enumerate() {
            let (place, size) = match domain {
                "constant" => (0, 0),
                "uniform" => (curve, 0),
                "varying" => (start, varying_count(self.basis, self.wrap, count)),
                _ => (start, count),
            };
            // A curve without vertices has no root, and may be the last.
            let value = values.get(place).or(values.last()).copied();
            all.push(value.ok_or("has no entries")?);
            start += size;
        }
        Ok(all)
    }

    /// Value at vertex `i` of a curve whose varying values are `own`. Varying values
    /// sit where segments meet; vertices beyond the ends take the end values.
    fn varying_at<T: Mix>(&self, own: &[T], i: usize) -> T {
        let last = own.len() - 1;
        match (self.basis, self.wrap) {
            (Basis::Bezier, wrap) => {
                let next = match wrap {
                    Wrap::Periodic => (i / 3 + 1) % own.len(),
                    _ => (i / 3 + 1).min(last),
                };
                T::mix(own[(i / 3).min(last)], own[next], (i % 3) as f32 / 3.0)
            }
            (Basis::CatmullRom | Basis::BSpline, Wrap::Nonperiodic) => {
                own[i.saturating_sub(1).min(last)]
            }
            _ => own[i.min(last)],
        }
    }
}

/// Number of varying values of a curve of `vertices` vertices; at least 1 where it
/// has a vertex.
pub(crate) fn varying_count(basis: Basis, wrap: Wrap, vertices: usize) -> usize {
    match (basis, wrap) {
        (Basis::Linear, _) => vertices,
        (Basis::CatmullRom | Basis::BSpline, Wrap::Pinned) => vertices,
        (_, Wrap::Periodic) => (vertices / basis.step()).max(1),
        _ => vertices.saturating_sub(4) / basis.step() + 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn varying_counts_are_those_of_the_schema() {
        use {Basis::*, Wrap::*};
        let cases = [
            (Linear, Nonperiodic, 5, 5),
            (Bezier, Nonperiodic, 7, 3),
            (Bezier, Periodic, 6, 2),
            (CatmullRom, Nonperiodic, 10, 8),
            (CatmullRom, Pinned, 8, 8),
            (BSpline, Pinned, 8, 8),
            (BSpline, Periodic, 6, 6),
        ];
        for (basis, wrap, vertices, expected) in cases {
            let found = varying_count(basis, wrap, vertices);
            assert_eq!(found, expected, "{basis:?} {wrap:?}");
        }
    }

    #[test]
    fn varying_values_of_a_catmull_rom_curve_skip_its_phantom_ends() {
        let layout = Layout::new(Basis::CatmullRom, Wrap::Nonperiodic, &[5], 5);
        let widths = layout.per_vertex(&[1.0f32, 2.0, 3.0], "varying");
        assert_eq!(widths, Ok(vec![1.0, 1.0, 2.0, 3.0, 3.0]));
    }

    #[test]
    fn varying_values_of_a_bezier_curve_are_mixed_in_between() {
        let layout = Layout::new(Basis::Bezier, Wrap::Nonperiodic, &[4], 4);
        let widths = layout.per_vertex(&[0.0f32, 3.0], "varying");
        assert_eq!(widths, Ok(vec![0.0, 1.0, 2.0, 3.0]));
    }

    #[test]
    fn curves_without_all_their_points_are_left_out() {
        let layout = Layout::new(Basis::Linear, Wrap::Nonperiodic, &[2, 3, 2], 6);
        assert_eq!(layout.counts(), [2, 3]);
        let ids = layout.per_curve(&[7, 8, 9], "uniform");
        assert_eq!(ids, Ok(vec![7, 8]));
        let widths = layout.per_vertex(&[1.0f32; 5], "vertex");
        assert_eq!(widths, Err("has 5 entries, not 7 (vertex)".into()));
    }
}

//! Whether arrays that a file claims to be Super-Helices are such.

use super::{SuperHelices, wide};
use std::fmt;

/// Most vertices of a strand, and of all that a file decodes to: a few bytes must not ask
/// for more memory than a machine has.
const VERTICES: u32 = 1 << 20;
const ALL_VERTICES: u64 = 1 << 28;

/// How far the root's tangent and normal may be from unit length and a right angle.
const SLACK: f64 = 1e-3;

/// What is wrong, and where.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wrong {
    /// An array and an index in it.
    pub place: String,
    pub message: String,
}

impl fmt::Display for Wrong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

fn wrong(place: impl Into<String>, message: impl Into<String>) -> Wrong {
    Wrong {
        place: place.into(),
        message: message.into(),
    }
}

impl SuperHelices {
    /// Sets the offsets from the number of elements of each strand.
    pub(super) fn deal(&mut self, counts: &[u32]) -> Result<(), Wrong> {
        self.offsets = vec![0];
        let mut end = 0u32;
        for (strand, count) in counts.iter().enumerate() {
            let next = end.checked_add(*count);
            end = next.ok_or_else(|| {
                wrong(
                    format!("elements of strand {strand}"),
                    "the elements up to here are more than 32 bits count",
                )
            })?;
            self.offsets.push(end);
        }
        Ok(())
    }

    /// Whether the arrays fit each other and every strand is a point or a curve.
    pub(crate) fn check(&self) -> Result<(), Wrong> {
        self.check_counts()?;
        let mut vertices = 0;
        for strand in 0..self.len() {
            let own = self.vertices[strand];
            vertices += u64::from(own);
            if own > VERTICES || vertices > ALL_VERTICES {
                let message = format!(
                    "{own} vertices, {vertices} so far; a strand may have {VERTICES}, all \
                     together {ALL_VERTICES}"
                );
                return Err(wrong(format!("vertices of strand {strand}"), message));
            }
            self.check_strand(strand)?;
        }
        Ok(())
    }

    fn check_counts(&self) -> Result<(), Wrong> {
        let strands = self.roots.len();
        let each = [
            ("elements", self.offsets.len().wrapping_sub(1)),
            ("vertices", self.vertices.len()),
            ("tangent", self.tangents.len()),
            ("normal", self.normals.len()),
            ("error", self.errors.len()),
        ];
        if let Some((name, found)) = each.iter().find(|(_, found)| *found != strands) {
            let message = format!("{found} entries for the {strands} strands that root has");
            return Err(wrong(*name, message));
        }
        let ascending = self.offsets.windows(2).all(|pair| pair[0] <= pair[1]);
        if self.offsets.first() != Some(&0) || !ascending {
            return Err(wrong("elements", "offsets that do not ascend from 0"));
        }
        let elements = self.offsets[strands] as usize;
        let each = [
            ("length", self.lengths.len()),
            ("twist", self.twists.len()),
            ("curvature_1", self.curvatures_1.len()),
            ("curvature_2", self.curvatures_2.len()),
        ];
        match each.iter().find(|(_, found)| *found != elements) {
            Some((name, found)) => {
                let message = format!("{found} entries for {elements} elements");
                Err(wrong(*name, message))
            }
            None => Ok(()),
        }
    }

    fn check_strand(&self, strand: usize) -> Result<(), Wrong> {
        let at = |name: &str| format!("{name} of strand {strand}");
        let [tangent, normal] = [self.tangents[strand], self.normals[strand]].map(wide);
        let error = self.errors[strand];
        let near = |found: f64, expected: f64| (found - expected).abs() <= SLACK;
        if !self.roots[strand].iter().all(|x| x.is_finite()) {
            return Err(wrong(at("root"), "not a finite number"));
        }
        if !near(tangent.length(), 1.0) {
            let message = format!(
                "it is {} long; a unit vector belongs here",
                tangent.length()
            );
            return Err(wrong(at("tangent"), message));
        }
        if !(near(normal.length(), 1.0) && near(normal.dot(tangent), 0.0)) {
            let message = "a unit vector perpendicular to the tangent belongs here";
            return Err(wrong(at("normal"), message));
        }
        if !(error >= 0.0 && error.is_finite()) {
            let message = format!("it is {error}, where 0 or more belongs");
            return Err(wrong(at("error"), message));
        }
        if self.elements(strand).is_empty() {
            return Ok(());
        }
        let Some(curve) = self.curve(strand) else {
            let message = "lengths are 0 or more, all numbers finite, and length times \
                           curvature 1e12 at most";
            return Err(wrong(at("elements"), message));
        };
        let reach = curve.root().position.abs().max_element() + curve.length();
        match reach <= f64::from(f32::MAX) {
            true => Ok(()),
            false => Err(wrong(
                at("length"),
                "it leads to where 32 bits do not count",
            )),
        }
    }
}

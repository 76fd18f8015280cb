//! From hairs to the fibres around them, chunk by chunk.

use crate::capture::Capture;
use crate::curves::Curves;
use crate::plan::Plan;
use crate::stages::length;
use crate::stages::strand::{self, StrandFields};
use pelage_curves::{FrameScratch, Vec3, catmull_rom, untwisted_normals};
use pelage_surface::RootFrame;

/// Arrays that are only used while fibres are made.
#[derive(Clone, Debug, Default)]
pub(crate) struct BundleScratch {
    /// The hairs in the middle.
    hairs: Curves,
    frames: FrameScratch,
    normals: Vec<Vec3>,
    tangents: Vec<Vec3>,
    sections: Vec<strand::Section>,
}

impl Plan {
    /// Curves a hair, at least 1.
    pub(crate) fn fibers(&self) -> usize {
        let strand = self.fields.strand.as_ref();
        strand.map_or(1, |strand| strand.fibers as usize)
    }

    /// Puts fibres in the place of hairs that have them; those of a hair follow one
    /// another. `frames` are those of the roots, in the space of `curves`.
    pub(crate) fn bundle(
        &self,
        capture: &Capture,
        frames: &[RootFrame],
        scratch: &mut BundleScratch,
        curves: &mut Curves,
    ) {
        let Some(fields) = &self.fields.strand else {
            return;
        };
        std::mem::swap(curves, &mut scratch.hairs);
        let hairs = &scratch.hairs;
        let (vertices, starts) = (&hairs.vertices, &hairs.starts);
        scratch.normals.resize(vertices.len(), Vec3::ZERO);
        let (first, normals) = (|i: usize| frames[i].tangent, &mut scratch.normals);
        untwisted_normals(vertices, starts, first, &mut scratch.frames, normals);
        let lengths = (0..hairs.len()).map(|i| starts[i + 1] - starts[i]);
        let count = fields.fibers as usize;
        curves.lay_out(lengths.flat_map(|length| std::iter::repeat_n(length, count)));
        for (i, frame) in frames.iter().enumerate() {
            self.fibers_of(fields, capture, i, frame.position, scratch, curves);
        }
    }

    /// Makes the fibres of hair number `i` of the chunk, which grows at `root`.
    fn fibers_of(
        &self,
        fields: &StrandFields,
        capture: &Capture,
        i: usize,
        root: Vec3,
        scratch: &mut BundleScratch,
        curves: &mut Curves,
    ) {
        let BundleScratch {
            hairs,
            normals,
            tangents,
            sections,
            ..
        } = scratch;
        let (hair, normals) = (hairs.get(i), &normals[hairs.range(i)]);
        tangents.resize(hair.len(), Vec3::ZERO);
        sections.resize(hair.len(), strand::Section::default());
        catmull_rom::tangents(hair, tangents);
        strand::sections(
            fields.splay(),
            &capture.bundles[i],
            hair,
            tangents,
            normals,
            sections,
        );
        let first = i * fields.fibers as usize;
        for place in first..first + fields.fibers as usize {
            let (fiber, vertices) = (capture.fibers[place], curves.get_mut(place));
            strand::around(fiber, root, sections, vertices);
            if self.fields.preserve.splay {
                length::preserve(hair, 1.0 - fiber.lack, vertices);
            }
        }
    }
}

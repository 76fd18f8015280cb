//! Colour, opacity and width of the hairs of a chunk, from the maps to what is mixed along
//! each hair.

use crate::color::ColorMix;
use crate::columns::Columns;
use crate::plan::Fields;
use crate::stages::look::{Look, LookFields};
use crate::stages::roots::Root;
use pelage_curves::Vec2;

/// Arrays that are only used while looks are read.
#[derive(Clone, Debug, Default)]
pub(crate) struct LookScratch {
    columns: Columns,
    /// Colours of all hairs at each place.
    colors: Vec<Vec<[f32; 3]>>,
}

impl Fields {
    /// Appends the looks of the hairs at `roots`, whose texture coordinates are `uvs`, to
    /// `looks`, and writes the mixes of their colours, hair by hair, to `mixes`.
    pub(crate) fn read_looks(
        &self,
        roots: &[Root],
        uvs: &[Vec2],
        seed: u64,
        scratch: &mut LookScratch,
        (looks, mixes): (&mut Vec<Look>, &mut Vec<ColorMix>),
    ) {
        let LookScratch { columns, colors } = scratch;
        let LookFields {
            color,
            color_space,
            opacity,
            width,
        } = &self.look;
        colors.resize_with(color.fields.len(), Vec::new);
        for (field, colors) in color.fields.iter().zip(&mut *colors) {
            field.read(uvs, colors);
        }
        self.tint.apply(roots, uvs, seed, columns, colors);
        color.mix(*color_space, colors, mixes);
        let ([o, p], [w, x]) = (opacity.fields(), width.fields());
        let numbers = columns.read([o, p, w, x], uvs);
        looks.extend(numbers.map(|[o, p, w, x]| Look {
            opacity: [o, p].map(|opacity| opacity.clamp(0.0, 1.0)),
            width: [w, x].map(|width| width.max(0.0)),
        }));
    }
}

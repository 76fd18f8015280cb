//! Colour, opacity and width of the hairs of a chunk, from the maps to what is mixed along
//! each hair.

use crate::color::ColorMix;
use crate::columns::Columns;
use crate::plan::Fields;
use crate::stages::look::Look;
use crate::stages::roots::Root;
use pelage_curves::Vec2;

/// Arrays that are only used while looks are read.
#[derive(Clone, Debug, Default)]
pub(crate) struct LookScratch {
    columns: Columns,
    /// Colours at root and tip.
    colors: [Vec<[f32; 3]>; 2],
}

impl Fields {
    /// Appends the looks of the hairs at `roots`, whose texture coordinates are `uvs`.
    pub(crate) fn read_looks(
        &self,
        roots: &[Root],
        uvs: &[Vec2],
        seed: u64,
        scratch: &mut LookScratch,
        looks: &mut Vec<Look>,
    ) {
        let LookScratch { columns, colors } = scratch;
        for (field, colors) in self.color.iter().zip(&mut *colors) {
            field.read(uvs, colors);
        }
        let [from, to] = colors;
        self.tint.apply(roots, uvs, seed, columns, [from, to]);
        let ([o, p], [w, x]) = (&self.opacity, &self.width);
        let numbers = columns.read([o, p, w, x], uvs);
        let hairs = from.iter().zip(to).zip(numbers);
        looks.extend(hairs.map(|((&from, &mut to), [o, p, w, x])| Look {
            color: ColorMix::new(self.color_space, from, to),
            opacity: [o, p].map(|opacity| opacity.clamp(0.0, 1.0)),
            width: [w, x].map(|width| width.max(0.0)),
        }));
    }
}

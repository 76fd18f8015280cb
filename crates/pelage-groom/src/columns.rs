//! Properties of all hairs of a chunk, one property after the other.
//!
//! Hairs that follow each other stand far apart on the surface, so every texel comes from
//! far away. Reading a property for all hairs before the next one waits for many texels at
//! once; reading all properties of a hair waits for each in turn.

use crate::maps::ScalarField;
use pelage_curves::Vec2;

/// Values of some properties at many places. Reused between chunks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Columns {
    columns: Vec<Vec<f32>>,
}

impl Columns {
    /// The values of `fields` at each of `uvs`, in their order.
    pub(crate) fn read<'a, const N: usize>(
        &'a mut self,
        fields: [&ScalarField; N],
        uvs: &[Vec2],
    ) -> impl Iterator<Item = [f32; N]> + 'a {
        if self.columns.len() < N {
            self.columns.resize_with(N, Vec::new);
        }
        for (field, column) in fields.into_iter().zip(&mut self.columns) {
            field.read(uvs, column);
        }
        let rows = 0..uvs.len();
        let columns: [&[f32]; N] = std::array::from_fn(|k| &self.columns[k][rows.clone()]);
        rows.map(move |row| columns.map(|column| column[row]))
    }
}

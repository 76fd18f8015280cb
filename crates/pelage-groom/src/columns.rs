//! Properties of all hairs of a chunk, one property after the other.
//!
//! Hairs that follow each other stand far apart on the surface, so every texel comes from
//! far away. Reading a property for all hairs before the next one waits for many texels at
//! once; reading all properties of a hair waits for each in turn.

use crate::lanes::{LANES, Row};
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
        let columns = self.fill(fields, uvs);
        (0..uvs.len()).map(move |row| columns.map(|column| column[row]))
    }

    /// The same, [`LANES`] places side by side; zeros behind the last.
    pub(crate) fn rows<'a, const N: usize>(
        &'a mut self,
        fields: [&ScalarField; N],
        uvs: &[Vec2],
    ) -> impl Iterator<Item = [Row; N]> + 'a {
        let columns = self.fill(fields, uvs);
        let firsts = (0..uvs.len()).step_by(LANES);
        firsts.map(move |first| columns.map(|column| row(&column[first..])))
    }

    fn fill<const N: usize>(&mut self, fields: [&ScalarField; N], uvs: &[Vec2]) -> [&[f32]; N] {
        if self.columns.len() < N {
            self.columns.resize_with(N, Vec::new);
        }
        for (field, column) in fields.into_iter().zip(&mut self.columns) {
            field.read(uvs, column);
        }
        std::array::from_fn(|k| &self.columns[k][..uvs.len()])
    }
}

/// The first of `column`.
#[inline(always)]
fn row(column: &[f32]) -> Row {
    column.first_chunk().copied().unwrap_or_else(|| {
        let mut row = [0.0; LANES];
        row[..column.len()].copy_from_slice(column);
        row
    })
}

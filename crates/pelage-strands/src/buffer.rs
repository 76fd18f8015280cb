//! A chunk of strands as structure of arrays.

use pelage_curves::Vec3;
use std::ops::Range;

/// What is known of one strand besides its vertices.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StrandMeta {
    /// Index of the hair in the groom.
    pub hair_id: u64,
    /// Index of the fibre in its multi-strand; 0 for single fibres.
    pub strand_id: u32,
    /// Texture coordinates of the root, origin lower left.
    pub root_uv: [f32; 2],
    /// Position of the fibre in the cross-section of its multi-strand.
    pub strand_uv: [f32; 2],
    /// Interpolation group.
    pub group: u32,
    /// Triangle of the surface the root lies on.
    pub triangle: u32,
    /// Weights of the triangle's three corners at the root; they sum to 1.
    pub barycentric: [f32; 3],
    /// Root on the surface at rest.
    pub root_rest: [f32; 3],
}

/// Strands as arrays: one entry a vertex, or one entry a strand.
///
/// `offsets` always has one entry more than there are strands, starts with 0 and
/// ascends. `points` has one entry a vertex. Every other array is either of the
/// length its domain asks for, or empty, which means *absent*: a file need not
/// carry colours. The generator fills them all, but for `normals` where the
/// recipe turns them off.
#[derive(Clone, Debug, PartialEq)]
pub struct StrandBuffer {
    /// Where each strand's vertices start; `strands + 1` entries.
    pub offsets: Vec<u32>,
    /// Per vertex: position, world space.
    pub points: Vec<[f32; 3]>,
    /// Per vertex: full width (diameter).
    pub widths: Vec<f32>,
    /// Per vertex: linear RGB in 0..=1.
    pub colors: Vec<[f32; 3]>,
    /// Per vertex: opacity in 0..=1.
    pub opacities: Vec<f32>,
    /// Per vertex: unit curve normal.
    pub normals: Vec<[f32; 3]>,
    /// Per strand: index of the hair in the groom.
    pub hair_id: Vec<u64>,
    /// Per strand: index of the fibre in its multi-strand.
    pub strand_id: Vec<u32>,
    /// Per strand: texture coordinates of the root.
    pub root_uv: Vec<[f32; 2]>,
    /// Per strand: position in the cross-section of the multi-strand.
    pub strand_uv: Vec<[f32; 2]>,
    /// Per strand: interpolation group.
    pub group: Vec<u32>,
    /// Per strand: triangle of the surface.
    pub triangle: Vec<u32>,
    /// Per strand: corner weights of the root in its triangle.
    pub barycentric: Vec<[f32; 3]>,
    /// Per strand: root position on the surface at rest.
    pub root_rest: Vec<[f32; 3]>,
}

impl Default for StrandBuffer {
    fn default() -> Self {
        Self {
            offsets: vec![0],
            points: Vec::new(),
            widths: Vec::new(),
            colors: Vec::new(),
            opacities: Vec::new(),
            normals: Vec::new(),
            hair_id: Vec::new(),
            strand_id: Vec::new(),
            root_uv: Vec::new(),
            strand_uv: Vec::new(),
            group: Vec::new(),
            triangle: Vec::new(),
            barycentric: Vec::new(),
            root_rest: Vec::new(),
        }
    }
}

/// Runs the same statement for every optional array of a buffer.
macro_rules! for_each_attribute {
    ($macro:ident) => {
        $macro!(
            points,
            widths,
            colors,
            opacities,
            normals,
            hair_id,
            strand_id,
            root_uv,
            strand_uv,
            group,
            triangle,
            barycentric,
            root_rest
        )
    };
}

impl StrandBuffer {
    /// A buffer without strands.
    pub fn new() -> Self {
        Self::default()
    }

    /// Number of strands.
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Whether there is no strand.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Vertices of strand `strand` as indices into the per-vertex arrays.
    pub fn vertices(&self, strand: usize) -> Range<usize> {
        self.offsets[strand] as usize..self.offsets[strand + 1] as usize
    }

    /// Number of vertices of strand `strand`.
    pub fn vertex_count(&self, strand: usize) -> usize {
        self.vertices(strand).len()
    }

    /// Positions of strand `strand`.
    pub fn strand_points(&self, strand: usize) -> &[Vec3] {
        bytemuck::cast_slice(&self.points[self.vertices(strand)])
    }

    /// Empties every array and keeps the memory.
    pub fn clear(&mut self) {
        self.offsets.truncate(1);
        macro_rules! clear { ($($name:ident),*) => { $(self.$name.clear();)* } }
        for_each_attribute!(clear);
    }

    /// Appends one strand's record; its vertices must have been appended before.
    pub fn push_meta(&mut self, meta: &StrandMeta) {
        self.offsets.push(self.points.len() as u32);
        self.hair_id.push(meta.hair_id);
        self.strand_id.push(meta.strand_id);
        self.root_uv.push(meta.root_uv);
        self.strand_uv.push(meta.strand_uv);
        self.group.push(meta.group);
        self.triangle.push(meta.triangle);
        self.barycentric.push(meta.barycentric);
        self.root_rest.push(meta.root_rest);
    }

    /// Appends the records of strands whose vertices are there already: each comes with the
    /// end of its vertices in [`points`](Self::points). Faster than one by one.
    ///
    /// ```
    /// use pelage_strands::{StrandBuffer, StrandMeta};
    /// let mut strands = StrandBuffer::new();
    /// strands.points = vec![[0.0; 3]; 5];
    /// let meta = |hair_id| StrandMeta { hair_id, ..Default::default() };
    /// strands.extend_meta([(2, meta(7)), (5, meta(8))].into_iter());
    /// assert_eq!((&strands.offsets[..], &strands.hair_id[..]), (&[0, 2, 5][..], &[7, 8][..]));
    /// ```
    #[inline(always)]
    pub fn extend_meta(&mut self, metas: impl ExactSizeIterator<Item = (u32, StrandMeta)>) {
        let first = self.len();
        let all = first + metas.len();
        self.offsets.resize(all + 1, 0);
        macro_rules! columns { ($($name:ident),*) => {
            $(
                self.$name.resize(all, Default::default());
                // Of one length for all to see, so that nothing is checked in the loop.
                let $name = &mut self.$name[first..all];
            )*
            let offsets = &mut self.offsets[first + 1..all + 1];
            for (i, (end, meta)) in metas.enumerate().take(all - first) {
                offsets[i] = end;
                $($name[i] = meta.$name;)*
            }
        } }
        columns!(
            hair_id,
            strand_id,
            root_uv,
            strand_uv,
            group,
            triangle,
            barycentric,
            root_rest
        );
    }

    /// Appends all strands of `other`. An array that one of the two lacks while it
    /// has strands is dropped: half an attribute is none.
    ///
    /// ```
    /// use pelage_strands::StrandBuffer;
    /// let mut one = StrandBuffer::new();
    /// one.points = vec![[0.0; 3], [0.0, 0.0, 1.0]];
    /// one.offsets = vec![0, 2];
    /// let mut two = StrandBuffer::new();
    /// two.append(&one);
    /// two.append(&one);
    /// assert_eq!(two.offsets, [0, 2, 4]);
    /// ```
    pub fn append(&mut self, other: &StrandBuffer) {
        if other.is_empty() {
            return;
        }
        let was_empty = self.is_empty();
        let base = self.points.len() as u32;
        self.offsets
            .extend(other.offsets[1..].iter().map(|o| base + o));
        macro_rules! append { ($($name:ident),*) => { $(
            if was_empty || !self.$name.is_empty() {
                if other.$name.is_empty() {
                    self.$name.clear();
                } else {
                    self.$name.extend_from_slice(&other.$name);
                }
            }
        )* } }
        for_each_attribute!(append);
    }

    /// Bytes held by the arrays.
    pub fn bytes(&self) -> usize {
        let mut bytes = std::mem::size_of_val(&self.offsets[..]);
        macro_rules! count { ($($name:ident),*) => { $(
            bytes += std::mem::size_of_val(&self.$name[..]);
        )* } }
        for_each_attribute!(count);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one_strand() -> StrandBuffer {
        let mut buffer = StrandBuffer::new();
        buffer.points = vec![[0.0; 3], [1.0; 3], [2.0; 3]];
        buffer.widths = vec![0.1, 0.1, 0.0];
        buffer.push_meta(&StrandMeta {
            hair_id: 7,
            ..Default::default()
        });
        buffer
    }

    #[test]
    fn appending_shifts_offsets_and_keeps_attributes() {
        let mut all = StrandBuffer::new();
        all.append(&one_strand());
        all.append(&one_strand());
        assert_eq!(all.offsets, [0, 3, 6]);
        assert_eq!(all.widths.len(), 6);
        assert_eq!(all.hair_id, [7, 7]);
        assert_eq!(all.vertices(1), 3..6);
    }

    #[test]
    fn an_attribute_one_side_lacks_is_dropped() {
        let mut bare = one_strand();
        bare.widths.clear();
        let mut all = one_strand();
        all.append(&bare);
        assert!(all.widths.is_empty());
        let mut all = bare;
        all.append(&one_strand());
        assert!(all.widths.is_empty());
    }

    #[test]
    fn clearing_leaves_a_valid_empty_buffer() {
        let mut buffer = one_strand();
        buffer.clear();
        assert_eq!(buffer, StrandBuffer::default());
    }
}

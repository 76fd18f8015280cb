//! Arrays of raw numbers as the text between a USD array's brackets.

use crate::columns::Scalar;
use crate::text_numbers::{push_f32, push_int};
use std::io::{self, Write};

/// Entries on a line: keeps lines short enough for editors and line-based tools.
const ENTRIES_A_LINE: usize = 16;

/// The inside of an array, written piece by piece; the text does not depend on
/// where the pieces were cut.
#[derive(Debug)]
pub(crate) struct TextArray {
    scalar: Scalar,
    components: usize,
    first: bool,
    on_line: usize,
    text: Vec<u8>,
}

impl TextArray {
    /// The inside of an array of entries of `components` numbers each.
    pub(crate) fn new(scalar: Scalar, components: usize) -> Self {
        Self {
            scalar,
            components,
            first: true,
            on_line: 0,
            text: Vec::new(),
        }
    }

    /// Starts the next array.
    pub(crate) fn restart(&mut self) {
        self.first = true;
    }

    /// Writes raw little-endian entries; `bytes` holds whole ones.
    pub(crate) fn put(&mut self, bytes: &[u8], out: &mut impl Write) -> io::Result<()> {
        self.text.clear();
        let width = if self.scalar == Scalar::U64 { 8 } else { 4 };
        for entry in bytes.chunks_exact(width * self.components) {
            self.separate();
            if self.components == 1 {
                push_scalar(&mut self.text, self.scalar, entry);
                continue;
            }
            for (k, number) in entry.chunks_exact(width).enumerate() {
                self.text
                    .extend_from_slice(if k == 0 { b"(" } else { b", " });
                push_scalar(&mut self.text, self.scalar, number);
            }
            self.text.push(b')');
        }
        out.write_all(&self.text)
    }

    fn separate(&mut self) {
        if std::mem::take(&mut self.first) {
            self.on_line = 0;
        } else if self.on_line == ENTRIES_A_LINE {
            self.text.extend_from_slice(b",\n");
            self.on_line = 0;
        } else {
            self.text.extend_from_slice(b", ");
        }
        self.on_line += 1;
    }
}

/// Integers are signed in USD; ids above half of their range come out negative.
fn push_scalar(text: &mut Vec<u8>, scalar: Scalar, bytes: &[u8]) {
    match (scalar, bytes) {
        (Scalar::F32, &[a, b, c, d]) => push_f32(text, f32::from_le_bytes([a, b, c, d])),
        (Scalar::U32, &[a, b, c, d]) => push_int(text, i32::from_le_bytes([a, b, c, d])),
        (Scalar::U64, &[a, b, c, d, e, f, g, h]) => {
            push_int(text, i64::from_le_bytes([a, b, c, d, e, f, g, h]));
        }
        _ => {}
    }
}

/// A [`TextArray`] as a place to pour raw bytes into, in whole entries.
pub(crate) struct ArrayText<'a, W> {
    array: TextArray,
    out: &'a mut W,
}

impl<'a, W: Write> ArrayText<'a, W> {
    /// Writes `array` into `out`.
    pub(crate) fn new(array: TextArray, out: &'a mut W) -> Self {
        Self { array, out }
    }
}

impl<W: Write> Write for ArrayText<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.array.put(bytes, self.out)?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_does_not_depend_on_where_the_pieces_were_cut() {
        let values: Vec<[f32; 3]> = (0..40).map(|i| [i as f32, 0.5, -1.25e-7]).collect();
        let mut whole = Vec::new();
        let mut array = TextArray::new(Scalar::F32, 3);
        array
            .put(bytemuck::cast_slice(&values), &mut whole)
            .unwrap();
        let mut pieces = Vec::new();
        array.restart();
        for piece in values.chunks(7) {
            array.put(bytemuck::cast_slice(piece), &mut pieces).unwrap();
        }
        assert_eq!(whole, pieces);
        let text = String::from_utf8(whole).unwrap();
        assert!(text.starts_with("(0, 0.5, -1.25e-7), (1, 0.5, -1.25e-7), "));
        assert_eq!(text.lines().count(), 3);
    }

    #[test]
    fn integers_are_signed() {
        let mut text = Vec::new();
        let mut array = TextArray::new(Scalar::U64, 1);
        array
            .put(bytemuck::cast_slice(&[7u64, u64::MAX]), &mut text)
            .unwrap();
        assert_eq!(text, b"7, -1");
    }
}

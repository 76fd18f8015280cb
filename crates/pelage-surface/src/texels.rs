//! The numbers of an image, in as many bytes as its file stores them.
//!
//! Codes of 8 and 16 bits stay codes; what each of them means stands in a table, so that
//! undoing sRGB, say, changes the table alone. A map of codes takes a quarter or half of the
//! memory of floats, and where roots lie far apart what a texel costs is waiting for it.

use std::sync::{Arc, LazyLock};

/// Numbers of an image: codes with what they mean, or floats.
#[derive(Clone, Debug, PartialEq)]
pub enum Texels {
    /// 8-bit codes.
    Eight(Codes<u8, 256>),
    /// 16-bit codes.
    Sixteen(Codes<u16, 65536>),
    /// Floats as they are.
    Floats(Vec<f32>),
}

/// Codes and the numbers that they stand for.
#[derive(Clone, Debug, PartialEq)]
pub struct Codes<C, const N: usize> {
    codes: Vec<C>,
    /// One for each code there can be.
    meanings: Arc<[f32; N]>,
}

static EIGHT: LazyLock<Arc<[f32; 256]>> = LazyLock::new(parts);
static SIXTEEN: LazyLock<Arc<[f32; 65536]>> = LazyLock::new(parts);

/// The codes as parts of the largest.
fn parts<const N: usize>() -> Arc<[f32; N]> {
    Arc::new(std::array::from_fn(|code| code as f32 / (N - 1) as f32))
}

impl From<Vec<u8>> for Texels {
    /// Codes as 0..=1.
    fn from(codes: Vec<u8>) -> Self {
        let meanings = EIGHT.clone();
        Self::Eight(Codes { codes, meanings })
    }
}

impl From<Vec<u16>> for Texels {
    /// Codes as 0..=1.
    fn from(codes: Vec<u16>) -> Self {
        let meanings = SIXTEEN.clone();
        Self::Sixteen(Codes { codes, meanings })
    }
}

impl From<Vec<f32>> for Texels {
    fn from(numbers: Vec<f32>) -> Self {
        Self::Floats(numbers)
    }
}

/// Does something with [`Numbers`] whatever they are kept as.
macro_rules! with_numbers {
    ($texels:expr, $numbers:ident => $do:expr) => {
        match $texels {
            Texels::Eight(codes) => {
                let $numbers = codes.numbers();
                $do
            }
            Texels::Sixteen(codes) => {
                let $numbers = codes.numbers();
                $do
            }
            Texels::Floats(floats) => {
                let $numbers = &floats[..];
                $do
            }
        }
    };
}
pub(crate) use with_numbers;

impl Texels {
    /// How many numbers there are.
    pub fn len(&self) -> usize {
        match self {
            Self::Eight(codes) => codes.codes.len(),
            Self::Sixteen(codes) => codes.codes.len(),
            Self::Floats(numbers) => numbers.len(),
        }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number `i`.
    ///
    /// Panics where there is none.
    #[inline(always)]
    pub fn get(&self, i: usize) -> f32 {
        with_numbers!(self, numbers => numbers.number(i))
    }

    /// All numbers.
    ///
    /// ```
    /// use pelage_surface::Texels;
    /// let codes = Texels::from(vec![0u8, 51, 255]);
    /// assert!(codes.iter().eq([0.0, 0.2, 1.0]));
    /// assert_eq!(codes.bytes(), 3);
    /// ```
    pub fn iter(&self) -> impl ExactSizeIterator<Item = f32> + Clone + '_ {
        (0..self.len()).map(|i| self.get(i))
    }

    /// Bytes of the numbers, without the table of what codes mean.
    pub fn bytes(&self) -> usize {
        match self {
            Self::Eight(codes) => codes.codes.len(),
            Self::Sixteen(codes) => codes.codes.len() * 2,
            Self::Floats(numbers) => numbers.len() * 4,
        }
    }

    /// `f` of all numbers.
    pub fn map(&self, f: impl Fn(f32) -> f32) -> Self {
        match self {
            Self::Eight(codes) => Self::Eight(codes.map(f)),
            Self::Sixteen(codes) => Self::Sixteen(codes.map(f)),
            Self::Floats(numbers) => Self::Floats(numbers.iter().map(|&x| f(x)).collect()),
        }
    }

    /// Every `step`-th number from `first` on: one channel of many.
    pub fn every(&self, first: usize, step: usize) -> Self {
        match self {
            Self::Eight(codes) => Self::Eight(codes.every(first, step)),
            Self::Sixteen(codes) => Self::Sixteen(codes.every(first, step)),
            Self::Floats(numbers) => {
                Self::Floats(numbers.iter().skip(first).step_by(step).copied().collect())
            }
        }
    }
}

impl<C: Copy, const N: usize> Codes<C, N> {
    fn map(&self, f: impl Fn(f32) -> f32) -> Self {
        Self {
            codes: self.codes.clone(),
            meanings: Arc::new(self.meanings.map(f)),
        }
    }

    fn every(&self, first: usize, step: usize) -> Self {
        Self {
            codes: self
                .codes
                .iter()
                .skip(first)
                .step_by(step)
                .copied()
                .collect(),
            meanings: self.meanings.clone(),
        }
    }

    #[inline(always)]
    pub(crate) fn numbers(&self) -> Coded<'_, C, N> {
        Coded {
            codes: &self.codes,
            meanings: &self.meanings,
        }
    }
}

/// Numbers in a row, however they are kept.
pub(crate) trait Numbers: Copy {
    /// Number `i`.
    fn number(self, i: usize) -> f32;

    /// How many there are.
    fn count(self) -> usize;

    /// `count` of them from `start` on.
    fn part(self, start: usize, count: usize) -> Self;
}

/// Codes that are read as what they stand for.
#[derive(Clone, Copy)]
pub(crate) struct Coded<'a, C, const N: usize> {
    codes: &'a [C],
    meanings: &'a [f32; N],
}

impl<C: Copy + Into<usize>, const N: usize> Numbers for Coded<'_, C, N> {
    #[inline(always)]
    fn number(self, i: usize) -> f32 {
        self.meanings[self.codes[i].into()]
    }

    #[inline(always)]
    fn count(self) -> usize {
        self.codes.len()
    }

    #[inline(always)]
    fn part(self, start: usize, count: usize) -> Self {
        Self {
            codes: &self.codes[start..][..count],
            ..self
        }
    }
}

impl Numbers for &[f32] {
    #[inline(always)]
    fn number(self, i: usize) -> f32 {
        self[i]
    }

    #[inline(always)]
    fn count(self) -> usize {
        self.len()
    }

    #[inline(always)]
    fn part(self, start: usize, count: usize) -> Self {
        &self[start..][..count]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_stand_for_parts_of_their_largest_and_take_their_own_bytes() {
        let eight = Texels::from((0..=u8::MAX).collect::<Vec<u8>>());
        let sixteen = Texels::from((0..=u16::MAX).collect::<Vec<u16>>());
        assert!(eight.iter().eq((0..256).map(|i| i as f32 / 255.0)));
        assert!(sixteen.iter().eq((0..65536).map(|i| i as f32 / 65535.0)));
        assert_eq!([eight.bytes(), sixteen.bytes()], [256, 131_072]);
        for texels in [eight, sixteen] {
            let (third, squares) = (texels.every(1, 3), texels.map(|x| x * x));
            assert_eq!(squares.bytes(), texels.bytes());
            let floats = Texels::from(texels.iter().collect::<Vec<f32>>());
            assert!(squares.iter().eq(floats.map(|x| x * x).iter()));
            assert!(third.iter().eq(floats.every(1, 3).iter()));
        }
    }
}

//! Long arrays in large pages of memory.
//!
//! A system gives memory when it is first touched, 4 KB at a time, and that takes a third of the
//! making of tables of a million pieces; later each reading far from the last has to look up
//! where its page is. Linux has pages of 2 MB for those who ask.

use bytemuck::Pod;
use std::fmt;
use std::ops::{Deref, DerefMut};

/// An array of numbers.
pub(crate) struct Pages<T> {
    memory: Memory<T>,
    len: usize,
}

enum Memory<T> {
    /// Of the allocator.
    Short(Vec<T>),
    /// Of the system.
    #[cfg(target_os = "linux")]
    Long(memmap2::MmapMut),
}

/// Bytes of a large page.
#[cfg(target_os = "linux")]
const LARGE: usize = 2 << 20;

/// Bytes from which on an array is long.
#[cfg(target_os = "linux")]
const LONG: usize = 2 * LARGE;

impl<T: Pod> Pages<T> {
    pub(crate) fn zeroed(len: usize) -> Self {
        let memory = Memory::zeroed(len);
        Self { memory, len }
    }

    /// Leaves the first `len`, in no more than twice the memory that they take.
    pub(crate) fn truncate(&mut self, len: usize) {
        self.len = len.min(self.len);
        if self.memory.numbers().len() > 2 * self.len {
            *self = self.clone();
        }
    }

    pub(crate) fn extend_from_slice(&mut self, others: &[T]) {
        let mut all = Self::zeroed(self.len + others.len());
        all[..self.len].copy_from_slice(self);
        all[self.len..].copy_from_slice(others);
        *self = all;
    }
}

impl<T: Pod> Memory<T> {
    fn zeroed(len: usize) -> Self {
        // Memory of whole large pages begins where one can begin.
        #[cfg(target_os = "linux")]
        if len.saturating_mul(size_of::<T>()) >= LONG
            && let Some(bytes) = (len * size_of::<T>()).checked_next_multiple_of(LARGE)
            && let Ok(memory) = memmap2::MmapMut::map_anon(bytes)
        {
            // A system without large pages has others.
            let _ = memory.advise(memmap2::Advice::HugePage);
            return Self::Long(memory);
        }
        Self::Short(vec![T::zeroed(); len])
    }

    #[inline(always)]
    fn numbers(&self) -> &[T] {
        match self {
            Self::Short(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Long(memory) => bytemuck::cast_slice(&memory[..whole::<T>(memory)]),
        }
    }

    #[inline(always)]
    fn numbers_mut(&mut self) -> &mut [T] {
        match self {
            Self::Short(numbers) => numbers,
            #[cfg(target_os = "linux")]
            Self::Long(memory) => {
                let bytes = whole::<T>(memory);
                bytemuck::cast_slice_mut(&mut memory[..bytes])
            }
        }
    }
}

/// Bytes of the numbers that fit `memory`.
#[cfg(target_os = "linux")]
fn whole<T>(memory: &[u8]) -> usize {
    memory.len() / size_of::<T>() * size_of::<T>()
}

impl<T: Pod> Deref for Pages<T> {
    type Target = [T];

    #[inline(always)]
    fn deref(&self) -> &[T] {
        &self.memory.numbers()[..self.len]
    }
}

impl<T: Pod> DerefMut for Pages<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.memory.numbers_mut()[..self.len]
    }
}

impl<T: Pod> Default for Pages<T> {
    fn default() -> Self {
        Self::zeroed(0)
    }
}

impl<T> From<Vec<T>> for Pages<T> {
    fn from(numbers: Vec<T>) -> Self {
        Self {
            len: numbers.len(),
            memory: Memory::Short(numbers),
        }
    }
}

impl<T: Pod> Clone for Pages<T> {
    fn clone(&self) -> Self {
        let mut pages = Self::zeroed(self.len);
        pages.copy_from_slice(self);
        pages
    }
}

impl<T: Pod + fmt::Debug> fmt::Debug for Pages<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self[..].fmt(f)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrays_of_any_length_are_zero_and_keep_what_is_written() {
        for len in [0, 1, 1000, 1 << 19, (1 << 20) + 7] {
            let mut pages = Pages::<u64>::zeroed(len);
            assert_eq!(*pages, vec![0; len]);
            for (number, k) in pages.iter_mut().zip(0..) {
                *number = k;
            }
            assert!(pages.clone().iter().copied().eq(0..len as u64));
            pages.extend_from_slice(&[7, 8]);
            assert_eq!(pages[len..], [7, 8]);
            pages.truncate(len / 3);
            assert!(pages.iter().copied().eq(0..len as u64 / 3));
            assert!(pages.memory.numbers().len() <= 2 * pages.len());
        }
    }

    #[test]
    fn an_array_of_the_allocator_is_the_same_array() {
        let pages = Pages::from(vec![3u32, 1, 4]);
        assert_eq!(*pages, [3, 1, 4]);
        assert_eq!(format!("{pages:?}"), "[3, 1, 4]");
    }
}

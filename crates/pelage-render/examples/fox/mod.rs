//! A fox: its shape, its skin and its fur.

mod coat;
mod shape;

pub use coat::fur;
pub use shape::skin;

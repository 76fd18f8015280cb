//! From a `groom.toml` to strands: the recipe, the plan it compiles to, and the
//! pipeline.

pub mod recipe;

//! The stages of the pipeline, one file each, in the order of document 004, 2.2.2.
//!
//! A stage is a pure function over slices: inputs first, outputs last. Its header says
//! what it does, where that comes from, and the space and unit of its arrays.

pub mod clump;
pub mod cut;
pub mod degenerate;
pub mod facing;
pub mod flyaway;
pub mod frames;
pub mod frenet;
pub mod frizz;
pub mod helix;
pub mod interpolate;
pub mod kink;
mod laying;
pub mod length;
pub mod look;
pub mod natural;
pub mod roots;
pub mod scale;
pub mod strand;
pub mod thin;
pub mod tint;
pub mod weights;
pub mod world;

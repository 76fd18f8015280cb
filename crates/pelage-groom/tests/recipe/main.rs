//! Recipes: what is accepted, what is refused and how, and the JSON Schema.

#![allow(
    clippy::unwrap_used,
    reason = "a test stops where its files cannot be read"
)]

mod bad;
mod corpus;
mod generated;
mod good;
mod maker;
mod mutation;
mod schema;
mod typed;

//! Recipes: what is accepted, what is refused and how, and the JSON Schema.

mod bad;
mod corpus;
mod good;
mod mutation;
mod schema;

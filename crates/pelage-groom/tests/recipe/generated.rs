//! Laws of recipes made at random from the schema.

use std::path::Path;

use pelage_groom::recipe::{Recipe, schema};
use proptest::prelude::*;
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::maker::Maker;

/// Whether the value is the same after it was written and read, in JSON and
/// in TOML.
fn survives<T: Serialize + DeserializeOwned + PartialEq>(value: &T) -> Result<bool, TestCaseError> {
    let fail = |error: &dyn std::fmt::Display| TestCaseError::fail(error.to_string());
    let json = serde_json::to_string(value).map_err(|error| fail(&error))?;
    let toml = toml::to_string(value).map_err(|error| fail(&error))?;
    let from_json: T = serde_json::from_str(&json).map_err(|error| fail(&error))?;
    let from_toml: T = toml::from_str(&toml).map_err(|error| fail(&error))?;
    Ok(from_json == *value && from_toml == *value)
}

macro_rules! sections_survive {
    ($recipe:ident: $($section:ident)+) => {
        $(prop_assert!(survives(&$recipe.$section)?, "{:?}", $recipe.$section);)+
    };
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn what_the_schema_allows_is_read_and_survives_being_written(seed in any::<u64>()) {
        let schema = schema();
        let json = Maker::new(&schema, seed).recipe();
        let file = Path::new("groom.toml");

        let text = toml::to_string(&json).unwrap();
        let read = Recipe::parse(&text, file);
        let read = read.map_err(|error| TestCaseError::fail(format!("{text}\n{error}")))?;
        sections_survive!(read: surface guides hair display roots groups interpolation cut scale
            frizz kink clump flyaway color opacity width strand output voxels);
        prop_assert_eq!(&Recipe::parse(&read.to_toml(), file).unwrap(), &read);

        let recipe: Recipe = serde_json::from_value(json).unwrap();
        prop_assert!(survives(&recipe)?, "{recipe:?}");
    }
}

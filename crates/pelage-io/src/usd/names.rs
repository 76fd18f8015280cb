//! Names that paths of `openusd` can hold: it takes paths apart by characters alone, and
//! going up from one that ends in a `}` of its own never ends.

use openusd::sdf::Value;

/// Whether entries of the field `name` become parts of paths when a stage is composed.
pub(super) fn in_paths(name: &str) -> bool {
    let fields = [
        "clips",
        "defaultPrim",
        "layerRelocates",
        "primChildren",
        "propertyChildren",
        "relocates",
        "variantChildren",
        "variantSelection",
        "variantSetChildren",
        "variantSetNames",
    ];
    fields.contains(&name)
}

/// The entry of the field `name` that no path can hold, if there is one.
pub(super) fn wrong(name: &str, value: &Value) -> Option<String> {
    let is_sound = match name {
        "primChildren" => is_prim,
        "propertyChildren" => is_property,
        "defaultPrim" => |name: &str| {
            name.is_empty() || is_prim_path(&format!("/{}", name.trim_start_matches('/')))
        },
        "relocates" | "layerRelocates" => |path: &str| path.is_empty() || is_prim_path(path),
        "variantSelection" => |name: &str| name.is_empty() || is_variant(name),
        _ => is_variant,
    };
    let entries: Vec<String> = match value {
        Value::Token(token) => vec![token.to_string()],
        Value::TokenVec(tokens) => tokens.iter().map(|t| t.to_string()).collect(),
        Value::StringVec(strings) => strings.clone(),
        Value::TokenListOp(list) => list.iter().map(|t| t.to_string()).collect(),
        Value::StringListOp(list) => list.iter().cloned().collect(),
        Value::VariantSelectionMap(map) => map.iter().flat_map(|(k, v)| [k, v]).cloned().collect(),
        Value::Relocates(pairs) => pairs
            .iter()
            .flat_map(|(from, to)| [from.to_string(), to.to_string()])
            .collect(),
        _ => Vec::new(),
    };
    entries.into_iter().find(|entry| !is_sound(entry))
}

/// Whether `name` can be a prim's.
pub(super) fn is_prim(name: &str) -> bool {
    !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || c == '_')
}

/// Whether `name` can be that of a variant or a variant set.
pub(super) fn is_variant(name: &str) -> bool {
    let belongs = |c: char| c.is_alphanumeric() || matches!(c, '_' | '-' | '|' | '.');
    !name.is_empty() && name.chars().all(belongs)
}

/// Whether `name` can be a property's.
pub(super) fn is_property(name: &str) -> bool {
    let belongs = |c: char| c.is_alphanumeric() || matches!(c, '_' | ':');
    !name.is_empty() && name.chars().all(belongs)
}

/// Whether `path` is that of a prim, from the root.
pub(super) fn is_prim_path(path: &str) -> bool {
    let names = path.strip_prefix('/');
    names.is_some_and(|names| names.split('/').all(is_prim))
}

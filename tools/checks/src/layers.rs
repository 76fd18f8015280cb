//! Crates depend downwards only.

use crate::metadata::Metadata;

/// What each crate of ours may depend on, beside crates that are not ours.
const MAY_USE: &[(&str, &[&str])] = &[
    ("pelage-curves", &[]),
    ("pelage-strands", &["pelage-curves"]),
    ("pelage-surface", &["pelage-curves"]),
    (
        "pelage-groom",
        &["pelage-curves", "pelage-strands", "pelage-surface"],
    ),
    (
        "pelage-io",
        &["pelage-curves", "pelage-strands", "pelage-surface"],
    ),
    (
        "pelage-render",
        &["pelage-curves", "pelage-strands", "pelage-surface"],
    ),
    (
        "pelage-examples",
        &["pelage-curves", "pelage-strands", "pelage-surface"],
    ),
    (
        "pelage",
        &[
            "pelage-curves",
            "pelage-strands",
            "pelage-surface",
            "pelage-groom",
            "pelage-io",
            "pelage-render",
            "pelage-examples",
        ],
    ),
    ("checks", &[]),
];

/// Every dependency that points the wrong way, and every crate without a layer.
/// Tests may use more: only normal and build dependencies are looked at.
pub fn problems(metadata: &Metadata) -> Vec<String> {
    let ours: Vec<&str> = metadata.members().map(|p| p.name.as_str()).collect();
    let mut problems = Vec::new();
    for package in metadata.members() {
        let Some((_, allowed)) = MAY_USE.iter().find(|(name, _)| *name == package.name) else {
            problems.push(format!(
                "{}: has no layer; give it one in layers.rs",
                package.name
            ));
            continue;
        };
        for dependency in &package.dependencies {
            let name = dependency.name.as_str();
            let tests = dependency.kind.as_deref() == Some("dev");
            if !tests && ours.contains(&name) && !allowed.contains(&name) {
                problems.push(format!("{} may not depend on {name}", package.name));
            }
        }
    }
    problems
}

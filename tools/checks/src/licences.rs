//! Every dependency has a licence that we may use.

use crate::metadata::Metadata;

/// Licences that ask for no more than their notice.
const ALLOWED: &[&str] = &[
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "CC0-1.0",
    "ISC",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Every package whose licence is missing or not allowed.
pub fn problems(metadata: &Metadata) -> Vec<String> {
    let refused = metadata
        .packages
        .iter()
        .filter(|p| !allowed(p.license.as_deref()));
    refused
        .map(|p| {
            let licence = p.license.as_deref().unwrap_or("none");
            format!(
                "{} {}: its licence is {licence}, which is not allowed",
                p.name, p.version
            )
        })
        .collect()
}

/// Whether an SPDX expression can be met: one of the alternatives, all of whose parts
/// are allowed. `/` is the old way to write OR.
fn allowed(licence: Option<&str>) -> bool {
    let Some(expression) = licence else {
        return false;
    };
    let flat = expression.replace('/', " OR ").replace(['(', ')'], " ");
    // "A AND (B OR C)" read without its brackets is "A AND B OR C": ask for more, not
    // less, by treating a bracketed expression as one that needs every part.
    if expression.contains('(') && expression.contains(" AND ") {
        let mut parts = flat.split(" AND ").map(str::trim);
        return parts.all(|part| part.split(" OR ").any(|l| ALLOWED.contains(&l.trim())));
    }
    flat.split(" OR ")
        .any(|all| all.split(" AND ").all(|l| ALLOWED.contains(&l.trim())))
}

#[cfg(test)]
mod tests {
    use super::allowed;

    #[test]
    fn one_alternative_must_be_allowed_as_a_whole() {
        assert!(allowed(Some("MIT OR GPL-3.0")));
        assert!(allowed(Some("MIT/Apache-2.0")));
        assert!(allowed(Some("(MIT OR Apache-2.0) AND Unicode-3.0")));
        assert!(!allowed(Some("MIT AND GPL-3.0")));
        assert!(!allowed(Some("(MIT OR Apache-2.0) AND GPL-3.0")));
        assert!(!allowed(None));
    }
}

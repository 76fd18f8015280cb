//! `pelage bench`: figures measured again.

use crate::groom::{Folder, pelage};
use serde_json::Value;
use std::collections::BTreeSet;

#[test]
fn measuring_writes_tables_plots_and_data_of_every_method() {
    let folder = Folder::new();
    let (results, data) = (folder.path("results"), folder.path("rows.json"));
    let printed = pelage(&[
        "bench", "sampling", "--quick", "-o", &results, "--json", &data,
    ]);
    for name in ["sampling-grid.svg", "sampling-rates.svg"] {
        let plot = folder.bytes(&format!("results/{name}"));
        assert!(plot.starts_with(b"<svg"), "{name}");
    }
    let page = String::from_utf8(folder.bytes("results/sampling.md")).unwrap();
    assert!(page.contains(printed.trim_end()), "{printed}");
    for heading in ["Rates", "Preprocessing", "Memory", "Threads", "Order"] {
        assert!(page.contains(&format!("\n## {heading}")), "{heading}");
    }

    let rows: Vec<Value> = serde_json::from_slice(&folder.bytes("rows.json")).unwrap();
    let mut methods = BTreeSet::new();
    for row in &rows {
        let row = row.as_object().unwrap();
        let keys: BTreeSet<&str> = row.keys().map(String::as_str).collect();
        assert_eq!(keys, KEYS.into());
        assert!(row["seconds"].as_f64().unwrap() > 0.0);
        methods.insert(row["method"].as_str().unwrap());
    }
    assert_eq!(
        methods,
        ["guided", "bisection", "alias", "rejection"].into()
    );
}

/// What programs that read the data may rely on.
const KEYS: [&str; 10] = [
    "mesh",
    "triangles",
    "map",
    "map_size",
    "method",
    "threads",
    "samples",
    "seconds",
    "preprocess_seconds",
    "bytes",
];

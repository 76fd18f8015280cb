//! `pelage bench`: figures measured again.

use crate::groom::{Folder, pelage};
use serde_json::Value;
use std::collections::BTreeSet;

/// The keys of a row.
fn keys(row: &Value) -> BTreeSet<&str> {
    row.as_object()
        .unwrap()
        .keys()
        .map(String::as_str)
        .collect()
}

#[test]
fn measuring_writes_tables_plots_and_data_of_every_method() {
    let folder = Folder::new();
    let (results, data) = (folder.path("results"), folder.path("rows.json"));
    let printed = pelage(&[
        "bench", "sampling", "--quick", "-o", &results, "--json", &data,
    ]);
    for name in [
        "sampling-grid.svg",
        "sampling-rates.svg",
        "sampling-spectrum.svg",
    ] {
        let plot = folder.bytes(&format!("results/{name}"));
        assert!(plot.starts_with(b"<svg"), "{name}");
    }
    let page = String::from_utf8(folder.bytes("results/sampling.md")).unwrap();
    assert!(page.contains(printed.trim_end()), "{printed}");
    for heading in [
        "Rates",
        "In the order",
        "Preprocessing",
        "Memory",
        "Threads",
        "Order",
        "Blue noise",
    ] {
        assert!(page.contains(&format!("\n## {heading}")), "{heading}");
    }

    let rows: Vec<Value> = serde_json::from_slice(&folder.bytes("rows.json")).unwrap();
    let mut methods = BTreeSet::new();
    for row in &rows {
        assert_eq!(keys(row), SAMPLING.into());
        assert!(row["seconds"].as_f64().unwrap() > 0.0);
        methods.insert(row["method"].as_str().unwrap());
    }
    assert_eq!(
        methods,
        ["guided", "bisection", "alias", "rejection"].into()
    );
}

#[test]
fn measuring_generation_writes_the_page_the_chart_and_data_of_every_scene() {
    let folder = Folder::new();
    let (results, data) = (folder.path("results"), folder.path("rows.json"));
    let printed = pelage(&[
        "bench",
        "generation",
        "--quick",
        "-o",
        &results,
        "--json",
        &data,
    ]);
    let chart = folder.bytes("results/generation-stages.svg");
    assert!(chart.starts_with(b"<svg"));
    let page = String::from_utf8(folder.bytes("results/generation.md")).unwrap();
    assert!(page.contains(printed.trim_end()), "{printed}");

    let rows: Vec<Value> = serde_json::from_slice(&folder.bytes("rows.json")).unwrap();
    let mut scenes = BTreeSet::new();
    for row in &rows {
        assert_eq!(keys(row), GENERATION.into());
        for time in ["seconds_cold", "seconds_warm"] {
            assert!(row[time].as_f64().unwrap() > 0.0, "{time}");
        }
        for stage in pelage::groom::Stage::ALL {
            assert!(row["stages"][stage.name()].is_number(), "{row}");
        }
        scenes.insert((row["scene"].as_str().unwrap(), row["cvs"].as_u64().unwrap()));
    }
    let names = ["plain", "five maps", "strands"].map(|name| {
        let along = format!("{name}, along the surface");
        [name.to_owned(), along]
    });
    let expected = names.iter().flatten();
    let expected = expected.flat_map(|name| [(&name[..], 6), (&name[..], 16)]);
    assert_eq!(scenes, expected.collect());
}

#[test]
fn measuring_curves_writes_the_page_the_pictures_and_the_data() {
    let folder = Folder::new();
    let (results, data) = (folder.path("results"), folder.path("data.json"));
    let printed = pelage(&[
        "bench", "curves", "--quick", "-o", &results, "--json", &data,
    ]);
    for picture in ["curves-errors.svg", "curves-kept.svg", "curves-frames.svg"] {
        let bytes = folder.bytes(&format!("results/{picture}"));
        assert!(bytes.starts_with(b"<svg"), "{picture}");
    }
    let page = String::from_utf8(folder.bytes("results/curves.md")).unwrap();
    assert!(page.contains(printed.trim_end()), "{printed}");

    let data: Value = serde_json::from_slice(&folder.bytes("data.json")).unwrap();
    let rates = data["rates"].as_array().unwrap();
    assert!(rates.iter().all(|row| row["rate"].as_f64().unwrap() > 0.0));
    assert_eq!(data["errors"].as_array().unwrap().len(), 4 * 5);
    assert_eq!(data["mixed"].as_array().unwrap().len(), 2 * 4);
}

/// What programs that read the data of generation may rely on.
const GENERATION: [&str; 9] = [
    "scene",
    "hairs",
    "cvs",
    "fibers",
    "threads",
    "seconds_cold",
    "seconds_warm",
    "stages",
    "peak_bytes",
];

/// What programs that read the data of sampling may rely on.
const SAMPLING: [&str; 10] = [
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

//! The page that explains every property to people.

use super::outline::{KeyOutline, outline};
use super::strips::{STRIPS, Strip};
use std::fmt::Write;

/// What stands before the tables.
const INTRODUCTION: &str = include_str!("page.md");

/// The page of all properties as Markdown, as it is checked in.
pub fn properties_text() -> String {
    let mut text = INTRODUCTION.to_owned();
    for section in outline() {
        let does = &section.does;
        // Writing to a String cannot fail.
        let _ = match section.key.strip_suffix("[]") {
            Some(list) => write!(text, "\n## `[[{list}]]`\n\n{does}\n"),
            None => write!(text, "\n## `[{}]`\n\n{does}\n", section.key),
        };
        if section.keys.is_empty() {
            continue;
        }
        text += "\n| key | what it does | values | default | takes | document 004 |\n\
            |---|---|---|---|---|---|\n";
        section.keys.iter().for_each(|key| text += &row(key));
        let of_section = |strip: &&Strip| section.keys.iter().any(|key| key.key == strip.key);
        STRIPS
            .iter()
            .filter(of_section)
            .for_each(|strip| text += &picture(strip));
    }
    text
}

/// The strip of a property, which `pelage gallery` draws.
fn picture(strip: &Strip) -> String {
    let values: Vec<String> = strip
        .values
        .iter()
        .map(|value| format!("`{value}`"))
        .collect();
    let (key, file) = (strip.key, strip.file());
    format!(
        "\n`{key}`: {}\n\n![{key}](gallery/{file})\n",
        values.join(", ")
    )
}

fn row(key: &KeyOutline) -> String {
    let (_, name) = key.key.rsplit_once('.').unwrap_or(("", &key.key));
    let unit = key.unit.map_or(String::new(), |unit| format!("; {unit}"));
    let default = match (&key.default, key.required) {
        (_, true) => "(required)".to_owned(),
        (Some(default), _) => format!("`{default}`"),
        (None, _) => String::new(),
    };
    let takes = [("map", key.map), ("ramp", key.ramp)];
    let takes: Vec<&str> = takes
        .iter()
        .filter(|(_, takes)| *takes)
        .map(|(what, _)| *what)
        .collect();
    format!(
        "| `{name}` | {} | {}{unit} | {default} | {} | {} |\n",
        cell(&key.does),
        cell(&key.values),
        takes.join(", "),
        key.ancestors.join(", "),
    )
}

/// `text` in one line of a table.
fn cell(text: &str) -> String {
    let lines: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
    lines.join("<br>").replace('|', "\\|")
}

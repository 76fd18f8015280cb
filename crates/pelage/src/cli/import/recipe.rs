//! A recipe made of settings, with what could not be mapped in its comments.

use super::Imported;
use super::dialect::{Dialect, Meaning, Unit, meaning};
use super::settings::{Setting, Settings};
use anyhow::{Context, Result, bail};
use pelage::Recipe;
use pelage::groom::recipe::{ProblemKind, RecipeError, SectionOutline, outline};
use std::collections::BTreeMap;
use std::fmt::{Display, Formatter, Write};
use std::path::Path;

/// More settings than any hair has: the file is something else.
const MOST_SETTINGS: usize = 10_000;

/// What every recipe must name, and no list of parameters does.
const PLACES: &str = "\
[surface]
mesh = \"FILL_IN.obj\"           # the mesh that grows the hair, at rest

[guides]
curves = \"FILL_IN.usda\"        # the guides as curves; or grow some: see docs/properties.md
";

/// Values of an axis that a file leaves out: the default of Stubble's frequencies.
const OTHER_AXES: f64 = 0.5;

/// A setting that the recipe has not, and why.
#[derive(Clone, Debug)]
pub struct LeftOut {
    line: usize,
    text: String,
    /// Whether its name is one of the program's.
    pub known: bool,
}

impl Display for LeftOut {
    fn fmt(&self, f: &mut Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.line, self.text)
    }
}

/// A key with its value.
struct Entry {
    value: String,
    /// What stands behind it.
    from: String,
    line: usize,
    /// Values of single axes, where the file gives those.
    axes: [Option<f64>; 3],
}

/// The recipe of `settings`, which came from the file `name`.
pub fn write(settings: &Settings, from: Dialect, name: &str) -> Result<Imported> {
    if settings.all.len() > MOST_SETTINGS {
        bail!("more than {MOST_SETTINGS} settings: this is no list of parameters of hair");
    }
    let mut making = Making::default();
    for setting in &settings.all {
        making.take(setting, from);
    }
    for &line in &settings.others {
        let text = "another hair: only the first of a scene is imported".to_owned();
        making.left_out.push(LeftOut {
            line,
            text,
            known: true,
        });
    }
    let toml = making.text(from, name);
    Recipe::parse(&toml, Path::new("groom.toml")).context("the recipe that was made is wrong")?;
    Ok(Imported {
        toml,
        mapped: making.entries.len(),
        left_out: making.left_out,
    })
}

#[derive(Default)]
struct Making {
    entries: BTreeMap<String, Entry>,
    left_out: Vec<LeftOut>,
}

impl Making {
    fn take(&mut self, setting: &Setting, from: Dialect) {
        let known = match meaning(from, &setting.name) {
            Some(Meaning::Key(key, unit)) => match self.set(&key, unit, setting) {
                Ok(()) => return,
                Err(why) => Some(why),
            },
            Some(Meaning::Unsure(key, why)) => Some(format!("perhaps {key}, but {why}")),
            Some(Meaning::Without(why)) => Some(why.to_owned()),
            None => None,
        };
        let why = known
            .clone()
            .unwrap_or(format!("not known as a name of {from}"));
        self.leave_out(setting, &why, known.is_some());
    }

    fn leave_out(&mut self, setting: &Setting, why: &str, known: bool) {
        let text = format!("{}: {why}", written(setting));
        let line = setting.line;
        self.left_out.push(LeftOut { line, text, known });
    }

    /// Gives `key` the value of `setting`, or says why it cannot have it.
    fn set(&mut self, key: &str, unit: Unit, setting: &Setting) -> Result<(), String> {
        let numbers = numbers(setting, unit).ok_or("expected numbers")?;
        let (key, axis) = split_axis(key);
        let mut axes = self.entries.get(key).map_or([None; 3], |entry| entry.axes);
        let numbers = match (axis, &numbers[..]) {
            (Some(axis), [number]) => {
                axes[axis] = Some(*number);
                axes.map(|number| number.unwrap_or(OTHER_AXES)).to_vec()
            }
            (Some(_), _) => return Err("expected one number".into()),
            (None, _) => numbers,
        };
        let value = accepted(key, &numbers)?;
        let converted = match unit {
            Unit::Same => "",
            Unit::Radians => ", from radians",
        };
        let entry = Entry {
            value,
            from: format!("{}, line {}{converted}", written(setting), setting.line),
            line: setting.line,
            axes,
        };
        let before = self.entries.insert(key.to_owned(), entry);
        if let Some(before) = before.filter(|_| axis.is_none()) {
            let text = format!("{key} is set again in line {}", setting.line);
            let (line, known) = (before.line, true);
            self.left_out.push(LeftOut { line, text, known });
        }
        Ok(())
    }

    fn text(&mut self, from: Dialect, name: &str) -> String {
        self.left_out.sort_by_key(|left| left.line);
        let mut text = format!(
            "# Imported by `pelage import` from {}: parameters of {from}.\n\
             # Lengths are in the unit of the mesh, colours were taken as linear RGB. A value\n\
             # that the other program had at its default may be missing from its file, and its\n\
             # defaults are not those of Pelage.\n\n{PLACES}",
            printable(name),
        );
        for section in outline() {
            text += &self.section(&section);
        }
        if !self.left_out.is_empty() {
            text += "\n# Not mapped, by line:\n";
        }
        for left in &self.left_out {
            let _ = writeln!(text, "#   {left}");
        }
        text
    }

    /// The keys of `section`.
    fn section(&self, section: &SectionOutline) -> String {
        let entry = |key: &str| self.entries.get(key);
        let found = section.keys.iter();
        let found = found.filter_map(|key| Some((&key.key, entry(&key.key)?)));
        let found: Vec<(&String, &Entry)> = found.collect();
        if found.is_empty() {
            return String::new();
        }
        let mut text = format!("\n[{}]\n", section.key);
        for (key, Entry { value, from, .. }) in found {
            let name = key.rsplit_once('.').map_or(key.as_str(), |(_, name)| name);
            text += &format!("{name} = {value}  # {from}\n");
        }
        text
    }
}

/// The values of `setting` in the unit that keys have.
fn numbers(setting: &Setting, unit: Unit) -> Option<Vec<f64>> {
    let convert = |number: f64| match unit {
        Unit::Same => number,
        Unit::Radians => number.to_degrees(),
    };
    let numbers = setting
        .values
        .iter()
        .map(|value| number(value).map(convert));
    numbers.collect()
}

/// `key[i]` as key and axis.
fn split_axis(key: &str) -> (&str, Option<usize>) {
    let parts = key.strip_suffix(']').and_then(|key| key.rsplit_once('['));
    let axis = parts
        .and_then(|(_, axis)| axis.parse().ok())
        .filter(|axis| *axis < 3);
    match (parts, axis) {
        (Some((key, _)), Some(axis)) => (key, Some(axis)),
        _ => (key, None),
    }
}

fn number(word: &str) -> Option<f64> {
    match word.to_ascii_lowercase().as_str() {
        "yes" | "on" | "true" => Some(1.0),
        "no" | "off" | "false" => Some(0.0),
        word => word.parse().ok().filter(|number: &f64| number.is_finite()),
    }
}

/// `numbers` as the value that `key` takes, or why there is none.
fn accepted(key: &str, numbers: &[f64]) -> Result<String, String> {
    let mut forms = Vec::new();
    // Several groups with the same number share it.
    if let Some((first, rest)) = numbers.split_first()
        && rest.iter().all(|number| number == first)
    {
        forms.push(decimal(*first));
        forms.push((*first != 0.0).to_string());
    }
    if numbers.len() == 3 {
        let all: Vec<String> = numbers.iter().map(|number| decimal(*number)).collect();
        forms.insert(0, format!("[{}]", all.join(", ")));
    }
    let mut why = None;
    for form in forms {
        let text = format!("surface.mesh = 'm'\nguides.curves = 'g'\n{key} = {form}\n");
        match Recipe::parse(&text, Path::new("")) {
            Ok(_) => return Ok(form),
            Err(error) => why = better(why, error),
        }
    }
    let why = why.map_or("expected one number".into(), |error| {
        error.first().message.clone()
    });
    Err(format!("{key}: {why}"))
}

/// Of the reasons against two forms, that against the form of the right type.
fn better(why: Option<RecipeError>, other: RecipeError) -> Option<RecipeError> {
    match why {
        Some(why) if why.first().kind == ProblemKind::OutOfRange => Some(why),
        Some(why) if other.first().kind != ProblemKind::OutOfRange => Some(why),
        _ => Some(other),
    }
}

/// A number as TOML: whole ones without a point, which every key takes.
fn decimal(number: f64) -> String {
    // Beyond, a double is whole but for its digits.
    if number.fract() == 0.0 && number.abs() < 1e15 {
        return format!("{number:.0}");
    }
    format!("{:?}", number)
}

/// Name and values of a setting, short and fit for a comment.
fn written(setting: &Setting) -> String {
    let values: Vec<&str> = setting.values.iter().take(4).map(String::as_str).collect();
    let more = if setting.values.len() > 4 { " …" } else { "" };
    printable(&format!("{} {}{more}", setting.name, values.join(" ")))
}

fn printable(text: &str) -> String {
    let shown = |c: char| if c.is_control() { ' ' } else { c };
    text.chars().take(100).map(shown).collect()
}

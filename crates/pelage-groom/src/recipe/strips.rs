//! What the gallery shows of each property: a strip of pictures, from low to high.

/// What hair a strip is shown on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// A furry ball.
    Fur,
    /// Some hundred long hairs on a square.
    Tuft,
    /// A few multi-strands on a square.
    Strands,
}

/// A strip of pictures that differ in one property.
#[derive(Clone, Copy, Debug)]
pub struct Strip {
    /// Dotted key of the property, as [`outline`](super::outline()) has it.
    pub key: &'static str,
    /// What is shown.
    pub on: Subject,
    /// Keys and values that differ from the subject's in all pictures.
    pub with: &'static [(&'static str, &'static str)],
    /// The line that sets the property, `{}` in the place of its value; empty where that
    /// is the key with the value.
    pub line: &'static str,
    /// Values as TOML, picture by picture.
    pub values: &'static [&'static str],
}

impl Strip {
    /// Name of its file in the gallery.
    pub fn file(&self) -> String {
        format!("{}.jpg", self.key.replace("[]", ""))
    }

    /// The line of a recipe that sets the property to `value`: key and value.
    pub fn line(&self, value: &str) -> (String, String) {
        let line = match self.line {
            "" => format!("{} = {value}", self.key),
            line => line.replace("{}", value),
        };
        let (key, value) = line.split_once(" = ").unwrap_or((&line, ""));
        (key.to_owned(), value.to_owned())
    }
}

/// Keys that change no picture, or name what the pictures are made of.
pub const WITHOUT_STRIP: [&str; 11] = [
    "surface.mesh",
    "surface.posed",
    "surface.up",
    "surface.meters_per_unit",
    "guides.curves",
    "guides.posed",
    "guides.tolerance",
    "groups.map",
    "display.count",
    "output.normals",
    "voxels.resolution",
];

const fn strip(key: &'static str, on: Subject, values: &'static [&'static str]) -> Strip {
    Strip {
        key,
        on,
        with: &[],
        line: "",
        values,
    }
}

impl Strip {
    const fn with(mut self, with: &'static [(&'static str, &'static str)]) -> Self {
        self.with = with;
        self
    }

    const fn line_is(mut self, line: &'static str) -> Self {
        self.line = line;
        self
    }
}

use Subject::{Fur, Strands, Tuft};

/// Few guides that lean as patches of a map say.
const COARSE: &[(&str, &str)] = &[("guides.grow.count", "40"), UNLIKE];
const UNLIKE: (&str, &str) = ("guides.grow.lean", "{ value = 110.0, map = 'patches.png' }");
const OFF_AND_ON: &[&str] = &["false", "true"];
const FRIZZED: &[(&str, &str)] = &[("frizz.tip", "0.25")];
const UNEVEN: &[(&str, &str)] = &[("frizz.frequency", "[4, 4, 4]")];
const MOVING: &[(&str, &str)] = &[
    ("frizz.tip", "0.25"),
    ("frizz.animation.amount", "1.0"),
    ("frizz.animation.speed", "0.05"),
];
const KINKED: &[(&str, &str)] = &[("kink.tip", "0.08"), ("kink.frequency", "[8, 8, 8]")];
const CURLY: &[(&str, &str)] = &[
    ("guides.grow.curl.radius", "0.06"),
    ("guides.grow.curl.turns", "4.0"),
    ("groups.segments", "32"),
];
const FEW_CURLS: &[(&str, &str)] = &[
    ("guides.grow.count", "6"),
    ("guides.grow.curl.radius", "0.08"),
    ("guides.grow.curl.turns", "3.0"),
    ("groups.segments", "32"),
    ("hair.count", "60"),
];
const BENT: &[(&str, &str)] = &[
    ("guides.grow.segments", "64"),
    ("groups.segments", "64"),
    ("guides.grow.bend.torsion", "900.0"),
];
const SPREAD: &[(&str, &str)] = &[
    ("strand.splay.root", "0.01"),
    ("strand.splay.center", "0.06"),
    ("strand.splay.tip", "0.03"),
];

/// Every strip, in the order of the properties.
pub const STRIPS: &[Strip] = &[
    strip("guides.grow.count", Fur, &["3", "30", "300", "3000"]).with(&[UNLIKE]),
    strip("guides.grow.seed", Tuft, &["0", "1", "2", "3"]),
    strip("guides.grow.length", Fur, &["0.1", "0.2", "0.4", "0.8"]),
    strip("guides.grow.segments", Tuft, &["1", "2", "4", "16"]).with(CURLY),
    strip("guides.grow.lean", Fur, &["0.0", "30.0", "60.0", "90.0"]),
    strip(
        "guides.grow.comb",
        Fur,
        &["[0, -1, 0]", "[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"],
    ),
    strip(
        "guides.grow.curl.radius",
        Tuft,
        &["0.0", "0.02", "0.05", "0.1"],
    )
    .with(CURLY),
    strip(
        "guides.grow.curl.turns",
        Tuft,
        &["0.0", "1.0", "3.0", "6.0"],
    )
    .with(CURLY),
    strip(
        "guides.grow.bend.curvature",
        Tuft,
        &["90.0", "360.0", "1500.0", "{ ramp = [[0, 0], [1, 1500]] }"],
    )
    .with(BENT),
    strip(
        "guides.grow.bend.torsion",
        Tuft,
        &["0.0", "360.0", "1500.0", "4000.0"],
    )
    .with(&[
        ("guides.grow.bend.curvature", "1500.0"),
        ("guides.grow.segments", "64"),
        ("groups.segments", "64"),
    ]),
    strip(
        "guides.grow.bend.roll",
        Tuft,
        &["0.0", "90.0", "180.0", "270.0"],
    )
    .with(&[("guides.grow.bend.curvature", "120.0")]),
    strip(
        "guides.grow.bend.random",
        Tuft,
        &["0.0", "0.1", "0.4", "1.0"],
    )
    .with(&[("guides.grow.bend.curvature", "120.0")]),
    strip("hair.count", Fur, &["500", "2_000", "8_000", "32_000"]),
    strip("hair.seed", Tuft, &["0", "1", "2", "3"]),
    strip(
        "roots.density",
        Fur,
        &["1.0", "{ map = 'gradient.png' }", "{ map = 'spots.png' }"],
    ),
    strip(
        "roots.pattern",
        Fur,
        &["'random'", "'stratified'", "'blue-noise'"],
    )
    .with(&[("hair.count", "1500"), ("guides.grow.length", "0.12")]),
    strip(
        "roots.displacement",
        Fur,
        &["0.0", "0.1", "{ value = 0.3, map = 'gradient.png' }"],
    ),
    strip("groups.segments", Tuft, &["1", "3", "8", "32"]).with(&[
        ("guides.grow.curl.radius", "0.06"),
        ("guides.grow.curl.turns", "4.0"),
    ]),
    strip("interpolation.guides", Fur, &["1", "2", "3", "12"]).with(COARSE),
    strip(
        "interpolation.method",
        Fur,
        &["'nearest'", "'inverse-distance'", "'natural-neighbor'"],
    )
    .with(COARSE),
    strip(
        "interpolation.space",
        Tuft,
        &["'vertices'", "'frenet'", "'helix'"],
    )
    .with(FEW_CURLS),
    strip("interpolation.elements", Tuft, &["1", "2", "4", "8"]).with(&[
        ("interpolation.space", "'helix'"),
        (
            "guides.grow.bend.curvature",
            "{ ramp = [[0, 0], [0.5, 1500], [1, 0]] }",
        ),
        ("guides.grow.bend.torsion", "900.0"),
        ("guides.grow.segments", "64"),
        ("groups.segments", "64"),
    ]),
    strip("interpolation.facing", Fur, OFF_AND_ON).with(COARSE),
    strip("cut.length", Tuft, &["0.25", "0.5", "0.75", "1.0"]),
    strip("scale.amount", Fur, &["0.25", "0.5", "1.0", "1.5"]),
    strip("scale.random", Tuft, &["0.0", "0.33", "0.67", "1.0"]),
    strip(
        "frizz.frequency",
        Tuft,
        &["[1, 1, 1]", "[3, 3, 3]", "[9, 9, 9]", "[50, 50, 50]"],
    )
    .with(FRIZZED),
    strip("frizz.root", Tuft, &["0.0", "0.1", "0.2", "0.4"]).with(UNEVEN),
    strip("frizz.tip", Tuft, &["0.0", "0.1", "0.25", "0.5"]).with(UNEVEN),
    strip("frizz.preserve_length", Tuft, OFF_AND_ON)
        .with(&[("frizz.tip", "0.6"), ("frizz.frequency", "[4, 4, 4]")]),
    strip(
        "frizz.animation.amount",
        Tuft,
        &["0.0", "0.33", "0.67", "1.0"],
    )
    .with(MOVING),
    strip(
        "frizz.animation.speed",
        Tuft,
        &["0.0", "0.01", "0.03", "0.1"],
    )
    .with(MOVING),
    strip(
        "frizz.animation.direction",
        Tuft,
        &["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 1]"],
    )
    .with(MOVING),
    strip(
        "kink.frequency",
        Tuft,
        &["[2, 2, 2]", "[5, 5, 5]", "[15, 15, 15]", "[40, 40, 40]"],
    )
    .with(KINKED),
    strip("kink.root", Tuft, &["0.0", "0.02", "0.05", "0.1"])
        .with(&[("kink.frequency", "[8, 8, 8]")]),
    strip("kink.tip", Tuft, &["0.0", "0.03", "0.08", "0.2"]).with(KINKED),
    strip("kink.preserve_length", Tuft, OFF_AND_ON)
        .with(&[("kink.tip", "0.2"), ("kink.frequency", "[8, 8, 8]")]),
    strip(
        "clump.levels[].around",
        Fur,
        &[
            "'points', size = 0.15",
            "'guides'",
            "'map', map = 'patches.png'",
        ],
    )
    .line_is("clump.levels = [{ around = {} }]"),
    strip("clump.levels[].size", Fur, &["0.05", "0.1", "0.2", "0.4"])
        .line_is("clump.levels = [{ size = {} }]"),
    strip("clump.levels[].map", Fur, &["'patches.png'"])
        .line_is("clump.levels = [{ around = 'map', map = {} }]"),
    strip("clump.levels[].root", Fur, &["0.0", "0.33", "0.67", "1.0"])
        .line_is("clump.levels = [{ size = 0.15, tip = 0.8, root = {} }]"),
    strip("clump.levels[].tip", Fur, &["0.0", "0.33", "0.67", "1.0"])
        .line_is("clump.levels = [{ size = 0.15, tip = {} }]"),
    strip(
        "clump.levels[].random",
        Fur,
        &["0.0", "0.33", "0.67", "1.0"],
    )
    .line_is("clump.levels = [{ size = 0.15, random = {} }]"),
    strip("clump.levels[].preserve_length", Fur, OFF_AND_ON)
        .line_is("clump.levels = [{ size = 0.4, preserve_length = {} }]"),
    strip("flyaway.percent", Fur, &["0.0", "2.0", "10.0", "50.0"])
        .with(&[("clump.levels", "[{ size = 0.12 }]")]),
    strip("flyaway.strength", Fur, &["0.0", "0.3", "1.0", "3.0"]).with(&[
        ("flyaway.percent", "15.0"),
        ("clump.levels", "[{ size = 0.12 }]"),
    ]),
    strip(
        "color.root",
        Fur,
        &["'#2a1a10'", "'#7a3010'", "'#c09040'", "'#303080'"],
    ),
    strip(
        "color.tip",
        Fur,
        &["'#2a1a10'", "'#7a3010'", "'#e0c080'", "'#6060e0'"],
    ),
    strip("color.space", Tuft, &["'hsv'", "'oklab'", "'rgb'"])
        .with(&[("color.root", "'#c02020'"), ("color.tip", "'#20c0c0'")]),
    strip("color.mutant.percent", Fur, &["0.0", "5.0", "25.0", "75.0"])
        .with(&[("color.mutant.color", "[0.8, 0.8, 0.75]")]),
    strip(
        "color.mutant.color",
        Fur,
        &["'#f0f0f0'", "'#c02020'", "'#101010'"],
    )
    .with(&[("color.mutant.percent", "20.0")]),
    strip(
        "color.variation.hue",
        Fur,
        &["0.0", "15.0", "60.0", "180.0"],
    ),
    strip(
        "color.variation.saturation",
        Fur,
        &["0.0", "0.2", "0.5", "1.0"],
    ),
    strip("color.variation.value", Fur, &["0.0", "0.1", "0.3", "0.6"]),
    strip("opacity.root", Tuft, &["0.05", "0.2", "0.5", "1.0"]).with(&[("opacity.tip", "0.05")]),
    strip("opacity.tip", Tuft, &["0.0", "0.2", "0.5", "1.0"]),
    strip("width.root", Tuft, &["0.002", "0.006", "0.015", "0.04"]),
    strip("width.tip", Tuft, &["0.0", "0.005", "0.015", "0.04"]),
    strip("strand.count", Strands, &["1", "4", "16", "64"]).with(SPREAD),
    strip(
        "strand.twist",
        Strands,
        &["0.0", "180.0", "720.0", "2160.0"],
    )
    .with(SPREAD),
    strip("strand.aspect", Strands, &["0.0", "0.3", "1.0", "2.5"]).with(SPREAD),
    strip("strand.offset", Strands, &["-0.2", "0.0", "0.2", "0.5"]).with(SPREAD),
    strip("strand.randomize", Strands, &["0.0", "0.3", "0.6", "1.0"]).with(SPREAD),
    strip(
        "strand.splay.root",
        Strands,
        &["0.0", "0.02", "0.05", "0.1"],
    ),
    strip(
        "strand.splay.center",
        Strands,
        &["0.0", "0.02", "0.05", "0.1"],
    ),
    strip("strand.splay.tip", Strands, &["0.0", "0.02", "0.05", "0.1"]),
    strip("strand.splay.preserve_length", Strands, OFF_AND_ON)
        .with(&[("strand.splay.center", "0.12"), ("strand.twist", "720.0")]),
    strip(
        "output.skip_threshold",
        Tuft,
        &["1.0", "0.98", "0.9", "0.5"],
    )
    .with(CURLY),
];

#[cfg(test)]
mod tests {
    use super::super::outline;
    use super::*;

    #[test]
    fn every_property_has_one_strip_or_needs_none() {
        let sections = outline();
        let keys = sections.iter().flat_map(|section| &section.keys);
        let mut strips = STRIPS.iter().map(|strip| strip.key);
        for key in keys.filter(|key| !WITHOUT_STRIP.contains(&key.key.as_str())) {
            assert_eq!(strips.next(), Some(key.key.as_str()), "in this order");
        }
        assert_eq!(strips.next(), None);
    }

    #[test]
    fn a_line_is_a_key_and_a_value() {
        for strip in STRIPS {
            for value in strip.values {
                let (key, text) = strip.line(value);
                assert!(strip.key.starts_with(&key), "{}", strip.key);
                assert!(text.contains(value), "{text}");
            }
        }
    }
}

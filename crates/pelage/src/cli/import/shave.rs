//! The names of Shave and a Haircut's Maya node, by their long names.
//!
//! Public scripts list the names; of few is the unit public too. Only those are mapped.
//! The short names in which Maya writes scenes are not public, so they are not known here.

use super::dialect::{Meaning, Unit};

/// Names with a meaning and a unit that are certain.
const KEYS: [(&str, &str); 9] = [
    ("hairCount", "hair.count"),
    ("hairSegments", "groups.segments"),
    ("rootColor", "color.root"),
    // Shave's hair colour is the one at the tip.
    ("hairColor", "color.tip"),
    ("mutantHairColor", "color.mutant.color"),
    ("percentMutantHairs", "color.mutant.percent"),
    ("percentMutantHair", "color.mutant.percent"),
    ("multiStrandCount", "strand.count"),
    ("displayHairMax", "display.count"),
];

const SCALE: &str = "whether it is a fraction or per cent is not known";
const HUE: &str = "whether it is in degrees or per cent is not known";
const WIDTH: &str = "whether it is a radius or a diameter, and its unit, are not known";
const AMOUNT: &str = "the unit of its amounts is not known";
const NOISE: &str = "its noise is another, so the same frequency looks different";

const UNSURE: [(&str, &str, &str); 27] = [
    ("scale", "scale.amount", SCALE),
    ("randScale", "scale.random", SCALE),
    ("rootThickness", "width.root", WIDTH),
    ("tipThickness", "width.tip", WIDTH),
    ("displacement", "roots.displacement", AMOUNT),
    ("hueVariation", "color.variation.hue", HUE),
    ("valueVariation", "color.variation.value", SCALE),
    ("rootFrizz", "frizz.root", AMOUNT),
    ("tipFrizz", "frizz.tip", AMOUNT),
    ("frizzXFrequency", "frizz.frequency", NOISE),
    ("frizzYFrequency", "frizz.frequency", NOISE),
    ("frizzZFrequency", "frizz.frequency", NOISE),
    ("frizzAnim", "frizz.animation.amount", AMOUNT),
    ("rootKink", "kink.root", AMOUNT),
    ("tipKink", "kink.tip", AMOUNT),
    ("kinkXFrequency", "kink.frequency", NOISE),
    ("kinkYFrequency", "kink.frequency", NOISE),
    ("kinkZFrequency", "kink.frequency", NOISE),
    ("rootSplay", "strand.splay.root", AMOUNT),
    ("centerSplay", "strand.splay.center", AMOUNT),
    ("tipSplay", "strand.splay.tip", AMOUNT),
    ("randomizeMulti", "strand.randomize", SCALE),
    ("twist", "strand.twist", "its unit is not known"),
    ("offset", "strand.offset", AMOUNT),
    ("aspect", "strand.aspect", AMOUNT),
    (
        "tipFade",
        "opacity.tip",
        "how much it fades is not known; 0 fades wholly",
    ),
    (
        "displayHairRatio",
        "display.count",
        "it is a share, not a number",
    ),
];

const SHADER: &str = "how hair reflects light is the shader's, not the hair's";
const DISPLAY: &str = "it is about the viewport";

const WITHOUT: [(&str, &str); 14] = [
    ("hairPasses", "hairs are made once, not in passes"),
    ("specular", SHADER),
    ("specularTint", SHADER),
    ("gloss", SHADER),
    ("amb/diff", SHADER),
    ("selfShadow", SHADER),
    ("geomShadow", SHADER),
    ("overrideGeomShader", SHADER),
    ("active", DISPLAY),
    ("displayGuides", DISPLAY),
    ("displayAs", DISPLAY),
    ("displaySegmentLimit", DISPLAY),
    ("interpolateGuides", "guides are always interpolated"),
    (
        "instancingStatus",
        "hairs are curves, not instances of a mesh",
    ),
];

/// What a name means, whatever its case.
pub fn meaning(name: &str) -> Option<Meaning> {
    let is = |known: &str| known.eq_ignore_ascii_case(name);
    if let Some((_, key)) = KEYS.iter().find(|(known, _)| is(known)) {
        return Some(Meaning::Key((*key).to_owned(), Unit::Same));
    }
    if let Some((_, key, why)) = UNSURE.iter().find(|(known, ..)| is(known)) {
        return Some(Meaning::Unsure(key, why));
    }
    let (_, why) = WITHOUT.iter().find(|(known, _)| is(known))?;
    Some(Meaning::Without(why))
}

#[cfg(test)]
/// The keys of ours that are named here.
pub fn keys() -> impl Iterator<Item = &'static str> {
    let unsure = UNSURE.iter().map(|(_, key, _)| *key);
    KEYS.iter().map(|(_, key)| *key).chain(unsure)
}

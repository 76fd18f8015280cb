//! Which keys wait for a stage that is not there yet. A stage that arrives
//! takes its lines out of this table.

use super::Recipe;
use super::entry::{Entry, Leaf};
use super::excerpt::Place;

/// A key whose stage is missing.
struct Waiting {
    key: &'static str,
    /// What is not there, as a sentence begins.
    stage: &'static str,
}

const fn waiting(key: &'static str, stage: &'static str) -> Waiting {
    Waiting { key, stage }
}

/// Every key that switches a missing stage on. Keys that do nothing alone, such
/// as `frizz.frequency` while both amounts are 0, need no line.
const WAITING: &[Waiting] = &[];

/// Whether values along a strand can be given as ramps.
pub(super) const RAMPS: bool = false;

/// The stage that `key` waits for, if it does.
pub(super) fn missing(key: &str) -> Option<&'static str> {
    let waiting = WAITING.iter().find(|waiting| waiting.key == key)?;
    Some(waiting.stage)
}

/// A key of a recipe whose stage does not exist yet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unbuilt {
    /// Dotted key.
    pub key: String,
    /// Place of its value, if the recipe was read from text.
    pub place: Option<Place>,
    /// What is missing and what to do about it.
    pub message: String,
}

impl Recipe {
    /// Keys set to something that needs a stage this version does not have.
    ///
    /// Empty for every recipe from [`Recipe::parse`], which refuses such keys.
    ///
    /// ```
    /// use pelage_groom::recipe::{Recipe, ScalarProperty};
    ///
    /// let mut recipe = Recipe::default();
    /// assert!(recipe.unbuilt().is_empty());
    /// recipe.strand.count = 5;
    /// assert!(recipe.unbuilt().iter().all(|unbuilt| unbuilt.key == "strand.count"));
    /// ```
    pub fn unbuilt(&self) -> Vec<Unbuilt> {
        let standard = Recipe::default();
        let mut defaults = Vec::new();
        standard.walk("", "", &mut |leaf| defaults.push(leaf));
        let mut found = Vec::new();
        self.walk("", "", &mut |leaf| {
            let default = defaults.iter().find(|default| default.key == leaf.key);
            let message = default.and_then(|default| unbuilt(&leaf, default));
            found.extend(message.map(|message| Unbuilt {
                place: self.place(&leaf.key),
                key: leaf.key,
                message,
            }));
        });
        found
    }
}

/// Why the value of `leaf` cannot be had yet, if it cannot.
fn unbuilt(leaf: &Leaf<'_>, default: &Leaf<'_>) -> Option<String> {
    let neutral = default.text.as_deref().unwrap_or_default();
    if leaf.ramp && !RAMPS {
        let advice = "give root and tip a value each";
        return Some(format!(
            "not there yet: ramps come in a later version; {advice}"
        ));
    }
    let waiting = WAITING.iter().find(|waiting| waiting.key == leaf.key)?;
    let text = leaf.text.as_deref().unwrap_or_default();
    if text == neutral || (leaf.zero && default.zero) {
        return None;
    }
    let stage = waiting.stage;
    Some(format!(
        "not there yet: {stage} comes in a later version; \
         remove the key or set it to {neutral} (its neutral value)"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_waiting_key_is_a_key_of_the_recipe() {
        let mut keys = Vec::new();
        Recipe::default().walk("", "", &mut |leaf| keys.push(leaf.key));
        for waiting in WAITING {
            assert!(keys.iter().any(|key| key == waiting.key), "{}", waiting.key);
        }
    }
}

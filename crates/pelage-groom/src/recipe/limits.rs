//! What a number may be: one value serves the check, the error and the schema.

use serde_json::{Map, Value, json};

/// An interval of allowed numbers; `None` is open-ended.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Limits {
    min: Option<f64>,
    max: Option<f64>,
    /// Whether `min` itself is left out.
    above: bool,
}

impl Limits {
    /// Any finite number.
    pub(crate) const ANY: Self = Self {
        min: None,
        max: None,
        above: false,
    };

    /// `min..`, the end included.
    pub(crate) const fn at_least(min: f64) -> Self {
        Self {
            min: Some(min),
            max: None,
            above: false,
        }
    }

    /// `min..max`, both ends included.
    pub(crate) const fn between(min: f64, max: f64) -> Self {
        Self {
            min: Some(min),
            max: Some(max),
            above: false,
        }
    }

    /// Everything above `min`.
    pub(crate) const fn above(min: f64) -> Self {
        Self {
            min: Some(min),
            max: None,
            above: true,
        }
    }

    /// Whether `number` is finite and allowed.
    pub(crate) fn allow(&self, number: f64) -> bool {
        let high_enough = |min| {
            if self.above {
                number > min
            } else {
                number >= min
            }
        };
        number.is_finite()
            && self.min.is_none_or(high_enough)
            && self.max.is_none_or(|max| number <= max)
    }

    /// `noun` with the interval, as errors write it: "a number 0..1".
    pub(crate) fn describe(&self, noun: &str) -> String {
        match (self.min, self.max) {
            (None, None) => noun.to_owned(),
            (Some(min), None) if self.above => format!("{noun} above {min}"),
            (Some(min), None) => format!("{noun} {min}.."),
            (Some(min), Some(max)) => format!("{noun} {min}..{max}"),
            (None, Some(max)) => format!("{noun} up to {max}"),
        }
    }

    /// The keywords of a JSON Schema.
    pub(crate) fn schema(&self, kind: &str) -> Map<String, Value> {
        let mut schema = Map::new();
        schema.insert("type".into(), json!(kind));
        let number = |x: f64| {
            if x.fract() == 0.0 {
                json!(x as i64)
            } else {
                json!(x)
            }
        };
        if let Some(min) = self.min {
            let keyword = if self.above {
                "exclusiveMinimum"
            } else {
                "minimum"
            };
            schema.insert(keyword.into(), number(min));
        }
        if let Some(max) = self.max {
            schema.insert("maximum".into(), number(max));
        }
        schema
    }
}

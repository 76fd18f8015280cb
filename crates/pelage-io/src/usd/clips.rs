//! Checks value clips before `openusd` lists them.
//!
//! A template (`frame.###.usd`, from a time to a time, by a stride) is written out as
//! one name for every step: without end where a step is too small to move the time.

use super::cursor::Broken;
use openusd::sdf::{Path, Value};

/// Names that the templates of one prim may stand for.
const MAX_CLIPS: f64 = 100_000.0;

/// Largest time and smallest step: steps move times of this size.
const MAX_TIME: f64 = 1e9;
const MIN_STRIDE: f64 = 1e-4;

/// Bytes of a template's name.
const MAX_NAME: usize = 1024;

/// Fails where the `clips` of `prim` stand for too many names.
pub(super) fn check(prim: &Path, clips: &Value) -> Result<(), Broken> {
    let Value::Dictionary(sets) = clips else {
        return Ok(());
    };
    let mut all = 0.0;
    for (name, set) in sets {
        let Value::Dictionary(set) = set else {
            continue;
        };
        let asset = match set.get("templateAssetPath") {
            Some(Value::String(name)) => name.len(),
            Some(Value::Token(name)) => name.len(),
            Some(Value::AssetPath(name)) => name.to_string().len(),
            _ => 0,
        };
        if asset > MAX_NAME {
            return Err(Broken(format!(
                "{prim} has a clip template of {asset} letters"
            )));
        }
        let keys = ["templateStartTime", "templateEndTime", "templateStride"];
        let times = keys.map(|key| set.get(key));
        if times.iter().all(Option::is_none) {
            continue;
        }
        // Layers add keys to each other's templates, so every one has to be whole.
        let [
            Some(Value::Double(start)),
            Some(Value::Double(end)),
            Some(Value::Double(stride)),
        ] = times
        else {
            return Err(Broken(format!(
                "the clips {name:?} of {prim} lack one of {}, which are doubles",
                keys.join(", ")
            )));
        };
        let count = (end - start) / stride + 1.0;
        let is_sound = start.abs() <= MAX_TIME && end.abs() <= MAX_TIME && *stride >= MIN_STRIDE;
        all += count.max(0.0);
        if !is_sound || all.is_nan() || all > MAX_CLIPS {
            return Err(Broken(format!(
                "the clips {name:?} of {prim} go from {start:?} to {end:?} by {stride:?}: \
                 at most {MAX_CLIPS} clips are read"
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;

    fn dictionary(entries: &[(&str, Value)]) -> Value {
        let entries = entries
            .iter()
            .map(|(key, value)| (key.to_string(), value.clone()));
        Value::Dictionary(HashMap::from_iter(entries))
    }

    fn template(start: f64, end: f64, stride: f64) -> Value {
        let set = dictionary(&[
            ("templateAssetPath", Value::String("a.###.usd".into())),
            ("templateStartTime", Value::Double(start)),
            ("templateEndTime", Value::Double(end)),
            ("templateStride", Value::Double(stride)),
        ]);
        dictionary(&[("default", set)])
    }

    #[test]
    fn templates_stand_for_a_bounded_number_of_clips() {
        let prim = Path::abs_root();
        for (start, end, stride) in [(1.0, 1000.0, 1.0), (0.0, 10.0, 0.25), (5.0, 1.0, 1.0)] {
            assert_eq!(check(&prim, &template(start, end, stride)), Ok(()));
        }
        for (start, end, stride) in [
            (0.0, 1.0, 1e-300),
            (0.0, f64::INFINITY, 1.0),
            (f64::NAN, 1.0, 1.0),
            (1e300, 1e300, 1.0),
            (0.0, 1.0, 0.0),
            (0.0, 1e6, 1.0),
        ] {
            let error = check(&prim, &template(start, end, stride)).unwrap_err();
            assert!(error.0.contains("at most 100000 clips"), "{error:?}");
        }
    }

    #[test]
    fn templates_that_layers_could_complete_are_refused() {
        let set = dictionary(&[("templateStride", Value::Double(1.0))]);
        let error = check(&Path::abs_root(), &dictionary(&[("default", set)])).unwrap_err();
        assert!(error.0.contains("lack one of"), "{error:?}");
        let explicit = dictionary(&[("primPath", Value::String("/a".into()))]);
        let clips = dictionary(&[("default", explicit)]);
        assert_eq!(check(&Path::abs_root(), &clips), Ok(()));
    }
}

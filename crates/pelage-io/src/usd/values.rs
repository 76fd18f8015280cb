//! Plain arrays from the typed values of USD attributes.

use super::stage::Scene;
use crate::ReadError;
use openusd::{gf, sdf, usd};
use sdf::Value;

impl Scene {
    /// Value of attribute `name` of `prim` at `time`, or `None` where it has none.
    ///
    /// Between samples numbers are interpolated and the rest is held, as OpenUSD
    /// does. Without a time the default counts, then the first sample.
    pub(super) fn value(
        &self,
        prim: &sdf::Path,
        name: &str,
        time: Option<f64>,
    ) -> Result<Option<Value>, ReadError> {
        let attribute = self.attribute(prim, name);
        let place = || format!("{prim}.{name}");
        if let Some(time) = time {
            let value = attribute.get_at::<Value>(usd::TimeCode::new(time));
            return self.decoded(place(), value);
        }
        let value = self.decoded(place(), attribute.get::<Value>())?;
        if let Some(value) = value.filter(|v| !matches!(v, Value::ValueBlock | Value::None)) {
            return Ok(Some(value));
        }
        match self.sample_times(prim, name)?.first() {
            Some(&first) => self.value(prim, name, Some(first)),
            None => Ok(None),
        }
    }

    /// Times at which attribute `name` of `prim` has samples, ascending.
    pub(super) fn sample_times(&self, prim: &sdf::Path, name: &str) -> Result<Vec<f64>, ReadError> {
        let times = self.attribute(prim, name).time_sample_times();
        self.decoded(format!("{prim}.{name}"), times)
    }

    /// A token attribute, where it is there and a token.
    pub(super) fn token(&self, prim: &sdf::Path, name: &str) -> Result<Option<String>, ReadError> {
        let value = self.value(prim, name, None)?;
        Ok(value.and_then(|v| v.try_as_token()).map(String::from))
    }

    /// Metadata `interpolation` of an attribute.
    pub(super) fn interpolation(
        &self,
        prim: &sdf::Path,
        name: &str,
    ) -> Result<Option<String>, ReadError> {
        let value = self
            .attribute(prim, name)
            .get_metadata::<Value>("interpolation");
        let value = self.decoded(format!("{prim}.{name}"), value)?;
        Ok(value.and_then(|v| v.try_as_token()).map(String::from))
    }
}

/// An entry that arrays of a kind of value can be read as.
pub(super) trait Entry: Copy {
    /// What is expected, for messages.
    const KIND: &'static str;

    /// The entries of `value`, one for a single value; `None` for another type.
    fn entries(value: Value) -> Option<Vec<Self>>;
}

impl Entry for f32 {
    const KIND: &'static str = "float[]";

    fn entries(value: Value) -> Option<Vec<f32>> {
        Some(match value {
            Value::FloatVec(v) => v,
            Value::DoubleVec(v) => v.into_iter().map(|x| x as f32).collect(),
            Value::HalfVec(v) => v.into_iter().map(f32::from).collect(),
            Value::Float(x) => vec![x],
            Value::Double(x) => vec![x as f32],
            Value::Half(x) => vec![x.into()],
            _ => return None,
        })
    }
}

impl Entry for [f32; 2] {
    const KIND: &'static str = "float2[]";

    fn entries(value: Value) -> Option<Vec<[f32; 2]>> {
        let double = |v: gf::Vec2d| [v.x as f32, v.y as f32];
        let half = |v: gf::Vec2h| [v.x.into(), v.y.into()];
        Some(match value {
            Value::Vec2fVec(v) => v.into_iter().map(|v| [v.x, v.y]).collect(),
            Value::Vec2dVec(v) => v.into_iter().map(double).collect(),
            Value::Vec2hVec(v) => v.into_iter().map(half).collect(),
            // Some exporters write texture coordinates with a third number.
            Value::Vec3fVec(v) => v.into_iter().map(|v| [v.x, v.y]).collect(),
            Value::Vec2f(v) => vec![[v.x, v.y]],
            Value::Vec2d(v) => vec![double(v)],
            _ => return None,
        })
    }
}

impl Entry for [f32; 3] {
    const KIND: &'static str = "float3[]";

    fn entries(value: Value) -> Option<Vec<[f32; 3]>> {
        let double = |v: gf::Vec3d| [v.x as f32, v.y as f32, v.z as f32];
        let half = |v: gf::Vec3h| [v.x.into(), v.y.into(), v.z.into()];
        Some(match value {
            Value::Vec3fVec(v) => v.into_iter().map(|v| [v.x, v.y, v.z]).collect(),
            Value::Vec3dVec(v) => v.into_iter().map(double).collect(),
            Value::Vec3hVec(v) => v.into_iter().map(half).collect(),
            Value::Vec3f(v) => vec![[v.x, v.y, v.z]],
            Value::Vec3d(v) => vec![double(v)],
            _ => return None,
        })
    }
}

impl Entry for i64 {
    const KIND: &'static str = "int[]";

    fn entries(value: Value) -> Option<Vec<i64>> {
        Some(match value {
            Value::IntVec(v) => v.into_iter().map(i64::from).collect(),
            Value::UintVec(v) => v.into_iter().map(i64::from).collect(),
            Value::Int64Vec(v) => v,
            // Bits are kept: identifiers use the whole range.
            Value::Uint64Vec(v) => v.into_iter().map(|x| x as i64).collect(),
            Value::Int(x) => vec![x.into()],
            Value::Uint(x) => vec![x.into()],
            Value::Int64(x) => vec![x],
            Value::Uint64(x) => vec![x as i64],
            _ => return None,
        })
    }
}

/// Number of entries of a value: of an array its length, of anything else 1.
pub(super) fn count(value: &Value) -> usize {
    match value {
        Value::BoolVec(v) => v.len(),
        Value::UcharVec(v) => v.len(),
        Value::IntVec(v) => v.len(),
        Value::UintVec(v) => v.len(),
        Value::Int64Vec(v) => v.len(),
        Value::Uint64Vec(v) => v.len(),
        Value::HalfVec(v) => v.len(),
        Value::FloatVec(v) => v.len(),
        Value::DoubleVec(v) => v.len(),
        Value::StringVec(v) => v.len(),
        Value::TokenVec(v) => v.len(),
        Value::AssetPathVec(v) => v.len(),
        Value::QuatfVec(v) => v.len(),
        Value::QuathVec(v) => v.len(),
        Value::Vec2hVec(v) => v.len(),
        Value::Vec2fVec(v) => v.len(),
        Value::Vec2dVec(v) => v.len(),
        Value::Vec2iVec(v) => v.len(),
        Value::Vec3hVec(v) => v.len(),
        Value::Vec3fVec(v) => v.len(),
        Value::Vec3dVec(v) => v.len(),
        Value::Vec3iVec(v) => v.len(),
        Value::Vec4hVec(v) => v.len(),
        Value::Vec4fVec(v) => v.len(),
        Value::Vec4dVec(v) => v.len(),
        Value::Vec4iVec(v) => v.len(),
        Value::Matrix4dVec(v) => v.len(),
        _ => 1,
    }
}

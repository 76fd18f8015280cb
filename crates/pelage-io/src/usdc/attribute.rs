//! An attribute of a prim.

use super::sections::{Sections, SpecKind};
use super::value::{Kind, ValueRep};

/// An attribute whose values are in the file.
pub(super) struct Written<'a> {
    pub(super) name: &'a str,
    pub(super) kind: &'static str,
    pub(super) uniform: bool,
    pub(super) interpolation: Option<&'static str>,
    pub(super) value: Value,
}

pub(super) enum Value {
    Still(ValueRep),
    Samples(ValueRep),
}

impl<'a> Written<'a> {
    /// One that may vary and whose schema says where its values belong.
    pub(super) fn plain(name: &'a str, kind: &'static str, value: Value) -> Self {
        Self {
            name,
            kind,
            uniform: false,
            interpolation: None,
            value,
        }
    }

    /// Adds its spec to those of the prim `parent`.
    pub(super) fn spec(&self, sections: &mut Sections, parent: usize) {
        let mut fields = vec![
            ("typeName", sections.token_value(self.kind)),
            (
                "variability",
                ValueRep::inlined(Kind::Variability, self.uniform.into()),
            ),
        ];
        if let Some(domain) = self.interpolation {
            fields.push(("interpolation", sections.token_value(domain)));
        }
        fields.push(match self.value {
            Value::Still(value) => ("default", value),
            Value::Samples(value) => ("timeSamples", value),
        });
        sections.spec(SpecKind::Attribute, Some(parent), self.name, &fields);
    }
}

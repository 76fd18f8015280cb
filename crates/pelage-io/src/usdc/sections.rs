//! The tables of a crate file: who has which fields, by index.
//!
//! A *spec* (the layer, a prim, an attribute) has a path and a set of fields; a
//! field is a name and a value. Names are tokens.

use super::compress::{compress_bytes, compress_integers};
use super::value::{Kind, ValueRep};
use crate::drawable::refused;
use std::collections::HashMap;
use std::io;

/// What a spec describes, with its number in the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub(super) enum SpecKind {
    Attribute = 1,
    Prim = 6,
    Layer = 7,
}

/// Ends a set of fields.
const END_OF_SET: i32 = -1;

#[derive(Debug)]
struct Spec {
    kind: SpecKind,
    parent: Option<usize>,
    /// Last element of the path, a token.
    element: u32,
    /// Where its fields start in `field_sets`.
    field_set: i32,
}

/// The tables, filled spec by spec.
#[derive(Debug)]
pub(super) struct Sections {
    tokens: Vec<String>,
    token_index: HashMap<String, u32>,
    /// Strings are tokens too.
    strings: Vec<u32>,
    fields: Vec<(u32, ValueRep)>,
    field_sets: Vec<i32>,
    /// In depth-first order: a parent before its children, and these together.
    specs: Vec<Spec>,
}

impl Sections {
    pub(super) fn new() -> Self {
        let mut sections = Self {
            tokens: Vec::new(),
            token_index: HashMap::new(),
            strings: Vec::new(),
            fields: Vec::new(),
            field_sets: Vec::new(),
            specs: Vec::new(),
        };
        // Attributes are told from prims by a negative token index, which 0 has
        // none of: this token can never be an attribute's name.
        sections.token("/");
        sections
    }

    /// Index of a token.
    pub(super) fn token(&mut self, token: &str) -> u32 {
        if let Some(&index) = self.token_index.get(token) {
            return index;
        }
        let index = self.tokens.len() as u32;
        self.tokens.push(token.into());
        self.token_index.insert(token.into(), index);
        index
    }

    /// A token as a value.
    pub(super) fn token_value(&mut self, token: &str) -> ValueRep {
        ValueRep::inlined(Kind::Token, self.token(token))
    }

    /// A string as a value.
    pub(super) fn string_value(&mut self, words: &str) -> ValueRep {
        // Tokens end with a zero byte in the file.
        let token = self.token(&words.replace('\0', ""));
        self.strings.push(token);
        ValueRep::inlined(Kind::String, self.strings.len() as u32 - 1)
    }

    /// Adds a spec called `element` below `parent` (an index that this gave before;
    /// none for the layer); gives its index. Children must follow their parent
    /// before anything that is not below it.
    pub(super) fn spec(
        &mut self,
        kind: SpecKind,
        parent: Option<usize>,
        element: &str,
        fields: &[(&str, ValueRep)],
    ) -> usize {
        let field_set = self.field_sets.len() as i32;
        for (name, value) in fields {
            let field = (self.token(name), *value);
            self.field_sets.push(self.fields.len() as i32);
            self.fields.push(field);
        }
        self.field_sets.push(END_OF_SET);
        let element = self.token(element);
        self.specs.push(Spec {
            kind,
            parent,
            element,
            field_set,
        });
        self.specs.len() - 1
    }

    /// Every section's name and bytes, in order.
    pub(super) fn encode(&self) -> io::Result<[(&'static str, Vec<u8>); 6]> {
        Ok([
            ("TOKENS", self.encode_tokens()?),
            ("STRINGS", self.encode_strings()),
            ("FIELDS", self.encode_fields()?),
            ("FIELDSETS", self.encode_field_sets()?),
            ("PATHS", self.encode_paths()?),
            ("SPECS", self.encode_specs()?),
        ])
    }

    /// Count, size, then all tokens, each ended by a zero byte, compressed.
    fn encode_tokens(&self) -> io::Result<Vec<u8>> {
        let mut text = Vec::new();
        for token in &self.tokens {
            text.extend_from_slice(token.as_bytes());
            text.push(0);
        }
        let mut out = count(self.tokens.len());
        out.extend(count(text.len()));
        push_sized(&mut out, compress_bytes(&text))?;
        Ok(out)
    }

    fn encode_strings(&self) -> Vec<u8> {
        let mut out = count(self.strings.len());
        self.strings
            .iter()
            .for_each(|token| out.extend(token.to_le_bytes()));
        out
    }

    /// Count, names, values.
    fn encode_fields(&self) -> io::Result<Vec<u8>> {
        let mut out = count(self.fields.len());
        push_integers(&mut out, self.fields.iter().map(|f| f.0 as i32))?;
        let values: Vec<u8> = self
            .fields
            .iter()
            .flat_map(|f| f.1.0.to_le_bytes())
            .collect();
        push_sized(&mut out, compress_bytes(&values))?;
        Ok(out)
    }

    fn encode_field_sets(&self) -> io::Result<Vec<u8>> {
        let mut out = count(self.field_sets.len());
        push_integers(&mut out, self.field_sets.iter().copied())?;
        Ok(out)
    }

    /// The count twice (of all paths, and of those in the tree: the same), then the
    /// tree depth first: path index, element, jump.
    fn encode_paths(&self) -> io::Result<Vec<u8>> {
        let mut out = count(self.specs.len());
        out.extend(count(self.specs.len()));
        push_integers(&mut out, 0..self.specs.len() as i32)?;
        let elements = self.specs.iter().map(|spec| match spec.kind {
            SpecKind::Attribute => -(spec.element as i32),
            SpecKind::Prim | SpecKind::Layer => spec.element as i32,
        });
        push_integers(&mut out, elements)?;
        push_integers(&mut out, (0..self.specs.len()).map(|i| self.jump(i)))?;
        Ok(out)
    }

    /// What follows entry `index` of the tree: -2 nothing below or beside it, -1 its
    /// child alone, 0 its next sibling alone, else its child, with the next sibling
    /// so many entries further.
    fn jump(&self, index: usize) -> i32 {
        let parent = self.specs[index].parent;
        let below = self
            .specs
            .get(index + 1)
            .is_some_and(|next| next.parent == Some(index));
        let beside = (index + 1..self.specs.len())
            .find(|&other| parent.is_some() && self.specs[other].parent == parent);
        match (below, beside) {
            (false, None) => -2,
            (true, None) => -1,
            (false, Some(_)) => 0,
            (true, Some(sibling)) => (sibling - index) as i32,
        }
    }

    /// Count, paths, field sets, kinds.
    fn encode_specs(&self) -> io::Result<Vec<u8>> {
        let mut out = count(self.specs.len());
        push_integers(&mut out, 0..self.specs.len() as i32)?;
        push_integers(&mut out, self.specs.iter().map(|spec| spec.field_set))?;
        push_integers(&mut out, self.specs.iter().map(|spec| spec.kind as i32))?;
        Ok(out)
    }
}

fn count(value: usize) -> Vec<u8> {
    (value as u64).to_le_bytes().to_vec()
}

fn push_integers(out: &mut Vec<u8>, values: impl Iterator<Item = i32>) -> io::Result<()> {
    push_sized(out, compress_integers(&values.collect::<Vec<_>>()))
}

fn push_sized(out: &mut Vec<u8>, bytes: Option<Vec<u8>>) -> io::Result<()> {
    let bytes = bytes.ok_or_else(|| refused("the file's tables pass 2 GB"))?;
    out.extend(count(bytes.len()));
    out.extend(bytes);
    Ok(())
}

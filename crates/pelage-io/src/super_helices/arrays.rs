//! The arrays by name, for forms that keep each under its own: USD and NumPy.

use super::SuperHelices;
use super::check::Wrong;
use std::borrow::Cow;

/// The version of these arrays that is written and read.
pub(crate) const VERSION: u32 = 1;

/// The array that tells that all are there.
pub(crate) const TELLING: &str = "curvature_1";

/// The entries of an array.
pub(crate) enum Entries<'a> {
    Counts(Cow<'a, [u32]>),
    Vectors(&'a [[f32; 3]]),
    Numbers(&'a [f32]),
}

impl Entries<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::Counts(all) => all.len(),
            Self::Vectors(all) => all.len(),
            Self::Numbers(all) => all.len(),
        }
    }

    /// Their bytes, little-endian.
    pub(crate) fn raw(&self) -> &[u8] {
        match self {
            Self::Counts(all) => bytemuck::cast_slice(all),
            Self::Vectors(all) => bytemuck::cast_slice(all),
            Self::Numbers(all) => bytemuck::cast_slice(all),
        }
    }
}

/// Where arrays are taken from. An array that is not there, or of another type, is an error.
pub(crate) trait Arrays {
    type Error;
    fn counts(&mut self, name: &str) -> Result<Vec<u32>, Self::Error>;
    fn vectors(&mut self, name: &str) -> Result<Vec<[f32; 3]>, Self::Error>;
    fn numbers(&mut self, name: &str) -> Result<Vec<f32>, Self::Error>;
    /// The error that what was taken is no Super-Helices.
    fn wrong(&self, wrong: Wrong) -> Self::Error;
}

impl SuperHelices {
    /// Number of elements of each strand.
    pub(super) fn element_counts(&self) -> Vec<u32> {
        let pairs = self.offsets.windows(2);
        pairs.map(|pair| pair[1] - pair[0]).collect()
    }

    /// All arrays, by name.
    pub(super) fn arrays(&self) -> [(&'static str, Entries<'_>); 11] {
        [
            ("version", Entries::Counts(vec![VERSION].into())),
            ("elements", Entries::Counts(self.element_counts().into())),
            ("vertices", Entries::Counts((&self.vertices[..]).into())),
            ("root", Entries::Vectors(&self.roots)),
            ("tangent", Entries::Vectors(&self.tangents)),
            ("normal", Entries::Vectors(&self.normals)),
            ("error", Entries::Numbers(&self.errors)),
            ("length", Entries::Numbers(&self.lengths)),
            ("twist", Entries::Numbers(&self.twists)),
            (TELLING, Entries::Numbers(&self.curvatures_1)),
            ("curvature_2", Entries::Numbers(&self.curvatures_2)),
        ]
    }

    /// Those that `source` has, checked.
    pub(crate) fn of_arrays<A: Arrays>(source: &mut A) -> Result<Self, A::Error> {
        let version = source.counts("version")?;
        if version != [VERSION] {
            return Err(source.wrong(Wrong {
                place: "version".into(),
                message: format!("version {version:?} is not read, only [{VERSION}]"),
            }));
        }
        let counts = source.counts("elements")?;
        let mut strands = Self {
            vertices: source.counts("vertices")?,
            roots: source.vectors("root")?,
            tangents: source.vectors("tangent")?,
            normals: source.vectors("normal")?,
            errors: source.numbers("error")?,
            lengths: source.numbers("length")?,
            twists: source.numbers("twist")?,
            curvatures_1: source.numbers(TELLING)?,
            curvatures_2: source.numbers("curvature_2")?,
            ..Self::default()
        };
        let dealt = strands.deal(&counts);
        let sound = dealt.and_then(|()| strands.check());
        sound.map_err(|wrong| source.wrong(wrong))?;
        Ok(strands)
    }
}

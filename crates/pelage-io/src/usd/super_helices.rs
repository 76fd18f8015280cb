//! Super-Helices from the attributes beside the curves of a prim.

use super::stage::{Scene, with_scene};
use super::values::Entry;
use crate::ReadError;
use crate::super_helices::{Arrays, NAMESPACE, SuperHelices, TELLING, Wrong};
use openusd::sdf;
use std::path::Path;

/// Reads the Super-Helices of the first prim of curves of `path` that has some. A prim that
/// is moved or scaled in its scene is refused: its numbers are of its own space.
pub(crate) fn read_super_helices(path: &Path) -> Result<SuperHelices, ReadError> {
    with_scene(path, |scene| {
        let telling = format!("{NAMESPACE}{TELLING}");
        for prim in scene.prims("BasisCurves")? {
            if scene.value(&prim, &telling, None)?.is_none() {
                continue;
            }
            if scene.world_from(&prim, None)? != glam::DMat4::IDENTITY {
                let message = "the prim is moved in its scene, its Super-Helices are not";
                let help = "read the file of `pelage fit` itself, or its curves";
                return Err(scene.error(&prim, message).help(help));
            }
            let mut source = Parameters { scene, prim: &prim };
            let strands = SuperHelices::of_arrays(&mut source)?;
            let metadata = scene.metadata()?;
            return Ok(SuperHelices {
                up_axis: metadata.up_axis,
                meters_per_unit: metadata.meters_per_unit,
                ..strands
            });
        }
        let message = format!("no BasisCurves prim has an attribute {telling}");
        Err(ReadError::file(path, message).help("`pelage fit` makes Super-Helices of curves"))
    })
}

/// The attributes of a prim.
struct Parameters<'a> {
    scene: &'a Scene,
    prim: &'a sdf::Path,
}

impl Parameters<'_> {
    fn place(&self, name: &str) -> String {
        format!("{}.{NAMESPACE}{name}", self.prim)
    }

    fn entries<T: Entry>(&self, name: &str) -> Result<Vec<T>, ReadError> {
        let value = self
            .scene
            .value(self.prim, &format!("{NAMESPACE}{name}"), None)?;
        let value = value.ok_or_else(|| self.scene.error(self.place(name), "it has no value"))?;
        T::entries(value).ok_or_else(|| {
            let message = format!("it is not of type {}", T::KIND);
            self.scene.error(self.place(name), message)
        })
    }
}

impl Arrays for Parameters<'_> {
    type Error = ReadError;

    fn counts(&mut self, name: &str) -> Result<Vec<u32>, ReadError> {
        let all = self.entries::<i64>(name)?;
        let narrow: Option<Vec<u32>> = all.iter().map(|&n| u32::try_from(n).ok()).collect();
        narrow.ok_or_else(|| {
            let message = "it has entries that do not fit in 32 bits";
            self.scene.error(self.place(name), message)
        })
    }

    fn vectors(&mut self, name: &str) -> Result<Vec<[f32; 3]>, ReadError> {
        self.entries(name)
    }

    fn numbers(&mut self, name: &str) -> Result<Vec<f32>, ReadError> {
        self.entries(name)
    }

    fn wrong(&self, Wrong { place, message }: Wrong) -> ReadError {
        self.scene.error(self.prim, format!("{place}: {message}"))
    }
}

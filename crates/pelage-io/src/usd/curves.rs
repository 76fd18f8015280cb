//! Curves of `UsdGeomBasisCurves` prims, in world space.

use super::frames;
use super::mesh::gather;
use super::stage::{Scene, with_scene};
use super::values::{Entry, count};
use super::xform::{transform_normals, transform_points};
use crate::layout::{Layout, Mix};
use crate::strands_of::strands_through_vertices;
use crate::{AttributeInfo, CurveFile, CurveSet, ReadError};
use openusd::sdf;
use pelage_curves::{Basis, Wrap};
use pelage_strands::{Bounds, Fault, FaultKind, StrandBuffer};
use std::collections::HashMap;
use std::path::Path;

/// The curves of a file, and how the extent of each set compares.
pub(crate) struct CurvesWithExtent {
    pub(crate) file: CurveFile,
    /// One entry a set.
    pub(crate) extents: Vec<Extent>,
    /// Whether the file has a mesh as well.
    pub(crate) has_mesh: bool,
}

/// What a prim says of its size, in its own space.
pub(crate) struct Extent {
    /// Smallest and largest corner as the file has them.
    pub(crate) authored: Option<[[f32; 3]; 2]>,
    /// The box that holds the curves.
    pub(crate) computed: Bounds,
}

/// Reads every `BasisCurves` prim with its extent.
pub(crate) fn read_curves_with_extents(
    path: &Path,
    time: Option<f64>,
) -> Result<CurvesWithExtent, ReadError> {
    with_scene(path, |scene| {
        let metadata = scene.metadata()?;
        let mut all = CurvesWithExtent {
            file: CurveFile {
                sets: Vec::new(),
                up_axis: metadata.up_axis,
                meters_per_unit: metadata.meters_per_unit,
            },
            extents: Vec::new(),
            has_mesh: !scene.prims("Mesh")?.is_empty(),
        };
        for prim in scene.prims("BasisCurves")? {
            let (set, extent) = Reader::new(scene, &prim, time)?.read()?;
            all.file.sets.push(set);
            all.extents.push(extent);
        }
        Ok(all)
    })
}

/// Reads one prim.
struct Reader<'a> {
    scene: &'a Scene,
    prim: &'a sdf::Path,
    time: Option<f64>,
    values: HashMap<String, sdf::Value>,
    attributes: Vec<AttributeInfo>,
    faults: Vec<Fault>,
}

impl<'a> Reader<'a> {
    /// Takes in every attribute; those that cannot be decoded become faults.
    fn new(scene: &'a Scene, prim: &'a sdf::Path, time: Option<f64>) -> Result<Self, ReadError> {
        let mut reader = Self {
            scene,
            prim,
            time,
            values: HashMap::new(),
            attributes: Vec::new(),
            faults: Vec::new(),
        };
        scene.property_names(prim)?;
        for attribute in scene.decoded(prim, scene.stage.prim(prim.clone()).attributes())? {
            let name = attribute.path().property_suffix().to_owned();
            let name = name.trim_start_matches('.');
            match scene.value(prim, name, time) {
                Ok(Some(value)) => reader.take(name, attribute, value)?,
                Ok(None) => {}
                Err(error) => reader.fault(format!("{name}: {}", error.message)),
            }
        }
        Ok(reader)
    }

    fn take(
        &mut self,
        name: &str,
        attribute: openusd::usd::Attribute,
        value: sdf::Value,
    ) -> Result<(), ReadError> {
        let kind = self.scene.decoded(self.prim, attribute.type_name())?;
        // Settings of the prim as a whole say nothing of its curves.
        let is_setting = ["type", "basis", "wrap", "visibility", "purpose"].contains(&name)
            || ["doubleSided", "orientation"].contains(&name)
            || name.starts_with("xformOp")
            || name.ends_with(":indices");
        if !is_setting {
            self.attributes.push(AttributeInfo {
                name: name.into(),
                kind: kind.map(String::from).unwrap_or_default(),
                domain: self.domain(name)?,
                count: count(&value),
            });
        }
        self.values.insert(name.into(), value);
        Ok(())
    }

    /// Interpolation of an attribute: as authored, else the schema's.
    fn domain(&self, name: &str) -> Result<String, ReadError> {
        let authored = self.scene.interpolation(self.prim, name)?;
        Ok(authored.unwrap_or_else(|| {
            match name {
                "points" | "widths" | "normals" | "velocities" | "accelerations" => "vertex",
                "curveVertexCounts" => "uniform",
                _ => "constant",
            }
            .into()
        }))
    }

    fn fault(&mut self, detail: String) {
        self.faults.push(Fault {
            kind: FaultKind::WrongCount,
            strand: None,
            detail,
        });
    }

    fn token(&mut self, name: &str, fallback: &str) -> String {
        let value = self.values.get(name).cloned();
        match value.and_then(|v| v.try_as_token()) {
            Some(token) => token.into(),
            None => fallback.into(),
        }
    }

    fn basis_and_wrap(&mut self) -> (Basis, Wrap) {
        let basis = match self.token("type", "cubic").as_str() {
            "linear" => Basis::Linear,
            _ => match self.token("basis", "bezier").as_str() {
                "catmullRom" => Basis::CatmullRom,
                "bspline" => Basis::BSpline,
                "bezier" => Basis::Bezier,
                other => {
                    self.fault(format!("basis is {other:?}; it is read as bezier"));
                    Basis::Bezier
                }
            },
        };
        let wrap = match self.token("wrap", "nonperiodic").as_str() {
            "periodic" => Wrap::Periodic,
            "pinned" => Wrap::Pinned,
            "nonperiodic" => Wrap::Nonperiodic,
            other => {
                self.fault(format!("wrap is {other:?}; it is read as nonperiodic"));
                Wrap::Nonperiodic
            }
        };
        (basis, wrap)
    }

    /// The entries of an attribute, or `None` with a fault where it does not fit.
    fn entries<T: Entry>(&mut self, name: &str) -> Option<Vec<T>> {
        let value = self.values.remove(name)?;
        let Some(entries) = T::entries(value) else {
            self.fault(format!("{name} is not of type {}", T::KIND));
            return None;
        };
        let indices = self.values.remove(&format!("{name}:indices"));
        let Some(indices) = indices.and_then(i64::entries) else {
            return Some(entries);
        };
        gather(&entries, &indices)
            .map_err(|message| self.fault(format!("{name}: {message}")))
            .ok()
    }

    /// The first of `names` that has a value, given to `expand` with its domain.
    fn attribute<T: Entry>(
        &mut self,
        names: &[&str],
        expand: impl Fn(&[T], &str) -> Result<Vec<T>, String>,
    ) -> Result<Vec<T>, ReadError> {
        let Some(name) = names.iter().find(|n| self.values.contains_key(**n)) else {
            return Ok(Vec::new());
        };
        let domain = self.domain(name)?;
        let Some(entries) = self.entries(name) else {
            return Ok(Vec::new());
        };
        Ok(expand(&entries, &domain).unwrap_or_else(|message| {
            self.fault(format!("{name} {message}"));
            Vec::new()
        }))
    }

    fn vertex<T: Entry + Mix>(
        &mut self,
        layout: &Layout,
        names: &[&str],
    ) -> Result<Vec<T>, ReadError> {
        self.attribute(names, |values, domain| layout.per_vertex(values, domain))
    }

    fn uniform<T: Entry>(&mut self, layout: &Layout, name: &str) -> Result<Vec<T>, ReadError> {
        self.attribute(&[name], |values, domain| layout.per_curve(values, domain))
    }

    /// A uniform attribute of integers that must fit in 32 bits.
    fn uniform_u32(&mut self, layout: &Layout, name: &str) -> Result<Vec<u32>, ReadError> {
        let values: Vec<i64> = self.uniform(layout, name)?;
        let narrow: Result<Vec<u32>, _> = values.iter().map(|&v| u32::try_from(v)).collect();
        Ok(narrow.unwrap_or_else(|_| {
            self.fault(format!("{name} has entries that do not fit in 32 bits"));
            Vec::new()
        }))
    }

    /// Points and how they are dealt out to curves.
    fn points(&mut self, basis: Basis, wrap: Wrap) -> (Vec<[f32; 3]>, Layout) {
        let mut points: Vec<[f32; 3]> = self.entries("points").unwrap_or_default();
        // Offsets are of 32 bits.
        points.truncate(u32::MAX as usize);
        let counts: Vec<i64> = self.entries("curveVertexCounts").unwrap_or_default();
        if let Some(curve) = counts.iter().position(|&c| c < 0) {
            self.fault(format!(
                "curveVertexCounts[{curve}] is {}; it is read as 0",
                counts[curve]
            ));
        }
        let counts: Vec<usize> = counts.iter().map(|&c| c.max(0) as usize).collect();
        let layout = Layout::new(basis, wrap, &counts, points.len());
        if layout.file_vertices() != points.len() as u64 {
            self.fault(format!(
                "points has {} entries, but curveVertexCounts add up to {}; {} of {} curves are read",
                points.len(),
                layout.file_vertices(),
                layout.counts().len(),
                counts.len()
            ));
        }
        for (curve, &count) in layout.counts().iter().enumerate() {
            // Curves of no or one vertex are found by `validate`.
            if count >= 2 && basis.segments(count, wrap).is_none() {
                self.faults.push(Fault {
                    kind: FaultKind::WrongCount,
                    strand: Some(curve),
                    detail: format!("{count} vertices make no {basis:?} {wrap:?} curve"),
                });
            }
        }
        points.truncate(layout.vertices());
        (points, layout)
    }

    fn read(mut self) -> Result<(CurveSet, Extent), ReadError> {
        let (basis, wrap) = self.basis_and_wrap();
        let (points, layout) = self.points(basis, wrap);
        let ids: Vec<i64> = self.uniform(&layout, "primvars:hairId")?;
        let mut curves = StrandBuffer {
            offsets: layout.offsets(),
            points,
            widths: self.vertex(&layout, &["primvars:widths", "widths"])?,
            colors: self.vertex(&layout, &["primvars:displayColor"])?,
            opacities: self.vertex(&layout, &["primvars:displayOpacity"])?,
            normals: self.vertex(&layout, &["primvars:normals", "normals"])?,
            hair_id: ids.into_iter().map(|id| id as u64).collect(),
            strand_id: self.uniform_u32(&layout, "primvars:strandId")?,
            root_uv: self.uniform(&layout, "primvars:st")?,
            strand_uv: self.uniform(&layout, "primvars:strandUv")?,
            group: self.uniform_u32(&layout, "primvars:group")?,
            triangle: self.uniform_u32(&layout, "primvars:triangle")?,
            barycentric: self.uniform(&layout, "primvars:barycentric")?,
            root_rest: self.uniform(&layout, "primvars:restRoot")?,
        };
        let mut authored = self.entries::<[f32; 3]>("extent");
        let authored = authored.take().and_then(|e| <[_; 2]>::try_from(e).ok());
        let mut set = CurveSet {
            name: self.prim.to_string(),
            basis,
            wrap,
            curves: std::mem::take(&mut curves),
            attributes: self.attributes,
            faults: self.faults,
            frames: frames(self.scene, std::slice::from_ref(self.prim))?,
        };
        let computed = Bounds::of(&strands_through_vertices(&set));
        let world = self.scene.world_from(self.prim, self.time)?;
        transform_points(&mut set.curves.points, &world);
        transform_normals(&mut set.curves.normals, &world);
        // Widths are lengths of the prim's own space.
        let scale = libm::cbrt(world.determinant().abs()) as f32;
        if scale != 1.0 {
            set.curves.widths.iter_mut().for_each(|w| *w *= scale);
        }
        Ok((set, Extent { authored, computed }))
    }
}

//! Hair into a crate file.

use super::attribute::{Value, Written};
use super::crate_file::CrateFile;
use super::sections::{Sections, SpecKind};
use super::value::{Kind, ValueRep};
use crate::columns::{Column, Content, Field, Scalar};
use crate::file_sink::{Stream, file_sink};
use crate::hair_prim::{self, attribute};
use crate::recorder::Recorder;
use crate::super_helices::{Entries, type_name};
use crate::write::WriteOptions;
use pelage_strands::{Amount, Bounds, StrandBuffer, StreamInfo};
use std::io;
use std::path::Path;

file_sink! {
    /// Writes hair as a USD crate file (`.usdc`, `.usd`).
    ///
    /// `/NAME/hair` is a `BasisCurves`: cubic Catmull-Rom, nonperiodic, the first
    /// and last vertex of each curve written twice. Widths are diameters, one a
    /// vertex, as are `displayColor` and, where one differs from 1,
    /// `displayOpacity`; ids, root UV (`st`), group and root at rest are one a
    /// curve. Frames become time samples of positions and extent.
    UsdcWriter, Usdc
}

#[derive(Debug)]
struct Usdc {
    file: CrateFile,
    recorder: Recorder,
    tool: String,
    /// One a column that has values, in the columns' order.
    arrays: Vec<Arrays>,
}

/// What a column came to, in the frames that have ended.
#[derive(Debug)]
struct Arrays {
    field: Field,
    is_constant: bool,
    /// One a frame for what moves, else one.
    values: Vec<ValueRep>,
}

impl Stream for Usdc {
    fn begin(path: &Path, options: &WriteOptions, info: &StreamInfo) -> io::Result<Self> {
        let mut columns = vec![Column::new(Field::Points, path)];
        columns.extend(hair_prim::columns(path, options.ribbons));
        Ok(Self {
            recorder: hair_prim::recorder(info, columns)?,
            file: CrateFile::create(path)?,
            tool: options.tool.clone(),
            arrays: Vec::new(),
        })
    }

    fn begin_frame(&mut self) -> io::Result<()> {
        self.recorder.begin_frame()
    }

    fn write(&mut self, strands: &StrandBuffer) -> io::Result<()> {
        let file = &self.file;
        self.recorder
            .take(strands, |columns, most| file.reserve(columns, most))?;
        Ok(())
    }

    fn end_frame(&mut self) -> io::Result<()> {
        let amount = self.recorder.end_frame()?.amount;
        for column in self.recorder.columns_of_frame() {
            settle(column, amount, &mut self.file, &mut self.arrays)?;
        }
        Ok(())
    }

    fn finish(self) -> io::Result<()> {
        self.finish_with(&[])
    }
}

impl Usdc {
    /// Gives the file its name, with arrays beside those of the hair.
    fn finish_with(self, beside: &[Beside]) -> io::Result<()> {
        let recorded = self.recorder.finish()?;
        let mut layer = Layer {
            file: self.file,
            sections: Sections::new(),
            times: None,
            attributes: Vec::new(),
        };
        layer.gather(&recorded.info, &recorded.extents, &self.arrays)?;
        layer.gather_beside(beside)?;
        layer.write(&recorded.info, &self.tool)
    }
}

/// An array that the prim of the curves has beside what hair has.
pub(crate) struct Beside<'a> {
    pub(crate) name: String,
    pub(crate) entries: &'a Entries<'a>,
}

/// Writes `strands` and what is `beside` them as the file `path`.
pub(crate) fn write_with(
    path: &Path,
    options: &WriteOptions,
    info: &StreamInfo,
    strands: &StrandBuffer,
    beside: &[Beside],
) -> io::Result<()> {
    let mut stream = Usdc::begin(path, options, info)?;
    stream.begin_frame()?;
    stream.write(strands)?;
    stream.end_frame()?;
    stream.finish_with(beside)
}

/// Brings what `column` has of a frame, `amount` of entries, to its place in `file`.
fn settle(
    column: &mut Column,
    amount: Amount,
    file: &mut CrateFile,
    arrays: &mut Vec<Arrays>,
) -> io::Result<()> {
    let field = column.field;
    let kind = kind_of(field);
    let (is_constant, value) = match column.finish() {
        Content::Absent | Content::Usual(0.0) => return Ok(()),
        Content::Usual(value) => (true, file.array(kind, 1, &value.to_le_bytes())?),
        Content::Values(spool) => (false, file.array_of(kind, field.entries(amount), spool)?),
    };
    match arrays.iter_mut().find(|arrays| arrays.field == field) {
        Some(arrays) => arrays.values.push(value),
        None => arrays.push(Arrays {
            field,
            is_constant,
            values: vec![value],
        }),
    }
    Ok(())
}

/// The specs and their values, once all strands are there.
struct Layer<'a> {
    file: CrateFile,
    sections: Sections,
    /// Times of the samples; none for a still.
    times: Option<ValueRep>,
    attributes: Vec<Written<'a>>,
}

impl<'a> Layer<'a> {
    /// Lists all attributes, and writes the values that are not there yet.
    fn gather(
        &mut self,
        info: &StreamInfo,
        extents: &[Bounds],
        columns: &[Arrays],
    ) -> io::Result<()> {
        if !info.frames.is_empty() {
            self.times = Some(self.file.times(&info.frames)?);
        }
        for (name, token) in hair_prim::SHAPE {
            let value = Value::Still(self.sections.token_value(token));
            self.attributes.push(Written {
                uniform: true,
                ..Written::plain(name, "token", value)
            });
        }
        let extents: Vec<ValueRep> = extents
            .iter()
            .map(|bounds| {
                let corners = hair_prim::extent(bounds);
                let raw = bytemuck::cast_slice(&corners);
                self.file.array(Kind::Vec3f, corners.len() as u64, raw)
            })
            .collect::<io::Result<_>>()?;
        let extent = self.sampled(&extents)?;
        self.attributes
            .push(Written::plain("extent", "float3[]", extent));
        for arrays in columns {
            self.gather_column(arrays, info.frames.len().max(1))?;
        }
        Ok(())
    }

    /// The values of something that moves.
    fn sampled(&mut self, values: &[ValueRep]) -> io::Result<Value> {
        match self.times {
            Some(times) => Ok(Value::Samples(self.file.samples(times, values)?)),
            None => Ok(Value::Still(values[0])),
        }
    }

    fn gather_column(&mut self, arrays: &Arrays, frames: usize) -> io::Result<()> {
        let Some(named) = attribute(arrays.field) else {
            return Ok(());
        };
        let value = if !arrays.field.moves() {
            Value::Still(arrays.values[0])
        } else if arrays.values.len() == frames {
            self.sampled(&arrays.values)?
        } else {
            // Half an attribute is none.
            return Ok(());
        };
        let interpolation = if arrays.is_constant {
            Some("constant")
        } else {
            named.interpolation
        };
        self.attributes.push(Written {
            interpolation,
            ..Written::plain(named.name, named.kind, value)
        });
        Ok(())
    }

    fn gather_beside(&mut self, beside: &'a [Beside]) -> io::Result<()> {
        for Beside { name, entries } in beside {
            let kind = match entries {
                Entries::Counts(_) => Kind::Int,
                Entries::Vectors(_) => Kind::Vec3f,
                Entries::Numbers(_) => Kind::Float,
            };
            let value = self.file.array(kind, entries.len() as u64, entries.raw())?;
            let value = Value::Still(value);
            self.attributes
                .push(Written::plain(name, type_name(entries), value));
        }
        Ok(())
    }

    /// Writes the specs.
    fn write(mut self, info: &StreamInfo, tool: &str) -> io::Result<()> {
        let def = ValueRep::inlined(Kind::Specifier, 0);
        let layer = self.layer_spec(info, tool)?;
        let groom = [
            ("specifier", def),
            ("typeName", self.sections.token_value("Xform")),
            ("kind", self.sections.token_value("component")),
            (
                "primChildren",
                self.file.names(&mut self.sections, &[hair_prim::CURVES])?,
            ),
        ];
        let groom = self
            .sections
            .spec(SpecKind::Prim, Some(layer), &info.name, &groom);
        let names: Vec<&str> = self.attributes.iter().map(|a| a.name).collect();
        let curves = [
            ("specifier", def),
            ("typeName", self.sections.token_value("BasisCurves")),
            ("properties", self.file.names(&mut self.sections, &names)?),
        ];
        let curves = self
            .sections
            .spec(SpecKind::Prim, Some(groom), hair_prim::CURVES, &curves);
        for attribute in &self.attributes {
            attribute.spec(&mut self.sections, curves);
        }
        self.file.finish(&self.sections)
    }

    fn layer_spec(&mut self, info: &StreamInfo, tool: &str) -> io::Result<usize> {
        let mut fields = Vec::new();
        if !tool.is_empty() {
            fields.push(("documentation", self.sections.string_value(tool)));
        }
        fields.push(("defaultPrim", self.sections.token_value(&info.name)));
        for (name, value) in hair_prim::layer_numbers(info) {
            fields.push((name, self.file.double(value)?));
        }
        let axis = hair_prim::up_axis(info.up_axis);
        fields.push(("upAxis", self.sections.token_value(axis)));
        fields.push((
            "primChildren",
            self.file.names(&mut self.sections, &[&info.name])?,
        ));
        Ok(self.sections.spec(SpecKind::Layer, None, "/", &fields))
    }
}

fn kind_of(field: Field) -> Kind {
    match field.element() {
        (Scalar::U32, _) => Kind::Int,
        (Scalar::U64, _) => Kind::Int64,
        (Scalar::F32, 1) => Kind::Float,
        (Scalar::F32, 2) => Kind::Vec2f,
        (Scalar::F32, _) => Kind::Vec3f,
    }
}

//! Series of a surface: triangles that stay the same, with fields at their corners.

use super::plan::{Column, Description, Field, FieldKind, Planner, Step};
use super::{FrameData, SeriesReader, SeriesWriter};
use crate::IoError;
use glam::DVec3;
use std::path::{Path, PathBuf};

/// Points and triangles of a surface.
#[derive(Debug, Clone, Copy)]
pub struct SurfaceMesh<'a> {
    /// Positions \[m\], until a frame brings others.
    pub points: &'a [DVec3],
    /// Point numbers of the corners of each triangle.
    pub triangles: &'a [[u32; 3]],
}

/// A field of a surface series and what the file says about it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceField<'a> {
    /// Name as ParaView lists it.
    pub name: &'a str,
    /// Numbers a point: 1 or 3.
    pub components: usize,
    /// SI unit; empty or `"1"` for pure numbers.
    pub unit: &'a str,
    /// How it is computed, in ASCII; may be empty.
    pub definition: &'a str,
    /// Where the definition stems from, in ASCII; may be empty.
    pub citation: &'a str,
}

/// The state of a surface at one time. What it leaves out stays as it was in the frame before.
#[derive(Debug, Clone, Default)]
pub struct SurfaceFrame<'a> {
    /// Simulated time \[s\]; larger than that of the frame before.
    pub time: f64,
    /// Positions \[m\] of a surface that moves.
    pub points: Option<&'a [DVec3]>,
    /// Fields of one number a point, by name.
    pub scalars: Vec<(&'a str, &'a [f64])>,
    /// Fields of one vector a point, by name.
    pub vectors: Vec<(&'a str, &'a [DVec3])>,
}

/// Writes a time series of a surface to one VTKHDF file, by the protocol of [`SeriesWriter`].
///
/// Triangles are written once. VTKHDF wants every field at every time, so all of them are declared at the start. A frame
/// brings those that are new: the others stay as they were and cost no space, and before its first value a field is NaN.
/// That is how indices of a cycle, which exist only at its end, stand beside stresses that change in every frame.
#[derive(Debug)]
pub struct SurfaceSeriesWriter {
    series: SeriesWriter,
    points: Vec<DVec3>,
}

impl SurfaceSeriesWriter {
    /// Starts a new series. The file appears with the first frame; one of the same name is then replaced.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] when a triangle names a point that is not there, or a field is declared twice or has neither
    /// one nor three components.
    pub fn create(
        path: impl Into<PathBuf>,
        mesh: SurfaceMesh<'_>,
        fields: &[SurfaceField<'_>],
    ) -> Result<Self, IoError> {
        let mut series = SeriesWriter::create(path);
        let mismatch = |what| IoError::Mismatch { path: series.path().to_owned(), what };
        let declared = declared(fields).map_err(mismatch)?;
        if let Some(corner) = mesh.triangles.iter().flatten().find(|&&v| v as usize >= mesh.points.len()) {
            return Err(mismatch(format!(
                "a triangle has the corner {corner} of {} points",
                mesh.points.len()
            )));
        }
        series.planner.triangles = Some(mesh.triangles.into());
        series.planner.declare(declared);
        Ok(Self { series, points: mesh.points.to_vec() })
    }

    /// Goes on with a series of the same mesh and fields: frames later than `time` \[s\] are dropped, those up to it stay. A
    /// missing file makes a new series.
    ///
    /// # Errors
    /// As [`create`](Self::create); [`IoError::Mismatch`] also when the file has other triangles or fields;
    /// [`IoError::Hdf5`], [`IoError::Kind`] or [`IoError::Damaged`] when it is not a series of ours.
    pub fn continue_at(
        path: impl Into<PathBuf>,
        mesh: SurfaceMesh<'_>,
        fields: &[SurfaceField<'_>],
        time: f64,
    ) -> Result<Self, IoError> {
        let mut writer = Self::create(path, mesh, fields)?;
        if !writer.path().exists() {
            return Ok(writer);
        }
        let reader = SeriesReader::open(writer.path())?;
        let mismatch =
            |what: &str| IoError::Mismatch { path: writer.path().to_owned(), what: what.to_owned() };
        if reader.triangles()? != mesh.triangles {
            return Err(mismatch("it holds other triangles; remove it or choose another folder"));
        }
        let in_file = reader.info().fields.iter().map(|field| (&field.name, field.components));
        let wanted = writer.series.planner.fields.iter().map(|f| (&f.name, f.columns().unwrap_or(1)));
        if !in_file.eq(wanted) {
            return Err(mismatch("it holds other fields; remove it or choose another folder"));
        }
        let Self { series, points } = &mut writer;
        series.replay(&reader, time, |planner, FrameData { time, position, scalars, vectors, .. }| {
            let frame = SurfaceFrame {
                time,
                points: Some(&position),
                scalars: scalars.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect(),
                vectors: vectors.iter().map(|(name, values)| (name.as_str(), values.as_slice())).collect(),
            };
            plan(planner, points, &frame)
        })?;
        Ok(writer)
    }

    /// The public file.
    pub fn path(&self) -> &Path {
        self.series.path()
    }

    /// Number of frames in the public file.
    pub fn len(&self) -> usize {
        self.series.len()
    }

    /// True before the first frame.
    pub fn is_empty(&self) -> bool {
        self.series.is_empty()
    }

    /// Time of the last frame \[s\].
    pub fn last_time(&self) -> Option<f64> {
        self.series.last_time()
    }

    /// Adds a frame; when this returns, the public file holds it.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] when an array has not one entry a point, a field was not declared or is given twice, or the time
    /// is not later than the last (nothing is written then); [`IoError::System`] or [`IoError::Hdf5`] when the disk refuses.
    pub fn append(&mut self, frame: &SurfaceFrame<'_>) -> Result<(), IoError> {
        let points = &self.points;
        self.series.commit(|planner| plan(planner, points, frame))
    }
}

/// The fields in order of name.
fn declared(fields: &[SurfaceField<'_>]) -> Result<Vec<Field>, String> {
    let mut declared = fields
        .iter()
        .map(|field| {
            let kind = match field.components {
                1 => FieldKind::Scalar,
                3 => FieldKind::Vector,
                n => return Err(format!("field `{}` has {n} components, expected 1 or 3", field.name)),
            };
            let unit = if field.unit.is_empty() { "1" } else { field.unit };
            let description = Description {
                unit: unit.to_owned(),
                definition: field.definition.to_owned(),
                citation: field.citation.to_owned(),
            };
            Ok(Field { name: field.name.to_owned(), kind, description })
        })
        .collect::<Result<Vec<Field>, String>>()?;
    declared.sort();
    match declared.windows(2).find(|pair| pair[0].name == pair[1].name) {
        Some(pair) => Err(format!("field `{}` is declared twice", pair[0].name)),
        None => Ok(declared),
    }
}

/// Checks a frame against the declaration and decides where its arrays go.
fn plan(planner: &mut Planner, mesh_points: &[DVec3], frame: &SurfaceFrame<'_>) -> Result<Step, String> {
    planner.check_time(frame.time)?;
    let count = mesh_points.len();
    let check = |name: &str, length: usize| {
        if length == count { Ok(()) } else { Err(format!("`{name}` has {length} values for {count} points")) }
    };
    let is_first = planner.steps == 0;
    let points = match frame.points {
        Some(points) => check("points", points.len()).map(|()| Some(Column::vectors(points)))?,
        None => is_first.then(|| Column::vectors(mesh_points)),
    };
    let mut columns: Vec<Option<Column>> = vec![None; planner.fields.len()];
    let scalars =
        frame.scalars.iter().map(|(name, v)| (*name, FieldKind::Scalar, v.len(), Column::scalars(v)));
    let vectors =
        frame.vectors.iter().map(|(name, v)| (*name, FieldKind::Vector, v.len(), Column::vectors(v)));
    for (name, kind, length, column) in scalars.chain(vectors) {
        check(name, length)?;
        let declared = planner.fields.iter().position(|field| field.name == name && field.kind == kind);
        let Some(at) = declared else {
            let components = if kind == FieldKind::Vector { 3 } else { 1 };
            return Err(format!("no field `{name}` with {components} components was declared"));
        };
        if columns[at].replace(column).is_some() {
            return Err(format!("field `{name}` is given twice"));
        }
    }
    if is_first {
        for (column, field) in columns.iter_mut().zip(&planner.fields) {
            column.get_or_insert_with(|| match field.columns() {
                None => Column::scalars(&vec![f64::NAN; count]),
                Some(_) => Column::vectors(&vec![DVec3::NAN; count]),
            });
        }
    }
    Ok(planner.arrange(frame.time, count as i64, points, columns))
}

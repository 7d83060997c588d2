//! Where everything lies in the file: the VTKHDF names, and the empty skeleton.
//!
//! Rules that VTK's reader keeps silent about until they are broken: all four kinds of cells must be there,
//! also the unused ones; `CellOffsets` counts cells, not entries of `Offsets`; `Connectivity` counts
//! from zero within a frame, so that one list 0, 1, 2, ... as long as the largest frame serves all frames. What
//! counts points and cells is listed by part, not by frame: frames of a surface share one part, and only their
//! points and fields have offsets of their own.

use super::plan::Field;
use crate::hdf5::{Element, Growing, Outcome, Write};
use crate::schema;

pub(super) const ROOT: &str = "VTKHDF";
pub(super) const POINTS: &str = "VTKHDF/Points";
pub(super) const NUMBER_OF_POINTS: &str = "VTKHDF/NumberOfPoints";
pub(super) const POINT_DATA: &str = "VTKHDF/PointData";
pub(super) const STEPS: &str = "VTKHDF/Steps";
pub(super) const TIMES: &str = "VTKHDF/Steps/Values";
pub(super) const POINT_OFFSETS: &str = "VTKHDF/Steps/PointOffsets";
pub(super) const POINT_DATA_OFFSETS: &str = "VTKHDF/Steps/PointDataOffsets";
pub(super) const PART_OFFSETS: &str = "VTKHDF/Steps/PartOffsets";
pub(super) const NUMBER_OF_PARTS: &str = "VTKHDF/Steps/NumberOfParts";
pub(super) const CELL_OFFSETS: &str = "VTKHDF/Steps/CellOffsets";
pub(super) const CONNECTIVITY_OFFSETS: &str = "VTKHDF/Steps/ConnectivityIdOffsets";
/// The group of our own, which VTK passes over.
pub(super) const OURS: &str = "vaso";
pub(super) const UNITS: &str = "vaso/units";

/// The cells of particles.
pub(super) const VERTICES: &str = "Vertices";
/// The cells of surfaces.
pub(super) const POLYGONS: &str = "Polygons";
/// The four kinds of cells of PolyData in the order of the columns of `CellOffsets`.
pub(super) const CELLS: [&str; 4] = [VERTICES, "Lines", POLYGONS, "Strips"];

/// Attributes of a field, with those of [`Description`](super::plan::Description).
pub(super) const FIELD_UNITS: &str = "units";
pub(super) const FIELD_DEFINITION: &str = "definition";
pub(super) const FIELD_CITATION: &str = "citation";

/// Rows of the lists with one row a frame: short, so that a short series stays small.
const STEP_CHUNK: usize = 256;
/// Rows a chunk of particle data. A frame rewrites the one chunk it shares with its predecessor and the old
/// version is lost space: small chunks keep that small, large ones compress better and are fewer.
pub(super) const POINT_CHUNK: usize = 4096;
/// Deflate level of particle data: half the time of level 4 for 4 % more bytes, as the rest is noise.
const LEVEL: u32 = 1;

pub(super) fn cells(kind: &str, list: &str) -> String {
    format!("{ROOT}/{kind}/{list}")
}

pub(super) fn field(name: &str) -> String {
    format!("{POINT_DATA}/{name}")
}

pub(super) fn field_offsets(name: &str) -> String {
    format!("{POINT_DATA_OFFSETS}/{name}")
}

/// Writes groups, attributes and empty datasets for frames with these fields.
pub(super) fn skeleton<W: Write>(file: &W, fields: &[Field], surface: bool) -> Outcome<()> {
    let per_step = |element, columns| Growing { element, columns, chunk: STEP_CHUNK, deflate: None };
    let per_point = |element, columns| Growing { element, columns, chunk: POINT_CHUNK, deflate: Some(LEVEL) };
    // A pair a frame for particles, an entry a triangle for a surface.
    let ends = if surface { per_point(Element::I64, None) } else { per_step(Element::I64, None) };

    file.group(ROOT)?;
    file.text(ROOT, "Type", "PolyData")?;
    file.integers(ROOT, "Version", &[2, 0])?;
    file.growing(NUMBER_OF_POINTS, per_step(Element::I64, None))?;
    file.growing(POINTS, per_point(Element::F32, Some(3)))?;
    for kind in CELLS {
        file.group(&format!("{ROOT}/{kind}"))?;
        file.growing(&cells(kind, "NumberOfCells"), per_step(Element::I64, None))?;
        file.growing(&cells(kind, "NumberOfConnectivityIds"), per_step(Element::I64, None))?;
        file.growing(&cells(kind, "Offsets"), ends)?;
        file.growing(&cells(kind, "Connectivity"), per_point(Element::I64, None))?;
    }
    file.group(POINT_DATA)?;
    file.group(STEPS)?;
    file.integers(STEPS, "NSteps", &[0])?;
    file.growing(TIMES, per_step(Element::F64, None))?;
    for list in [POINT_OFFSETS, PART_OFFSETS, NUMBER_OF_PARTS] {
        file.growing(list, per_step(Element::I64, None))?;
    }
    for table in [CELL_OFFSETS, CONNECTIVITY_OFFSETS] {
        file.growing(table, per_step(Element::I64, Some(CELLS.len())))?;
    }
    file.group(POINT_DATA_OFFSETS)?;
    for entry in fields {
        file.growing(&field(&entry.name), per_point(entry.element(), entry.columns()))?;
        file.growing(&field_offsets(&entry.name), per_step(Element::I64, None))?;
    }

    file.group(OURS)?;
    file.text(OURS, "Generator", concat!("vaso ", env!("CARGO_PKG_VERSION")))?;
    file.group(UNITS)?;
    file.text(UNITS, "Points", "m")?;
    for entry in fields {
        let described = &entry.description;
        let unit = if described.unit.is_empty() { schema::unit(&entry.name) } else { Some(&*described.unit) };
        if let Some(unit) = unit {
            file.text(UNITS, &entry.name, unit)?;
            file.note(&field(&entry.name), FIELD_UNITS, unit)?;
        }
        let notes = [(FIELD_DEFINITION, &described.definition), (FIELD_CITATION, &described.citation)];
        for (name, text) in notes.into_iter().filter(|(_, text)| !text.is_empty()) {
            file.note(&field(&entry.name), name, text)?;
        }
    }
    Ok(())
}

//! What one frame adds to the file, decided before anything is written.

use super::{Frame, layout};
use crate::hdf5::{Element, Outcome, Values, Write};
use crate::schema;
use glam::DVec3;
use std::sync::Arc;

/// Name and width of a field.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) kind: FieldKind,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum FieldKind {
    Scalar,
    Vector,
    Id,
}

impl Field {
    pub(super) fn element(&self) -> Element {
        match self.kind {
            FieldKind::Scalar | FieldKind::Vector => Element::F32,
            FieldKind::Id => Element::I64,
        }
    }

    pub(super) fn columns(&self) -> Option<usize> {
        (self.kind == FieldKind::Vector).then_some(3)
    }
}

/// The numbers of one array as they go to disk.
#[derive(Debug, Clone)]
pub(super) enum Column {
    F32(Vec<f32>),
    I64(Vec<i64>),
}

impl Column {
    fn scalars(values: &[f64]) -> Self {
        Self::F32(values.iter().map(|&x| x as f32).collect())
    }

    fn vectors(values: &[DVec3]) -> Self {
        Self::F32(values.iter().flat_map(|v| v.as_vec3().to_array()).collect())
    }

    fn ids(values: &[u64]) -> Self {
        // VTK's id type is signed; identities count particles, far below its limit, and wrap back on reading.
        Self::I64(values.iter().map(|&id| id as i64).collect())
    }

    fn values(&self) -> Values<'_> {
        match self {
            Self::F32(v) => Values::F32(v),
            Self::I64(v) => Values::I64(v),
        }
    }

    /// Equality of bits, so that a NaN equals itself and zeros of both signs differ.
    fn same_bits(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::F32(a), Self::F32(b)) => {
                bytemuck::cast_slice::<f32, u8>(a) == bytemuck::cast_slice::<f32, u8>(b)
            }
            (Self::I64(a), Self::I64(b)) => a == b,
            _ => false,
        }
    }
}

/// An array of a frame and the row at which it begins in its dataset.
#[derive(Debug, Clone)]
struct Placed {
    column: Arc<Column>,
    offset: i64,
    /// Not in the file yet.
    fresh: bool,
}

/// Everything one frame adds. Applying the same steps in the same order makes equal files.
#[derive(Debug, Clone)]
pub(super) struct Step {
    index: i64,
    time: f64,
    count: i64,
    points: Placed,
    fields: Vec<(String, Placed)>,
    /// Entries the shared list 0, 1, 2, ... must grow by.
    connectivity: std::ops::Range<i64>,
}

/// Rows in use, dataset by dataset, and the last frame to compare the next one with.
#[derive(Debug, Clone, Default)]
pub(super) struct Planner {
    pub(super) fields: Vec<Field>,
    pub(super) steps: i64,
    pub(super) last_time: Option<f64>,
    points_rows: i64,
    field_rows: Vec<i64>,
    connectivity_rows: i64,
    previous: Option<Step>,
}

impl Planner {
    /// Checks a frame against the frames before it and decides where its arrays go.
    ///
    /// # Errors
    /// Says in words what does not fit: lengths, set of fields, or time.
    pub(super) fn plan(&mut self, frame: &Frame<'_>) -> Result<Step, String> {
        let mut columns = self.columns(frame)?;
        columns.sort_by(|a, b| a.0.cmp(&b.0));
        let fields: Vec<Field> = columns.iter().map(|(field, _)| field.clone()).collect();
        if let Some(twice) = fields.windows(2).find(|pair| pair[0].name == pair[1].name) {
            return Err(format!("field `{}` is given twice", twice[0].name));
        }
        if self.steps == 0 {
            self.field_rows = vec![0; fields.len()];
            self.fields = fields;
        } else if self.fields != fields {
            let names =
                |list: &[Field]| list.iter().map(|field| field.name.clone()).collect::<Vec<_>>().join(", ");
            return Err(format!(
                "the frame has the fields \"{}\", the frames before it have \"{}\"; they must be the same",
                names(&fields),
                names(&self.fields)
            ));
        }

        let count = frame.position.len() as i64;
        let before = self.previous.take();
        let points = place(
            Column::vectors(frame.position),
            before.as_ref().map(|s| &s.points),
            &mut self.points_rows,
            count,
        );
        let mut placed = Vec::with_capacity(columns.len());
        for (i, (field, column)) in columns.into_iter().enumerate() {
            let old = before.as_ref().map(|step| &step.fields[i].1);
            placed.push((field.name, place(column, old, &mut self.field_rows[i], count)));
        }
        let connectivity = self.connectivity_rows..count.max(self.connectivity_rows);
        self.connectivity_rows = connectivity.end;

        let step = Step { index: self.steps, time: frame.time, count, points, fields: placed, connectivity };
        self.steps += 1;
        self.last_time = Some(frame.time);
        self.previous = Some(step.clone());
        Ok(step)
    }

    fn columns(&self, frame: &Frame<'_>) -> Result<Vec<(Field, Column)>, String> {
        if !frame.time.is_finite() {
            return Err(format!("the time of the frame is \"{}\", expected a finite number", frame.time));
        }
        if let Some(last) = self.last_time.filter(|&last| frame.time <= last) {
            return Err(format!(
                "the frame at {} s does not come after the last one at {last} s; open the series with \
                 `continue_at` to drop later frames",
                frame.time
            ));
        }
        let expected = frame.position.len();
        let check = |name: &str, length: usize| {
            if length == expected {
                Ok(())
            } else {
                Err(format!("field `{name}` has {length} values for {expected} particles"))
            }
        };
        let mut columns = Vec::new();
        for (name, values) in &frame.scalars {
            check(name, values.len())?;
            columns
                .push((Field { name: name.to_string(), kind: FieldKind::Scalar }, Column::scalars(values)));
        }
        for (name, values) in &frame.vectors {
            check(name, values.len())?;
            columns
                .push((Field { name: name.to_string(), kind: FieldKind::Vector }, Column::vectors(values)));
        }
        if let Some(ids) = frame.ids {
            check(schema::ID, ids.len())?;
            columns.push((Field { name: schema::ID.to_owned(), kind: FieldKind::Id }, Column::ids(ids)));
        }
        Ok(columns)
    }
}

fn place(column: Column, before: Option<&Placed>, rows: &mut i64, count: i64) -> Placed {
    if let Some(old) = before.filter(|old| old.column.same_bits(&column)) {
        return Placed { fresh: false, ..old.clone() };
    }
    let offset = *rows;
    *rows += count;
    Placed { column: Arc::new(column), offset, fresh: true }
}

impl Step {
    /// Appends the step to a file that holds exactly the steps before it.
    pub(super) fn apply<W: Write>(&self, file: &W) -> Outcome<()> {
        let one = |path: &str, value: i64| file.extend(path, Values::I64(&[value]));

        one(layout::NUMBER_OF_POINTS, self.count)?;
        if self.points.fresh {
            file.extend(layout::POINTS, self.points.column.values())?;
        }
        for (name, placed) in &self.fields {
            if placed.fresh {
                file.extend(&layout::field(name), placed.column.values())?;
            }
            one(&layout::field_offsets(name), placed.offset)?;
        }

        // One poly-vertex cell a frame: without a cell a surface mapper has nothing to draw.
        for (kind, used) in layout::CELLS.into_iter().zip([true, false, false, false]) {
            let (cells, ids) = if used { (1, self.count) } else { (0, 0) };
            one(&layout::cells(kind, "NumberOfCells"), cells)?;
            one(&layout::cells(kind, "NumberOfConnectivityIds"), ids)?;
            let offsets: &[i64] = if used { &[0, self.count] } else { &[0] };
            file.extend(&layout::cells(kind, "Offsets"), Values::I64(offsets))?;
        }
        let connectivity: Vec<i64> = self.connectivity.clone().collect();
        file.extend(&layout::cells(layout::CELLS[0], "Connectivity"), Values::I64(&connectivity))?;

        file.extend(layout::TIMES, Values::F64(&[self.time]))?;
        one(layout::POINT_OFFSETS, self.points.offset)?;
        one(layout::PART_OFFSETS, self.index)?;
        one(layout::NUMBER_OF_PARTS, 1)?;
        file.extend(layout::CELL_OFFSETS, Values::I64(&[self.index, 0, 0, 0]))?;
        file.extend(layout::CONNECTIVITY_OFFSETS, Values::I64(&[0, 0, 0, 0]))?;
        file.integers(layout::STEPS, "NSteps", &[self.index + 1])
    }
}

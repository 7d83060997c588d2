//! What one frame adds to the file, decided before anything is written.

use super::cells::{Cells, Triangles};
use super::{Frame, layout};
use crate::hdf5::{Element, Outcome, Values, Write};
use crate::schema;
use glam::DVec3;
use std::sync::Arc;

/// Name, width and meaning of a field.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Field {
    pub(super) name: String,
    pub(super) kind: FieldKind,
    pub(super) description: Description,
}

/// What the file says of a field beyond its name; empty where there is nothing to say.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Description {
    pub(super) unit: String,
    pub(super) definition: String,
    pub(super) citation: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum FieldKind {
    Scalar,
    Vector,
    Id,
}

impl Field {
    fn undescribed(name: &str, kind: FieldKind) -> Self {
        Self { name: name.to_owned(), kind, description: Description::default() }
    }

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
    pub(super) fn scalars(values: &[f64]) -> Self {
        Self::F32(values.iter().map(|&x| x as f32).collect())
    }

    pub(super) fn vectors(values: &[DVec3]) -> Self {
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
    cells: Cells,
}

/// Rows in use, dataset by dataset, and the last frame to compare the next one with.
#[derive(Debug, Clone, Default)]
pub(super) struct Planner {
    pub(super) fields: Vec<Field>,
    pub(super) steps: i64,
    pub(super) last_time: Option<f64>,
    /// Triangles of a surface; `None` for particles.
    pub(super) triangles: Option<Triangles>,
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
            self.declare(fields);
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
        let columns = columns.into_iter().map(|(_, column)| Some(column)).collect();
        Ok(self.arrange(frame.time, count, Some(Column::vectors(frame.position)), columns))
    }

    /// Fixes the fields of all frames, which are in order of name.
    pub(super) fn declare(&mut self, fields: Vec<Field>) {
        self.field_rows = vec![0; fields.len()];
        self.fields = fields;
    }

    /// Gives every array its rows. One that is left out stays as it was in the frame before; the first frame has all.
    pub(super) fn arrange(
        &mut self,
        time: f64,
        count: i64,
        points: Option<Column>,
        columns: Vec<Option<Column>>,
    ) -> Step {
        let before = self.previous.take();
        let points = place(points, before.as_ref().map(|s| &s.points), &mut self.points_rows, count);
        let mut placed = Vec::with_capacity(columns.len());
        for (i, (field, column)) in self.fields.iter().zip(columns).enumerate() {
            let old = before.as_ref().map(|step| &step.fields[i].1);
            placed.push((field.name.clone(), place(column, old, &mut self.field_rows[i], count)));
        }
        let cells = match &self.triangles {
            Some(triangles) => Cells::Surface(triangles.clone()),
            None => {
                let connectivity = self.connectivity_rows..count.max(self.connectivity_rows);
                self.connectivity_rows = connectivity.end;
                Cells::Particles(connectivity)
            }
        };
        let step = Step { index: self.steps, time, count, points, fields: placed, cells };
        self.steps += 1;
        self.last_time = Some(time);
        self.previous = Some(step.clone());
        step
    }

    /// Says what is wrong with the time of a new frame.
    pub(super) fn check_time(&self, time: f64) -> Result<(), String> {
        if !time.is_finite() {
            return Err(format!("the time of the frame is \"{time}\", expected a finite number"));
        }
        match self.last_time.filter(|&last| time <= last) {
            Some(last) => Err(format!(
                "the frame at {time} s does not come after the last one at {last} s; open the series with \
                 `continue_at` to drop later frames"
            )),
            None => Ok(()),
        }
    }

    fn columns(&self, frame: &Frame<'_>) -> Result<Vec<(Field, Column)>, String> {
        self.check_time(frame.time)?;
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
            columns.push((Field::undescribed(name, FieldKind::Scalar), Column::scalars(values)));
        }
        for (name, values) in &frame.vectors {
            check(name, values.len())?;
            columns.push((Field::undescribed(name, FieldKind::Vector), Column::vectors(values)));
        }
        if let Some(ids) = frame.ids {
            check(schema::ID, ids.len())?;
            columns.push((Field::undescribed(schema::ID, FieldKind::Id), Column::ids(ids)));
        }
        Ok(columns)
    }
}

fn place(column: Option<Column>, before: Option<&Placed>, rows: &mut i64, count: i64) -> Placed {
    let stays = |old: &&Placed| column.as_ref().is_none_or(|column| old.column.same_bits(column));
    if let Some(old) = before.filter(stays) {
        return Placed { fresh: false, ..old.clone() };
    }
    let offset = *rows;
    *rows += count;
    let column =
        column.expect("the first frame has every array, and it is the only one without a frame before");
    Placed { column: Arc::new(column), offset, fresh: true }
}

impl Step {
    /// Appends the step to a file that holds exactly the steps before it.
    pub(super) fn apply<W: Write>(&self, file: &W) -> Outcome<()> {
        let one = |path: &str, value: i64| file.extend(path, Values::I64(&[value]));

        self.cells.apply(file, self.index, self.count)?;
        if self.points.fresh {
            file.extend(layout::POINTS, self.points.column.values())?;
        }
        for (name, placed) in &self.fields {
            if placed.fresh {
                file.extend(&layout::field(name), placed.column.values())?;
            }
            one(&layout::field_offsets(name), placed.offset)?;
        }

        file.extend(layout::TIMES, Values::F64(&[self.time]))?;
        one(layout::POINT_OFFSETS, self.points.offset)?;
        file.integers(layout::STEPS, "NSteps", &[self.index + 1])
    }
}

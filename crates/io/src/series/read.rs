//! Reading a series back, with every count checked before it is believed.

use super::plan::{Description, Field, FieldKind};
use super::{FrameData, layout};
use crate::IoError;
use crate::hdf5::{Read, Reader};
use crate::schema;
use glam::DVec3;
use std::cmp::Ordering;
use std::path::{Path, PathBuf};

/// A point field of a series.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FieldInfo {
    /// Name as ParaView lists it.
    pub name: String,
    /// Numbers a point: 1 or 3.
    pub components: usize,
    /// Unit the file or the field table names, `"1"` for pure numbers; `None` where neither does.
    pub unit: Option<String>,
    /// How the field is computed; `None` where the file does not say.
    pub definition: Option<String>,
    /// Where the definition stems from; `None` where the file does not say.
    pub citation: Option<String>,
}

/// What a series holds.
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesInfo {
    /// Time of each frame \[s\], ascending.
    pub times: Vec<f64>,
    /// Particles, or points of the surface, in each frame.
    pub counts: Vec<usize>,
    /// Fields, in order of name.
    pub fields: Vec<FieldInfo>,
}

/// A series opened for reading. The frames visible are those at the time of opening.
pub struct SeriesReader {
    file: Checked,
    info: SeriesInfo,
    point_offsets: Vec<usize>,
    fields: Vec<(Field, Vec<usize>)>,
}

/// Opens a series and reads its table of contents.
///
/// # Errors
/// As [`SeriesReader::open`].
pub fn read_series_info(path: &Path) -> Result<SeriesInfo, IoError> {
    SeriesReader::open(path).map(|reader| reader.info)
}

impl SeriesReader {
    /// Opens a series and checks that its lists agree with each other and with the sizes of its arrays.
    ///
    /// # Errors
    /// [`IoError::System`] or [`IoError::Hdf5`] when the file cannot be opened, [`IoError::Kind`] when it is
    /// HDF5 but no VTKHDF PolyData, [`IoError::Damaged`] when counts, offsets and sizes contradict each other.
    pub fn open(path: &Path) -> Result<Self, IoError> {
        let file = Checked::open(path)?;
        let times: Vec<f64> = file.rows(layout::TIMES, 0, file.shape(layout::TIMES)?.0)?;
        // A NaN compares as nothing and so counts as out of order.
        if let Some(pair) =
            times.windows(2).find(|pair| pair[0].partial_cmp(&pair[1]) != Some(Ordering::Less))
        {
            return Err(file.damaged(format!("time {} s follows {} s", pair[1], pair[0])));
        }
        let part_counts = file.list(layout::NUMBER_OF_POINTS, None)?;
        let count_of = |part: usize| {
            let count = part_counts.get(part).copied();
            count.ok_or_else(|| file.damaged(format!("part {part} of {} is asked for", part_counts.len())))
        };
        let parts = file.list(layout::PART_OFFSETS, Some(times.len()))?;
        let counts = parts.into_iter().map(count_of).collect::<Result<Vec<usize>, IoError>>()?;
        let point_offsets = file.list(layout::POINT_OFFSETS, Some(times.len()))?;
        if file.columns_holding(layout::POINTS, &point_offsets, &counts)? != 3 {
            return Err(file.damaged("points have not three coordinates".to_owned()));
        }
        let mut fields = Vec::new();
        for name in file.datasets(layout::POINT_DATA)? {
            let offsets = file.list(&layout::field_offsets(&name), Some(times.len()))?;
            let kind = match file.columns_holding(&layout::field(&name), &offsets, &counts)? {
                1 if name == schema::ID => FieldKind::Id,
                1 => FieldKind::Scalar,
                3 => FieldKind::Vector,
                n => return Err(file.damaged(format!("field `{name}` has {n} components"))),
            };
            let description = file.description(&name)?;
            fields.push((Field { name, kind, description }, offsets));
        }
        let told = |text: &String| Some(text.clone()).filter(|text| !text.is_empty());
        let described = fields.iter().map(|(field, _)| FieldInfo {
            name: field.name.clone(),
            components: field.columns().unwrap_or(1),
            unit: told(&field.description.unit).or(schema::unit(&field.name).map(str::to_owned)),
            definition: told(&field.description.definition),
            citation: told(&field.description.citation),
        });
        let info = SeriesInfo { times, counts, fields: described.collect() };
        Ok(Self { file, info, point_offsets, fields })
    }

    /// What the series holds.
    pub fn info(&self) -> &SeriesInfo {
        &self.info
    }

    /// Row of the file at which the positions of a frame begin; `None` where there is no such frame. Frames of the same row hold the
    /// same positions, bit for bit.
    pub fn position_row(&self, index: usize) -> Option<usize> {
        self.point_offsets.get(index).copied()
    }

    /// The same of a field; `None` also where there is no such field.
    pub fn field_row(&self, name: &str, index: usize) -> Option<usize> {
        let (_, offsets) = self.fields.iter().find(|(field, _)| field.name == name)?;
        offsets.get(index).copied()
    }

    /// Reads one frame.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] when there is no frame of that index, [`IoError::Hdf5`] when the data cannot be
    /// read (a damaged chunk, say).
    pub fn frame(&self, index: usize) -> Result<FrameData, IoError> {
        let Some((&time, &count)) = self.info.times.get(index).zip(self.info.counts.get(index)) else {
            let what = format!("frame {index} was asked for, the series has {}", self.info.times.len());
            return Err(IoError::Mismatch { path: self.file.path.clone(), what });
        };
        let mut frame = FrameData {
            time,
            position: self.file.vectors(layout::POINTS, self.point_offsets[index], count)?,
            ..FrameData::default()
        };
        for (field, offsets) in &self.fields {
            let path = layout::field(&field.name);
            match field.kind {
                FieldKind::Id => {
                    let ids: Vec<i64> = self.file.rows(&path, offsets[index], count)?;
                    frame.ids = Some(ids.into_iter().map(|id| id as u64).collect());
                }
                FieldKind::Scalar => {
                    let values: Vec<f32> = self.file.rows(&path, offsets[index], count)?;
                    frame.scalars.push((field.name.clone(), values.into_iter().map(f64::from).collect()));
                }
                FieldKind::Vector => {
                    let values = self.file.vectors(&path, offsets[index], count)?;
                    frame.vectors.push((field.name.clone(), values));
                }
            }
        }
        Ok(frame)
    }

    /// Corners of the triangles of a surface, as point numbers, the same for all frames; empty for particles.
    ///
    /// # Errors
    /// [`IoError::Damaged`] when the cells are no triangles or name points that are not there, [`IoError::Hdf5`] when the data
    /// cannot be read.
    pub fn triangles(&self) -> Result<Vec<[u32; 3]>, IoError> {
        let list = |name| self.file.list(&layout::cells(layout::POLYGONS, name), None);
        let cells = list("NumberOfCells")?.first().copied().unwrap_or(0);
        if cells == 0 {
            return Ok(Vec::new());
        }
        let (ends, corners) = (list("Offsets")?, list("Connectivity")?);
        let regular = ends.len() == cells + 1 && ends.iter().enumerate().all(|(k, &end)| end == 3 * k);
        if !regular || corners.len() != 3 * cells {
            return Err(self.file.damaged("the polygons are not triangles".to_owned()));
        }
        let points = self.info.counts.iter().copied().min().unwrap_or(0);
        if let Some(corner) = corners.iter().find(|&&corner| corner >= points) {
            return Err(self.file.damaged(format!("a triangle has the corner {corner} of {points} points")));
        }
        Ok(corners.chunks_exact(3).map(|t| [t[0] as u32, t[1] as u32, t[2] as u32]).collect())
    }

    /// Reads the last frame; `None` when there is none.
    ///
    /// # Errors
    /// As [`Self::frame`].
    pub fn last_frame(&self) -> Result<Option<FrameData>, IoError> {
        self.info.times.len().checked_sub(1).map(|index| self.frame(index)).transpose()
    }
}

/// A file whose every complaint carries its path.
struct Checked {
    path: PathBuf,
    file: Reader,
}

impl Checked {
    fn open(path: &Path) -> Result<Self, IoError> {
        let file = Reader::open(path).map_err(|text| IoError::hdf5(path, "read", text))?;
        let found = file.text(layout::ROOT, "Type").unwrap_or_else(|_| "no VTKHDF data".to_owned());
        if found != "PolyData" {
            let expected = "a VTKHDF series of PolyData".to_owned();
            return Err(IoError::Kind { path: path.to_owned(), found, expected });
        }
        Ok(Self { path: path.to_owned(), file })
    }

    fn damaged(&self, what: String) -> IoError {
        IoError::Damaged { path: self.path.clone(), what }
    }

    fn failed(&self, text: String) -> IoError {
        IoError::hdf5(&self.path, "read", text)
    }

    fn shape(&self, name: &str) -> Result<(usize, usize), IoError> {
        self.file.shape(name).map_err(|text| self.failed(text))
    }

    fn datasets(&self, group: &str) -> Result<Vec<String>, IoError> {
        self.file.datasets(group).map_err(|text| self.failed(text))
    }

    fn rows<T: crate::hdf5::Number>(
        &self,
        name: &str,
        start: usize,
        count: usize,
    ) -> Result<Vec<T>, IoError> {
        self.file.rows(name, start, count).map_err(|text| self.failed(text))
    }

    fn vectors(&self, name: &str, start: usize, count: usize) -> Result<Vec<DVec3>, IoError> {
        let values: Vec<f32> = self.rows(name, start, count)?;
        Ok(values.chunks_exact(3).map(|v| DVec3::new(v[0].into(), v[1].into(), v[2].into())).collect())
    }

    /// What the file says of a field.
    fn description(&self, field: &str) -> Result<Description, IoError> {
        let note = |name| {
            let text = self.file.note(&layout::field(field), name).map_err(|text| self.failed(text))?;
            Ok::<String, IoError>(text.unwrap_or_default())
        };
        Ok(Description {
            unit: note(layout::FIELD_UNITS)?,
            definition: note(layout::FIELD_DEFINITION)?,
            citation: note(layout::FIELD_CITATION)?,
        })
    }

    /// A list of non-negative integers, with one a frame where the number of frames is given.
    fn list(&self, name: &str, frames: Option<usize>) -> Result<Vec<usize>, IoError> {
        let (rows, _) = self.shape(name)?;
        if let Some(frames) = frames.filter(|&frames| frames != rows) {
            return Err(self.damaged(format!("`{name}` has {rows} entries for {frames} frames")));
        }
        self.rows::<i64>(name, 0, rows)?
            .into_iter()
            .map(|x| usize::try_from(x).map_err(|_| self.damaged(format!("`{name}` has the entry {x}"))))
            .collect()
    }

    /// Number of columns of an array, once every frame's rows are known to lie inside it.
    fn columns_holding(&self, name: &str, offsets: &[usize], counts: &[usize]) -> Result<usize, IoError> {
        let (rows, columns) = self.shape(name)?;
        for (&offset, &count) in offsets.iter().zip(counts) {
            if offset.checked_add(count).is_none_or(|end| end > rows) {
                return Err(self.damaged(format!(
                    "`{name}` has {rows} rows, a frame needs {count} from row {offset} on"
                )));
            }
        }
        Ok(columns)
    }
}

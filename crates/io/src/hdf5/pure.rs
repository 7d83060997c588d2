//! The pure-Rust library `rust-hdf5`.
//!
//! Three of its habits shape the code above it: a file is readable only after `close`; being killed while a
//! file is open for appending may spoil what was good before; and the shape a writing handle reports does
//! not follow its own appends, so row counts are kept by the caller.

use super::{Element, Growing, Number, Outcome, Read, Values, Write};
use rust_hdf5::{DatatypeMessage, H5Dataset, H5File, H5Group, H5Type};
use std::path::Path;

/// A file open for writing.
pub(crate) struct Writer(H5File);

/// A file open for reading.
pub(crate) struct Reader(H5File);

fn words<E: std::fmt::Display>(error: E) -> String {
    error.to_string()
}

/// Folder and name of an object; the folder of a root object is the empty string.
fn split(path: &str) -> (&str, &str) {
    path.rsplit_once('/').unwrap_or(("", path))
}

/// Type and bytes of fixed-length text.
fn fixed_text(value: &str) -> Outcome<(DatatypeMessage, Vec<u8>)> {
    // HDF5 has no strings of length zero.
    let mut bytes = value.as_bytes().to_vec();
    bytes.resize(bytes.len().max(1), 0);
    let size = u32::try_from(bytes.len()).map_err(words)?;
    Ok((DatatypeMessage::FixedString { size, padding: 1, charset: 0 }, bytes))
}

fn group_of(file: &H5File, path: &str) -> Outcome<H5Group> {
    let root = file.root_group();
    if path.is_empty() { Ok(root) } else { root.group(path).map_err(words) }
}

impl Writer {
    fn create_dataset<T: H5Type>(
        &self,
        path: &str,
        dimensions: &[usize],
        chunk: Option<(usize, Option<u32>)>,
    ) -> Outcome<H5Dataset> {
        let (folder, name) = split(path);
        let mut builder = group_of(&self.0, folder)?.new_dataset::<T>().shape(dimensions);
        if let Some((rows, deflate)) = chunk {
            let mut chunk = dimensions.to_vec();
            let mut limit: Vec<Option<usize>> = dimensions.iter().copied().map(Some).collect();
            chunk[0] = rows;
            limit[0] = None;
            builder = builder.chunk(&chunk).max_shape(&limit);
            if let Some(level) = deflate {
                builder = builder.shuffle_deflate(level);
            }
        }
        builder.create(name).map_err(words)
    }
}

impl Write for Writer {
    fn create(path: &Path) -> Outcome<Self> {
        H5File::create(path).map(Self).map_err(words)
    }

    fn append(path: &Path) -> Outcome<Self> {
        H5File::open_rw(path).map(Self).map_err(words)
    }

    fn group(&self, path: &str) -> Outcome<()> {
        let (folder, name) = split(path);
        group_of(&self.0, folder)?.create_group(name).map(drop).map_err(words)
    }

    fn text(&self, group: &str, name: &str, value: &str) -> Outcome<()> {
        let (kind, bytes) = fixed_text(value)?;
        group_of(&self.0, group)?.set_attr_typed(name, kind, bytes).map_err(words)
    }

    fn note(&self, dataset: &str, name: &str, value: &str) -> Outcome<()> {
        let (kind, bytes) = fixed_text(value)?;
        let dataset = self.0.dataset_writer(dataset).map_err(words)?;
        dataset.set_attr_typed(name, kind, bytes).map_err(words)
    }

    fn integers(&self, group: &str, name: &str, values: &[i64]) -> Outcome<()> {
        let group = group_of(&self.0, group)?;
        match values {
            [one] => group.set_attr_numeric(name, one),
            several => group.set_attr_array_numeric(name, several),
        }
        .map_err(words)
    }

    fn growing(&self, path: &str, shape: Growing) -> Outcome<()> {
        let dimensions: Vec<usize> = std::iter::once(0).chain(shape.columns).collect();
        let chunk = Some((shape.chunk, shape.deflate));
        match shape.element {
            Element::F32 => self.create_dataset::<f32>(path, &dimensions, chunk),
            Element::F64 => self.create_dataset::<f64>(path, &dimensions, chunk),
            Element::I64 => self.create_dataset::<i64>(path, &dimensions, chunk),
        }
        .map(drop)
    }

    fn extend(&self, path: &str, values: Values<'_>) -> Outcome<()> {
        if values.is_empty() {
            return Ok(());
        }
        let dataset = self.0.dataset_writer(path).map_err(words)?;
        match values {
            Values::F32(v) => dataset.append(v),
            Values::F64(v) => dataset.append(v),
            Values::I64(v) => dataset.append(v),
            Values::U64(v) => dataset.append(v),
            Values::U8(v) => dataset.append(v),
        }
        .map_err(words)
    }

    fn fixed(&self, path: &str, values: Values<'_>, columns: Option<usize>) -> Outcome<()> {
        fn fill<T: H5Type>(writer: &Writer, path: &str, shape: &[usize], values: &[T]) -> Outcome<()> {
            let dataset = writer.create_dataset::<T>(path, shape, None)?;
            if values.is_empty() { Ok(()) } else { dataset.write_raw(values).map_err(words) }
        }
        let rows = values.len() / columns.unwrap_or(1).max(1);
        let shape: Vec<usize> = std::iter::once(rows).chain(columns).collect();
        match values {
            Values::F32(v) => fill(self, path, &shape, v),
            Values::F64(v) => fill(self, path, &shape, v),
            Values::I64(v) => fill(self, path, &shape, v),
            Values::U64(v) => fill(self, path, &shape, v),
            Values::U8(v) => fill(self, path, &shape, v),
        }
    }

    fn close(self) -> Outcome<()> {
        self.0.close_no_sync().map_err(words)
    }
}

impl Read for Reader {
    fn open(path: &Path) -> Outcome<Self> {
        H5File::open(path).map(Self).map_err(words)
    }

    fn text(&self, group: &str, name: &str) -> Outcome<String> {
        let group = group_of(&self.0, group)?;
        let text = group.attr_string(name).map_err(words)?;
        Ok(text.trim_end_matches('\0').to_owned())
    }

    fn note(&self, dataset: &str, name: &str) -> Outcome<Option<String>> {
        let dataset = self.0.dataset(dataset).map_err(words)?;
        if !dataset.attr_names().map_err(words)?.iter().any(|present| present == name) {
            return Ok(None);
        }
        let text = dataset.attr(name).and_then(|attribute| attribute.read_string()).map_err(words)?;
        Ok(Some(text.trim_end_matches('\0').to_owned()))
    }

    fn datasets(&self, group: &str) -> Outcome<Vec<String>> {
        let mut names = group_of(&self.0, group)?.dataset_names().map_err(words)?;
        names.sort();
        Ok(names)
    }

    fn shape(&self, path: &str) -> Outcome<(usize, usize)> {
        match self.0.dataset(path).map_err(words)?.shape()[..] {
            [rows] => Ok((rows, 1)),
            [rows, columns] => Ok((rows, columns)),
            ref other => Err(format!("dataset \"{path}\" has rank {}, expected 1 or 2", other.len())),
        }
    }

    fn rows<T: Number>(&self, path: &str, start: usize, count: usize) -> Outcome<Vec<T>> {
        if count == 0 {
            return Ok(Vec::new());
        }
        let dataset = self.0.dataset(path).map_err(words)?;
        match dataset.shape()[..] {
            [_] => dataset.read_slice(&[start], &[count]),
            [_, columns] => dataset.read_slice(&[start, 0], &[count, columns]),
            ref other => return Err(format!("dataset \"{path}\" has rank {}, expected 1 or 2", other.len())),
        }
        .map_err(words)
    }
}

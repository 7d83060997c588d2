//! The reference C library through `hdf5-metno`, to check the pure-Rust library against.

use super::{Element, Growing, Number, Outcome, Read, Values, Write};
use hdf5_metno::types::{FixedAscii, VarLenAscii};
use hdf5_metno::{Attribute, Dataset, Extent, File, Group, H5Type, SimpleExtents};
use std::path::Path;

/// A file open for writing.
pub(crate) struct Writer(File);

/// A file open for reading.
pub(crate) struct Reader(File);

fn words<E: std::fmt::Display>(error: E) -> String {
    error.to_string()
}

fn group_of(file: &File, path: &str) -> Outcome<Group> {
    file.group(if path.is_empty() { "/" } else { path }).map_err(words)
}

/// Last component of the name the library gives an object, which is its full path.
fn base(name: &str) -> String {
    name.rsplit_once('/').map_or(name, |(_, base)| base).to_owned()
}

fn read_text(attribute: &Attribute) -> Outcome<String> {
    // The other library writes text of fixed length; the longest of ours is a formula of some hundred letters.
    let fixed = || attribute.read_scalar::<FixedAscii<512>>().map(|text| text.as_str().to_owned());
    attribute
        .read_scalar::<VarLenAscii>()
        .map(|text| text.as_str().to_owned())
        .or_else(|_| fixed())
        .map_err(words)
}

fn create<T: H5Type>(file: &File, path: &str, shape: Growing) -> Outcome<()> {
    let extents: Vec<Extent> =
        std::iter::once(Extent::resizable(0)).chain(shape.columns.map(Extent::fixed)).collect();
    let mut builder = file.new_dataset::<T>();
    if let Some(level) = shape.deflate {
        builder = builder.shuffle().deflate(u8::try_from(level).map_err(words)?);
    }
    let builder = match shape.columns {
        None => builder.chunk(shape.chunk),
        Some(columns) => builder.chunk((shape.chunk, columns)),
    };
    builder.shape(SimpleExtents::from_vec(extents)).create(path).map(drop).map_err(words)
}

/// Fills the rows from `start` on; the library takes the number of columns from the type of the view.
fn fill<T: H5Type>(dataset: &Dataset, start: usize, values: &[T]) -> Outcome<()> {
    fn rows<T: H5Type, const N: usize>(dataset: &Dataset, start: usize, values: &[T]) -> Outcome<()> {
        let (rows, rest) = values.as_chunks::<N>();
        if !rest.is_empty() {
            return Err(format!("{} values do not make rows of {N}", values.len()));
        }
        dataset.write_slice::<_, T, _, _>(rows, (start..start + rows.len(), ..)).map_err(words)
    }
    match dataset.shape()[..] {
        [_] => dataset.write_slice(values, start..start + values.len()).map_err(words),
        [_, 3] => rows::<T, 3>(dataset, start, values),
        [_, 4] => rows::<T, 4>(dataset, start, values),
        ref other => Err(format!("no rows of shape {other:?} are written by this program")),
    }
}

fn extend<T: H5Type>(dataset: &Dataset, values: &[T]) -> Outcome<()> {
    let mut shape = dataset.shape();
    let columns = shape.get(1).copied().unwrap_or(1);
    let start = shape[0];
    shape[0] += values.len() / columns;
    dataset.resize(shape).map_err(words)?;
    fill(dataset, start, values)
}

impl Write for Writer {
    fn create(path: &Path) -> Outcome<Self> {
        File::create(path).map(Self).map_err(words)
    }

    fn append(path: &Path) -> Outcome<Self> {
        File::open_rw(path).map(Self).map_err(words)
    }

    fn group(&self, path: &str) -> Outcome<()> {
        self.0.create_group(path).map(drop).map_err(words)
    }

    fn text(&self, group: &str, name: &str, value: &str) -> Outcome<()> {
        let text = VarLenAscii::from_ascii(value).map_err(words)?;
        let attribute = group_of(&self.0, group)?.new_attr::<VarLenAscii>().create(name).map_err(words)?;
        attribute.write_scalar(&text).map_err(words)
    }

    fn note(&self, dataset: &str, name: &str, value: &str) -> Outcome<()> {
        let text = VarLenAscii::from_ascii(value).map_err(words)?;
        let dataset = self.0.dataset(dataset).map_err(words)?;
        let attribute = dataset.new_attr::<VarLenAscii>().create(name).map_err(words)?;
        attribute.write_scalar(&text).map_err(words)
    }

    fn integers(&self, group: &str, name: &str, values: &[i64]) -> Outcome<()> {
        let group = group_of(&self.0, group)?;
        if let [one] = values {
            let attribute = match group.attr(name) {
                Ok(present) => present,
                Err(_) => group.new_attr::<i64>().create(name).map_err(words)?,
            };
            return attribute.write_scalar(one).map_err(words);
        }
        let attribute = group.new_attr::<i64>().shape(values.len()).create(name).map_err(words)?;
        attribute.write(values).map_err(words)
    }

    fn growing(&self, path: &str, shape: Growing) -> Outcome<()> {
        match shape.element {
            Element::F32 => create::<f32>(&self.0, path, shape),
            Element::F64 => create::<f64>(&self.0, path, shape),
            Element::I64 => create::<i64>(&self.0, path, shape),
        }
    }

    fn extend(&self, path: &str, values: Values<'_>) -> Outcome<()> {
        if values.is_empty() {
            return Ok(());
        }
        let dataset = self.0.dataset(path).map_err(words)?;
        match values {
            Values::F32(v) => extend(&dataset, v),
            Values::F64(v) => extend(&dataset, v),
            Values::I64(v) => extend(&dataset, v),
            Values::U64(v) => extend(&dataset, v),
            Values::U8(v) => extend(&dataset, v),
        }
    }

    fn fixed(&self, path: &str, values: Values<'_>, columns: Option<usize>) -> Outcome<()> {
        fn write<T: H5Type>(file: &File, path: &str, shape: &[usize], values: &[T]) -> Outcome<()> {
            let dataset = file.new_dataset::<T>().shape(shape).create(path).map_err(words)?;
            if values.is_empty() { Ok(()) } else { fill(&dataset, 0, values) }
        }
        let rows = values.len() / columns.unwrap_or(1).max(1);
        let shape: Vec<usize> = std::iter::once(rows).chain(columns).collect();
        match values {
            Values::F32(v) => write(&self.0, path, &shape, v),
            Values::F64(v) => write(&self.0, path, &shape, v),
            Values::I64(v) => write(&self.0, path, &shape, v),
            Values::U64(v) => write(&self.0, path, &shape, v),
            Values::U8(v) => write(&self.0, path, &shape, v),
        }
    }

    fn close(self) -> Outcome<()> {
        self.0.close().map_err(words)
    }
}

impl Read for Reader {
    fn open(path: &Path) -> Outcome<Self> {
        File::open(path).map(Self).map_err(words)
    }

    fn text(&self, group: &str, name: &str) -> Outcome<String> {
        read_text(&group_of(&self.0, group)?.attr(name).map_err(words)?)
    }

    fn note(&self, dataset: &str, name: &str) -> Outcome<Option<String>> {
        let dataset = self.0.dataset(dataset).map_err(words)?;
        if !dataset.attr_names().map_err(words)?.iter().any(|present| present == name) {
            return Ok(None);
        }
        read_text(&dataset.attr(name).map_err(words)?).map(Some)
    }

    fn datasets(&self, group: &str) -> Outcome<Vec<String>> {
        let found = group_of(&self.0, group)?.datasets().map_err(words)?;
        let mut names: Vec<String> = found.iter().map(|dataset| base(&dataset.name())).collect();
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
        if dataset.ndim() == 1 {
            let values = dataset.read_slice_1d::<T, _>(start..start + count).map_err(words)?;
            Ok(values.iter().copied().collect())
        } else {
            let values = dataset.read_slice_2d::<T, _>((start..start + count, ..)).map_err(words)?;
            Ok(values.iter().copied().collect())
        }
    }
}

//! The little of HDF5 this project needs, as two traits, so that the library behind it can be exchanged.
//!
//! [`pure`] is Rust only and is the default: a fresh machine builds it with nothing but a linker.
//! [`c`] wraps the reference C library behind the feature `hdf5-c`; the same tests run on both.
//!
//! Objects are addressed by their path without a leading slash; `""` is the root group.

#[cfg(feature = "hdf5-c")]
mod c;
// With the C library in its place it is still compared against.
#[cfg(any(not(feature = "hdf5-c"), test))]
mod pure;

use std::path::Path;

/// The library's own words; the caller knows file and purpose and makes an [`crate::IoError`] of them.
pub(crate) type Outcome<T> = Result<T, String>;

#[cfg(feature = "hdf5-c")]
pub(crate) use c::{Reader, Writer};
#[cfg(not(feature = "hdf5-c"))]
pub(crate) use pure::{Reader, Writer};

/// Type of one number in a growing dataset; little-endian on disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Element {
    F32,
    F64,
    I64,
}

/// Numbers to be written, rows one after the other.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Values<'a> {
    F32(&'a [f32]),
    F64(&'a [f64]),
    I64(&'a [i64]),
    U64(&'a [u64]),
    U8(&'a [u8]),
}

impl Values<'_> {
    pub(crate) fn len(&self) -> usize {
        match self {
            Self::F32(v) => v.len(),
            Self::F64(v) => v.len(),
            Self::I64(v) => v.len(),
            Self::U64(v) => v.len(),
            Self::U8(v) => v.len(),
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// A dataset that grows by rows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Growing {
    pub(crate) element: Element,
    /// `None`: a list of numbers (rank 1); `Some(n)`: rows of `n` numbers (rank 2).
    pub(crate) columns: Option<usize>,
    /// Rows a chunk.
    pub(crate) chunk: usize,
    /// Byte shuffle and deflate at this level.
    pub(crate) deflate: Option<u32>,
}

/// Writing side.
pub(crate) trait Write: Sized {
    /// Makes a new file, replacing one of the same name.
    fn create(path: &Path) -> Outcome<Self>;
    /// Opens an existing file to append to its datasets.
    fn append(path: &Path) -> Outcome<Self>;
    /// Makes a group; its parent exists.
    fn group(&self, path: &str) -> Outcome<()>;
    /// Sets an attribute of a group to fixed-length ASCII text.
    fn text(&self, group: &str, name: &str, value: &str) -> Outcome<()>;
    /// Sets an attribute of a dataset to fixed-length ASCII text.
    fn note(&self, dataset: &str, name: &str, value: &str) -> Outcome<()>;
    /// Sets an attribute of a group to integers: one makes a scalar, several an array.
    fn integers(&self, group: &str, name: &str, values: &[i64]) -> Outcome<()>;
    /// Makes an empty dataset that can grow.
    fn growing(&self, path: &str, shape: Growing) -> Outcome<()>;
    /// Appends whole rows to a growing dataset.
    fn extend(&self, path: &str, values: Values<'_>) -> Outcome<()>;
    /// Makes a dataset of fixed size and fills it; `columns` as in [`Growing`].
    fn fixed(&self, path: &str, values: Values<'_>, columns: Option<usize>) -> Outcome<()>;
    /// Completes the file; before this it is not readable. Forcing it to disk is the caller's part.
    fn close(self) -> Outcome<()>;
}

/// Reading side.
pub(crate) trait Read: Sized {
    /// Opens a file.
    fn open(path: &Path) -> Outcome<Self>;
    /// Text attribute of a group.
    fn text(&self, group: &str, name: &str) -> Outcome<String>;
    /// Text attribute of a dataset; `None` where it has none of that name.
    fn note(&self, dataset: &str, name: &str) -> Outcome<Option<String>>;
    /// Names of the datasets directly in a group, in order of name.
    fn datasets(&self, group: &str) -> Outcome<Vec<String>>;
    /// Number of rows and of columns (1 for a list).
    fn shape(&self, path: &str) -> Outcome<(usize, usize)>;
    /// `count` rows from `start` on.
    fn rows<T: Number>(&self, path: &str, start: usize, count: usize) -> Outcome<Vec<T>>;
    /// All rows.
    fn all<T: Number>(&self, path: &str) -> Outcome<Vec<T>> {
        let (rows, _) = self.shape(path)?;
        self.rows(path, 0, rows)
    }
}

/// A number type both libraries know.
#[cfg(not(feature = "hdf5-c"))]
pub(crate) trait Number: Copy + rust_hdf5::H5Type {}
/// A number type both libraries know.
#[cfg(feature = "hdf5-c")]
pub(crate) trait Number: Copy + rust_hdf5::H5Type + hdf5_metno::H5Type {}

impl Number for f32 {}
impl Number for f64 {}
impl Number for i64 {}
impl Number for u64 {}
impl Number for u8 {}

#[cfg(all(test, feature = "hdf5-c"))]
mod tests {
    use super::*;

    fn write<W: Write>(path: &Path) {
        let file = W::create(path).unwrap();
        file.group("a").unwrap();
        file.text("a", "Name", "PolyData").unwrap();
        file.integers("a", "Version", &[2, 0]).unwrap();
        let shape = Growing { element: Element::F32, columns: Some(3), chunk: 16, deflate: Some(1) };
        file.growing("a/points", shape).unwrap();
        file.growing("a/times", Growing { element: Element::F64, columns: None, deflate: None, ..shape })
            .unwrap();
        file.fixed("a/ids", Values::U64(&[7, u64::MAX]), None).unwrap();
        file.note("a/points", "units", "m").unwrap();
        file.close().unwrap();
        for session in 0..3 {
            let file = W::append(path).unwrap();
            let rows: Vec<f32> = (0..60).map(|k| (session * 60 + k) as f32 / 7.0).collect();
            file.extend("a/points", Values::F32(&rows)).unwrap();
            file.extend("a/times", Values::F64(&[f64::from(session)])).unwrap();
            file.close().unwrap();
        }
    }

    fn check<R: Read>(path: &Path) {
        let file = R::open(path).unwrap();
        assert_eq!(file.text("a", "Name").unwrap(), "PolyData");
        assert_eq!(file.note("a/points", "units").unwrap().as_deref(), Some("m"));
        assert_eq!(file.note("a/points", "citation").unwrap(), None);
        assert_eq!(file.datasets("a").unwrap(), ["ids", "points", "times"]);
        assert_eq!(file.shape("a/points").unwrap(), (60, 3));
        let points: Vec<f32> = file.all("a/points").unwrap();
        assert_eq!(points, (0..180).map(|k| k as f32 / 7.0).collect::<Vec<_>>());
        assert_eq!(file.rows::<f32>("a/points", 17, 5).unwrap(), points[51..66]);
        assert_eq!(file.all::<f64>("a/times").unwrap(), [0.0, 1.0, 2.0]);
        assert_eq!(file.all::<u64>("a/ids").unwrap(), [7, u64::MAX]);
    }

    #[test]
    fn either_library_reads_what_the_other_wrote() {
        let folder = tempfile::tempdir().unwrap();
        let (ours, theirs) = (folder.path().join("pure.h5"), folder.path().join("c.h5"));
        write::<pure::Writer>(&ours);
        write::<c::Writer>(&theirs);
        for path in [&ours, &theirs] {
            check::<pure::Reader>(path);
            check::<c::Reader>(path);
        }
    }
}

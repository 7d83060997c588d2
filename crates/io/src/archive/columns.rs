//! A body's columns in and out of an archive, through the one list every body keeps of them.

use super::Archive;
use crate::IoError;
use glam::DVec3;
use std::path::Path;
use vaso_particles::{Column, Columns, Visitor};

impl Archive {
    /// Stores every column of a body under `<body>.<column>`.
    pub fn put_columns(&mut self, body: &str, columns: &mut dyn Columns) {
        columns.visit(&mut Save { archive: self, body });
    }

    /// Fills every column of a body from `<body>.<column>`, bit for bit; the number of particles becomes
    /// that of the archive.
    ///
    /// `path` is the file the archive came from, for the error text.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] with the first column that is missing, of another type or of another length than
    /// the column before it; the columns are then partly filled and of no use.
    pub fn fill_columns(&self, path: &Path, body: &str, columns: &mut dyn Columns) -> Result<(), IoError> {
        let mut restore = Restore { archive: self, body, count: None, fault: None };
        columns.visit(&mut restore);
        match restore.fault {
            Some(what) => Err(IoError::Mismatch { path: path.to_owned(), what }),
            None => Ok(()),
        }
    }
}

struct Save<'a> {
    archive: &'a mut Archive,
    body: &'a str,
}

impl Save<'_> {
    fn name<T>(&self, column: &Column<T>) -> String {
        format!("{}.{}", self.body, column.name())
    }
}

impl Visitor for Save<'_> {
    fn scalar(&mut self, column: &mut Column<f64>) {
        self.archive.put_floats(&self.name(column), column);
    }

    fn vector(&mut self, column: &mut Column<DVec3>) {
        self.archive.put_vectors(&self.name(column), column);
    }

    fn integer(&mut self, column: &mut Column<u64>) {
        self.archive.put_integers(&self.name(column), column);
    }

    fn label(&mut self, column: &mut Column<i32>) {
        let values: Vec<u64> = column.iter().map(|&label| u64::from(label.cast_unsigned())).collect();
        self.archive.put_integers(&self.name(column), &values);
    }
}

struct Restore<'a> {
    archive: &'a Archive,
    body: &'a str,
    count: Option<usize>,
    fault: Option<String>,
}

impl Restore<'_> {
    fn fill<T>(&mut self, column: &mut Column<T>, read: impl Fn(&Archive, &str) -> Option<Vec<T>>) {
        let name = format!("{}.{}", self.body, column.name());
        let Some(values) = read(self.archive, &name) else {
            self.fault.get_or_insert(format!("the column `{name}` is missing or of another type"));
            return;
        };
        let count = *self.count.get_or_insert(values.len());
        if values.len() != count {
            self.fault.get_or_insert(format!(
                "the column `{name}` has {} entries, the columns before it {count}",
                values.len()
            ));
        }
        *column = Column::with(column.name(), column.unit(), values);
    }
}

impl Visitor for Restore<'_> {
    fn scalar(&mut self, column: &mut Column<f64>) {
        self.fill(column, |archive, name| archive.floats(name).map(<[f64]>::to_vec));
    }

    fn vector(&mut self, column: &mut Column<DVec3>) {
        self.fill(column, Archive::vectors);
    }

    fn integer(&mut self, column: &mut Column<u64>) {
        self.fill(column, |archive, name| archive.integers(name).map(<[u64]>::to_vec));
    }

    fn label(&mut self, column: &mut Column<i32>) {
        self.fill(column, |archive, name| {
            let bits = archive.integers(name)?;
            bits.iter().map(|&bits| u32::try_from(bits).ok().map(u32::cast_signed)).collect()
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Body {
        position: Column<DVec3>,
        density: Column<f64>,
        id: Column<u64>,
        buffer: Column<i32>,
    }

    impl Columns for Body {
        fn visit(&mut self, visitor: &mut dyn Visitor) {
            let Self { position, density, id, buffer } = self;
            visitor.vector(position);
            visitor.scalar(density);
            visitor.integer(id);
            visitor.label(buffer);
        }
    }

    fn body(count: usize) -> Body {
        let at = |i: usize| (i as f64 + 1.0).recip();
        Body {
            position: Column::with("position", "m", (0..count).map(|i| DVec3::splat(at(i))).collect()),
            density: Column::with("density", "kg/m^3", (0..count).map(|i| 1060.0 + at(i)).collect()),
            id: Column::with("id", "", (0..count as u64).map(|i| i << 40).collect()),
            buffer: Column::with("buffer", "", (0..count).map(|i| i as i32 - 2).collect()),
        }
    }

    #[test]
    fn a_body_comes_back_bit_for_bit_with_another_number_of_particles() {
        let mut archive = Archive::new("checkpoint", 1);
        archive.put_columns("fluid", &mut body(7));
        let mut restored = body(3);
        archive.fill_columns(Path::new("checkpoint.h5"), "fluid", &mut restored).unwrap();
        let original = body(7);
        assert_eq!(restored.position[..], original.position[..]);
        assert_eq!(restored.density[..], original.density[..]);
        assert_eq!(restored.id[..], original.id[..]);
        assert_eq!(restored.buffer[..], original.buffer[..]);
        assert_eq!(restored.density.unit(), "kg/m^3");
    }

    #[test]
    fn a_missing_or_short_column_is_named() {
        let mut archive = Archive::new("checkpoint", 1);
        archive.put_columns("fluid", &mut body(7));
        let path = Path::new("checkpoint.h5");
        let error = archive.fill_columns(path, "wall", &mut body(7)).unwrap_err().to_string();
        assert!(error.contains("`wall.position`"), "{error}");
        archive.put_floats("fluid.density", &[1.0]);
        let error = archive.fill_columns(path, "fluid", &mut body(7)).unwrap_err().to_string();
        assert!(error.contains("`fluid.density`") && error.contains('7'), "{error}");
    }
}

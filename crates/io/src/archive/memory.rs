//! The state of a run in and out of an archive, through the lists that its parts keep of it.

use super::Archive;
use crate::IoError;
use glam::DVec3;
use std::path::Path;
use vaso_particles::{Columns, Memory};

/// Puts what it is shown into an archive.
struct Writing<'a>(&'a mut Archive);

impl Memory for Writing<'_> {
    fn numbers(&mut self, name: &str, values: &mut Vec<f64>) {
        self.0.put_floats(name, values);
    }

    fn integers(&mut self, name: &str, values: &mut Vec<u64>) {
        self.0.put_integers(name, values);
    }

    fn vectors(&mut self, name: &str, values: &mut Vec<DVec3>) {
        self.0.put_vectors(name, values);
    }

    fn columns(&mut self, name: &str, body: &mut dyn Columns) {
        self.0.put_columns(name, body);
    }

    /// What is written is what there is: nothing can fail to fit.
    fn refuse(&mut self, _: &str, _: String) {}
}

/// Fills what it is shown from an archive, and keeps the first fault.
struct Reading<'a> {
    archive: &'a Archive,
    path: &'a Path,
    fault: Option<String>,
}

impl Reading<'_> {
    fn fill<T>(&mut self, name: &str, to: &mut Vec<T>, found: Option<Vec<T>>) {
        match found {
            Some(values) => *to = values,
            None => self.refuse(name, "it is missing or of another type".to_owned()),
        }
    }
}

impl Memory for Reading<'_> {
    fn numbers(&mut self, name: &str, values: &mut Vec<f64>) {
        self.fill(name, values, self.archive.floats(name).map(<[f64]>::to_vec));
    }

    fn integers(&mut self, name: &str, values: &mut Vec<u64>) {
        self.fill(name, values, self.archive.integers(name).map(<[u64]>::to_vec));
    }

    fn vectors(&mut self, name: &str, values: &mut Vec<DVec3>) {
        self.fill(name, values, self.archive.vectors(name));
    }

    fn columns(&mut self, name: &str, body: &mut dyn Columns) {
        if let Err(IoError::Mismatch { what, .. }) = self.archive.fill_columns(self.path, name, body) {
            self.fault.get_or_insert(what);
        }
    }

    fn refuse(&mut self, name: &str, what: String) {
        self.fault.get_or_insert(format!("`{name}`: {what}"));
    }
}

impl Archive {
    /// Stores all that `part` shows of itself.
    pub fn remember(&mut self, part: impl FnOnce(&mut dyn Memory)) {
        part(&mut Writing(self));
    }

    /// Fills all that `part` shows of itself, bit for bit.
    ///
    /// `path` is the file the archive came from, for the error text.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] with the first thing that is missing or does not fit; the part is then of no use.
    pub fn recall(&self, path: &Path, part: impl FnOnce(&mut dyn Memory)) -> Result<(), IoError> {
        let mut reading = Reading { archive: self, path, fault: None };
        part(&mut reading);
        match reading.fault {
            Some(what) => Err(IoError::Mismatch { path: path.to_owned(), what }),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, Default, PartialEq)]
    struct Part {
        time: f64,
        work: f64,
        steps: u64,
        capacity: Option<f64>,
        force: Vec<DVec3>,
        rows: Vec<f64>,
    }

    impl Part {
        fn remember(&mut self, memory: &mut dyn Memory) {
            let Self { time, work, steps, capacity, force, rows } = self;
            memory.fields("part.clock", &mut [time, work]);
            memory.counts("part.steps", &mut [steps]);
            memory.optional("part.capacity", capacity);
            memory.fixed_vectors("part.force", force);
            memory.numbers("part.rows", rows);
        }
    }

    fn written() -> (Part, Archive) {
        let mut part = Part {
            time: 0.1 + 0.2,
            work: -0.0,
            steps: u64::MAX,
            capacity: Some(1.0 / 3.0),
            force: vec![DVec3::X; 2],
            rows: vec![f64::INFINITY, 5e-324],
        };
        let mut archive = Archive::new("checkpoint", 1);
        archive.remember(|memory| part.remember(memory));
        (part, archive)
    }

    #[test]
    fn a_part_comes_back_as_it_was() {
        let (part, archive) = written();
        let mut other = Part { force: vec![DVec3::ZERO; 2], ..Part::default() };
        archive.recall(Path::new("a.h5"), |memory| other.remember(memory)).expect("it fits");
        assert_eq!(other, part);
        assert_eq!(other.work.to_bits(), part.work.to_bits());
    }

    #[test]
    fn what_does_not_fit_is_named_and_left_out() {
        let (_, archive) = written();
        let mut other = Part { force: vec![DVec3::ZERO; 3], ..Part::default() };
        let error = archive.recall(Path::new("a.h5"), |memory| other.remember(memory)).unwrap_err();
        assert!(error.to_string().contains("`part.force`: it has 2 values, 3 are needed"), "{error}");
        assert_eq!(other.force.len(), 3);
        let empty = Archive::new("checkpoint", 1);
        let error = empty.recall(Path::new("a.h5"), |memory| other.remember(memory)).unwrap_err();
        assert!(
            error.to_string().contains("`part.clock`") && error.to_string().contains("missing"),
            "{error}"
        );
    }
}

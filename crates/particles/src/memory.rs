//! What a part of a run carries from step to step beside and within its columns, listed once for writing and for reading.

use crate::visit::Columns;
use glam::DVec3;

/// Where the state of a run goes to, or comes from.
///
/// A part of a run has a function `remember` that takes itself apart with an exhaustive pattern and shows all that its next step
/// depends on, always in the same way. A memory that writes leaves what it is shown as it is; one that reads fills it, or
/// notes what does not fit and leaves it. So what is written is what is read, and a forgotten field does not compile.
pub trait Memory {
    /// A list of numbers, as long when read as it was when written.
    fn numbers(&mut self, name: &str, values: &mut Vec<f64>);

    /// A list of integers, as long when read as it was when written.
    fn integers(&mut self, name: &str, values: &mut Vec<u64>);

    /// A list of vectors, as long when read as it was when written.
    fn vectors(&mut self, name: &str, values: &mut Vec<DVec3>);

    /// All columns of a body.
    fn columns(&mut self, name: &str, body: &mut dyn Columns);

    /// Notes that what goes by `name` does not fit, and why.
    fn refuse(&mut self, name: &str, what: String);

    /// Numbers of a part, as many as it has.
    fn fields(&mut self, name: &str, fields: &mut [&mut f64]) {
        let mut values: Vec<f64> = fields.iter().map(|field| **field).collect();
        self.numbers(name, &mut values);
        if fits(self, name, values.len(), fields.len()) {
            fields.iter_mut().zip(values).for_each(|(field, value)| **field = value);
        }
    }

    /// Counters of a part, as many as it has.
    fn counts(&mut self, name: &str, fields: &mut [&mut u64]) {
        let mut values: Vec<u64> = fields.iter().map(|field| **field).collect();
        self.integers(name, &mut values);
        if fits(self, name, values.len(), fields.len()) {
            fields.iter_mut().zip(values).for_each(|(field, value)| **field = value);
        }
    }

    /// A number that there may be or not.
    fn optional(&mut self, name: &str, value: &mut Option<f64>) {
        let mut values: Vec<f64> = value.iter().copied().collect();
        self.numbers(name, &mut values);
        *value = values.first().copied();
    }

    /// A list of numbers whose length is fixed by the case.
    fn fixed_numbers(&mut self, name: &str, values: &mut Vec<f64>) {
        let mut read = values.clone();
        self.numbers(name, &mut read);
        if fits(self, name, read.len(), values.len()) {
            *values = read;
        }
    }

    /// A list of vectors whose length is fixed by the case.
    fn fixed_vectors(&mut self, name: &str, values: &mut Vec<DVec3>) {
        let mut read = values.clone();
        self.vectors(name, &mut read);
        if fits(self, name, read.len(), values.len()) {
            *values = read;
        }
    }
}

/// Whether as many values are there as are needed; notes it where they are not.
fn fits<M: Memory + ?Sized>(memory: &mut M, name: &str, seen: usize, needed: usize) -> bool {
    if seen != needed {
        memory.refuse(name, format!("it has {seen} values, {needed} are needed"));
    }
    seen == needed
}

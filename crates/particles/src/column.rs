//! One quantity of all particles of a body.

use glam::DVec3;
use std::ops::{Deref, DerefMut};

/// Values of one quantity, one entry a particle, with the name and unit they carry in files.
#[derive(Clone, Debug)]
pub struct Column<T> {
    name: &'static str,
    unit: &'static str,
    data: Vec<T>,
}

impl<T> Column<T> {
    /// Empty column; `name` is the word used in code, case files and HDF5, `unit` is SI.
    pub fn new(name: &'static str, unit: &'static str) -> Self {
        Self { name, unit, data: Vec::new() }
    }

    /// Column with values.
    pub fn with(name: &'static str, unit: &'static str, data: Vec<T>) -> Self {
        Self { name, unit, data }
    }

    /// Name of the quantity.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// SI unit, empty for pure numbers.
    pub fn unit(&self) -> &'static str {
        self.unit
    }

    /// Bytes held, reserve included.
    pub fn bytes(&self) -> usize {
        self.data.capacity() * size_of::<T>()
    }

    /// The vector behind the column, for changes of length by [`crate::visit`].
    pub(crate) fn vec_mut(&mut self) -> &mut Vec<T> {
        &mut self.data
    }
}

impl<T> Deref for Column<T> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.data
    }
}

impl<T> DerefMut for Column<T> {
    fn deref_mut(&mut self) -> &mut [T] {
        &mut self.data
    }
}

/// Column of vectors.
pub type VectorColumn = Column<DVec3>;
/// Column of numbers.
pub type ScalarColumn = Column<f64>;

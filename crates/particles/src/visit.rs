//! One list of columns a body, six uses: reorder, append, remove, scan, count, save.

use crate::column::Column;
use glam::DVec3;
use rayon::prelude::*;

/// A set of columns of equal length.
///
/// `visit` takes the body apart with an exhaustive pattern, so that a forgotten column does not
/// compile; there is no default to fall back on.
pub trait Columns {
    /// Shows every column to `visitor`, always in the same order.
    fn visit(&mut self, visitor: &mut dyn Visitor);
}

/// What is done to each column.
pub trait Visitor {
    /// A column of numbers.
    fn scalar(&mut self, column: &mut Column<f64>);
    /// A column of vectors.
    fn vector(&mut self, column: &mut Column<DVec3>);
    /// A column of identities or counters.
    fn integer(&mut self, column: &mut Column<u64>);
    /// A column of small labels.
    fn label(&mut self, column: &mut Column<i32>);
}

macro_rules! for_all_columns {
    ($visitor:ty, |$this:ident, $column:ident| $body:expr) => {
        impl Visitor for $visitor {
            fn scalar(&mut self, $column: &mut Column<f64>) {
                let $this = self;
                $body
            }
            fn vector(&mut self, $column: &mut Column<DVec3>) {
                let $this = self;
                $body
            }
            fn integer(&mut self, $column: &mut Column<u64>) {
                let $this = self;
                $body
            }
            fn label(&mut self, $column: &mut Column<i32>) {
                let $this = self;
                $body
            }
        }
    };
}

/// Columns that [`reorder`] writes into before they take the place of others; kept, so that they are not allocated in every step.
#[derive(Clone, Debug, Default)]
pub struct Spare {
    scalar: Vec<f64>,
    vector: Vec<DVec3>,
    integer: Vec<u64>,
    label: Vec<i32>,
}

impl Spare {
    /// Bytes held.
    pub fn bytes(&self) -> usize {
        8 * (self.scalar.capacity() + self.integer.capacity())
            + size_of::<DVec3>() * self.vector.capacity()
            + 4 * self.label.capacity()
    }
}

/// Permutes all columns: entry `k` becomes the former entry `order[k]`.
pub fn reorder(body: &mut impl Columns, order: &[u32], spare: &mut Spare) {
    struct Reorder<'a>(&'a [u32], &'a mut Spare);
    fn apply<T: Copy + Send + Sync>(order: &[u32], column: &mut Column<T>, spare: &mut Vec<T>) {
        let data = column.vec_mut();
        spare.clear();
        make_room(spare, order.len());
        let sorted = order.par_iter().with_min_len(4096).map(|&old| data[old as usize]);
        sorted.collect_into_vec(spare);
        std::mem::swap(data, spare);
    }
    impl Visitor for Reorder<'_> {
        fn scalar(&mut self, column: &mut Column<f64>) {
            apply(self.0, column, &mut self.1.scalar);
        }
        fn vector(&mut self, column: &mut Column<DVec3>) {
            apply(self.0, column, &mut self.1.vector);
        }
        fn integer(&mut self, column: &mut Column<u64>) {
            apply(self.0, column, &mut self.1.integer);
        }
        fn label(&mut self, column: &mut Column<i32>) {
            apply(self.0, column, &mut self.1.label);
        }
    }
    body.visit(&mut Reorder(order, spare));
}

/// Room for `more` entries. Columns that double when they are full would hold as much of nothing; a sixteenth more is room for those who
/// come in.
fn make_room<T>(column: &mut Vec<T>, more: usize) {
    if column.capacity() - column.len() < more {
        column.reserve_exact(more + (column.len() + more) / 16);
    }
}

/// Appends a copy of particle `i` to all columns.
pub fn append_copy(body: &mut impl Columns, i: usize) {
    struct Append(usize);
    for_all_columns!(Append, |this, column| {
        let value = column[this.0];
        make_room(column.vec_mut(), 1);
        column.vec_mut().push(value);
    });
    body.visit(&mut Append(i));
}

/// Removes particle `i`; the last one takes its place.
pub fn swap_remove(body: &mut impl Columns, i: usize) {
    struct Remove(usize);
    for_all_columns!(Remove, |this, column| {
        column.vec_mut().swap_remove(this.0);
    });
    body.visit(&mut Remove(i));
}

/// Bytes held by all columns.
pub fn bytes(body: &mut impl Columns) -> usize {
    struct Count(usize);
    for_all_columns!(Count, |this, column| this.0 += column.bytes());
    let mut count = Count(0);
    body.visit(&mut count);
    count.0
}

/// Place of a value that is not a finite number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NonFinite {
    /// Name of the column.
    pub column: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Index of the particle.
    pub particle: usize,
}

/// First non-finite value, in column order.
pub fn first_non_finite(body: &mut impl Columns) -> Option<NonFinite> {
    struct Scan(Option<NonFinite>);
    impl Scan {
        fn note<T>(&mut self, column: &Column<T>, bad: impl Fn(&T) -> bool) {
            if self.0.is_none()
                && let Some(particle) = column.iter().position(bad)
            {
                self.0 = Some(NonFinite { column: column.name(), unit: column.unit(), particle });
            }
        }
    }
    impl Visitor for Scan {
        fn scalar(&mut self, column: &mut Column<f64>) {
            self.note(column, |x| !x.is_finite());
        }
        fn vector(&mut self, column: &mut Column<DVec3>) {
            self.note(column, |x| !x.is_finite());
        }
        fn integer(&mut self, _: &mut Column<u64>) {}
        fn label(&mut self, _: &mut Column<i32>) {}
    }
    let mut scan = Scan(None);
    body.visit(&mut scan);
    scan.0
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Body {
        x: Column<DVec3>,
        m: Column<f64>,
    }

    impl Columns for Body {
        fn visit(&mut self, visitor: &mut dyn Visitor) {
            let Self { x, m } = self;
            visitor.vector(x);
            visitor.scalar(m);
        }
    }

    fn body() -> Body {
        Body {
            x: Column::with("position", "m", (0..4).map(|k| DVec3::splat(f64::from(k))).collect()),
            m: Column::with("mass", "kg", vec![0.0, 1.0, 2.0, 3.0]),
        }
    }

    #[test]
    fn all_columns_move_together() {
        let mut body = body();
        reorder(&mut body, &[2, 0, 3, 1], &mut Spare::default());
        append_copy(&mut body, 1);
        swap_remove(&mut body, 0);
        assert_eq!(&body.m[..], &[0.0, 0.0, 3.0, 1.0]);
        assert!(body.x.iter().zip(body.m.iter()).all(|(x, m)| x.x == *m));
    }

    #[test]
    fn a_bad_value_is_found_by_name() {
        let mut body = body();
        assert_eq!(first_non_finite(&mut body), None);
        body.m[3] = f64::NAN;
        assert_eq!(first_non_finite(&mut body), Some(NonFinite { column: "mass", unit: "kg", particle: 3 }));
    }
}

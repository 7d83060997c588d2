//! Wall shear stress summed over a cycle while it runs.

use crate::clock::{CycleClock, Piece};
use crate::error::MetricsError;
use crate::wall::indices::{PointIndices, ShearCycle};
use crate::wall::integral::{mean_absolute, mean_magnitude};
use glam::DVec3;
use rayon::prelude::*;
use vaso_particles::{Columns, Memory, ScalarColumn, VectorColumn, Visitor};

/// Least part of a cycle a point must have had a value for to get indices: with less the rest of the cycle is a guess.
const LEAST_COVERAGE: f64 = 0.9;

/// Sums over the cycle that is going on, for every point of the wall.
///
/// Between samples the stress is taken to go in a straight line; all sums are exact for that. Memory does not grow with the
/// number of samples. Where the wall moves, samples must be given in the frame of the wall as it was at first.
#[derive(Clone, Debug)]
pub struct ShearCycles {
    /// Where in its cycles the series is.
    pub clock: CycleClock,
    normal: Vec<DVec3>,
    /// Last sample \[Pa\]; not a number where it had no value.
    last: VectorColumn,
    /// Integral of the stress \[Pa s\].
    vector: VectorColumn,
    /// Integral of its magnitude \[Pa s\].
    magnitude: ScalarColumn,
    /// Integral of the magnitude of its part across the mean direction of the cycle before \[Pa s\].
    transverse: ScalarColumn,
    /// Time it had a value for \[s\].
    covered: ScalarColumn,
    /// Largest magnitude \[Pa\].
    peak: ScalarColumn,
    /// Mean direction of the cycle before; zero where there is none.
    direction: VectorColumn,
}

impl ShearCycles {
    /// Sums for points with unit `normal`, over cycles of `period` \[s\] from `start` \[s\] on.
    ///
    /// # Errors
    /// When the period is not positive.
    pub fn new(normal: Vec<DVec3>, start: f64, period: f64) -> Result<Self, MetricsError> {
        let n = normal.len();
        let vectors = |name, unit, value| VectorColumn::with(name, unit, vec![value; n]);
        let numbers = |name, unit| ScalarColumn::with(name, unit, vec![0.0; n]);
        Ok(Self {
            clock: CycleClock::new(start, period)?,
            last: vectors("last", "Pa", DVec3::NAN),
            vector: vectors("vector", "Pa s", DVec3::ZERO),
            magnitude: numbers("magnitude", "Pa s"),
            transverse: numbers("transverse", "Pa s"),
            covered: numbers("covered", "s"),
            peak: numbers("peak", "Pa"),
            direction: vectors("direction", "", DVec3::ZERO),
            normal,
        })
    }

    /// Shows all that changes, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        memory.columns(name, self);
        let (seen, needed) = (self.last.len(), self.normal.len());
        if seen != needed {
            memory.refuse(name, format!("it has {seen} points, {needed} are needed"));
        }
        self.clock.remember(&format!("{name}.clock"), memory);
    }

    /// Takes the stress \[Pa\] of all points at `time` \[s\]; gives the cycle that ended since the last sample, of several the
    /// last.
    ///
    /// # Errors
    /// When there is not one value a point.
    pub fn add(&mut self, time: f64, stress: &[Option<DVec3>]) -> Result<Option<ShearCycle>, MetricsError> {
        MetricsError::length("wall shear stress", stress.len(), self.normal.len())?;
        let mut ended = None;
        for piece in self.clock.advance(time) {
            self.integrate(&piece, stress);
            if piece.completes {
                ended = Some(self.close(piece.cycle));
            }
        }
        // A sample that came too early for the clock changes nothing.
        if self.clock.last() == Some(time) {
            for (last, stress) in self.last.iter_mut().zip(stress) {
                *last = stress.unwrap_or(DVec3::NAN);
            }
        }
        Ok(ended)
    }

    fn integrate(&mut self, piece: &Piece, stress: &[Option<DVec3>]) {
        let sums = (
            &mut self.vector[..],
            &mut self.magnitude[..],
            &mut self.transverse[..],
            &mut self.covered[..],
            &mut self.peak[..],
        );
        let given = (&self.last[..], stress, &self.normal[..], &self.direction[..]);
        (sums, given).into_par_iter().with_min_len(1024).for_each(
            |((vector, magnitude, transverse, covered, peak), (last, stress, normal, direction))| {
                let Some(stress) = stress else { return };
                if last.is_nan() {
                    return;
                }
                let (a, b) = (last.lerp(*stress, piece.span.0), last.lerp(*stress, piece.span.1));
                let across = normal.cross(*direction);
                *vector += piece.duration * 0.5 * (a + b);
                *magnitude += piece.duration * mean_magnitude(a, b);
                *transverse += piece.duration * mean_absolute(a.dot(across), b.dot(across));
                *covered += piece.duration;
                *peak = peak.max(a.length()).max(b.length());
            },
        );
    }

    /// Indices of the cycle that ends, and sums of zero for the next.
    fn close(&mut self, cycle: u64) -> ShearCycle {
        let period = self.clock.period();
        let point = (0..self.normal.len())
            .map(|k| {
                let covered = self.covered[k];
                (covered >= LEAST_COVERAGE * period).then(|| {
                    let transverse = (self.direction[k] != DVec3::ZERO).then(|| self.transverse[k] / covered);
                    PointIndices::new(
                        self.vector[k] / covered,
                        self.magnitude[k] / covered,
                        transverse,
                        self.peak[k],
                    )
                })
            })
            .collect();
        for (direction, vector) in self.direction.iter_mut().zip(self.vector.iter()) {
            *direction = vector.normalize_or_zero();
        }
        self.vector.fill(DVec3::ZERO);
        for sums in [&mut self.magnitude, &mut self.transverse, &mut self.covered, &mut self.peak] {
            sums.fill(0.0);
        }
        ShearCycle { number: cycle, point }
    }
}

impl Columns for ShearCycles {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        let Self { clock: _, normal: _, last, vector, magnitude, transverse, covered, peak, direction } =
            self;
        for column in [last, vector, direction] {
            visitor.vector(column);
        }
        for column in [magnitude, transverse, covered, peak] {
            visitor.scalar(column);
        }
    }
}

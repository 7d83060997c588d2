//! The wall of flows in a vessel at rest.

use crate::wall::{CouplingError, Facet, MovingWall};
use vaso_particles::{Memory, WallLoad, WallView};

/// A wall that moves, for flows that have none. None can be made, so nothing of one is run, held or even compiled for them: of a flow in
/// it the type says that no solid and no shell is entered.
#[derive(Clone, Copy, Debug)]
pub enum NoWall {}

impl MovingWall for NoWall {
    fn view(&self) -> WallView<'_> {
        match *self {}
    }

    fn thinning(&self) -> f64 {
        match *self {}
    }

    fn facet_of(&self) -> Vec<u32> {
        match *self {}
    }

    fn facet(&self, _: usize) -> Facet {
        match *self {}
    }

    fn load(&mut self, _: &WallLoad) -> Result<(), CouplingError> {
        match *self {}
    }

    fn advance(&mut self, _: f64) -> Result<usize, CouplingError> {
        match *self {}
    }

    fn remember(&mut self, _: &mut dyn Memory) {
        match *self {}
    }

    fn resume(&mut self) -> Result<(), CouplingError> {
        match *self {}
    }
}

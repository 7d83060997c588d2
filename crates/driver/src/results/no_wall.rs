//! What is written of a wall at rest: nothing.

use crate::case::Case;
use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::plan::Plan;
use crate::results::{ShearColumns, ShearFields};
use crate::world::WallParticles;
use std::path::PathBuf;
use vaso_coupling::{Coupling, NoWall};
use vaso_io::Summary;
use vaso_scene::Field;

impl Deforming for NoWall {
    type File = Self;

    const HAS_TRIANGLES: bool = false;

    const EFFECT: &'static str = "";

    fn build(_: &Case, plan: &Plan, _: &WallParticles) -> Result<Option<Self>, DriverError> {
        if plan.wall.is_some() || plan.shell.is_some() {
            return Err(DriverError::input(
                "a wall that is planned to deform cannot be built as one at rest",
            ));
        }
        Ok(None)
    }

    fn create(
        &self,
        _: PathBuf,
        _: &Case,
        _: Option<&ShearFields>,
        _: Option<f64>,
    ) -> Result<Self, DriverError> {
        match *self {}
    }

    fn append(
        wall: &Coupling<Self>,
        _: &mut Self,
        _: f64,
        _: &[Field],
        _: Option<&ShearColumns>,
    ) -> Result<(), DriverError> {
        match wall.wall {}
    }

    fn summarize(wall: &mut Coupling<Self>, _: &Plan, _: &mut Summary) {
        match wall.wall {}
    }

    fn bytes(&mut self) -> usize {
        match *self {}
    }
}

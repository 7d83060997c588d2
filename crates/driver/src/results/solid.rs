//! `wall.vtkhdf` of a wall that deforms: its particles, with what the case asks for.

use crate::case::Case;
use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::plan::Plan;
use crate::results::{ShearColumns, ShearFields, open};
use crate::world::WallParticles;
use glam::DVec3;
use rayon::prelude::*;
use std::path::PathBuf;
use vaso_coupling::Coupling;
use vaso_fluid::Real;
use vaso_io::{Frame, IoError, SeriesWriter, SolidSummary, Summary, schema};
use vaso_scene::Field;
use vaso_solid::Solid;

impl<R: Real> Deforming for Solid<R> {
    type File = SeriesWriter;

    const HAS_TRIANGLES: bool = false;

    const EFFECT: &'static str = "wall.solid";

    fn build(case: &Case, plan: &Plan, particles: &WallParticles) -> Result<Option<Self>, DriverError> {
        let (Some(planned), WallParticles::Layers(body)) = (&plan.wall, particles) else { return Ok(None) };
        planned.build(case, plan, body).map(Some)
    }

    fn create(
        &self,
        path: PathBuf,
        _: &Case,
        _: Option<&ShearFields>,
        kept: Option<f64>,
    ) -> Result<SeriesWriter, DriverError> {
        Ok(open(path, kept)?)
    }

    fn append(
        wall: &Coupling<Self>,
        file: &mut SeriesWriter,
        time: f64,
        fields: &[Field],
        _: Option<&ShearColumns>,
    ) -> Result<(), DriverError> {
        Ok(append(file, time, wall, fields)?)
    }

    fn summarize(wall: &mut Coupling<Self>, plan: &Plan, told: &mut Summary) {
        told.solid = Some(summary(wall, plan.wall.as_ref().map_or(0.0, |w| w.layers())));
    }

    fn bytes(&mut self) -> usize {
        Self::bytes(self)
    }
}

/// Appends the state of the wall to a series.
///
/// # Errors
/// As [`SeriesWriter::append`].
fn append<R: Real>(
    series: &mut SeriesWriter,
    time: f64,
    wall: &Coupling<Solid<R>>,
    fields: &[Field],
) -> Result<(), IoError> {
    let solid = &wall.wall;
    let state = &solid.state;
    let all = || (0..state.len()).into_par_iter();
    let view = wall.view();
    let mut frame = Frame { time, position: view.position, ids: Some(&state.id), ..Frame::default() };
    let asks = |field| fields.contains(&field);
    let (mut von_mises, mut diagonal, mut shear, mut stretches) = (vec![], vec![], vec![], vec![]);
    if asks(Field::VonMises) {
        von_mises = all().map(|i| solid.von_mises(i)).collect::<Vec<f64>>();
        let stress: Vec<[DVec3; 2]> = all()
            .map(|i| {
                let s = solid.cauchy_stress(i);
                [
                    DVec3::new(s.x_axis.x, s.y_axis.y, s.z_axis.z),
                    DVec3::new(s.x_axis.y, s.y_axis.z, s.z_axis.x),
                ]
            })
            .collect();
        (diagonal, shear) = stress.into_iter().map(|[d, s]| (d, s)).unzip();
        stretches = all().map(|i| DVec3::from_array(solid.principal_stretches(i))).collect();
    }
    if asks(Field::Displacement) {
        frame.vectors.push((schema::DISPLACEMENT, &state.displacement));
    }
    if asks(Field::Velocity) {
        frame.vectors.push((schema::VELOCITY, &state.velocity));
    }
    if asks(Field::VonMises) {
        frame.scalars.push((schema::VON_MISES, &von_mises));
        frame.vectors.push((schema::STRESS_DIAGONAL, &diagonal));
        frame.vectors.push((schema::STRESS_SHEAR, &shear));
        frame.vectors.push((schema::PRINCIPAL_STRETCHES, &stretches));
    }
    series.append(&frame)
}

/// What the summary says of the wall.
fn summary<R: Real>(wall: &mut Coupling<Solid<R>>, layers: f64) -> SolidSummary {
    let energies = wall.wall.energies();
    let solid = &wall.wall;
    let largest = solid.state.displacement.iter().map(|u| u.length_squared()).fold(0.0, f64::max);
    SolidSummary {
        spacing_m: solid.numbers().spacing,
        layers,
        substeps_per_step: wall.substeps as f64 / wall.steps.max(1) as f64,
        max_displacement_m: largest.sqrt(),
        reaction_n: solid.reaction().to_array(),
        blood_work_j: wall.work,
        load_work_j: energies.load_work,
        kinetic_j: energies.kinetic,
        strain_j: energies.strain,
        hourglass_j: energies.hourglass,
        dissipated_j: energies.dissipated,
        balance_j: energies.balance(),
    }
}

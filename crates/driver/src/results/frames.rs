//! Frames of the series, and values at points.

use crate::flow::Flow;
use glam::DVec3;
use rayon::prelude::*;
use vaso_coupling::MovingWall;
use vaso_fluid::{FluidState, Real};
use vaso_io::{Frame, SeriesWriter};
use vaso_kernels::Wendland;
use vaso_scene::Field;

/// Appends the state of the fluid to a series.
///
/// # Errors
/// As [`SeriesWriter::append`].
pub fn append_frame<R: Real, W: MovingWall>(
    series: &mut SeriesWriter,
    flow: &Flow<R, W>,
    fields: &[Field],
) -> Result<(), vaso_io::IoError> {
    let fluid = &flow.fluid;
    let state: &FluidState = &fluid.state;
    let reference = flow.openings.reference_pressure(flow.time);
    let rho0 = flow.fluid.numbers().rest_density;
    let pressure: Vec<f64> =
        (0..state.len()).into_par_iter().map(|i| reference + fluid.pressure(i)).collect();
    let density: Vec<f64> = state.density_change.par_iter().map(|d| rho0 + d).collect();
    let mut frame =
        Frame { time: flow.time, position: &state.position, ids: Some(&state.id), ..Frame::default() };
    for field in fields {
        match field {
            Field::Velocity => frame.vectors.push(("Velocity", &state.velocity)),
            Field::Pressure => frame.scalars.push(("Pressure", &pressure)),
            Field::Density => frame.scalars.push(("Density", &density)),
            // Fields of the wall are in a file of their own.
            _ => {}
        }
    }
    series.append(&frame)
}

/// Kernel mean (Shepard) of pressure \[Pa\] and velocity \[m/s\] at a point; NaN where no fluid is near.
pub(super) fn interpolate<R: Real, W: MovingWall>(flow: &Flow<R, W>, at: DVec3) -> (f64, DVec3) {
    let state = &flow.fluid.state;
    let kernel = Wendland::new(flow.fluid.numbers().smoothing_length);
    let (mut weight, mut pressure, mut velocity) = (0.0, 0.0, DVec3::ZERO);
    for i in 0..state.len() {
        let r = state.position[i].distance(at);
        if r < kernel.support() {
            let w = state.mass[i] * kernel.value(r);
            weight += w;
            pressure += w * flow.fluid.pressure(i);
            velocity += w * state.velocity[i];
        }
    }
    (flow.openings.reference_pressure(flow.time) + pressure / weight, velocity / weight)
}

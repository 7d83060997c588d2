//! Pressure near the caps of a pipe.

use crate::pipe::Pipe;
use vaso_fluid::Real;

/// Pressure and velocity along a pipe, averaged over sections a spacing long and the last quarter of a run.
#[derive(Clone, Debug)]
pub struct Along {
    /// Distance of each section from the inlet \[m\].
    pub place: Vec<f64>,
    /// Mean pressure \[Pa\].
    pub pressure: Vec<f64>,
    /// Mean pressure of the inner half of the radius \[Pa\].
    pub core: Vec<f64>,
    /// Density relative
    pub filled: Vec<f64>,
    /// noise
    pub noise: Vec<[f64; 4]>,
    /// Mean velocity along the pipe \[m/s\].
    pub velocity: Vec<f64>,
}

/// Runs `pipe` and looks along it.
///
/// # Panics
/// When the run breaks down.
pub fn along<R: Real>(pipe: &Pipe) -> Along {
    let (mut flow, _, plan) = pipe.flow::<R>();
    let n = (pipe.length / pipe.spacing()).round() as usize;
    let mut sums = vec![[0.0_f64; 5]; n];
    let axis = pipe.axis.normalize();
    let mut steps = 0.0;
    let mut noise = vec![[0.0_f64; 5]; n];
    let mean = std::env::args().nth(3).and_then(|a| a.parse::<f64>().ok()).unwrap_or(100.0) * pipe.viscosity / pipe.density / pipe.diameter;
    while flow.time < plan.end_time {
        flow.step(plan.end_time).unwrap_or_else(|e| panic!("{e}"));
        if flow.time < 0.75 * plan.end_time {
            continue;
        }
        steps += 1.0;
        let reference = flow.openings.reference_pressure(flow.time);
        let state = &flow.fluid.state;
        for (i, &x) in state.position.iter().enumerate() {
            let (z, r) = pipe.place(x);
            if let Some(sum) = sums.get_mut((z / pipe.length * n as f64) as usize) {
                let p = flow.fluid.pressure(i) + reference;
                let m = &mut noise[(z / pipe.length * n as f64) as usize];
                let w = state.velocity[i].dot(axis);
                let across = (state.velocity[i] - w * axis).length_squared() / 2.0;
                m[0] += across;
                let e = w - 2.0 * mean * (1.0 - (r / pipe.radius()).powi(2));
                m[1] += e * e;
                m[2] += w * w;
                m[3] += e;
                let radial = state.velocity[i].dot((x - pipe.origin - z * axis).normalize_or_zero());
                m[4] += radial;
                sum[0] += 1.0;
                sum[1] += p;
                sum[2] += state.velocity[i].dot(axis);
                if r < 0.5 * pipe.radius() {
                    sum[3] += 1.0;
                    sum[4] += p;
                }
            }
        }
    }
    let volume = pipe.spacing().powi(3);
    Along {
        place: (0..n).map(|k| (k as f64 + 0.5) * pipe.length / n as f64).collect(),
        pressure: sums.iter().map(|s| s[1] / s[0]).collect(),
        core: sums.iter().map(|s| s[4] / s[3]).collect(),
        filled: sums.iter().map(|s| s[0] * volume / steps / (pipe.area() * pipe.length / n as f64)).collect(),
        noise: noise.iter().zip(&sums).map(|(m, s)| [(m[0] / s[0]).sqrt() / mean / 2.0, (m[1] / s[0]).sqrt() / mean / 2.0, m[2] / s[0] / mean / mean, m[4] / s[0] / mean / 2.0]).collect(),
        velocity: sums.iter().map(|s| s[2] / s[0]).collect(),
    }
}

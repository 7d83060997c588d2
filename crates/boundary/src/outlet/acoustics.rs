//! Coupled outlets on lines that only carry sound: what an explicit coupling has to survive.

use super::coupling::{Outlet, Seen, common_pressure};
use super::{Coupling, Integration, Windkessel};

const RHO: f64 = 1060.0;
const C: f64 = 10.0;
/// Spacing \[m\].
const DP: f64 = 4e-4;
/// Section of the trunk \[m^2\].
const AREA: f64 = 2.8e-5;
/// Acoustic step over the time sound takes for a spacing, as in the fluid.
const STEP: f64 = 0.6 * 1.3;
const Z: f64 = RHO * C / AREA;
/// Flow that enters from the first step on \[m^3/s\].
const INFLOW: f64 = 6e-6;

/// A line of cells a spacing long; the flow leaves it at its far end.
struct Line {
    area: f64,
    pressure: Vec<f64>,
    flow: Vec<f64>,
}

impl Line {
    fn new(cells: usize, area: f64) -> Self {
        Self { area, pressure: vec![0.0; cells], flow: vec![0.0; cells] }
    }

    /// What the buffer shows, against the imposed and the reference pressure.
    fn seen(&self, imposed: f64, reference: f64) -> Seen {
        let mean = |values: &[f64]| values[values.len() - 4..].iter().sum::<f64>() / 4.0;
        Seen {
            velocity: mean(&self.flow) / self.area,
            section: self.area,
            pressure: reference + mean(&self.pressure),
            imposed,
        }
    }

    fn kick(&mut self, beyond: f64, dt: f64, loss: f64) {
        let n = self.flow.len();
        for i in 0..n {
            let next = if i + 1 < n { self.pressure[i + 1] } else { beyond };
            let push = (self.pressure[i] - next) * self.area / (RHO * DP) * dt;
            self.flow[i] = (self.flow[i] + push) * (1.0 - loss);
        }
    }

    fn fill(&mut self, inflow: f64, dt: f64) {
        for i in 0..self.pressure.len() {
            let entering = if i == 0 { inflow } else { self.flow[i - 1] };
            self.pressure[i] += RHO * C * C / (self.area * DP) * (entering - self.flow[i]) * dt;
        }
    }
}

/// What an outlet showed over the last fifth of a run.
#[derive(Debug)]
struct Late {
    /// Mean pressure \[Pa\].
    pressure: f64,
    /// Largest minus smallest flow at the cap \[m^3/s\].
    flow_range: f64,
    /// Mean flow \[m^3/s\].
    flow: f64,
}

/// A trunk of `cells` spacings that parts into one line for each outlet, run for `transits` of it.
///
/// `level` is whether the fluid carries the pressure itself, not only what it differs from the common one by.
fn run(outlets: &mut [Outlet], cells: usize, transits: usize, level: bool, loss: f64) -> Vec<Late> {
    let share = AREA / outlets.len() as f64;
    let mut trunk = Line::new(cells, AREA);
    let mut lines: Vec<Line> = (0..outlets.len()).map(|k| Line::new(cells / 2 + 7 * k, share)).collect();
    let dt = STEP * DP / C;
    let steps = (transits * cells) as f64 / STEP;
    let mut seen = vec![(0.0, f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0); outlets.len()];
    for step in 0..steps as usize {
        let reference = if level { 0.0 } else { common_pressure(outlets.iter()) };
        for (outlet, line) in outlets.iter_mut().zip(&mut lines) {
            let imposed = outlet.state.outlet.pressure;
            line.kick(imposed - reference, dt, loss);
            outlet.follow(line.seen(imposed, reference), 4.0 * DP, dt);
        }
        // The flow out of the trunk is that over the faces into the lines, each with half its pressure drop.
        let joint = trunk.pressure[cells - 1];
        trunk.kick(joint, dt, loss);
        let into: Vec<f64> = lines.iter().map(|l| (joint - l.pressure[0]) * l.area / (RHO * C)).collect();
        trunk.flow[cells - 1] = into.iter().sum();
        trunk.fill(INFLOW, dt);
        for (line, &q) in lines.iter_mut().zip(&into) {
            line.fill(q, dt);
        }
        if step as f64 > 0.8 * steps {
            for ((s, outlet), line) in seen.iter_mut().zip(outlets.iter()).zip(&lines) {
                let q = line.flow[line.flow.len() - 1];
                *s = (s.0 + outlet.state.outlet.pressure, s.1.min(q), s.2.max(q), s.3 + q, s.4 + 1.0);
            }
        }
    }
    seen.iter().map(|s| Late { pressure: s.0 / s.4, flow_range: s.2 - s.1, flow: s.3 / s.4 }).collect()
}

fn outlet(model: Windkessel, area: f64) -> Outlet {
    Outlet::new(model, model.distal_pressure, RHO * C / area, 4.0 * DP / C, area)
}

#[test]
fn a_resistance_settles_at_its_pressure_however_large_it_is() {
    for cells in [20, 80, 320] {
        for ratio in [0.1, 0.3, 1.0, 2.0, 5.0, 10.0, 20.0] {
            let mut one = [outlet(Windkessel::resistance(ratio * Z, 0.0), AREA)];
            let late = &run(&mut one, cells, 400, true, 1e-4)[0];
            let pressure = late.pressure / (ratio * Z * INFLOW);
            assert!((pressure - 1.0).abs() < 1e-3, "R/Z {ratio}, {cells} spacings: {late:?}");
            assert!(late.flow_range < 0.01 * INFLOW, "R/Z {ratio}, {cells} spacings: {late:?}");
        }
    }
}

#[test]
fn outlets_relative_to_their_common_pressure_come_to_rest() {
    for cells in [40, 80, 160] {
        for ratio in [0.3, 1.0, 2.0, 5.0, 10.0] {
            // Each over the impedance of its half of the section.
            let models = [0.5, 1.0].map(|r| Windkessel::resistance(r * 2.0 * ratio * Z, 0.0));
            let mut two = models.map(|m| outlet(m, AREA / 2.0));
            let late = run(&mut two, cells, 400, false, 1e-4);
            for (one, model) in late.iter().zip(&models) {
                let pressure = one.pressure / (model.proximal_resistance * one.flow);
                assert!((pressure - 1.0).abs() < 5e-3, "R/Z {ratio}, {cells} spacings: {late:?}");
                assert!(one.flow_range < 0.03 * INFLOW, "R/Z {ratio}, {cells} spacings: {late:?}");
            }
        }
    }
}

#[test]
fn a_short_window_is_unstable_where_the_implicit_coupling_is_not() {
    let cells = 80;
    let window = |transits: f64| {
        let mut one = [outlet(Windkessel::resistance(5.0 * Z, 0.0), AREA)];
        let duration = transits * cells as f64 * DP / C;
        one[0].coupling = Coupling::Window { duration, integration: Integration::Exponential };
        run(&mut one, cells, 200, true, 1e-3)[0].flow_range / INFLOW
    };
    let range = window(1.4);
    assert!(range > 1e3 || range.is_nan(), "{range}");
}

//! What `summary.json` says of a run.

use super::{Results, account, outflows};
use crate::calls;
use crate::case::Case;
use crate::deforming::Deforming;
use crate::flow::Flow;
use crate::ledger::Stage;
use crate::plan::Plan;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_io::{
    Numbers, OpeningEntry, OpeningSummary, ParticleCounts, Stability, Status, StepCounts, Summary,
    SurfaceReport,
};

impl<F> Results<F> {
    /// The summary of a run that ends now.
    pub fn summary<R: Real, W: Deforming<File = F>>(
        &self,
        flow: &mut Flow<R, W>,
        case: &Case,
        plan: &Plan,
        counts: ParticleCounts,
        wall_clock: f64,
    ) -> Summary {
        let cycle = self.observers.openings.as_ref().and_then(|o| o.completed.last());
        let openings = plan.openings.iter().enumerate().map(|(k, o)| {
            let late = || (self.late.mean(self.late.flow[k]), self.late.mean(self.late.pressure[k]));
            let (flow, pressure) = cycle.map_or_else(late, |c| (c.flow(k).mean, c.pressure(k).mean));
            OpeningSummary {
                opening: opening_entry(&o.name, &o.opening),
                mean_flow_m3_s: flow,
                mean_pressure_pa: pressure,
            }
        });
        let loop_seconds = flow.ledger.total() - flow.ledger.seconds(Stage::Output);
        let mut summary = Summary {
            vaso_version: env!("CARGO_PKG_VERSION").into(),
            status: Status::Completed,
            case: case.scene.title.clone(),
            identity: self.identity.clone(),
            message: None,
            time_s: flow.time,
            wall_clock_s: wall_clock,
            threads: rayon::current_num_threads() as u64,
            particles: ParticleCounts { fluid: flow.fluid.state.len() as u64, ..counts },
            steps: StepCounts {
                advection: flow.advective_steps,
                acoustic: flow.acoustic_steps,
                solid: flow.wall.as_ref().map_or(0, |w| w.substeps),
            },
            particle_substeps_per_s: flow.particle_substeps as f64 / loop_seconds.max(f64::MIN_POSITIVE),
            spacing_m: plan.numbers.spacing,
            sound_speed_m_s: plan.numbers.sound_speed,
            precision: R::PRECISION.into(),
            stability: Stability {
                max_density_error: flow.watch.max_density_error,
                max_mach: flow.watch.max_mach,
                escaped_particles: flow.watch.escaped,
                non_finite: flow.watch.non_finite,
                mass_balance_error: self.mass_balance(flow),
                energy_growth: self.observers.energy.growth().unwrap_or(f64::NAN),
            },
            openings: openings.collect(),
            effects: costed_effects(flow, plan),
            end_reason: None,
            cycles: account::cycles(&self.observers, &case.scene.output.fractional_flow_reserve),
            energy: Some(account::energy(&self.observers.energy, flow.openings.ports())),
            wall: self.observers.wall.as_ref().map(account::wall),
            solid: None,
            shell: None,
            surface: Some(surface_report(&case.vessel)),
            numbers: Some(numbers(plan)),
            warnings: plan.warnings.clone(),
        };
        if let Some(wall) = &mut flow.wall {
            W::summarize(wall, plan, &mut summary);
        }
        let is_thinning = plan.numbers.rheology.is_some();
        let missed = calls::missed(&summary, plan.numbers.reference_speed, plan.viscosity, is_thinning);
        summary.warnings.extend(missed);
        summary
    }

    /// Inflow minus outflow over the inflow, by the volumes that crossed the caps in the second half, of a pulsatile flow in the
    /// last whole cycle.
    fn mass_balance<R: Real, W: MovingWall>(&self, flow: &Flow<R, W>) -> f64 {
        let cycle = self.observers.openings.as_ref().and_then(|o| o.completed.last());
        if let Some(error) = cycle.and_then(vaso_metrics::OpeningCycle::mass_balance_error) {
            return error;
        }
        let Some((_, before)) = &self.late_start else { return f64::NAN };
        let change: Vec<f64> = outflows(flow).iter().zip(before).map(|(now, then)| now - then).collect();
        let inflow: f64 = change.iter().map(|c| (-c).max(0.0)).sum();
        if inflow > 0.0 { change.iter().sum::<f64>().abs() / inflow } else { f64::NAN }
    }
}

/// Geometry of an opening as JSON has it.
pub fn opening_entry(name: &str, o: &vaso_geometry::Opening) -> OpeningEntry {
    OpeningEntry {
        name: name.into(),
        center_m: o.center.to_array(),
        normal: o.normal.to_array(),
        area_m2: o.area,
        radius_m: o.radius,
    }
}

/// Geometry audit as JSON has it.
pub fn surface_report(vessel: &vaso_geometry::Vessel) -> SurfaceReport {
    SurfaceReport {
        triangles: vessel.surface.triangles.len() as u64,
        volume_m3: vessel.surface.volume(),
        area_m2: vessel.surface.area(),
        watertight: vessel.audit.watertight,
        components: vessel.audit.components as u64,
        self_intersections: vessel.audit.self_intersections as u64,
        repairs: vessel.audit.repairs.clone(),
        unit: vessel.unit.symbol().into(),
    }
}

/// Numbers of a plan as JSON has them.
pub fn numbers(plan: &Plan) -> Numbers {
    Numbers {
        reynolds_peak: Some(plan.reynolds_peak),
        womersley: plan.womersley,
        radial_strain: plan.radial_strain,
        sound_speed_m_s: Some(plan.numbers.sound_speed),
    }
}

/// Effects of the plan with the time of the stages they are made of.
fn costed_effects<R: Real, W: Deforming>(flow: &mut Flow<R, W>, plan: &Plan) -> Vec<vaso_io::EffectEntry> {
    let bytes = flow.fluid.bytes();
    let wall_bytes = flow.wall.as_mut().map(|wall| [wall.wall.bytes(), wall.bytes()]);
    let spent = |stages: &[Stage]| stages.iter().map(|&s| flow.ledger.seconds(s)).sum::<f64>();
    plan.effects
        .iter()
        .map(|effect| {
            let stages: &[Stage] = match effect.name.as_str() {
                "blood.pressure" => &[Stage::Rows, Stage::Momentum, Stage::Continuity],
                "blood.viscosity" => &[Stage::Viscosity],
                "blood.shear_thinning" => &[Stage::ShearThinning],
                // One sweep finds both the density sum and the correction matrices.
                "blood.density_blend" => &[Stage::Summation],
                "blood.transport_velocity" => &[Stage::Transport],
                "wall.rigid" | "wall.rigid_shell" => &[Stage::WallPressure],
                "wall.solid" | "wall.shell" => &[Stage::Wall],
                "wall.coupling" => &[Stage::WallPressure, Stage::Coupling],
                "metrics.wall_shear" => &[Stage::WallShear],
                "opening.velocity" | "opening.pressure" | "opening.resistance" | "opening.windkessel" => {
                    &[Stage::Exchange, Stage::Openings]
                }
                _ => &[],
            };
            let shared = if effect.name.starts_with("opening.") {
                let both = plan
                    .effects
                    .iter()
                    .filter(|e| e.on && OPENING_EFFECTS.contains(&e.name.as_str()))
                    .count();
                both.max(1) as f64
            } else {
                1.0
            };
            let mut entry = effect.clone();
            if effect.on && !stages.is_empty() {
                entry.seconds = Some(spent(stages) / shared);
            }
            if effect.name == "blood.pressure" {
                entry.bytes = Some(bytes as u64);
            }
            if let Some([own, between]) = wall_bytes {
                match effect.name.as_str() {
                    name if name == W::EFFECT => entry.bytes = Some(own as u64),
                    "wall.coupling" => entry.bytes = Some(between as u64),
                    _ => {}
                }
            }
            entry
        })
        .collect()
}

/// Effects that share the stages of the buffers.
const OPENING_EFFECTS: [&str; 2] = ["opening.velocity", "opening.pressure"];

//! What the summary says of cycles, energy and the wall.

use crate::observe::{EnergyObserver, Observers, OpeningObserver, WallObserver};
use vaso_boundary::Port;
use vaso_io::{
    CycleSummary, Distribution, EnergySummary, LOW_TAWSS, OpeningCycleSummary, PeriodicitySummary,
    PressureDropSummary, WallSummary,
};
use vaso_metrics::OpeningCycle;

/// All whole cycles; `pairs` are the openings, proximal and distal, whose pressure drop is told.
pub(super) fn cycles(observers: &Observers, pairs: &[[String; 2]]) -> Vec<CycleSummary> {
    let Some(openings) = &observers.openings else { return Vec::new() };
    let one = |(index, cycle): (usize, &OpeningCycle)| CycleSummary {
        index: cycle.number,
        start_s: cycle.number as f64 * cycle.period,
        end_s: (cycle.number + 1) as f64 * cycle.period,
        openings: opening_cycles(cycle),
        periodicity: index.checked_sub(1).and_then(|k| periodicity(openings, k)),
        mass_balance_error: cycle.mass_balance_error(),
        pressure_drops: pairs.iter().filter_map(|pair| pressure_drop(cycle, pair)).collect(),
        mean_tawss_pa: observers.wall.as_ref().and_then(|wall| wall.mean_tawss(cycle.number)),
    };
    openings.completed.iter().enumerate().map(one).collect()
}

fn opening_cycles(cycle: &OpeningCycle) -> Vec<OpeningCycleSummary> {
    let split = cycle.flow_split();
    let one = |k: usize| {
        let (flow, pressure) = (cycle.flow(k), cycle.pressure(k));
        OpeningCycleSummary {
            name: cycle.names[k].clone(),
            mean_flow_m3_s: flow.mean,
            min_flow_m3_s: flow.min,
            max_flow_m3_s: flow.max,
            mean_pressure_pa: pressure.mean,
            systolic_pressure_pa: pressure.max,
            diastolic_pressure_pa: pressure.min,
            pulse_pressure_pa: pressure.peak_to_peak(),
            flow_split: split[k],
            pulsatility_index: flow.pulsatility_index(),
            resistive_index: flow.resistive_index(),
        }
    };
    (0..cycle.names.len()).map(one).collect()
}

/// Change `k`, from cycle `k` to the next.
fn periodicity(openings: &OpeningObserver, k: usize) -> Option<PeriodicitySummary> {
    let change = openings.changes.get(k)?;
    let largest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    Some(PeriodicitySummary {
        flow: largest(&change.flow),
        pressure: largest(&change.pressure),
        wall_shear: openings.shear_changes.get(k).copied().flatten(),
    })
}

fn pressure_drop(cycle: &OpeningCycle, [proximal, distal]: &[String; 2]) -> Option<PressureDropSummary> {
    // The case has been checked: openings of these names exist.
    let (p, d) = (cycle.opening(proximal).ok()?, cycle.opening(distal).ok()?);
    let drop = cycle.pressure_drop(p, d);
    Some(PressureDropSummary {
        proximal: proximal.clone(),
        distal: distal.clone(),
        mean_pa: drop.mean,
        min_pa: drop.min,
        max_pa: drop.max,
        fractional_flow_reserve: cycle.fractional_flow_reserve(p, d),
    })
}

/// The balance of energy, with what the damping of backflow took at `ports`.
pub(super) fn energy(energy: &EnergyObserver, ports: &[Port]) -> EnergySummary {
    let balance = &energy.balance;
    let kinetic = balance.last.map_or(0.0, |(_, now)| now.kinetic_energy - balance.initial_kinetic_energy);
    let mut damped = ports.iter().filter(|p| p.condition.model().is_some()).map(|p| p.counters.damped_energy);
    EnergySummary {
        inflow_j: balance.inflow,
        throughput_j: balance.throughput,
        dissipated_j: balance.dissipated,
        kinetic_change_j: kinetic,
        residual_j: balance.residual(),
        relative_residual: balance.relative_residual(),
        damped_backflow_j: damped.next().map(|first| first + damped.sum::<f64>()),
    }
}

/// Stresses of the wall outside the buffers.
pub(super) fn wall(wall: &WallObserver) -> WallSummary {
    let (mesh, area) = (&wall.mesh, &wall.counted);
    let magnitude: Option<Vec<f64>> = wall
        .stress
        .as_ref()
        .map(|stress| stress.iter().map(|s| s.map_or(f64::NAN, |s| s.length())).collect());
    let fields = wall.cycle.as_ref().map(vaso_metrics::ShearCycle::fields);
    let index = |k: usize| fields.as_ref().and_then(|f| Distribution::by_area(&f[k], area));
    WallSummary {
        points: mesh.position.len() as u64,
        triangles: mesh.triangles.len() as u64,
        area_m2: mesh.area.iter().sum(),
        counted_area_m2: area.iter().sum(),
        wss_pa: magnitude.and_then(|values| Distribution::by_area(&values, area)),
        cycle: wall.cycle.as_ref().map(|cycle| cycle.number),
        tawss_pa: index(0),
        low_tawss_area_fraction: fields
            .as_ref()
            .and_then(|f| Distribution::fraction_below(LOW_TAWSS, &f[0], area)),
        osi: index(1),
        rrt_1_pa: index(2),
        ecap_1_pa: index(3),
        transverse_wss_pa: index(4),
        peak_wss_pa: index(5),
    }
}

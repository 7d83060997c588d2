//! The pressure outlets start from, where a case asks for that of the periodic cycle.

use crate::case::Case;
use crate::error::{DriverError, problem};
use crate::plan::PlannedOpening;
use vaso_boundary::{Condition, Source, Waveform, Windkessel, mean_split};

/// Puts the outlets that ask for it where their periodic cycle will be once the inflow has risen: that of the Windkessel alone, under
/// its share of the inflow at the mean pressure all outlets have in common.
///
/// # Errors
/// When the inflow does not repeat, an outlet does not set its pressure by the flow, or the pressure would rise for ever.
pub(crate) fn periodic(case: &Case, openings: &mut [PlannedOpening]) -> Result<(), DriverError> {
    let asks = |name: &str| {
        case.scene.openings.iter().any(|o| {
            o.name == name
                && matches!(o.condition, vaso_scene::Condition::Windkessel { periodic_start: true, .. })
        })
    };
    let Some(first) = openings.iter().find(|o| asks(&o.name)) else { return Ok(()) };
    let wrong = |text: String| {
        let key = format!("opening.{}.periodic_start", first.name);
        DriverError::input(problem(&case.scene, &key, text, "", "give `initial_pressure` instead"))
    };
    let is_driven = openings.iter().any(|o| matches!(o.condition, Condition::Pressure { .. }));
    let inflow = inflow(openings).filter(|_| !is_driven).ok_or_else(|| {
        wrong("needs one inlet with a velocity or flow that is constant or repeats, and outlet models elsewhere".into())
    })?;
    let models: Vec<Windkessel> = openings.iter().filter_map(|o| o.condition.model().map(|m| m.0)).collect();
    let (_, shares) = mean_split(&models, inflow.mean()).map_err(|e| wrong(e.to_string()))?;
    let rising = openings.iter().find_map(|o| match &o.condition {
        Condition::Velocity { mean, .. } => Some(mean),
        _ => None,
    });
    let mut share = shares.iter();
    let mut starts = Vec::with_capacity(openings.len());
    for opening in openings.iter() {
        let start = match (opening.condition.model(), asks(&opening.name)) {
            (Some((model, _)), asked) => {
                let share = share.next().copied().unwrap_or(0.0);
                let flow = inflow.scaled(share);
                let cycle =
                    asked.then(|| model.periodic(&flow)).transpose().map_err(|e| wrong(e.to_string()))?;
                let ahead = rising.map_or(0.0, |signal| model.head_start(&flow, signal));
                cycle.map(|cycle| cycle.start.stored_pressure + ahead)
            }
            (None, _) => None,
        };
        starts.push(start);
    }
    for (opening, start) in openings.iter_mut().zip(starts) {
        if let (Condition::Windkessel { initial_pressure, .. }, Some(start)) = (&mut opening.condition, start)
        {
            *initial_pressure = start;
        }
    }
    Ok(())
}

/// Flow into the vessel \[m^3/s\] over a cycle; `None` where there is not one inlet, or it does not repeat.
pub(crate) fn inflow(openings: &[PlannedOpening]) -> Option<Waveform> {
    let mut inlets = openings.iter().filter_map(|o| match &o.condition {
        Condition::Velocity { mean, .. } => Some((&mean.source, o.opening.area)),
        _ => None,
    });
    let (source, area) = inlets.next()?;
    if inlets.next().is_some() {
        return None;
    }
    match source {
        Source::Constant(value) => Waveform::new(vec![0.0, 0.5], vec![value * area; 2], Some(1.0)).ok(),
        Source::Waveform(wave) => wave.period().map(|_| wave.scaled(area)),
    }
}

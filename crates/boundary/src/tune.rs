//! Windkessel parameters from what a clinic measures: cuff pressures and a mean flow.

use crate::error::BoundaryError;
use crate::outlet::{Cycle, Windkessel};
use crate::waveform::Waveform;

/// How the flow parts among the outlets.
#[derive(Clone, Debug, PartialEq)]
pub enum Split {
    /// By the power of the radius that the wall shear stress calls for: 2 parts by area, 3 after Murray (1926), 2.55 as
    /// measured in coronary trees.
    Radius {
        /// The power.
        exponent: f64,
    },
    /// By given fractions, which are scaled to sum up to one.
    Given(Vec<f64>),
}

impl Split {
    /// By the areas of the caps.
    pub const AREA: Self = Self::Radius { exponent: 2.0 };
    /// By the cubes of their radii (Murray 1926).
    pub const MURRAY: Self = Self::Radius { exponent: 3.0 };

    /// The fraction of each outlet of areas `areas` \[m^2\].
    ///
    /// # Errors
    /// When the given fractions are not one for each outlet, or one is not above zero.
    pub fn fractions(&self, areas: &[f64]) -> Result<Vec<f64>, BoundaryError> {
        let weights = match self {
            Self::Radius { exponent } => areas.iter().map(|a| a.powf(0.5 * exponent)).collect(),
            Self::Given(fractions) => fractions.clone(),
        };
        if weights.len() != areas.len() {
            return Err(BoundaryError::Count {
                what: "fractions",
                given: weights.len(),
                outlets: areas.len(),
            });
        }
        if let Some(&value) = weights.iter().find(|w| !(**w > 0.0 && w.is_finite())) {
            return Err(BoundaryError::OutOfRange {
                key: "split",
                value,
                allowed: "more than zero for each outlet",
            });
        }
        let total: f64 = weights.iter().sum();
        Ok(weights.iter().map(|w| w / total).collect())
    }
}

/// What the outlets are to give.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Highest pressure of the cycle \[Pa\].
    pub systolic: f64,
    /// Lowest pressure of the cycle \[Pa\].
    pub diastolic: f64,
    /// Pressure behind the outlets \[Pa\].
    pub distal_pressure: f64,
    /// How the flow parts.
    pub split: Split,
    /// Speed of pulse waves in the vessels behind, which with the area gives their proximal resistance rho c / A
    /// \[m/s\].
    pub wave_speed: f64,
    /// Density of the blood \[kg/m^3\].
    pub density: f64,
}

/// One outlet that was tuned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuned {
    /// Part of the flow it takes.
    pub fraction: f64,
    /// Its parameters.
    pub model: Windkessel,
    /// The periodic cycle it has, from the model alone.
    pub cycle: Cycle,
}

/// Largest part of the total resistance that is proximal.
const PROXIMAL: f64 = 0.3;
/// Largest part of the pulse that the proximal resistance makes by itself. It leaves the compliance something to do.
const PROXIMAL_PULSE: f64 = 0.5;
/// Relative error of the pressures at which the search ends.
const PRECISION: f64 = 1e-6;
/// Rounds of the search for the resistance; 10 to 20 are needed.
const ROUNDS: usize = 100;

/// Windkessel parameters of outlets of areas `areas` \[m^2\] that take up `inflow` \[m^3/s\], a waveform with a period, at
/// the pressures of the target.
///
/// Each outlet gets the inflow times its fraction. The total resistance follows from the mean pressure, the proximal one
/// from the wave speed, at most three tenths of it, and the compliance from the pulse; the mean is then moved until the
/// systolic and diastolic pressure are the asked ones, each time by the periodic cycle of the model.
///
/// Walls that deform store blood too: what they store has to be taken off the compliance.
///
/// # Errors
/// When a number has no meaning, the inflow no period, or varies too little for the pulse.
pub fn tune(inflow: &Waveform, areas: &[f64], target: &Target) -> Result<Vec<Tuned>, BoundaryError> {
    let Target { systolic, diastolic, distal_pressure, .. } = *target;
    let refuse = |key, value, allowed| Err(BoundaryError::OutOfRange { key, value, allowed });
    if diastolic.is_nan() || diastolic <= distal_pressure {
        return refuse("diastolic", diastolic, "more than the distal pressure, in Pa");
    }
    if !(systolic > diastolic && systolic.is_finite()) {
        return refuse("systolic", systolic, "more than the diastolic pressure, in Pa");
    }
    if !(target.wave_speed >= 0.0 && target.density > 0.0) {
        return refuse("wave_speed", target.wave_speed, "zero or more, in m/s, with a density above zero");
    }
    let mean_flow = inflow.mean();
    if mean_flow.is_nan() || mean_flow <= 0.0 {
        return refuse("mean inflow", mean_flow, "more than zero, in m^3/s");
    }
    let fractions = target.split.fractions(areas)?;
    let outlet = |(&area, &fraction): (&f64, &f64)| {
        tune_one(&inflow.scaled(fraction), area, target).map(|(model, cycle)| Tuned {
            fraction,
            model,
            cycle,
        })
    };
    areas.iter().zip(&fractions).map(outlet).collect()
}

/// Parameters of one outlet under its own flow.
fn tune_one(flow: &Waveform, area: f64, target: &Target) -> Result<(Windkessel, Cycle), BoundaryError> {
    let Target { systolic, diastolic, distal_pressure, .. } = *target;
    let (pulse, middle) = (systolic - diastolic, 0.5 * (systolic + diastolic));
    let (low, high) = flow.range();
    let wave_resistance = target.density * target.wave_speed / area;
    let mut mean = diastolic + pulse / 3.0;
    let mut found = None;
    for _ in 0..ROUNDS {
        let total = (mean - distal_pressure) / flow.mean();
        let pulse_limit = PROXIMAL_PULSE * pulse / (high - low).max(f64::MIN_POSITIVE);
        let proximal = wave_resistance.min(PROXIMAL * total).min(pulse_limit);
        let model = |compliance: f64| Windkessel {
            proximal_resistance: proximal,
            compliance,
            distal_resistance: total - proximal,
            distal_pressure,
        };
        let (tuned, cycle) = compliance_for(&model, flow, pulse)?;
        found = Some((tuned, cycle));
        let off = middle - 0.5 * (cycle.systolic + cycle.diastolic);
        if off.abs() < PRECISION * middle.abs() {
            break;
        }
        // Half of the way at least to the distal pressure: a resistance stays above zero.
        mean = (mean + off).max(0.5 * (mean + distal_pressure));
    }
    found.ok_or(BoundaryError::NoPeriod)
}

/// The compliance that gives the pulse, which falls as the compliance grows.
fn compliance_for(
    model: &dyn Fn(f64) -> Windkessel,
    flow: &Waveform,
    pulse: f64,
) -> Result<(Windkessel, Cycle), BoundaryError> {
    let pulse_of = |cycle: &Cycle| cycle.systolic - cycle.diastolic;
    let stiff = model(0.0).periodic(flow)?;
    if pulse_of(&stiff) < pulse {
        return Err(BoundaryError::TooSteady { pulse, largest: pulse_of(&stiff) });
    }
    let period = flow.period().ok_or(BoundaryError::NoPeriod)?;
    // Time constants from a ten-thousandth to ten thousand periods hold any pulse a heart makes.
    let unit = period / model(0.0).distal_resistance;
    let (mut low, mut high) = ((1e-4 * unit).ln(), (1e4 * unit).ln());
    loop {
        let compliance = (0.5 * (low + high)).exp();
        let tried = model(compliance);
        let cycle = tried.periodic(flow)?;
        let off = pulse_of(&cycle) - pulse;
        if off.abs() < PRECISION * pulse || high - low < PRECISION {
            return Ok((tried, cycle));
        }
        if off > 0.0 {
            low = compliance.ln();
        } else {
            high = compliance.ln();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waveform::Interpolation;

    const MMHG: f64 = 133.322;

    /// A beat of a common carotid artery of 6.9 ml/s.
    fn beat() -> Waveform {
        let time = vec![0.0, 0.06, 0.12, 0.2, 0.3, 0.36, 0.42, 0.6];
        let value = vec![4.5e-6, 5e-6, 1.45e-5, 1.1e-5, 8e-6, 4e-6, 7e-6, 5.5e-6];
        let wave = Waveform::new(time, value, Some(0.9)).expect("valid");
        let wave = wave.interpolated(Interpolation::Monotone).expect("possible");
        wave.scaled(6.9e-6 / wave.mean())
    }

    fn target(split: Split) -> Target {
        Target {
            systolic: 120.0 * MMHG,
            diastolic: 80.0 * MMHG,
            distal_pressure: 5.0 * MMHG,
            split,
            wave_speed: 7.0,
            density: 1060.0,
        }
    }

    #[test]
    fn the_asked_pressures_come_out() {
        let areas = [7e-6, 1.4e-5];
        for (systolic, diastolic) in [(120.0, 80.0), (160.0, 70.0), (95.0, 60.0), (100.0, 92.0)] {
            let mut asked = target(Split::AREA);
            (asked.systolic, asked.diastolic) = (systolic * MMHG, diastolic * MMHG);
            for tuned in tune(&beat(), &areas, &asked).expect("possible") {
                // An independent run from a wrong start, by the other integration, for ten time constants.
                let Tuned { model, fraction, .. } = tuned;
                let flow = beat().scaled(fraction);
                let steps = 2000;
                let dt = 0.9 / f64::from(steps);
                let cycles = (10.0 * model.time_constant() / 0.9).ceil() as i32 + 3;
                let start =
                    crate::OutletState { flow: flow.at(0.0), ..crate::OutletState::at_rest(100.0 * MMHG) };
                let mut state = start;
                let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
                for k in 1..=cycles * steps {
                    let t = dt * f64::from(k);
                    state = model.advance(&state, flow.at(t), dt, crate::Integration::ModifiedEuler);
                    if k > (cycles - 1) * steps {
                        low = low.min(state.pressure);
                        high = high.max(state.pressure);
                    }
                }
                assert!((low / asked.diastolic - 1.0).abs() < 1e-3, "{} mmHg: {tuned:?}", low / MMHG);
                assert!((high / asked.systolic - 1.0).abs() < 1e-3, "{} mmHg: {tuned:?}", high / MMHG);
            }
        }
    }

    #[test]
    fn the_split_follows_area_murray_or_what_is_given() {
        let areas = [1e-5, 4e-5];
        let first = |split: Split| split.fractions(&areas).expect("valid")[0];
        assert!((first(Split::AREA) - 0.2).abs() < 1e-12);
        assert!((first(Split::MURRAY) - 1.0 / 9.0).abs() < 1e-12);
        assert!((first(Split::Given(vec![3.0, 1.0])) - 0.75).abs() < 1e-12);
        let tuned = tune(&beat(), &areas, &target(Split::MURRAY)).expect("possible");
        let total = |k: usize| tuned[k].model.total_resistance();
        assert!((total(0) / total(1) - 8.0).abs() < 0.5, "{tuned:?}");
        assert!(matches!(Split::Given(vec![1.0]).fractions(&areas), Err(BoundaryError::Count { .. })));
    }

    #[test]
    fn what_cannot_be_is_refused() {
        let mut asked = target(Split::AREA);
        asked.systolic = 400.0 * MMHG;
        asked.diastolic = 20.0 * MMHG;
        assert!(matches!(tune(&beat(), &[1e-5], &asked), Err(BoundaryError::TooSteady { .. })));
        asked.diastolic = 500.0 * MMHG;
        assert!(matches!(
            tune(&beat(), &[1e-5], &asked),
            Err(BoundaryError::OutOfRange { key: "systolic", .. })
        ));
    }
}

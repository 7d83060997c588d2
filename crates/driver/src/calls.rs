//! What the numbers of a scene call for, whether or not the case has it on, and what a run showed of it afterwards.

use crate::plan::PlannedOpening;
use vaso_boundary::profile::Profile;
use vaso_boundary::{Condition, Source};
use vaso_io::{EffectEntry, Summary};

/// Mean shear rate `8 U / D` below which blood is more viscous than its limit by more than a tenth \[1/s\] (Johnston et al. 2004).
const SHEAR_THINNING: f64 = 100.0;
/// Diameters below which shear thinning matters in any flow, and below which blood is no continuum any more \[m\].
const NARROW: f64 = 1e-3;
const NO_CONTINUUM: f64 = 0.3e-3;
/// Womersley number above which the profile of a pulsatile inlet is no parabola (Womersley 1955).
const PULSATILE: f64 = 3.0;
/// Radial strain below which a rigid wall changes the wall shear stress by less than some 5 %.
const STIFF: f64 = 0.02;
/// Shear rate below which the viscosity of blood is far above its limit \[1/s\].
const SLOW: f64 = 50.0;

/// Effects that every flow calls for.
const ALWAYS: [&str; 3] = ["blood.density_blend", "blood.gradient_correction", "blood.transport_velocity"];

/// Numbers of a scene that decide.
pub(crate) struct Scene<'a> {
    /// Openings with their conditions.
    pub(crate) openings: &'a [PlannedOpening],
    /// Womersley number at the inlet, where the flow pulses.
    pub(crate) womersley: Option<f64>,
    /// Radial strain expected of a wall that deforms \[-\].
    pub(crate) radial_strain: Option<f64>,
    /// Whether the viscosity follows the shear rate.
    pub(crate) is_thinning: bool,
}

impl Scene<'_> {
    /// Mean velocity \[m/s\] over time and diameter \[m\] of the largest inlet that prescribes a flow.
    fn inlet(&self) -> Option<(f64, f64)> {
        let inlets = self.openings.iter().filter_map(|o| match &o.condition {
            Condition::Velocity { mean, .. } => {
                let speed = match &mean.source {
                    Source::Constant(value) => *value,
                    Source::Waveform(waveform) => waveform.mean(),
                };
                Some((speed.abs(), 2.0 * o.opening.radius))
            }
            _ => None,
        });
        inlets.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Says of effects whether the numbers call for them, and returns what to say where that is not what the case has.
    pub(crate) fn judge(&self, effects: &mut [EffectEntry]) -> Vec<String> {
        let mut warnings = Vec::new();
        for left_out in effects.iter().filter(|e| ALWAYS.contains(&e.name.as_str()) && !e.on) {
            warnings.push(format!("`{}` is off: {}", left_out.name, left_out.reason));
        }
        if let Some((speed, diameter)) = self.inlet() {
            self.judge_thinning(speed, diameter, effects, &mut warnings);
        }
        if let Some(strain) = self.radial_strain {
            judge_strain(strain, effects, &mut warnings);
        }
        if let Some(alpha) = self.womersley.filter(|alpha| *alpha > PULSATILE) {
            let parabolic = self.openings.iter().filter(|o| match &o.condition {
                Condition::Velocity { mean, profile } => {
                    matches!(mean.source, Source::Waveform(_)) && *profile == Profile::Parabolic
                }
                _ => false,
            });
            for opening in parabolic {
                warnings.push(format!(
                    "the Womersley number is {alpha:.1}: above {PULSATILE} the profile of a pulsatile inflow is no parabola; set \
                     `opening.{}.profile` = \"womersley\"",
                    opening.name
                ));
            }
        }
        warnings
    }

    fn judge_thinning(
        &self,
        speed: f64,
        diameter: f64,
        effects: &mut [EffectEntry],
        warnings: &mut Vec<String>,
    ) {
        let rate = 8.0 * speed / diameter;
        let called_for = rate < SHEAR_THINNING || diameter < NARROW;
        let why = if diameter < NARROW {
            format!("the inlet is {:.2} mm wide, and below {:.0} mm", 1e3 * diameter, 1e3 * NARROW)
        } else {
            format!(
                "the mean shear rate at the inlet is 8 U/D = {rate:.0} 1/s, and below {SHEAR_THINNING:.0} 1/s"
            )
        };
        for effect in effects.iter_mut().filter(|e| e.name == "blood.shear_thinning") {
            effect.called_for = called_for;
            effect.reason += &format!("; 8 U/D at the inlet is {rate:.0} 1/s");
        }
        match (self.is_thinning, called_for) {
            (false, true) => warnings.push(format!(
                "{why} blood is more viscous than its limit: the scene calls for `blood.viscosity` = {{ model = \"carreau-yasuda\" }}"
            )),
            (true, false) => warnings.push(format!(
                "the mean shear rate at the inlet is 8 U/D = {rate:.0} 1/s: at rates above {SHEAR_THINNING:.0} 1/s a constant \
                 viscosity gives nearly the same, for less time"
            )),
            _ => {}
        }
        if diameter < NO_CONTINUUM {
            warnings.push(format!(
                "the inlet is {:.3} mm wide: below {:.1} mm blood is no continuum",
                1e3 * diameter,
                1e3 * NO_CONTINUUM
            ));
        }
    }
}

fn judge_strain(strain: f64, effects: &mut [EffectEntry], warnings: &mut Vec<String>) {
    let called_for = strain >= STIFF;
    let walls = ["wall.solid", "wall.shell", "wall.coupling"];
    for effect in effects.iter_mut().filter(|e| e.on && walls.contains(&e.name.as_str())) {
        effect.called_for = called_for;
        effect.reason += &format!("; radial strain of {:.1} % expected", 100.0 * strain);
    }
    if !called_for {
        warnings.push(format!(
            "the wall is expected to widen by {:.2} %: below {:.0} % a rigid wall (`wall.model` = \"rigid\") gives nearly the same \
             flow, for less time",
            100.0 * strain,
            100.0 * STIFF
        ));
    }
}

/// What a run showed that its plan had not expected, in words.
pub(crate) fn missed(
    summary: &Summary,
    expected_speed: f64,
    viscosity: f64,
    is_thinning: bool,
) -> Vec<String> {
    let mut missed = Vec::new();
    let speed = summary.stability.max_mach * summary.sound_speed_m_s;
    if speed > 1.5 * expected_speed {
        missed.push(format!(
            "the blood reached {speed:.3} m/s where the plan expected {expected_speed:.3} m/s: the sound speed of {:.2} m/s is {:.1} \
             times that instead of ten; raise `numerics.sound_speed`",
            summary.sound_speed_m_s,
            summary.sound_speed_m_s / speed
        ));
    }
    if summary.stability.max_density_error > DENSE {
        missed.push(format!(
            "the density deviated by {:.1} % at most, more than the {:.0} % of a nearly incompressible flow; raise \
             `numerics.sound_speed`",
            100.0 * summary.stability.max_density_error,
            100.0 * DENSE
        ));
    }
    let wall = summary.wall.as_ref();
    if let Some(stress) = wall.and_then(|w| w.tawss_pa.or(w.wss_pa)).filter(|_| !is_thinning) {
        let rate = stress.median / viscosity;
        if rate < SLOW {
            missed.push(format!(
                "half of the wall has a shear rate below {rate:.0} 1/s, where blood is far more viscous than its limit: the flow calls \
                 for `blood.viscosity` = {{ model = \"carreau-yasuda\" }}"
            ));
        }
    }
    missed
}

/// Deviation of the density that is told.
const DENSE: f64 = 0.03;

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_io::{Distribution, Stability, WallSummary};

    fn effect(name: &str, on: bool) -> EffectEntry {
        EffectEntry { name: name.into(), on, called_for: on, reason: "r".into(), seconds: None, bytes: None }
    }

    fn scene(is_thinning: bool, radial_strain: Option<f64>) -> Scene<'static> {
        Scene { openings: &[], womersley: None, radial_strain, is_thinning }
    }

    #[test]
    fn slow_blood_calls_for_thinning_and_fast_blood_does_not() {
        let mut warnings = Vec::new();
        let mut effects = [effect("blood.shear_thinning", false)];
        scene(false, None).judge_thinning(0.05, 6e-3, &mut effects, &mut warnings);
        assert!(
            effects[0].called_for && !effects[0].on && warnings[0].contains("carreau-yasuda"),
            "{warnings:?}"
        );
        warnings.clear();
        scene(true, None).judge_thinning(0.5, 6e-3, &mut effects, &mut warnings);
        assert!(!effects[0].called_for && warnings[0].contains("constant viscosity"), "{warnings:?}");
        warnings.clear();
        scene(false, None).judge_thinning(0.5, 6e-3, &mut effects, &mut warnings);
        assert!(warnings.is_empty(), "{warnings:?}");
        scene(true, None).judge_thinning(0.5, 0.2e-3, &mut effects, &mut warnings);
        assert!(effects[0].called_for && warnings[0].contains("no continuum"), "{warnings:?}");
    }

    #[test]
    fn a_stiff_wall_is_not_called_for() {
        let mut effects = [effect("wall.shell", true), effect("wall.solid", false)];
        assert!(scene(false, Some(0.05)).judge(&mut effects).is_empty());
        assert!(effects[0].called_for && !effects[1].called_for && effects[0].reason.contains("5.0 %"));
        let warnings = scene(false, Some(0.001)).judge(&mut effects);
        assert!(!effects[0].called_for && warnings[0].contains("0.10 %"), "{warnings:?}");
    }

    #[test]
    fn what_a_run_showed_is_held_against_its_plan() {
        let stress = Distribution { median: 0.1, ..Distribution::default() };
        let summary = Summary {
            sound_speed_m_s: 10.0,
            stability: Stability { max_mach: 0.15, max_density_error: 0.04, ..Stability::default() },
            wall: Some(WallSummary { wss_pa: Some(stress), ..WallSummary::default() }),
            ..Summary::default()
        };
        assert_eq!(missed(&summary, 0.9, 3.5e-3, false).len(), 3);
        assert_eq!(missed(&summary, 1.4, 3.5e-3, true).len(), 1);
    }
}

//! How much blood goes into a vessel of which only the size is known.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use vaso_boundary::{Waveform, WaveformError};
use vaso_geometry::Opening;

/// Mean velocity over section and beat in large arteries at rest \[m/s\]. A common carotid artery of radius 3 mm has 0.23 m/s
/// (Boileau et al. 2015), an ascending aorta of radius 13 mm with the whole cardiac output 0.16 m/s.
const MEAN_VELOCITY: f64 = 0.15;
/// Wall shear stress that arteries keep to, which bounds the velocity in narrow ones \[Pa\]: 1 to 7 Pa (Malek, Alper, Izumo
/// 1999). With Poiseuille's law it makes the flow go with the cube of the radius (Murray 1926).
const WALL_SHEAR_STRESS: f64 = 1.5;
/// Viscosity of blood in large arteries \[Pa s\].
const VISCOSITY: f64 = 3.5e-3;
/// Cardiac output of an adult at rest \[m^3/s\]: five litres a minute.
const CARDIAC_OUTPUT: f64 = 5e-3 / 60.0;
/// Most flow through the outlets over what their own sizes call for.
const OUTLETS: f64 = 2.0;
/// A beat \[s\]: 67 a minute.
pub(super) const PERIOD: f64 = 0.9;
/// Intervals of the table, 20 ms each.
const INTERVALS: usize = 45;
/// Cosine and sine amplitudes of the flow over its mean in a common carotid artery, by harmonics of the beat from the first:
/// transformed from the inflow of Boileau et al. 2015, their common carotid artery.
const HARMONICS: [[f64; 2]; 8] = [
    [-0.0121, 0.5066],
    [-0.2740, 0.1129],
    [-0.1750, -0.1313],
    [0.0245, -0.0995],
    [0.0142, -0.0502],
    [0.0508, -0.0287],
    [0.0324, 0.0118],
    [0.0206, 0.0105],
];

/// An inflow that was assumed.
pub(super) struct Inflow {
    /// Mean over a beat \[m^3/s\].
    pub(super) mean: f64,
    /// Why it is that.
    pub(super) reason: String,
    time: Vec<f64>,
    flow: Vec<f64>,
}

/// Flow that a vessel of a radius \[m\] is made for \[m^3/s\].
fn usual(radius: f64) -> f64 {
    let by_stress = WALL_SHEAR_STRESS * radius / (4.0 * VISCOSITY);
    MEAN_VELOCITY.min(by_stress) * PI * radius * radius
}

impl Inflow {
    /// The inflow of a vessel that blood enters at `inlet` and leaves at `outlets`.
    pub(super) fn new(inlet: &Opening, outlets: &[Opening]) -> Self {
        let by_outlets = OUTLETS * outlets.iter().map(|o| usual(o.radius)).sum::<f64>();
        let own = usual(inlet.radius);
        let mean = own.min(CARDIAC_OUTPUT).min(by_outlets);
        let velocity = mean / inlet.area;
        let reason = if mean < own && mean == CARDIAC_OUTPUT {
            "the cardiac output of an adult at rest, 5 L/min".to_owned()
        } else if mean < own {
            "twice what the sizes of the outlets call for".to_owned()
        } else if velocity < MEAN_VELOCITY * (1.0 - 1e-9) {
            format!(
                "a wall shear stress of {WALL_SHEAR_STRESS} Pa after Poiseuille, as arteries keep to (Malek et al. 1999)"
            )
        } else {
            "the area times a mean velocity of 15 cm/s, usual in large arteries at rest".to_owned()
        };
        let phases = (0..=INTERVALS).map(|k| k as f64 / INTERVALS as f64);
        let shape = |phase: f64| {
            let harmonic = |(k, [a, b]): (usize, &[f64; 2])| {
                let (sin, cos) = (TAU * (k + 1) as f64 * phase).sin_cos();
                a * cos + b * sin
            };
            1.0 + HARMONICS.iter().enumerate().map(harmonic).sum::<f64>()
        };
        Self {
            mean,
            reason,
            time: phases.clone().map(|phase| PERIOD * phase).collect(),
            flow: phases.map(|phase| mean * shape(phase)).collect(),
        }
    }

    /// Flow into the vessel over a beat \[m^3/s\].
    pub(super) fn waveform(&self) -> Result<Waveform, WaveformError> {
        // The last row stands for the first of the next beat, which a table may repeat and a waveform not.
        let rows = self.time.len() - 1;
        Waveform::new(self.time[..rows].to_vec(), self.flow[..rows].to_vec(), Some(PERIOD))
    }

    /// The table as a file that `opening.waveform` may name.
    pub(super) fn table(&self) -> String {
        let mut text = String::from(
            "# ASSUMED inflow over one beat; replace it by a measured one. Shape: common carotid artery, after Boileau et al. 2015.\n\
             time_s,flow_ml_per_s\n",
        );
        for (time, flow) in self.time.iter().zip(&self.flow) {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{time:.3},{:.5e}", flow * 1e6);
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Flows as measured: 6.5 ml/s in a common carotid artery of 3 mm (Boileau et al. 2015), and no more than there is.
    #[test]
    fn flows_are_of_the_measured_order() {
        let carotid = usual(3e-3) / 6.5e-6;
        assert!((0.5..1.5).contains(&carotid), "{carotid}");
        let ratio = usual(0.4e-3) / usual(0.2e-3);
        assert!((ratio - 8.0).abs() < 1e-9, "Murray's cube: {ratio}");
    }

    #[test]
    fn the_shape_has_a_mean_of_one_and_never_turns_back() {
        let table = |radius: f64| {
            let polygon = vec![];
            let opening = Opening {
                center: glam::DVec3::ZERO,
                normal: glam::DVec3::Z,
                area: PI * radius * radius,
                radius,
                polygon,
                axes: [glam::DVec3::X, glam::DVec3::Y],
                axis: glam::DVec3::Z,
            };
            Inflow::new(&opening, std::slice::from_ref(&opening))
        };
        let aorta = table(14e-3);
        assert_eq!(aorta.mean, CARDIAC_OUTPUT);
        let wave = aorta.waveform().expect("valid");
        assert!((wave.mean() / CARDIAC_OUTPUT - 1.0).abs() < 1e-3, "{}", wave.mean());
        let (low, high) = wave.range();
        assert!(low > 0.0 && (1.8..2.4).contains(&(high / aorta.mean)), "{low} {high}");
        assert_eq!(aorta.table().lines().count(), 2 + INTERVALS + 1);
    }
}

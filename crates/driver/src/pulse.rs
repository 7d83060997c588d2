//! The pulse wave in a vessel whose wall deforms, and the sound speed it asks for.

use std::fmt;
use vaso_geometry::Vessel;

/// Speeds of Moens and Korteweg for a tethered tube, `c_w^2 = E t / (2 rho R (1 - nu^2))` \[m/s\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PulseWave {
    /// In the vessel as a whole: with `R` twice its volume over the area of its wall.
    pub mean: f64,
    /// With the radius of the narrowest opening, where it is fastest.
    pub fastest: f64,
}

/// Sound speed over that of the pulse wave, in the whole and where it is fastest. The blood yields in series with the wall,
/// `1/c_eff^2 = 1/c_w^2 + 1/c^2`: 5 slows the wave by 2 per cent, 3 by 5.
const FACTOR: f64 = 5.0;
const FACTOR_WHERE_FASTEST: f64 = 3.0;

impl PulseWave {
    /// In `vessel` with a wall of a `stiffness` `E t / (1 - nu^2)` \[N/m\], filled with blood of a `density` \[kg/m^3\].
    pub(crate) fn new(vessel: &Vessel, stiffness: f64, density: f64) -> Self {
        let speed = |radius: f64| (stiffness / (2.0 * density * radius)).sqrt();
        let narrowest = vessel.openings.iter().map(|o| o.radius).fold(f64::INFINITY, f64::min);
        Self { mean: speed(2.0 * vessel.surface.volume() / vessel.wall_area()), fastest: speed(narrowest) }
    }

    /// Least sound speed \[m/s\].
    pub(crate) fn sound_speed(&self) -> f64 {
        (FACTOR * self.mean).max(FACTOR_WHERE_FASTEST * self.fastest)
    }

    /// Why [`Self::sound_speed`] is what it is.
    pub(crate) fn reason(&self) -> String {
        let sound = self.sound_speed();
        let (mean, fastest) = (sound / self.mean, sound / self.fastest);
        let slowed = |factor: f64| 50.0 / (factor * factor);
        format!(
            "{mean:.1} times the pulse wave speed of {:.2} m/s in the vessel as a whole, which it then slows by {:.0} %, and \
             {fastest:.1} times that of {:.2} m/s at its narrowest opening, by {:.0} %",
            self.mean,
            slowed(mean),
            self.fastest,
            slowed(fastest)
        )
    }
}

impl fmt::Display for PulseWave {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{:.2} m/s", self.mean)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_vessel_decides_unless_an_opening_is_very_narrow() {
        let usual = PulseWave { mean: 8.0, fastest: 11.0 };
        assert_eq!(usual.sound_speed(), 40.0);
        assert!(usual.reason().contains("by 2 %, and 3.6 times that of 11.00 m/s"), "{}", usual.reason());
        let narrow = PulseWave { mean: 8.0, fastest: 20.0 };
        assert_eq!(narrow.sound_speed(), 60.0);
    }
}

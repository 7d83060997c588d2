//! Why particles cannot be made, and what is doubtful about those that can.

use crate::Settings;
use glam::DVec3;
use vaso_geometry::Vessel;

/// Spacings across the radius of an opening below which it is refused.
const REFUSED: f64 = 1.0;
/// Spacings across the radius of an opening below which it is doubtful.
const DOUBTFUL: f64 = 3.0;
/// More particles than this are taken for a mistake in the spacing or in the unit of the surface.
const MOST_PARTICLES: f64 = 1e9;

/// Why no particles were made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GenerationError {
    /// A setting is out of its range.
    #[error("`{key}` is {value}, allowed is {allowed}")]
    Setting {
        /// Name of the field of [`Settings`].
        key: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// The range.
        allowed: &'static str,
    },
    /// Not a single ring of particles fits into an opening.
    #[error(
        "`spacing` {spacing:.3e} m leaves no ring of particles in opening {opening} of radius {radius:.3e} m; \
         take {needed:.3e} m or less, or close that opening"
    )]
    TooCoarse {
        /// Number of the opening in the vessel.
        opening: usize,
        /// Its radius \[m\].
        radius: f64,
        /// The spacing asked for \[m\].
        spacing: f64,
        /// Largest spacing with three particles across the radius \[m\].
        needed: f64,
    },
    /// Nothing is left to put a shell on.
    #[error(
        "the vessel has no wall: all its triangles belong to the {openings} openings found; \
         is it a tube with round ends?"
    )]
    NoWall {
        /// Openings of the vessel.
        openings: usize,
    },
    /// The whole region takes no particle.
    #[error(
        "`spacing` {spacing:.3e} m is too large: a volume of {volume:.3e} m^3 does not hold one particle"
    )]
    Empty {
        /// The spacing asked for \[m\].
        spacing: f64,
        /// Volume of the region \[m^3\].
        volume: f64,
    },
    /// The spacing asks for more particles than any machine this is meant for can hold.
    #[error(
        "`spacing` {spacing:.3e} m asks for {predicted:.1e} particles, at most 1e9 are made; \
         is the unit of the surface right?"
    )]
    TooFine {
        /// The spacing asked for \[m\].
        spacing: f64,
        /// Number of particles it would take.
        predicted: f64,
    },
}

/// What is doubtful about a spacing that still works.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Warning {
    /// Fewer than three particles lie across the radius of an opening.
    #[error(
        "opening {opening} has only {:.1} spacings across its radius of {radius:.3e} m; \
         its flow needs a spacing of {needed:.3e} m or less",
        radius / spacing
    )]
    Unresolved {
        /// Number of the opening in the vessel.
        opening: usize,
        /// Its radius \[m\].
        radius: f64,
        /// The spacing asked for \[m\].
        spacing: f64,
        /// Largest spacing with three particles across the radius \[m\].
        needed: f64,
    },
    /// Limbs are so near each other that they have one wall.
    #[error(
        "{:.2} % of the wall of {thickness:.3e} m belong to two parts of the vessel at once, \
         which move together there; a thinner wall or a shell keeps them apart",
        100.0 * shared
    )]
    SharedWall {
        /// Share of the volume of the wall.
        shared: f64,
        /// Thickness of the wall \[m\].
        thickness: f64,
    },
}

/// What is doubtful about `settings` for `vessel`; costs nothing, so it can be asked before generating.
pub fn warnings(vessel: &Vessel, settings: &Settings) -> Vec<Warning> {
    let spacing = settings.spacing;
    let radii = vessel.openings.iter().map(|o| o.radius).enumerate();
    radii
        .filter(|&(_, radius)| radius < DOUBTFUL * spacing)
        .map(|(opening, radius)| Warning::Unresolved { opening, radius, spacing, needed: radius / DOUBTFUL })
        .collect()
}

/// Refuses settings that cannot give particles for `vessel`.
pub(crate) fn check(vessel: &Vessel, settings: &Settings) -> Result<(), GenerationError> {
    check_spacing(vessel, settings.spacing, settings.smoothing)
}

/// Refuses a spacing and a smoothing length that cannot give particles for `vessel`.
pub(crate) fn check_spacing(vessel: &Vessel, spacing: f64, smoothing: f64) -> Result<(), GenerationError> {
    if !(spacing > 0.0 && spacing.is_finite()) {
        return Err(GenerationError::Setting { key: "spacing", value: spacing, allowed: "above 0 m" });
    }
    if !(1.0..=2.0).contains(&smoothing) {
        let allowed = "1 to 2 spacings";
        return Err(GenerationError::Setting { key: "smoothing", value: smoothing, allowed });
    }
    for (opening, radius) in vessel.openings.iter().map(|o| o.radius).enumerate() {
        if radius < REFUSED * spacing {
            return Err(GenerationError::TooCoarse { opening, radius, spacing, needed: radius / DOUBTFUL });
        }
    }
    Ok(())
}

/// Number of particles for a region of `volume` \[m^3\].
pub(crate) fn particle_count(volume: f64, spacing: f64) -> Result<usize, GenerationError> {
    let predicted = volume / spacing.powi(3);
    if predicted > MOST_PARTICLES {
        return Err(GenerationError::TooFine { spacing, predicted });
    }
    match predicted.round() {
        n if n >= 1.0 => Ok(n as usize),
        _ => Err(GenerationError::Empty { spacing, volume }),
    }
}

/// Number of particles for a surface of `area` \[m^2\] within `bounds` \[m\], rounded up.
pub(crate) fn shell_count(area: f64, bounds: (DVec3, DVec3), spacing: f64) -> Result<usize, GenerationError> {
    let predicted = (area / (spacing * spacing)).ceil();
    // Neighbours are searched in cells over the whole box, so their number is a limit too.
    let cells = (bounds.1 - bounds.0).to_array().iter().map(|e| e / spacing + 1.0).product::<f64>() / 8.0;
    if predicted.max(cells) > MOST_PARTICLES {
        return Err(GenerationError::TooFine { spacing, predicted: predicted.max(cells) });
    }
    Ok(predicted as usize)
}

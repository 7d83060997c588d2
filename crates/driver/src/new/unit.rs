//! In which unit a surface is, told from how large its vessel would be in each.

use crate::error::DriverError;
use crate::print::length;
use std::ops::RangeInclusive;
use std::path::Path;
use vaso_geometry::{LengthUnit, Vessel};

/// Radius of the largest opening that vessels have \[m\]: from an artery of a mouse or a small one of the brain to a widened
/// aorta.
const RADIUS: RangeInclusive<f64> = 0.5e-3..=25e-3;
/// Diagonal of the box around what people cut out of an image \[m\].
const DIAGONAL: RangeInclusive<f64> = 4e-3..=1.0;

/// How large a vessel is if its coordinates are in a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Reading {
    unit: LengthUnit,
    /// Radius of the largest opening \[m\].
    radius: f64,
    /// Diagonal of its box \[m\].
    diagonal: f64,
}

impl Reading {
    fn is_vessel(&self) -> bool {
        RADIUS.contains(&self.radius) && DIAGONAL.contains(&self.diagonal)
    }

    /// How far it is from the vessels most often simulated, aortas to coronary arteries: squared, in standard deviations of the
    /// logarithms of radius (5 mm, a factor of 2.7) and diagonal (10 cm, a factor of 2.2). Round numbers, no statistics.
    fn oddity(&self) -> f64 {
        (self.radius / 5e-3).ln().powi(2) + ((self.diagonal / 0.1).ln() / 0.8).powi(2)
    }

    fn words(&self) -> String {
        format!(
            "in {} its largest opening has a radius of {} and the vessel is {} across",
            self.unit,
            length(self.radius),
            length(self.diagonal)
        )
    }
}

fn readings(vessel: &Vessel) -> Vec<Reading> {
    let own = vessel.unit.metres();
    let (radius, diagonal) = (vessel.openings.first().map_or(0.0, |o| o.radius), vessel.surface.diagonal());
    let reading = |(unit, _): (LengthUnit, _)| {
        let scale = unit.metres() / own;
        Reading { unit, radius: radius * scale, diagonal: diagonal * scale }
    };
    LengthUnit::ALL.into_iter().map(reading).collect()
}

/// The unit in which `vessel`, read in any unit, is most like a vessel, and the reason in words, with the units it might be in as well.
///
/// # Errors
/// When it is as large as vessels are in no unit.
pub(super) fn guess(vessel: &Vessel, file: &Path) -> Result<(LengthUnit, String), DriverError> {
    let (mut likely, others): (Vec<Reading>, Vec<Reading>) =
        readings(vessel).into_iter().partition(Reading::is_vessel);
    likely.sort_by(|a, b| a.oddity().total_cmp(&b.oddity()));
    let Some((best, doubtful)) = likely.split_first() else {
        let units = LengthUnit::ALL.map(|(_, symbol)| symbol).join(", ");
        let readings: Vec<String> =
            others.iter().map(|reading| format!("\n    {}", reading.words())).collect();
        return Err(DriverError::input(format!(
            "{}: the unit of the coordinates is not in the file, and in no unit is it as large as vessels are:{}\n  allowed  \
             {units}\n  advice   give it, as in --unit {}",
            file.display(),
            readings.concat(),
            LengthUnit::Millimetre
        )));
    };
    let radii = |readings: &[Reading]| {
        readings.iter().map(|o| format!("{} in {}", length(o.radius), o.unit)).collect::<Vec<_>>().join(", ")
    };
    let doubt = match doubtful {
        [] => String::new(),
        [other, ..] => format!("; IN DOUBT, {}: then give --unit {}", other.words(), other.unit),
    };
    let reason = format!("guessed: {}; the radius would be {}{doubt}", best.words(), radii(&others));
    Ok((best.unit, reason))
}

/// What is said of a unit that was given.
pub(super) fn given(vessel: &Vessel) -> String {
    let own = readings(vessel).into_iter().find(|reading| reading.unit == vessel.unit);
    own.map_or_else(String::new, |reading| {
        let doubt = if reading.is_vessel() { "" } else { ", which vessels are not; is it the right unit?" };
        format!("as given: {}{doubt}", reading.words())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;
    use vaso_geometry::{prepare, shapes};

    fn guessed(radius: f64) -> Result<LengthUnit, String> {
        let pipe = shapes::pipe(radius, 20.0 * radius, DVec3::Z, 24);
        let vessel = prepare(pipe, Some(LengthUnit::Metre)).expect("a pipe");
        guess(&vessel, Path::new("pipe.stl")).map(|(unit, _)| unit).map_err(|e| e.to_string())
    }

    #[test]
    fn sizes_of_one_unit_only_are_guessed() {
        assert_eq!(guessed(3.1), Ok(LengthUnit::Millimetre));
        assert_eq!(guessed(12.0), Ok(LengthUnit::Millimetre));
        assert_eq!(guessed(0.3), Ok(LengthUnit::Centimetre));
        assert_eq!(guessed(3.1e-3), Ok(LengthUnit::Metre));
        assert_eq!(guessed(3100.0), Ok(LengthUnit::Micrometre));
    }

    #[test]
    fn an_aorta_in_centimetres_may_be_a_coronary_artery_in_millimetres() {
        let told = |radius: f64, length: f64| {
            let pipe = shapes::pipe(radius, length, DVec3::Z, 24);
            let vessel = prepare(pipe, Some(LengthUnit::Metre)).expect("a pipe");
            guess(&vessel, Path::new("pipe.stl")).expect("two units fit")
        };
        let (unit, reason) = told(1.4, 20.0);
        assert_eq!(unit, LengthUnit::Centimetre);
        assert!(reason.contains("IN DOUBT, in mm") && reason.contains("--unit mm"), "{reason}");
        assert_eq!(told(1.7, 80.0).0, LengthUnit::Millimetre);
        let text = guessed(0.04).expect_err("an opening of 0.04 mm, 0.4 mm or 4 cm");
        assert!(text.contains("in no unit") && text.contains("--unit"), "{text}");
    }
}

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

/// The one unit in which `vessel`, read in any unit, is as large as vessels are, and the reason in words.
///
/// # Errors
/// When there is more than one such unit, or none: a wrong guess is a factor of a thousand in volume.
pub(super) fn guess(vessel: &Vessel, file: &Path) -> Result<(LengthUnit, String), DriverError> {
    let all = readings(vessel);
    let (likely, others): (Vec<Reading>, Vec<Reading>) = all.into_iter().partition(Reading::is_vessel);
    if let [only] = likely[..] {
        let others: Vec<String> =
            others.iter().map(|o| format!("{} in {}", length(o.radius), o.unit)).collect();
        return Ok((
            only.unit,
            format!("guessed: {}; the radius would be {}", only.words(), others.join(", ")),
        ));
    }
    let (what, candidates) = if likely.is_empty() {
        ("in no unit is it as large as vessels are", others)
    } else {
        ("it may be a vessel in more than one unit", likely)
    };
    let units = LengthUnit::ALL.map(|(_, symbol)| symbol).join(", ");
    let readings: Vec<String> =
        candidates.iter().map(|reading| format!("\n    {}", reading.words())).collect();
    Err(DriverError::input(format!(
        "{}: the unit of the coordinates is not in the file, and {what}:{}\n  allowed  {units}\n  advice   give it, as in \
         --unit {}",
        file.display(),
        readings.concat(),
        candidates.first().map_or(LengthUnit::Millimetre, |reading| reading.unit)
    )))
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
        let text = guessed(1.4).expect_err("two units fit");
        assert!(text.contains("in cm") && text.contains("in mm") && !text.contains("in um"), "{text}");
        assert!(text.contains("--unit"), "{text}");
        let text = guessed(0.1).expect_err("an opening of 0.1 mm, 1 mm or 10 cm");
        assert!(text.contains("in no unit"), "{text}");
    }
}

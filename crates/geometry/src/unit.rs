//! Units of length a surface file may be in: such files do not say it themselves.

use std::{fmt, str::FromStr};

/// Unit of the coordinates of a surface file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LengthUnit {
    /// Metre.
    Metre,
    /// Centimetre.
    Centimetre,
    /// Millimetre.
    Millimetre,
    /// Micrometre.
    Micrometre,
}

impl LengthUnit {
    /// Every unit there is, with its symbol.
    pub const ALL: [(LengthUnit, &'static str); 4] = [
        (LengthUnit::Metre, "m"),
        (LengthUnit::Centimetre, "cm"),
        (LengthUnit::Millimetre, "mm"),
        (LengthUnit::Micrometre, "um"),
    ];

    /// Length of one such unit \[m\].
    pub fn metres(self) -> f64 {
        match self {
            LengthUnit::Metre => 1.0,
            LengthUnit::Centimetre => 1e-2,
            LengthUnit::Millimetre => 1e-3,
            LengthUnit::Micrometre => 1e-6,
        }
    }

    /// Symbol: "m", "cm", "mm" or "um".
    pub fn symbol(self) -> &'static str {
        match self {
            LengthUnit::Metre => "m",
            LengthUnit::Centimetre => "cm",
            LengthUnit::Millimetre => "mm",
            LengthUnit::Micrometre => "um",
        }
    }

    /// The likely unit of a vessel whose bounding box has this diagonal, in that unknown unit.
    ///
    /// Vessels are 5 mm to 1 m long, so a diagonal below 1 must be metres and one above it is taken as
    /// millimetres. Centimetres and micrometres are never guessed: their range overlaps that of
    /// millimetres, and a wrong guess is a factor of a thousand in volume.
    pub fn guess(diagonal: f64) -> LengthUnit {
        if diagonal < 1.0 { LengthUnit::Metre } else { LengthUnit::Millimetre }
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.symbol())
    }
}

/// The text is no unit of length: what it was.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("\"{0}\" is no unit of length of a surface; allowed are \"m\", \"cm\", \"mm\" and \"um\"")]
pub struct UnknownUnit(pub String);

impl FromStr for LengthUnit {
    type Err = UnknownUnit;

    fn from_str(text: &str) -> Result<Self, UnknownUnit> {
        LengthUnit::ALL
            .into_iter()
            .find_map(|(unit, symbol)| (symbol == text).then_some(unit))
            .ok_or_else(|| UnknownUnit(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_and_back() {
        for (unit, symbol) in LengthUnit::ALL {
            assert_eq!(symbol.parse(), Ok(unit));
            assert_eq!(unit.to_string(), symbol);
        }
        assert_eq!("inch".parse::<LengthUnit>(), Err(UnknownUnit("inch".into())));
    }

    #[test]
    fn guesses_by_the_size_of_vessels() {
        assert_eq!(LengthUnit::guess(0.058), LengthUnit::Metre);
        assert_eq!(LengthUnit::guess(58.0), LengthUnit::Millimetre);
    }
}

//! Dimensions as exponents of metre, kilogram, second and radian.

use std::fmt;
use std::ops::{Div, Mul};

/// The dimension of a quantity: the exponents of m, kg, s and rad in its SI unit.
///
/// The plane angle is kept apart, although SI counts it as a pure number, so that a bare `"40"` cannot
/// pass for forty radians where degrees were meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Dimension {
    /// Exponent of the metre.
    pub length: i8,
    /// Exponent of the kilogram.
    pub mass: i8,
    /// Exponent of the second.
    pub time: i8,
    /// Exponent of the radian.
    pub angle: i8,
}

const fn dimension(length: i8, mass: i8, time: i8) -> Dimension {
    Dimension { length, mass, time, angle: 0 }
}

/// A pure number.
pub const NUMBER: Dimension = dimension(0, 0, 0);
/// Plane angle \[rad\].
pub const ANGLE: Dimension = Dimension { angle: 1, ..NUMBER };
/// Length \[m\].
pub const LENGTH: Dimension = dimension(1, 0, 0);
/// Area \[m^2\].
pub const AREA: Dimension = dimension(2, 0, 0);
/// Volume \[m^3\].
pub const VOLUME: Dimension = dimension(3, 0, 0);
/// Time \[s\].
pub const TIME: Dimension = dimension(0, 0, 1);
/// Frequency or shear rate \[1/s\].
pub const FREQUENCY: Dimension = dimension(0, 0, -1);
/// Mass \[kg\].
pub const MASS: Dimension = dimension(0, 1, 0);
/// Mass density \[kg/m^3\].
pub const DENSITY: Dimension = dimension(-3, 1, 0);
/// Velocity \[m/s\].
pub const VELOCITY: Dimension = dimension(1, 0, -1);
/// Acceleration \[m/s^2\].
pub const ACCELERATION: Dimension = dimension(1, 0, -2);
/// Force \[N\].
pub const FORCE: Dimension = dimension(1, 1, -2);
/// Energy \[J\].
pub const ENERGY: Dimension = dimension(2, 1, -2);
/// Pressure, stress or elastic modulus \[Pa\].
pub const PRESSURE: Dimension = dimension(-1, 1, -2);
/// Dynamic viscosity \[Pa s\].
pub const VISCOSITY: Dimension = dimension(-1, 1, -1);
/// Kinematic viscosity \[m^2/s\].
pub const KINEMATIC_VISCOSITY: Dimension = dimension(2, 0, -1);
/// Volume flow rate \[m^3/s\].
pub const FLOW_RATE: Dimension = dimension(3, 0, -1);
/// Hydraulic resistance: pressure per flow rate \[Pa s/m^3\].
pub const RESISTANCE: Dimension = dimension(-4, 1, -1);
/// Hydraulic compliance: volume per pressure \[m^3/Pa\].
pub const COMPLIANCE: Dimension = dimension(4, -1, 2);
/// Stiffness of a support per area: pressure per displacement \[Pa/m\].
pub const SUPPORT_STIFFNESS: Dimension = dimension(-2, 1, -2);
/// Damping of a support per area: pressure per velocity \[Pa s/m\].
pub const SUPPORT_DAMPING: Dimension = dimension(-2, 1, -1);

/// What a dimension is called, its SI unit, and other units people write it in, small to large.
pub(crate) struct Known {
    pub(crate) dimension: Dimension,
    pub(crate) name: &'static str,
    pub(crate) units: &'static [&'static str],
}

pub(crate) const KNOWN: &[Known] = &[
    Known { dimension: NUMBER, name: "a pure number", units: &["", "%"] },
    Known { dimension: ANGLE, name: "an angle", units: &["rad", "deg"] },
    Known { dimension: LENGTH, name: "a length", units: &["m", "mm", "um", "cm"] },
    Known { dimension: AREA, name: "an area", units: &["m^2", "mm^2", "cm^2"] },
    Known { dimension: VOLUME, name: "a volume", units: &["m^3", "ml", "ul", "L"] },
    Known { dimension: TIME, name: "a time", units: &["s", "ms", "us", "min", "h"] },
    Known { dimension: FREQUENCY, name: "a frequency", units: &["1/s", "Hz", "1/min"] },
    Known { dimension: MASS, name: "a mass", units: &["kg", "g", "mg"] },
    Known { dimension: DENSITY, name: "a density", units: &["kg/m^3", "g/cm^3", "g/ml"] },
    Known { dimension: VELOCITY, name: "a velocity", units: &["m/s", "cm/s", "mm/s"] },
    Known { dimension: ACCELERATION, name: "an acceleration", units: &["m/s^2", "cm/s^2"] },
    Known { dimension: FORCE, name: "a force", units: &["N", "mN", "uN", "dyn"] },
    Known { dimension: ENERGY, name: "an energy", units: &["J", "mJ", "uJ"] },
    Known {
        dimension: PRESSURE,
        name: "a pressure",
        units: &["Pa", "kPa", "MPa", "mmHg", "cmH2O", "dyn/cm^2", "bar"],
    },
    Known { dimension: VISCOSITY, name: "a dynamic viscosity", units: &["Pa s", "mPa s", "cP", "P"] },
    Known {
        dimension: KINEMATIC_VISCOSITY,
        name: "a kinematic viscosity",
        units: &["m^2/s", "mm^2/s", "cSt"],
    },
    Known {
        dimension: FLOW_RATE,
        name: "a flow rate",
        units: &["m^3/s", "ml/s", "ml/min", "L/min", "cm^3/s"],
    },
    Known {
        dimension: RESISTANCE,
        name: "a hydraulic resistance",
        units: &["Pa s/m^3", "mmHg s/ml", "mmHg min/L", "dyn s/cm^5"],
    },
    Known {
        dimension: COMPLIANCE,
        name: "a hydraulic compliance",
        units: &["m^3/Pa", "ml/mmHg", "cm^5/dyn"],
    },
    Known { dimension: SUPPORT_STIFFNESS, name: "a stiffness per area", units: &["Pa/m", "kPa/mm", "N/m^3"] },
    Known {
        dimension: SUPPORT_DAMPING,
        name: "a damping per area",
        units: &["Pa s/m", "kPa s/m", "dyn s/cm^3"],
    },
];

impl Dimension {
    /// What the field calls it, with an article: `a pressure`, `a flow rate`; a dimension without a name of its
    /// own is given by its SI unit.
    pub fn name(self) -> String {
        KNOWN
            .iter()
            .find(|known| known.dimension == self)
            .map_or_else(|| format!("a quantity in {self}"), |known| known.name.to_owned())
    }

    /// Units in use for it, the SI unit first; empty for a dimension without a name.
    pub fn units(self) -> &'static [&'static str] {
        KNOWN.iter().find(|known| known.dimension == self).map_or(&[], |known| known.units)
    }

    /// The dimension raised to a power, or `None` when an exponent leaves the range of -128 to 127.
    pub fn power(self, exponent: i8) -> Option<Self> {
        Some(Self {
            length: self.length.checked_mul(exponent)?,
            mass: self.mass.checked_mul(exponent)?,
            time: self.time.checked_mul(exponent)?,
            angle: self.angle.checked_mul(exponent)?,
        })
    }

    /// The dimension of a product, or `None` when an exponent leaves the range of -128 to 127.
    pub fn checked_mul(self, other: Self) -> Option<Self> {
        Some(Self {
            length: self.length.checked_add(other.length)?,
            mass: self.mass.checked_add(other.mass)?,
            time: self.time.checked_add(other.time)?,
            angle: self.angle.checked_add(other.angle)?,
        })
    }
}

impl Mul for Dimension {
    type Output = Self;

    /// # Panics
    /// When an exponent leaves the range of -128 to 127, which no product of named dimensions does.
    fn mul(self, other: Self) -> Self {
        self.checked_mul(other).expect("exponents of named dimensions are small")
    }
}

impl Div for Dimension {
    type Output = Self;

    /// # Panics
    /// When an exponent leaves the range of -128 to 127, which no quotient of named dimensions does.
    fn div(self, other: Self) -> Self {
        other
            .power(-1)
            .and_then(|inverse| self.checked_mul(inverse))
            .expect("exponents of named dimensions are small")
    }
}

/// The SI unit in base units, such as `kg m^-1 s^-2`; nothing for a pure number.
impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let factors = [("kg", self.mass), ("m", self.length), ("s", self.time), ("rad", self.angle)];
        let mut space = "";
        for (symbol, exponent) in factors.into_iter().filter(|&(_, exponent)| exponent != 0) {
            write!(f, "{space}{symbol}")?;
            if exponent != 1 {
                write!(f, "^{exponent}")?;
            }
            space = " ";
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_dimensions_agree_with_their_definitions() {
        assert_eq!(RESISTANCE, PRESSURE / FLOW_RATE);
        assert_eq!(COMPLIANCE, VOLUME / PRESSURE);
        assert_eq!(VISCOSITY, PRESSURE * TIME);
        assert_eq!(KINEMATIC_VISCOSITY, VISCOSITY / DENSITY);
        assert_eq!(SUPPORT_STIFFNESS, PRESSURE / LENGTH);
        assert_eq!(SUPPORT_DAMPING, PRESSURE / VELOCITY);
        assert_eq!(FORCE, MASS * ACCELERATION);
        assert_eq!(ENERGY, FORCE * LENGTH);
        assert_eq!(RESISTANCE * COMPLIANCE, TIME);
    }

    #[test]
    fn every_listed_unit_has_the_dimension_it_is_listed_for() {
        for known in KNOWN {
            for unit in known.units {
                let (_, found) = crate::parse_unit(unit).unwrap();
                assert_eq!(found, known.dimension, "{unit}");
            }
        }
    }

    #[test]
    fn prints_base_units() {
        assert_eq!(PRESSURE.to_string(), "kg m^-1 s^-2");
        assert_eq!(NUMBER.to_string(), "");
        assert_eq!((MASS * MASS).name(), "a quantity in kg^2");
    }
}

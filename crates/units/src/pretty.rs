//! From SI values to text a person likes to read.

use crate::dimension::{
    ANGLE, COMPLIANCE, DENSITY, Dimension, FLOW_RATE, FREQUENCY, LENGTH, PRESSURE, RESISTANCE, VISCOSITY,
};

/// Units to print in, where the list of units in use holds some that are rather read than written.
fn units_to_print(dimension: Dimension) -> &'static [&'static str] {
    match dimension {
        ANGLE => &["deg"],
        LENGTH => &["m", "mm", "um"],
        DENSITY => &["kg/m^3"],
        PRESSURE => &["Pa", "kPa", "MPa"],
        FREQUENCY => &["1/s"],
        VISCOSITY => &["Pa s", "mPa s"],
        FLOW_RATE => &["m^3/s", "ml/s", "ul/s"],
        RESISTANCE => &["Pa s/m^3"],
        COMPLIANCE => &["m^3/Pa"],
        _ => dimension.units(),
    }
}

/// An SI value with four significant digits in a handy unit: `pretty(5e-4, LENGTH)` is `0.5 mm`,
/// `pretty(15998.7, PRESSURE)` is `16 kPa`.
///
/// The first of the units in use, the SI unit leading, whose number lies from 0.1 to below 1000 is taken; where none
/// does, the SI unit.
pub fn pretty(value: f64, dimension: Dimension) -> String {
    let candidates = units_to_print(dimension);
    let handy = candidates.iter().find_map(|unit| {
        let (factor, _) = crate::parse_unit(unit).ok()?;
        let number = value / factor;
        (0.1..1000.0).contains(&number.abs()).then(|| (number, (*unit).to_owned()))
    });
    let si = || dimension.units().first().map_or_else(|| dimension.to_string(), |unit| (*unit).to_owned());
    let (number, unit) = handy.unwrap_or_else(|| (value, si()));
    let digits = significant(number);
    if unit.is_empty() { digits } else { format!("{digits} {unit}") }
}

/// A number with four significant digits, without trailing zeros.
pub fn significant(number: f64) -> String {
    if !number.is_finite() || number == 0.0 {
        return format!("{number}");
    }
    let rounded: f64 = format!("{number:.3e}").parse().expect("a formatted double is a double");
    if (1e-3..1e5).contains(&rounded.abs()) { format!("{rounded}") } else { format!("{rounded:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dimension::*;

    #[test]
    fn picks_units_people_use() {
        assert_eq!(pretty(5e-4, LENGTH), "0.5 mm");
        assert_eq!(pretty(2e-5, LENGTH), "20 um");
        assert_eq!(pretty(15_998.686, PRESSURE), "16 kPa");
        assert_eq!(pretty(0.0035, VISCOSITY), "3.5 mPa s");
        assert_eq!(pretty(1060.0, DENSITY), "1060 kg/m^3");
        assert_eq!(pretty(6.92e-6, FLOW_RATE), "6.92 ml/s");
        assert_eq!(pretty(1.5e8, RESISTANCE), "1.5e8 Pa s/m^3");
        assert_eq!(pretty(0.012, TIME), "12 ms");
        assert_eq!(pretty(0.45, NUMBER), "0.45");
        assert_eq!(pretty(std::f64::consts::FRAC_PI_2, ANGLE), "90 deg");
        assert_eq!(pretty(0.0, PRESSURE), "0 Pa");
        assert_eq!(pretty(-0.3, VELOCITY), "-0.3 m/s");
        assert_eq!(pretty(-0.03, VELOCITY), "-3 cm/s");
        assert_eq!(pretty(2.0, MASS * MASS), "2 kg^2");
    }
}

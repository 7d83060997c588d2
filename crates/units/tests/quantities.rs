//! Units against their published values, what is refused and where the caret points, and round trips.

use proptest::prelude::*;
use vaso_units::dimension::*;
use vaso_units::{Quantity, UnitError, parse, parse_as, parse_unit, pretty};

#[test]
fn si_values_of_what_people_write() {
    let table: &[(&str, Dimension, f64)] = &[
        ("0.5 mm", LENGTH, 5e-4),
        ("0.3 mm", LENGTH, 3e-4),
        ("20 um", LENGTH, 2e-5),
        ("20 µm", LENGTH, 2e-5),
        ("10 ms", TIME, 0.01),
        ("1.5 min", TIME, 90.0),
        ("1.2 Hz", FREQUENCY, 1.2),
        ("100 s^-1", FREQUENCY, 100.0),
        ("100 1/s", FREQUENCY, 100.0),
        ("1060 kg/m^3", DENSITY, 1060.0),
        ("1.06 g/cm3", DENSITY, 1060.0),
        ("1.06 g/ml", DENSITY, 1060.0),
        ("0.3 m/s", VELOCITY, 0.3),
        ("30cm/s", VELOCITY, 0.3),
        ("1e6 Pa/m", SUPPORT_STIFFNESS, 1e6),
        ("1e4 Pa s/m", SUPPORT_DAMPING, 1e4),
        ("3.5 mPa s", VISCOSITY, 3.5e-3),
        ("3.5 mPa*s", VISCOSITY, 3.5e-3),
        ("3.5 cP", VISCOSITY, 3.5e-3),
        ("0.035 P", VISCOSITY, 3.5e-3),
        ("0.8 MPa", PRESSURE, 8e5),
        ("10 dyn/cm^2", PRESSURE, 1.0),
        ("1 bar", PRESSURE, 1e5),
        ("1 kg m^-1 s^-2", PRESSURE, 1.0),
        ("1 kg/m/s²", PRESSURE, 1.0),
        ("1.5e8 Pa s/m^3", RESISTANCE, 1.5e8),
        ("1 dyn s/cm^5", RESISTANCE, 1e5),
        ("8e-10 m^3/Pa", COMPLIANCE, 8e-10),
        ("1 cm^5/dyn", COMPLIANCE, 1e-5),
        ("1 ml/(mmHg s)", FLOW_RATE / PRESSURE, 1e-6 / 133.322387415),
        ("45 %", NUMBER, 0.45),
        ("0.45", NUMBER, 0.45),
        ("-3", NUMBER, -3.0),
        (".5 m", LENGTH, 0.5),
        ("5. m", LENGTH, 5.0),
        ("+1E-2 m", LENGTH, 0.01),
    ];
    for &(text, dimension, value) in table {
        assert_eq!(parse_as(text, dimension), Ok(value), "{text}");
    }
}

#[test]
fn units_that_are_no_power_of_ten_agree_with_published_factors() {
    // Factors as tabulated by NIST SP 811, appendix B.8, to the digits given there.
    let table: &[(&str, Dimension, f64, f64)] = &[
        ("1 mmHg", PRESSURE, 133.3224, 5e-5),
        ("1 cmH2O", PRESSURE, 98.0665, 5e-5),
        ("1 atm", PRESSURE, 101_325.0, 1e-9),
        ("1 deg", ANGLE, 0.017_453_29, 5e-9),
        ("1 L/min", FLOW_RATE, 1.666_667e-5, 5e-12),
        ("80 ml/min", FLOW_RATE, 1.333_333e-6, 5e-13),
        ("1 mmHg s/ml", RESISTANCE, 1.333_224e8, 5e1),
        ("1 mmHg min/L", RESISTANCE, 7.999_343e6, 5e0),
        ("1 ml/mmHg", COMPLIANCE, 7.500_617e-9, 5e-15),
    ];
    for &(text, dimension, value, half_last_digit) in table {
        let found = parse_as(text, dimension).unwrap();
        assert!((found - value).abs() <= half_last_digit, "{text}: {found} against {value}");
    }
}

#[test]
fn faults_are_named_and_pointed_at() {
    let table: &[(&str, &str, &str)] = &[
        ("", "\"\" does not begin with a number", "\n^"),
        ("mm", "\"mm\" does not begin with a number", "mm\n^^"),
        ("nan m", "\"nan m\" does not begin with a number", "nan m\n^^^"),
        ("5", "\"5\" has no unit, but a pressure needs one", "5\n ^"),
        ("5 mmhg", "the unit \"mmhg\" is not known; did you mean \"mmHg\"?", "5 mmhg\n  ^^^^"),
        ("5 furlong", "the unit \"furlong\" is not known", "5 furlong\n  ^^^^^^^"),
        ("5 N/mm^", "the unit \"mm^\" cannot be read", "5 N/mm^\n    ^^^"),
        ("5 N/", "the unit \"\" cannot be read because a factor is missing", "5 N/\n    ^"),
        ("5 N/(m m", "the unit \"(m m\" cannot be read", "5 N/(m m\n    ^^^^"),
        ("5 N/(m (m m))", "the unit \"(\" cannot be read", "5 N/(m (m m))\n       ^"),
        ("5 N/m)", "the unit \")\" cannot be read", "5 N/m)\n     ^"),
        ("5 N/m m", "\"m\" after a `/` can be read in two ways", "5 N/m m\n      ^"),
        ("5 mPa s", "\"5 mPa s\" is a dynamic viscosity, not a pressure", "5 mPa s\n  ^^^^^"),
        ("5 m^400", "the unit \"m^400\" cannot be read", "5 m^400\n  ^^^^^"),
        ("5 m^100 m^100", "the unit \"m^100\" cannot be read", "5 m^100 m^100\n        ^^^^^"),
        ("1e400 Pa", "\"1e400 Pa\" is too large", "1e400 Pa\n^^^^^"),
        ("1e99999999999 Pa", "\"1e99999999999 Pa\" is too large", "1e99999999999 Pa\n^^^^^^^^^^^^^"),
    ];
    for &(text, message, caret) in table {
        let error = parse_as(text, PRESSURE).unwrap_err();
        assert_eq!(error.to_string(), message);
        assert_eq!(error.caret(text), caret);
    }
}

#[test]
fn a_missing_unit_carries_what_was_expected() {
    let error = parse_as("12", FLOW_RATE).unwrap_err();
    assert_eq!(error, UnitError::MissingUnit { text: "12".into(), expected: FLOW_RATE });
}

fn any_dimension() -> impl Strategy<Value = Dimension> {
    (-9i8..10, -9i8..10, -9i8..10, -9i8..10).prop_map(|(length, mass, time, angle)| Dimension {
        length,
        mass,
        time,
        angle,
    })
}

fn named_dimension() -> impl Strategy<Value = Dimension> {
    prop::sample::select(vec![
        NUMBER,
        ANGLE,
        LENGTH,
        VOLUME,
        TIME,
        FREQUENCY,
        DENSITY,
        VELOCITY,
        FORCE,
        PRESSURE,
        VISCOSITY,
        FLOW_RATE,
        RESISTANCE,
        COMPLIANCE,
        SUPPORT_STIFFNESS,
        SUPPORT_DAMPING,
    ])
}

proptest! {
    #[test]
    fn all_digits_come_back(value in prop::num::f64::NORMAL | prop::num::f64::ZERO, dimension in any_dimension()) {
        let quantity = Quantity { value, dimension };
        let back = parse(&quantity.to_string()).unwrap();
        prop_assert_eq!(back.value.to_bits(), value.to_bits());
        prop_assert_eq!(back.dimension, dimension);
    }

    #[test]
    fn pretty_text_reads_back_to_four_digits(
        mantissa in 1.0f64..10.0, power in -14i32..14, negative: bool, dimension in named_dimension(),
    ) {
        let value = mantissa * 10f64.powi(power) * if negative { -1.0 } else { 1.0 };
        let back = parse_as(&pretty(value, dimension), dimension).unwrap();
        prop_assert!((back - value).abs() <= 0.5001e-3 * value.abs(), "{} from {}", back, value);
    }

    #[test]
    fn a_prefix_is_a_shift_of_the_decimal_point(digits in 1u32..1_000_000) {
        let metres = format!("{digits}e-3 m");
        prop_assert_eq!(parse(&format!("{digits} mm")), parse(&metres));
    }

    #[test]
    fn a_number_is_the_number_times_its_unit(value in -1e6f64..1e6, dimension in named_dimension(), pick in 0usize..9) {
        let units = dimension.units();
        let unit = units[pick % units.len()];
        let (factor, found) = parse_unit(unit).unwrap();
        prop_assert_eq!(found, dimension);
        let read = parse_as(&format!("{value:?} {unit}"), dimension).unwrap();
        prop_assert!((read - value * factor).abs() <= 4.0 * f64::EPSILON * (value * factor).abs());
    }

    #[test]
    fn no_text_panics(text in "\\PC{0,24}") {
        if let Err(error) = parse_as(&text, PRESSURE) {
            let _ = error.caret(&text);
            prop_assert!(error.span().end <= text.len());
        }
    }

    #[test]
    fn no_text_of_unit_letters_panics(text in "[0-9emPas/^*() .²³·+-]{0,16}") {
        if let Err(error) = parse(&text) {
            prop_assert!(text.get(error.span()).is_some());
        }
    }
}

//! The units that can be written: prefix times symbol.

use crate::dimension::{
    ANGLE, Dimension, ENERGY, FORCE, FREQUENCY, KINEMATIC_VISCOSITY, LENGTH, MASS, NUMBER, PRESSURE, TIME,
    VISCOSITY, VOLUME,
};

/// A symbol: one of it is `factor * 10^decade` of the SI unit of its dimension.
///
/// Powers of ten are kept apart from the factor so that `"0.3 mm"` gives the same double as `3e-4`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Unit {
    pub(crate) symbol: &'static str,
    pub(crate) factor: f64,
    pub(crate) decade: i32,
    pub(crate) dimension: Dimension,
    prefixes: bool,
}

const fn metric(symbol: &'static str, decade: i32, dimension: Dimension) -> Unit {
    Unit { symbol, factor: 1.0, decade, dimension, prefixes: true }
}

const fn alone(symbol: &'static str, factor: f64, decade: i32, dimension: Dimension) -> Unit {
    Unit { symbol, factor, decade, dimension, prefixes: false }
}

/// Conventional millimetre of mercury: 13 595.1 kg/m^3 times 9.806 65 m/s^2 times 1 mm, in Pa.
const MILLIMETRE_OF_MERCURY: f64 = 133.322387415;
/// Conventional centimetre of water: 1000 kg/m^3 times 9.806 65 m/s^2 times 1 cm, in Pa.
const CENTIMETRE_OF_WATER: f64 = 98.0665;

const UNITS: &[Unit] = &[
    metric("m", 0, LENGTH),
    metric("g", -3, MASS),
    metric("s", 0, TIME),
    alone("min", 60.0, 0, TIME),
    alone("h", 3600.0, 0, TIME),
    metric("Hz", 0, FREQUENCY),
    metric("L", -3, VOLUME),
    metric("l", -3, VOLUME),
    metric("N", 0, FORCE),
    metric("dyn", -5, FORCE),
    metric("J", 0, ENERGY),
    metric("Pa", 0, PRESSURE),
    metric("bar", 5, PRESSURE),
    alone("mmHg", MILLIMETRE_OF_MERCURY, 0, PRESSURE),
    alone("cmH2O", CENTIMETRE_OF_WATER, 0, PRESSURE),
    alone("atm", 101_325.0, 0, PRESSURE),
    metric("P", -1, VISCOSITY),
    metric("St", -4, KINEMATIC_VISCOSITY),
    alone("rad", 1.0, 0, ANGLE),
    alone("deg", std::f64::consts::PI / 180.0, 0, ANGLE),
    alone("°", std::f64::consts::PI / 180.0, 0, ANGLE),
    alone("%", 1.0, -2, NUMBER),
];

const PREFIXES: &[(&str, i32)] = &[
    ("n", -9),
    ("u", -6),
    ("\u{b5}", -6),
    ("\u{3bc}", -6),
    ("m", -3),
    ("c", -2),
    ("d", -1),
    ("h", 2),
    ("k", 3),
    ("M", 6),
    ("G", 9),
];

/// The unit of a symbol with or without a prefix. A symbol of its own wins over a prefixed one (`min`, `Pa`).
pub(crate) fn look_up(text: &str) -> Option<Unit> {
    if let Some(unit) = UNITS.iter().find(|unit| unit.symbol == text) {
        return Some(*unit);
    }
    PREFIXES.iter().find_map(|(prefix, power)| {
        let symbol = text.strip_prefix(prefix)?;
        let unit = UNITS.iter().find(|unit| unit.prefixes && unit.symbol == symbol)?;
        Some(Unit { decade: unit.decade + power, ..*unit })
    })
}

/// The known symbol spelt most like `text`.
pub(crate) fn nearest_symbol(text: &str) -> Option<String> {
    let alone = UNITS.iter().map(|unit| unit.symbol.to_owned());
    let prefixed = UNITS.iter().filter(|unit| unit.prefixes).flat_map(|unit| {
        let ascii = PREFIXES.iter().filter(|(prefix, _)| prefix.is_ascii());
        ascii.map(|(prefix, _)| format!("{prefix}{}", unit.symbol))
    });
    let symbols: Vec<String> = alone.chain(prefixed).collect();
    nearest(text, symbols.iter().map(String::as_str)).map(str::to_owned)
}

/// The candidate with the smallest edit distance to `text`, if at most a third of the letters differ.
///
/// A difference in case counts less than a wrong letter; of equally near candidates the first is taken.
///
/// ```
/// assert_eq!(vaso_units::nearest("viscocity", ["density", "viscosity"]), Some("viscosity"));
/// assert_eq!(vaso_units::nearest("colour", ["density", "viscosity"]), None);
/// ```
pub fn nearest<'a>(text: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let written: Vec<char> = text.chars().collect();
    candidates
        .into_iter()
        .map(|candidate| (edit_distance(&written, &candidate.chars().collect::<Vec<_>>()), candidate))
        .filter(|(distance, candidate)| {
            let letters = written.len().max(candidate.chars().count());
            // Distances are in thirds of a letter; two letters are too few for a third to mean anything.
            *distance <= letters.max(3)
        })
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, candidate)| candidate)
}

/// Distance in thirds of a letter: an insertion, deletion or replacement and a swap of two neighbours cost 3 each, a
/// change of case 1 (optimal string alignment, Damerau 1964).
fn edit_distance(a: &[char], b: &[char]) -> usize {
    let width = b.len() + 1;
    let mut cost = vec![0; (a.len() + 1) * width];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            cost[i * width + j] = if i == 0 || j == 0 {
                3 * (i + j)
            } else {
                let (letter_a, letter_b) = (a[i - 1], b[j - 1]);
                let replace = match (letter_a == letter_b, letter_a.eq_ignore_ascii_case(&letter_b)) {
                    (true, _) => 0,
                    (false, true) => 1,
                    (false, false) => 3,
                };
                let swapped = i > 1 && j > 1 && letter_a == b[j - 2] && a[i - 2] == letter_b;
                let swap = if swapped { cost[(i - 2) * width + j - 2] + 3 } else { usize::MAX };
                let replaced = cost[(i - 1) * width + j - 1] + replace;
                replaced.min(cost[(i - 1) * width + j] + 3).min(cost[i * width + j - 1] + 3).min(swap)
            };
        }
    }
    cost[a.len() * width + b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_symbol_of_its_own_wins_over_a_prefixed_one() {
        assert_eq!(look_up("min").unwrap().dimension, TIME);
        assert_eq!(look_up("Pa").unwrap().dimension, PRESSURE);
        assert_eq!(look_up("hPa").unwrap().decade, 2);
        assert!(look_up("mmin").is_none());
        assert!(look_up("kmmHg").is_none());
    }

    #[test]
    fn edit_distance_counts_letters_and_case() {
        let distance =
            |a: &str, b: &str| edit_distance(&a.chars().collect::<Vec<_>>(), &b.chars().collect::<Vec<_>>());
        assert_eq!(distance("kitten", "sitting"), 9);
        assert_eq!(distance("mmhg", "mmHg"), 1);
        assert_eq!(distance("", "ab"), 6);
        assert_eq!(distance("valeu", "value"), 3);
    }

    #[test]
    fn misspelt_symbols_find_the_right_one() {
        assert_eq!(nearest_symbol("mmhg").as_deref(), Some("mmHg"));
        assert_eq!(nearest_symbol("kpa").as_deref(), Some("kPa"));
        assert_eq!(nearest_symbol("cmh2o").as_deref(), Some("cmH2O"));
        assert_eq!(nearest_symbol("furlong"), None);
    }
}

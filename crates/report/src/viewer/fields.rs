//! What can colour a body: names for people, units, and the range of colours.

use crate::scale::{number, ticks};
use serde::Serialize;
use vaso_io::schema;

/// A field of a series as people know it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Known {
    /// Name in the series.
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// What stands beside the colour bar.
    pub(super) short: &'static str,
    pub(super) scale: Scale,
    /// Part of the values below the upper end of the colours.
    upper: f64,
    /// True for what is of a whole cycle, not of an instant.
    pub(super) of_cycle: bool,
}

/// Units that values are told in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// Pressure from pascals, told in kilopascals where there are many; low values count.
    Pressure,
    /// Stress from pascals, the same from zero.
    Stress,
    /// Length from metres in millimetres.
    Length,
    /// As it is, in the unit given.
    Plain(&'static str),
}

/// Pascals above which kilopascals are told.
const MANY_PASCALS: f64 = 2000.0;

impl Scale {
    /// Factor from SI and the unit, for values up to `largest` in SI.
    fn unit(self, largest: f64) -> (f64, &'static str) {
        match self {
            Self::Pressure | Self::Stress if largest > MANY_PASCALS => (1e-3, "kPa"),
            Self::Pressure | Self::Stress => (1.0, "Pa"),
            Self::Length => (1e3, "mm"),
            Self::Plain(unit) => (1.0, unit),
        }
    }
}

/// Most values lie below the upper end of the colours; of ratios with long tails a little more are left out.
const MOST: f64 = 0.99;
const TAILED: f64 = 0.95;

const fn known(name: &'static str, title: &'static str, short: &'static str, scale: Scale) -> Known {
    Known { name, title, short, scale, upper: MOST, of_cycle: false }
}

const fn index(name: &'static str, title: &'static str, unit: &'static str, upper: f64) -> Known {
    Known { name, title, short: name, scale: Scale::Plain(unit), upper, of_cycle: true }
}

/// Pressure of the blood, also where it is read off at the wall.
pub(super) const PRESSURE: Known = known(schema::PRESSURE, "Pressure", "pressure", Scale::Pressure);

/// Fields of a wall, in the order of the menu.
pub(super) const OF_WALL: [Known; 14] = [
    known(schema::WSS, "Wall shear stress", schema::WSS, Scale::Plain("Pa")),
    index(schema::TAWSS, "Time-averaged wall shear stress", "Pa", MOST),
    index(schema::OSI, "Oscillatory shear index", "", MOST),
    index(schema::RRT, "Relative residence time", "1/Pa", TAILED),
    index(schema::ECAP, "Endothelial cell activation potential", "1/Pa", TAILED),
    index(schema::TRANSVERSE_WSS, "Transverse wall shear stress", "Pa", MOST),
    index(schema::PEAK_WSS, "Peak wall shear stress", "Pa", MOST),
    PRESSURE,
    known(schema::DISPLACEMENT, "Displacement", "displacement", Scale::Length),
    known(schema::VON_MISES, "Von Mises stress", "von Mises", Scale::Stress),
    known(schema::VON_MISES_INNER, "Von Mises stress, inner face", "von Mises", Scale::Stress),
    known(schema::VON_MISES_OUTER, "Von Mises stress, outer face", "von Mises", Scale::Stress),
    known(schema::THICKNESS, "Wall thickness", "thickness", Scale::Length),
    known(schema::VELOCITY, "Speed of the wall", "speed", Scale::Plain("m/s")),
];

/// Fields of the blood.
pub(super) const OF_BLOOD: [Known; 2] =
    [known(schema::VELOCITY, "Speed", "speed", Scale::Plain("m/s")), PRESSURE];

/// A tick of the colour bar.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) text: String,
}

/// Colours of a field over all its frames.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Colors {
    /// From SI to the unit told.
    pub(super) factor: f64,
    pub(super) unit: &'static str,
    pub(super) ticks: Vec<Tick>,
}

/// Unit and range for values in SI; those not finite count for nothing.
pub(super) fn colors(field: &Known, values: impl Iterator<Item = f64>) -> Colors {
    let mut sorted: Vec<f64> = values.filter(|x| x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let at = |part: f64| sorted.get((sorted.len().max(1) - 1).min((sorted.len() as f64 * part) as usize));
    let at = |part: f64| at(part).copied().unwrap_or(0.0);
    let largest = at(1.0).abs().max(at(0.0).abs());
    let (factor, unit) = field.scale.unit(largest);
    let low = match field.scale {
        Scale::Pressure => at(1.0 - MOST),
        // Thickness is told from where it begins: all of a wall is about as thick.
        Scale::Length if field.name == schema::THICKNESS => at(1.0 - MOST),
        _ => 0.0,
    };
    let ticks = ticks(factor * low, factor * at(field.upper), 5);
    let tick = |&value: &f64| Tick { value, text: number(value, 4) };
    Colors { factor, unit, ticks: ticks.iter().map(tick).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pressures_get_the_unit_that_keeps_them_short_and_stresses_begin_at_zero() {
        let low = colors(&PRESSURE, [10.0, 20.0, f64::NAN].into_iter());
        assert_eq!((low.factor, low.unit), (1.0, "Pa"));
        assert_eq!(low.ticks[0].text, "10");
        let high = colors(&PRESSURE, (0..1000).map(|k| 10_000.0 + 3.0 * f64::from(k)));
        assert_eq!((high.unit, high.ticks[0].text.as_str()), ("kPa", "10"));
        let shear = colors(&OF_WALL[0], (0..1000).map(|k| if k == 7 { 1e6 } else { 1.0 }));
        assert_eq!((shear.unit, shear.ticks[0].value), ("Pa", 0.0));
        assert!(shear.ticks.last().unwrap().value < 2.0, "one outlier takes all colours: {shear:?}");
    }

    #[test]
    fn without_values_there_is_still_a_range() {
        let none = colors(&OF_WALL[1], [f64::NAN].into_iter());
        assert!(none.ticks.len() >= 2 && none.ticks.iter().all(|tick| tick.value.is_finite()));
    }
}

//! Numbers as 16 bits: the browser and the graphics card take them as they are.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;

/// Steps between the lowest and the highest code; no rounding is larger than half a step.
pub(super) const STEPS: f64 = 65_534.0;
/// Stands for no value.
pub(super) const MISSING: u16 = u16::MAX;

/// The range that codes span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Span {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Span {
    /// From the lowest to the highest of the values that are finite; `None` without any.
    pub(super) fn of(values: impl Iterator<Item = f64>) -> Option<Self> {
        let (low, high) = values
            .filter(|x| x.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        (low <= high).then_some(Self { low, high })
    }

    /// Value of one step of the codes; 0 where all values are the same.
    pub(super) fn step(&self) -> f64 {
        // Halves, so that the width of the widest range of doubles is still finite.
        2.0 * (0.5 * self.high - 0.5 * self.low) / STEPS
    }

    /// Code of a value; those outside are clamped, those not finite are [`MISSING`].
    pub(super) fn code(&self, value: f64) -> u16 {
        let step = self.step();
        if !value.is_finite() {
            MISSING
        } else if step > 0.0 {
            ((value - self.low) / step).round().clamp(0.0, STEPS) as u16
        } else {
            0
        }
    }
}

/// The box of positions, one span an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bounds(pub(super) [Span; 3]);

impl Bounds {
    /// Of the positions that are finite; `None` without any.
    pub(super) fn of<'a>(position: impl Iterator<Item = &'a DVec3> + Clone) -> Option<Self> {
        let axis = |k: usize| Span::of(position.clone().filter(|x| x.is_finite()).map(|x| x[k]));
        Some(Self([axis(0)?, axis(1)?, axis(2)?]))
    }

    /// Codes of positions, three a point.
    pub(super) fn codes(&self, position: &[DVec3]) -> Vec<u16> {
        position.iter().flat_map(|x| [0, 1, 2].map(|k| self.0[k].code(x[k]))).collect()
    }
}

/// All codes of a page, one after the other.
#[derive(Debug, Default)]
pub(super) struct Payload {
    codes: Vec<u16>,
}

impl Payload {
    /// Appends codes and returns where they begin, counted in codes.
    pub(super) fn push(&mut self, codes: &[u16]) -> usize {
        let at = self.codes.len();
        self.codes.extend_from_slice(codes);
        at
    }

    /// Little-endian bytes as base64.
    pub(super) fn base64(&self) -> String {
        let bytes: Vec<u8> = self.codes.iter().flat_map(|code| code.to_le_bytes()).collect();
        STANDARD.encode(bytes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_comes_back_within_half_a_step() {
        for (low, high) in [(-3.0, 7.0), (0.0, 1e-9), (11_000.0, 11_001.0), (-1e300, 1e300)] {
            let span = Span { low, high };
            for k in 0..=1000 {
                let value = low + (high / 1000.0 - low / 1000.0) * f64::from(k);
                let code = span.code(value);
                assert_ne!(code, MISSING);
                let back = low + span.step() * f64::from(code);
                let rounding = 4.0 * f64::EPSILON * low.abs().max(high.abs());
                assert!(
                    (back - value).abs() <= 0.5 * span.step() * (1.0 + 1e-9) + rounding,
                    "{value}: {back}"
                );
            }
        }
    }

    #[test]
    fn what_is_no_number_is_missing_and_the_ends_are_kept() {
        let values = [f64::NAN, 2.0, f64::INFINITY, -1.0, f64::NEG_INFINITY];
        let span = Span::of(values.into_iter()).unwrap();
        assert_eq!(span, Span { low: -1.0, high: 2.0 });
        assert_eq!(values.map(|x| span.code(x)), [MISSING, 65_534, MISSING, 0, MISSING]);
        assert_eq!(span.code(1e9), 65_534);
        assert_eq!(Span::of([f64::NAN].into_iter()), None);
        assert_eq!(Span::of(std::iter::empty()), None);
        let flat = Span::of([5.0, 5.0].into_iter()).unwrap();
        assert_eq!((flat.code(5.0), flat.step()), (0, 0.0));
    }

    #[test]
    fn positions_are_coded_in_their_box() {
        let position = [DVec3::new(0.0, 1.0, 5.0), DVec3::new(2.0, 3.0, 5.0), DVec3::NAN];
        let bounds = Bounds::of(position.iter()).unwrap();
        assert_eq!(bounds.codes(&position[..2]), [0, 0, 0, 65_534, 65_534, 0]);
        assert_eq!(Bounds::of([DVec3::NAN].iter()), None);
    }

    #[test]
    fn codes_travel_as_little_endian_bytes() {
        let mut payload = Payload::default();
        assert_eq!(payload.push(&[1]), 0);
        assert_eq!(payload.push(&[0x0203, MISSING]), 1);
        assert_eq!(STANDARD.decode(payload.base64()).unwrap(), [1, 0, 3, 2, 255, 255]);
    }
}

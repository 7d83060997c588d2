//! Random numbers that depend on seed and index only, never on the order of evaluation.

use glam::DVec3;

/// SplitMix64 output function (Steele, Lea, Flood 2014) of the `index`-th state after `seed`.
fn splitmix64(seed: u64, index: u64) -> u64 {
    let mut z = seed.wrapping_add(index.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

/// Vector with components uniform in [-1, 1), the `index`-th of the sequence of `seed`.
pub(crate) fn unit_box(seed: u64, index: usize) -> DVec3 {
    let component = |k: u64| {
        let bits = splitmix64(seed, 3 * index as u64 + k) >> 11;
        bits as f64 / (1_u64 << 52) as f64 - 1.0
    };
    DVec3::new(component(0), component(1), component(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// First outputs for seed 1234567 of the published reference program.
    #[test]
    fn matches_the_reference_sequence() {
        let expected = [6457827717110365317, 3203168211198807973, 9817491932198370423];
        for (k, e) in expected.into_iter().enumerate() {
            assert_eq!(splitmix64(1_234_567, k as u64), e);
        }
    }

    #[test]
    fn components_fill_the_box_evenly() {
        let n = 20_000;
        let sum: DVec3 = (0..n).map(|i| unit_box(3, i)).sum();
        let square: DVec3 = (0..n).map(|i| unit_box(3, i) * unit_box(3, i)).sum();
        // Standard error of the mean is 0.004.
        assert!((sum / n as f64).abs().max_element() < 0.02);
        assert!((square / n as f64 - 1.0 / 3.0).abs().max_element() < 0.01);
    }
}

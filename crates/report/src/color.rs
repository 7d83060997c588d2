//! The colour map: viridis, of even steps to the eye and readable without colour.

/// Viridis (S. van der Walt and N. Smith for matplotlib, 2015, CC0), every eighth of its 256 colours as sRGB.
/// Between them linear interpolation is off by less than 2 of 255.
pub(crate) const VIRIDIS: [[u8; 3]; 33] = [
    [68, 1, 84],
    [71, 13, 96],
    [72, 24, 106],
    [72, 35, 116],
    [71, 45, 123],
    [69, 54, 129],
    [66, 64, 134],
    [63, 73, 137],
    [59, 82, 139],
    [55, 90, 141],
    [51, 99, 141],
    [47, 106, 142],
    [44, 114, 142],
    [41, 122, 142],
    [38, 129, 142],
    [35, 137, 142],
    [33, 144, 140],
    [31, 152, 139],
    [31, 159, 136],
    [33, 166, 133],
    [40, 174, 128],
    [49, 181, 123],
    [62, 188, 116],
    [76, 194, 108],
    [93, 201, 99],
    [110, 206, 88],
    [130, 211, 76],
    [150, 216, 63],
    [171, 220, 50],
    [192, 223, 36],
    [213, 226, 26],
    [234, 229, 26],
    [253, 231, 37],
];

/// Colour of a value between 0 and 1 as sRGB from 0 to 255; values outside are clamped, NaN is grey.
pub(crate) fn viridis(value: f64) -> [f64; 3] {
    if value.is_nan() {
        return [128.0; 3];
    }
    let place = value.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let low = (place as usize).min(VIRIDIS.len() - 2);
    let part = place - low as f64;
    std::array::from_fn(|c| {
        let (a, b) = (f64::from(VIRIDIS[low][c]), f64::from(VIRIDIS[low + 1][c]));
        a + part * (b - a)
    })
}

/// The map as a CSS gradient, from the low end at the bottom to the high end at the top.
pub(crate) fn css_gradient() -> String {
    let stops: Vec<String> =
        VIRIDIS.iter().step_by(4).map(|[r, g, b]| format!("#{r:02x}{g:02x}{b:02x}")).collect();
    format!("linear-gradient(to top, {})", stops.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_middle_and_outside() {
        assert_eq!(viridis(0.0), [68.0, 1.0, 84.0]);
        assert_eq!(viridis(1.0), [253.0, 231.0, 37.0]);
        assert_eq!(viridis(-5.0), viridis(0.0));
        assert_eq!(viridis(f64::INFINITY), viridis(1.0));
        assert_eq!(viridis(f64::NAN), [128.0; 3]);
        // Published middle entry (index 128 of 256): #21908C.
        let middle = viridis(128.0 / 255.0);
        for (found, published) in middle.iter().zip([33.0, 144.0, 140.0]) {
            assert!((found - published).abs() < 2.0, "{middle:?}");
        }
    }

    /// Brightness must rise all the way, or the map lies about order to a reader who sees no colour.
    #[test]
    fn luminance_rises() {
        let luminance = |value: f64| {
            let linear = viridis(value).map(|c| ((c / 255.0 + 0.055) / 1.055).powf(2.4));
            0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        };
        let steps: Vec<f64> = (0..=100).map(|k| luminance(f64::from(k) / 100.0)).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
    }
}

//! Round numbers: ranges and ticks for axes and colour bars, and numbers as people write them.

/// Ticks of 1, 2 or 5 times a power of ten that cover `low..=high`; about `wanted` of them.
///
/// A range without extent or without finite ends gives ticks around it.
pub(crate) fn ticks(low: f64, high: f64, wanted: usize) -> Vec<f64> {
    let (low, high) = widen(low, high);
    let rough = (high - low) / wanted.max(1) as f64;
    let power = 10f64.powf(rough.log10().floor());
    let step =
        [1.0, 2.0, 5.0, 10.0].map(|f| f * power).into_iter().find(|&s| s >= 0.999 * rough).unwrap_or(rough);
    let first = (low / step).floor() as i64;
    let last = (high / step).ceil() as i64;
    // Multiples of the step, each from its own integer, so that 0.3 prints as 0.3.
    (first..=last).map(|k| k as f64 * step).collect()
}

fn widen(low: f64, high: f64) -> (f64, f64) {
    if !low.is_finite() || !high.is_finite() {
        return (0.0, 1.0);
    }
    let size = low.abs().max(high.abs());
    if high - low > 1e-9 * size {
        (low, high)
    } else {
        (low - 0.5 * size.max(1e-12), high + 0.5 * size.max(1e-12))
    }
}

/// A number with `digits` significant digits, without needless zeros; a power of ten where it is clearer.
pub(crate) fn number(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return "–".to_owned();
    }
    let exponent = value.abs().log10().floor() as i32;
    let text = if (-3..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        let mantissa = number(value / 10f64.powi(exponent), digits);
        format!("{mantissa} × 10{}", superscript(exponent))
    };
    text.replace('-', "−")
}

/// A whole number in groups of three digits, parted by narrow spaces.
pub(crate) fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// Seconds as a person says them.
pub(crate) fn duration(seconds: f64) -> String {
    if !seconds.is_finite() {
        return "–".to_owned();
    }
    let whole = seconds.max(0.0).round() as u64;
    match whole {
        0..120 => format!("{} s", number(seconds, 3)),
        120..7200 => format!("{} min {:02} s", whole / 60, whole % 60),
        _ => format!("{} h {:02} min", whole / 3600, whole / 60 % 60),
    }
}

/// Bytes in the unit that keeps the number short.
pub(crate) fn bytes(value: u64) -> String {
    let size = value as f64;
    match value {
        0..1_000 => format!("{value} B"),
        1_000..1_000_000 => format!("{} kB", number(size / 1e3, 3)),
        1_000_000..1_000_000_000 => format!("{} MB", number(size / 1e6, 3)),
        _ => format!("{} GB", number(size / 1e9, 3)),
    }
}

fn superscript(exponent: i32) -> String {
    exponent
        .to_string()
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            digit => char::from_u32('⁰' as u32 + digit as u32 - '0' as u32).unwrap_or(digit),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_cover_the_range() {
        assert_eq!(ticks(0.0, 1.0, 5), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(ticks(-6.1, 3.2, 4), [-10.0, -5.0, 0.0, 5.0]);
        for (low, high) in
            [(0.0, 1e-9), (-3e5, 7e5), (11_999.0, 12_001.0), (5.0, 5.0), (0.0, 0.0), (f64::NAN, 1.0)]
        {
            let ticks = ticks(low, high, 5);
            assert!((2..=12).contains(&ticks.len()), "{low} {high}: {ticks:?}");
            let covers = |x: f64| x.is_nan() || (ticks[0] <= x && x <= ticks[ticks.len() - 1]);
            assert!(covers(low) && covers(high), "{low} {high}: {ticks:?}");
        }
    }

    #[test]
    fn numbers_read_well() {
        let cases = [
            (0.0, "0"),
            (0.6000000000000001, "0.6"),
            (-6.1e-6, "−6.1 × 10⁻⁶"),
            (12_000.0, "12000"),
            (93.24, "93.2"),
            (9.1e6, "9.1 × 10⁶"),
            (1.0, "1"),
            (999.96, "1000"),
            (0.00123, "0.00123"),
            (f64::NAN, "–"),
        ];
        for (value, text) in cases {
            assert_eq!(number(value, 3), text);
        }
        assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(count(12), "12");
        assert_eq!(duration(93.2), "93.2 s");
        assert_eq!(duration(754.0), "12 min 34 s");
        assert_eq!(duration(7384.0), "2 h 03 min");
        assert_eq!(bytes(5_242_880), "5.24 MB");
    }
}

//! Histograms one above the other on one axis, as inline SVG that follows the page's colours.

use crate::html::escape;
use crate::scale::{number, ticks};
use vaso_io::Histogram;

const WIDTH: f64 = 760.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 12.0;
/// Height of a histogram with the line above it, and of the axis below the last.
const PANEL: f64 = 96.0;
const HEAD: f64 = 22.0;
const BOTTOM: f64 = 40.0;
/// Colours of the style sheet, `--c0` to `--c6`.
const COLORS: usize = 7;

/// Histograms of the same bins under each other. `axis` names the quantity with its unit.
pub(crate) fn histograms(title: &str, axis: &str, rows: &[(&str, &Histogram)]) -> String {
    let Some((_, first)) = rows.first() else { return String::new() };
    let (low, high) = (first.low, first.low + first.width * first.counts.len() as f64);
    let x = |value: f64| LEFT + (WIDTH - LEFT - RIGHT) * (value - low) / (high - low);
    let height = PANEL * rows.len() as f64 + BOTTOM;
    let names: Vec<&str> = rows.iter().map(|(name, _)| *name).collect();
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" aria-label=\"{}\">",
        escape(&format!("{title} of {}", names.join(", ")))
    );
    for (k, (name, histogram)) in rows.iter().enumerate() {
        let floor = PANEL * (k + 1) as f64;
        let total = histogram.counts.iter().sum::<u64>().max(1) as f64;
        let most = histogram.counts.iter().copied().max().unwrap_or(0).max(1) as f64;
        svg += &format!(
            "<g class=\"grid\"><line x1=\"{LEFT}\" x2=\"{:.1}\" y1=\"{floor:.1}\" y2=\"{floor:.1}\"/></g>\
             <path class=\"bars\" style=\"fill:var(--c{})\" d=\"{}\"><title>{}</title></path>\
             <g class=\"axis\"><text x=\"{LEFT}\" y=\"{:.1}\">{}</text>\
             <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{} %</text></g>",
            WIDTH - RIGHT,
            k % COLORS,
            bars(histogram, most, floor, &x),
            escape(name),
            floor - PANEL + 14.0,
            escape(name),
            LEFT - 8.0,
            floor - PANEL + HEAD + 10.0,
            number(100.0 * most / total, 3)
        );
    }
    svg += "<g class=\"axis\">";
    let floor = PANEL * rows.len() as f64;
    for tick in ticks(low, high, 8).into_iter().filter(|t| (low - 1e-9..=high + 1e-9).contains(t)) {
        svg += &format!(
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{floor:.1}\" y2=\"{:.1}\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            floor + 5.0,
            floor + 19.0,
            number(tick, 3),
            x = x(tick)
        );
    }
    svg += &format!(
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text></g></svg>",
        0.5 * (LEFT + WIDTH - RIGHT),
        height - 4.0,
        escape(axis)
    );
    format!(
        "<figure class=\"chart\"><figcaption><b>{}</b> <small>share of the particles a bin, each to its own height; the ends \
         also count what lies beyond</small></figcaption>{svg}</figure>\n",
        escape(title)
    )
}

/// Outline of the bars, those without height left out.
fn bars(histogram: &Histogram, most: f64, floor: f64, x: &impl Fn(f64) -> f64) -> String {
    let mut path = String::new();
    for (k, &count) in histogram.counts.iter().enumerate().filter(|(_, count)| **count > 0) {
        let left = histogram.low + k as f64 * histogram.width;
        let top = floor - (PANEL - HEAD) * count as f64 / most;
        path += &format!("M{:.1} {floor:.1}V{top:.1}H{:.1}V{floor:.1}Z", x(left), x(left + histogram.width));
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_stand_where_their_bins_are() {
        let histogram = Histogram { low: 0.0, width: 0.5, counts: vec![1, 0, 3, 0] };
        let html = histograms("Distances", "spacings", &[("a<b", &histogram)]);
        // The axis is 684 pixels long: a bin 171, the third one the highest, the first a third of it.
        assert!(html.contains("M64.0 96.0V71.3H235.0V96.0ZM406.0 96.0V22.0H577.0V96.0Z"), "{html}");
        assert!(html.contains("a&lt;b") && html.contains("75 %"), "{html}");
        assert_eq!(histograms("Distances", "spacings", &[]), "");
    }
}

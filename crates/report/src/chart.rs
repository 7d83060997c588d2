//! Curves against time as inline SVG that follows the page's light or dark colours.

use crate::html::escape;
use crate::scale::{number, ticks};

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 260.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 12.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 40.0;
/// Horizontal buckets a curve is thinned to; each keeps its lowest and highest point.
const BUCKETS: usize = 500;
/// Ticks wanted on the time axis.
const TIME_TICKS: usize = 8;
/// Colours of the style sheet, `--c0` to `--c6`; dashes tell the curves apart beyond that and without colour.
const COLORS: usize = 7;
const DASHES: [&str; 3] = ["", " stroke-dasharray=\"7 4\"", " stroke-dasharray=\"2 3\""];

/// A named curve; points where the value is NaN are gaps.
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) points: Vec<(f64, f64)>,
}

/// A chart with axes, grid and legend. `label` names the quantity with its unit.
pub(crate) fn chart(title: &str, label: &str, curves: &[Curve]) -> String {
    let all =
        || curves.iter().flat_map(|curve| &curve.points).filter(|(t, y)| t.is_finite() && y.is_finite());
    if all().next().is_none() {
        return String::new();
    }
    let extent = |pick: fn(&(f64, f64)) -> f64| {
        all().map(pick).fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    };
    let (start, end) = time_range(extent(|p| p.0));
    let (low, high) = extent(|p| p.1);
    let y_ticks = ticks(low, high, 5);
    let (low, high) = (y_ticks[0], y_ticks[y_ticks.len() - 1]);
    let x = |t: f64| LEFT + (WIDTH - LEFT - RIGHT) * (t - start) / (end - start);
    let y = |v: f64| HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (v - low) / (high - low);

    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" data-time=\"{start} {end} {LEFT} {} {TOP} {}\" aria-label=\"{}\"><g class=\"grid\">",
        WIDTH - RIGHT,
        HEIGHT - BOTTOM,
        escape(&format!("{title}: {}", described(curves)))
    );
    for &tick in &y_ticks {
        let class = if tick == 0.0 { " class=\"zero\"" } else { "" };
        svg += &format!(
            "<line{class} x1=\"{LEFT}\" x2=\"{:.1}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>",
            WIDTH - RIGHT,
            y = y(tick)
        );
    }
    svg += "</g><g class=\"axis\">";
    for &tick in &y_ticks {
        svg += &format!(
            "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
            LEFT - 8.0,
            y(tick) + 4.0,
            number(tick, 4)
        );
    }
    for tick in ticks(start, end, TIME_TICKS).into_iter().filter(|&t| start <= t && t <= end) {
        svg += &format!(
            "<line x1=\"{x:.1}\" x2=\"{x:.1}\" y1=\"{:.1}\" y2=\"{:.1}\"/>\
             <text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}</text>",
            HEIGHT - BOTTOM,
            HEIGHT - BOTTOM + 5.0,
            HEIGHT - BOTTOM + 19.0,
            number(tick, 4),
            x = x(tick)
        );
    }
    svg += &format!(
        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">time [s]</text></g>",
        0.5 * (LEFT + WIDTH - RIGHT),
        HEIGHT - 4.0
    );
    for (k, curve) in curves.iter().enumerate() {
        let dash = DASHES[(k / COLORS) % DASHES.len()];
        svg += &format!(
            "<path class=\"curve\" style=\"stroke:var(--c{})\"{dash} d=\"{}\"><title>{}</title></path>",
            k % COLORS,
            path(&thinned(&curve.points, start, end), x, y),
            escape(&curve.name)
        );
    }
    svg += "</svg>";
    let legend: String = curves
        .iter()
        .enumerate()
        .map(|(k, curve)| {
            let dash = DASHES[(k / COLORS) % DASHES.len()];
            format!(
                "<li><svg viewBox=\"0 0 24 8\" aria-hidden=\"true\"><path class=\"curve\" style=\"stroke:var(--c{})\"{dash} \
                 d=\"M1 4H23\"/></svg>{}</li>",
                k % COLORS,
                escape(&curve.name)
            )
        })
        .collect();
    format!(
        "<figure class=\"chart\"><figcaption><b>{}</b> <small>{}</small></figcaption>\
         <ul class=\"legend\">{legend}</ul>{svg}</figure>\n",
        escape(title),
        escape(label)
    )
}

/// The range of time shown: from zero where the curves start near it, and on to a round number that is near.
fn time_range((start, end): (f64, f64)) -> (f64, f64) {
    let end = if end > start { end } else { start + 1.0 };
    let near = 0.03 * (end - start);
    let start = if (0.0..near).contains(&start) { 0.0 } else { start };
    let round = ticks(start, end, TIME_TICKS).last().copied().filter(|&tick| tick <= end + near);
    (start, round.unwrap_or(end).max(end))
}

/// The curves in words, for a reader who does not see them.
fn described(curves: &[Curve]) -> String {
    let parts: Vec<String> = curves
        .iter()
        .map(|curve| {
            let values = curve.points.iter().map(|p| p.1).filter(|y| y.is_finite());
            let (low, high) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), y| (a.min(y), b.max(y)));
            format!("{} from {} to {}", curve.name, number(low, 3), number(high, 3))
        })
        .collect();
    parts.join("; ")
}

/// Keeps the lowest and the highest point of each bucket, in order of time, so that no peak is lost.
fn thinned(points: &[(f64, f64)], start: f64, end: f64) -> Vec<(f64, f64)> {
    if points.len() <= 2 * BUCKETS {
        return points.to_vec();
    }
    let bucket = |t: f64| (((t - start) / (end - start) * BUCKETS as f64) as usize).min(BUCKETS - 1);
    points
        .chunk_by(|a, b| bucket(a.0) == bucket(b.0) && a.1.is_nan() == b.1.is_nan())
        .flat_map(|group| {
            let by_value = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
            let mut kept: Vec<(f64, f64)> = group
                .iter()
                .min_by(by_value)
                .into_iter()
                .chain(group.iter().max_by(by_value))
                .copied()
                .collect();
            kept.sort_by(|a, b| a.0.total_cmp(&b.0));
            kept.dedup();
            kept
        })
        .collect()
}

fn path(points: &[(f64, f64)], x: impl Fn(f64) -> f64, y: impl Fn(f64) -> f64) -> String {
    let mut text = String::new();
    let mut pen_down = false;
    for &(t, v) in points {
        if !v.is_finite() {
            pen_down = false;
            continue;
        }
        text += &format!("{}{:.1} {:.1}", if pen_down { "L" } else { "M" }, x(t), y(v));
        pen_down = true;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_every_peak_and_the_order() {
        let mut points: Vec<(f64, f64)> = (0..20_000).map(|k| (f64::from(k), f64::from(k % 3))).collect();
        points[7777].1 = 99.0;
        points[15_000].1 = -50.0;
        let kept = thinned(&points, 0.0, 19_999.0);
        assert!(kept.len() <= 2 * BUCKETS);
        assert!(kept.contains(&(7777.0, 99.0)) && kept.contains(&(15_000.0, -50.0)));
        assert!(kept.windows(2).all(|pair| pair[0].0 < pair[1].0));
    }

    #[test]
    fn the_time_axis_ends_on_round_numbers_that_are_near() {
        assert_eq!(time_range((0.0027, 0.4998)), (0.0, 0.5));
        assert_eq!(time_range((0.0, 0.46)), (0.0, 0.46));
        assert_eq!(time_range((2.0, 3.0)), (2.0, 3.0));
        assert_eq!(time_range((1.0, 1.0)), (1.0, 2.0));
    }

    #[test]
    fn gaps_lift_the_pen_and_nothing_gives_nothing() {
        let points = [(0.0, 1.0), (1.0, f64::NAN), (2.0, 3.0), (3.0, 4.0)];
        assert_eq!(path(&points, |t| t, |v| v), "M0.0 1.0M2.0 3.0L3.0 4.0");
        let nan = Curve { name: "a".into(), points: vec![(0.0, f64::NAN)] };
        assert_eq!(chart("Flow", "ml/s", &[nan]), "");
        let one = Curve { name: "a<b".into(), points: vec![(0.0, 1.0)] };
        let html = chart("Flow", "ml/s", &[one]);
        assert!(html.contains("a&lt;b") && !html.contains("NaN") && !html.contains("inf"), "{html}");
    }
}

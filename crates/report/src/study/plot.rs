//! Error against time on logarithmic axes.

use crate::html::escape;
use crate::scale::{duration, number};
use std::fmt::Write;
use vaso_io::{StudyReport, StudyRun, StudyStatus};

const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 430.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 170.0;
const TOP: f64 = 34.0;
const BOTTOM: f64 = 48.0;
/// Errors whose lines are drawn \[-\].
const LINES: [f64; 3] = [0.05, 0.02, 0.01];
/// Colours that are told apart with most kinds of colour vision (Okabe, Ito 2008); a file of its own has no style sheet.
const COLORS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#707070"];
const INK: &str = "#333333";
const GRID: &str = "#dddddd";

/// An axis of powers of ten.
struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
}

impl Axis {
    /// Around values, with a little room; a decade around one where there are none.
    fn around(values: impl Iterator<Item = f64>, from: f64, to: f64) -> Self {
        let (low, high) = values
            .filter(|v| v.is_finite() && *v > 0.0)
            .fold((f64::INFINITY, 0.0f64), |(a, b), v| (a.min(v), b.max(v)));
        let (low, high) = if low <= high { (low, high) } else { (1.0, 1.0) };
        Self { low: (low / 1.6).log10(), high: (high * 1.6).log10(), from, to }
    }

    fn at(&self, value: f64) -> f64 {
        self.from + (self.to - self.from) * (value.log10() - self.low) / (self.high - self.low)
    }

    fn holds(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value.log10())
    }

    /// Values to label: 1, 2 and 5 times powers of ten, or the powers alone over many decades.
    fn ticks(&self) -> Vec<f64> {
        let factors: &[f64] = if self.high - self.low < 2.5 { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let decades = self.low.floor() as i32..=self.high.ceil() as i32;
        let all = decades.flat_map(|d| factors.iter().map(move |f| f * 10f64.powi(d)));
        all.filter(|v| self.holds(*v)).collect()
    }
}

/// Ladders in order of appearance.
fn ladders(report: &StudyReport) -> Vec<&str> {
    let mut ladders: Vec<&str> = Vec::new();
    for run in &report.runs {
        if !ladders.contains(&run.ladder.as_str()) {
            ladders.push(&run.ladder);
        }
    }
    ladders
}

pub(super) fn work_precision(report: &StudyReport) -> String {
    let error = |run: &StudyRun| run.error(&report.judged_by);
    let shown: Vec<&StudyRun> = report
        .runs
        .iter()
        .filter(|run| run.status == StudyStatus::Completed && error(run).is_finite() && error(run) > 0.0)
        .collect();
    let x = Axis::around(shown.iter().map(|run| run.wall_clock_s), LEFT, WIDTH - RIGHT);
    let y = Axis::around(shown.iter().map(|run| error(run)), HEIGHT - BOTTOM, TOP);
    let what = if report.judged_by.is_empty() { "error" } else { &report.judged_by };
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"{INK}\"><rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"white\"/>\n",
        escape(&format!("Error {what} against wall time of {} runs", shown.len()))
    );
    grid(&mut svg, &x, &y, what);
    front(&mut svg, report, &shown, &x, &y);
    lines(&mut svg, report, &x, &y);
    let ladders = ladders(report);
    for (k, ladder) in ladders.iter().enumerate() {
        let color = COLORS[k % COLORS.len()];
        let mut members: Vec<&&StudyRun> = shown.iter().filter(|run| run.ladder == *ladder).collect();
        if k == 0 {
            members.sort_by(|a, b| a.wall_clock_s.total_cmp(&b.wall_clock_s));
            let points: Vec<String> = members
                .iter()
                .map(|run| format!("{:.1},{:.1}", x.at(run.wall_clock_s), y.at(error(run))))
                .collect();
            let _ = writeln!(
                svg,
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>",
                points.join(" ")
            );
        }
        for run in members {
            let title =
                format!("{}: {} %, {}", run.name, number(100.0 * error(run), 3), duration(run.wall_clock_s));
            let place = (x.at(run.wall_clock_s), y.at(error(run)));
            let _ = writeln!(svg, "<g><title>{}</title>{}</g>", escape(&title), mark(k, place, color));
        }
        let at = (WIDTH - RIGHT + 22.0, TOP + 10.0 + 20.0 * k as f64);
        let label = escape(ladder);
        let _ = writeln!(
            svg,
            "{}<text x=\"{}\" y=\"{}\">{label}</text>",
            mark(k, at, color),
            at.0 + 12.0,
            at.1 + 4.0
        );
    }
    let broken = report.runs.iter().filter(|run| run.status != StudyStatus::Completed);
    let mut place = TOP + 30.0 + 20.0 * ladders.len() as f64;
    for (k, run) in broken.enumerate() {
        if k == 0 {
            let _ =
                writeln!(svg, "<text x=\"{}\" y=\"{place:.1}\">not completed:</text>", WIDTH - RIGHT + 14.0);
        }
        place += 16.0;
        let _ = writeln!(
            svg,
            "<text x=\"{}\" y=\"{place:.1}\" font-size=\"10\">× {}</text>",
            WIDTH - RIGHT + 14.0,
            escape(&run.name)
        );
    }
    svg + "</svg>\n"
}

fn grid(svg: &mut String, x: &Axis, y: &Axis, what: &str) {
    for tick in x.ticks() {
        let at = x.at(tick);
        let _ = writeln!(
            svg,
            "<path d=\"M{at:.1} {TOP}V{}\" stroke=\"{GRID}\"/><text x=\"{at:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            HEIGHT - BOTTOM,
            HEIGHT - BOTTOM + 18.0,
            number(tick, 3)
        );
    }
    for tick in y.ticks() {
        let at = y.at(tick);
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {at:.1}H{}\" stroke=\"{GRID}\"/><text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{} %</text>",
            WIDTH - RIGHT,
            LEFT - 8.0,
            at + 4.0,
            number(100.0 * tick, 3)
        );
    }
    let _ = writeln!(
        svg,
        "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\">wall time [s]</text><text x=\"{LEFT}\" y=\"18\">error \
         <tspan font-weight=\"bold\">{}</tspan></text>",
        0.5 * (LEFT + WIDTH - RIGHT),
        HEIGHT - 8.0,
        escape(what)
    );
}

/// Steps under which no run is: the time that an error takes at least.
fn front(svg: &mut String, report: &StudyReport, shown: &[&StudyRun], x: &Axis, y: &Axis) {
    let mut path = String::new();
    for name in &report.front {
        let Some(run) = shown.iter().find(|run| run.name == *name) else { continue };
        let (a, b) = (x.at(run.wall_clock_s), y.at(run.error(&report.judged_by)));
        let _ = if path.is_empty() {
            write!(path, "M{a:.1} {TOP}V{b:.1}")
        } else {
            write!(path, "H{a:.1}V{b:.1}")
        };
    }
    if !path.is_empty() {
        let _ = writeln!(
            svg,
            "<path d=\"{path}H{}\" fill=\"none\" stroke=\"#999999\" stroke-width=\"1.2\" stroke-dasharray=\"5 4\"/>\
             <text x=\"{}\" y=\"18\" text-anchor=\"end\" fill=\"#707070\">- - no run is below and left of it</text>",
            WIDTH - RIGHT,
            WIDTH - RIGHT
        );
    }
}

/// Lines of round errors, with the time they take where the law says so.
fn lines(svg: &mut String, report: &StudyReport, x: &Axis, y: &Axis) {
    let entry = report.errors.iter().find(|e| e.name == report.judged_by);
    for error in LINES.into_iter().filter(|e| y.holds(*e)) {
        let at = y.at(error);
        let price = entry.and_then(|e| e.prices.iter().find(|p| (p.error - error).abs() < 1e-12));
        let text = price.map_or_else(String::new, |p| {
            let mark = if p.is_extrapolated { " (outside of what was run)" } else { "" };
            format!("{} % takes {}{mark}", number(100.0 * error, 3), duration(p.wall_clock_s))
        });
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {at:.1}H{}\" stroke=\"#aa8800\" stroke-width=\"0.8\"/><text x=\"{:.1}\" y=\"{:.1}\" \
             text-anchor=\"end\" fill=\"#8a6d00\" font-size=\"11\">{text}</text>",
            WIDTH - RIGHT,
            WIDTH - RIGHT - 4.0,
            at - 4.0
        );
        if let Some(price) = price.filter(|p| x.holds(p.wall_clock_s)) {
            let _ = writeln!(
                svg,
                "<circle cx=\"{:.1}\" cy=\"{at:.1}\" r=\"3\" fill=\"none\" stroke=\"#8a6d00\"/>",
                x.at(price.wall_clock_s)
            );
        }
    }
}

/// A mark whose shape tells the ladder as its colour does.
fn mark(kind: usize, (x, y): (f64, f64), color: &str) -> String {
    let path = match kind % 4 {
        0 => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\""),
        1 => format!("<rect x=\"{:.1}\" y=\"{:.1}\" width=\"9\" height=\"9\"", x - 4.5, y - 4.5),
        2 => format!("<path d=\"M{x:.1} {:.1}l5.5 9.5h-11z\"", y - 6.0),
        _ => format!("<path d=\"M{x:.1} {:.1}l6 6l-6 6l-6-6z\"", y - 6.0),
    };
    format!("{path} fill=\"{color}\" stroke=\"white\"/>")
}

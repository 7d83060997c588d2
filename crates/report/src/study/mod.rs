//! The page of a study: what accuracy costs, as a picture and in tables.

mod plot;

use crate::ReportError;
use crate::html::{self, Column, escape, prose, section, table};
use crate::scale::{bytes, count, duration, number};
use std::path::{Path, PathBuf};
use vaso_io::{ErrorEntry, StudyReport, StudyRun, StudyStatus, write_whole};

/// Writes `study.svg` and `report.html` into the folder of a study; returns the path of the page.
///
/// # Errors
/// [`ReportError::Io`] when they cannot be written.
pub fn write_study(out_dir: &Path, report: &StudyReport) -> Result<PathBuf, ReportError> {
    let svg = plot::work_precision(report);
    write_whole(&out_dir.join("study.svg"), svg.as_bytes())?;
    let path = out_dir.join("report.html");
    write_whole(&path, page(report, &svg).as_bytes())?;
    Ok(path)
}

/// The picture of `study.svg`: error against wall time, both on logarithmic axes, with the front.
pub fn work_precision(report: &StudyReport) -> String {
    plot::work_precision(report)
}

fn page(report: &StudyReport, svg: &str) -> String {
    let goal = report.goal.as_ref().map_or_else(String::new, |goal| {
        let word = if goal.met { "Met" } else { "Not met" };
        format!("<p><b>{word}:</b> {}.</p>\n", escape(&goal.verdict))
    });
    let head = format!(
        "<header><h1>{}</h1>\n<p>What accuracy costs in time. Errors are counted from {}. {} threads.</p>\n{goal}</header>\n",
        escape(&report.case),
        prose(&report.reference),
        report.threads
    );
    let notes: String =
        report.warnings.iter().map(|w| format!("<p class=\"note\">{}</p>\n", prose(w))).collect();
    let body = [
        head,
        section("precision", "Error against time", &(format!("<figure>{svg}</figure>\n") + &notes)),
        section("prices", "What an error costs", &(laws(report) + &prices(report))),
        section("runs", "Runs", &(runs(report) + &broken(report))),
    ];
    let foot = format!(
        "Made by vaso {} from <code>study.json</code>; the results of each run are in <code>runs</code> beside it.",
        escape(&report.vaso_version)
    );
    html::page(&report.case, "", &body.concat(), &foot)
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{} %", number(100.0 * share, 3)) } else { "–".into() }
}

/// Order, uncertainty and price of each error.
fn laws(report: &StudyReport) -> String {
    let columns = [
        Column::Words("error"),
        Column::Numbers("order", "in the spacing"),
        Column::Numbers("half the error costs", "times the time"),
        Column::Numbers("uncertainty of the finest", "GCI"),
        Column::Words("what the values say"),
    ];
    let plain = |x: Option<f64>| x.map_or("–".into(), |x| number(x, 3));
    let row = |e: &ErrorEntry| {
        vec![
            escape(&e.name),
            plain(e.order),
            plain(e.halving),
            e.uncertainty.map_or("–".into(), percent),
            escape(&e.trend),
        ]
    };
    table("Along the ladder of spacings", &columns, &report.errors.iter().map(row).collect::<Vec<_>>())
}

fn prices(report: &StudyReport) -> String {
    let columns = [
        Column::Words("error"),
        Column::Numbers("of", "%"),
        Column::Numbers("spacing", "mm"),
        Column::Numbers("wall time", ""),
        Column::Words("measured"),
    ];
    let rows: Vec<Vec<String>> = report
        .errors
        .iter()
        .flat_map(|e| e.prices.iter().map(move |p| (e, p)))
        .map(|(e, p)| {
            vec![
                escape(&e.name),
                number(100.0 * p.error, 3),
                number(1e3 * p.spacing_m, 3),
                duration(p.wall_clock_s),
                if p.is_extrapolated {
                    "no: outside of what was run"
                } else {
                    "within or next to what was run"
                }
                .into(),
            ]
        })
        .collect();
    if rows.is_empty() {
        return "<p class=\"note\">No error falls along the ladder of spacings, so none has a price.</p>\n"
            .into();
    }
    table("Prices", &columns, &rows)
}

fn runs(report: &StudyReport) -> String {
    let mut columns = vec![
        Column::Words("run"),
        Column::Words("settings"),
        Column::Numbers("particles", ""),
        Column::Numbers("acoustic steps", ""),
        Column::Numbers("wall time", ""),
        Column::Numbers("expected", ""),
        Column::Numbers("memory", ""),
        Column::Numbers("error", "%"),
    ];
    let has_walls = report.runs.iter().any(|run| run.wall_s.is_some());
    let has_maps = report.runs.iter().any(|run| run.wall_shear_correlation.is_some());
    columns.extend(has_walls.then_some(Column::Numbers("in the wall", "")));
    columns.extend(has_maps.then_some(Column::Numbers("wall shear stress", "correlation")));
    let row = |run: &StudyRun| {
        let settings: Vec<String> = run.settings.iter().map(|[k, v]| format!("{k} = {v}")).collect();
        let on_front = report.front.contains(&run.name);
        let name = escape(&run.name);
        let mut row = vec![
            if on_front { format!("<b>{name}</b>") } else { name },
            escape(&settings.join(", ")),
            count(run.particles.total()),
            count(run.steps.acoustic),
            duration(run.wall_clock_s),
            duration(run.predicted_s),
            bytes(run.memory_bytes),
            number(100.0 * run.error(&report.judged_by), 3),
        ];
        row.extend(has_walls.then(|| run.wall_s.map_or("–".into(), duration)));
        row.extend(has_maps.then(|| run.wall_shear_correlation.map_or("–".into(), |r| number(r, 4))));
        row
    };
    let completed = report.runs.iter().filter(|run| run.status == StudyStatus::Completed);
    table(
        "Runs; bold: no other beats it in time and error",
        &columns,
        &completed.map(row).collect::<Vec<_>>(),
    )
}

/// Runs that did not come to their end, with the reason.
fn broken(report: &StudyReport) -> String {
    let rows: Vec<Vec<String>> = report
        .runs
        .iter()
        .filter(|run| run.status != StudyStatus::Completed)
        .map(|run| {
            vec![escape(&run.name), run.status.to_string(), prose(run.message.as_deref().unwrap_or(""))]
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let columns = [Column::Words("run"), Column::Words("status"), Column::Words("why")];
    table("Not completed", &columns, &rows)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_io::{NamedValue, PriceEntry};

    fn report() -> StudyReport {
        let run = |name: &str, ladder: &str, time: f64, error: f64| StudyRun {
            name: name.into(),
            ladder: ladder.into(),
            wall_clock_s: time,
            errors: vec![NamedValue { name: "worst".into(), value: error }],
            ..StudyRun::default()
        };
        let mut failed = run("<b>", "sound-speed", f64::NAN, f64::NAN);
        failed.status = StudyStatus::Failed;
        failed.message = Some("a & b".into());
        StudyReport {
            case: "Pipe <1>".into(),
            judged_by: "worst".into(),
            runs: vec![run("coarse", "spacing", 10.0, 0.04), run("fine", "spacing", 90.0, 0.01), failed],
            front: vec!["coarse".into(), "fine".into()],
            errors: vec![ErrorEntry {
                name: "worst".into(),
                order: Some(2.0),
                prices: vec![PriceEntry {
                    error: 0.02,
                    spacing_m: 1e-3,
                    wall_clock_s: 40.0,
                    is_extrapolated: false,
                }],
                ..ErrorEntry::default()
            }],
            ..StudyReport::default()
        }
    }

    #[test]
    fn the_page_shows_runs_prices_and_what_broke_and_escapes_names() {
        let report = report();
        let svg = work_precision(&report);
        let page = page(&report, &svg);
        for part in ["Pipe &lt;1&gt;", "<b>coarse</b>", "&lt;b&gt;", "a &amp; b", "40 s", "Not completed"] {
            assert!(page.contains(part), "{part} is missing");
        }
        assert!(!page.contains("NaN") && !svg.contains("inf"));
    }

    #[test]
    fn a_study_without_errors_still_has_its_picture() {
        let svg = work_precision(&StudyReport::default());
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n") && !svg.contains("NaN"), "{svg}");
    }
}

//! The page as a whole.

use crate::ReportError;
use crate::accuracy::Accuracy;
use crate::chart::{Curve, chart};
use crate::html::{self, escape, prose, section};
use crate::{against, cycles, limits, sections, vessel, viewer, wall};
use std::path::{Path, PathBuf};
use vaso_io::{Summary, TableData, read_table, write_whole};

/// Bytes of a page at most.
const MOST_BYTES: usize = 15_000_000;

/// Makes `report.html` in the output folder of a run and returns its path.
///
/// The page is one file that needs no network, below 15 MB. A script in it turns the vessel; without one all else still stands. It is made from `summary.json`, and from
/// `openings.csv`, `fluid.vtkhdf` and `wall.vtkhdf` as far as they exist: a part that cannot be read is
/// replaced by the reason, so that a run that broke down still gets its report.
///
/// # Errors
/// [`ReportError::Io`] when `summary.json` cannot be read or the page cannot be written.
pub fn write_report(out_dir: &Path) -> Result<PathBuf, ReportError> {
    let summary = Summary::read(&out_dir.join("summary.json"))?;
    write(out_dir, &summary, "")
}

/// The same with a section more: pressures beside those of another run of the vessel, whose output folder is `other`, and what became of the pulse.
///
/// # Errors
/// Those of [`write_report`], and [`ReportError::Io`] when `summary.json` of the other run or `openings.csv` of either cannot be read.
pub fn write_report_against(out_dir: &Path, other: &Path) -> Result<PathBuf, ReportError> {
    let summary = Summary::read(&out_dir.join("summary.json"))?;
    let against = against::against(out_dir, &summary, other)?;
    write(out_dir, &summary, &against)
}

fn write(out_dir: &Path, summary: &Summary, against: &str) -> Result<PathBuf, ReportError> {
    let path = out_dir.join("report.html");
    write_whole(&path, page(out_dir, summary, against).as_bytes())?;
    Ok(path)
}

fn page(out: &Path, summary: &Summary, against: &str) -> String {
    let before = sections::head(summary);
    let accuracy = Accuracy::of(out, summary);
    let pictures = vessel::figures(out, summary.spacing_m);
    let after = [
        section(
            "openings",
            "Openings",
            &(waveforms(&out.join("openings.csv")) + &sections::openings(summary)),
        ),
        section("cycles", "Cycles", &cycles::cycles(summary)),
        section("against", "Against another run", against),
        section("wall", "The wall", &wall::wall(out, summary)),
        section("stability", "Stability", &(sections::stability(summary) + &cycles::energy(summary))),
        section("accuracy", "How far off", &accuracy.section(summary)),
        section("cost", "Plan and cost", &sections::effects(summary)),
        section("scene", "Scene", &sections::scene(summary)),
        section("limits", "What this does not prove", &limits::limits(summary, &accuracy)),
    ]
    .concat();
    // The viewer takes what the rest has left.
    let room = MOST_BYTES.saturating_sub(before.len() + pictures.len() + after.len());
    let vessel = viewer::viewer(out, summary, room) + &pictures;
    let body = [before, section("vessel", "The vessel", &vessel), after].concat();
    let foot = format!(
        "Made by vaso {} from <code>summary.json</code>, <code>openings.csv</code> and the series beside this \
         file. Quantities are SI or marked with their unit.",
        escape(&summary.vaso_version)
    );
    html::page(&summary.case, viewer::STYLE, &body, &foot)
}

/// Flow and pressure of every opening against time.
fn waveforms(path: &Path) -> String {
    if !path.exists() {
        return String::new();
    }
    let data = match read_table(path) {
        Ok(data) => data,
        Err(error) => return format!("<p class=\"note\">No waveforms: {}</p>\n", prose(&error.to_string())),
    };
    chart("Flow", "ml/s, positive out of the vessel", &curves(&data, ".flow_m3_s", 1e6)) + &pressure(&data)
}

/// Pressure in the unit that keeps the axis short.
fn pressure(data: &TableData) -> String {
    let pascals = curves(data, ".pressure_pa", 1.0);
    let values = pascals.iter().flat_map(|curve| &curve.points).map(|point| point.1.abs());
    if values.filter(|x| x.is_finite()).fold(0.0, f64::max) < 2000.0 {
        chart("Pressure", "Pa", &pascals)
    } else {
        chart("Pressure", "kPa", &curves(data, ".pressure_pa", 1e-3))
    }
}

/// The columns with a suffix as curves named by what comes before it.
fn curves(data: &TableData, suffix: &str, factor: f64) -> Vec<Curve> {
    data.header
        .iter()
        .enumerate()
        .filter_map(|(k, column)| Some((k, column.strip_suffix(suffix)?)))
        .map(|(k, name)| Curve {
            name: name.to_owned(),
            points: data.rows.iter().map(|row| (row[0], factor * row[k])).collect(),
        })
        .collect()
}

//! What another run of the same vessel has, beside this one: what an elastic wall takes off the pulse, say.

use crate::ReportError;
use crate::chart::{Curve, chart};
use crate::html::{Column, escape, table};
use crate::scale::number;
use std::path::Path;
use vaso_io::{CycleSummary, OpeningCycleSummary, Summary, TableData, read_table};

/// Part of a period or of a spacing by which two may differ and still be the same.
const SAME: f64 = 1e-6;
/// Means over such a part of the cycle are what a peak is looked for in, as in the table of the cycles.
const PART: f64 = 0.01;

/// Pressures of both runs at the openings that both have, and what became of the pulse in the last whole cycle that both have.
///
/// # Errors
/// [`ReportError::Io`] when `summary.json` or `openings.csv` of either cannot be read.
pub(crate) fn against(out: &Path, summary: &Summary, other: &Path) -> Result<String, ReportError> {
    let theirs = Summary::read(&other.join("summary.json"))?;
    let tables = [read_table(&out.join("openings.csv"))?, read_table(&other.join("openings.csv"))?];
    let names = [name(out), name(other)];
    Ok(differences(summary, &theirs, &names)
        + &charts(&tables, &names)
        + &pulses(summary, &theirs, &tables, &names))
}

/// What the folder of a run is called: by the folder of its case where it is only `out`.
fn name(out: &Path) -> String {
    let last = |path: &Path| path.file_name().map(|name| name.to_string_lossy().into_owned());
    let whole = std::path::absolute(out).unwrap_or_else(|_| out.to_owned());
    match (last(&whole), whole.parent().and_then(last)) {
        (Some(out), Some(case)) if out == "out" => case,
        (Some(folder), _) => folder,
        (None, _) => out.display().to_string(),
    }
}

/// The effects that only one of them has, and what else makes them differ by more than the wall.
fn differences(own: &Summary, other: &Summary, names: &[String; 2]) -> String {
    let only = |a: &Summary, b: &Summary| -> Vec<String> {
        let is_on = |summary: &Summary, name: &str| summary.effects.iter().any(|e| e.name == name && e.on);
        a.effects
            .iter()
            .filter(|e| e.on && !is_on(b, &e.name))
            .map(|e| format!("<code>{}</code>", escape(&e.name)))
            .collect()
    };
    let mut text = String::from("<p>");
    for (names, effects) in [(&names[0], only(own, other)), (&names[1], only(other, own))] {
        if !effects.is_empty() {
            text += &format!("Only <code>{}</code> has {}. ", escape(names), effects.join(", "));
        }
    }
    if (own.spacing_m / other.spacing_m - 1.0).abs() > SAME {
        let millimetres = |summary: &Summary| number(1e3 * summary.spacing_m, 3);
        text += &format!(
            "Spacings are {} and {} mm, which is part of the difference. ",
            millimetres(own),
            millimetres(other)
        );
    }
    let tables: Vec<&str> = own
        .identity
        .iter()
        .filter(|[table, digest]| other.identity.iter().any(|[t, d]| t == table && d != digest))
        .map(|[table, _]| table.as_str())
        .collect();
    if !tables.is_empty() {
        text += &format!("The cases differ in {}.", escape(&tables.join(", ")));
    }
    text + "</p>\n"
}

/// A column of `openings.csv` against time.
fn column(data: &TableData, name: &str) -> Option<Vec<(f64, f64)>> {
    let k = data.header.iter().position(|column| column == name)?;
    Some(data.rows.iter().map(|row| (row[0], row[k])).collect())
}

fn charts([own, other]: &[TableData; 2], names: &[String; 2]) -> String {
    let openings = own.header.iter().filter_map(|column| column.strip_suffix(".pressure_pa"));
    openings
        .filter_map(|opening| {
            let of = |data: &TableData| column(data, &format!("{opening}.pressure_pa"));
            let curve = |name: &String, points: Vec<(f64, f64)>| Curve {
                name: name.clone(),
                points: points.into_iter().map(|(t, p)| (t, 1e-3 * p)).collect(),
            };
            let curves = [curve(&names[0], of(own)?), curve(&names[1], of(other)?)];
            Some(chart(&format!("Pressure of {opening}"), "kPa", &curves))
        })
        .collect()
}

/// The last cycle that both have at the same time.
fn common<'a>(own: &'a Summary, other: &'a Summary) -> Option<(&'a CycleSummary, &'a CycleSummary)> {
    own.cycles.iter().rev().find_map(|a| {
        let near = |x: f64, y: f64| (x - y).abs() < SAME * (a.end_s - a.start_s);
        let same = |b: &&CycleSummary| near(a.start_s, b.start_s) && near(a.end_s, b.end_s);
        Some((a, other.cycles.iter().find(same)?))
    })
}

fn pulses(own: &Summary, other: &Summary, tables: &[TableData; 2], names: &[String; 2]) -> String {
    let Some((a, b)) = common(own, other) else {
        return "<p class=\"note\">The runs have no whole cycle at the same time, so that pulses cannot be compared.</p>\n".into();
    };
    let kilopascals = |p: f64| number(1e-3 * p, 4);
    let row = |own: &OpeningCycleSummary| {
        let theirs = b.openings.iter().find(|o| o.name == own.name)?;
        let peak = |data| peak(data, &format!("{}.pressure_pa", own.name), (a.start_s, a.end_s));
        let later = match (peak(&tables[0]), peak(&tables[1])) {
            (Some(ours), Some(theirs)) => number(1e3 * (ours - theirs), 2),
            _ => "–".into(),
        };
        let span = |o: &OpeningCycleSummary| o.max_flow_m3_s - o.min_flow_m3_s;
        Some(vec![
            escape(&own.name),
            kilopascals(own.mean_pressure_pa),
            kilopascals(theirs.mean_pressure_pa),
            kilopascals(own.pulse_pressure_pa),
            kilopascals(theirs.pulse_pressure_pa),
            format!("{} %", number(100.0 * (1.0 - own.pulse_pressure_pa / theirs.pulse_pressure_pa), 2)),
            later,
            format!("{} %", number(100.0 * (1.0 - span(own) / span(theirs)), 2)),
        ])
    };
    let rows: Vec<_> = a.openings.iter().filter_map(row).collect();
    let columns = [
        Column::Words("opening"),
        Column::Numbers("mean", "kPa"),
        Column::Numbers("against", ""),
        Column::Numbers("pulse", "kPa"),
        Column::Numbers("against", ""),
        Column::Numbers("damping", ""),
        Column::Numbers("peak later by", "ms"),
        Column::Numbers("damping of the flow", ""),
    ];
    let caption = format!(
        "Pressure of cycle {}, {} against {}. The pulse is the highest less the lowest of means over a hundredth of the cycle, its damping the \
         part of the other's pulse that this one lacks, and that of the flow the same of its range",
        a.index + 1,
        names[0],
        names[1]
    );
    if rows.is_empty() { String::new() } else { table(&caption, &columns, &rows) }
}

/// When the mean over a part of the cycle is highest \[s\]; `None` without values.
fn peak(data: &TableData, name: &str, (start, end): (f64, f64)) -> Option<f64> {
    let parts = (1.0 / PART).round() as usize;
    let mut sums = vec![(0.0, 0.0); parts];
    for (t, p) in column(data, name)? {
        let part = ((t - start) / (end - start) * parts as f64).floor();
        if (0.0..parts as f64).contains(&part) && p.is_finite() {
            let (sum, n) = &mut sums[part as usize];
            *sum += p;
            *n += 1.0;
        }
    }
    let means = sums.iter().map(|(sum, n)| sum / n).enumerate().filter(|(_, mean)| mean.is_finite());
    let (k, _) = means.max_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(start + (k as f64 + 0.5) * PART * (end - start))
}

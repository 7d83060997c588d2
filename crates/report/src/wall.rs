//! The wall: pictures of its stresses, and what they amount to.

use crate::html::{Column, escape, prose, table};
use crate::picture::{Quantity, draw_surface};
use crate::scale::{count, number};
use crate::vessel::{WIDTH, enclosed, note};
use std::path::Path;
use vaso_io::{
    Distribution, FieldInfo, IoError, LOW_TAWSS, SeriesReader, Summary, WallSummary, schema, wall_surface,
};

/// What is drawn, where the series has it: the others are ratios whose few large values would hide all else.
const DRAWN: [(Quantity, &str); 4] = [
    (Quantity::WallShear, "Wall shear stress"),
    (Quantity::Tawss, "Time-averaged wall shear stress"),
    (Quantity::Osi, "Oscillatory shear index"),
    (Quantity::TransverseWss, "Transverse wall shear stress"),
];

/// Pictures and numbers of the wall.
pub(crate) fn wall(out: &Path, summary: &Summary) -> String {
    let Some(path) = wall_surface(out) else { return String::new() };
    let reader = match SeriesReader::open(&path) {
        Ok(reader) => reader,
        Err(error) => return note(&error.into()),
    };
    let figures = figures(&reader, &path, summary).unwrap_or_else(|error| note(&error.into()));
    let numbers = summary.wall.as_ref().map(|wall| numbers(wall, &path, &reader.info().fields));
    figures + &numbers.unwrap_or_default()
}

fn figures(reader: &SeriesReader, path: &Path, summary: &Summary) -> Result<String, IoError> {
    let triangles = reader.triangles()?;
    // A wall of particles has no stress of the blood on it.
    let Some(frame) = reader.last_frame()?.filter(|_| !triangles.is_empty()) else {
        return Ok(String::new());
    };
    let cycle = match summary.wall.as_ref().and_then(|wall| wall.cycle) {
        Some(cycle) => format!("over cycle {}, from both sides", cycle + 1),
        None => "over the last whole cycle, from both sides".to_owned(),
    };
    let instant = format!("at {} s, from both sides", number(frame.time, 4));
    let what = format!("{} triangles", count(triangles.len() as u64));
    let figure = |quantity: Quantity, title: &str| {
        // Before the first cycle has ended its indices have no values.
        let values = quantity.values(&frame, path).ok()?;
        values.iter().find(|v| v.is_finite())?;
        let unknown = if values.iter().all(|v| v.is_finite()) { "" } else { ", grey where it is not known" };
        let when = if quantity == Quantity::WallShear { &instant } else { &cycle };
        let when = format!("{when}{unknown}");
        let drawn = draw_surface(&frame, &triangles, path, quantity, WIDTH);
        Some(
            drawn
                .and_then(|drawn| enclosed(&drawn, title, &when, &what, quantity))
                .unwrap_or_else(|e| note(&e)),
        )
    };
    Ok(DRAWN.iter().filter_map(|&(quantity, title)| figure(quantity, title)).collect())
}

/// How stresses and indices are distributed over the wall, and what they are.
fn numbers(wall: &WallSummary, file: &Path, fields: &[FieldInfo]) -> String {
    let known = [
        ("wall shear stress", schema::WSS, "Pa", wall.wss_pa),
        ("time-averaged wall shear stress", schema::TAWSS, "Pa", wall.tawss_pa),
        ("largest wall shear stress", schema::PEAK_WSS, "Pa", wall.peak_wss_pa),
        ("transverse wall shear stress", schema::TRANSVERSE_WSS, "Pa", wall.transverse_wss_pa),
        ("oscillatory shear index", schema::OSI, "", wall.osi),
        ("relative residence time", schema::RRT, "1/Pa", wall.rrt_1_pa),
        ("endothelial cell activation potential", schema::ECAP, "1/Pa", wall.ecap_1_pa),
    ];
    let told: Vec<(&str, &str, &str, Distribution)> = known
        .into_iter()
        .filter_map(|(name, field, unit, found)| Some((name, field, unit, found?)))
        .collect();
    if told.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = told
        .iter()
        .map(|(name, field, unit, found)| {
            let values = [found.mean, found.percentile_1, found.median, found.percentile_99];
            let mut row = vec![format!("{name} <small>{field}</small>"), (*unit).to_owned()];
            row.extend(values.map(|value| number(value, 3)));
            row.push(format!("{} %", number(100.0 * found.missing, 2)));
            row
        })
        .collect();
    let columns = [
        Column::Words("quantity"),
        Column::Words("unit"),
        Column::Numbers("mean", ""),
        Column::Numbers("1 %", ""),
        Column::Numbers("median", ""),
        Column::Numbers("99 %", ""),
        Column::Numbers("area without value", ""),
    ];
    let caption = "By area of the wall outside the buffers of the openings; below each percentile lies that part of the area";
    let mut html = table(caption, &columns, &rows);
    if let Some(low) = wall.low_tawss_area_fraction {
        html += &format!(
            "<p>The time-averaged wall shear stress is below {LOW_TAWSS} Pa, as it is where atherosclerosis is found (Malek, Alper and \
             Izumo 1999), on {} % of {} cm².</p>\n",
            number(100.0 * low, 3),
            number(wall.counted_area_m2 * 1e4, 3)
        );
    }
    html + &definitions(&told, file, fields)
}

/// Formula and source of each quantity, as the file has them.
fn definitions(told: &[(&str, &str, &str, Distribution)], file: &Path, fields: &[FieldInfo]) -> String {
    let rows: Vec<Vec<String>> = told
        .iter()
        .filter_map(|(_, name, _, _)| {
            let field = fields.iter().find(|field| field.name == *name)?;
            let definition = field.definition.as_deref()?;
            let citation = field.citation.as_deref().unwrap_or_default();
            Some(vec![escape(name), prose(&format!("`{definition}`")), escape(citation)])
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let columns = [Column::Words("quantity"), Column::Words("definition"), Column::Words("source")];
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    table(&format!("What these numbers are, as the attributes in {name} say"), &columns, &rows)
}

//! The parts of the page that come from `summary.json`.

use crate::html::{Column, escape, prose, table, verdict};
use crate::scale::{bytes, count, duration, number};
use vaso_io::{Status, Summary};

/// Title, status, message and key figures.
pub(crate) fn head(summary: &Summary) -> String {
    let class = match summary.status {
        Status::Completed => "good",
        Status::Failed => "bad",
        _ => "fair",
    };
    let title = if summary.case.is_empty() { "Untitled case" } else { &summary.case };
    let mut html = format!(
        "<header><h1>{}</h1><p class=\"lead\"><span class=\"status verdict {class}\">{}</span> \
         blood flow by smoothed particles, vaso {}</p>",
        escape(title),
        summary.status,
        escape(&summary.vaso_version)
    );
    if let Some(message) = &summary.message {
        html += &format!("<p class=\"note {class}\">{}</p>", prose(message));
    }
    for warning in &summary.warnings {
        html += &format!("<p class=\"note\">{}</p>", prose(warning));
    }
    let card = |name: &str, value: String| format!("<div><dt>{name}</dt><dd>{value}</dd></div>");
    let unit = |value: f64, unit: &str| format!("{} <small>{unit}</small>", number(value, 3));
    let speed = unit(summary.particle_substeps_per_s / 1e6, "million/s");
    let cards = [
        card("Simulated time", unit(summary.time_s, "s")),
        card("Wall clock", duration(summary.wall_clock_s)),
        card("Particles", count(summary.particles.total())),
        card("Spacing", unit(summary.spacing_m * 1e3, "mm")),
        card("Particle steps", speed),
        card("Threads", count(summary.threads)),
        card("Sound speed", unit(summary.sound_speed_m_s, "m/s")),
        card("Precision", escape(&summary.precision)),
    ];
    html += &format!("<dl class=\"cards\">{}</dl></header>\n", cards.concat());
    html
}

/// What was computed, why, and what it cost.
pub(crate) fn effects(summary: &Summary) -> String {
    if summary.effects.is_empty() {
        return String::new();
    }
    let total: f64 = summary.effects.iter().filter_map(|effect| effect.seconds).sum();
    let mut rows = Vec::new();
    for effect in &summary.effects {
        let state = match (effect.on, effect.called_for) {
            (true, _) => verdict("good", "on"),
            (false, true) => verdict("bad", "off, called for"),
            (false, false) => verdict("off", "off"),
        };
        let seconds = effect.seconds.filter(|_| effect.on);
        let share = seconds.filter(|_| total > 0.0).map(|s| {
            let percent = 100.0 * s / total;
            format!("<span class=\"share\"><i style=\"width:{percent:.1}%\"></i></span><span class=\"percent\">{percent:.0} %</span>")
        });
        rows.push(vec![
            escape(&effect.name),
            state,
            prose(&effect.reason),
            seconds.map_or_else(String::new, |s| number(s, 3)),
            share.unwrap_or_default(),
            effect.bytes.filter(|&b| b > 0).map_or_else(String::new, bytes),
        ]);
    }
    let rest = summary.wall_clock_s - total;
    if total > 0.0 && rest > 0.005 * summary.wall_clock_s {
        let text = "preparation, and what belongs to no effect".to_owned();
        rows.push(vec![
            "rest".to_owned(),
            String::new(),
            text,
            number(rest, 3),
            String::new(),
            String::new(),
        ]);
    }
    let columns = [
        Column::Words("effect"),
        Column::Words("state"),
        Column::Words("reason"),
        Column::Numbers("time", "s"),
        Column::Numbers("share of effects", ""),
        Column::Numbers("memory", ""),
    ];
    table("Effects the program knows, whether this run computed them, and what they cost", &columns, &rows)
}

/// What the guards saw, against what is acceptable.
pub(crate) fn stability(summary: &Summary) -> String {
    let seen = &summary.stability;
    let fluid = summary.particles.fluid.max(1) as f64;
    let measured =
        |value: f64, text: &dyn Fn(f64) -> String, name: &str, meaning: &str, good: f64, fair: f64| {
            let seen = if value.is_nan() { "–".to_owned() } else { text(value) };
            let limit = format!("up to {}", text(good));
            vec![name.to_owned(), seen, limit, judge(value.abs(), good, fair), meaning.to_owned()]
        };
    let percent = |value: f64| format!("{} %", number(100.0 * value, 3));
    let plain = |value: f64| number(value, 3);
    let counted = |value: u64, name: &str, meaning: &str, fair: f64| {
        let judged = judge(value as f64, 0.0, fair);
        vec![name.to_owned(), count(value), "none".to_owned(), judged, meaning.to_owned()]
    };
    let rows = [
        measured(
            seen.max_density_error,
            &percent,
            "density error",
            "largest deviation from the rest density",
            0.02,
            0.05,
        ),
        measured(
            seen.max_mach,
            &plain,
            "Mach number",
            "largest speed over the artificial sound speed",
            0.1,
            0.2,
        ),
        measured(
            seen.mass_balance_error,
            &percent,
            "mass balance",
            "inflow less outflow and storage, over the inflow",
            0.01,
            0.05,
        ),
        measured(
            seen.energy_growth,
            &percent,
            "energy growth",
            "energy that nothing supplied, over the total",
            0.01,
            0.1,
        ),
        counted(seen.escaped_particles, "escaped particles", "fluid found outside the lumen", 1e-3 * fluid),
        counted(seen.non_finite, "non-finite values", "not a number, or infinite", 0.0),
    ];
    let columns = [
        Column::Words("quantity"),
        Column::Numbers("seen", ""),
        Column::Numbers("good", ""),
        Column::Words("verdict"),
        Column::Words("meaning"),
    ];
    let steps = &summary.steps;
    format!(
        "{}<p class=\"soft\">{} advection steps, {} acoustic steps, {} wall steps.</p>\n",
        table("Worst values over the whole run", &columns, &rows),
        count(steps.advection),
        count(steps.acoustic),
        count(steps.solid)
    )
}

fn judge(value: f64, good: f64, fair: f64) -> String {
    if value.is_nan() {
        verdict("off", "not measured")
    } else if value <= good {
        verdict("good", "good")
    } else if value <= fair {
        verdict("fair", "borderline")
    } else {
        verdict("bad", "too large")
    }
}

/// Openings with their means.
pub(crate) fn openings(summary: &Summary) -> String {
    if summary.openings.is_empty() {
        return String::new();
    }
    let mut rows: Vec<Vec<String>> = summary
        .openings
        .iter()
        .map(|entry| {
            vec![
                escape(&entry.opening.name),
                number(entry.opening.area_m2 * 1e6, 4),
                number(entry.opening.radius_m * 1e3, 4),
                number(entry.mean_flow_m3_s * 1e6, 4),
                number(entry.mean_pressure_pa, 4),
            ]
        })
        .collect();
    let net: f64 = summary.openings.iter().map(|entry| entry.mean_flow_m3_s).sum();
    rows.push(vec!["sum".to_owned(), String::new(), String::new(), number(net * 1e6, 3), String::new()]);
    let columns = [
        Column::Words("opening"),
        Column::Numbers("area", "mm²"),
        Column::Numbers("radius", "mm"),
        Column::Numbers("mean flow", "ml/s"),
        Column::Numbers("mean pressure", "Pa"),
    ];
    table("Means at the openings; flow is positive out of the vessel", &columns, &rows)
}

/// Geometry audit and numbers of the scene.
pub(crate) fn scene(summary: &Summary) -> String {
    let mut rows: Vec<Vec<String>> = Vec::new();
    let mut row = |name: &str, value: String| rows.push(vec![name.to_owned(), value]);
    let particles = &summary.particles;
    row(
        "particles",
        format!(
            "{} fluid, {} wall, {} shell",
            count(particles.fluid),
            count(particles.wall),
            count(particles.shell)
        ),
    );
    if let Some(surface) = &summary.surface {
        let pieces = if surface.components == 1 { "piece" } else { "pieces" };
        let closed = if surface.watertight { "closed" } else { "not closed" };
        row(
            "surface",
            format!("{} triangles in {} {pieces}, {closed}", count(surface.triangles), surface.components),
        );
        row("enclosed volume", format!("{} ml", number(surface.volume_m3 * 1e6, 4)));
        row("area", format!("{} cm²", number(surface.area_m2 * 1e4, 4)));
        row("unit of the file", escape(&surface.unit));
        let repairs = if surface.repairs.is_empty() { "none".to_owned() } else { surface.repairs.join("; ") };
        row("repairs", escape(&repairs));
    }
    if let Some(numbers) = &summary.numbers {
        let known = [
            ("peak Reynolds number", numbers.reynolds_peak, 1.0, ""),
            ("Womersley number", numbers.womersley, 1.0, ""),
            ("expected radial strain", numbers.radial_strain, 100.0, " %"),
        ];
        for (name, value, factor, unit) in known {
            if let Some(value) = value {
                row(name, format!("{}{unit}", number(factor * value, 3)));
            }
        }
    }
    table("Geometry and numbers of the scene", &[Column::Words("quantity"), Column::Words("value")], &rows)
}

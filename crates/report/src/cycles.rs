//! What the cycles of a run amount to, and where its energy went.

use crate::html::{Column, escape, table};
use crate::scale::{count, number};
use vaso_io::{CycleSummary, EndReason, EnergySummary, Summary};

/// Mean pressure below which pressures are told in pascals rather than in mmHg \[Pa\].
const PHYSIOLOGICAL: f64 = 2000.0;
/// One mmHg \[Pa\].
const MMHG: f64 = 133.322387415;
/// Cycles listed from the beginning and from the end, where there are many.
const LISTED: usize = 10;

/// Tables of the cycles; empty without any.
pub(crate) fn cycles(summary: &Summary) -> String {
    let Some(last) = summary.cycles.last() else { return String::new() };
    let why = match summary.end_reason {
        Some(EndReason::Periodic) => " The run ended because the last two were alike.",
        Some(EndReason::Steady) => " The run ended because the flow had become steady.",
        _ => "",
    };
    let followed = match summary.cycles.len() {
        1 => "One whole cycle was followed.".to_owned(),
        n => format!("{} whole cycles were followed.", count(n as u64)),
    };
    format!("<p>{followed}{why}</p>\n") + &convergence(&summary.cycles) + &openings(last) + &drops(last)
}

fn percent(part: Option<f64>) -> String {
    part.map_or_else(|| "–".to_owned(), |part| format!("{} %", number(100.0 * part, 2)))
}

/// How cycles became alike.
fn convergence(cycles: &[CycleSummary]) -> String {
    let is_listed = |k: usize| k < LISTED || k + LISTED >= cycles.len();
    let rows: Vec<Vec<String>> = cycles
        .iter()
        .enumerate()
        .filter(|(k, _)| is_listed(*k))
        .map(|(_, cycle)| {
            let change = cycle.periodicity;
            vec![
                count(cycle.index + 1),
                format!("{} to {}", number(cycle.start_s, 4), number(cycle.end_s, 4)),
                percent(change.map(|c| c.flow)),
                percent(change.map(|c| c.pressure)),
                percent(change.and_then(|c| c.wall_shear)),
                percent(cycle.mass_balance_error),
                cycle.mean_tawss_pa.map_or_else(|| "–".to_owned(), |mean| number(mean, 4)),
            ]
        })
        .collect();
    let columns = [
        Column::Words("cycle"),
        Column::Numbers("time", "s"),
        Column::Numbers("change of flow", ""),
        Column::Numbers("of pressure", ""),
        Column::Numbers("of wall shear stress", ""),
        Column::Numbers("mass balance", ""),
        Column::Numbers("mean TAWSS", "Pa"),
    ];
    let left_out = cycles.len() - rows.len();
    let mut caption =
        "Change from the cycle before: root mean square over the range, the largest of all openings; of the \
                       time-averaged wall shear stress over its mean"
            .to_owned();
    if left_out > 0 {
        caption += &format!("; {left_out} cycles in the middle are left out");
    }
    table(&caption, &columns, &rows)
}

/// Flow and pressure of the last cycle.
fn openings(last: &CycleSummary) -> String {
    let high = last.openings.iter().map(|o| o.mean_pressure_pa.abs()).fold(0.0, f64::max);
    let (pascals, unit) = if high < PHYSIOLOGICAL { (1.0, "Pa") } else { (MMHG, "mmHg") };
    let optional = |value: Option<f64>| value.map_or_else(|| "–".to_owned(), |value| number(value, 3));
    let rows: Vec<Vec<String>> = last
        .openings
        .iter()
        .map(|o| {
            let flow = |value: f64| number(value * 1e6, 4);
            let pressure = |value: f64| number(value / pascals, 4);
            vec![
                escape(&o.name),
                flow(o.mean_flow_m3_s),
                format!("{} to {}", flow(o.min_flow_m3_s), flow(o.max_flow_m3_s)),
                percent(o.flow_split),
                optional(o.pulsatility_index),
                optional(o.resistive_index),
                pressure(o.mean_pressure_pa),
                format!("{} / {}", pressure(o.systolic_pressure_pa), pressure(o.diastolic_pressure_pa)),
                pressure(o.pulse_pressure_pa),
            ]
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let columns = [
        Column::Words("opening"),
        Column::Numbers("flow", "ml/s"),
        Column::Numbers("range", "ml/s"),
        Column::Numbers("split", ""),
        Column::Numbers("PI", ""),
        Column::Numbers("RI", ""),
        Column::Numbers("pressure", unit),
        Column::Numbers("systolic / diastolic", ""),
        Column::Numbers("pulse", ""),
    ];
    let caption = format!(
        "Cycle {} at the openings: flow out of the vessel, its mean and range, its share of all that leaves; mean, highest and \
         lowest pressure and the difference of the latter. PI is (Qmax − Qmin) / |Qmean| (Gosling, King 1974), RI is (Qmax − Qmin) / Qmax (Pourcelot \
         1974), of means over a hundredth of the cycle",
        last.index + 1
    );
    table(&caption, &columns, &rows)
}

/// Pressure drops and fractional flow reserves of the last cycle.
fn drops(last: &CycleSummary) -> String {
    let rows: Vec<Vec<String>> = last
        .pressure_drops
        .iter()
        .map(|drop| {
            vec![
                format!("{} → {}", escape(&drop.proximal), escape(&drop.distal)),
                number(drop.mean_pa, 4),
                format!("{} to {}", number(drop.min_pa, 4), number(drop.max_pa, 4)),
                drop.fractional_flow_reserve.map_or_else(|| "–".to_owned(), |ffr| number(ffr, 3)),
            ]
        })
        .collect();
    if rows.is_empty() {
        return String::new();
    }
    let columns = [
        Column::Words("from and to"),
        Column::Numbers("mean drop", "Pa"),
        Column::Numbers("range", "Pa"),
        Column::Numbers("FFR", ""),
    ];
    let caption = "Pressure drops; FFR, the fractional flow reserve, is the mean distal over the mean proximal pressure (Pijls et \
                   al. 1996)";
    table(caption, &columns, &rows)
}

/// Where the energy went; empty where no account was kept.
pub(crate) fn energy(summary: &Summary) -> String {
    let Some(energy) = summary.energy else { return String::new() };
    let EnergySummary {
        inflow_j,
        throughput_j,
        dissipated_j,
        kinetic_change_j,
        residual_j,
        relative_residual: _,
        damped_backflow_j,
    } = energy;
    let share = |value: f64| percent((throughput_j > 0.0).then(|| value / throughput_j));
    let row = |name: &str, value: f64, meaning: &str| {
        vec![name.to_owned(), number(value * 1e3, 3), share(value), meaning.to_owned()]
    };
    let mut rows = vec![
        row("entered", inflow_j, "through the openings, less what left"),
        row("became heat", dissipated_j, "by friction, as the velocities show it"),
        row("became motion", kinetic_change_j, "kinetic energy at the end less that at the start"),
        row("residual", residual_j, "numerical dissipation, compression, and errors of these estimates"),
    ];
    rows.extend(damped_backflow_j.map(|taken| {
        row(
            "backflow damping",
            taken,
            "taken from blood that came in through outlet models; part of the residual",
        )
    }));
    let columns = [
        Column::Words("energy"),
        Column::Numbers("", "mJ"),
        Column::Numbers("share of throughput", ""),
        Column::Words("meaning"),
    ];
    table("Where the energy went, over the whole run", &columns, &rows)
}

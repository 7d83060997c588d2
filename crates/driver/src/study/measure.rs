//! Numbers that a study compares, read from the files of a run.

use crate::error::DriverError;
use crate::plan::Plan;
use std::path::Path;
use vaso_boundary::Condition;
use vaso_io::{Summary, TableData, read_table};
use vaso_scene::{Expectation, Measured, Statistic};

/// A number to be compared.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Target {
    /// Name of its value.
    pub(crate) label: String,
    /// Name of the error it is part of.
    pub(crate) error: String,
    /// What is measured.
    pub(crate) measured: Measured,
    /// Openings or probe.
    pub(crate) places: Vec<String>,
    /// What becomes of it in time.
    pub(crate) statistic: Statistic,
    /// The value, where it is known, and what errors are shares of, where it is said \[SI\].
    pub(crate) known: Option<f64>,
    pub(crate) scale: Option<f64>,
}

/// Share of a run without cycles that counts.
const LAST: f64 = 0.25;

/// What is known of a flow, or where nothing is: flows that are not imposed, pressures that are not, and the wall shear stress.
pub(crate) fn targets(plan: &Plan, known: &[Expectation]) -> Vec<Target> {
    if !known.is_empty() {
        let label = |e: &Expectation| match e.places.as_slice() {
            [] => e.name.clone(),
            places => format!("{}.{}", e.name, places.join("-")),
        };
        let one = |e: &Expectation| Target {
            label: label(e),
            error: e.name.clone(),
            measured: e.measured,
            places: e.places.clone(),
            statistic: e.statistic,
            known: Some(e.value),
            scale: e.scale,
        };
        return known.iter().map(one).collect();
    }
    let mut targets = Vec::new();
    let mut add = |label: String, measured, places: Vec<String>, statistic| {
        targets.push(Target {
            error: label.clone(),
            label,
            measured,
            places,
            statistic,
            known: None,
            scale: None,
        });
    };
    for opening in &plan.openings {
        let places = vec![opening.name.clone()];
        if !matches!(opening.condition, Condition::Velocity { .. }) {
            add(format!("flow_{}", opening.name), Measured::Flow, places.clone(), Statistic::Mean);
        }
        if !matches!(opening.condition, Condition::Pressure { .. }) {
            add(format!("pressure_{}", opening.name), Measured::Pressure, places.clone(), Statistic::Mean);
            if plan.period.is_some() {
                let label = format!("peak_pressure_{}", opening.name);
                add(label, Measured::Pressure, places, Statistic::Maximum);
            }
        }
    }
    if plan.wall_metrics {
        add("wall_shear".into(), Measured::WallShear, Vec::new(), Statistic::Mean);
    }
    if plan.deforms() {
        add("displacement".into(), Measured::Displacement, Vec::new(), Statistic::Mean);
    }
    targets
}

/// The values of targets in the files of a run, NaN where there is none.
///
/// # Errors
/// When a file cannot be read.
pub(crate) fn values(
    out: &Path,
    summary: &Summary,
    plan: &Plan,
    targets: &[Target],
) -> Result<Vec<f64>, DriverError> {
    let openings = read_table(&out.join("openings.csv"))?;
    let has_probes = targets.iter().any(|t| t.measured == Measured::Speed);
    let probes = if has_probes { read_table(&out.join("probes.csv"))? } else { TableData::default() };
    let end = summary.time_s;
    let start = match plan.period.filter(|period| *period <= end) {
        Some(period) => end - period,
        None => (1.0 - LAST) * end,
    };
    let window = Window { start, end, period: plan.period };
    let wall = summary.wall.as_ref();
    let value = |target: &Target| {
        let column = |table: &TableData, place: usize, what: &str| {
            let name = format!("{}.{what}", target.places[place]);
            window.of(table, &name)
        };
        let series = match target.measured {
            Measured::Flow => column(&openings, 0, "flow_m3_s"),
            Measured::Pressure => column(&openings, 0, "pressure_pa"),
            Measured::PressureDrop => {
                difference(&column(&openings, 0, "pressure_pa"), &column(&openings, 1, "pressure_pa"))
            }
            Measured::Speed => {
                let [u, v, w] = ["u", "v", "w"].map(|axis| column(&probes, 0, &format!("{axis}_m_s")));
                magnitude(&u, &v, &w)
            }
            Measured::WallShear => {
                return wall.and_then(|w| w.tawss_pa.or(w.wss_pa)).map_or(f64::NAN, |stress| stress.mean);
            }
            Measured::Displacement => {
                let solid = summary.solid.as_ref().map(|s| s.max_displacement_m);
                return solid.or(summary.shell.as_ref().map(|s| s.max_displacement_m)).unwrap_or(f64::NAN);
            }
        };
        window.statistic(&series, target.statistic)
    };
    Ok(targets.iter().map(value).collect())
}

/// Points of time and value.
type Series = Vec<(f64, f64)>;

fn difference(a: &Series, b: &Series) -> Series {
    a.iter().zip(b).map(|(a, b)| (a.0, a.1 - b.1)).collect()
}

fn magnitude(x: &Series, y: &Series, z: &Series) -> Series {
    x.iter().zip(y).zip(z).map(|((x, y), z)| (x.0, (x.1 * x.1 + y.1 * y.1 + z.1 * z.1).sqrt())).collect()
}

/// The time that counts.
struct Window {
    start: f64,
    end: f64,
    period: Option<f64>,
}

impl Window {
    /// A column within the window.
    ///
    /// # Panics
    /// When the table has none of that name: it is of a run that has just been made for it.
    fn of(&self, table: &TableData, name: &str) -> Series {
        let column = |name: &str| {
            table.column(name).unwrap_or_else(|| panic!("the run has written a column `{name}`"))
        };
        let (time, value) = (column("time_s"), column(name));
        let slack = 1e-9 * self.end;
        let within = |t: f64| t > self.start + slack && t <= self.end + slack;
        time.into_iter().zip(value).filter(|(t, v)| within(*t) && v.is_finite()).collect()
    }

    fn statistic(&self, series: &Series, statistic: Statistic) -> f64 {
        if series.is_empty() {
            return f64::NAN;
        }
        let values = series.iter().map(|s| s.1);
        match statistic {
            Statistic::Mean => values.sum::<f64>() / series.len() as f64,
            Statistic::Minimum => values.fold(f64::INFINITY, f64::min),
            Statistic::Maximum => values.fold(f64::NEG_INFINITY, f64::max),
            Statistic::Amplitude => {
                let period = self.period.unwrap_or(self.end - self.start);
                let part = |f: fn(f64) -> f64| {
                    let sum: f64 =
                        series.iter().map(|(t, v)| v * f(std::f64::consts::TAU * t / period)).sum();
                    2.0 * sum / series.len() as f64
                };
                part(f64::cos).hypot(part(f64::sin))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_are_of_the_last_cycle() {
        let rows = (1..=400).map(|k| {
            let t = 0.01 * f64::from(k);
            let value = if t <= 3.0 { 100.0 } else { 2.0 + 3.0 * (std::f64::consts::TAU * t + 0.4).cos() };
            vec![t, value]
        });
        let table = TableData { header: vec!["time_s".into(), "a.b".into()], rows: rows.collect() };
        let window = Window { start: 3.0, end: 4.0, period: Some(1.0) };
        let series = window.of(&table, "a.b");
        assert_eq!(series.len(), 100);
        assert!((window.statistic(&series, Statistic::Mean) - 2.0).abs() < 1e-12);
        assert!((window.statistic(&series, Statistic::Amplitude) - 3.0).abs() < 1e-12);
        assert!((window.statistic(&series, Statistic::Maximum) - 5.0).abs() < 1e-2);
        assert!((window.statistic(&series, Statistic::Minimum) + 1.0).abs() < 1e-2);
        assert!(window.statistic(&Vec::new(), Statistic::Mean).is_nan());
    }
}

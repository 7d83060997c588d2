//! The page itself, from the results that are kept.

use std::fmt::Write;
use std::path::PathBuf;

use vaso_io::{StudyReport, StudyRun, StudyStatus};
use vaso_report::work_precision;

use super::{CASES, Studied};
use crate::root;

const HEAD: &str = "\
# What accuracy costs in time

Made by `cargo run --release -p vaso-tests --example accuracy`; do not edit. Each section is a `vaso study`, which anybody can run on
a case of theirs. Times are wall times of whole runs on two threads of a shared machine: they vary by a third from hour to hour,
their ratios less. But for `pipe` and `pipe-one-percent` they are too long, by up to a third where a wall deforms: those studies were run from outside of
the worker threads. The expected times of `carotid-walls` are those of the planner before its constants were fitted to them. How errors, orders and the grid convergence index are counted is in
[studies.md](studies.md) and in `crates/study`.
";

/// The file in which the results of a study are kept.
pub fn file(studied: &Studied) -> PathBuf {
    root().join("tests/accuracy").join(format!("{}.json", studied.name))
}

fn image(studied: &Studied) -> String {
    format!("images/accuracy-{}.svg", studied.name)
}

fn results() -> impl Iterator<Item = (&'static Studied, StudyReport)> {
    CASES.iter().filter_map(|s| Some((s, StudyReport::read(&file(s)).ok()?)))
}

/// The page, from what is kept.
pub fn render() -> String {
    let mut text = HEAD.to_owned();
    for (studied, report) in results() {
        text.push_str(&section(studied, &report));
    }
    text
}

/// Writes the page and its pictures.
///
/// # Panics
/// When they cannot be written.
pub fn write() {
    for (studied, report) in results() {
        std::fs::write(root().join("docs").join(image(studied)), work_precision(&report))
            .expect("it can be written");
    }
    std::fs::write(root().join("docs/accuracy.md"), render()).expect("it can be written");
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.2} %", 100.0 * share) } else { "–".into() }
}

fn section(studied: &Studied, report: &StudyReport) -> String {
    let mut text = format!(
        "\n## {} (`{}`)\n\n{}\n\n```sh\n{}\n```\n",
        report.case,
        studied.name,
        studied.remark,
        studied.command()
    );
    let _ = writeln!(
        text,
        "\n![error against time]({})\n\nErrors are counted from {}.\n",
        image(studied),
        report.reference
    );
    let names: Vec<&str> = report.errors.iter().map(|e| e.name.as_str()).collect();
    let _ = writeln!(
        text,
        "| run | particles | acoustic steps | wall time | expected | memory | {} |\n|---|---|---|---|---|---|{}",
        names.join(" | "),
        "---|".repeat(names.len())
    );
    for run in &report.runs {
        text.push_str(&row(run, &names, report));
    }
    if report.runs.iter().any(|run| run.wall_s.is_some() || run.wall_shear_correlation.is_some()) {
        text.push_str(&walls(report));
    }
    text.push_str("\nBold: no other run beats it in time and error.\n\n");
    for error in &report.errors {
        let _ = write!(text, "- `{}`: {}", error.name, error.trend);
        if let Some(uncertainty) = error.uncertainty {
            let _ = write!(text, "; uncertainty of the finest {}", percent(uncertainty));
        }
        if let Some(halving) = error.halving {
            let _ = write!(text, "; half the error costs {halving:.1} times the time");
        }
        for price in &error.prices {
            let _ = write!(
                text,
                "; {} takes {:.0} s at {:.3} mm{}",
                percent(price.error),
                price.wall_clock_s,
                1e3 * price.spacing_m,
                if price.is_extrapolated { " (outside of what was run)" } else { "" }
            );
        }
        text.push_str(".\n");
    }
    if let Some(goal) = &report.goal {
        let _ = writeln!(text, "\n**{}**: {}.", if goal.met { "Met" } else { "Not met" }, goal.verdict);
    }
    text
}

/// What the walls cost, and how alike the flows in them are.
fn walls(report: &StudyReport) -> String {
    let completed = || report.runs.iter().filter(|run| run.status == StudyStatus::Completed);
    let names: Vec<&str> = completed()
        .next()
        .map(|run| run.values.iter().map(|value| value.name.as_str()).collect())
        .unwrap_or_default();
    let mut text = format!(
        "\n| run | wall particles | time in the wall | wall shear stress, correlation | {} |\n|---|---|---|---|{}\n",
        names.join(" | "),
        "---|".repeat(names.len())
    );
    for run in completed() {
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            run.name,
            run.particles.wall + run.particles.shell,
            run.wall_s.map_or("–".into(), |s| format!("{s:.1} s")),
            run.wall_shear_correlation.map_or("–".into(), |r| format!("{r:.4}")),
            run.values.iter().map(|value| format!("{:.4e}", value.value)).collect::<Vec<_>>().join(" | ")
        );
    }
    text.push_str(
        "\nThe correlation is over the wall, by area, with the run of the ladder of spacings at the same spacing; values are in SI units.\n",
    );
    text
}

fn row(run: &StudyRun, names: &[&str], report: &StudyReport) -> String {
    if run.status != StudyStatus::Completed {
        let blank = "| – ".repeat(names.len());
        let why = run.message.as_deref().unwrap_or("").lines().next().unwrap_or("");
        return format!("| {} | {}: {why} | | | | {blank}|\n", run.name, run.status);
    }
    let name = if report.front.contains(&run.name) { format!("**{}**", run.name) } else { run.name.clone() };
    let errors: String = names.iter().map(|n| format!("{} | ", percent(run.error(n)))).collect();
    format!(
        "| {name} | {} | {} | {:.1} s | {:.1} s | {:.0} MB | {errors}\n",
        run.particles.total(),
        run.steps.acoustic,
        run.wall_clock_s,
        run.predicted_s,
        1e-6 * run.memory_bytes as f64,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_that_of_the_results() {
        let page = std::fs::read_to_string(root().join("docs/accuracy.md")).unwrap_or_default();
        assert_eq!(page, render(), "make it again with `just accuracy`");
    }
}

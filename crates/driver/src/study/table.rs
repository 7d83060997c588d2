//! What a study says on a terminal.

use crate::print::{duration, length};
use std::fmt::Write;
use vaso_io::{ErrorEntry, StudyReport, StudyRun, StudyStatus};

/// How a run ended, in a line.
pub(super) fn outcome(run: &StudyRun) -> String {
    match (run.status, &run.message) {
        (StudyStatus::Completed, _) => {
            format!("         {:.1} s, {} particles", run.wall_clock_s, run.particles.total())
        }
        (status, message) => format!("         {status}: {}", message.as_deref().unwrap_or("")),
    }
}

/// All runs, and what they tell.
pub(super) fn table(report: &StudyReport) -> String {
    let width = report.runs.iter().map(|run| run.name.len()).max().unwrap_or(0).max(4);
    let names: Vec<&str> = report.errors.iter().map(|e| e.name.as_str()).collect();
    let mut text = format!("\n{:<width$} {:>9} {:>9} {:>9}", "run", "particles", "steps", "seconds");
    for name in &names {
        let _ = write!(text, " {:>w$}", name, w = name.len().max(8));
    }
    text.push('\n');
    for run in &report.runs {
        let _ = write!(text, "{:<width$} ", run.name);
        if run.status != StudyStatus::Completed {
            let _ = writeln!(text, "{}", run.status);
            continue;
        }
        let _ =
            write!(text, "{:>9} {:>9} {:>9.1}", run.particles.total(), run.steps.acoustic, run.wall_clock_s);
        for name in &names {
            let _ = write!(text, " {:>w$}", percent(run.error(name)), w = name.len().max(8));
        }
        let front = if report.front.contains(&run.name) { "  *" } else { "" };
        let _ = writeln!(text, "{front}");
    }
    let _ = writeln!(text, "* no other run beats it in time and in `{}`\n", report.judged_by);
    let _ = writeln!(text, "errors are counted from {}", report.reference);
    for error in &report.errors {
        text.push_str(&law(error));
    }
    if let Some(goal) = &report.goal {
        let _ = writeln!(text, "goal     {}", goal.verdict);
    }
    for warning in &report.warnings {
        let _ = writeln!(text, "warning  {warning}");
    }
    text
}

fn law(error: &ErrorEntry) -> String {
    let mut text = format!("{:<12} {}", error.name, error.trend);
    if let Some(uncertainty) = error.uncertainty {
        let _ = write!(text, "; uncertainty of the finest {}", percent(uncertainty));
    }
    if let Some(halving) = error.halving {
        let _ = write!(text, "; half the error costs {halving:.1} times the time");
    }
    text.push('\n');
    for price in &error.prices {
        let _ = writeln!(
            text,
            "{:<12} {} takes {} at a spacing of {}{}",
            "",
            percent(price.error),
            duration(price.wall_clock_s),
            length(price.spacing_m),
            if price.is_extrapolated { ", outside of what was run" } else { "" }
        );
    }
    text
}

fn percent(share: f64) -> String {
    if share.is_finite() { format!("{:.2} %", 100.0 * share) } else { "-".into() }
}

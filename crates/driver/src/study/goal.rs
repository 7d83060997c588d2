//! `--error` and `--budget`: settings chosen from the laws that the ladder has shown, and run.

use super::analysis::trade;
use super::ladder::{SPACING, at_spacing};
use super::{Climb, Judged};
use crate::error::DriverError;
use vaso_io::{GoalEntry, StudyRun, StudyStatus};
use vaso_study::PowerLaw;

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// An error, as a share \[-\].
    Error(f64),
    /// A wall time \[s\].
    Budget(f64),
}

/// An error asked for counts as met between these parts of it.
const BAND: (f64, f64) = (0.5, 1.5);
/// What a rung of the ladder happens to meet with more than this part of it is followed by one run at the spacing of the law: who asks for two per
/// cent does not want three. More than one is not run for that, as half the spacing takes sixteen times as long.
const ENOUGH: f64 = 1.1;
/// Spacings tried for an error after the ladder.
const ATTEMPTS: usize = 4;
/// Part of the time left that a run is chosen for: laws of time are measured on a busy machine, and what runs over is lost.
const CAUTION: f64 = 0.85;
/// Spacings are not refined, nor made coarser, by more than this at once: laws do not hold that far.
const STRIDE: f64 = 2.0;

/// Pursues a goal with the runs there are, and tells what came of it.
pub(super) fn pursue(climb: &mut Climb, goal: Goal, judged: &Judged) -> Result<GoalEntry, DriverError> {
    match goal {
        Goal::Error(error) => pursue_error(climb, error, judged),
        Goal::Budget(budget) => pursue_budget(climb, budget, judged),
    }
}

fn pursue_error(climb: &mut Climb, error: f64, judged: &Judged) -> Result<GoalEntry, DriverError> {
    let within = |e: f64| e >= BAND.0 * error && e <= BAND.1 * error;
    for attempt in 0..ATTEMPTS {
        climb.analyse();
        let found = nearest(&climb.runs, error, judged).map(|run| run.error(judged.by));
        if found.is_some_and(|e| within(e) && (attempt > 0 || e <= ENOUGH * error)) {
            break;
        }
        let Some(spacing) = next_spacing(&climb.runs, error, judged) else { break };
        let variant = at_spacing(spacing);
        if climb.runs.iter().any(|run| run.name == variant.name) {
            break;
        }
        climb.run(&variant)?;
    }
    climb.analyse();
    let best = nearest(&climb.runs, error, judged);
    let met = best.is_some_and(|run| within(run.error(judged.by)));
    let percent = |e: f64| format!("{:.2} %", 100.0 * e);
    let verdict = match best {
        Some(run) if met => format!(
            "an error of {} was asked for: {} at a spacing of {:.4} mm, in {:.1} s",
            percent(error),
            percent(run.error(judged.by)),
            1e3 * run.spacing_m,
            run.wall_clock_s
        ),
        Some(run) => format!(
            "an error of {} was asked for and not met: the nearest is {}, at a spacing of {:.4} mm in {:.1} s; {}",
            percent(error),
            percent(run.error(judged.by)),
            1e3 * run.spacing_m,
            run.wall_clock_s,
            if run.error(judged.by) < error {
                "no coarser spacing could be run"
            } else {
                "the error does not fall as far with the spacings tried"
            }
        ),
        None => "no run has an error".to_owned(),
    };
    Ok(GoalEntry { error: Some(error), budget_s: None, run: best.map(|run| run.name.clone()), met, verdict })
}

/// The run whose error is nearest to the one asked for, by their ratio.
fn nearest<'a>(runs: &'a [StudyRun], error: f64, judged: &Judged) -> Option<&'a StudyRun> {
    let away = |run: &StudyRun| (run.error(judged.by) / error).ln().abs();
    let rungs = completed(runs).filter(|run| away(run).is_finite());
    rungs.min_by(|a, b| away(a).total_cmp(&away(b)))
}

fn completed(runs: &[StudyRun]) -> impl Iterator<Item = &StudyRun> {
    runs.iter().filter(|run| run.ladder == SPACING && run.status == StudyStatus::Completed)
}

/// The spacing at which the error is expected: by the two runs around it or nearest to it, or by the law of all.
fn next_spacing(runs: &[StudyRun], error: f64, judged: &Judged) -> Option<f64> {
    let mut points: Vec<(f64, f64)> = completed(runs)
        .map(|run| (run.spacing_m, run.error(judged.by)))
        .filter(|p| p.1.is_finite() && p.1 > 0.0)
        .collect();
    points.sort_by(|a, b| (a.1 / error).ln().abs().total_cmp(&(b.1 / error).ln().abs()));
    let local = PowerLaw::fit(points.get(..2)?).filter(|law| law.exponent > 0.3);
    let law = local.or_else(|| trade(runs, judged.by).map(|t| t.error))?;
    let from = points[0].0;
    let refused = |s: f64| {
        runs.iter()
            .any(|run| run.status != StudyStatus::Completed && run.spacing_m <= s && run.spacing_m > from)
    };
    let spacing = law.solve(error)?.clamp(from / STRIDE, from * STRIDE);
    // Between what ran and what was refused there is still room.
    Some(if refused(spacing) { (from * spacing).sqrt() } else { spacing })
}

fn pursue_budget(climb: &mut Climb, budget: f64, judged: &Judged) -> Result<GoalEntry, DriverError> {
    climb.analyse();
    let left = budget - climb.seconds();
    let times: Vec<(f64, f64)> = completed(&climb.runs).map(|r| (r.spacing_m, r.wall_clock_s)).collect();
    let finest = times.iter().map(|t| t.0).fold(f64::INFINITY, f64::min);
    let law = PowerLaw::fit(&times);
    let chosen = law.filter(|law| law.exponent < -0.05).and_then(|law| law.solve(CAUTION * left));
    let mut tried = None;
    if let Some(spacing) = chosen.filter(|_| left > 0.0).map(|s| s.max(finest / STRIDE))
        && spacing < finest
    {
        let variant = at_spacing(spacing);
        climb.run(&variant)?;
        climb.analyse();
        tried = Some(variant.name);
    }
    let used = climb.seconds();
    let best = completed(&climb.runs).min_by(|a, b| a.spacing_m.total_cmp(&b.spacing_m));
    let met = best.is_some() && used <= budget;
    let verdict = match (best, &tried) {
        (Some(run), _) => format!(
            "{budget:.0} s were given, {used:.1} s used: a spacing of {:.4} mm, error {}",
            1e3 * run.spacing_m,
            match run.error(judged.by) {
                e if e.is_finite() => format!("{:.2} %", 100.0 * e),
                _ => "not known, as it is what the others are counted from".to_owned(),
            }
        ),
        (None, _) => "no run came to its end".to_owned(),
    };
    Ok(GoalEntry { error: None, budget_s: Some(budget), run: best.map(|run| run.name.clone()), met, verdict })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::analysis::WORST;
    use vaso_io::NamedValue;

    fn run(spacing: f64, error: f64) -> StudyRun {
        StudyRun {
            ladder: SPACING.into(),
            spacing_m: spacing,
            wall_clock_s: spacing.powi(-4),
            errors: vec![NamedValue { name: WORST.into(), value: error }],
            ..StudyRun::default()
        }
    }

    #[test]
    fn the_next_spacing_follows_the_runs_nearest_to_the_error() {
        let judged = Judged { by: WORST };
        let runs = [run(2.0, 0.08), run(1.5, 0.045), run(1.0, 0.02)];
        let next = next_spacing(&runs, 0.01, &judged).expect("a law");
        assert!((next - 0.5f64.sqrt()).abs() < 1e-9, "{next}");
        assert!((next_spacing(&runs, 1e-4, &judged).expect("a law") - 0.5).abs() < 1e-9, "a stride at most");
        assert_eq!(nearest(&runs, 0.04, &judged).map(|r| r.spacing_m), Some(1.5));
    }
}

//! From the values of runs to errors, orders and prices.

use super::ladder::SPACING;
use super::measure::Target;
use vaso_io::{ErrorEntry, NamedValue, PriceEntry, StudyRun, StudyStatus};
use vaso_scene::Measured;
use vaso_study::{Convergence, Trade, Trend, convergence, pareto};

/// Name of the largest of all errors.
pub(super) const WORST: &str = "worst";
/// Errors whose price is told.
const PRICED: [f64; 3] = [0.05, 0.02, 0.01];
/// Errors below this are rounding and noise, not a law.
const LEAST: f64 = 1e-9;

/// What the errors of a target are counted from.
struct Reference {
    value: f64,
    scale: f64,
    convergence: Option<Convergence>,
    /// The run whose own value it is, which has no error then.
    own: Option<usize>,
}

/// Fills in the errors of all runs, and tells what the ladder of spacings says of each.
pub(super) fn analyse(runs: &mut [StudyRun], targets: &[Target]) -> Vec<ErrorEntry> {
    let references: Vec<Reference> = (0..targets.len()).map(|k| reference(runs, targets, k)).collect();
    let names = names(targets);
    for (index, run) in runs.iter_mut().enumerate() {
        run.errors = if run.status == StudyStatus::Completed {
            errors(index, run, targets, &references, &names)
        } else {
            Vec::new()
        };
    }
    let parts = names.iter().map(|name| {
        let alone: Vec<&Reference> =
            targets.iter().zip(&references).filter(|(t, _)| t.error == *name).map(|(_, r)| r).collect();
        // Errors against a run of the ladder itself fall as it is neared, at whatever order: no law is read off them.
        let has_law = alone.iter().all(|r| r.own.is_none());
        entry(runs, name, alone.first().and_then(|r| r.convergence), has_law)
    });
    let mut entries: Vec<ErrorEntry> = parts.collect();
    entries.push(entry(runs, WORST, None, references.iter().all(|r| r.own.is_none())));
    entries
}

/// Names of errors, each once, in order.
pub(super) fn names(targets: &[Target]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for target in targets {
        if !names.contains(&target.error) {
            names.push(target.error.clone());
        }
    }
    names
}

/// Indices of the completed runs of the ladder of spacings, finest first.
fn rungs(runs: &[StudyRun]) -> Vec<usize> {
    let mut rungs: Vec<usize> = (0..runs.len())
        .filter(|&k| runs[k].ladder == SPACING && runs[k].status == StudyStatus::Completed)
        .collect();
    rungs.sort_by(|&a, &b| runs[a].spacing_m.total_cmp(&runs[b].spacing_m));
    rungs
}

fn reference(runs: &[StudyRun], targets: &[Target], k: usize) -> Reference {
    let target = &targets[k];
    let rungs = rungs(runs);
    let largest = |value: &dyn Fn(usize) -> f64| {
        let alike = (0..targets.len()).filter(|&j| match target.known {
            Some(_) => targets[j].error == target.error,
            None => targets[j].measured == target.measured,
        });
        alike.map(|j| value(j).abs()).fold(0.0, f64::max)
    };
    if let Some(value) = target.known {
        let scale = target.scale.unwrap_or_else(|| largest(&|j| targets[j].known.unwrap_or(0.0)));
        return Reference { value, scale, convergence: None, own: None };
    }
    let Some(&finest) = rungs.first() else {
        return Reference { value: f64::NAN, scale: f64::NAN, convergence: None, own: None };
    };
    let at = |run: usize, target: usize| runs[run].values[target].value;
    let convergence = match rungs[..] {
        [a, b, c, ..] => convergence([a, b, c].map(|r| runs[r].spacing_m), [a, b, c].map(|r| at(r, k))),
        _ => None,
    };
    let (value, own) = match convergence {
        Some(Convergence { trend: Trend::Monotonic(_), extrapolated, .. }) => (extrapolated, None),
        _ => (at(finest, k), Some(finest)),
    };
    // Shares of the largest of their kind: a small branch is not to rule the study. Of a wall there is one number only.
    let scale = match target.measured {
        Measured::Flow | Measured::Pressure => largest(&|j| at(finest, j)),
        _ => value.abs(),
    };
    Reference { value, scale, convergence, own }
}

fn errors(
    index: usize,
    run: &StudyRun,
    targets: &[Target],
    references: &[Reference],
    names: &[String],
) -> Vec<NamedValue> {
    let mut errors: Vec<NamedValue> = names
        .iter()
        .map(|name| {
            let parts: Vec<f64> = (0..targets.len())
                .filter(|&k| targets[k].error == *name)
                .map(|k| match references[k].own {
                    Some(own) if own == index => f64::NAN,
                    _ => (run.values[k].value - references[k].value) / references[k].scale,
                })
                .collect();
            let square = parts.iter().map(|e| e * e).sum::<f64>() / parts.len() as f64;
            NamedValue { name: name.clone(), value: square.sqrt() }
        })
        .collect();
    // NaN where one has no error: the worst of the others would look better than it is known to be.
    let worst = errors.iter().map(|e| e.value).fold(0.0, |a: f64, b| if b.is_nan() { b } else { a.max(b) });
    errors.push(NamedValue { name: WORST.into(), value: worst });
    errors
}

/// The laws of an error along the ladder of spacings.
pub(super) fn trade(runs: &[StudyRun], name: &str) -> Option<Trade> {
    let points: Vec<(f64, f64, f64)> = rungs(runs)
        .into_iter()
        .map(|k| (runs[k].spacing_m, runs[k].wall_clock_s, runs[k].error(name)))
        .filter(|p| p.2 > LEAST)
        .collect();
    Trade::new(&points)
}

fn entry(runs: &[StudyRun], name: &str, convergence: Option<Convergence>, has_law: bool) -> ErrorEntry {
    let trade = trade(runs, name).filter(|_| has_law);
    let prices = PRICED.iter().filter_map(|&error| {
        let price = trade.as_ref()?.of_error(error)?;
        Some(PriceEntry {
            error,
            spacing_m: price.spacing,
            wall_clock_s: price.time,
            is_extrapolated: price.is_extrapolated,
        })
    });
    let trend = match (convergence.map(|c| c.trend), &trade) {
        (Some(Trend::Monotonic(p)), _) => format!("the values converge at order {p:.2}"),
        (Some(Trend::Oscillating), _) => "the values swing with the spacing: no order can be told".into(),
        (Some(Trend::Unclear(Some(p))), _) => {
            format!("the values go together at order {p:.2}, outside of 0.5 to 3: none is relied on")
        }
        (Some(Trend::Unclear(None)), _) => {
            "the values do not converge as those of a scheme of an order would".into()
        }
        (None, Some(trade)) => format!("the error falls at order {:.2}", trade.error.exponent),
        (None, None) if !has_law => "counted from the finest run in part: no law is told".into(),
        (None, None) => "the error does not fall along the ladder, or too few runs tell".into(),
    };
    ErrorEntry {
        name: name.to_owned(),
        order: trade.as_ref().map(|t| t.error.exponent),
        time_exponent: trade.as_ref().map(|t| t.time.exponent),
        halving: trade.as_ref().map(Trade::of_halving),
        uncertainty: convergence.map(|c| c.uncertainty),
        trend,
        prices: prices.collect(),
    }
}

/// Names of the runs that no other beats, by growing time.
pub(super) fn front(runs: &[StudyRun], judged_by: &str) -> Vec<String> {
    let points: Vec<(f64, f64)> = runs
        .iter()
        .map(|run| match run.status {
            StudyStatus::Completed => (run.wall_clock_s, run.error(judged_by)),
            _ => (f64::NAN, f64::NAN),
        })
        .collect();
    pareto(&points).into_iter().map(|k| runs[k].name.clone()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_scene::Statistic;

    fn target(error: &str, known: Option<f64>) -> Target {
        Target {
            label: error.into(),
            error: error.into(),
            measured: Measured::Pressure,
            places: vec![],
            statistic: Statistic::Mean,
            known,
            scale: None,
        }
    }

    fn run(spacing: f64, values: &[f64]) -> StudyRun {
        StudyRun {
            name: format!("{spacing}"),
            ladder: SPACING.into(),
            spacing_m: spacing,
            wall_clock_s: spacing.powi(-4),
            values: values.iter().map(|&value| NamedValue { name: String::new(), value }).collect(),
            ..StudyRun::default()
        }
    }

    #[test]
    fn known_values_give_errors_with_their_order_and_price() {
        let targets = [target("p", Some(2.0)), target("p", Some(-1.0))];
        let of = |h: f64| run(h, &[2.0 + 0.04 * h * h, -1.0 + 0.04 * h * h]);
        let mut runs = [of(2.0), of(1.5), of(1.0)];
        let entries = analyse(&mut runs, &targets);
        assert!((runs[2].error("p") - 0.02).abs() < 1e-12 && (runs[0].error(WORST) - 0.08).abs() < 1e-12);
        let p = &entries[0];
        assert!(
            (p.order.expect("it falls") - 2.0).abs() < 1e-9 && (p.halving.expect("so") - 4.0).abs() < 1e-9
        );
        assert!((p.prices[0].spacing_m - 2.5f64.sqrt()).abs() < 1e-9, "{:?}", p.prices);
        assert_eq!(front(&runs, WORST), ["2", "1.5", "1"]);
    }

    #[test]
    fn unknown_values_are_counted_from_where_they_converge() {
        let of = |h: f64| run(h, &[10.0 - 0.3 * h.powf(1.5)]);
        let mut runs = [of(1.69), of(1.3), of(1.0)];
        let entries = analyse(&mut runs, &[target("p", None)]);
        assert!(entries[0].trend.contains("order 1.50"), "{}", entries[0].trend);
        // Of the finest value, as everything of its kind.
        assert!((runs[2].error("p") - 0.3 / 9.7).abs() < 1e-6, "{:?}", runs[2].errors);
    }

    #[test]
    fn what_swings_is_counted_from_the_finest_which_has_no_error_then() {
        let mut runs = [run(1.69, &[1.0]), run(1.3, &[1.2]), run(1.0, &[1.1])];
        let entries = analyse(&mut runs, &[target("p", None)]);
        assert!(runs[2].error("p").is_nan() && (runs[1].error("p") - 0.1 / 1.1).abs() < 1e-12);
        assert!(
            entries[0].trend.contains("swing") && entries[0].order.is_none() && entries[0].prices.is_empty()
        );
        assert!(entries[1].order.is_none(), "nor is the worst of it told");
        assert!((entries[0].uncertainty.expect("half the range") - 0.1 / 1.1).abs() < 1e-12);
    }

    #[test]
    fn runs_that_broke_have_no_errors_and_no_part_in_the_front() {
        let mut broken = run(1.0, &[]);
        broken.status = StudyStatus::Failed;
        let mut runs = [run(2.0, &[1.0]), broken];
        analyse(&mut runs, &[target("p", Some(2.0))]);
        assert!(runs[1].errors.is_empty() && front(&runs, WORST) == ["2"]);
    }
}

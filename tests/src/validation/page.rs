//! `docs/validation.md` and the results it is made from.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use super::{CASES, Figure, Outcome, Tolerance, Unit};
use crate::root;

/// Outcomes by the name of their case.
pub type Results = BTreeMap<String, Outcome>;

/// File of the results.
pub fn results_file() -> PathBuf {
    root().join("tests/validation/results.json")
}

/// The results kept so far.
///
/// # Panics
/// When the file is not what [`save`] writes.
pub fn load() -> Results {
    match std::fs::read_to_string(results_file()) {
        Ok(text) => serde_json::from_str(&text).expect("results are written by `save`"),
        Err(_) => Results::new(),
    }
}

/// Keeps results.
///
/// # Panics
/// When they cannot be written.
pub fn save(results: &Results) {
    let text = serde_json::to_string_pretty(results).expect("numbers and text have a JSON form");
    std::fs::write(results_file(), text + "\n").expect("the folder of results can be written to");
}

/// What nothing on the page shows.
const LIMITS: &str = "\
- **Walls that move.** All is rigid but for one elastic tube and the walls of two persons, and of those only how far a stretch that is
  nearly a tube widens is held against a formula. More of walls is in the tests of `crates/solid`, `crates/shell` and `tests/src/flows`.
- **Vessels of persons.** All else that has been run are round pipes and a bifurcation made from numbers. The carotid and the
  aorta of a person are held against what their outlets have to reach, the flow within them against no measurement.
- **Turbulence.** There is no turbulence model. At the peak of its beat the aorta has a Reynolds number of 6700, at which its jet
  would be turbulent; no figure here shows what is missed by that.
- **Spacings other than these.** Errors are those of ten to twenty particles across. A branch four particles wide has none
  of them.
- **Wall shear stress on a wall that is not straight.** On exact velocities it is tested in `crates/metrics`; out of a run
  only in a pipe.
- **Long runs.** Three seconds and two beats at most. A slow drift of the number of particles would not show.
- **Outlets as a person has them.** That a Windkessel is solved exactly says nothing about its parameters.
- **Parts that agree by construction.** The pressure at a single outlet model is its own equation under the flow that
  leaves, and the flow at a velocity inlet is imposed: these figures hold the coupling, not the flow in between.
";

/// The page.
pub fn render(results: &Results) -> String {
    let mut page = String::from(
        "# Validation\n\n\
         Made by `cargo run --release -p vaso-tests --example validation` from `tests/validation/results.json`; do not\n\
         edit. Cases named behind `--` are run anew first, all of them with `all`.\n\n\
         D/n is a spacing of an nth of the diameter. Errors have a sign where one has a meaning. A tolerance in brackets is\n\
         not asked for: nothing is at that resolution, and the tests hold what was measured with a little room. Times are\n\
         those of the loop on a machine busy with other work, up to five times those of a quiet one. The same cases run\n\
         coarser and shorter with the tests (`tests/src/flows/validation.rs`).\n",
    );
    page += "\n| case | figures | within what is asked | missed | largest number of particles | time |\n|---|---|---|---|---|---|\n";
    for case in CASES {
        let Some(outcome) = results.get(case.name) else {
            writeln!(page, "| [{}](#{}) | not run | | | | |", case.title, case.name).expect("a string");
            continue;
        };
        let asked = |f: &&Figure| !matches!(f.tolerance, Tolerance::Held(_));
        let n_asked = outcome.figures.iter().filter(asked).count();
        let missed = outcome.figures.iter().filter(|f| is_missed(f)).count();
        writeln!(
            page,
            "| [{}](#{}) | {} | {} of {n_asked} | {missed} | {} | {} |",
            case.title,
            case.name,
            outcome.figures.len(),
            n_asked - missed,
            outcome.particles,
            if outcome.run_before.is_some() { "run before the present scheme".into() } else { time(outcome) }
        )
        .expect("a string");
    }
    for case in CASES {
        write!(
            page,
            "\n## {}\n\n{}.\n\n{}\n\nReference: {}\n\n{}\n\n",
            case.name,
            case.title,
            wrap(case.setup),
            wrap(case.reference),
            wrap(case.remark)
        )
        .expect("a string");
        let Some(outcome) = results.get(case.name) else {
            page += "Not run yet.\n";
            continue;
        };
        if let Some(change) = &outcome.run_before {
            write!(page, "**Run before {change}, and not again since.**\n\n").expect("a string");
        }
        page += "| figure | error | tolerance | |\n|---|---|---|---|\n";
        for figure in &outcome.figures {
            let (tolerance, verdict) = judged(figure);
            writeln!(page, "| {} | {} | {tolerance} | {verdict} |", figure.what, shown(figure))
                .expect("a string");
        }
    }
    page + "\n## What this does not prove\n\n" + LIMITS
}

fn is_missed(figure: &Figure) -> bool {
    match figure.tolerance {
        Tolerance::Missed { asked, .. } => figure.error.abs() > asked,
        Tolerance::TooLow { asked, .. } => figure.error < asked,
        Tolerance::Held(_) => false,
        _ => !figure.holds(),
    }
}

fn time(outcome: &Outcome) -> String {
    let threads =
        if outcome.threads == 1 { "1 thread".to_owned() } else { format!("{} threads", outcome.threads) };
    if outcome.seconds < 1.0 { "below 1 s".into() } else { format!("{:.0} s, {threads}", outcome.seconds) }
}

fn shown(figure: &Figure) -> String {
    let error = figure.error;
    match figure.unit {
        Unit::Part if error != 0.0 && error.abs() < 1e-4 => format!("{error:.0e}"),
        Unit::Part => format!("{:+.2} %", 100.0 * error).replace("+0.00 %", "0.00 %"),
        Unit::Degree => format!("{error:+.2}°"),
        Unit::Number if error.fract() == 0.0 => format!("{error:.0}"),
        Unit::Number => format!("{error:.3}"),
    }
}

fn judged(figure: &Figure) -> (String, &'static str) {
    let bound = |value: f64| match figure.unit {
        Unit::Part if value < 1e-4 => format!("{value:.0e}"),
        Unit::Part => format!("{} %", trimmed(100.0 * value)),
        Unit::Degree => format!("{}°", trimmed(value)),
        Unit::Number => trimmed(value),
    };
    match figure.tolerance {
        Tolerance::Asked(asked) => (bound(asked), if figure.holds() { "met" } else { "**missed**" }),
        Tolerance::AtLeast(asked) => {
            (format!("at least {}", bound(asked)), if figure.holds() { "met" } else { "**missed**" })
        }
        Tolerance::Held(held) => (format!("({})", bound(held)), ""),
        Tolerance::TooLow { asked, held } => (
            format!("at least {asked} (held at {held})"),
            if is_missed(figure) { "**missed**" } else { "met" },
        ),
        Tolerance::Missed { asked, held } => {
            let met = if is_missed(figure) { "**missed**" } else { "met" };
            (format!("{} (held at {})", bound(asked), bound(held)), met)
        }
    }
}

/// A number without trailing zeros.
fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Text in lines of at most 120 characters.
fn wrap(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().expect("there is a line");
        if line.len() + 1 + word.len() > 118 && !line.is_empty() {
            lines.push(word.to_owned());
        } else {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page is what its results make, so neither can be changed by hand alone.
    #[test]
    fn the_page_is_that_of_the_results() {
        let page = std::fs::read_to_string(root().join("docs/validation.md")).expect("the page is there");
        assert!(
            page == render(&load()),
            "make it anew: cargo run --release -p vaso-tests --example validation"
        );
    }
}

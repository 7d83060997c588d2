//! `docs/stability.md` and the results it is made from.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::PathBuf;

use super::{CASES, Held};
use crate::root;
use crate::validation::{Figure, Outcome, Tolerance, Unit};

/// Outcomes by the number of their case.
pub type Results = BTreeMap<String, Outcome>;

fn file() -> PathBuf {
    root().join("tests/stability/results.json")
}

/// The results kept so far.
///
/// # Panics
/// When the file is not what [`save`] writes.
pub fn load() -> Results {
    match std::fs::read_to_string(file()) {
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
    std::fs::write(file(), text + "\n").expect("the folder of results can be written to");
}

const HEAD: &str = "\
# Hard cases

Made by `cargo run --release -p vaso-tests --example stability`; do not edit. What usually breaks codes of this kind, how it is set
up here, and how far from the bound it stays. Every run also ends in finite numbers, which is not repeated below. The runs are coarse
enough for each change to be tested by them (`tests/src/flows/stability.rs`): they show that nothing breaks, not that it is accurate.
";

/// The page.
pub fn render(results: &Results) -> String {
    let mut page = HEAD.to_owned();
    for hard in CASES {
        let _ = write!(page, "\n## {}: {}\n\nBreaks codes by: {}\n\n", hard.id, hard.title, hard.breaks);
        match &hard.held {
            Held::Elsewhere(text) => {
                let _ = writeln!(page, "Held by {text}.");
            }
            Held::Here(setup, _) => {
                let _ = writeln!(page, "{setup}\n");
                match results.get(hard.id) {
                    Some(outcome) => page.push_str(&table(outcome)),
                    None => page.push_str("Not run yet.\n"),
                }
            }
        }
    }
    page
}

fn number(value: f64, unit: Unit) -> String {
    match unit {
        Unit::Part => format!("{:.2} %", 100.0 * value),
        Unit::Degree => format!("{value:.2} degrees"),
        Unit::Number => format!("{value:.3}").trim_end_matches('0').trim_end_matches('.').to_owned(),
    }
}

fn table(outcome: &Outcome) -> String {
    let mut text = String::from("| what | measured | bound | |\n|---|---|---|---|\n");
    for figure in &outcome.figures {
        text.push_str(&row(figure));
    }
    let _ = writeln!(
        text,
        "\n{} particles, {:.0} s on {} threads.",
        outcome.particles, outcome.seconds, outcome.threads
    );
    text
}

fn row(figure: &Figure) -> String {
    let Figure { what, error, unit, tolerance } = figure;
    let bound = match *tolerance {
        Tolerance::Asked(bound) | Tolerance::Held(bound) => format!("at most {}", number(bound, *unit)),
        Tolerance::AtLeast(bound) => format!("at least {}", number(bound, *unit)),
        Tolerance::TooLow { asked, held } => {
            format!("at least {}, held at {}", number(asked, *unit), number(held, *unit))
        }
        Tolerance::Missed { asked, held } => {
            format!("at most {}, held at {}", number(asked, *unit), number(held, *unit))
        }
    };
    let verdict = match tolerance {
        Tolerance::Missed { asked, .. } if error.abs() > *asked => "missed",
        Tolerance::TooLow { asked, .. } if error < asked => "missed",
        _ if figure.holds() => "",
        _ => "**broken**",
    };
    format!("| {what} | {} | {bound} | {verdict} |\n", number(*error, *unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_that_of_the_results() {
        let page = std::fs::read_to_string(root().join("docs/stability.md")).unwrap_or_default();
        assert_eq!(page, render(&load()), "make it again with `just stability`");
    }
}

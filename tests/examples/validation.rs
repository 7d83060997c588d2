//! Writes `docs/validation.md`. Cases named as arguments are run before, all of them with `all`:
//! `cargo run --release -p vaso-tests --example validation -- poiseuille ends`. Those on outside data want `VASO_DATA`.
//! With `--quick` the quick versions that the tests run are run instead, and only printed.

use std::process::ExitCode;

use vaso_tests::validation::{CASES, case, page};
use vaso_tests::{among_workers, root};

fn main() -> ExitCode {
    among_workers(make)
}

fn make() -> ExitCode {
    let mut asked: Vec<String> = std::env::args().skip(1).collect();
    let quick = asked.iter().any(|a| a == "--quick");
    asked.retain(|a| a != "--quick");
    if asked == ["all"] {
        asked = CASES.iter().map(|c| c.name.to_owned()).collect();
    }
    for name in &asked {
        let Some(case) = case(name) else {
            eprintln!(
                "no case \"{name}\"; there are: {}",
                CASES.iter().map(|c| c.name).collect::<Vec<_>>().join(", ")
            );
            return ExitCode::FAILURE;
        };
        println!("{name}");
        let run = if quick { case.quick } else { Some(case.full) };
        let Some(outcome) = run.and_then(|run| run()) else { continue };
        for figure in &outcome.figures {
            println!(
                "  {}: {:+.5} {}",
                figure.what,
                figure.error,
                if figure.holds() { "" } else { "MISSED" }
            );
        }
        println!("  {} particles, {:.0} s", outcome.particles, outcome.seconds);
        if quick {
            continue;
        }
        // Read anew: another run may have added its own meanwhile.
        let mut results = page::load();
        results.insert(name.clone(), outcome);
        page::save(&results);
    }
    if quick {
        return ExitCode::SUCCESS;
    }
    std::fs::write(root().join("docs/validation.md"), page::render(&page::load()))
        .expect("the page can be written");
    ExitCode::SUCCESS
}

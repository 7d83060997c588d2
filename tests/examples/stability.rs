//! Writes `docs/stability.md`. Hard cases named as arguments are run before, all of them with `all`:
//! `cargo run --release -p vaso-tests --example stability -- H1 H14`.

use std::process::ExitCode;

use vaso_tests::stability::{CASES, Held, hard, page};
use vaso_tests::{among_workers, root};

fn main() -> ExitCode {
    among_workers(make)
}

fn make() -> ExitCode {
    let mut asked: Vec<String> = std::env::args().skip(1).collect();
    if asked == ["all"] {
        asked = CASES.iter().map(|c| c.id.to_owned()).collect();
    }
    for id in &asked {
        let Some(hard) = hard(id) else {
            eprintln!("no hard case \"{id}\"; there are H1 to H{}", CASES.len());
            return ExitCode::FAILURE;
        };
        let Held::Here(_, run) = hard.held else { continue };
        println!("{id}: {}", hard.title);
        let Some(outcome) = run() else { continue };
        for figure in &outcome.figures {
            println!(
                "  {}: {:+.5} {}",
                figure.what,
                figure.error,
                if figure.holds() { "" } else { "BROKEN" }
            );
        }
        println!("  {} particles, {:.0} s", outcome.particles, outcome.seconds);
        // Read anew: another run may have added its own meanwhile.
        let mut results = page::load();
        results.insert(id.clone(), outcome);
        page::save(&results);
    }
    std::fs::write(root().join("docs/stability.md"), page::render(&page::load()))
        .expect("the page can be written");
    ExitCode::SUCCESS
}

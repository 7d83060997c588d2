//! Writes `docs/accuracy.md`: what accuracy costs in time. Cases named as arguments are studied before, `all` for all:
//! `cargo run --release -p vaso-tests --example accuracy -- pipe carotid`. Their results are kept in `tests/accuracy`.

use std::path::Path;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;

use vaso_driver::Case;
use vaso_driver::run::Talk;
use vaso_driver::study::{StudyRequest, study};
use vaso_tests::accuracy::{CASES, Studied, page};
use vaso_tests::{among_workers, root};

fn main() -> ExitCode {
    among_workers(make)
}

fn make() -> ExitCode {
    let mut asked: Vec<String> = std::env::args().skip(1).collect();
    if asked == ["all"] {
        asked = CASES.iter().map(|c| c.name.to_owned()).collect();
    }
    for name in &asked {
        let Some(studied) = CASES.iter().find(|c| c.name == name) else {
            eprintln!(
                "no study \"{name}\"; there are: {}",
                CASES.iter().map(|c| c.name).collect::<Vec<_>>().join(", ")
            );
            return ExitCode::FAILURE;
        };
        if let Err(error) = run(studied) {
            eprintln!("error: {error}");
            return ExitCode::FAILURE;
        }
    }
    page::write();
    ExitCode::SUCCESS
}

fn run(studied: &Studied) -> Result<(), vaso_driver::DriverError> {
    let case = Case::load(&root().join(studied.case), &studied.settings())?;
    let request =
        StudyRequest { wish: studied.wish(), goal: studied.goal, repeat: 1, ..StudyRequest::default() };
    let out = root().join("target/accuracy").join(studied.name);
    let report = study(&case, &request, &out, true, &AtomicBool::new(false), &Talk { quiet: false })?;
    report.write(Path::new(&page::file(studied)))?;
    Ok(())
}

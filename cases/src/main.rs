//! Writes surfaces and waveforms of the shipped cases: `cargo run -p vaso-cases`.

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    match vaso_cases::write(Path::new(env!("CARGO_MANIFEST_DIR"))) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

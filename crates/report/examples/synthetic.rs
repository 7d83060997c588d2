//! Writes the made-up run of the tests and its report, to look at them without computing a flow.
//!
//! `cargo run --release -p vaso-report --example synthetic -- OUT`

#[path = "../tests/synthetic/mod.rs"]
mod synthetic;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = std::env::args().nth(1).ok_or("usage: synthetic OUT")?;
    std::fs::create_dir_all(&out)?;
    synthetic::write(std::path::Path::new(&out))?;
    vaso_report::write_report(std::path::Path::new(&out))?;
    Ok(())
}

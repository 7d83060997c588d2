//! Writes `docs/generators.md` and its pictures: what the generators of particles make, how good and how dear it is.
//!
//! `cargo run --release -p vaso-tests --example generators`; some minutes on two cores, most of them for the flows. With
//! numbers as arguments only those particles across the pipe are run.

fn main() -> std::io::Result<()> {
    let asked: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    vaso_tests::generators::write(if asked.is_empty() { &[10.0, 16.0] } else { &asked })
}

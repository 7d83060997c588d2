//! Writes `docs/figures.md`: the pipe against its formula, and the speed on this machine.
//!
//! `cargo run --release -p vaso-tests --example figures > docs/figures.md`; about a quarter of an hour on
//! two cores. With numbers as arguments only those particles across the pipe are run:
//! `docs/figures.md` holds 10, 16 and 20, `docs/figures-30.md` the finest.

fn main() {
    let asked: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    vaso_tests::figures::print(if asked.is_empty() { &[10.0, 16.0, 20.0, 30.0] } else { &asked });
}

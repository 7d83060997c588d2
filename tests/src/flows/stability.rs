//! The hard cases of `docs/stability.md`; figures are printed with `-- --nocapture`.

use crate::stability::{Held, hard};

/// Runs a hard case, and holds every figure to its bound.
fn check(id: &str) {
    let Held::Here(_, run) = hard(id).expect("it is in the list").held else {
        panic!("{id} is held elsewhere")
    };
    let Some(outcome) = run() else { return };
    println!("{id}: {} particles, {:.0} s", outcome.particles, outcome.seconds);
    for figure in &outcome.figures {
        println!("  {figure:?}");
    }
    let off: Vec<_> = outcome.figures.iter().filter(|f| !f.holds()).collect();
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn backflow_at_a_pressure_outlet_brings_blood_of_its_own_speed() {
    check("H1");
}

#[test]
fn a_wall_thinner_than_the_spacing_does_not_leak() {
    check("H2");
}

#[test]
fn lumens_side_by_side_do_not_feel_each_other() {
    check("H3");
}

#[test]
fn a_sudden_stop_tears_no_void() {
    check("H5");
}

#[test]
fn the_jet_of_a_stenosis_is_whole() {
    check("H6");
}

#[test]
fn nothing_enters_a_flow_divider() {
    check("H7");
}

#[test]
fn an_outlet_too_small_for_the_spacing_is_told() {
    check("H10");
}

#[test]
fn an_abrupt_onset_is_a_water_hammer_and_no_more() {
    check("H14");
}

#[test]
fn a_start_far_from_the_outlet_settles() {
    check("H15");
}

#[test]
fn a_closed_outlet_stays_closed_and_nothing_piles_up() {
    check("H16");
}

#[test]
fn many_cycles_do_not_drift() {
    check("H18");
}

#[test]
fn viscous_and_thin_blood_run() {
    check("H19");
}

//! The quick runs of the cases of `docs/validation.md`; figures are printed with `-- --nocapture`.

use crate::poiseuille;
use crate::validation::case;

/// Runs the quick version of a case, and holds every figure to its tolerance.
fn check(name: &str) {
    let run = case(name).and_then(|c| c.quick).expect("the case has a quick run");
    let Some(outcome) = run() else { return };
    println!("{name}: {} particles, {:.0} s", outcome.particles, outcome.seconds);
    for figure in &outcome.figures {
        println!("  {figure:?}");
    }
    let off: Vec<_> = outcome.figures.iter().filter(|f| !f.holds()).collect();
    assert!(off.is_empty(), "{off:#?}");
}

#[test]
fn outlet_models_alone_are_exact() {
    check("windkessel");
}

#[test]
fn a_pipe_carries_poiseuille_flow() {
    check("poiseuille");
}

#[test]
fn the_pressure_is_right_up_to_the_caps() {
    check("ends");
}

#[test]
fn a_pressure_sets_the_flow_of_the_series_going() {
    check("start-up");
}

#[test]
fn an_oscillating_pressure_drives_the_flow_of_womersley() {
    check("womersley");
}

#[test]
fn a_turned_or_moved_pipe_has_the_same_flow() {
    check("frames");
}

#[test]
fn a_resistance_has_the_pressure_of_its_flow() {
    check("resistance");
}

#[test]
fn a_windkessel_has_the_pressure_of_its_flow() {
    check("windkessel-pipe");
}

#[test]
fn the_pipe_of_finite_elements_fills_its_windkessel() {
    check("svfsi-pipe");
}

#[test]
fn two_windkessels_share_the_flow_by_resistance() {
    check("two-outlets");
}

#[test]
fn a_stiff_outlet_stays_calm() {
    check("stiff-outlet");
}

#[test]
fn nothing_is_lost_when_the_flow_turns_round() {
    check("backflow");
}

/// Both precisions are the same flow up to particle noise.
#[test]
fn double_precision_gives_the_same_pipe() {
    let (mixed, double) = (poiseuille::run::<f32>(10.0), poiseuille::run::<f64>(10.0));
    println!("{mixed:?}\n{double:?}");
    assert!((mixed.velocity - double.velocity).abs() < 0.003, "{mixed:?} {double:?}");
    assert!((mixed.flow - double.flow).abs() < 0.005, "{mixed:?} {double:?}");
}

/// The top of the ladder takes ten minutes, so it is run by `just validate-long`.
#[test]
#[ignore = "ten minutes on two cores; `just validate-long` runs it"]
fn the_error_goes_on_falling_at_thirty_across() {
    let (coarse, fine) = (poiseuille::run::<f32>(20.0), poiseuille::run::<f32>(30.0));
    println!("{coarse:?}\n{fine:?}");
    assert!(fine.velocity < coarse.velocity, "{coarse:?} {fine:?}");
}

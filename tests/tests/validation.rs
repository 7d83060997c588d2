//! Flows against formulas. The figures are printed: `cargo test -p vaso-tests --test validation -- --nocapture`.

use vaso_tests::poiseuille;

/// Reynolds number 100, parabolic inlet, pressure outlet, from rest. The bounds are those the project
/// asks of itself; the error must fall with the spacing.
#[test]
fn a_pipe_carries_poiseuille_flow() {
    let ladder: Vec<_> = [10.0, 16.0, 20.0].map(poiseuille::run::<f32>).into();
    for e in &ladder {
        println!("{e:?}");
        assert_eq!(e.escaped, 0, "{e:?}");
        assert!(e.density < 0.02, "{e:?}");
        assert!(e.balance.abs() < 0.01, "{e:?}");
    }
    let [coarse, middle, fine] = ladder[..] else { unreachable!("three runs") };
    assert!(middle.velocity < 0.015 && middle.transverse < 0.01, "{middle:?}");
    assert!(fine.velocity < 0.012 && fine.transverse < 0.01, "{fine:?}");
    assert!(middle.gradient.abs() < 0.05 && fine.gradient.abs() < 0.05, "{middle:?} {fine:?}");
    assert!(coarse.velocity > middle.velocity && middle.velocity > fine.velocity, "{ladder:?}");
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

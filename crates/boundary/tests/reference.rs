//! The pressure that the equation of state is relative to.

use glam::DVec3;
use vaso_boundary::{Condition, Openings, Profile, Signal};
use vaso_fluid::Numbers;
use vaso_geometry::{LengthUnit, prepare, shapes};

fn openings(reference_pressure: Option<f64>) -> Openings {
    let pipe = prepare(shapes::pipe(3e-3, 20e-3, DVec3::Z, 32), Some(LengthUnit::Metre)).expect("a pipe");
    let inlet = Condition::Velocity { profile: Profile::Plug, mean: Signal::constant(0.1) };
    let outlet = Condition::Pressure { value: Signal::constant(12_000.0) };
    let ports = pipe.openings.into_iter().zip([inlet, outlet]).collect();
    Openings::new(ports, &Numbers::new(1060.0, 3.5e-3, 0.2, 0.5e-3), reference_pressure)
}

#[test]
fn the_first_pressure_outlet_is_followed_unless_a_pressure_is_given() {
    assert_eq!(openings(None).reference_pressure(0.0), 12_000.0);
    assert_eq!(openings(Some(500.0)).reference_pressure(0.0), 500.0);
}

//! Outlet models at the ends of a short pipe of blood.

mod support;

use support::{RADIUS, Run, numbers};
use vaso_boundary::{Condition, Openings, Profile, Signal, Source, Windkessel};

/// Mean velocity \[m/s\].
const SPEED: f64 = 0.2;

fn area() -> f64 {
    std::f64::consts::PI * RADIUS * RADIUS
}

/// Resistance of the pipe's acoustic impedance rho c / A \[Pa s/m^3\].
fn acoustic_impedance() -> f64 {
    let numbers = numbers(2.0 * SPEED);
    numbers.rest_density * numbers.sound_speed / area()
}

/// The pressure is 50 rho U^2, which would change the density by half if the equation of state carried it.
#[test]
fn a_resistance_of_five_acoustic_impedances_settles_at_its_pressure() {
    let resistance = 5.0 * acoustic_impedance();
    let mean = Signal { source: Source::Constant(SPEED), ramp: 0.02 };
    let inlet = Condition::Velocity { profile: Profile::Parabolic, mean };
    let outlet = Condition::Resistance { resistance, distal_pressure: 0.0 };
    let mut run = Run::new(numbers(2.0 * SPEED), [inlet, outlet], None);
    let (mut sum, mut n) = (0.0, 0.0);
    while run.time < 0.12 {
        run.step();
        if run.time > 0.06 {
            sum += run.openings.measure(&run.fluid.state, run.time)[1].pressure;
            n += 1.0;
        }
    }
    let exact = resistance * SPEED * area();
    assert!((sum / n / exact - 1.0).abs() < 0.01, "{} of the exact pressure", sum / n / exact);
    assert!(run.fluid.top_density_error() < 0.02, "{}", run.fluid.top_density_error());
}

/// Two closed stores, full and empty: blood comes in through one outlet and leaves through the other, and the flow falls
/// by the resistance and compliance of both in series. Only the difference of two outlets drives it, from a step at the start.
#[test]
fn a_full_store_empties_into_the_other() {
    let time_constant = 0.1;
    let resistance = 5.0 * acoustic_impedance();
    let model = Windkessel {
        proximal_resistance: resistance,
        compliance: time_constant / resistance,
        distal_resistance: f64::INFINITY,
        distal_pressure: 0.0,
    };
    let store = |initial_pressure| Condition::Windkessel { model, initial_pressure };
    let full = 2.0 * resistance * SPEED * area();
    let mut run = Run::new(numbers(2.0 * SPEED), [store(full), store(0.0)], None);
    run.openings.set_backflow_damping(0.0);
    let (mut ratio, mut n) = ([0.0; 2], 0.0);
    while run.time < 0.1 {
        run.step();
        if run.time > 0.02 {
            let exact = SPEED * area() * (-run.time / time_constant).exp();
            let readings = run.openings.measure(&run.fluid.state, run.time);
            for (sum, reading) in ratio.iter_mut().zip(readings) {
                *sum += reading.outlet.expect("both are outlet models").flow / exact;
            }
            n += 1.0;
        }
    }
    let [upper, lower] = ratio.map(|sum| sum / n);
    assert!((upper + 1.0).abs() < 0.01 && (lower - 1.0).abs() < 0.01, "{upper} {lower} of the exact flow");
    let passed = SPEED * area() * time_constant * (1.0 - (-run.time / time_constant).exp());
    for port in run.openings.ports() {
        let volume = port.counters.outflow_volume.abs();
        assert!((volume / passed - 1.0).abs() < 0.03, "{} of the exact volume", volume / passed);
    }
}

#[test]
fn backflow_is_damped_and_counted() {
    let store = |initial_pressure| Condition::Windkessel {
        model: Windkessel {
            proximal_resistance: acoustic_impedance(),
            compliance: 1e-9,
            distal_resistance: 1e10,
            distal_pressure: 0.0,
        },
        initial_pressure,
    };
    let energy = |strength: f64| {
        let mut run = Run::new(numbers(2.0 * SPEED), [store(800.0), store(0.0)], None);
        run.openings.set_backflow_damping(strength);
        while run.time < 0.005 {
            run.step();
        }
        run.openings.ports()[0].counters.damped_energy
    };
    assert_eq!(energy(0.0), 0.0);
    assert!(energy(0.5) > 0.0);
}

/// What is stored and put back is all there is: the same run in two halves.
#[test]
fn a_restored_run_goes_on_alike() {
    let conditions = || {
        let mean = Signal { source: Source::Constant(SPEED), ramp: 0.0 };
        [
            Condition::Velocity { profile: Profile::Plug, mean },
            Condition::Resistance { resistance: acoustic_impedance(), distal_pressure: 500.0 },
        ]
    };
    let mut whole = Run::new(numbers(2.0 * SPEED), conditions(), None);
    for _ in 0..10 {
        whole.step();
    }
    let ports: Vec<_> =
        whole.openings.ports().iter().map(|p| (p.opening.clone(), p.condition.clone())).collect();
    let mut fresh = Openings::new(ports, &numbers(2.0 * SPEED), None);
    fresh.restore(&whole.openings.states(), whole.openings.next_id());
    let before = whole.openings.clone();
    for _ in 0..5 {
        whole.step();
    }
    assert_ne!(whole.openings.states(), before.states());
    assert_eq!(fresh.states(), before.states());
    assert_eq!(fresh.reference_pressure(0.0), before.reference_pressure(0.0));
    assert_eq!(fresh.next_id(), before.next_id());
}

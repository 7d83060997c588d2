//! Outlet models at the ends of a short pipe of blood.

mod support;

use std::path::Path;
use support::{RADIUS, Run, numbers};
use vaso_boundary::{
    Condition, Integration, Interpolation, OutletState, Profile, Signal, Source, Waveform, Windkessel,
};
use vaso_io::Archive;

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
/// by the resistance and compliance of both in series. Only the difference of two outlets drives it. It flows from the start: from rest, the
/// step would tear a layer of particles off each end, 2 % of what passes.
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
    (0..2).for_each(|k| run.openings.set_backflow_damping(k, 0.0));
    for i in 0..run.fluid.state.len() {
        let x = run.fluid.state.position[i];
        let r = x.x.hypot(x.y) / RADIUS;
        run.fluid.state.velocity[i].z = 2.0 * SPEED * (1.0 - r * r);
    }
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
        (0..2).for_each(|k| run.openings.set_backflow_damping(k, strength));
        while run.time < 0.005 {
            run.step();
        }
        run.openings.ports()[0].counters.damped_energy
    };
    assert_eq!(energy(0.0), 0.0);
    assert!(energy(0.5) > 0.0);
}

/// What is stored and put back is all there is: a run that goes on from it has the same bits.
#[test]
fn a_restored_run_goes_on_alike() {
    let run = || {
        let mean = Signal { source: Source::Constant(SPEED), ramp: 0.0 };
        let inlet = Condition::Velocity { profile: Profile::Plug, mean };
        let outlet = Condition::Resistance { resistance: acoustic_impedance(), distal_pressure: 500.0 };
        Run::new(numbers(2.0 * SPEED), [inlet, outlet], None)
    };
    let (mut whole, mut resumed) = (run(), run());
    for _ in 0..20 {
        whole.step();
    }
    let kept = |run: &mut Run| {
        let mut archive = Archive::new("run", 1);
        archive.remember(|memory| run.fluid.remember(memory));
        archive.remember(|memory| run.openings.remember(memory));
        archive
    };
    let archive = kept(&mut whole);
    let back = archive.recall(Path::new("run"), |memory| {
        resumed.fluid.remember(memory);
        resumed.openings.remember(memory);
    });
    back.expect("the same openings");
    resumed.time = whole.time;
    for _ in 0..10 {
        whole.step();
        resumed.step();
    }
    assert!(whole.openings.ports()[1].counters.deleted > 0, "particles have passed");
    assert!(kept(&mut resumed) == kept(&mut whole), "the same bits");
}

/// A beat into a Windkessel that starts on its periodic cycle, against the model alone under the asked flow, ten spacings
/// across. What is left is the noise of the flow at the cap, and the layer of particles that has not yet come through.
#[test]
fn a_windkessel_follows_its_exact_pressure_over_a_beat() {
    let period = 0.15;
    let time: Vec<f64> = (0..25).map(|k| period * f64::from(k) / 25.0).collect();
    let beat = |t: f64| 0.15 + 0.15 * (std::f64::consts::TAU * t / period).sin();
    let value = time.iter().map(|&t| beat(t)).collect();
    let wave = Waveform::new(time, value, Some(period)).expect("valid");
    let wave = wave.interpolated(Interpolation::Fourier { harmonics: 4 }).expect("possible");
    let model = Windkessel {
        proximal_resistance: 0.3 * acoustic_impedance(),
        compliance: 0.1 / acoustic_impedance(),
        distal_resistance: 2.0 * acoustic_impedance(),
        distal_pressure: 0.0,
    };
    let cycle = model.periodic(&wave.scaled(area())).expect("periodic");
    let mean = Signal { source: Source::Waveform(wave), ramp: 0.02 };
    let inlet = Condition::Velocity { profile: Profile::Womersley, mean: mean.clone() };
    let outlet = Condition::Windkessel { model, initial_pressure: cycle.start.stored_pressure };
    let mut run = Run::new(numbers(2.0 * 0.3), [inlet, outlet], None);
    let mut exact = OutletState::at_rest(cycle.start.stored_pressure);
    let (mut squares, mut n, mut taken_up) = (0.0, 0.0, 0.0);
    while run.time < period {
        let before = run.time;
        run.step();
        let duration = run.time - before;
        exact = model.advance(&exact, area() * mean.at(run.time), duration, Integration::Exponential);
        let reading = run.openings.measure(&run.fluid.state, run.time)[1];
        squares += (reading.pressure - exact.pressure).powi(2);
        taken_up += reading.outlet.expect("an outlet model").flow * duration;
        n += 1.0;
    }
    let rms = f64::sqrt(squares / n) / (cycle.systolic - cycle.diastolic);
    assert!(rms < 0.03, "{rms} of the pulse");
    let left = run.openings.ports()[1].counters.outflow_volume;
    assert!((taken_up / left - 1.0).abs() < 0.01, "the model took up {taken_up} of {left} m^3");
}

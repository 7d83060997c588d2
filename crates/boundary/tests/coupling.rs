//! Outlet models at the ends of a short pipe of blood.

mod support;

use support::{LENGTH, RADIUS, Run, numbers};
use vaso_boundary::{Condition, Profile, Signal, Source, Windkessel};

const SPEED: f64 = 0.2;

fn area() -> f64 {
    std::f64::consts::PI * RADIUS * RADIUS
}

#[test]
fn a_resistance_of_five_acoustic_impedances_settles_at_its_pressure() {
    let numbers = numbers(2.0 * SPEED);
    let impedance = numbers.rest_density * numbers.sound_speed / area();
    for ratio in [1.0, 5.0] {
        let mean = Signal { source: Source::Constant(SPEED), ramp: 0.02 };
        let inlet = Condition::Velocity { profile: Profile::Parabolic, mean };
        let outlet = Condition::Resistance { resistance: ratio * impedance, distal_pressure: 0.0 };
        let mut run = Run::new(numbers, [inlet, outlet], None);
        let (mut sum, mut flow, mut n) = (0.0, 0.0, 0.0);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        while run.time < 0.2 {
            run.step();
            if run.time > 0.1 {
                let reading = run.openings.measure(&run.fluid.state, run.time)[1];
                sum += reading.pressure;
                flow += reading.flow;
                low = f64::min(low, reading.pressure);
                high = f64::max(high, reading.pressure);
                n += 1.0;
            }
        }
        let (pressure, exact) = (sum / n, ratio * impedance * SPEED * area());
        println!(
            "R/Z {ratio}: {:.4} ({:.4}..{:.4}) flow {:.4} of the asked, density error {:.4}, {} particles",
            pressure / exact,
            low / exact,
            high / exact,
            flow / n / SPEED / area(),
            run.fluid.top_density_error(),
            run.fluid.state.len()
        );
        assert!((pressure / exact - 1.0).abs() < 0.01, "R/Z {ratio}: {pressure} Pa, not {exact}");
    }
}

#[test]
fn two_stores_empty_into_each_other() {
    let numbers = numbers(2.0 * SPEED);
    let impedance = numbers.rest_density * numbers.sound_speed / area();
    let resistance = 5.0 * impedance;
    let drop = 2.0 * resistance * SPEED * area();
    let time_constant = 0.1;
    // Closed stores of equal size: the flow decays with R C of both in series.
    let model = Windkessel {
        proximal_resistance: resistance,
        compliance: time_constant / resistance,
        distal_resistance: f64::INFINITY,
        distal_pressure: 0.0,
    };
    let store = |initial_pressure| Condition::Windkessel { model, initial_pressure };
    let mut run = Run::new(numbers, [store(drop), store(0.0)], None);
    run.openings.set_backflow_damping(0.0);
    while run.time < 0.15 {
        run.step();
        let readings = run.openings.measure(&run.fluid.state, run.time);
        if (run.time / 0.01).fract() < 0.05 {
            let exact = SPEED * area() * (-run.time / time_constant).exp();
            println!(
                "{:.4} {:.4} {:.4} {:.4}",
                run.time,
                readings[0].outlet.unwrap().flow / exact,
                readings[1].outlet.unwrap().flow / exact,
                run.fluid.top_density_error()
            );
        }
    }
    println!("{:?} {} {LENGTH}", run.openings.states(), run.fluid.state.len());
}

//! Walls of one layer next to blood: at rest as layers are, and inflated to rest.

use super::tube::{is_middle, means, pressure};
use crate::pipe::Pipe;
use vaso_coupling::ShellWall;
use vaso_driver::Flow;
use vaso_fluid::Real;

type ShellFlow = Flow<f32, ShellWall<f32>>;

/// Flow \[m^3/s\] along the middle of a pipe of 10 spacings across, driven by a pressure until it is steady, over that of Poiseuille.
fn poiseuille<R: Real>(across: f64, wall: &str) -> f64 {
    let pressure = |p: f64| format!("condition = \"pressure\"\nvalue = \"{p} Pa\"\nramp = \"5 ms\"");
    let (difference, viscosity) = (120.0, 0.1);
    let pipe = Pipe {
        inlet: pressure(difference),
        outlet: pressure(0.0),
        viscosity,
        end_time: 0.1,
        more: format!("\n[wall]\nmodel = \"{wall}\"\n"),
        ..Pipe::published(across)
    };
    let (mut flow, _, plan) = pipe.flow::<R>();
    let (mut carried, mut time) = (0.0, 0.0);
    while flow.time < pipe.end_time {
        let before = flow.time;
        flow.step(pipe.end_time).unwrap_or_else(|e| panic!("{e}"));
        if before < 0.8 * pipe.end_time {
            continue;
        }
        let (state, dt) = (&flow.fluid.state, flow.time - before);
        let within = (0..state.len()).filter(|&i| (0.3..0.7).contains(&(state.position[i].z / pipe.length)));
        let momentum: f64 = within.map(|i| state.mass[i] * state.velocity[i].z).sum();
        carried += dt * momentum / plan.numbers.rest_density / (0.4 * pipe.length);
        time += dt;
    }
    assert_eq!(flow.watch.escaped, 0, "{wall}");
    let exact = std::f64::consts::PI * pipe.radius().powi(4) * difference / (8.0 * viscosity * pipe.length);
    carried / time / exact
}

#[test]
fn a_rigid_shell_carries_the_flow_of_a_rigid_wall() {
    let (shell, layers) = (poiseuille::<f32>(10.0, "rigid-shell"), poiseuille::<f32>(10.0, "rigid"));
    println!(
        "flow by that of Poiseuille: shell {shell:.4}, four layers {layers:.4}, ratio {:.4}",
        shell / layers
    );
    assert!((shell / layers - 1.0).abs() < 0.01, "{shell} {layers}");
}

/// A tube whose lumen is 10 mm wide, at rest under a pressure.
struct Inflated {
    across: f64,
    young: f64,
    thickness: f64,
    /// Spacing of the shell over that of the blood.
    share: f64,
    /// Hoop strain of the mid-surface of a thin tube.
    strain: f64,
}

const POISSON: f64 = 0.45;
const LUMEN: f64 = 5e-3;
/// Length between the rings \[m\].
const LENGTH: f64 = 30e-3;

impl Inflated {
    /// Pressure \[Pa\] that the lumen passes on to the mid-surface of a tube held at its ends: `p r = E t strain / (1 - nu^2)`.
    fn pressure(&self) -> f64 {
        self.strain * self.young * self.thickness / ((1.0 - POISSON * POISSON) * LUMEN)
    }

    fn pipe(&self) -> Pipe {
        let spacing = 2.0 * LUMEN / self.across;
        let end = format!("condition = \"pressure\"\nvalue = \"{} Pa\"\nramp = \"14 ms\"", self.pressure());
        Pipe {
            diameter: 2.0 * LUMEN,
            length: LENGTH + 8.0 * spacing,
            density: 1000.0,
            // A thick liquid comes to rest soon.
            viscosity: 0.3,
            inlet: end.clone(),
            outlet: end,
            // Slow sound is enough for a state at rest.
            more: format!(
                "[numerics]\nsound_speed = \"20 m/s\"\n[wall]\nmodel = \"shell\"\nmaterial = \"saint-venant-kirchhoff\"\n\
                 young_modulus = \"{} Pa\"\npoisson_ratio = {POISSON}\nthickness = \"{} m\"\nspacing = \"{} m\"\n\
                 density = \"1000 kg/m^3\"\ndamping = \"quasi-static\"\n",
                self.young,
                self.thickness,
                self.share * spacing
            ),
            ..Pipe::published(self.across)
        }
    }

    /// Radial displacement of the middle fifth over that of theory under the pressure there, its scatter, and that pressure over the
    /// one at the ends.
    fn run(&self) -> [f64; 3] {
        let pipe = self.pipe();
        let (mut flow, _, _) = pipe.flow_in::<f32, ShellWall<f32>>();
        // Some periods of what is left of the sloshing: 12 ms each.
        let [mean, scatter, pressure] = means(&mut flow, [48e-3, 96e-3], |flow| {
            let [mean, scatter] = self.middle(flow, &pipe);
            [mean, scatter, pressure(flow, &pipe) / self.pressure()]
        });
        [mean / pressure, scatter / mean, pressure]
    }

    /// Radial displacement of the mid-surface under the full pressure: that of Lame in plane strain, which of a thin tube is `p r R (1 - nu^2)/(E t)`
    /// and the Poisson effect of the pressure across the wall, `nu/(1 - nu) t/(2R)` of it; times what a tube of finite length has more.
    ///
    /// Next to ends that are held it widens less, by as much as over a length `1/b` not at all, `b^4 = 3 (1 - nu^2)/(R t)^2` (Timoshenko and
    /// Woinowsky-Krieger 1959, chapter 15). The wall contracts less there along the axis, and so more in the middle: by `nu d` of the strain, where
    /// `d` is the share of both lengths. The middle widens by `1/(1 - nu^2 d)`.
    fn expected(&self) -> f64 {
        let (a, b, r) = (LUMEN, LUMEN + self.thickness, LUMEN + 0.5 * self.thickness);
        let lame = self.pressure() * a * a * (1.0 + POISSON) / (self.young * (b * b - a * a))
            * ((1.0 - 2.0 * POISSON) * r + b * b / r);
        let held = (r * self.thickness).sqrt() / (3.0 * (1.0 - POISSON * POISSON)).sqrt().sqrt();
        lame / (1.0 - POISSON * POISSON * 2.0 * held / LENGTH)
    }

    /// Mean radial displacement of the middle fifth over that of theory at the full pressure, and its standard deviation.
    fn middle(&self, flow: &ShellFlow, pipe: &Pipe) -> [f64; 2] {
        let state = &flow.wall.as_ref().expect("the wall deforms").wall.shell.state;
        let expected = self.expected();
        let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for i in (0..state.len()).filter(|&i| is_middle(state.reference_position[i].z, pipe)) {
            let x = state.reference_position[i];
            let u = state.displacement[i].dot(x.with_z(0.0).normalize()) / expected;
            (n, sum, squares) = (n + 1.0, sum + u, squares + u * u);
        }
        let mean = sum / n;
        [mean, (squares / n - mean * mean).max(0.0).sqrt()]
    }
}

const BOUND: f64 = 0.02;

const TUBE: Inflated = Inflated { across: 10.0, young: 600e3, thickness: 0.5e-3, share: 1.0, strain: 5e-3 };

#[test]
fn a_tube_under_pressure_widens_as_theory_says() {
    let [widening, scatter, pressure] = TUBE.run();
    println!("widening {widening:.4} of that of theory, scatter {scatter:.4}, pressure {pressure:.4}");
    assert!((widening - 1.0).abs() < BOUND, "{widening}");
}

/// As thin as a sixth of a spacing, where the wall is lighter than the blood within reach.
#[test]
fn a_thin_tube_widens_as_a_membrane() {
    let thin = Inflated { young: 2e6, thickness: 0.15e-3, ..TUBE };
    let [widening, scatter, pressure] = thin.run();
    println!("widening {widening:.4} of that of theory, scatter {scatter:.4}, pressure {pressure:.4}");
    assert!((widening - 1.0).abs() < BOUND, "{widening}");
}

#[test]
#[ignore = "some minutes on two cores"]
fn the_widening_at_other_spacings() {
    for other in [
        Inflated { across: 16.0, ..TUBE },
        Inflated { share: 0.7, ..TUBE },
        Inflated { thickness: 2e-3, young: 150e3, ..TUBE },
    ] {
        let [widening, scatter, pressure] = other.run();
        println!(
            "D/{}, t {} mm, shell {} spacings: widening {widening:.4} of theory, scatter {scatter:.4}, pressure {pressure:.4}",
            other.across,
            1e3 * other.thickness,
            other.share
        );
        // A wall as thick as 0.4 of the radius is none of the theory of shells any more, and the plan says so: 6.4 % were measured.
        let bound = if other.thickness < 0.3 * LUMEN { BOUND } else { 0.08 };
        assert!((widening - 1.0).abs() < bound, "{widening}");
    }
}

/// A pulse of pressure into a coarse tube of these thickness \[m\] and density \[kg/m^3\]: the largest energy of the wall over the work of
/// the openings so far, from the end of the pulse on, and the largest displacement \[m\].
fn pulse(thickness: f64, density: f64) -> [f64; 2] {
    // The pulse wave goes at 4 m/s in every one of them.
    let young = 2.0 * 1000.0 * LUMEN * 16.0 * (1.0 - POISSON * POISSON) / thickness;
    let spacing = 1e-3;
    let (duration, height) = (4e-3, 800.0);
    let rise = duration / 20.0;
    let pipe = Pipe {
        diameter: 2.0 * LUMEN,
        length: 28e-3 + 8.0 * spacing,
        density: 1000.0,
        viscosity: 3e-3,
        inlet: "condition = \"pressure\"\nwaveform = \"inflow.csv\"".into(),
        outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
        inflow: vec![[0.0, 0.0], [rise, height], [duration, height], [duration + rise, 0.0], [1.0, 0.0]],
        end_time: 20e-3,
        more: format!(
            "[numerics]\nsound_speed = \"20 m/s\"\n[wall]\nmodel = \"shell\"\nyoung_modulus = \"{young} Pa\"\npoisson_ratio = \
             {POISSON}\nthickness = \"{thickness} m\"\ndensity = \"{density} kg/m^3\"\n"
        ),
        ..Pipe::published(10.0)
    };
    let (mut flow, _, _) = pipe.flow_in::<f32, ShellWall<f32>>();
    let (mut work, mut share, mut largest) = (0.0, 0.0_f64, 0.0_f64);
    while flow.time < pipe.end_time {
        let before = flow.time;
        flow.step(pipe.end_time).unwrap_or_else(|e| panic!("t {thickness}, density {density}: {e}"));
        work -= (flow.time - before)
            * flow.readings.iter().map(|r| r.pressure * r.flow + r.kinetic_power).sum::<f64>();
        let shell = &flow.wall.as_ref().expect("the wall deforms").wall.shell;
        largest = shell.state.displacement.iter().map(|u| u.length()).fold(largest, f64::max);
        if flow.time > duration {
            let e = shell.energies();
            share = share.max((e.kinetic + e.rotary + e.strain() + e.hourglass) / work);
        }
    }
    assert_eq!(flow.watch.escaped, 0, "t {thickness}, density {density}");
    [share, largest]
}

#[test]
fn a_light_and_a_thick_shell_keep_the_energy_they_get() {
    for (thickness, density) in [(0.05e-3, 500.0), (4e-3, 1200.0)] {
        let [share, largest] = pulse(thickness, density);
        println!(
            "t {thickness} m, density {density}: energy over work {share:.3}, up to {:.3} mm",
            1e3 * largest
        );
        assert!(share < 1.0, "t {thickness}, density {density}: {share}");
    }
}

#[test]
#[ignore = "some minutes on two cores"]
fn shells_of_all_thicknesses_keep_the_energy_they_get() {
    for thickness in [0.05e-3, 0.1e-3, 0.2e-3, 0.4e-3, 1e-3, 4e-3] {
        for density in [500.0, 800.0, 1200.0] {
            let [share, largest] = pulse(thickness, density);
            println!(
                "t {thickness} m, density {density}: energy over work {share:.3}, up to {:.3} mm",
                1e3 * largest
            );
            assert!(share < 1.0, "t {thickness}, density {density}: {share}");
        }
    }
}

/// A long pulse of pressure in a long thin tube whose material does not contract sideways: it goes at `1/sqrt(1/c_w^2 + 1/c^2)`, with `c_w^2
/// = E t / (2 rho R)` of the mid-surface. The front is timed at half its height, a quarter and half along.
#[test]
#[ignore = "some minutes on two cores"]
fn a_long_pulse_goes_at_the_speed_of_moens_and_korteweg() {
    let (young, thickness, density, sound) = (300e3, 1e-3, 1000.0, 30.0);
    let (rise, height) = (40e-3, 150.0);
    let wave = (young * thickness / (2.0 * density * (LUMEN + 0.5 * thickness))).sqrt();
    let expected = 1.0 / (1.0_f64 / (wave * wave) + 1.0 / (sound * sound)).sqrt();
    let front: Vec<[f64; 2]> = (0..=20)
        .map(|k| {
            let s = f64::from(k) / 20.0;
            [s * rise, 0.5 * height * (1.0 - (std::f64::consts::PI * s).cos())]
        })
        .chain([[1.0, height]])
        .collect();
    let pipe = Pipe {
        diameter: 2.0 * LUMEN,
        length: 300e-3,
        density,
        viscosity: 1e-4,
        inlet: "condition = \"pressure\"\nwaveform = \"inflow.csv\"".into(),
        outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
        inflow: front,
        end_time: 65e-3,
        more: format!(
            "[numerics]\nsound_speed = \"{sound} m/s\"\n[wall]\nmodel = \"shell\"\nmaterial = \"saint-venant-kirchhoff\"\nyoung_modulus = \
             \"{young} Pa\"\npoisson_ratio = 0.0\nthickness = \"{thickness} m\"\ndensity = \"{density} kg/m^3\"\n"
        ),
        ..Pipe::published(10.0)
    };
    let (mut flow, _, _) = pipe.flow_in::<f32, ShellWall<f32>>();
    let places = [0.2, 0.5].map(|share| share * pipe.length);
    let mut passed = [None; 2];
    let mut before = [(0.0, 0.0); 2];
    while flow.time < pipe.end_time && passed[1].is_none() {
        flow.step(pipe.end_time).unwrap_or_else(|e| panic!("{e}"));
        let state = &flow.fluid.state;
        for k in 0..2 {
            let near = (0..state.len()).filter(|&i| (state.position[i].z - places[k]).abs() < 5e-3);
            let (sum, n) = near.fold((0.0, 0.0), |(sum, n), i| (sum + state.pressure[i], n + 1.0));
            let (now, level) = ((flow.time, sum / n), 0.5 * height);
            if passed[k].is_none() && now.1 > level {
                let share = (level - before[k].1) / (now.1 - before[k].1);
                passed[k] = Some(before[k].0 + share * (now.0 - before[k].0));
            }
            before[k] = now;
        }
    }
    let [Some(first), Some(second)] = passed else { panic!("the pulse does not arrive: {passed:?}") };
    let speed = (places[1] - places[0]) / (second - first);
    println!("{speed:.3} m/s, {:.4} of {expected:.3} m/s", speed / expected);
    assert!((speed / expected - 1.0).abs() < 0.03, "{speed}");
    assert_eq!(flow.watch.escaped, 0);
}

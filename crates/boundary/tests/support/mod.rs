//! A short pipe of blood on a lattice, with what the loop nest of a run does and nothing else.

use glam::DVec3;
use vaso_boundary::{Condition, Openings};
use vaso_fluid::{Fluid, FluidState, Isa, Numbers};
use vaso_geometry::{LengthUnit, prepare, shapes};
use vaso_particles::{WallDistance, WallView};

pub(crate) const SPACING: f64 = 4e-4;
/// Radius of the pipe \[m\].
pub(crate) const RADIUS: f64 = 2e-3;
/// Length of the pipe, along z \[m\].
pub(crate) const LENGTH: f64 = 1e-2;

struct Pipe;
impl WallDistance for Pipe {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        let across = x.with_z(0.0);
        (across.length() - RADIUS, across.normalize_or(DVec3::X))
    }
}

pub(crate) struct Run {
    pub(crate) fluid: Fluid<f64>,
    pub(crate) openings: Openings,
    pub(crate) time: f64,
}

/// Numbers of a flow of `speed` \[m/s\].
pub(crate) fn numbers(speed: f64) -> Numbers {
    Numbers::new(1060.0, 3.5e-3, speed, SPACING)
}

impl Run {
    /// Blood at rest between the conditions at the lower and at the upper end.
    pub(crate) fn new(numbers: Numbers, conditions: [Condition; 2], reference_pressure: Option<f64>) -> Self {
        let vessel =
            prepare(shapes::pipe(RADIUS, LENGTH, DVec3::Z, 64), Some(LengthUnit::Metre)).expect("a pipe");
        let middle = vessel.openings.iter().map(|o| o.center.z).sum::<f64>() / 2.0;
        let mut caps = vessel.openings;
        caps.sort_by(|a, b| a.center.z.total_cmp(&b.center.z));
        let ports = caps.into_iter().zip(conditions).collect();

        let (across, along) = (18, (LENGTH / SPACING).round() as i32);
        let sites = (0..along).flat_map(|k| {
            (0..across * across).map(move |s| {
                let site = |k: i32, n: i32| SPACING * (f64::from(k) - 0.5 * f64::from(n - 1));
                DVec3::new(site(s % across, across), site(s / across, across), middle + site(k, along))
            })
        });
        let near = sites.filter(|x| Pipe.sample(*x).0 < 3.0 * SPACING);
        let (blood, wall): (Vec<DVec3>, Vec<DVec3>) = near.partition(|x| Pipe.sample(*x).0 < 0.0);
        let depth: Vec<f64> = wall.iter().map(|x| Pipe.sample(*x).0).collect();
        let (velocity, volume) = (vec![DVec3::ZERO; wall.len()], vec![SPACING.powi(3); wall.len()]);
        let view = WallView { position: &wall, velocity: &velocity, depth: &depth, volume: &volume };
        let state =
            FluidState::at_rest(blood.clone(), &vec![SPACING.powi(3); blood.len()], numbers.rest_density);
        let bounds = (DVec3::new(-4e-3, -4e-3, middle - LENGTH), DVec3::new(4e-3, 4e-3, middle + LENGTH));
        let mut fluid = Fluid::new(state, view, Box::new(Pipe), bounds, numbers, Isa::detect());
        let mut openings = Openings::new(ports, &numbers, reference_pressure);
        openings.start(&mut fluid.state);
        Self { fluid, openings, time: 0.0 }
    }

    /// Takes one advective step.
    pub(crate) fn step(&mut self) {
        let Self { fluid, openings, time } = self;
        if *time > 0.0 {
            openings.exchange(&mut fluid.state, *time);
        }
        fluid.sort();
        openings.locate(&fluid.state, 1.0);
        fluid.search(openings.zones());
        fluid.summation(openings.zones());
        fluid.viscosity();
        fluid.offsets();
        let duration = fluid.advective_step();
        let (mut left, mut dt) = (duration, fluid.numbers().acoustic_step(fluid.top_speed()).min(duration));
        fluid.begin_acoustic(dt);
        loop {
            fluid.wall_pressure();
            let inner = fluid.kick(dt);
            left -= dt;
            let near = openings.apply(fluid, *time + duration - left, dt);
            let next = fluid.numbers().acoustic_step(inner.max(near)).min(left);
            let goes_on = left > 1e-9 * duration;
            fluid.continuity(dt, goes_on.then_some(next));
            if !goes_on {
                break;
            }
            dt = next;
        }
        *time += duration;
        fluid.transport(openings.zones());
        assert!(fluid.guard().lost.is_empty(), "a particle left through the wall at {time} s");
    }
}

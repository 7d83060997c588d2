//! How the flow at a cap reaches the outlet model, so that the two stay stable together.

use super::{Integration, OutletState, Windkessel};
use serde::{Deserialize, Serialize};
use vaso_particles::Memory;

/// How an outlet takes up the flow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Coupling {
    /// Every acoustic step, implicitly with the acoustic impedance of the cap: the outlet and the wave that comes out of the
    /// vessel agree on a flow. Stable for any resistance.
    #[default]
    Impedance,
    /// Once a window, from the mean flow over it, as published. Unstable for resistances above about the acoustic
    /// impedance of the vessel unless the window spans many transits of sound.
    Window {
        /// Length of the window \[s\].
        duration: f64,
        /// How the model takes the step.
        integration: Integration,
    },
}

/// Where a coupled outlet stands: all that its next step needs to know.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct CoupledState {
    /// The model.
    pub(crate) outlet: OutletState,
    /// Section that the fluid in the buffer fills, averaged over its way through \[m^2\].
    pub(crate) section: f64,
    /// Mean pressure in the buffer above the imposed one, as it is without sound \[Pa\].
    pub(crate) offset: f64,
    /// Volume that left in the window so far \[m^3\].
    pub(crate) window_volume: f64,
    /// Time since the window began \[s\].
    pub(crate) window_time: f64,
}

/// What the buffer of an outlet shows after an acoustic step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Seen {
    /// Mean velocity out of the vessel \[m/s\].
    pub(crate) velocity: f64,
    /// Section that the particles fill \[m^2\].
    pub(crate) section: f64,
    /// Mean pressure of the particles \[Pa\].
    pub(crate) pressure: f64,
    /// Pressure that was imposed on them \[Pa\].
    pub(crate) imposed: f64,
}

/// A model coupled to a cap.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outlet {
    pub(crate) model: Windkessel,
    pub(crate) coupling: Coupling,
    /// Acoustic impedance Z of the cap, rho c / A \[Pa s/m^3\].
    pub(crate) impedance: f64,
    /// Time in which sound crosses the buffer \[s\]. The flow is smoothed over half of it: what the buffer shows is a mean
    /// over its length, and comes that much late.
    pub(crate) transit: f64,
    /// Time over which the offset is followed \[s\]: what is faster is sound.
    pub(crate) settling: f64,
    pub(crate) state: CoupledState,
}

/// [`Outlet::settling`] over [`Outlet::transit`] for an outlet of no resistance.
const SETTLING: f64 = 2.0;

impl Outlet {
    /// `model` at the cap, of an acoustic `impedance` rho c / A \[Pa s/m^3\] and a buffer that sound crosses in
    /// `transit` \[s\], starting at rest at `pressure` \[Pa\].
    pub(crate) fn new(model: Windkessel, pressure: f64, impedance: f64, transit: f64, area: f64) -> Self {
        let ratio = model.impedance(transit) / impedance;
        Self {
            model,
            coupling: Coupling::default(),
            impedance,
            transit,
            settling: SETTLING * transit * (1.0 + ratio),
            state: CoupledState {
                outlet: OutletState::at_rest(pressure),
                section: area,
                ..CoupledState::default()
            },
        }
    }

    /// Shows what it carries from step to step, under `name`.
    pub(crate) fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { state, model: _, coupling: _, impedance: _, transit: _, settling: _ } = self;
        let CoupledState { outlet, section, offset, window_volume, window_time } = state;
        let OutletState { pressure, stored_pressure, flow } = outlet;
        memory.fields(
            name,
            &mut [pressure, stored_pressure, flow, section, offset, window_volume, window_time],
        );
    }

    /// Takes up what the buffer, of a `length` \[m\], shows after an acoustic step of `duration` \[s\].
    ///
    /// The section rises and falls as layers of particles pass the ends of the buffer. Its mean over the way through the
    /// buffer does not, and makes the flow the one that passes, also where the lumen is not as wide as the cap.
    pub(crate) fn follow(&mut self, seen: Seen, length: f64, duration: f64) {
        let Seen { velocity, section, pressure, imposed } = seen;
        let passed = (velocity.abs() * duration / length).min(1.0);
        self.state.section += passed * (section - self.state.section);
        let flow = self.state.section * velocity;
        match self.coupling {
            Coupling::Impedance => self.meet(flow, pressure, imposed, duration),
            Coupling::Window { duration: window, integration } => {
                self.gather(flow, duration, window, integration);
            }
        }
    }

    /// The flow at the end of the step is where the outlet and the wave that comes out of the vessel agree,
    /// `p_c + R Q* = p + Z (Q - Q*)`.
    ///
    /// Friction, inertia and the kernel's short reach at the cap let `p` differ from the imposed pressure where there is
    /// no sound at all. That offset is followed slowly and taken off: in the mean `Q*` is the flow that is seen.
    fn meet(&mut self, flow: f64, pressure: f64, imposed: f64, duration: f64) {
        let CoupledState { outlet, offset, .. } = &mut self.state;
        *offset -= (-duration / self.settling).exp_m1() * (pressure - imposed - *offset);
        let at_no_flow = self.model.advance(outlet, 0.0, duration, Integration::Exponential).pressure;
        let slope = self.model.slope(duration);
        let met = (pressure - *offset - at_no_flow + self.impedance * flow) / (slope + self.impedance);
        let smooth = outlet.flow - (-2.0 * duration / self.transit).exp_m1() * (met - outlet.flow);
        *outlet = self.model.advance(outlet, smooth, duration, Integration::Exponential);
    }

    /// Gathers the flow over a window and takes the step of the model at its end.
    fn gather(&mut self, flow: f64, duration: f64, window: f64, integration: Integration) {
        let CoupledState { outlet, window_volume, window_time, .. } = &mut self.state;
        *window_volume += flow * duration;
        *window_time += duration;
        if *window_time >= window * (1.0 - 1e-9) {
            let mean = *window_volume / *window_time;
            *outlet = self.model.advance(outlet, mean, *window_time, integration);
            (*window_volume, *window_time) = (0.0, 0.0);
        }
    }
}

/// Mean pressure of outlets, weighted by what they let through \[Pa\].
///
/// Taken as the level of the fluid's pressure it leaves only the differences between outlets in the fluid. With weights 1/R
/// these take energy out for any flows, `sum R_k Q_k^2 >= (sum Q_k)^2 / sum 1/R_k`. Other weights can feed the sound that
/// runs between outlets.
pub(crate) fn common_pressure<'a>(outlets: impl Iterator<Item = &'a Outlet> + Clone) -> f64 {
    let impedance = |outlet: &Outlet| outlet.model.impedance(outlet.settling);
    let largest = outlets.clone().map(impedance).fold(0.0, f64::max);
    // Outlets of no resistance share the weight, rather than having an infinite one.
    let weight =
        |outlet: &Outlet| if largest > 0.0 { 1.0 / impedance(outlet).max(1e-6 * largest) } else { 1.0 };
    let (sum, total) = outlets.fold((0.0, 0.0), |(sum, total), outlet| {
        (sum + weight(outlet) * outlet.state.outlet.pressure, total + weight(outlet))
    });
    sum / total
}

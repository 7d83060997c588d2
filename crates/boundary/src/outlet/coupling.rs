//! How the flow at a cap reaches the outlet model, so that the two stay stable together.

use super::{Integration, OutletState, Windkessel};
use serde::{Deserialize, Serialize};

/// How an outlet takes up the flow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Coupling {
    /// Every acoustic step, from a flow smoothed over the time that the impedance of the outlet calls for.
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

/// Where a coupled outlet stands: all that its next step needs to know, to be kept in a checkpoint.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CoupledState {
    /// The model.
    pub outlet: OutletState,
    /// Section that the fluid in the buffer fills, averaged over its way through \[m^2\].
    pub section: f64,
    /// Volume that left in the window so far \[m^3\].
    pub window_volume: f64,
    /// Time since the window began \[s\].
    pub window_time: f64,
}

impl CoupledState {
    /// Its numbers in the order of the fields, for stores that know nothing but numbers.
    pub fn to_array(&self) -> [f64; 6] {
        let OutletState { pressure, stored_pressure, flow } = self.outlet;
        [pressure, stored_pressure, flow, self.section, self.window_volume, self.window_time]
    }

    /// The state of which [`Self::to_array`] gave the numbers.
    pub fn from_array(
        [pressure, stored_pressure, flow, section, window_volume, window_time]: [f64; 6],
    ) -> Self {
        let outlet = OutletState { pressure, stored_pressure, flow };
        Self { outlet, section, window_volume, window_time }
    }
}

/// A model coupled to a cap.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Outlet {
    pub(crate) model: Windkessel,
    pub(crate) coupling: Coupling,
    /// Time over which the flow is smoothed \[s\].
    pub(crate) smoothing: f64,
    pub(crate) state: CoupledState,
}

/// Smoothing time over the time in which sound crosses the buffer, for an outlet of no resistance.
///
/// Taken together with the resistance over the acoustic impedance of the cap, rho c / A: smoothing over T gives a
/// resistance R the compliance T/R, so this is the compliance of some buffers more of fluid, however large R is.
const SMOOTHING: f64 = 2.0;

impl Outlet {
    /// `model` at the cap, of an acoustic impedance rho c / A \[Pa s/m^3\] and a buffer that sound crosses in
    /// `transit` \[s\], starting at rest at `pressure` \[Pa\].
    pub(crate) fn new(model: Windkessel, pressure: f64, impedance: f64, transit: f64, area: f64) -> Self {
        let ratio = model.impedance(transit) / impedance;
        Self {
            model,
            coupling: Coupling::default(),
            smoothing: SMOOTHING * transit * (1.0 + ratio),
            state: CoupledState {
                outlet: OutletState::at_rest(pressure),
                section: area,
                ..CoupledState::default()
            },
        }
    }

    /// Takes up what the buffer shows over an acoustic step of `duration` \[s\]: a mean `velocity` \[m/s\] out of the
    /// vessel, and a `section` \[m^2\] that its particles fill.
    ///
    /// The section rises and falls as layers of particles pass the ends of the buffer. Its mean over the way through the
    /// buffer does not, and makes the flow the one that passes, also where the lumen is not as wide as the cap.
    pub(crate) fn follow(&mut self, velocity: f64, section: f64, length: f64, duration: f64) {
        let passed = (velocity.abs() * duration / length).min(1.0);
        self.state.section += passed * (section - self.state.section);
        self.step(self.state.section * velocity, duration);
    }

    /// Takes an acoustic step of `duration` \[s\] in which `flow` \[m^3/s\] leaves through the cap.
    pub(crate) fn step(&mut self, flow: f64, duration: f64) {
        let CoupledState { outlet, window_volume, window_time, .. } = &mut self.state;
        match self.coupling {
            Coupling::Impedance => {
                let taken_up = -(-duration / self.smoothing).exp_m1();
                let smooth = outlet.flow + taken_up * (flow - outlet.flow);
                *outlet = self.model.advance(outlet, smooth, duration, Integration::Exponential);
            }
            Coupling::Window { duration: window, integration } => {
                *window_volume += flow * duration;
                *window_time += duration;
                if *window_time >= window * (1.0 - 1e-9) {
                    let mean = *window_volume / *window_time;
                    *outlet = self.model.advance(outlet, mean, *window_time, integration);
                    (*window_volume, *window_time) = (0.0, 0.0);
                }
            }
        }
    }
}

/// Gives all outlets the smoothing of the slowest, which [`common_pressure`] relies on.
pub(crate) fn share_smoothing<'a>(outlets: impl Iterator<Item = &'a mut Outlet>) {
    let outlets: Vec<&mut Outlet> = outlets.collect();
    let slowest = outlets.iter().map(|o| o.smoothing).fold(0.0, f64::max);
    for outlet in outlets {
        outlet.smoothing = slowest;
    }
}

/// Mean pressure of outlets, weighted by what they let through \[Pa\].
///
/// Taken as the level of the fluid's pressure it leaves only the differences between outlets in the fluid. With weights 1/R
/// these differences still take energy out for any flows, `sum R_k Q_k^2 >= (sum Q_k)^2 / sum 1/R_k`, as long as all flows are
/// smoothed alike. Other weights, or unlike smoothing, feed the sound that runs between outlets.
pub(crate) fn common_pressure<'a>(outlets: impl Iterator<Item = &'a Outlet> + Clone) -> f64 {
    let impedance = |outlet: &Outlet| outlet.model.impedance(outlet.smoothing);
    let largest = outlets.clone().map(impedance).fold(0.0, f64::max);
    // Outlets of no resistance share the weight, rather than having an infinite one.
    let weight =
        |outlet: &Outlet| if largest > 0.0 { 1.0 / impedance(outlet).max(1e-6 * largest) } else { 1.0 };
    let (sum, total) = outlets.fold((0.0, 0.0), |(sum, total), outlet| {
        (sum + weight(outlet) * outlet.state.outlet.pressure, total + weight(outlet))
    });
    sum / total
}

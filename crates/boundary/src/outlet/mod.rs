//! Outlet models alone: the pressure that belongs to a flow in time.
//!
//! All of them are the three-element Windkessel, `C dp_c/dt = Q - (p_c - p_d)/R_d` and `p = p_c + R_p Q`, which is eq 10
//! of the published scheme without the time derivative of the flow. A resistance is one whose stored pressure
//! does not move.

mod coupling;
mod periodic;

pub use coupling::Coupling;
pub(crate) use coupling::{Outlet, Seen, common_pressure};
pub use periodic::{Cycle, mean_split};

use crate::error::BoundaryError;
use serde::{Deserialize, Serialize};

/// Three-element Windkessel (Westerhof, Lankhaar and Westerhof 2009), with the flow positive out of the vessel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Windkessel {
    /// R_p, of the vessels up to where blood is stored \[Pa s/m^3\].
    pub proximal_resistance: f64,
    /// C \[m^3/Pa\]; 0 stores nothing, infinity holds the stored pressure.
    pub compliance: f64,
    /// R_d, of the vessels behind \[Pa s/m^3\]; infinity lets nothing out.
    pub distal_resistance: f64,
    /// p_d, what the stored pressure falls to \[Pa\].
    pub distal_pressure: f64,
}

/// Where an outlet model stands; all that its next step needs to know.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OutletState {
    /// p at the cap \[Pa\].
    pub pressure: f64,
    /// p_c, behind the proximal resistance \[Pa\].
    pub stored_pressure: f64,
    /// Q, out of the vessel \[m^3/s\].
    pub flow: f64,
}

impl OutletState {
    /// No flow, at a pressure \[Pa\].
    pub fn at_rest(pressure: f64) -> Self {
        Self { pressure, stored_pressure: pressure, flow: 0.0 }
    }
}

/// How a Windkessel goes on in time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Integration {
    /// Exact for a flow that changes linearly over the step, whatever its length.
    #[default]
    Exponential,
    /// Heun's two stages for the pressure at the cap, with the time derivative of the flow, as published. Stable only
    /// below [`Windkessel::stable_step`], of second order.
    ModifiedEuler,
}

/// The stored pressure above the distal one after a step is
/// `keep y + constant Q_0 + rising (Q_1 - Q_0)`.
#[derive(Clone, Copy, Debug)]
struct Response {
    keep: f64,
    constant: f64,
    rising: f64,
}

impl Windkessel {
    /// A resistance R \[Pa s/m^3\] against a base pressure p_0 \[Pa\], `p = p_0 + R Q` (eq 9 of the published scheme).
    pub fn resistance(resistance: f64, base_pressure: f64) -> Self {
        Self {
            proximal_resistance: resistance,
            compliance: f64::INFINITY,
            distal_resistance: f64::INFINITY,
            distal_pressure: base_pressure,
        }
    }

    /// Whether all numbers have a meaning.
    ///
    /// # Errors
    /// Names the first that has none.
    pub fn validate(&self) -> Result<(), BoundaryError> {
        let refuse = |key, value, allowed| Err(BoundaryError::OutOfRange { key, value, allowed });
        if !(self.proximal_resistance >= 0.0 && self.proximal_resistance.is_finite()) {
            return refuse("proximal_resistance", self.proximal_resistance, "zero or more, in Pa s/m^3");
        }
        if self.compliance.is_nan() || self.compliance < 0.0 {
            return refuse("compliance", self.compliance, "zero or more, in m^3/Pa");
        }
        if self.distal_resistance.is_nan() || self.distal_resistance <= 0.0 {
            return refuse("distal_resistance", self.distal_resistance, "more than zero, in Pa s/m^3");
        }
        if !self.distal_pressure.is_finite() {
            return refuse("distal_pressure", self.distal_pressure, "a finite pressure in Pa");
        }
        if self.compliance == 0.0 && self.distal_resistance.is_infinite() {
            return Err(BoundaryError::Blocked);
        }
        Ok(())
    }

    /// Time constant R_d C of the outflow from the store \[s\].
    pub fn time_constant(&self) -> f64 {
        if self.compliance == 0.0 { 0.0 } else { self.distal_resistance * self.compliance }
    }

    /// Longest step at which [`Integration::ModifiedEuler`] does not grow by itself, 2 R_d C \[s\].
    pub fn stable_step(&self) -> f64 {
        2.0 * self.time_constant()
    }

    /// Pressure per flow that the cap sees after a constant flow has lasted `duration` \[s\] \[Pa s/m^3\].
    pub fn impedance(&self, duration: f64) -> f64 {
        self.proximal_resistance + self.response(duration).constant
    }

    /// Pressure at the end of a step of `duration` \[s\] per flow at its end \[Pa s/m^3\].
    pub(crate) fn slope(&self, duration: f64) -> f64 {
        self.proximal_resistance + self.response(duration).rising
    }

    /// Mean pressure per mean flow, R_p + R_d \[Pa s/m^3\]; R_p alone for a resistance.
    pub fn total_resistance(&self) -> f64 {
        let resistance_only = self.compliance.is_infinite() && self.distal_resistance.is_infinite();
        self.proximal_resistance + if resistance_only { 0.0 } else { self.distal_resistance }
    }

    fn response(&self, duration: f64) -> Response {
        if self.compliance == 0.0 {
            return Response { keep: 0.0, constant: self.distal_resistance, rising: self.distal_resistance };
        }
        let x = duration / self.time_constant();
        let filled = duration / self.compliance;
        // (1 - e^-x)/x and (1 - that)/x; the quotients lose their digits for small x.
        let (first, second) = if x < 1e-3 {
            let second = 0.5 - x / 6.0 * (1.0 - x / 4.0 * (1.0 - x / 5.0));
            (1.0 - x * second, second)
        } else {
            let first = -(-x).exp_m1() / x;
            (first, (1.0 - first) / x)
        };
        Response { keep: (-x).exp(), constant: filled * first, rising: filled * second }
    }

    /// The state after a step of `duration` \[s\] at whose end `flow` \[m^3/s\] leaves the vessel.
    pub fn advance(
        &self,
        state: &OutletState,
        flow: f64,
        duration: f64,
        integration: Integration,
    ) -> OutletState {
        let resistance = self.proximal_resistance;
        match integration {
            Integration::Exponential => {
                let Response { keep, constant, rising } = self.response(duration);
                let stored_pressure = self.distal_pressure
                    + keep * (state.stored_pressure - self.distal_pressure)
                    + constant * state.flow
                    + rising * (flow - state.flow);
                OutletState { pressure: stored_pressure + resistance * flow, stored_pressure, flow }
            }
            Integration::ModifiedEuler => {
                let outflow = 1.0 / self.time_constant();
                let inflow = resistance * outflow + 1.0 / self.compliance;
                let change = resistance * (flow - state.flow) / duration;
                let rate = |p: f64, q: f64| (self.distal_pressure - p) * outflow + q * inflow + change;
                let k1 = rate(state.pressure, state.flow);
                let k2 = rate(state.pressure + duration * k1, flow);
                let pressure = state.pressure + 0.5 * duration * (k1 + k2);
                OutletState { pressure, stored_pressure: pressure - resistance * flow, flow }
            }
        }
    }
}

#[cfg(test)]
mod acoustics;
#[cfg(test)]
mod tests;

//! What is imposed at an opening, and what is seen there.

use crate::error::BoundaryError;
use crate::outlet::{Outlet, OutletState, Windkessel};
use crate::profile::{Amplitudes, Inlet, Profile};
use crate::waveform::Signal;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use vaso_geometry::Opening;
use vaso_particles::Memory;

/// What is imposed at an opening.
#[derive(Clone, Debug, PartialEq)]
pub enum Condition {
    /// Mean velocity into the vessel \[m/s\] with a shape over the section.
    Velocity {
        /// Shape over the section.
        profile: Profile,
        /// Section mean, positive into the vessel \[m/s\].
        mean: Signal,
    },
    /// Pressure at the cap \[Pa\].
    Pressure {
        /// Pressure over time \[Pa\].
        value: Signal,
    },
    /// Pressure that follows the flow out of the vessel, p = p_d + R Q.
    Resistance {
        /// R \[Pa s/m^3\].
        resistance: f64,
        /// p_d \[Pa\].
        distal_pressure: f64,
    },
    /// Three-element Windkessel.
    Windkessel {
        /// Its resistances and compliance.
        model: Windkessel,
        /// Pressure at the start, without flow \[Pa\].
        initial_pressure: f64,
    },
}

impl Condition {
    /// Whether what is imposed has a meaning.
    ///
    /// # Errors
    /// Names what has none.
    pub fn validate(&self) -> Result<(), BoundaryError> {
        match self {
            Self::Velocity { profile, mean } => profile.validate(mean),
            _ => self.model().map_or(Ok(()), |(model, _)| model.validate()),
        }
    }

    /// Whether it sets a pressure, or relates one to the flow.
    pub fn sets_pressure(&self) -> bool {
        !matches!(self, Self::Velocity { .. })
    }

    /// The outlet model, if it is one, and its pressure at the start \[Pa\].
    pub fn model(&self) -> Option<(Windkessel, f64)> {
        match *self {
            Self::Velocity { .. } | Self::Pressure { .. } => None,
            Self::Resistance { resistance, distal_pressure } => {
                Some((Windkessel::resistance(resistance, distal_pressure), distal_pressure))
            }
            Self::Windkessel { model, initial_pressure } => Some((model, initial_pressure)),
        }
    }
}

/// What went through an opening since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Counters {
    /// Particles put in.
    pub injected: u64,
    /// Particles taken out.
    pub deleted: u64,
    /// Of those, particles the buffer did not own.
    pub strays: u64,
    /// Volume that left the vessel, at rest density \[m^3\].
    pub outflow_volume: f64,
    /// Kinetic energy that the damping of backflow took \[J\].
    pub damped_energy: f64,
}

/// One opening of a run.
#[derive(Clone, Debug)]
pub struct Port {
    /// Cap of the vessel.
    pub opening: Opening,
    /// What is imposed there.
    pub condition: Condition,
    /// What went through.
    pub counters: Counters,
    /// Strength of the damping of backflow, where there is a model.
    pub(crate) backflow_damping: f64,
    /// What passed in the acoustic steps of this advective step.
    pub(crate) passed: Passed,
    /// The model behind a resistance or Windkessel.
    pub(crate) outlet: Option<Outlet>,
    /// The profile behind a velocity.
    pub(crate) inlet: Option<Inlet>,
}

impl Port {
    /// Shows what it carries from step to step, under `name`.
    pub(crate) fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        // What passed is that of one step.
        let Self { opening: _, condition: _, counters, backflow_damping: _, passed: _, outlet, inlet } = self;
        let Counters { injected, deleted, strays, outflow_volume, damped_energy } = counters;
        memory.counts(&format!("{name}.particles"), &mut [injected, deleted, strays]);
        memory.fields(&format!("{name}.sums"), &mut [outflow_volume, damped_energy]);
        if let Some(outlet) = outlet {
            outlet.remember(&format!("{name}.outlet"), memory);
        }
        if let Some(inlet) = inlet {
            inlet.remember(&format!("{name}.inlet"), memory);
        }
    }

    /// Way of the particles of the buffer that leads a unit length out of the cap. An imposed velocity goes along the vessel: along the normal it would
    /// go through a wall that leans. Where a pressure is imposed they go along the normal, since their continuity looks along the cap only, and would
    /// take a flow across the normal that varies for compression.
    pub(crate) fn stride(&self) -> DVec3 {
        if self.condition.sets_pressure() { self.opening.normal } else { self.opening.stride() }
    }

    /// How far `x` is beside the buffer \[m\], negative in it.
    pub(crate) fn lateral(&self, x: DVec3) -> f64 {
        if self.condition.sets_pressure() { self.opening.lateral(x) } else { self.opening.beside(x) }
    }

    /// Notes how much of each shape of its profile flows in at `t` \[s\]; nothing where it imposes no velocity.
    pub(crate) fn set_amplitudes(&self, t: f64, amplitudes: &mut Amplitudes) {
        if let (Condition::Velocity { mean, .. }, Some(inlet)) = (&self.condition, &self.inlet) {
            inlet.set_amplitudes(mean, t, amplitudes);
        }
    }
}

/// What passed through an opening in some acoustic steps.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Passed {
    /// Their duration \[s\].
    pub time: f64,
    /// Volume out of the vessel at rest density \[m^3\].
    pub volume: f64,
    /// Kinetic energy out of the vessel \[J\].
    pub kinetic_energy: f64,
}

/// Mean state of an opening.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reading {
    /// Flow out of the vessel at rest density, averaged over the particles the buffer owns and over the acoustic steps of the last
    /// advective step \[m^3/s\].
    pub flow: f64,
    /// The imposed pressure, or else the mean over a section just inside the buffer \[Pa\].
    pub pressure: f64,
    /// Kinetic energy that leaves the vessel a second, averaged as the flow is \[W\].
    pub kinetic_power: f64,
    /// Where the outlet model stands, if there is one.
    pub outlet: Option<OutletState>,
}

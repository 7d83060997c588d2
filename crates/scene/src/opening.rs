//! What happens at the openings.

use crate::waveform::Waveform;
use crate::words::{Word, words};

/// The condition at one opening of the vessel.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// Its name in all outputs, unique in the case: letters, digits, `_` and `-`, not a number.
    pub name: String,
    /// Any point near the opening, in the unit of the surface; the nearest opening is meant.
    pub near: [f64; 3],
    /// What holds there.
    pub condition: Condition,
    /// Time over which the prescribed value rises smoothly from zero \[s\]; `None` leaves it to the planner. Always
    /// `None` for outlet models.
    pub ramp: Option<f64>,
    /// How an outlet model takes up the flow; the default where the condition is none.
    pub coupling: Coupling,
    /// How strongly flow that comes in through an outlet model is damped, from 0 (not at all) to 1; `None` where the condition
    /// is none.
    pub backflow_damping: Option<f64>,
}

/// What holds at an opening. Velocity and flow are positive into the vessel, pressures are gauge.
#[derive(Debug, Clone, PartialEq)]
pub enum Condition {
    /// Given mean velocity over the cross-section \[m/s\].
    Velocity {
        /// Shape across the opening.
        profile: Profile,
        /// Mean over the cross-section \[m/s\].
        value: Drive,
    },
    /// Given flow rate \[m^3/s\].
    Flow {
        /// Shape across the opening.
        profile: Profile,
        /// Flow rate \[m^3/s\].
        value: Drive,
    },
    /// Given pressure \[Pa\].
    Pressure {
        /// Pressure \[Pa\].
        value: Drive,
    },
    /// p = p_d + R Q with the outflow Q.
    Resistance {
        /// R \[Pa s/m^3\].
        resistance: f64,
        /// p_d \[Pa\].
        distal_pressure: f64,
    },
    /// Three-element Windkessel: p = p_c + R_p Q, C dp_c/dt = Q - (p_c - p_d)/R_d, with the outflow Q.
    Windkessel {
        /// R_p \[Pa s/m^3\].
        proximal_resistance: f64,
        /// R_d \[Pa s/m^3\].
        distal_resistance: f64,
        /// C \[m^3/Pa\].
        compliance: f64,
        /// p at the start \[Pa\].
        initial_pressure: f64,
        /// Whether the start is that of the periodic cycle under the inflow instead.
        periodic_start: bool,
        /// p_d \[Pa\].
        distal_pressure: f64,
    },
}

impl Condition {
    /// True where the condition fixes how much flows through; false where it fixes a pressure or relates the
    /// pressure to the flow.
    pub fn prescribes_flow(&self) -> bool {
        matches!(self, Self::Velocity { .. } | Self::Flow { .. })
    }

    /// The word of the condition in `case.toml`.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Velocity { .. } => ConditionKind::Velocity,
            Self::Flow { .. } => ConditionKind::Flow,
            Self::Pressure { .. } => ConditionKind::Pressure,
            Self::Resistance { .. } => ConditionKind::Resistance,
            Self::Windkessel { .. } => ConditionKind::Windkessel,
        }
        .word()
    }
}

words! {
    /// The conditions of the file.
    pub(crate) enum ConditionKind {
        Velocity = "velocity",
        Flow = "flow",
        Pressure = "pressure",
        Resistance = "resistance",
        Windkessel = "windkessel",
    }
}

words! {
    /// The profiles of the file.
    pub(crate) enum ProfileKind {
        Plug = "plug",
        Parabolic = "parabolic",
        Power = "power",
        FullyDeveloped = "fully-developed",
        Womersley = "womersley",
    }
}

/// Shape of the velocity across an opening, with unit mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Profile {
    /// The same everywhere.
    Plug,
    /// Fully developed steady flow through a disc, stretched to the rim.
    Parabolic,
    /// `(n + 2)/n (1 - s^n)` at the part `s` of the way from the centre to the rim: the parabola for 2, and blunter the larger
    /// n is.
    Power {
        /// n.
        exponent: f64,
    },
    /// Fully developed steady flow through a section of the shape of the opening.
    FullyDeveloped,
    /// Fully developed pulsatile flow (Womersley 1955), harmonic by harmonic of a periodic waveform.
    Womersley,
}

words! {
    /// The couplings of the file.
    pub(crate) enum CouplingKind {
        Impedance = "impedance",
        Window = "window",
    }
}

/// How an outlet model takes up the flow.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Coupling {
    /// Every acoustic step, implicitly with the acoustic impedance of the cap.
    #[default]
    Impedance,
    /// Once a window, from the mean flow over it.
    Window {
        /// Length of the window \[s\].
        duration: f64,
    },
}

/// A prescribed value, the same at all times or given over time.
#[derive(Debug, Clone, PartialEq)]
pub enum Drive {
    /// The same at all times, in the SI unit of what it prescribes.
    Constant(f64),
    /// Given over time.
    Waveform(Waveform),
}

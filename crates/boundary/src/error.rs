//! What can be wrong with outlets and inlets that a user describes.

/// Why a condition cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BoundaryError {
    /// A number outside of what has a meaning.
    #[error("`{key}` is {value}, allowed is {allowed}")]
    OutOfRange {
        /// The number's name.
        key: &'static str,
        /// Its value, in SI units.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// Nothing stores the blood and nothing lets it out.
    #[error(
        "an outlet without compliance needs a finite `distal_resistance`: nothing would take the flow; give a \
         `compliance` in m^3/Pa"
    )]
    Blocked,
    /// The pressure rises from cycle to cycle.
    #[error(
        "there is no periodic state: {mean_flow} m^3/s flow in on average and an infinite `distal_resistance` lets \
         nothing out"
    )]
    NeverPeriodic {
        /// Mean flow into the outlet \[m^3/s\].
        mean_flow: f64,
    },
    /// A periodic state needs a period.
    #[error("a periodic state needs an inflow that repeats, and the waveform has no period")]
    NoPeriod,
    /// Lists that belong together differ in length.
    #[error("{given} {what} for {outlets} outlets; give one for each")]
    Count {
        /// What was listed.
        what: &'static str,
        /// Length of the list.
        given: usize,
        /// Number of outlets.
        outlets: usize,
    },
    /// No outlet of these can give the asked pressures.
    #[error(
        "a pulse of {pulse} Pa cannot be had with this inflow: without any compliance it is {largest} Pa; ask for a \
         smaller pulse or give an inflow that varies more"
    )]
    TooSteady {
        /// Systolic minus diastolic pressure asked for \[Pa\].
        pulse: f64,
        /// Largest pulse that resistances alone give \[Pa\].
        largest: f64,
    },
    /// A profile that needs harmonics has none.
    #[error("a Womersley profile needs a waveform with a period, and this one has none")]
    ProfileWithoutPeriod,
}

//! All openings of a run, and the pressure level they set.

use crate::impose::Now;
use crate::outlet::{Coupling, Outlet, OutletState, common_pressure};
use crate::port::{Condition, Counters, Passed, Port};
use crate::profile::{Amplitudes, Inlet};
use crate::room::Room;
use num_complex::Complex64;
use vaso_fluid::{CapZone, Numbers};
use vaso_geometry::Opening;
use vaso_particles::{Memory, Selection};

/// Length of a buffer, in spacings.
pub const BUFFER_LENGTH: f64 = 4.0;

/// What the pressure of the fluid is relative to.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reference {
    /// The same at all times \[Pa\].
    Fixed(f64),
    /// The pressure imposed at an opening.
    Opening(usize),
    /// The common pressure of the outlet models.
    Outlets,
}

/// Strength of the damping of backflow at outlet models (Moghadam et al. 2011: 0 to 1).
const BACKFLOW_DAMPING: f64 = 0.5;

/// All openings of a run.
#[derive(Clone, Debug)]
pub struct Openings {
    pub(crate) ports: Vec<Port>,
    pub(crate) numbers: Numbers,
    pub(crate) spacing: f64,
    pub(crate) next_id: u64,
    reference: Reference,
    /// Room behind the cap of each pressure opening, for what comes in there.
    pub(crate) rooms: Vec<Room>,
    pub(crate) zones: Vec<CapZone>,
    /// Steady unit-mean profile value at each zone entry.
    pub(crate) shape: Vec<f64>,
    /// Those of the harmonics, one zone entry after the other where its inlet has any.
    pub(crate) waves: Vec<Complex64>,
    /// Particles behind the buffer of each velocity opening, see [`Self::density_behind`].
    pub(crate) behind: Vec<Selection>,
    /// Particles that a stage looks for.
    pub(crate) found: Selection,
    /// What holds at each opening in an acoustic step.
    pub(crate) now: Vec<Now>,
    /// Volume that the particles of each buffer carry of each shape of its profile \[m^3\].
    pub(crate) carried: Vec<Amplitudes>,
}

impl Openings {
    /// Openings with their conditions, for a fluid of given numbers.
    ///
    /// Without a fixed `reference_pressure` \[Pa\] that of the first pressure opening is followed, or else the common
    /// one of the outlet models: it does no work on a rigid lumen, so the equation of state need not carry it.
    pub fn new(ports: Vec<(Opening, Condition)>, numbers: &Numbers, reference_pressure: Option<f64>) -> Self {
        let length = BUFFER_LENGTH * numbers.spacing;
        let transit = length / numbers.sound_speed;
        let ports: Vec<Port> = ports
            .into_iter()
            .map(|(opening, condition)| {
                let impedance = numbers.rest_density * numbers.sound_speed / opening.area;
                let outlet = condition
                    .model()
                    .map(|(model, pressure)| Outlet::new(model, pressure, impedance, transit, opening.area));
                let inlet = match &condition {
                    Condition::Velocity { profile, mean } => {
                        Some(Inlet::new(*profile, mean, &opening, numbers))
                    }
                    _ => None,
                };
                let backflow_damping = BACKFLOW_DAMPING;
                Port {
                    opening,
                    condition,
                    counters: Counters::default(),
                    backflow_damping,
                    outlet,
                    inlet,
                    passed: Passed::default(),
                }
            })
            .collect();
        let fixed_value = ports.iter().position(|p| matches!(p.condition, Condition::Pressure { .. }));
        let reference = match (reference_pressure, fixed_value) {
            (Some(pressure), _) => Reference::Fixed(pressure),
            (None, Some(k)) => Reference::Opening(k),
            (None, None) if ports.iter().any(|p| p.outlet.is_some()) => Reference::Outlets,
            (None, None) => Reference::Fixed(0.0),
        };
        let room = |p: &Port| match p.condition.sets_pressure() {
            true => Room::new(&p.opening, numbers.spacing),
            false => Room::default(),
        };
        Self {
            rooms: ports.iter().map(room).collect(),
            behind: vec![Selection::default(); ports.len()],
            found: Selection::default(),
            now: vec![Now::default(); ports.len()],
            carried: vec![Amplitudes::default(); ports.len()],
            ports,
            numbers: *numbers,
            spacing: numbers.spacing,
            next_id: 0,
            reference,
            zones: Vec::new(),
            shape: Vec::new(),
            waves: Vec::new(),
        }
    }

    /// Chooses how the outlet model of opening `k` takes up the flow; [`Coupling::Impedance`] unless called. Nothing happens
    /// at other openings.
    pub fn set_coupling(&mut self, k: usize, coupling: Coupling) {
        if let Some(outlet) = &mut self.ports[k].outlet {
            outlet.coupling = coupling;
        }
    }

    /// Sets how strongly flow that comes in through the outlet model of opening `k` is damped: 0 not at all, 0.5 unless called, at
    /// most 1 (Moghadam et al. 2011, there beta).
    pub fn set_backflow_damping(&mut self, k: usize, strength: f64) {
        self.ports[k].backflow_damping = strength;
    }

    /// Puts the outlet model of opening `k` into a state, such as the start of its periodic cycle
    /// ([`Windkessel::periodic`](crate::Windkessel::periodic)); nothing happens at other openings.
    pub fn set_outlet(&mut self, k: usize, state: OutletState) {
        if let Some(outlet) = &mut self.ports[k].outlet {
            outlet.state.outlet = state;
        }
    }

    /// Shows all that the openings carry from step to step; what has been read stands for [`Self::start`].
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        let Self {
            ports,
            next_id,
            numbers: _,
            spacing: _,
            reference: _,
            // Found anew at the begin of each step.
            rooms: _,
            zones: _,
            shape: _,
            waves: _,
            behind: _,
            found: _,
            now: _,
            carried: _,
        } = self;
        memory.counts("openings.next_id", &mut [next_id]);
        for (k, port) in ports.iter_mut().enumerate() {
            port.remember(&format!("openings.{k}"), memory);
        }
    }

    /// The openings.
    pub fn ports(&self) -> &[Port] {
        &self.ports
    }

    /// Identity the next new particle will get.
    pub fn next_id(&self) -> u64 {
        self.next_id
    }

    /// Particles near caps, as [`Self::locate`] found them.
    pub fn zones(&self) -> &[CapZone] {
        &self.zones
    }

    /// Reference pressure at `t` \[s\], which the fluid's pressure is relative to \[Pa\]; where it is that of outlet models,
    /// the one of their last step.
    pub fn reference_pressure(&self, t: f64) -> f64 {
        match self.reference {
            Reference::Fixed(pressure) => pressure,
            Reference::Opening(k) => self.pressure_value(k, t).unwrap_or(0.0),
            Reference::Outlets => common_pressure(self.ports.iter().filter_map(|p| p.outlet.as_ref())),
        }
    }

    /// Pressure imposed at opening `k` at `t` \[s\], if it imposes one \[Pa\]; of an outlet model, that of its last
    /// step.
    pub fn pressure_value(&self, k: usize, t: f64) -> Option<f64> {
        let port = &self.ports[k];
        match &port.condition {
            Condition::Pressure { value } => Some(value.at(t)),
            _ => port.outlet.as_ref().map(|outlet| outlet.state.outlet.pressure),
        }
    }

    pub(crate) fn buffer_length(&self) -> f64 {
        BUFFER_LENGTH * self.spacing
    }
}

//! The section behind the buffer of a velocity, whose pressure the buffer takes on.

use crate::buffer::FRINGE;
use crate::openings::Openings;
use vaso_fluid::FluidState;

/// Length of the section, in spacings.
const LENGTH: f64 = 2.0;

impl Openings {
    /// Finds the particles of the sections; an advective step begins.
    pub(crate) fn find_sections(&mut self, state: &FluidState) {
        let from = self.buffer_length() + FRINGE * self.spacing;
        let to = from + LENGTH * self.spacing;
        for (port, behind) in self.ports.iter().zip(&mut self.behind) {
            if !port.condition.sets_pressure() {
                behind.find(state.len(), |i| {
                    let x = state.position[i];
                    (from..to).contains(&port.opening.depth(x)) && port.lateral(x) < self.spacing
                });
            }
        }
    }

    /// Mean density change \[kg/m^3\] of the section behind the buffer of opening `k`, which is that of the buffer; `None` where there is no
    /// velocity imposed, or nothing behind.
    ///
    /// A flow that is imposed has no divergence, so no density of its own. With a pressure of their own, behind that of the vessel,
    /// particles of the buffer would give way to sound like a soft wall: those behind it pile up, their kernel sum exceeds their
    /// density, and the blend of the two feeds the sound.
    pub(crate) fn density_behind(&self, k: usize, state: &FluidState) -> Option<f64> {
        let section = self.behind[k].chosen();
        let sum: f64 = section.iter().map(|&i| state.density_change[i as usize]).sum();
        (!section.is_empty()).then(|| sum / section.len() as f64)
    }
}

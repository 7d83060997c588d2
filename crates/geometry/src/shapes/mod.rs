//! Surfaces made from a few numbers, for tests and cases: always closed, outward, and the same every time.

mod arch;
mod axial;
mod bifurcation;
mod cut;
mod even;
mod implicit;
mod junction;
mod nets;
mod pipe;
mod rings;

pub use arch::{ArchBranch, ArchSpec, aortic_arch};
pub use axial::{axial, cosine_change};
pub use bifurcation::{BifurcationSpec, bifurcation};
pub use pipe::{bent_pipe, pipe};

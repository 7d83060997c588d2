//! Tests of whole bodies, one program: each would compile the pair loops anew.

mod energy;
mod kinematics;
mod large;
mod loads;
mod statics;
mod steps;
mod support;
mod tubes;

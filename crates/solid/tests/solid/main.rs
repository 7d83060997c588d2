//! Tests of whole bodies, one program: each would compile the pair loops anew.

mod beams;
mod columns;
mod energy;
mod hypo_elastic;
mod kinematics;
mod loads;
mod support;
mod tubes;

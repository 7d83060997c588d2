//! Flows against formulas, published numbers and what must not happen. They are unit tests of this library rather than
//! programs of their own, because each of those would compile the pair loops anew.

mod aorta;
mod carotid;
mod determinism;
mod elastic_tube;
mod fibers;
mod moving_wall;
mod narrowing;
mod near_wall;
mod openings;
mod outlet_crowding;
mod shear_thinning;
mod shell_walls;
mod shells;
mod stability;
mod steps;
mod tube;
mod validation;

//! Tests of walls beside a fluid, one program: each would compile the pair loops anew.

mod columns;
mod reaction;
mod shell_wall;

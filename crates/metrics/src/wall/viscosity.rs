//! Where the viscosity at the wall comes from.

/// Dynamic viscosity of the blood, as wall shear stress needs it.
#[derive(Clone, Copy)]
pub enum Viscosity<'a> {
    /// The same everywhere \[Pa s\].
    Constant(f64),
    /// A law: viscosity \[Pa s\] at a shear rate `sqrt(2 D:D)` \[1/s\]. It is asked at the shear rate of the wall itself,
    /// which for a shear-thinning law makes it the most accurate choice.
    ShearRate(&'a (dyn Fn(f64) -> f64 + Sync)),
    /// One value a fluid particle \[Pa s\], continued linearly to the wall.
    PerParticle(&'a [f64]),
}

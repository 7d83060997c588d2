//! The one table of field names: what the physics writes, what ParaView lists, what the report looks up.

/// Names and units of the point data in `fluid.vtkhdf`, `wall.vtkhdf` and `particles.vtkhdf`.
///
/// Dimensionless fields have the unit `"1"`.
pub const FIELDS: &[(&str, &str)] = &[
    (VELOCITY, "m/s"),
    (PRESSURE, "Pa"),
    (DENSITY, "kg/m^3"),
    (ID, "1"),
    (DISPLACEMENT, "m"),
    (VON_MISES, "Pa"),
    (STRESS_DIAGONAL, "Pa"),
    (STRESS_SHEAR, "Pa"),
    (PRINCIPAL_STRETCHES, "1"),
    (WSS, "Pa"),
    (TAWSS, "Pa"),
    (OSI, "1"),
    (RRT, "1/Pa"),
    (ECAP, "1/Pa"),
    (TRANSVERSE_WSS, "Pa"),
    (PEAK_WSS, "Pa"),
    (NORMAL, "1"),
    (THICKNESS, "m"),
    (VON_MISES_INNER, "Pa"),
    (VON_MISES_OUTER, "Pa"),
    (STRESS_INNER_MAX, "Pa"),
    (STRESS_INNER_MIN, "Pa"),
    (STRESS_OUTER_MAX, "Pa"),
    (STRESS_OUTER_MIN, "Pa"),
    (VOLUME, "m^3"),
    (DEPTH, "m"),
    (AREA, "m^2"),
    (CURVATURE_MAX, "1/m"),
    (CURVATURE_MIN, "1/m"),
    (CLAMPED, "1"),
    (BODY, "1"),
];

/// Fluid velocity \[m/s\].
pub const VELOCITY: &str = "Velocity";
/// Gauge pressure \[Pa\].
pub const PRESSURE: &str = "Pressure";
/// Density \[kg/m^3\].
pub const DENSITY: &str = "Density";
/// Identity of a particle for its whole life.
pub const ID: &str = "Id";
/// Displacement of the wall from its reference place \[m\].
pub const DISPLACEMENT: &str = "Displacement";
/// Von Mises stress of the wall \[Pa\].
pub const VON_MISES: &str = "VonMises";
/// Cauchy stress of the wall, xx, yy and zz \[Pa\].
pub const STRESS_DIAGONAL: &str = "CauchyStressDiagonal";
/// Cauchy stress of the wall, xy, yz and zx \[Pa\].
pub const STRESS_SHEAR: &str = "CauchyStressShear";
/// Principal stretches of the wall, largest first.
pub const PRINCIPAL_STRETCHES: &str = "PrincipalStretches";
/// Wall shear stress vector: the force of the fluid on the wall per area \[Pa\].
pub const WSS: &str = "WSS";
/// Time average of the magnitude of the wall shear stress over a cycle \[Pa\].
pub const TAWSS: &str = "TAWSS";
/// Oscillatory shear index, 0 to 0.5.
pub const OSI: &str = "OSI";
/// Relative residence time \[1/Pa\].
pub const RRT: &str = "RRT";
/// Endothelial cell activation potential \[1/Pa\].
pub const ECAP: &str = "ECAP";
/// Time average of the wall shear stress across its mean direction \[Pa\].
pub const TRANSVERSE_WSS: &str = "TransverseWSS";
/// Largest magnitude of the wall shear stress in a cycle \[Pa\].
pub const PEAK_WSS: &str = "PeakWSS";
/// Unit normal of the wall.
pub const NORMAL: &str = "Normal";
/// Von Mises stress on the face of the lumen of a shell \[Pa\].
pub const VON_MISES_INNER: &str = "VonMisesInner";
/// Von Mises stress on the outer face of a shell \[Pa\].
pub const VON_MISES_OUTER: &str = "VonMisesOuter";
/// The larger principal stress in the face of the lumen of a shell \[Pa\].
pub const STRESS_INNER_MAX: &str = "PrincipalStressInnerMax";
/// The smaller one \[Pa\].
pub const STRESS_INNER_MIN: &str = "PrincipalStressInnerMin";
/// The larger principal stress in the outer face of a shell \[Pa\].
pub const STRESS_OUTER_MAX: &str = "PrincipalStressOuterMax";
/// The smaller one \[Pa\].
pub const STRESS_OUTER_MIN: &str = "PrincipalStressOuterMin";
/// Thickness of a shell \[m\].
pub const THICKNESS: &str = "Thickness";
/// Volume of a particle \[m^3\].
pub const VOLUME: &str = "Volume";
/// Distance of a wall particle outside the lumen surface \[m\].
pub const DEPTH: &str = "Depth";
/// Area of a particle of a shell \[m^2\].
pub const AREA: &str = "Area";
/// The larger principal curvature of a shell \[1/m\], positive where normals spread.
pub const CURVATURE_MAX: &str = "CurvatureMax";
/// The smaller principal curvature of a shell \[1/m\].
pub const CURVATURE_MIN: &str = "CurvatureMin";
/// 1 for a particle of a wall that is held at an opening, else 0.
pub const CLAMPED: &str = "Clamped";
/// Body of a particle where one file holds several: see [`crate::particles::BodyKind`].
pub const BODY: &str = "Body";

/// Unit of a field of the table; `None` for a name that is not in it.
pub fn unit(field: &str) -> Option<&'static str> {
    FIELDS.iter().find(|(name, _)| *name == field).map(|(_, unit)| *unit)
}

//! What the blood and the wall are made of, and what holds and loads the wall.

use crate::opening::Drive;
use crate::words::words;

/// The fluid.
#[derive(Debug, Clone, PartialEq)]
pub struct Blood {
    /// Rest density \[kg/m^3\].
    pub density: f64,
    /// Viscosity law.
    pub viscosity: Viscosity,
}

/// Viscosity as a function of the shear rate g = sqrt(2 D:D) \[1/s\].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Viscosity {
    /// The same at every shear rate.
    Newtonian {
        /// Dynamic viscosity \[Pa s\].
        viscosity: f64,
    },
    /// eta = eta_inf + (eta_0 - eta_inf) (1 + (lambda g)^a)^((n - 1)/a). The Carreau law is the case a = 2, and is
    /// read into this variant.
    CarreauYasuda {
        /// eta_0, viscosity at rest \[Pa s\].
        zero_shear_viscosity: f64,
        /// eta_inf, viscosity at a large shear rate \[Pa s\].
        infinite_shear_viscosity: f64,
        /// lambda \[s\].
        relaxation_time: f64,
        /// n, the power-law index.
        index: f64,
        /// a, the sharpness of the transition.
        transition: f64,
    },
    /// sqrt(eta) = sqrt(tau_y/g) + sqrt(eta_c).
    Casson {
        /// tau_y \[Pa\].
        yield_stress: f64,
        /// eta_c, viscosity at a large shear rate \[Pa s\].
        infinite_shear_viscosity: f64,
    },
    /// eta = k g^(n - 1).
    PowerLaw {
        /// k: the viscosity at a shear rate of 1/s \[Pa s\].
        consistency: f64,
        /// n, the power-law index.
        index: f64,
    },
}

words! {
    /// The viscosity laws of the file.
    pub(crate) enum ViscosityModel {
        Newtonian = "newtonian",
        Carreau = "carreau",
        CarreauYasuda = "carreau-yasuda",
        Casson = "casson",
        PowerLaw = "power-law",
    }
}

/// The vessel wall.
#[derive(Debug, Clone, PartialEq)]
pub enum Wall {
    /// Does not move; represented by layers of particles outside the surface.
    Rigid,
    /// Does not move; represented by one layer of particles.
    RigidShell,
    /// Deforms; resolved through its thickness.
    Solid(ElasticWall),
    /// Deforms; one layer of shell particles.
    Shell(ElasticWall),
}

words! {
    /// The wall models of the file.
    pub(crate) enum WallModel {
        Rigid = "rigid",
        RigidShell = "rigid-shell",
        Solid = "solid",
        Shell = "shell",
    }
}

/// How the wall is made of particles, whatever its model.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct WallBody {
    /// Thickness, outwards from the surface \[m\]; `None` for a rigid wall that leaves it to the spacing.
    pub thickness: Option<f64>,
    /// Where it ends at the openings; `None` leaves it to the model.
    pub open_ends: Option<OpenEnds>,
}

/// A wall that deforms.
#[derive(Debug, Clone, PartialEq)]
pub struct ElasticWall {
    /// Constitutive law.
    pub material: Material,
    /// Thickness, outwards from the surface \[m\].
    pub thickness: f64,
    /// Distance between its particles \[m\]; `None` leaves it to the planner.
    pub spacing: Option<f64>,
    /// Density at rest \[kg/m^3\].
    pub density: f64,
    /// What holds the wall at the openings.
    pub ends: Ends,
    /// What takes energy out of its motion.
    pub damping: Damping,
    /// Tissue around the wall.
    pub support: Option<Support>,
    /// Gauge pressure of the blood at which the wall is without load in the shape of the surface \[Pa\].
    pub unloaded_pressure: f64,
    /// Gauge pressure on the outer face \[Pa\].
    pub external_pressure: f64,
    /// Gauge pressure on the inner face \[Pa\]; present exactly when the scene has no blood.
    pub pressure: Option<Drive>,
}

/// Constitutive law of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Material {
    /// Nearly incompressible neo-Hookean.
    NeoHookean(Elasticity),
    /// Saint Venant-Kirchhoff: linear between Green strain and second Piola-Kirchhoff stress.
    SaintVenantKirchhoff(Elasticity),
    /// Linear between rate of deformation and Jaumann stress rate.
    Hypoelastic(Elasticity),
    /// Two families of fibres in a neo-Hookean matrix (Gasser, Ogden, Holzapfel 2006).
    HolzapfelGasserOgden(Fibers),
}

/// Constants of a matrix with two families of fibres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fibers {
    /// c, shear modulus of the matrix \[Pa\].
    pub matrix_modulus: f64,
    /// k1, stiffness of the fibres \[Pa\].
    pub fiber_modulus: f64,
    /// k2, exponent of their stiffening.
    pub fiber_exponent: f64,
    /// kappa, dispersion of their directions, from 0 (aligned) to 1/3 (isotropic).
    pub fiber_dispersion: f64,
    /// Angle between fibres and circumferential direction \[rad\].
    pub fiber_angle: f64,
    /// Poisson's ratio of the matrix, which sets the bulk modulus.
    pub poisson_ratio: f64,
}

words! {
    /// The wall materials of the file.
    pub(crate) enum MaterialModel {
        NeoHookean = "neo-hookean",
        SaintVenantKirchhoff = "saint-venant-kirchhoff",
        Hypoelastic = "hypoelastic",
        HolzapfelGasserOgden = "holzapfel-gasser-ogden",
    }
}

/// Isotropic elastic constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// Young's modulus \[Pa\].
    pub young_modulus: f64,
    /// Poisson's ratio.
    pub poisson_ratio: f64,
}

words! {
    /// What holds the wall at the openings.
    pub enum Ends {
        /// Neither moves nor turns.
        Clamped = "clamped",
        /// Moves in the plane of the opening only.
        Sliding = "sliding",
        /// Not held.
        Free = "free",
    }
}

words! {
    /// Where the particles of a wall end at the openings.
    pub enum OpenEnds {
        /// In the plane of the cap; what is nearer to it than to the wall is left out.
        ClosestCap = "closest-cap",
        /// In the plane of the cap; what stands in a box on it is left out.
        Boxes = "boxes",
        /// Beyond the cap, straight on for a kernel support.
        Collar = "collar",
    }
}

impl OpenEnds {
    /// The words a shell may have: nothing of it has to be taken out, so there are no boxes.
    pub(crate) const OF_SHELLS: &'static [&'static str] = &["closest-cap", "collar"];
}

words! {
    /// What takes energy out of the motion of the wall.
    pub enum Damping {
        /// Nothing but the load.
        None = "none",
        /// Viscosity of the material.
        Material = "material",
        /// As much as brings it to rest soonest.
        QuasiStatic = "quasi-static",
    }
}

/// Tissue around the wall: traction -(stiffness u + damping du/dt) on the outer face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Support {
    /// Traction per displacement \[Pa/m\].
    pub stiffness: f64,
    /// Traction per velocity \[Pa s/m\].
    pub damping: f64,
}

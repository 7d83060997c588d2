//! Wall shear stress at points of the vessel surface.

mod fit;
mod mesh;
mod near;
mod shear;
mod viscosity;

pub use mesh::WallMesh;
pub use near::NearWallDistance;
pub use shear::{ShearSample, WallMotion, WallShear};
pub use viscosity::Viscosity;

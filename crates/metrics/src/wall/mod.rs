//! Wall shear stress at points of the vessel surface, and its indices over a cycle.

mod anchors;
mod carried;
mod cycles;
mod fit;
mod indices;
mod integral;
mod mesh;
mod near;
mod shear;
mod viscosity;
mod window;

pub use carried::{CarriedWall, WallPose};
pub use cycles::ShearCycles;
pub use indices::{LARGEST_INVERSE, PointIndices, SHEAR_DEFINITIONS, STRESS_DEFINITION, ShearCycle};
pub use mesh::WallMesh;
pub use near::NearWallDistance;
pub use shear::{ShearSample, WallMotion, WallShear};
pub use viscosity::Viscosity;
pub use window::ShearWindow;

//! Wall shear stress at all points of a wall.

use crate::error::MetricsError;
use crate::wall::fit::{Fit, FitPoint, Line};
use crate::wall::near::NearWall;
use crate::wall::viscosity::Viscosity;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_particles::WallDistance;

/// Radius of the fit \[spacings\]: the smallest with enough particles, because a larger one sees less of a thin boundary layer.
const SUPPORT: f64 = 2.6;
/// Radius tried where too few particles lie within [`SUPPORT`] \[spacings\].
const WIDE_SUPPORT: f64 = 3.9;

/// How the points of a wall move.
#[derive(Clone, Copy, Debug)]
pub struct WallMotion<'a> {
    /// Velocity of each point \[m/s\].
    pub velocity: &'a [DVec3],
    /// Derivative of the velocity of the wall along the wall at each point, `G[i][j] = d v_i / d x_j` \[1/s\].
    pub gradient: &'a [DMat3],
}

/// Wall shear stress of one instant.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearSample {
    /// Force a unit area that the blood exerts along the wall \[Pa\], one entry a point; `None` where too few particles are
    /// near to tell.
    pub stress: Vec<Option<DVec3>>,
    /// Points whose fit had to reach out to 3.9 spacings.
    pub widened: usize,
}

impl ShearSample {
    /// Points without a value.
    pub fn missing(&self) -> usize {
        self.stress.iter().filter(|stress| stress.is_none()).count()
    }
}

/// Wall shear stress at given points of a wall, from the velocities of particles.
///
/// `tau = mu (I - n n) (grad v + grad v^T) m` with `m = -n` into the lumen: the drag on the wall. The gradient comes from
/// constrained moving least squares (Lancaster and Salkauskas 1981) in the distance from the wall, with the velocity of the wall
/// on the wall.
#[derive(Clone, Debug)]
pub struct WallShear {
    position: Vec<DVec3>,
    normal: Vec<DVec3>,
    spacing: f64,
}

impl WallShear {
    /// Estimator for the points at `position` \[m\] with unit `normal` out of the lumen, in fluid of the given spacing \[m\].
    ///
    /// # Errors
    /// When the spacing is not positive, or there are not as many normals as points.
    pub fn new(position: Vec<DVec3>, normal: Vec<DVec3>, spacing: f64) -> Result<Self, MetricsError> {
        MetricsError::positive("spacing", spacing)?;
        MetricsError::length("normal", normal.len(), position.len())?;
        Ok(Self { position, normal, spacing })
    }

    /// The points \[m\].
    pub fn position(&self) -> &[DVec3] {
        &self.position
    }

    /// Their unit normals, out of the lumen.
    pub fn normal(&self) -> &[DVec3] {
        &self.normal
    }

    /// Distance from the wall up to which distances had better be exact \[m\]: that of all particles a fit uses, unless they
    /// are few.
    pub fn reach(&self) -> f64 {
        SUPPORT * self.spacing
    }

    /// Distance from the wall of the farthest particle that a fit may use where particles are few \[m\].
    pub fn wide_reach(&self) -> f64 {
        WIDE_SUPPORT * self.spacing
    }

    /// Wall shear stress of fluid particles at `position` \[m\] with `velocity` \[m/s\] along a wall at rest.
    ///
    /// `distance` has to be that of the surface the points lie on; it is asked once or twice a particle.
    ///
    /// # Errors
    /// When the columns differ in length.
    pub fn evaluate(
        &self,
        position: &[DVec3],
        velocity: &[DVec3],
        distance: &dyn WallDistance,
        viscosity: Viscosity,
    ) -> Result<ShearSample, MetricsError> {
        self.run(position, velocity, distance, viscosity, None)
    }

    /// As [`evaluate`](Self::evaluate), along a wall that moves.
    ///
    /// # Errors
    /// When columns differ in length.
    pub fn evaluate_moving(
        &self,
        position: &[DVec3],
        velocity: &[DVec3],
        distance: &dyn WallDistance,
        viscosity: Viscosity,
        motion: WallMotion,
    ) -> Result<ShearSample, MetricsError> {
        MetricsError::length("wall velocity", motion.velocity.len(), self.position.len())?;
        MetricsError::length("wall velocity gradient", motion.gradient.len(), self.position.len())?;
        self.run(position, velocity, distance, viscosity, Some(motion))
    }

    fn run(
        &self,
        position: &[DVec3],
        velocity: &[DVec3],
        distance: &dyn WallDistance,
        viscosity: Viscosity,
        motion: Option<WallMotion>,
    ) -> Result<ShearSample, MetricsError> {
        MetricsError::length("velocity", velocity.len(), position.len())?;
        if let Viscosity::PerParticle(values) = viscosity {
            MetricsError::length("viscosity", values.len(), position.len())?;
        }
        let bounds = self
            .position
            .iter()
            .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)));
        if self.position.is_empty() {
            return Ok(ShearSample { stress: Vec::new(), widened: 0 });
        }
        let near = |support: f64| {
            let reach = support * self.spacing;
            (NearWall::new(position, velocity, distance, bounds, reach), reach)
        };
        let (set, support) = near(SUPPORT);
        let mut stress: Vec<Option<DVec3>> = (0..self.position.len())
            .into_par_iter()
            .with_min_len(64)
            .map(|k| self.at(k, &set, support, viscosity, motion))
            .collect();
        let poor: Vec<usize> = (0..stress.len()).filter(|&k| stress[k].is_none()).collect();
        if poor.is_empty() {
            return Ok(ShearSample { stress, widened: 0 });
        }
        let (set, support) = near(WIDE_SUPPORT);
        let wide: Vec<Option<DVec3>> =
            poor.par_iter().map(|&k| self.at(k, &set, support, viscosity, motion)).collect();
        let widened = wide.iter().flatten().count();
        for (k, value) in poor.into_iter().zip(wide) {
            stress[k] = value;
        }
        Ok(ShearSample { stress, widened })
    }

    /// Stress at point `k` from the particles within `support` \[m\].
    fn at(
        &self,
        k: usize,
        near: &NearWall,
        support: f64,
        viscosity: Viscosity,
        motion: Option<WallMotion>,
    ) -> Option<DVec3> {
        let (x, normal) = (self.position[k], self.normal[k]);
        let (wall_velocity, wall_gradient) = motion
            .map_or((DVec3::ZERO, DMat3::ZERO), |m| (m.velocity[k], without_shear(m.gradient[k], normal)));
        let mut fit = Fit::new(FitPoint { position: x, normal, spacing: self.spacing });
        let mut line = Line::new();
        for (particle, squared) in near.within(x, support) {
            let carried = wall_velocity + wall_gradient * (particle.position - x);
            let counted = fit.add(particle, squared, support, carried);
            if let (Viscosity::PerParticle(values), Some(place)) = (viscosity, counted) {
                line.add(place, values[particle.number as usize]);
            }
        }
        let shear = fit.shear()?;
        let mu = match viscosity {
            Viscosity::Constant(mu) => mu,
            Viscosity::ShearRate(law) => {
                let gradient = wall_gradient + outer(shear, -normal);
                // D:D = |grad v + grad v^T|^2 / 4
                law((0.5 * squared_norm(gradient + gradient.transpose())).sqrt())
            }
            Viscosity::PerParticle(_) => line.at_wall(),
        };
        Some(mu * shear)
    }
}

/// The velocity gradient of fluid that moves with the wall and does not shear it: along the wall that of the wall, across it
/// what makes `(G + G^T) n` vanish along the wall. For a wall that turns as a whole it is the turning of all space, so the
/// stress does not depend on the frame.
fn without_shear(gradient: DMat3, normal: DVec3) -> DMat3 {
    let along = gradient - outer(gradient * normal, normal);
    let tilt = along.transpose() * normal;
    along - outer(tilt, normal)
}

/// `a b^T`.
pub(super) fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

fn squared_norm(m: DMat3) -> f64 {
    m.x_axis.length_squared() + m.y_axis.length_squared() + m.z_axis.length_squared()
}

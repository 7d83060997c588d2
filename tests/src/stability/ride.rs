//! A flow under watch: what must hold whatever happens.

use glam::DVec3;
use vaso_coupling::MovingWall;
use vaso_driver::{Diverged, Flow};
use vaso_geometry::SignedDistance;

use crate::validation::{Outcome, Tolerance, Unit};

/// What a ride showed.
#[derive(Clone, Debug, Default)]
pub struct Ride {
    /// Fluid particles at the start and at the end.
    pub particles: (usize, usize),
    /// Largest speed of any particle at any advective step \[m/s\].
    pub top_speed: f64,
    /// Smallest distance between two particles at the end \[spacings\].
    pub least_distance: f64,
    /// Largest density deviation \[-\].
    pub density: f64,
    /// Largest Mach number \[-\].
    pub mach: f64,
    /// Particles lost through the wall.
    pub escaped: u64,
    /// Time of the loop \[s\].
    pub seconds: f64,
}

impl Ride {
    /// Adds the invariants to an outcome: a density deviation of `density` at most, a Mach number of a fifth, nobody lost.
    pub fn invariants(&self, what: &str, density: f64, outcome: &mut Outcome) {
        let name = |text: &str| if what.is_empty() { text.to_owned() } else { format!("{what}: {text}") };
        outcome.particles = outcome.particles.max(self.particles.1);
        outcome.seconds += self.seconds;
        outcome.figure(
            name("largest density deviation"),
            self.density,
            Unit::Part,
            Tolerance::Asked(density),
        );
        outcome.figure(name("largest Mach number"), self.mach, Unit::Number, Tolerance::Asked(0.2));
        outcome.figure(name("particles lost"), self.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    }
}

/// Runs a flow to `end` \[s\] and shows each advective step to `see`.
///
/// # Errors
/// When it breaks down.
pub fn ride<W: MovingWall>(
    flow: &mut Flow<f32, W>,
    end: f64,
    mut see: impl FnMut(&Flow<f32, W>),
) -> Result<Ride, Diverged> {
    let start = flow.fluid.state.len();
    let mut top_speed: f64 = 0.0;
    while flow.time < end {
        flow.step(end)?;
        top_speed = flow.fluid.state.velocity.iter().map(|v| v.length()).fold(top_speed, f64::max);
        see(flow);
    }
    let spacing = flow.fluid.numbers().spacing;
    Ok(Ride {
        particles: (start, flow.fluid.state.len()),
        top_speed,
        least_distance: least_distance(&flow.fluid.state.position) / spacing,
        density: flow.watch.max_density_error,
        mach: flow.watch.max_mach,
        escaped: flow.watch.escaped,
        seconds: flow.ledger.total(),
    })
}

/// Smallest distance between two points \[m\], by sweeping along x.
fn least_distance(points: &[DVec3]) -> f64 {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x));
    let mut least = f64::INFINITY;
    for (k, a) in sorted.iter().enumerate() {
        for b in &sorted[k + 1..] {
            if b.x - a.x >= least {
                break;
            }
            least = least.min(a.distance(*b));
        }
    }
    least
}

/// Share of the points of a lattice of one spacing, at least `1.5` spacings inside the wall, that have no particle within one
/// spacing: in a set without voids the farthest a point can lie from the nearest is 0.87 spacings.
pub fn voids(wall: &SignedDistance, points: &[DVec3], spacing: f64) -> f64 {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x));
    let low = points.iter().fold(DVec3::INFINITY, |a, b| a.min(*b));
    let high = points.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b));
    let n = ((high - low) / spacing).ceil();
    let (mut inside, mut empty) = (0u32, 0u32);
    for i in 0..=n.x as usize {
        let x = low.x + spacing * i as f64;
        let from = sorted.partition_point(|p| p.x < x - spacing);
        let near: Vec<DVec3> = sorted[from..].iter().copied().take_while(|p| p.x <= x + spacing).collect();
        for j in 0..=n.y as usize {
            for k in 0..=n.z as usize {
                let site = DVec3::new(x, low.y + spacing * j as f64, low.z + spacing * k as f64);
                if wall.query(site).distance < -1.5 * spacing {
                    inside += 1;
                    empty += u32::from(near.iter().all(|p| p.distance(site) > spacing));
                }
            }
        }
    }
    f64::from(empty) / f64::from(inside.max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_distance_is_found() {
        let points = [DVec3::ZERO, DVec3::X, DVec3::new(0.9, 0.3, 0.0), DVec3::new(0.1, 5.0, 0.0)];
        assert!((least_distance(&points) - 0.1f64.hypot(0.3)).abs() < 1e-12);
    }
}

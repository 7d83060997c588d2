//! Straight lines shot at the surface.

use crate::distance::SignedDistance;
use glam::DVec3;
use parry3d_f64::query::Ray;
use parry3d_f64::query::details::local_ray_intersection_with_triangle;

impl SignedDistance {
    /// Distance from `origin` along the unit vector `direction` to the first triangle hit, from either
    /// side, within `reach` \[m\].
    pub fn cast(&self, origin: DVec3, direction: DVec3, reach: f64) -> Option<f64> {
        let ray = Ray::new(origin, direction);
        let hit = |leaf: u32, nearest: f64| {
            let [a, b, c] = self.corners[leaf as usize];
            let distance = local_ray_intersection_with_triangle(a, b, c, &ray)?.0.time_of_impact;
            (distance < nearest).then_some(distance)
        };
        let (_, distance) = self.tree.cast_ray(&ray, reach, hit)?;
        (distance < reach).then_some(distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LengthUnit, prepare, shapes};

    #[test]
    fn a_ray_across_a_pipe_hits_its_wall_and_one_along_it_its_cap() {
        let pipe =
            prepare(shapes::pipe(2e-3, 10e-3, DVec3::Z, 256), Some(LengthUnit::Metre)).expect("a pipe");
        let (wall, closed) = (SignedDistance::wall(&pipe), SignedDistance::closed(&pipe));
        let inside = DVec3::new(0.5e-3, 0.0, 4e-3);
        for k in 0..64 {
            let direction = DVec3::new(f64::from(k).cos(), f64::from(k).sin(), 0.0);
            let along = inside.dot(direction);
            let exact = (along * along + 4e-6 - 0.25e-6).sqrt() - along;
            let hit = wall.cast(inside, direction, 1.0).expect("the wall is all around");
            assert!((hit / exact - 1.0).abs() < 1e-3, "{hit} instead of {exact}");
        }
        assert_eq!(wall.cast(inside, DVec3::Z, 1.0), None);
        let cap = closed.cast(inside, DVec3::Z, 1.0).expect("the cap is in the way");
        assert!((cap - 6e-3).abs() < 1e-12);
        assert_eq!(closed.cast(inside, DVec3::Z, 5e-3), None);
    }
}

//! Where a particle that comes in through a pressure opening is put.
//!
//! Its own place, set back by the length of the buffer, is free only where blood has moved evenly inwards all the way. Where it goes in
//! and out in turns, what passes the end of the buffer says that there is a particle too few behind the cap, but not where.

use glam::DVec3;
use vaso_fluid::FluidState;
use vaso_geometry::Opening;

/// Depth behind the cap of the places that are offered, in spacings.
const DEPTH: f64 = 0.5;
/// Distance of the offered places from the border of the cap, in spacings: that of a first layer, and a little less.
const MARGIN: f64 = 0.4;
/// Distance between them, in spacings.
const STEP: f64 = 0.5;
/// Distance to the nearest particle, in spacings, at which the own place will do.
const FREE: f64 = 0.8;
/// Least distance, in spacings: nearer pairs are parted, see the fluid's `Separation`.
const LEAST: f64 = 0.7;
/// Reach of the mean a velocity is taken from, in spacings.
const AROUND: f64 = 1.5;

/// Places over a cap: a square lattice along its axes \[m\].
fn places(opening: &Opening, spacing: f64) -> Vec<DVec3> {
    let (step, depth) = (STEP * spacing, DEPTH * spacing);
    let reach = opening.polygon.iter().map(|p| p[0].hypot(p[1])).fold(0.0, f64::max);
    let n = (reach / step).ceil() as i32;
    let site = |i: i32, j: i32| {
        let along = step * (f64::from(i) * opening.axes[0] + f64::from(j) * opening.axes[1]);
        opening.center - depth * opening.normal + along
    };
    (-n..=n)
        .flat_map(|i| (-n..=n).map(move |j| site(i, j)))
        .filter(|&x| opening.lateral(x) < -MARGIN * spacing)
        .collect()
}

/// What is free behind the cap of an opening in one exchange. Its lists are used again in the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Room {
    /// Places over the cap that are offered \[m\].
    places: Vec<DVec3>,
    /// Whether it has been looked over in this exchange.
    is_seen: bool,
    /// Squared distance from each place to the nearest particle \[m^2\].
    gap: Vec<f64>,
    /// Position \[m\] and velocity along the normal \[m/s\] of the particles near the cap.
    near: Vec<(DVec3, f64)>,
    spacing: f64,
}

impl Room {
    /// Room over the cap of `opening`.
    pub(crate) fn new(opening: &Opening, spacing: f64) -> Self {
        Self { places: places(opening, spacing), spacing, ..Self::default() }
    }

    /// Begins a new exchange.
    pub(crate) fn forget(&mut self) {
        self.is_seen = false;
    }

    /// Sees who is near the cap of `opening`, whose number is `label`, unless that has been done in this exchange.
    pub(crate) fn see(&mut self, opening: &Opening, label: i32, state: &FluidState) -> &mut Self {
        if !self.is_seen {
            self.is_seen = true;
            let reach = (DEPTH + AROUND) * self.spacing;
            let is_near = |&i: &usize| {
                state.opening[i] == label && (0.0..reach).contains(&opening.depth(state.position[i]))
            };
            self.near.clear();
            let near = (0..state.len()).filter(is_near);
            self.near.extend(near.map(|i| (state.position[i], state.velocity[i].dot(opening.normal))));
            self.gap.clear();
            self.gap.extend(self.places.iter().map(|&x| nearest(&self.near, x)));
        }
        self
    }

    /// Takes a place for a particle that would come to `own` \[m\]: that if it is free, or else the one farthest from all others. Gives the
    /// place and the mean velocity along the normal around it \[m/s\], which is `velocity` where it is the own; nothing where no
    /// place is left.
    pub(crate) fn take(&mut self, own: DVec3, velocity: f64) -> Option<(DVec3, f64)> {
        let squared = |distance: f64| (distance * self.spacing).powi(2);
        let taken = if nearest(&self.near, own) >= squared(FREE) {
            (own, velocity)
        } else {
            // The first of equals, so that the choice does not depend on anything but the set.
            let best =
                (1..self.gap.len()).fold(0, |best, k| if self.gap[k] > self.gap[best] { k } else { best });
            if self.gap.get(best).is_none_or(|&gap| gap < squared(LEAST)) {
                return None;
            }
            (self.places[best], self.mean(self.places[best], velocity))
        };
        self.near.push(taken);
        for (gap, place) in self.gap.iter_mut().zip(&self.places) {
            *gap = gap.min(place.distance_squared(taken.0));
        }
        Some(taken)
    }

    fn mean(&self, x: DVec3, own: f64) -> f64 {
        let reach = AROUND * self.spacing;
        let (mut weights, mut sum) = (0.0, 0.0);
        for &(place, velocity) in &self.near {
            let weight = (1.0 - place.distance(x) / reach).max(0.0);
            weights += weight;
            sum += weight * velocity;
        }
        if weights > 0.0 { sum / weights } else { own }
    }
}

/// Squared distance from `x` to the nearest particle \[m^2\].
fn nearest(near: &[(DVec3, f64)], x: DVec3) -> f64 {
    near.iter().map(|n| n.0.distance_squared(x)).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square cap of four spacings across, facing up.
    fn cap() -> Opening {
        let polygon = vec![[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]];
        Opening {
            center: DVec3::ZERO,
            normal: DVec3::Z,
            area: 16.0,
            radius: (16.0 / std::f64::consts::PI).sqrt(),
            polygon,
            axes: [DVec3::X, DVec3::Y],
            axis: DVec3::Z,
        }
    }

    /// Particles at rest at the sites of a layer half a spacing deep, but for those left out.
    fn layer(left_out: &[[i32; 2]]) -> FluidState {
        let site = |i: i32, j: i32| DVec3::new(f64::from(i) - 1.5, f64::from(j) - 1.5, -0.5);
        let position: Vec<DVec3> = (0..4)
            .flat_map(|i| (0..4).map(move |j| [i, j]))
            .filter(|at| !left_out.contains(at))
            .map(|[i, j]| site(i, j))
            .collect();
        let volume = vec![1.0; position.len()];
        let mut state = FluidState::at_rest(position, &volume, 1000.0);
        state.opening.fill(0);
        state.velocity.fill(DVec3::new(0.5, 0.0, -0.2));
        state
    }

    /// The room that these particles leave.
    fn room(state: &FluidState) -> Room {
        let mut room = Room::new(&cap(), 1.0);
        room.see(&cap(), 0, state);
        room
    }

    #[test]
    fn places_lie_over_the_cap() {
        let places = places(&cap(), 1.0);
        assert_eq!(places.len(), 49);
        assert!(places.iter().all(|x| x.x.abs() < 1.6 && x.y.abs() < 1.6 && x.z == -0.5));
    }

    #[test]
    fn the_own_place_is_taken_where_it_is_free() {
        let own = DVec3::new(0.5, 0.5, -0.5);
        let mut room = room(&layer(&[[2, 2]]));
        assert_eq!(room.take(own, -0.1), Some((own, -0.1)));
        let (other, _) = room.take(own, -0.1).expect("a square lattice has room at its cells");
        assert!(
            (other.distance(own) - 0.5_f64.sqrt()).abs() > 1e-6 && other != own,
            "it is taken once: {other}"
        );
    }

    #[test]
    fn another_place_is_taken_where_the_own_is_not() {
        let mut room = room(&layer(&[[0, 3]]));
        let (place, outward) = room.take(DVec3::new(0.5, 0.5, -0.5), -0.1).expect("one is free");
        assert!(place.distance(DVec3::new(-1.5, 1.5, -0.5)) < 1e-12, "{place}");
        assert!((outward + 0.2).abs() < 1e-12, "it moves as its neighbours do: {outward}");
    }

    #[test]
    fn nothing_is_put_where_there_is_no_room() {
        let mut crowd = layer(&[]);
        let second = crowd.position.iter().map(|x| *x + DVec3::new(0.5, 0.5, 0.0)).collect::<Vec<_>>();
        for x in second {
            vaso_particles::visit::append_copy(&mut crowd, 0);
            *crowd.position.last_mut().expect("one was added") = x;
        }
        let mut room = room(&crowd);
        assert_eq!(room.take(DVec3::new(0.5, 0.5, -0.5), -0.1), None);
    }
}

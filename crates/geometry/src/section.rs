//! Sections of a vessel, measured on a grid of points inside it.

use crate::distance::SignedDistance;
use crate::distance_grid::DistanceGrid;
use crate::opening::Opening;
use crate::vessel::Vessel;
use glam::{DMat3, DVec3};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Grid points across the radius of the smallest opening.
const POINTS_ACROSS: f64 = 5.0;
/// Most grid points in the bounding box; a finer grid is coarsened to this.
const MOST_POINTS: f64 = 4e6;
/// Thickness of the slices whose volume gives an area, in grid spacings.
const SLICE: f64 = 2.0;

impl Vessel {
    /// Smallest section area \[m^2\] that everything entering at the largest opening must pass,
    /// that is, up to the nearest of the other openings; `None` with fewer than two openings.
    ///
    /// Slices are shells of equal path length inside the lumen; near a bend they are oblique, so the
    /// area is good to about a tenth. Used to expect the speed in a throat, not to measure one.
    pub fn narrowest_section(&self) -> Option<f64> {
        let [inlet, others @ ..] = self.openings.as_slice() else { return None };
        if others.is_empty() {
            return None;
        }
        let smallest = self.openings.iter().map(|o| o.radius).fold(f64::INFINITY, f64::min);
        // Counted along axes of the vessel, so that it does not matter how that lies.
        let axes = self.axes();
        let turned = Vessel { surface: self.surface.map(|x| axes.transpose() * x), ..self.clone() };
        let (low, high) = turned.surface.bounds();
        let extent = high - low;
        let spacing = (smallest / POINTS_ACROSS).max((extent.x * extent.y * extent.z / MOST_POINTS).cbrt());
        let grid = DistanceGrid::build(&SignedDistance::closed(&turned), (low, high), spacing, 2.0 * spacing);
        let n: [usize; 3] = (extent / spacing).to_array().map(|e| e.ceil() as usize + 1);
        let at = |k: usize| {
            let [i, j, l] = [k % n[0], k / n[0] % n[1], k / (n[0] * n[1])];
            low + spacing * DVec3::new(i as f64, j as f64, l as f64)
        };
        let place = |k: usize| axes * at(k);
        let total = n[0] * n[1] * n[2];
        let inside: Vec<bool> = (0..total).map(|k| grid.sample(at(k)).0 < 0.0).collect();

        // Path lengths as whole thousandths of the spacing, which makes their order exact.
        let steps = neighbour_steps();
        let mut length = vec![u64::MAX; total];
        let mut front = BinaryHeap::new();
        let near_cap = |k: usize, depth: f64| {
            let o = inlet;
            let x = place(k);
            (0.0..depth).contains(&o.depth(x)) && o.lateral(x) < 0.0
        };
        for k in (0..total).filter(|&k| inside[k] && near_cap(k, 1.5 * spacing)) {
            length[k] = (1000.0 * inlet.depth(place(k)) / spacing) as u64;
            front.push(Reverse((length[k], k)));
        }
        while let Some(Reverse((reached, k))) = front.pop() {
            if reached > length[k] {
                continue;
            }
            let here = [k % n[0], k / n[0] % n[1], k / (n[0] * n[1])];
            for &(step, cost) in &steps {
                let there: [i64; 3] = std::array::from_fn(|a| here[a] as i64 + step[a]);
                if (0..3).any(|a| there[a] < 0 || there[a] >= n[a] as i64) {
                    continue;
                }
                let next = (there[2] as usize * n[1] + there[1] as usize) * n[0] + there[0] as usize;
                if inside[next] && reached + cost < length[next] {
                    length[next] = reached + cost;
                    front.push(Reverse((length[next], next)));
                }
            }
        }
        let first_exit = (0..total)
            .filter(|&k| length[k] < u64::MAX)
            .filter(|&k| {
                others.iter().any(|o| o.depth(place(k)).abs() < 1.5 * spacing && o.lateral(place(k)) < 0.0)
            })
            .map(|k| length[k])
            .min()?;
        let slice = (1000.0 * SLICE) as u64;
        let mut count = vec![0_u64; (first_exit / slice) as usize];
        for &l in length.iter().filter(|&&l| l < u64::MAX) {
            if let Some(c) = count.get_mut((l / slice) as usize) {
                *c += 1;
            }
        }
        // The first slice touches the cap and is cut by it.
        let fewest = count.iter().skip(1).min().copied()?;
        Some(fewest as f64 * spacing * spacing / SLICE)
    }
}

impl Vessel {
    /// Unit axes that turn with the vessel, as columns: that of the largest opening last, and first across it towards the centre of
    /// the opening farthest from it.
    fn axes(&self) -> DMat3 {
        let inlet = &self.openings[0];
        let z = inlet.normal;
        let across = |o: &Opening| (o.center - inlet.center).reject_from_normalized(z);
        let farthest =
            self.openings.iter().map(across).max_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
        // A straight pipe is the same from all sides.
        let x = farthest
            .filter(|x| x.length() > 1e-3 * inlet.radius)
            .map_or(z.any_orthonormal_vector(), DVec3::normalize);
        DMat3::from_cols(x, z.cross(x), z)
    }
}

/// Parts a grid spacing is counted in, so that lengths are whole numbers.
pub(crate) const STEP_UNIT: u64 = 1000;

/// The 26 neighbours in a grid with the length of the step in parts of a spacing.
pub(crate) fn neighbour_steps() -> Vec<([i64; 3], u64)> {
    let mut steps = Vec::new();
    for l in -1..=1_i64 {
        for j in -1..=1_i64 {
            for i in -1..=1_i64 {
                let squared = i * i + j * j + l * l;
                if squared > 0 {
                    steps.push(([i, j, l], (STEP_UNIT as f64 * (squared as f64).sqrt()).round() as u64));
                }
            }
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use crate::{LengthUnit, prepare, shapes};
    use glam::{DMat3, DVec3};

    #[test]
    fn a_pipe_is_as_wide_as_its_caps() {
        for axis in [DVec3::Z, DVec3::new(1.0, 2.0, 3.0).normalize()] {
            let pipe = prepare(shapes::pipe(2e-3, 20e-3, axis, 64), Some(LengthUnit::Metre)).expect("a pipe");
            let area = pipe.narrowest_section().expect("two openings");
            let exact = std::f64::consts::PI * 4e-6;
            assert!((area / exact - 1.0).abs() < 0.12, "{axis}: {area} against {exact}");
        }
    }

    /// The sound speed of a run follows from it, so it must not depend on how the vessel lies.
    #[test]
    fn a_turned_vessel_is_as_narrow() {
        let area = |turn: DMat3| {
            let surface = shapes::bifurcation(&shapes::BifurcationSpec::default()).map(|x| turn * x);
            let vessel = prepare(surface, Some(LengthUnit::Metre)).expect("a bifurcation");
            vessel.narrowest_section().expect("three openings")
        };
        let (straight, turned) = (area(DMat3::IDENTITY), area(DMat3::from_axis_angle(DVec3::X, 0.7)));
        assert!((turned / straight - 1.0).abs() < 0.01, "{turned} against {straight}");
    }
}

//! Regular lattices, and the choice of the sites that fill a region.

use crate::region::Region;
use glam::{DQuat, DVec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::f64::consts::SQRT_2;

/// Lattice the particles start from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lattice {
    /// One site at the centre of each cube of edge `spacing`.
    #[default]
    Cubic,
    /// Body-centred cubic: two sites in each cube of edge `2^(1/3) spacing`.
    Bcc,
}

impl Lattice {
    /// Edge of the repeated cube for volume `spacing^3` a site \[m\].
    fn edge(self, spacing: f64) -> f64 {
        match self {
            Self::Cubic => spacing,
            Self::Bcc => spacing * 2.0_f64.cbrt(),
        }
    }

    /// Sites of one cube, in edges from its lower corner.
    fn basis(self) -> &'static [DVec3] {
        const CUBIC: [DVec3; 1] = [DVec3::splat(0.5)];
        const BCC: [DVec3; 2] = [DVec3::splat(0.25), DVec3::splat(0.75)];
        match self {
            Self::Cubic => &CUBIC,
            Self::Bcc => &BCC,
        }
    }
}

/// Cubes along the edge of a block: one look at the level in its middle settles most of the blocks.
const BLOCK: usize = 8;

/// A lattice over a region, walked in blocks of cubes.
struct Array<'a, R> {
    region: &'a R,
    /// From the frame of the lattice to space.
    turn: DQuat,
    /// Lower corner in the frame of the lattice \[m\].
    origin: DVec3,
    edge: f64,
    basis: &'static [DVec3],
    /// Blocks along each axis.
    n_blocks: [usize; 3],
    /// Depth up to which the level of a site must be known exactly \[m\].
    margin: f64,
}

/// Where a block of cubes lies.
enum Place {
    Outside,
    /// All sites are deeper than the margin; the level in the middle stands for them.
    Inside(f64),
    Border,
}

impl<'a, R: Region> Array<'a, R> {
    fn new(region: &'a R, lattice: Lattice, spacing: f64, turn: DQuat, margin: f64) -> Self {
        let (low, high) = region.bounds();
        let half = 0.5 * (high - low);
        // Half extent of the box in the turned frame.
        let reach = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| (turn * axis).abs().dot(half));
        let edge = lattice.edge(spacing);
        let n_cubes = reach.map(|reach| (2.0 * reach / edge).ceil());
        let center = turn.inverse() * (0.5 * (low + high));
        let origin = center - 0.5 * edge * DVec3::from_array(n_cubes);
        let n_blocks = n_cubes.map(|n| (n as usize).div_ceil(BLOCK).max(1));
        Self { region, turn, origin, edge, basis: lattice.basis(), n_blocks, margin }
    }

    fn n_blocks(&self) -> usize {
        self.n_blocks.iter().product()
    }

    /// Lower corner of a block, in the frame of the lattice.
    fn corner(&self, block: usize) -> DVec3 {
        let [nx, ny, _] = self.n_blocks;
        let index = [block % nx, block / nx % ny, block / (nx * ny)];
        self.origin + BLOCK as f64 * self.edge * DVec3::from_array(index.map(|k| k as f64))
    }

    fn place(&self, corner: DVec3) -> Place {
        let half = 0.5 * BLOCK as f64 * self.edge;
        let settled = half * 3.0_f64.sqrt() + self.margin;
        let level = self.region.exact_level(self.turn * (corner + half));
        if level.abs() <= settled {
            Place::Border
        } else if level > 0.0 {
            Place::Outside
        } else {
            Place::Inside(level)
        }
    }

    /// Sites of a block, in space.
    fn sites(&self, corner: DVec3) -> impl Iterator<Item = DVec3> + '_ {
        (0..BLOCK.pow(3)).flat_map(move |cube| {
            let index = [cube % BLOCK, cube / BLOCK % BLOCK, cube / (BLOCK * BLOCK)];
            let index = DVec3::from_array(index.map(|k| k as f64));
            self.basis.iter().map(move |site| self.turn * (corner + self.edge * (index + *site)))
        })
    }

    /// Level at `x`, exact within the margin.
    fn level(&self, x: DVec3) -> f64 {
        let level = self.region.level(x);
        if level.abs() < self.margin { self.region.exact_level(x) } else { level }
    }
}

/// The `count` sites of a lattice of `spacing` \[m\] that lie deepest in `region`, ties by site number.
///
/// Taking a number of sites, not those below a level, makes the particle volume the share of the exact
/// volume without an offset in density. `None` when there are not enough sites about the region.
pub(crate) fn deepest_sites(
    region: &impl Region,
    lattice: Lattice,
    spacing: f64,
    count: usize,
) -> Option<Vec<DVec3>> {
    // The last site taken lies well within this of the border.
    let margin = 1.5 * spacing;
    // Turned by one radian about no axis of symmetry: along a vessel in line with a lattice the number of
    // sites a section holds would jump with its radius, and relaxation cannot carry that far.
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, SQRT_2, 3.0_f64.sqrt()).normalize(), 1.0);
    let array = Array::new(region, lattice, spacing, turn, margin);
    let sites: Vec<(f64, DVec3)> = (0..array.n_blocks())
        .into_par_iter()
        .flat_map_iter(|block| {
            let corner = array.corner(block);
            match array.place(corner) {
                Place::Outside => Vec::new(),
                Place::Inside(level) => array.sites(corner).map(|x| (level, x)).collect(),
                Place::Border => {
                    array.sites(corner).map(|x| (array.level(x), x)).filter(|site| site.0 < margin).collect()
                }
            }
        })
        .collect();
    if count == 0 || sites.len() < count {
        return None;
    }
    let mut rank: Vec<usize> = (0..sites.len()).collect();
    rank.select_nth_unstable_by(count - 1, |&a, &b| sites[a].0.total_cmp(&sites[b].0).then(a.cmp(&b)));
    rank.truncate(count);
    rank.sort_unstable();
    Some(rank.into_iter().map(|k| sites[k].1).collect())
}

/// Volume of `region` \[m^3\] by cubes of edge `cell` \[m\], those on the border counted in part.
///
/// The part is that of a plane face parallel to the cube, which leaves an error of the second order in
/// `cell` over the radius of curvature.
pub(crate) fn volume(region: &impl Region, cell: f64) -> f64 {
    let array = Array::new(region, Lattice::Cubic, cell, DQuat::IDENTITY, cell);
    let cubes: Vec<f64> = (0..array.n_blocks())
        .into_par_iter()
        .map(|block| {
            let corner = array.corner(block);
            let part = |x| (0.5 - array.level(x) / cell).clamp(0.0, 1.0);
            match array.place(corner) {
                Place::Outside => 0.0,
                Place::Inside(_) => BLOCK.pow(3) as f64,
                Place::Border => array.sites(corner).map(part).sum(),
            }
        })
        .collect();
    cubes.iter().sum::<f64>() * cell.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::faces::Faces;
    use std::f64::consts::PI;

    /// Ball of radius 1 about the origin.
    struct Ball;

    impl Region for Ball {
        fn bounds(&self) -> (DVec3, DVec3) {
            (DVec3::splat(-1.0), DVec3::splat(1.0))
        }
        fn level(&self, x: DVec3) -> f64 {
            (x.length() - 1.0).clamp(-0.6, 0.6)
        }
        fn exact_level(&self, x: DVec3) -> f64 {
            x.length() - 1.0
        }
        fn faces(&self, x: DVec3) -> Faces {
            let mut faces = Faces::new();
            faces.push(1.0 - x.length(), x.normalize_or_zero());
            faces
        }
        fn exact_faces(&self, x: DVec3) -> Faces {
            self.faces(x)
        }
    }

    #[test]
    fn the_sites_taken_are_the_deepest() {
        for lattice in [Lattice::Cubic, Lattice::Bcc] {
            let dp = 0.05;
            let count = (4.0 / 3.0 * PI / f64::powi(dp, 3)).round() as usize;
            let radii = |count| {
                let sites =
                    deepest_sites(&Ball, lattice, dp, count).expect("a ball of 20 spacings has sites");
                let mut radii: Vec<f64> = sites.iter().map(|x| x.length()).collect();
                radii.sort_by(f64::total_cmp);
                radii
            };
            let (taken, more) = (radii(count), radii(count + 500));
            assert_eq!(taken.len(), count);
            assert_eq!(taken[..], more[..count], "{lattice:?}: a deeper site was left out");
            assert!((taken[count - 1] - 1.0).abs() < 0.25 * dp, "{lattice:?}: {}", taken[count - 1]);
        }
    }

    #[test]
    fn more_sites_than_there_are_is_no_choice() {
        assert!(deepest_sites(&Ball, Lattice::Cubic, 0.5, 1_000_000).is_none());
    }

    #[test]
    fn volume_of_a_ball_to_a_thousandth() {
        let exact = 4.0 / 3.0 * PI;
        assert!((volume(&Ball, 0.05) / exact - 1.0).abs() < 1e-3);
    }
}

//! An aorta with its arch and the three arteries that leave it.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{
    cut::{End, cut, drop_unused},
    even::even_out,
    implicit::{Implicit, union},
    junction::Branch,
    nets::surface_net,
    rings::fill_disc,
};
use crate::surface::Surface;

/// An artery that leaves the arch, straight and of one radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArchBranch {
    /// Radius.
    pub radius: f64,
    /// Where its axis meets that of the arch: 0 at the end of the ascending aorta, half a turn at the start of the descending
    /// one \[rad\].
    pub place: f64,
    /// Lean of its axis from upright towards the descending aorta \[rad\].
    pub lean: f64,
    /// Length from there.
    pub length: f64,
}

/// Dimensions of a thoracic aorta: straight up, half a circle, straight down, all in one plane. Lengths in any one unit.
///
/// The diameters of the default along the aorta are means of 300 people by computed tomography (Lee et al., J. Korean Soc. Radiol. 69
/// (2013) 105-112): ascending aorta 29.9 mm, transverse arch 25.4 mm, descending aorta 23.6 mm at its start and 21.7 mm
/// at its end. The brachiocephalic and left subclavian arteries have the radii of 6.2 and 4.23 mm of Alastruey, Parker, Peiro, Byrd and
/// Sherwin, J. Biomech. 40 (2007) 1794-1805, the left common carotid artery that of
/// [`BifurcationSpec`](super::BifurcationSpec). Lengths, places and angles are chosen. The default is in metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ArchSpec {
    /// Radius of the ascending aorta.
    pub ascending_radius: f64,
    /// Radius at the top of the arch.
    pub arch_radius: f64,
    /// Radius of the descending aorta where the arch ends.
    pub descending_radius: f64,
    /// Radius of the descending aorta where it is cut off.
    pub distal_radius: f64,
    /// Radius of the circle that the axis of the arch follows.
    pub bend_radius: f64,
    /// Length of the ascending aorta below the arch.
    pub ascending_length: f64,
    /// Length of the descending aorta below the arch.
    pub descending_length: f64,
    /// Brachiocephalic, left common carotid and left subclavian artery.
    pub branches: [ArchBranch; 3],
    /// Width over which walls blend into each other where they meet at an angle.
    pub blend: f64,
    /// Edge length of the triangles.
    pub edge: f64,
}

impl Default for ArchSpec {
    fn default() -> Self {
        let branch = |radius: f64, place: f64, lean: f64, length: f64| ArchBranch {
            radius,
            place: place.to_radians(),
            lean: lean.to_radians(),
            length,
        };
        ArchSpec {
            ascending_radius: 14.95e-3,
            arch_radius: 12.7e-3,
            descending_radius: 11.8e-3,
            distal_radius: 10.85e-3,
            bend_radius: 32e-3,
            ascending_length: 30e-3,
            descending_length: 80e-3,
            branches: [
                branch(6.2e-3, 58.0, -12.0, 50e-3),
                branch(3.41e-3, 87.0, 0.0, 45e-3),
                branch(4.23e-3, 112.0, 12.0, 46e-3),
            ],
            blend: 6e-3,
            edge: 1.45e-3,
        }
    }
}

/// The surface of a thoracic aorta, closed by five flat round caps at right angles to each axis.
///
/// The ascending aorta comes up the z axis and ends at the origin, the arch turns towards +x, and the plane of both is y = 0.
///
/// # Panics
/// When a length is not positive, the arch is bent about less than its radius, or an artery is so short that its end lies in
/// the arch.
pub fn aortic_arch(spec: &ArchSpec) -> Surface {
    let arch = Arch::new(spec);
    let ends = arch.ends();
    for end in ends {
        for k in 0..16 {
            let (sin, cos) = (f64::from(k) * TAU / 16.0).sin_cos();
            let side = end.along.any_orthonormal_vector();
            let rim = end.center + end.radius * (cos * side + sin * end.along.cross(side));
            assert!(
                arch.field(rim).abs() < 1e-6 * end.radius,
                "the arch reaches the end of a vessel: {spec:?}"
            );
        }
    }
    // Beyond the ends by some edges, to be cut there.
    let margin = DVec3::splat(4.0 * spec.edge);
    let disc = |end: &End| end.radius * (DVec3::ONE - end.along * end.along).max(DVec3::ZERO).map(f64::sqrt);
    let (mut low, mut high) = (DVec3::splat(f64::INFINITY), DVec3::splat(f64::NEG_INFINITY));
    for end in &ends {
        low = low.min(end.center - disc(end));
        high = high.max(end.center + disc(end));
    }
    low.y = -spec.ascending_radius.max(spec.arch_radius);
    high.y = -low.y;
    let mut surface = surface_net(&arch, [low - margin, high + margin], spec.edge);
    let mut borders: Vec<Vec<u32>> = ends.iter().map(|end| cut(&mut surface, end, spec.edge)).collect();
    drop_unused(&mut surface, &mut borders);
    let fixed = borders.concat();
    even_out(&arch, &fixed, &mut surface);
    for (border, end) in borders.iter().zip(ends) {
        fill_disc(&mut surface, border, end.center);
    }
    surface
}

/// The aorta and its branches as one wall.
struct Arch {
    spec: ArchSpec,
    branches: [(DVec3, Branch); 3],
}

impl Arch {
    fn new(spec: &ArchSpec) -> Self {
        let ArchSpec { ascending_radius, arch_radius, descending_radius, distal_radius, .. } = *spec;
        let lengths = [
            ascending_radius,
            arch_radius,
            descending_radius,
            distal_radius,
            spec.bend_radius - ascending_radius.max(arch_radius).max(descending_radius),
            spec.ascending_length,
            spec.descending_length,
            spec.blend,
            spec.edge,
        ];
        let of_branches = spec.branches.iter().flat_map(|b| [b.radius, b.length]);
        let positive = lengths.into_iter().chain(of_branches).all(|l| l > 0.0 && l.is_finite());
        assert!(positive, "lengths must be positive, and the arch bent about more than its radius: {spec:?}");
        let branches = spec.branches.map(|b| {
            let along = DVec3::new(b.lean.sin(), 0.0, b.lean.cos());
            (on_arch(spec, b.place), Branch { along, length: b.length, radii: vec![(0.0, b.radius)] })
        });
        Arch { spec: *spec, branches }
    }

    /// Radius of the aorta at a distance along its axis behind the start of the arch.
    fn radius(&self, s: f64) -> f64 {
        let ArchSpec { ascending_radius, arch_radius, descending_radius, distal_radius, .. } = self.spec;
        let half = 0.5 * PI * self.spec.bend_radius;
        let end = 2.0 * half + self.spec.descending_length;
        let radii = vec![
            (0.0, ascending_radius),
            (half, arch_radius),
            (2.0 * half, descending_radius),
            (end, distal_radius),
        ];
        Branch { along: DVec3::Z, length: end, radii }.radius(s)
    }

    /// About the distance to the wall of the aorta alone, and the direction away from its axis.
    fn aorta(&self, x: DVec3) -> (f64, DVec3) {
        let bend = self.spec.bend_radius;
        let (place, s) = if x.z > 0.0 {
            let angle = x.z.atan2(bend - x.x);
            (on_arch(&self.spec, angle), angle * bend)
        } else if x.x < bend {
            (DVec3::new(0.0, 0.0, x.z), x.z)
        } else {
            (DVec3::new(2.0 * bend, 0.0, x.z), PI * bend - x.z)
        };
        ((x - place).length() - self.radius(s), (x - place).normalize_or_zero())
    }

    /// Where the vessels are cut off.
    fn ends(&self) -> [End; 5] {
        let spec = &self.spec;
        let down = |x: f64, length: f64, radius: f64| End {
            center: DVec3::new(x, 0.0, -length),
            along: DVec3::NEG_Z,
            radius,
        };
        let [first, second, third] = [0, 1, 2].map(|k| {
            let (origin, branch) = &self.branches[k];
            let center = *origin + branch.length * branch.along;
            End { center, along: branch.along, radius: spec.branches[k].radius }
        });
        let ascending = down(0.0, spec.ascending_length, spec.ascending_radius);
        let descending = down(2.0 * spec.bend_radius, spec.descending_length, spec.distal_radius);
        [ascending, descending, first, second, third]
    }
}

impl Implicit for Arch {
    fn field(&self, x: DVec3) -> f64 {
        let aorta = self.aorta(x);
        let branches = self.branches.each_ref().map(|(origin, branch)| branch.distance(x - *origin));
        let pair = |a, b| union(self.spec.blend, a, b);
        let [a, b, c] = branches;
        [pair(aorta, a), pair(aorta, b), pair(aorta, c), pair(a, b), pair(b, c)]
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }

    fn scale(&self) -> f64 {
        self.spec.blend
    }
}

/// Point of the axis of the arch at an angle from its start.
fn on_arch(spec: &ArchSpec, angle: f64) -> DVec3 {
    spec.bend_radius * DVec3::new(1.0 - angle.cos(), 0.0, angle.sin())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LengthUnit, prepare};

    #[test]
    fn caps_are_round_flat_and_where_the_spec_says() {
        let spec = ArchSpec::default();
        let surface = aortic_arch(&spec);
        let vessel = prepare(surface.clone(), Some(LengthUnit::Metre)).expect("a clean surface");
        assert!(vessel.audit.watertight && vessel.audit.repairs.is_empty(), "{:?}", vessel.audit);
        assert_eq!(vessel.openings.len(), 5);
        for end in Arch::new(&spec).ends() {
            let found = vessel
                .openings
                .iter()
                .min_by(|a, b| a.center.distance(end.center).total_cmp(&b.center.distance(end.center)));
            let found = found.expect("there are openings");
            assert!(found.center.distance(end.center) < 1e-6, "{:?}", found.center);
            assert!(found.normal.distance(end.along) < 1e-6);
            let n = found.polygon.len() as f64;
            let polygon = (0.5 * n * (TAU / n).sin() / PI).sqrt();
            assert!((found.radius / (end.radius * polygon) - 1.0).abs() < 1e-6);
        }
    }

    /// Without the branches it is two tubes and a bend, whose radii go along smooth steps. What the branches add and the blend fills in
    /// lies between nothing and a tenth of the tubes.
    #[test]
    fn volume_is_that_of_its_tubes() {
        let spec = ArchSpec::default();
        let surface = aortic_arch(&spec);
        let arch = Arch::new(&spec);
        let n = 4000;
        let (from, to) = (-spec.ascending_length, PI * spec.bend_radius + spec.descending_length);
        let step = (to - from) / f64::from(n);
        let section = |s: f64| PI * arch.radius(s).powi(2);
        let aorta: f64 = (0..n).map(|k| section(from + (f64::from(k) + 0.5) * step) * step).sum();
        let outside = |b: &ArchBranch| PI * b.radius.powi(2) * (b.length - spec.arch_radius);
        let tubes = aorta + spec.branches.iter().map(outside).sum::<f64>();
        let excess = surface.volume() / tubes - 1.0;
        assert!(excess > -0.02 && excess < 0.02, "{excess}");
    }

    #[test]
    fn triangles_are_well_shaped_and_of_the_size_asked_for() {
        let spec = ArchSpec::default();
        let surface = aortic_arch(&spec);
        let (mut worst, mut sum, mut longest_edge) = (1.0_f64, 0.0, 0.0_f64);
        for t in 0..surface.triangles.len() {
            let [a, b, c] = surface.triangle(t);
            let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
            longest_edge = longest_edge.max(longest);
            let quality = 4.0 / 3f64.sqrt() * surface.triangle_area(t) / longest.powi(2);
            worst = worst.min(quality);
            sum += quality;
        }
        let mean = sum / surface.triangles.len() as f64;
        assert!(worst > 0.2 && mean > 0.75, "worst {worst}, mean {mean}");
        assert!(longest_edge < 2.5 * spec.edge, "longest edge {longest_edge}");
    }

    #[test]
    #[should_panic(expected = "reaches the end")]
    fn a_branch_that_ends_in_the_arch_is_refused() {
        let mut spec = ArchSpec::default();
        spec.branches[1].length = 10e-3;
        aortic_arch(&spec);
    }
}

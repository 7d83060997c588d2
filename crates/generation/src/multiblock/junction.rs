//! Where three limbs meet: half planes that share one line.

use super::limb::Hinge;
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use vaso_geometry::{Curve, Junction, SignedDistance};

/// Distances of the line from the carina that are tried, in distances of the parent's centreline from the wall.
const BACK: [f64; 10] = [0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.15, 1.3];
/// Where between the directions of two limbs the half plane between them may lie.
const BETWEEN: [f64; 7] = [0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65];
/// Directions from the line to the carina that are tried, from straight on (0) to between the daughters (1).
const ASIDE: [f64; 5] = [0.0, 0.25, 0.5, 0.75, 1.0];
/// Angle that a daughter should keep from the half plane between the two \[rad\].
const OPEN: f64 = 0.4;
/// Rays that measure a half plane.
const RAYS: usize = 25;
/// Largest ratio of the half planes' areas: with more the cells of a limb would be too uneven.
const UNEVEN: f64 = 2.5;
/// Length a limb takes to become plane, as a multiple of the distance at which it is clear of the others, of how far
/// the rims of its half planes are swept along it, and of how far the wider reaches. Found on Y and T junctions: shorter
/// ones turn cells over.
const EASE: f64 = 1.25;
const SWEEP: f64 = 2.2;
const ROOM: f64 = 1.7;
/// Least angle between the start of a limb and the half planes beside it \[rad\].
const NARROW: f64 = 0.3;

/// One limb of a junction.
pub(super) struct Start {
    /// From the hinge along the limb.
    pub(super) curve: Curve,
    pub(super) hinge: Hinge,
}

/// A half plane from the hinge.
#[derive(Clone, Copy)]
struct Half {
    angle: f64,
    area: f64,
}

/// The place of the hinge.
struct Joint {
    center: DVec3,
    axis: DVec3,
    /// Directions of angle zero and of a right angle, across the axis.
    plane: [DVec3; 2],
    /// Between parent and first, parent and second, first and second daughter.
    half: [Half; 3],
}

impl Joint {
    fn direction(&self, angle: f64) -> DVec3 {
        angle.cos() * self.plane[0] + angle.sin() * self.plane[1]
    }

    fn angle(&self, v: DVec3) -> f64 {
        v.dot(self.plane[1]).atan2(v.dot(self.plane[0]))
    }
}

/// Area of the lumen in the half plane from `center` towards `side`, hinged along `axis`.
fn half_area(wall: &SignedDistance, center: DVec3, axis: DVec3, side: DVec3, reach: f64) -> Option<f64> {
    let step = PI / (RAYS - 1) as f64;
    (0..RAYS)
        .map(|k| {
            let angle = -FRAC_PI_2 + step * k as f64;
            let r = wall.cast(center, angle.cos() * side + angle.sin() * axis, reach)?;
            let weight = if k == 0 || k + 1 == RAYS { 0.25 } else { 0.5 };
            Some(weight * r * r * step)
        })
        .sum()
}

/// A junction whose three limbs have a wedge each.
pub(super) struct Meeting<'a> {
    joint: Joint,
    /// Centrelines of the limbs from the junction outwards, parent first.
    limbs: [&'a Curve; 3],
    /// Angles about the hinge between which each lies.
    bounds: [[f64; 2]; 3],
    wall: &'a SignedDistance,
}

/// The half planes between the limbs of a junction, or why there are none.
///
/// `limbs` are the centrelines from the junction outwards, parent first.
pub(super) fn meeting<'a>(
    junction: &Junction,
    limbs: [&'a Curve; 3],
    wall: &'a SignedDistance,
) -> Result<Meeting<'a>, String> {
    let clearance = |x: DVec3| wall.query(x).distance.abs();
    let ahead = |curve: &Curve| (1.5 * clearance(curve.at(0.3 * curve.length()))).min(curve.length());
    let parent = limbs[0].at(ahead(limbs[0]));
    let width = clearance(parent);
    let [to_first, to_second] = [limbs[1], limbs[2]].map(|curve| {
        let length = ahead(curve);
        (curve.at(length) - junction.middle).normalize_or_zero() + curve.tangent(length)
    });
    let axis = to_second.cross(to_first).try_normalize().ok_or("its daughters run in one direction")?;
    // The carina, in the plane of the middle.
    let tip = junction.carina + (junction.middle - junction.carina).dot(axis) * axis;
    let forward =
        (tip - parent).reject_from_normalized(axis).try_normalize().ok_or("its parent is too short")?;
    let plane = [forward, axis.cross(forward)];
    let joint = best_joint(tip, axis, plane, [to_first, to_second], width, wall)?;
    let angles = joint.half.map(|h| h.angle);
    // By growing angle: second, between the daughters, first, parent.
    let [left_parent, right_parent] = [angles[0], angles[1] + TAU];
    let bounds = [[left_parent, right_parent], [angles[2], angles[0]], [angles[1], angles[2]]];
    Ok(Meeting { joint, limbs, bounds, wall })
}

/// The hinge whose half planes are most alike in area.
fn best_joint(
    tip: DVec3,
    axis: DVec3,
    plane: [DVec3; 2],
    daughters: [DVec3; 2],
    width: f64,
    wall: &SignedDistance,
) -> Result<Joint, String> {
    let reach = 4.0 * width;
    let mut best: Option<(f64, f64, Joint)> = None;
    let flat = Joint { center: tip, axis, plane, half: [Half { angle: 0.0, area: 0.0 }; 3] };
    let [first, second] = daughters.map(|d| flat.angle(d));
    for (back, aside) in BACK.iter().flat_map(|b| ASIDE.iter().map(move |a| (*b, *a))) {
        let between = aside * 0.5 * (first + second);
        let center = tip - back * width * flat.direction(between);
        let joint = Joint { center, ..flat };
        let measure = |angle: f64| {
            let area = half_area(wall, center, axis, joint.direction(angle), reach)?;
            Some(Half { angle, area })
        };
        // The neck: the smallest half plane between parent and daughter.
        let neck = |daughter: f64, parent: f64| {
            let tried = BETWEEN.iter().filter_map(|b| measure(daughter + b * (parent - daughter)));
            tried.min_by(|a, b| a.area.total_cmp(&b.area))
        };
        let halves = (neck(first, PI), neck(second, -PI), measure(between));
        let (Some(a), Some(b), Some(c)) = halves else { continue };
        let areas = [a.area, b.area, c.area];
        let ratio =
            areas.iter().fold(0.0_f64, |m, x| m.max(*x)) / areas.iter().fold(f64::INFINITY, |m, x| m.min(*x));
        let narrow = [first - between, between - second].map(|open| (OPEN - open).max(0.0) / OPEN);
        let price = ratio + 2.0 * (narrow[0] + narrow[1]);
        if best.as_ref().is_none_or(|(least, ..)| price < *least) {
            best = Some((price, ratio, Joint { half: [a, b, c], ..joint }));
        }
    }
    let (_, ratio, joint) = best.ok_or("the lumen is not closed around it")?;
    if ratio > UNEVEN {
        return Err(format!(
            "its limbs are too unlike: the planes between them differ {ratio:.1} times in area"
        ));
    }
    Ok(joint)
}

impl Meeting<'_> {
    /// The start of limb `k`, which takes `ease` times the usual length to become plane; or why it has none.
    pub(super) fn start(&self, k: usize, ease: f64) -> Result<Start, String> {
        let [p, q, r] = self.joint.half;
        let sides = [[p, q], [r, p], [q, r]][k];
        start(&self.joint, self.limbs[k], self.bounds[k], sides, ease, self.wall)
    }
}

/// The start of the limb along `curve` in the wedge between two angles about the hinge, `sides` the half planes
/// there.
fn start(
    joint: &Joint,
    curve: &Curve,
    [low, high]: [f64; 2],
    sides: [Half; 2],
    ease: f64,
    wall: &SignedDistance,
) -> Result<Start, String> {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    let step = curve.length() / 200.0;
    let is_free = |arc: f64| {
        let (origin, tangent) = (curve.at(arc), curve.tangent(arc));
        let reach = 4.0 * wall.query(origin).distance.abs();
        let (x, y) = tangent.any_orthonormal_pair();
        (0..24).all(|k| {
            let angle = TAU * f64::from(k) / 24.0;
            let ray = angle.cos() * x + angle.sin() * y;
            wall.cast(origin, ray, reach).is_some_and(|r| {
                let point = origin + r * ray - joint.center;
                let off = (joint.angle(point) - middle + PI).rem_euclid(TAU) - PI;
                off.abs() < half - 0.02
            })
        })
    };
    let free = (1..200).map(|k| f64::from(k) * step).find(|arc| is_free(*arc));
    let free = free.ok_or("a limb ends before its sections are clear of the others")?;
    let clear = joint.center.distance(curve.at(free));
    // Longer than need be, as far as there is limb.
    let (right, left) = (joint.direction(high), joint.direction(low));
    let rims = sides.map(|half| (2.0 * half.area / PI).sqrt());
    let ahead = |arc: f64| {
        let angle = (joint.angle(curve.at(arc) - joint.center) - middle + PI).rem_euclid(TAU) - PI;
        joint.direction(middle + 0.0 * angle.clamp(NARROW - half, half - NARROW))
    };
    // The half planes turn into the plane of the section and sweep their rims along.
    let is_long_enough = |arc: f64| {
        let tangent = ahead(arc);
        let sweep = right.dot(tangent).abs() * rims[1];
        let sweep = sweep.max(left.dot(tangent).abs() * rims[0]);
        joint.center.distance(curve.at(arc))
            >= (EASE * clear).max(ease * SWEEP * sweep).max(ease * ROOM * rims[0].max(rims[1]))
    };
    let mut until = free;
    while !is_long_enough(until) && until + step < 0.9 * curve.length() {
        until += step;
    }
    let (a, b) = (joint.center, curve.at(until));
    let span = a.distance(b);
    let (da, db) = (span * ahead(until), span * curve.tangent(until));
    let hermite = |k: usize| {
        let u = k as f64 / 32.0;
        let (v, w) = (1.0 - u, u * (1.0 - u));
        v * a + u * b + w * (v * (da - (b - a)) + u * ((b - a) - db))
    };
    let bridge = Curve::new((0..=32).map(hermite));
    let rest = curve.stretch(until, curve.length(), ((curve.length() - until) / step).ceil() as usize);
    let whole = Curve::new(bridge.points().iter().chain(&rest.points()[1..]).copied());
    let hinge = Hinge { axis: joint.axis, right, left, length: bridge.length() };
    Ok(Start { curve: whole, hinge })
}

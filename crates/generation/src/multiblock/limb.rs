//! A limb: a stretch of vessel from a junction or an opening to an opening or a plane between two junctions.

use super::section::{Plane, Section};
use glam::{DQuat, DVec3};
use rayon::prelude::*;
use std::f64::consts::PI;
use vaso_geometry::{Curve, Frame, Opening, SignedDistance};

/// Stations of a limb in a spacing.
const STATIONS: f64 = 2.0;
/// How far a section may reach from its centre, in distances from the wall there.
const REACH: f64 = 4.0;
/// Over how many radii of an opening sections turn into its plane.
const TURN: f64 = 2.0;
/// By how much the first and last section lie inside the caps, in radii: the rim itself belongs to both.
const INSET: f64 = 5e-4;

/// How a limb starts at a junction: in two half planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hinge {
    /// Unit vector along the line in which they meet.
    pub(super) axis: DVec3,
    /// Unit vectors in the half planes across it. Seen along the limb with the axis up, `right` is to the right.
    pub(super) right: DVec3,
    pub(super) left: DVec3,
    /// Length over which the sections become plane \[m\].
    pub(super) length: f64,
}

/// Where the sections of a limb lie.
pub(super) struct Route<'a> {
    curve: Curve,
    frames: Vec<Frame>,
    hinge: Option<Hinge>,
    /// Turn of the first and last section into the plane of an opening, and the length it takes \[m\].
    caps: [Option<(DQuat, f64)>; 2],
    wall: &'a SignedDistance,
}

impl<'a> Route<'a> {
    /// A route along `curve`, which starts at the hinge or at the first opening, if any, and ends at the second.
    pub(super) fn new(
        curve: &Curve,
        spacing: f64,
        hinge: Option<Hinge>,
        openings: [Option<&Opening>; 2],
        wall: &'a SignedDistance,
    ) -> Self {
        let curve = curve.resampled(spacing);
        // Without a hinge an axis of the vessel's own frame: those of a round opening are an accident.
        let free = if curve.tangent(0.0).y.abs() < 0.8 { DVec3::Y } else { DVec3::Z };
        let up = hinge.map_or(free, |h| h.axis);
        let frames = curve.frames(up);
        let turned = |opening: Option<&Opening>, arc: f64, sign: f64| {
            let opening = opening?;
            let turn = DQuat::from_rotation_arc(curve.tangent(arc), sign * opening.normal);
            Some((turn, TURN * opening.radius))
        };
        let caps = [turned(openings[0], 0.0, -1.0), turned(openings[1], curve.length(), 1.0)];
        Self { curve, frames, hinge, caps, wall }
    }

    pub(super) fn length(&self) -> f64 {
        self.curve.length()
    }

    /// The plane at length `arc` \[m\].
    pub(super) fn plane(&self, arc: f64) -> Plane {
        let length = self.length();
        let inset = |cap: Option<(DQuat, f64)>| cap.map_or(0.0, |(_, over)| INSET * over);
        let arc = arc.clamp(inset(self.caps[0]), length - inset(self.caps[1]));
        let n = self.frames.len() - 1;
        let at = arc / length * n as f64;
        let k = (at as usize).min(n - 1);
        let guide = self.frames[k].y.lerp(self.frames[k + 1].y, at - k as f64);
        let mut tangent = self.curve.tangent(arc);
        let mut y = guide.reject_from_normalized(tangent).normalize();
        for (cap, from_end) in self.caps.iter().zip([arc, length - arc]) {
            if let Some((turn, over)) = cap {
                let near = (1.0 - from_end / over).max(0.0);
                let turn = DQuat::IDENTITY.slerp(*turn, near * near * (3.0 - 2.0 * near));
                (tangent, y) = (turn * tangent, turn * y);
            }
        }
        let x = y.cross(tangent);
        let mut plane = Plane { origin: self.curve.at(arc), y, right: x, left: -x, bend: 0.0, freedom: 1.0 };
        if let Some(hinge) = &self.hinge {
            // Slowly at first, where the half planes reach far and their rims would turn back.
            let bend = (1.0 - (arc / hinge.length).powi(2)).max(0.0);
            let first = self.frames[0];
            // The part along the limb falls evenly, so that the rim moves evenly along the limb.
            let tilted = |side: DVec3, sign: f64| {
                let along = bend * side.dot(first.tangent);
                sign * (1.0 - along * along).max(0.0).sqrt() * x + along * tangent
            };
            (plane.right, plane.left) = (tilted(hinge.right, 1.0), tilted(hinge.left, -1.0));
            plane.bend = bend;
            // Behind the hinge the centre goes back to the middle over the same length again.
            plane.freedom = (arc / hinge.length - 1.0).clamp(0.0, 1.0);
        }
        plane
    }

    pub(super) fn section(&self, arc: f64) -> Option<Section> {
        let plane = self.plane(arc);
        let reach = REACH * self.wall.query(plane.origin).distance.abs();
        Section::cut(plane, self.wall, reach)
    }
}

/// A stretch of a limb that can be cut into blocks, with the volume before each station.
pub(super) struct Run {
    /// Length along the route of each station \[m\].
    pub(super) arc: Vec<f64>,
    /// Volume from the start of the run to each station \[m^3\].
    pub(super) volume: Vec<f64>,
    /// Its section.
    pub(super) section: Vec<Section>,
}

impl Run {
    /// Volume of the run \[m^3\].
    pub(super) fn total(&self) -> f64 {
        self.volume.last().copied().unwrap_or(0.0)
    }

    /// Length along the route before which `volume` \[m^3\] of the run lies.
    pub(super) fn arc_at(&self, volume: f64) -> f64 {
        interpolate(&self.volume, &self.arc, volume)
    }

    /// Area of the section before which `volume` \[m^3\] of the run lies \[m^2\].
    pub(super) fn area_at(&self, volume: f64) -> f64 {
        let k = self.volume.partition_point(|v| *v <= volume).clamp(1, self.volume.len() - 1);
        let part = (volume - self.volume[k - 1]) / (self.volume[k] - self.volume[k - 1]);
        self.section[k - 1].area + part.clamp(0.0, 1.0) * (self.section[k].area - self.section[k - 1].area)
    }
}

fn interpolate(x: &[f64], y: &[f64], at: f64) -> f64 {
    let k = x.partition_point(|v| *v <= at).clamp(1, x.len() - 1);
    let part = (at - x[k - 1]) / (x[k] - x[k - 1]);
    y[k - 1] + part.clamp(0.0, 1.0) * (y[k] - y[k - 1])
}

/// The stretches of a route between two lengths in which every section is whole and none meets the next.
pub(super) fn runs(route: &Route<'_>, from: f64, to: f64, spacing: f64) -> Vec<Run> {
    let n = (STATIONS * (to - from) / spacing).ceil().max(1.0) as usize;
    // The last station is the end to the last bit.
    let arc = |k: usize| if k == n { to } else { from + (to - from) * k as f64 / n as f64 };
    let sections: Vec<Option<Section>> = (0..=n).into_par_iter().map(|k| route.section(arc(k))).collect();
    let mut runs: Vec<Run> = Vec::new();
    let mut is_open = false;
    for (k, section) in sections.into_iter().enumerate() {
        let Some(section) = section else {
            is_open = false;
            continue;
        };
        let last = runs.last_mut().filter(|_| is_open);
        if let Some(run) = last {
            let (volume, least) = run.section[run.section.len() - 1].volume_to(&section);
            if least > 0.0 {
                run.volume.push(run.total() + volume);
                run.arc.push(arc(k));
                run.section.push(section);
                continue;
            }
        }
        runs.push(Run { arc: vec![arc(k)], volume: vec![0.0], section: vec![section] });
        is_open = true;
    }
    // A stretch shorter than it is wide is not worth its two ends.
    runs.retain(|run| {
        let (first, last) = (run.section.len().min(1), run.section.len() - 1);
        let area = run.section[first.min(last)].area.min(run.section[last].area);
        run.arc[last] - run.arc[0] > 2.0 * (area / PI).sqrt()
    });
    runs
}

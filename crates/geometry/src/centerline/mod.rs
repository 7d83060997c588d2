//! The tree of centrelines of a vessel: branches between openings and junctions.

mod axial;
mod center;
mod curve;
mod path;

pub use curve::{Curve, Frame};

use crate::distance::SignedDistance;
use crate::vessel::Vessel;
use glam::DVec3;

/// Points across the radius at which two ways are compared, and of the lines between them.
const STEPS_ACROSS: f64 = 10.0;
const SAMPLES: usize = 32;
/// Width over which the steps of the grid are smoothed out of a way, in distances from the wall.
const WIDTH: f64 = 0.5;

/// Where a branch starts or ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BranchEnd {
    /// At the centre of the opening of that number.
    Opening(usize),
    /// At the junction of that number.
    Junction(usize),
}

/// A stretch of vessel without branching.
#[derive(Clone, Debug, PartialEq)]
pub struct Branch {
    /// The end towards the largest opening.
    pub start: BranchEnd,
    /// The other end.
    pub end: BranchEnd,
    /// Centreline from start to end. At a junction it reaches to abreast of the carina, where it is a
    /// way through the lumen, not a line of centres.
    pub curve: Curve,
}

/// Where a branch splits in two.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// Branch towards the largest opening, by number.
    pub parent: usize,
    /// The other two branches.
    pub daughters: [usize; 2],
    /// Point of the wall between the daughters \[m\].
    pub carina: DVec3,
    /// Middle between the ways into the daughters abreast of the carina \[m\].
    pub middle: DVec3,
}

/// Branches and junctions of a vessel; a tree whose root is the largest opening.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Centerlines {
    /// The branches.
    pub branches: Vec<Branch>,
    /// The junctions.
    pub junctions: Vec<Junction>,
}

impl Centerlines {
    /// Traces the vessel from its largest opening to every other.
    ///
    /// `None` with fewer than two openings, or where an opening cannot be reached at the resolution of
    /// the search (3e5 points in the lumen).
    pub fn trace(vessel: &Vessel) -> Option<Self> {
        let [root, others @ ..] = vessel.openings.as_slice() else { return None };
        if others.is_empty() {
            return None;
        }
        let (wall, closed) = (SignedDistance::wall(vessel), SignedDistance::closed(vessel));
        let ways = path::Ways::to(vessel, &wall, root.center)?;
        let step = others.iter().map(|o| o.radius).fold(root.radius, f64::min) / STEPS_ACROSS;
        let leaf = |o: &crate::Opening| {
            let inner = ways.way_to(o.center)?;
            let way = std::iter::once(root.center).chain(inner).chain([o.center]);
            let width = |x: DVec3| WIDTH * wall.query(x).distance.abs().max(2.0 * step);
            Some(Curve::new(way).resampled(step).smoothed(width).resampled(step))
        };
        let leaves: Vec<Curve> = others.iter().map(leaf).collect::<Option<_>>()?;
        let mut tree = Tree { leaves, closed, step, lines: Self::default() };
        let all: Vec<usize> = (0..others.len()).collect();
        tree.grow(&all, 0.0, BranchEnd::Opening(0));
        let mut lines = tree.lines;
        for branch in &mut lines.branches {
            branch.curve = center::centered(&branch.curve, &wall, step);
        }
        Some(lines)
    }
}

/// A tree being grown from its root.
struct Tree {
    /// Ways from the root to each other opening.
    leaves: Vec<Curve>,
    closed: SignedDistance,
    step: f64,
    lines: Centerlines,
}

/// Where two ways part.
struct Parting {
    arc: f64,
    ways: [usize; 2],
    carina: DVec3,
}

impl Tree {
    /// Adds the branch that starts at `start`, `arc` along the ways into `group`, and all behind it; returns
    /// its number.
    fn grow(&mut self, group: &[usize], arc: f64, start: BranchEnd) -> usize {
        let number = self.lines.branches.len();
        let parting = self.first_parting(group, arc);
        let Some(Parting { arc: until, ways: [a, b], carina }) = parting else {
            // Ways that never part lead into the same branch; the first stands for them.
            let way = &self.leaves[group[0]];
            let curve = way.stretch(arc, way.length(), self.pieces(way.length() - arc));
            self.lines.branches.push(Branch { start, end: BranchEnd::Opening(group[0] + 1), curve });
            return number;
        };
        let junction = self.lines.junctions.len();
        let pieces = self.pieces(until - arc);
        let between = |k: usize| {
            let at = arc + (until - arc) * k as f64 / pieces as f64;
            0.5 * (self.leaves[a].at(at) + self.leaves[b].at(at))
        };
        let curve = Curve::new((0..=pieces).map(between));
        let middle = between(pieces);
        self.lines.branches.push(Branch { start, end: BranchEnd::Junction(junction), curve });
        self.lines.junctions.push(Junction { parent: number, daughters: [0; 2], carina, middle });
        // Each way goes with that of the two it stays together with longer.
        let stays = |k: usize, with: usize| {
            k == with || self.parting(k, with, until - self.step).is_none_or(|p| p.arc > until + self.step)
        };
        let (first, second): (Vec<usize>, Vec<usize>) = group.iter().partition(|&&k| stays(k, a));
        let daughters = [(a, first), (b, second)].map(|(lead, mut group)| {
            group.sort_by_key(|&k| (k != lead, k));
            self.grow(&group, until, BranchEnd::Junction(junction))
        });
        self.lines.junctions[junction].daughters = daughters;
        number
    }

    fn pieces(&self, length: f64) -> usize {
        (length / self.step).ceil().max(2.0) as usize
    }

    fn first_parting(&self, group: &[usize], arc: f64) -> Option<Parting> {
        let pairs = group.iter().enumerate().flat_map(|(n, &a)| group[n + 1..].iter().map(move |&b| (a, b)));
        pairs.filter_map(|(a, b)| self.parting(a, b, arc)).min_by(|p, q| p.arc.total_cmp(&q.arc))
    }

    /// The first place from `arc` on where the line between two ways leaves the lumen.
    fn parting(&self, a: usize, b: usize, arc: f64) -> Option<Parting> {
        let (way, other) = (&self.leaves[a], &self.leaves[b]);
        let last = way.length().min(other.length());
        let mut at = arc;
        while at < last {
            let (p, q) = (way.at(at), other.at(at));
            if p.distance(q) > self.step {
                let sample = |k: usize| p.lerp(q, k as f64 / SAMPLES as f64);
                let level = |k: usize| self.closed.query(sample(k)).distance;
                let highest = (0..=SAMPLES).map(|k| (level(k), k)).max_by(|x, y| x.0.total_cmp(&y.0));
                if let Some((level, k)) = highest
                    && level > 0.0
                {
                    let carina = self.closed.query(sample(k)).point;
                    return Some(Parting { arc: at, ways: [a, b], carina });
                }
            }
            at += self.step;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{LengthUnit, prepare, shapes};
    use std::f64::consts::PI;

    #[test]
    fn a_bend_is_as_long_as_its_arc_and_centered() {
        let surface = shapes::bent_pipe(3e-3, 15e-3, PI / 2.0, 64);
        let bend = prepare(surface, Some(LengthUnit::Metre)).expect("a bend");
        let lines = Centerlines::trace(&bend).expect("two openings");
        let [branch] = lines.branches.as_slice() else { panic!("{lines:?}") };
        let length = branch.curve.length();
        assert!((length / (PI / 2.0 * 15e-3) - 1.0).abs() < 0.01, "{length}");
        let wall = SignedDistance::wall(&bend);
        let clearance = branch.curve.points().iter().map(|p| -wall.query(*p).distance).fold(1.0, f64::min);
        assert!(clearance > 0.97 * 3e-3, "{clearance}");
    }
}

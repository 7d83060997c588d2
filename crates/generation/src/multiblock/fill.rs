//! The limbs of a vessel and what blocks they are filled with.

use super::blocks::{Layer, Maker, Stretch};
use super::layers::Library;
use super::limb::{self, Hinge, Route};
use super::{Report, junction};
use crate::frame::Frame;
use vaso_geometry::{BranchEnd, Centerlines, Curve, Opening, Vessel};

/// Distances from the carina, in distances from the wall, at which blocks start at a junction without.
const CLEAR: f64 = 1.0;
/// Lengths a limb may take to unfold that are tried one after the other, in usual ones.
const EASES: [f64; 4] = [1.0, 1.3, 0.8, 1.7];
/// Fewest layers worth a block.
const FEWEST: usize = 2;

/// A limb to be filled.
pub(super) struct Limb<'a> {
    pub(super) route: Route<'a>,
    /// Length along the route at which it starts \[m\].
    from: f64,
    pub(super) hinge: Option<Hinge>,
}

/// What a limb was filled with.
#[derive(Default)]
pub(super) struct Filling {
    pub(super) stretches: Vec<Stretch>,
    /// Whether its layers reach from end to end.
    pub(super) is_whole: bool,
}

impl Filling {
    pub(super) fn layers(&self) -> impl Iterator<Item = &Layer> {
        self.stretches.iter().flat_map(|s| &s.layers)
    }

    /// Length along the route up to which its layers are sound without a gap \[m\].
    fn reach(&self) -> f64 {
        let sound = self.layers().filter(|l| l.is_sound);
        sound.fold(0.0, |reached, layer| if layer.arc[0] <= reached { layer.arc[1] } else { reached })
    }

    pub(super) fn layers_mut(&mut self) -> impl Iterator<Item = &mut Layer> {
        self.stretches.iter_mut().flat_map(|s| &mut s.layers)
    }
}

/// The laying of blocks.
pub(super) struct Work<'a> {
    pub(super) vessel: &'a Vessel,
    pub(super) frame: &'a Frame,
    pub(super) lines: &'a Centerlines,
    pub(super) maker: Maker<'a>,
    pub(super) wireframes: Library,
    pub(super) report: Report,
}

/// Half of a branch, or the whole, from a junction outwards.
struct Outward {
    curve: Curve,
    opening: Option<usize>,
}

impl<'a> Work<'a> {
    /// Limbs and what they are filled with.
    pub(super) fn fill(&mut self) -> (Vec<Limb<'a>>, Vec<Filling>) {
        let (mut limbs, mut fillings) = (Vec::new(), Vec::new());
        for branch in &self.lines.branches {
            if let (BranchEnd::Opening(a), BranchEnd::Opening(b)) = (branch.start, branch.end) {
                let openings = [Some(&self.vessel.openings[a]), Some(&self.vessel.openings[b])];
                let route = Route::new(&branch.curve, self.maker.spacing, None, openings, self.maker.wall);
                let limb = Limb { route, from: 0.0, hinge: None };
                fillings.push(self.fill_limb(&limb));
                limbs.push(limb);
            }
        }
        for number in 0..self.lines.junctions.len() {
            let outward = self.outward(number);
            let blocked = self.blocked(number, &outward);
            let filled = match blocked {
                Ok(filled) => {
                    self.report.blocked_junctions += 1;
                    filled
                }
                Err(reason) => {
                    let at = 1e3 * self.frame.place(self.lines.junctions[number].carina);
                    self.report.unblocked_junctions.push(format!(
                        "the junction at ({:.1}, {:.1}, {:.1}) mm is filled by the lattice: {reason}",
                        at.x, at.y, at.z
                    ));
                    self.unblocked(&outward)
                }
            };
            for (limb, filling) in filled {
                limbs.push(limb);
                fillings.push(filling);
            }
        }
        (limbs, fillings)
    }

    /// The three limbs of a junction: parent, first and second daughter.
    fn outward(&self, number: usize) -> [Outward; 3] {
        let junction = &self.lines.junctions[number];
        let [a, b] = junction.daughters;
        [junction.parent, a, b].map(|branch| {
            let branch = &self.lines.branches[branch];
            let is_start = branch.start == BranchEnd::Junction(number);
            let whole = if is_start { branch.curve.clone() } else { branch.curve.reversed() };
            let far = if is_start { branch.end } else { branch.start };
            match far {
                BranchEnd::Opening(k) => Outward { curve: whole, opening: Some(k) },
                BranchEnd::Junction(_) => {
                    // Two junctions share a branch: each gets half of it, up to a plane in the middle.
                    let half = whole.stretch(0.0, 0.5 * whole.length(), whole.points().len().div_ceil(2));
                    Outward { curve: half, opening: None }
                }
            }
        })
    }

    fn limb(&self, outward: &Outward, curve: &Curve, hinge: Option<Hinge>, from: f64) -> Limb<'a> {
        let opening: Option<&'a Opening> = outward.opening.map(|k| &self.vessel.openings[k]);
        let route = Route::new(curve, self.maker.spacing, hinge, [None, opening], self.maker.wall);
        Limb { route, from, hinge }
    }

    /// Limbs that fill a junction, or why they do not.
    fn blocked(&mut self, number: usize, outward: &[Outward; 3]) -> Result<Vec<(Limb<'a>, Filling)>, String> {
        let curves = outward.each_ref().map(|o| &o.curve);
        let meeting = junction::meeting(&self.lines.junctions[number], curves, self.maker.wall)?;
        let mut filled = Vec::with_capacity(3);
        for (k, outward) in outward.iter().enumerate() {
            let mut sound = None;
            for ease in EASES {
                let start = meeting.start(k, ease)?;
                let limb = self.limb(outward, &start.curve, Some(start.hinge), 0.0);
                let filling = self.fill_limb(&limb);
                if filling.reach() >= start.hinge.length {
                    sound = Some((limb, filling));
                    break;
                }
            }
            filled.push(sound.ok_or("its sections cross or its cells turn over")?);
        }
        Ok(filled)
    }

    /// Limbs that keep clear of a junction.
    fn unblocked(&mut self, outward: &[Outward; 3]) -> Vec<(Limb<'a>, Filling)> {
        let mut filled = Vec::new();
        for outward in outward {
            let curve = &outward.curve;
            let from = CLEAR * self.maker.wall.query(curve.at(0.5 * curve.length())).distance.abs();
            if from < 0.8 * curve.length() {
                let limb = self.limb(outward, curve, None, from);
                let filling = self.fill_limb(&limb);
                filled.push((limb, Filling { is_whole: false, ..filling }));
            }
        }
        filled
    }

    fn fill_limb(&mut self, limb: &Limb<'_>) -> Filling {
        let spacing = self.maker.spacing;
        let runs = limb::runs(&limb.route, limb.from, limb.route.length(), spacing);
        let even_until = limb.hinge.map_or(0.0, |h| h.length);
        let mut filling = Filling { stretches: Vec::new(), is_whole: runs.len() == 1 };
        for run in &runs {
            let layers = self.wireframes.layers(run, spacing, even_until);
            if layers.iter().map(|l| l.arc.len() - 1).sum::<usize>() < FEWEST {
                filling.is_whole = false;
                continue;
            }
            for layers in &layers {
                match self.maker.stretch(&limb.route, layers) {
                    Some(stretch) => filling.stretches.push(stretch),
                    None => filling.is_whole = false,
                }
            }
        }
        let is_sound = filling.layers().all(|l| l.is_sound);
        filling.is_whole &= is_sound;
        let ends = runs.first().zip(runs.last()).map(|(a, b)| [a.arc[0], b.arc[b.arc.len() - 1]]);
        filling.is_whole &= ends == Some([limb.from, limb.route.length()]);
        filling
    }
}

//! How many cells a section gets, and where along a limb the layers of cells end.

use super::limb::Run;
use super::topology::{Divisions, Topology, Wireframe};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Most by which the area of a section may differ from that of the first, in ratio, before it is divided anew.
const BAND: f64 = 0.12;
/// Wireframes with a number of cells this far off are not looked at, unless there are no others.
const NEAR: f64 = 0.15;
/// Cells of the core to the wall, in divisions of the core.
const RADIAL: (f64, f64) = (0.15, 0.75);
/// Most divisions of a core.
const MOST: usize = 200;

/// Layers of cells with the same wireframe.
pub(super) struct Layers {
    pub(super) frame: Arc<Wireframe>,
    /// Length along the route of the sections between the layers \[m\], one more than layers.
    pub(super) arc: Vec<f64>,
}

/// Wireframes made so far: a vessel asks for the same few again and again.
pub(super) struct Library {
    topology: Topology,
    made: BTreeMap<Divisions, Arc<Wireframe>>,
}

impl Library {
    pub(super) fn new(topology: Topology) -> Self {
        Self { topology, made: BTreeMap::new() }
    }

    fn get(&mut self, d: Divisions) -> Arc<Wireframe> {
        let topology = self.topology;
        self.made.entry(d).or_insert_with(|| Arc::new(topology.wireframe(d))).clone()
    }

    /// The wireframe that divides a section most evenly into about `target` cells; with `is_even` the
    /// divisions across the hinge are even, so that a line of nodes lies on it.
    fn choose(&mut self, target: f64, is_even: bool) -> Arc<Wireframe> {
        let topology = self.topology;
        let radial = |n: usize| match topology {
            Topology::Single => 1..=1,
            _ => {
                let share = |s: f64| (s * n as f64) as usize;
                share(RADIAL.0).max(1)..=share(RADIAL.1).max(1)
            }
        };
        let most = MOST.min(2 + target.sqrt() as usize);
        let pairs = (1..=most).flat_map(|n| [(n, n), (n, n + 1), (n + 1, n)]);
        let all = pairs
            .filter(|(across, _)| !is_even || across % 2 == 0)
            .flat_map(|(across, along)| radial(along).map(move |radial| Divisions { across, along, radial }));
        let off = |d: Divisions| (topology.cells(d) as f64 / target).ln().abs();
        let mut found: Vec<(f64, Divisions)> = all.map(|d| (off(d), d)).collect();
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let near = found.partition_point(|(off, _)| *off < NEAR).max(3).min(found.len());
        let price = |frame: &Wireframe, off: f64| {
            off * off + frame.spread * frame.spread + (0.7 - frame.closest).max(0.0)
        };
        let tried = found[..near].iter().map(|&(off, d)| {
            let frame = self.get(d);
            (price(&frame, off), frame)
        });
        let best = tried.min_by(|a, b| a.0.total_cmp(&b.0));
        best.map(|(_, frame)| frame).unwrap_or_else(|| self.get(Divisions { across: 2, along: 2, radial: 1 }))
    }

    /// Cuts a run into layers whose cells have the volume of a cube of `spacing` \[m\].
    ///
    /// Sections before length `even_until` \[m\] have a line of nodes on the hinge.
    pub(super) fn layers(&mut self, run: &Run, spacing: f64, even_until: f64) -> Vec<Layers> {
        let (cell, face) = (spacing.powi(3), spacing * spacing);
        let total = run.total();
        let mut layers = Vec::new();
        let mut start = 0.0;
        while start < total {
            // The middle of the first layer stands for it.
            let first = run.area_at((start + 0.5 * spacing * run.area_at(start)).min(total));
            let frame = self.choose(first / face, run.arc_at(start) < even_until);
            let layer = frame.cells as f64 * cell;
            let fits = |v: f64| (run.area_at(v) / first).ln().abs() < BAND;
            let mut n = 1;
            while start + (n as f64 + 0.5) * layer <= total && fits(start + (n as f64 + 0.5) * layer) {
                n += 1;
            }
            // What is left over would be less than a layer: shared among those of the last stretch.
            let mut end = start + n as f64 * layer;
            if end + 0.75 * layer > total {
                n = ((total - start) / layer).round().max(1.0) as usize;
                end = total;
            }
            let at = |k: usize| run.arc_at(start + (end - start) * k as f64 / n as f64);
            layers.push(Layers { frame, arc: (0..=n).map(at).collect() });
            start = if end == total { f64::INFINITY } else { end };
        }
        layers
    }
}

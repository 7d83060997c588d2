//! How blocks fill a section: wireframes on the unit disc.

use super::tfi;
use glam::DVec2;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Arrangement of the blocks of a section.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Topology {
    /// One block over the whole section.
    Single,
    /// Three by three blocks, the corner points of the inner ones inside the vessel.
    NineBlock,
    /// One block in the core and one between it and each quarter of the wall.
    #[default]
    OGrid,
}

/// A point of a wireframe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Node {
    /// Inside, at these coordinates on the unit disc.
    Inner(DVec2),
    /// On the wall, by its number in [`Wireframe::wall`].
    Wall(usize),
}

/// A point on the wall, and from which point of the opposite edge it is projected, both on the unit disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Projection {
    pub(crate) at: DVec2,
    pub(crate) from: DVec2,
}

/// A block of a section by its edges: bottom, top, left, right.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Patch {
    pub(crate) edges: [Vec<Node>; 4],
}

/// Blocks of a section on the unit disc.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Wireframe {
    pub(crate) patches: Vec<Patch>,
    /// Points on the wall, by growing angle from the first.
    pub(crate) wall: Vec<Projection>,
    /// Cells of the section.
    pub(crate) cells: usize,
    /// Coefficient of variation of the areas of the cells on the disc.
    pub(crate) spread: f64,
    /// Area of the smallest cell over the mean, on the disc.
    pub(crate) smallest: f64,
    /// Smallest distance between the centres of cells, in square roots of their mean area.
    pub(crate) closest: f64,
}

/// Free numbers of a wireframe: where the ring of inner points lies.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Shape {
    /// Radius of the corners of the core.
    core: f64,
    /// Edges of the core between the chord, 0, and the circle through the corners, 1.
    bulge: f64,
    /// By how much the points along the edges of the core and along the wall draw to the corners.
    crowd: f64,
}

/// Divisions of a wireframe: along the core across the hinge and along it, and from the core to the wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Divisions {
    pub(crate) across: usize,
    pub(crate) along: usize,
    pub(crate) radial: usize,
}

/// Below this distance between centres an arrangement counts as worse than its areas alone say.
const CLOSE: f64 = 0.75;

impl Topology {
    /// Cells of a section with the given divisions.
    pub(crate) fn cells(self, d: Divisions) -> usize {
        match self {
            Self::Single => d.across * d.along,
            Self::NineBlock => (d.across + 2 * d.radial) * (d.along + 2 * d.radial),
            Self::OGrid => d.across * d.along + 2 * d.radial * (d.across + d.along),
        }
    }

    /// The wireframe with the least spread of areas for the divisions.
    pub(crate) fn wireframe(self, d: Divisions) -> Wireframe {
        let build = |shape: Shape| {
            let mut frame = match self {
                Self::Single => single(d),
                Self::NineBlock => nine_block(d, shape),
                Self::OGrid => o_grid(d, shape),
            };
            frame.measure();
            frame
        };
        let price = |f: &Wireframe| f.spread + (CLOSE - f.closest).max(0.0);
        let mut shape = match self {
            Self::Single => return build(Shape { core: 0.0, bulge: 0.0, crowd: 0.0 }),
            Self::NineBlock => Shape { core: 0.55, bulge: 0.5, crowd: 0.0 },
            Self::OGrid => Shape { core: 0.7, bulge: 0.48, crowd: 0.14 },
        };
        let freedoms: &[fn(&mut Shape, f64)] = match self {
            Self::OGrid => {
                &[|s, by| s.core += 0.06 * by, |s, by| s.bulge += 0.1 * by, |s, by| s.crowd += 0.05 * by]
            }
            _ => &[|s, by| s.core += 0.06 * by, |s, by| s.bulge += 0.1 * by],
        };
        // Compass search: the price has one minimum, and a hundredth of it is near enough.
        let mut best = build(shape);
        let mut step = 1.0;
        while step > 0.1 {
            let mut has_moved = false;
            for (freedom, way) in freedoms.iter().flat_map(|f| [(f, step), (f, -step)]) {
                let mut tried = shape;
                freedom(&mut tried, way);
                let is_sound = (0.2..0.95).contains(&tried.core) && (0.0..=1.0).contains(&tried.bulge);
                let frame = if is_sound { build(tried) } else { continue };
                if price(&frame) < price(&best) {
                    (best, shape, has_moved) = (frame, tried, true);
                }
            }
            step *= if has_moved { 1.0 } else { 0.5 };
        }
        best
    }
}

impl Wireframe {
    /// Areas and centres of the cells on the disc itself.
    fn measure(&mut self) {
        let wall: Vec<DVec2> = self.wall.iter().map(|w| w.at).collect();
        let place = |node: &Node| match *node {
            Node::Inner(p) => p,
            Node::Wall(k) => wall[k],
        };
        let (mut areas, mut centers) = (Vec::new(), Vec::new());
        for patch in &self.patches {
            let [b, t, l, r] = &patch.edges.each_ref().map(|e| e.iter().map(place).collect::<Vec<_>>());
            let face = tfi::face(b, t, l, r);
            let [ni, nj, _] = face.cells();
            for (i, j) in (0..ni).flat_map(|i| (0..nj).map(move |j| (i, j))) {
                let corner = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(a, b)| face.at(i + a, j + b, 0));
                areas.push(0.5 * (corner[2] - corner[0]).perp_dot(corner[3] - corner[1]));
                centers.push(corner.iter().sum::<DVec2>() / 4.0);
            }
        }
        let mean = areas.iter().sum::<f64>() / areas.len() as f64;
        let variance = areas.iter().map(|a| (a - mean).powi(2)).sum::<f64>() / areas.len() as f64;
        self.cells = areas.len();
        self.spread = variance.sqrt() / mean;
        self.smallest = areas.iter().fold(f64::INFINITY, |a, b| a.min(*b)) / mean;
        // By growing x, each looks ahead as far as the closest pair so far.
        centers.sort_by(|a, b| a.x.total_cmp(&b.x));
        let mut closest = f64::INFINITY;
        for (k, a) in centers.iter().enumerate() {
            for b in &centers[k + 1..] {
                if b.x - a.x >= closest {
                    break;
                }
                closest = closest.min(a.distance(*b));
            }
        }
        self.closest = closest / mean.sqrt();
        if areas.iter().any(|a| *a <= 0.0) {
            self.spread = f64::INFINITY;
        }
    }
}

fn polar(radius: f64, angle: f64) -> DVec2 {
    radius * DVec2::from_angle(angle)
}

fn part(k: usize, n: usize) -> f64 {
    k as f64 / n as f64
}

fn crowded(u: f64, crowd: f64) -> f64 {
    u + crowd * (TAU * u).sin() / TAU
}

/// The line from `a` to `b` in `n` pieces, inside.
fn straight(a: DVec2, b: DVec2, n: usize) -> Vec<DVec2> {
    (0..=n).map(|k| a.lerp(b, part(k, n))).collect()
}

/// Half the angle the quarters of the wall before and behind the core take.
fn corner_angle(across: usize, along: usize) -> f64 {
    FRAC_PI_2 * along as f64 / (across + along) as f64
}

fn inner(line: &[DVec2]) -> Vec<Node> {
    line.iter().map(|p| Node::Inner(*p)).collect()
}

/// The core's corner points and, between them, its edges: right, top, left, bottom, counter-clockwise.
fn core_edges(d: Divisions, shape: Shape) -> [Vec<DVec2>; 4] {
    let corner = corner_angle(d.across, d.along);
    let turn = [-corner, corner, PI - corner, PI + corner, TAU - corner];
    std::array::from_fn(|side| {
        let n = if side % 2 == 0 { d.along } else { d.across };
        let (from, to) = (turn[side], turn[side + 1]);
        let (a, b) = (polar(shape.core, from), polar(shape.core, to));
        let bulged = |k: usize| {
            let u = crowded(part(k, n), shape.crowd);
            a.lerp(b, u).lerp(polar(shape.core, from + (to - from) * u), shape.bulge)
        };
        // Corners are the same bits on both edges.
        let point = |k: usize| match k {
            0 => a,
            k if k == n => polar(shape.core, turn[(side + 1) % 4]),
            k => bulged(k),
        };
        (0..=n).map(point).collect()
    })
}

/// The core as a patch: its edges run left to right and bottom to top.
fn core_patch([right, top, left, bottom]: &[Vec<DVec2>; 4]) -> Patch {
    let backwards = |line: &[DVec2]| inner(&line.iter().rev().copied().collect::<Vec<_>>());
    Patch { edges: [inner(bottom), backwards(top), backwards(left), inner(right)] }
}

fn frame(patches: Vec<Patch>, wall: Vec<Projection>) -> Wireframe {
    Wireframe { patches, wall, cells: 0, spread: f64::INFINITY, smallest: 0.0, closest: 0.0 }
}

fn o_grid(d: Divisions, shape: Shape) -> Wireframe {
    let core = core_edges(d, shape);
    let mut patches = vec![core_patch(&core)];
    let mut wall = Vec::new();
    let total = 2 * (d.across + d.along);
    let corner = corner_angle(d.across, d.along);
    let spoke = |from: DVec2, number: usize, at: DVec2| {
        let mut line = inner(&straight(from, at, d.radial));
        line[d.radial] = Node::Wall(number);
        line
    };
    let first = polar(1.0, -corner);
    for (side, edge) in core.iter().enumerate() {
        let n = edge.len() - 1;
        let start = wall.len();
        let (from, to) = (
            [-corner, corner, PI - corner, PI + corner][side],
            [corner, PI - corner, PI + corner, TAU - corner][side],
        );
        let at = |k: usize| polar(1.0, from + (to - from) * crowded(part(k, n), shape.crowd));
        wall.extend((0..n).map(|k| Projection { at: at(k), from: edge[k] }));
        let end = if side == 3 { first } else { at(n) };
        let outer: Vec<Node> = (0..=n).map(|k| Node::Wall((start + k) % total)).collect();
        let (left, right) = (spoke(edge[0], start, at(0)), spoke(edge[n], (start + n) % total, end));
        // Seen from the core the wall is below, so that the cells keep their orientation.
        let backwards = |line: Vec<Node>| line.into_iter().rev().collect::<Vec<_>>();
        patches.push(Patch { edges: [outer, inner(edge), backwards(left), backwards(right)] });
    }
    frame(patches, wall)
}

fn single(d: Divisions) -> Wireframe {
    let corner = corner_angle(d.across, d.along);
    let total = 2 * (d.across + d.along);
    let start = [-corner, corner, PI - corner, PI + corner];
    let sides = [d.along, d.across, d.along, d.across];
    let mut at = Vec::new();
    for side in 0..4 {
        let span = if side % 2 == 0 { 2.0 * corner } else { PI - 2.0 * corner };
        at.extend((0..sides[side]).map(|k| polar(1.0, start[side] + span * part(k, sides[side]))));
    }
    // The point of the same number on the opposite edge; for the corners that is the corner across.
    let opposite = |k: usize| {
        let (mut side, mut number) = (0, k);
        while number >= sides[side] {
            number -= sides[side];
            side += 1;
        }
        if number == 0 {
            -at[k]
        } else {
            DVec2::new(
                if side % 2 == 0 { -at[k].x } else { at[k].x },
                if side % 2 == 0 { at[k].y } else { -at[k].y },
            )
        }
    };
    let wall = (0..total).map(|k| Projection { at: at[k], from: 0.5 * (at[k] + opposite(k)) }).collect();
    let line = |from: usize, n: usize| (0..=n).map(|k| Node::Wall((from + k) % total)).collect::<Vec<_>>();
    let backwards = |line: Vec<Node>| line.into_iter().rev().collect::<Vec<_>>();
    let (right, top) = (line(0, d.along), line(d.along, d.across));
    let (left, bottom) = (line(d.along + d.across, d.along), line(2 * d.along + d.across, d.across));
    frame(vec![Patch { edges: [bottom, backwards(top), backwards(left), right] }], wall)
}

fn nine_block(d: Divisions, shape: Shape) -> Wireframe {
    // Along each side of the section: a corner block, a middle block, a corner block.
    let core = core_edges(d, shape);
    let corner = corner_angle(d.across, d.along);
    let r = d.radial;
    let total = 2 * (d.across + d.along) + 8 * r;
    // A middle block meets the wall over the share of the side its divisions have.
    let half = |n: usize, span: f64| span * n as f64 / (n + 2 * r) as f64;
    let sides = [
        (d.along, corner, 0.0),
        (d.across, FRAC_PI_2 - corner, FRAC_PI_2),
        (d.along, corner, PI),
        (d.across, FRAC_PI_2 - corner, 1.5 * PI),
    ];
    let mut wall = Vec::new();
    // Wall points before and behind each corner of the core, and the outer corner itself.
    let mut marks = [[0; 3]; 4];
    for (side, &(n, span, middle)) in sides.iter().enumerate() {
        let core_edge = &core[side];
        let (low, high) = (middle - half(n, span), middle + half(n, span));
        let outer = polar(1.0, middle - span);
        let (a, b) = (core_edge[0], core_edge[n]);
        marks[side][0] = wall.len();
        // Corner block behind: projected from the line between the inner corner and the next side's wall.
        let previous = {
            let (m, span, middle) = sides[(side + 3) % 4];
            polar(1.0, middle + half(m, span))
        };
        wall.extend((0..r).map(|k| {
            let at = polar(1.0, (middle - span) + (low - (middle - span)) * part(k, r));
            let from = if k == 0 { a } else { previous.lerp(a, part(k, r)) };
            Projection { at: if k == 0 { outer } else { at }, from }
        }));
        marks[side][1] = wall.len();
        wall.extend(
            (0..n)
                .map(|k| Projection { at: polar(1.0, low + (high - low) * part(k, n)), from: core_edge[k] }),
        );
        marks[side][2] = wall.len();
        let next = {
            let (m, span, middle) = sides[(side + 1) % 4];
            polar(1.0, middle - half(m, span))
        };
        wall.extend((0..r).map(|k| {
            let at = polar(1.0, high + (middle + span - high) * part(k, r));
            Projection { at, from: b.lerp(next, part(k, r)) }
        }));
    }
    let walls = |from: usize, n: usize| (0..=n).map(|k| Node::Wall((from + k) % total)).collect::<Vec<_>>();
    let backwards = |line: Vec<Node>| line.into_iter().rev().collect::<Vec<_>>();
    let spoke = |number: usize, to: DVec2| {
        let mut line = inner(&straight(wall[number].at, to, r));
        line[0] = Node::Wall(number);
        line
    };
    let mut patches = vec![core_patch(&core)];
    for side in 0..4 {
        let edge = &core[side];
        let n = edge.len() - 1;
        let [_, low, high] = marks[side];
        // Middle block: wall below, core above.
        patches
            .push(Patch { edges: [walls(low, n), inner(edge), spoke(low, edge[0]), spoke(high, edge[n])] });
        // Corner block behind the middle one of the next side: from this side's wall to the next's.
        let next = (side + 1) % 4;
        let [outer, next_low, _] = marks[next];
        patches.push(Patch {
            edges: [
                walls(high, r),
                backwards(spoke(next_low, edge[n])),
                spoke(high, edge[n]),
                walls(outer, r),
            ],
        });
    }
    frame(patches, wall)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn divisions(n: usize, radial: usize) -> Divisions {
        Divisions { across: n, along: n, radial }
    }

    /// The order of the topologies, and the figures of a disc with 12 divisions of the core.
    #[test]
    fn an_o_grid_is_the_most_even_and_a_single_block_the_least() {
        let single = Topology::Single.wireframe(divisions(20, 1));
        let nine = Topology::NineBlock.wireframe(divisions(12, 4));
        let o_grid = Topology::OGrid.wireframe(divisions(12, 5));
        for (name, frame) in [("single", &single), ("nine-block", &nine), ("o-grid", &o_grid)] {
            println!(
                "{name}: spread {:.4}, closest {:.3}, {} cells",
                frame.spread, frame.closest, frame.cells
            );
        }
        assert!(o_grid.spread < nine.spread && nine.spread < single.spread);
        assert!(o_grid.spread <= 0.13 && o_grid.closest >= 0.70, "{} {}", o_grid.spread, o_grid.closest);
        assert!((single.spread - 0.307).abs() < 0.03, "{}", single.spread);
    }

    #[test]
    fn wireframes_have_the_cells_they_promise_and_walls_all_around() {
        for topology in [Topology::Single, Topology::NineBlock, Topology::OGrid] {
            for d in [divisions(4, 2), Divisions { across: 6, along: 5, radial: 3 }] {
                let frame = topology.wireframe(d);
                assert_eq!(frame.cells, topology.cells(d), "{topology:?}");
                assert!(frame.spread < 0.6, "{topology:?} {d:?}: {}", frame.spread);
                let turn = frame.wall[0].at.to_angle();
                let mut last = -1.0;
                for wall in &frame.wall {
                    assert!((wall.at.length() - 1.0).abs() < 1e-12 && wall.from.length() < 1.0 + 1e-12);
                    let angle = (wall.at.to_angle() - turn).rem_euclid(TAU);
                    assert!(angle > last, "{topology:?}: {angle} after {last}");
                    last = angle;
                }
            }
        }
    }
}

//! The pictures of the page, as SVG.

use super::tables::{GENERATORS, candidates, vessel};
use glam::DVec3;
use vaso_driver::compare::{Compared, measure, middle};
use vaso_generation::Settings;
use vaso_generation::multiblock::{self, Options, Outline, Topology};
use vaso_geometry::shapes::{BifurcationSpec, bifurcation, pipe};
use vaso_report::{ComparedParticles, Drawing, Pen, Plane, sheet, slab};

const EDGE: Pen = Pen { color: [0, 90, 160], width: 1.6 };
const CELL: Pen = Pen { color: [110, 120, 135], width: 0.7 };
const SECTION: Pen = Pen { color: [190, 70, 20], width: 0.8 };
/// Spacing in the bifurcation \[m\].
const SPACING: f64 = 0.5e-3;
/// Every so manyth section is drawn.
const EVERY: usize = 3;
/// Angle by which the eye is off the axis of symmetry \[rad\], so that round things look round.
const TILT: f64 = 0.35;

/// All pictures with their names.
pub(crate) fn all() -> Vec<(&'static str, String)> {
    let fork = vessel(bifurcation(&BifurcationSpec::default()));
    let compared: Vec<(String, Compared)> = candidates(GENERATORS)
        .into_iter()
        .map(|candidate| {
            let made = measure(&fork, &Settings::new(SPACING), &candidate, 0, &mut |_, _| {});
            (candidate.name, made.unwrap_or_else(|e| panic!("{e}")))
        })
        .collect();
    let particles = |plane: Plane, names: &[&str]| -> Vec<(String, Drawing)> {
        let wanted = compared.iter().filter(|(name, _)| names.is_empty() || names.contains(&name.as_str()));
        let drawn = wanted.map(|(name, c)| {
            let body = &c.fluid.body;
            let particles = ComparedParticles { position: &body.position, volume: &body.volume };
            (name.clone(), slab(&particles, plane, SPACING))
        });
        drawn.collect()
    };
    let symmetry = Plane { origin: DVec3::ZERO, right: DVec3::Z, up: DVec3::X };
    let along = particles(symmetry, &["relaxed-lattice:cubic", "multiblock:o-grid"]);
    let across = particles(middle(&fork), &[]);
    vec![
        ("sections", sections()),
        ("blocks", blocks()),
        ("along", on_sheet(&along, 1, 900, "particles in the plane of symmetry of a bifurcation")),
        ("across", on_sheet(&across, 3, 900, "particles across a branch")),
    ]
}

fn on_sheet(drawings: &[(String, Drawing)], columns: usize, width: u32, label: &str) -> String {
    let panels: Vec<(&str, &Drawing)> = drawings.iter().map(|(name, d)| (name.as_str(), d)).collect();
    sheet(&panels, columns, width, label, true)
}

fn outline(surface: vaso_geometry::Surface, spacing: f64, topology: Topology) -> Outline {
    let options = Options { topology, ..Options::default() };
    let made = multiblock::fluid(&vessel(surface), &Settings::new(spacing), &options, &mut |_, _| {});
    made.unwrap_or_else(|e| panic!("{e}")).outline
}

/// The cells of each arrangement in the first section of a tube.
fn sections() -> String {
    let plane = Plane { origin: DVec3::ZERO, right: DVec3::X, up: DVec3::Y };
    let draw = |topology| {
        let outline = outline(pipe(3e-3, 15e-3, DVec3::Z, 96), 6e-3 / 16.0, topology);
        let end = outline.faces[0][0].z;
        let is_first = |line: &&Vec<DVec3>| line.iter().all(|x| (x.z - end).abs() < 1e-6);
        let mut drawing = Drawing::new(plane);
        outline.faces.iter().filter(is_first).for_each(|line| drawing.line(line, CELL));
        outline.edges.iter().filter(is_first).for_each(|line| drawing.line(line, EDGE));
        drawing
    };
    let names =
        [("single", Topology::Single), ("nine-block", Topology::NineBlock), ("o-grid", Topology::OGrid)];
    let drawings: Vec<(String, Drawing)> = names.map(|(name, t)| (name.to_owned(), draw(t))).into();
    on_sheet(&drawings, 3, 900, "cells of three arrangements of blocks in a round section")
}

/// Sections and blocks of the bifurcation.
fn blocks() -> String {
    let outline = outline(bifurcation(&BifurcationSpec::default()), SPACING, Topology::OGrid);
    let (sin, cos) = TILT.sin_cos();
    let plane = Plane { origin: DVec3::ZERO, right: DVec3::new(0.0, -sin, cos), up: DVec3::X };
    let mut cuts = Drawing::new(plane);
    for border in outline.sections.iter().step_by(EVERY) {
        let closed: Vec<DVec3> = border.iter().chain(border.first()).copied().collect();
        cuts.line(&closed, SECTION);
    }
    let mut edges = Drawing::new(plane);
    outline.edges.iter().for_each(|line| edges.line(line, Pen { width: 0.9, ..EDGE }));
    on_sheet(
        &[("sections".to_owned(), cuts), ("blocks".to_owned(), edges)],
        1,
        900,
        "sections and blocks of a bifurcation",
    )
}

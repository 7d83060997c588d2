//! Particles by blocks in shapes made from numbers and in real vessels.

use glam::{DQuat, DVec3};
use std::path::PathBuf;
use vaso_generation::multiblock::{Multiblock, Options, Place, Topology, fluid};
use vaso_generation::{Quality, Settings};
use vaso_geometry::{LengthUnit, Surface, Vessel, prepare, read_surface, shapes, write_stl};

fn vessel(surface: Surface, unit: LengthUnit) -> Vessel {
    prepare(surface, Some(unit)).expect("it is a vessel")
}

/// A surface of the data folder, `None` when there is none.
fn data(file: &str) -> Option<Surface> {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        eprintln!("skipped: VASO_DATA is not set");
        return None;
    };
    Some(read_surface(&PathBuf::from(data).join("geometry").join(file)).expect("the file is there"))
}

fn lay(vessel: &Vessel, spacing: f64, options: &Options) -> Multiblock {
    fluid(vessel, &Settings::new(spacing), options, &mut |_, _| {}).expect("the spacing suits")
}

fn o_grid(vessel: &Vessel, spacing: f64) -> Multiblock {
    lay(vessel, spacing, &Options::default())
}

/// The volumes add up, and no particle is outside.
fn hold(vessel: &Vessel, made: &Multiblock, volume: f64) {
    let filled = made.body.volume.iter().sum::<f64>() / vessel.surface.volume();
    println!("{:?}\n{:?}", made.report, made.body.quality);
    assert!((filled - 1.0).abs() < volume, "filled {filled}");
    assert_eq!(made.body.quality.outside, 0);
    assert!(made.body.volume.iter().all(|v| *v > 0.0));
    assert_eq!(made.body.volume.len(), made.body.position.len());
}

#[test]
fn a_pipe_is_filled_evenly_at_any_width() {
    let pipe =
        vessel(shapes::pipe(3.0, 30.0, DVec3::new(1.0, 2.0, 3.0).normalize(), 96), LengthUnit::Millimetre);
    for across in [8.0, 12.0, 20.0] {
        let made = o_grid(&pipe, 6e-3 / across);
        hold(&pipe, &made, 0.005);
        let q = &made.body.quality;
        assert!(q.volume_cv <= 0.13 && q.nearest_neighbor_min >= 0.70, "{across} across: {q:?}");
        assert_eq!(made.report.lattice_particles, 0);
    }
}

#[test]
fn an_o_grid_is_the_most_even_and_a_single_block_the_least() {
    let pipe = vessel(shapes::pipe(3.0, 20.0, DVec3::Z, 96), LengthUnit::Millimetre);
    let spread = |topology| {
        let made = lay(&pipe, 0.4e-3, &Options { topology, ..Options::default() });
        hold(&pipe, &made, 0.005);
        made.body.quality.volume_cv
    };
    let [single, nine, o_grid] = [Topology::Single, Topology::NineBlock, Topology::OGrid].map(spread);
    assert!(o_grid < nine && nine < single, "{o_grid} {nine} {single}");
    assert!((single - 0.307).abs() < 0.03 && o_grid < 0.13, "{single} {o_grid}");
}

/// Smoothing makes up for most of what a single block lacks.
#[test]
fn smoothing_evens_out_a_single_block() {
    let pipe = vessel(shapes::pipe(3.0, 12.0, DVec3::Z, 96), LengthUnit::Millimetre);
    let spread = |smoothing_sweeps| {
        let options = Options { topology: Topology::Single, smoothing_sweeps, ..Options::default() };
        let made = lay(&pipe, 0.4e-3, &options);
        hold(&pipe, &made, 0.005);
        made.body.quality.volume_cv
    };
    let (plain, smooth) = (spread(0), spread(200));
    assert!(smooth < 0.6 * plain, "{smooth} after {plain}");
}

/// Nodes carry the volume of the cells, none is doubled where blocks meet, and some are on the wall.
#[test]
fn particles_at_nodes_are_merged() {
    let pipe = vessel(shapes::pipe(3.0, 12.0, DVec3::Z, 96), LengthUnit::Millimetre);
    let spacing = 0.5e-3;
    let cells = o_grid(&pipe, spacing);
    let nodes = lay(&pipe, spacing, &Options { place: Place::Nodes, ..Options::default() });
    hold(&pipe, &nodes, 0.005);
    let sum = |made: &Multiblock| made.body.volume.iter().sum::<f64>();
    assert!((sum(&nodes) / sum(&cells) - 1.0).abs() < 1e-12);
    assert!(nodes.body.position.len() > cells.body.position.len());
    assert!(nodes.body.quality.nearest_neighbor_min > 0.3, "{:?}", nodes.body.quality);
    let on_wall = nodes.body.position.iter().filter(|x| (x.truncate().length() - 3e-3).abs() < 1e-5).count();
    assert!(on_wall > 500, "{on_wall}");
}

#[test]
fn bends_throats_and_forks_are_filled_whole() {
    let bend = vessel(shapes::bent_pipe(3.0, 12.0, 3.0, 96), LengthUnit::Millimetre);
    let made = o_grid(&bend, 0.4e-3);
    hold(&bend, &made, 0.005);
    assert!(made.report.lattice_particles == 0 && made.body.quality.volume_cv < 0.2);
    for (file, junctions) in [
        ("straight_tube", 0),
        ("straight_tube_open", 0),
        ("curved_tube_180", 0),
        ("stenosis_75", 0),
        ("carotid", 1),
        ("carotid_open", 1),
        ("t_junction", 1),
    ] {
        let Some(surface) = data(&format!("synthetic/{file}.stl")) else { return };
        let vessel = vessel(surface, LengthUnit::Millimetre);
        let made = o_grid(&vessel, 0.4e-3);
        println!("{file}");
        hold(&vessel, &made, 0.005);
        assert_eq!(made.report.blocked_junctions, junctions, "{:?}", made.report);
        assert_eq!(made.report.lattice_particles, 0, "{:?}", made.report);
        let q = &made.body.quality;
        assert!(q.volume_cv < 0.2 && q.nearest_neighbor_min > 0.5, "{q:?}");
    }
}

#[test]
fn the_real_carotid_is_filled_whole() {
    let Some(surface) = data("carotid_bifurcation/carotid_lumen.stl") else { return };
    let vessel = vessel(surface, LengthUnit::Millimetre);
    for spacing in [0.6e-3, 0.4e-3] {
        let made = o_grid(&vessel, spacing);
        hold(&vessel, &made, 0.01);
        assert_eq!((made.report.blocked_junctions, made.report.lattice_particles), (1, 0));
        let q = &made.body.quality;
        assert!(q.volume_cv <= 0.20 && q.nearest_neighbor_min >= 0.5, "{q:?}");
    }
}

/// Four branches leave the arch within two of its diameters: what cannot be blocked is left to the lattice, which
/// makes up the volume exactly, and is said.
#[test]
fn the_real_aorta_is_filled_with_the_lattice_between_blocks() {
    let Some(surface) = data("aorta_arch_vmr0024/aorta_lumen.stl") else { return };
    let vessel = vessel(surface, LengthUnit::Centimetre);
    let made = o_grid(&vessel, 1.2e-3);
    hold(&vessel, &made, 0.01);
    let report = &made.report;
    assert_eq!(report.blocked_junctions + report.unblocked_junctions.len(), 4);
    assert!(report.lattice_share < 0.5, "{report:?}");
    let q = &made.body.quality;
    assert!(q.volume_cv <= 0.20 && q.nearest_neighbor_min >= 0.5, "{q:?}");
}

/// A vessel too short and wide for a block is all lattice.
#[test]
fn what_cannot_be_blocked_at_all_is_filled_by_the_lattice() {
    let surface = shapes::pipe(3.0, 6.0, DVec3::Z, 48);
    let mut vessel = vessel(surface, LengthUnit::Millimetre);
    vessel.openings.truncate(1);
    let made = o_grid(&vessel, 0.6e-3);
    assert_eq!((made.report.cells, made.report.lattice_share), (0, 1.0));
    assert_eq!(made.body.quality.outside, 0);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let bend = vessel(shapes::bent_pipe(3.0, 9.0, 1.2, 48), LengthUnit::Millimetre);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| o_grid(&bend, 0.5e-3))
    };
    assert_eq!(with(1), with(3));
}

/// The same vessel turned, moved and in other units, read back from a file.
#[test]
fn a_vessel_gets_the_same_cells_wherever_it_is() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let made = |surface: &Surface, unit| {
        let file = folder.path().join("vessel.stl");
        write_stl(&file, surface).expect("the folder is there");
        let read = read_surface(&file).expect("what was written can be read");
        o_grid(&vessel(read, unit), 0.5e-3)
    };
    let turn = DQuat::from_axis_angle(DVec3::new(0.3, -0.5, 0.8).normalize(), 2.0);
    let metre = DVec3::new(600.0, -500.0, 624.5);
    let surfaces = [Some(shapes::bent_pipe(3.0, 9.0, 1.2, 48)), data("synthetic/carotid.stl")];
    for surface in surfaces.into_iter().flatten() {
        let first = made(&surface, LengthUnit::Millimetre);
        for (copy, unit) in [
            (surface.map(|v| turn * v + metre), LengthUnit::Millimetre),
            (surface.map(|v| turn.inverse() * v * 1e-3), LengthUnit::Metre),
            (surface.map(|v| v * 0.1), LengthUnit::Centimetre),
        ] {
            let second = made(&copy, unit);
            let (a, b): (&Quality, &Quality) = (&first.body.quality, &second.body.quality);
            assert_eq!((a.count, a.outside), (b.count, b.outside), "{a:?} {b:?}");
            assert!((a.volume_cv - b.volume_cv).abs() < 1e-3, "{a:?} {b:?}");
            assert!((a.nearest_neighbor_min - b.nearest_neighbor_min).abs() < 0.01, "{a:?} {b:?}");
            assert!((a.volume_error - b.volume_error).abs() < 1e-4, "{a:?} {b:?}");
        }
    }
}

//! Shells of real vessels, for those who have the data.

use std::path::PathBuf;
use vaso_generation::{ShellReference, ShellSettings, shell};
use vaso_geometry::{LengthUnit, SignedDistance, prepare, read_surface};

/// Generates a shell at `spacing` \[m\] and holds it to the figures of a good set.
fn hold(file: &str, unit: LengthUnit, spacing: f64) {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        eprintln!("skipped: VASO_DATA is not set");
        return;
    };
    let surface = read_surface(&PathBuf::from(data).join("geometry").join(file)).expect("the file is there");
    let vessel = prepare(surface, Some(unit)).expect("a published vessel is usable");
    let settings =
        ShellSettings { reference: ShellReference::Lumen, ..ShellSettings::new(spacing, 2.0 * spacing) };
    let body = shell(&vessel, &settings, &mut |_, _| {}).expect("the spacing suits the vessel");
    let area = vessel.wall_area();
    assert_eq!(body.position.len(), (area / (spacing * spacing)).ceil() as usize);
    assert!((body.area.iter().sum::<f64>() / area - 1.0).abs() < 1e-12);
    let wall = SignedDistance::wall(&vessel);
    let diagonal = vessel.surface.diagonal();
    assert!(body.position.iter().all(|x| wall.query(*x).distance.abs() < 1e-6 * diagonal));
    let q = &body.quality;
    assert!(q.nearest_neighbor_min > 0.65 && q.nearest_neighbor_cv < 0.06, "{q:?}");
    assert!(q.kernel_sum_std.expect("the vessel is long") < 0.01, "{q:?}");
}

#[test]
fn carotid() {
    hold("carotid_bifurcation/carotid_lumen.stl", LengthUnit::Millimetre, 0.4e-3);
}

#[test]
fn aorta() {
    hold("aorta_arch_vmr0024/aorta_lumen.stl", LengthUnit::Centimetre, 1.2e-3);
}

/// Two tubes that meet at right angles, with a sharp crease.
#[test]
fn t_junction() {
    hold("synthetic/t_junction.stl", LengthUnit::Millimetre, 0.4e-3);
}

/// Slender triangles in rings, all alike.
#[test]
fn stenosed_tube() {
    hold("stenosed_tube_sphinxsys/stenosed_tube.stl", LengthUnit::Millimetre, 0.5e-3);
}

//! Particles in real vessels, for those who have the data.

use std::path::PathBuf;
use vaso_generation::{Body, Settings, fluid, rigid_wall};
use vaso_geometry::{LengthUnit, SignedDistance, Vessel, prepare, read_surface};

fn vessel(file: &str, unit: LengthUnit) -> Option<Vessel> {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        eprintln!("skipped: VASO_DATA is not set");
        return None;
    };
    let surface = read_surface(&PathBuf::from(data).join("geometry").join(file)).expect("the file is there");
    Some(prepare(surface, Some(unit)).expect("a published vessel is usable"))
}

/// Generates fluid and wall at `spacing` \[m\] and holds them to the figures of a good set.
fn hold(vessel: &Vessel, spacing: f64) -> (Body, Body) {
    let settings = Settings::new(spacing);
    let blood = fluid(vessel, &settings, &mut |_, _| {}).expect("the spacing suits the vessel");
    let wall = rigid_wall(vessel, &settings, &mut |_, _| {}).expect("the spacing suits the vessel");

    let q = &blood.quality;
    assert_eq!(q.outside, 0, "{q:?}");
    assert!(q.volume_error.abs() < 0.01, "{q:?}");
    assert!(q.nearest_neighbor_min > 0.65, "{q:?}");
    assert!(q.nearest_neighbor_cv < 0.06, "{q:?}");
    assert!(q.kernel_sum_std.expect("the vessel is wide") < 0.01, "{q:?}");
    assert!((q.kernel_sum_mean.expect("the vessel is wide") - 1.0).abs() < 0.015, "{q:?}");

    let q = &wall.quality;
    assert!(q.nearest_neighbor_min > 0.65, "{q:?}");
    assert!(q.nearest_neighbor_cv < 0.06, "{q:?}");
    let closed = SignedDistance::closed(vessel);
    assert!(wall.position.iter().all(|x| closed.query(*x).distance > 0.0), "wall stands in a lumen");
    for opening in &vessel.openings {
        let in_front =
            |x: &&_| opening.lateral(**x) < 0.0 && (-2.6 * spacing..0.0).contains(&opening.depth(**x));
        assert_eq!(wall.position.iter().filter(in_front).count(), 0, "the wall closes an opening");
    }
    (blood, wall)
}

#[test]
fn carotid_bifurcation() {
    let Some(vessel) = vessel("carotid_bifurcation/carotid_lumen.stl", LengthUnit::Millimetre) else {
        return;
    };
    for spacing in [0.6e-3, 0.4e-3] {
        let (blood, _) = hold(&vessel, spacing);
        let filled = blood.volume.iter().sum::<f64>();
        assert!((filled / 1866.83e-9 - 1.0).abs() < 1e-5, "published volume 1866.83 mm^3, filled {filled}");
    }
}

/// Six openings, two of them so near that the wall of one limb passes beside the end of another.
#[test]
fn aorta() {
    let Some(vessel) = vessel("aorta_arch_vmr0024/aorta_lumen.stl", LengthUnit::Centimetre) else { return };
    hold(&vessel, 1.2e-3);
}

/// A straight tube with a throat, in line with the coordinate axes.
#[test]
fn stenosed_tube() {
    let Some(vessel) = vessel("stenosed_tube_sphinxsys/stenosed_tube.stl", LengthUnit::Millimetre) else {
        return;
    };
    hold(&vessel, 0.5e-3);
}

//! Outer surfaces of vessels from files, for those who have the data.

use std::path::PathBuf;

use vaso_geometry::{LengthUnit, SignedDistance, Vessel, extrude, prepare, read_surface, write_stl};

fn vessel(file: &str) -> Option<Vessel> {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        eprintln!("skipped: VASO_DATA is not set");
        return None;
    };
    let surface = read_surface(&PathBuf::from(data).join("geometry").join(file)).expect("the file is there");
    Some(prepare(surface, Some(LengthUnit::Millimetre)).expect("a published vessel is usable"))
}

/// By Pappus the volume of a bent tube grows as that of a straight one, with the square of its radius.
#[test]
fn a_bent_tube_grows_as_a_straight_one() {
    let Some(vessel) = vessel("synthetic/curved_tube_180.stl") else { return };
    for distance in [0.25e-3, 1e-3, 2e-3] {
        let outer = extrude(&vessel, distance).expect("a positive distance");
        assert!(outer.is_sound() && outer.limited == 0, "{:?}", outer.places);
        let growth = outer.surface.volume() / vessel.surface.volume();
        let expected = (1.0 + distance / vessel.openings[0].radius).powi(2);
        assert!((growth / expected - 1.0).abs() < 2e-3, "{growth} instead of {expected}");
    }
}

#[test]
fn the_outer_surface_of_a_carotid_is_a_vessel_again() {
    let Some(vessel) = vessel("synthetic/carotid_dirty.stl") else { return };
    let outer = extrude(&vessel, 0.2e-3).expect("a positive distance");
    assert!(outer.intersections.is_empty(), "{:?}", outer.places);
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("outer.stl");
    write_stl(&path, &outer.surface).expect("the folder can be written to");
    let again = prepare(read_surface(&path).expect("just written"), Some(LengthUnit::Metre)).expect("closed");
    assert!(again.audit.watertight);
    assert_eq!(again.openings.len(), vessel.openings.len());
    assert!((again.surface.volume() / outer.surface.volume() - 1.0).abs() < 1e-4);
}

/// In the fork the walls of both branches are one before they part.
#[test]
fn a_thick_wall_cuts_itself_in_the_fork() {
    let Some(vessel) = vessel("carotid_bifurcation/carotid_lumen.stl") else { return };
    let distance = 1.6e-3;
    let outer = extrude(&vessel, distance).expect("a positive distance");
    let closed = SignedDistance::closed(&vessel);
    let is_fork = |x| {
        let nearest = closed.query(x);
        vessel.openings.iter().all(|o| o.distance(x) > 3.0 * distance)
            && nearest.distance > 0.0
            && closed.facing(x, nearest.normal, 2.0 * distance).is_some()
    };
    let fork = outer.places.iter().find(|place| is_fork(place.center)).expect("the branches part somewhere");
    assert!(fork.pairs > 50, "{fork:?}");
}

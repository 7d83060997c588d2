//! Walls with open ends around real vessels, for those who have the data.

use std::path::PathBuf;
use vaso_generation::{Ends, Settings, wall};
use vaso_geometry::{LengthUnit, SignedDistance, prepare, read_surface};

/// Three openings, one of them cut at a slant, and a fork whose walls are one before the branches part.
#[test]
fn carotid() {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        eprintln!("skipped: VASO_DATA is not set");
        return;
    };
    let path = PathBuf::from(data).join("geometry/carotid_bifurcation/carotid_lumen.stl");
    let surface = read_surface(&path).expect("the file is there");
    let vessel = prepare(surface, Some(LengthUnit::Millimetre)).expect("a published vessel is usable");
    let (dp, thickness) = (0.6e-3, 1.8e-3);
    let made = wall(&vessel, &Settings::new(dp), thickness, Ends::ClosestCap, &mut |_, _| {})
        .expect("the spacing suits the vessel");
    let q = &made.body.quality;
    assert!(q.nearest_neighbor_min > 0.65 && q.nearest_neighbor_cv < 0.06, "{q:?}");
    let closed = SignedDistance::closed(&vessel);
    for (x, clamped) in made.body.position.iter().zip(&made.clamped) {
        let phi = closed.query(*x).distance;
        assert!(phi > 0.0 && phi < thickness, "{x} at {phi}");
        let reach = vessel.openings.iter().map(|o| o.distance(*x)).fold(f64::INFINITY, f64::min);
        assert!(
            !clamped || reach < (4.0 * dp).hypot(thickness + 2.0 * dp),
            "{x} is held far from any opening"
        );
        for opening in &vessel.openings {
            let beyond = -opening.depth(*x);
            let lateral = opening.lateral(*x);
            assert!(!(beyond > 0.0 && lateral < thickness), "{x} stands beyond an opening by {beyond}");
        }
    }
    assert!(made.shared > 0.0 && made.shared < 0.02, "{}", made.shared);
}

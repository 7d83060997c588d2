//! Centrelines of real vessels.

use vaso_geometry::{BranchEnd, Centerlines, LengthUnit, SignedDistance, Vessel, prepare, read_surface};

fn vessel(file: &str, unit: LengthUnit) -> Option<Vessel> {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        println!("skipped: VASO_DATA is not set");
        return None;
    };
    let path = std::path::Path::new(&data).join("geometry").join(file);
    Some(prepare(read_surface(&path).expect("the file is there"), Some(unit)).expect("it is a vessel"))
}

/// Every opening ends one branch, branches and junctions form a tree, and the lines run inside, half a radius
/// from the wall at least.
fn hold(vessel: &Vessel) -> Centerlines {
    let lines = Centerlines::trace(vessel).expect("there are openings");
    let n = vessel.openings.len();
    assert_eq!(lines.branches.len(), 2 * n - 3);
    assert_eq!(lines.junctions.len(), n - 2);
    let mut ends: Vec<usize> = lines
        .branches
        .iter()
        .flat_map(|b| [b.start, b.end])
        .filter_map(|end| if let BranchEnd::Opening(k) = end { Some(k) } else { None })
        .collect();
    ends.sort_unstable();
    assert_eq!(ends, (0..n).collect::<Vec<_>>());
    let (closed, wall) = (SignedDistance::closed(vessel), SignedDistance::wall(vessel));
    for (k, junction) in lines.junctions.iter().enumerate() {
        assert_eq!(lines.branches[junction.parent].end, BranchEnd::Junction(k));
        for d in junction.daughters {
            assert_eq!(lines.branches[d].start, BranchEnd::Junction(k));
        }
        assert!(closed.query(junction.carina).distance.abs() < 1e-9);
        println!("junction {k}: {junction:?}");
    }
    for branch in &lines.branches {
        let points = branch.curve.points();
        let clearance = |p: &glam::DVec3| -wall.query(*p).distance;
        let smallest = points.iter().map(clearance).fold(1.0, f64::min);
        let length = 1e3 * branch.curve.length();
        println!(
            "{:?} {:?} {length:.2} mm long, {:.2} mm from the wall",
            branch.start,
            branch.end,
            1e3 * smallest
        );
    }
    lines
}

#[test]
fn carotid_bifurcation() {
    if let Some(vessel) = vessel("carotid_bifurcation/carotid_lumen.stl", LengthUnit::Millimetre) {
        hold(&vessel);
    }
}

#[test]
fn aortic_arch() {
    if let Some(vessel) = vessel("aorta_arch_vmr0024/aorta_lumen.stl", LengthUnit::Centimetre) {
        hold(&vessel);
    }
}

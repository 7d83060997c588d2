//! A mesh that goes with the particles of a wall, and the stress along it.

use crate::support::{RADIUS, pipe_vessel, relaxed_pipe};
use glam::{DMat3, DQuat, DVec3};
use std::f64::consts::TAU;
use vaso_geometry::SignedDistance;
use vaso_metrics::{CarriedWall, NearWallDistance, Viscosity, WallMesh, WallMotion, WallPose, WallShear};
use vaso_particles::{WallDistance, WallView};

const ACROSS: f64 = 20.0;

/// Three layers of particles behind the wall of the pipe, in rings, each with its depth.
fn layers(spacing: f64, length: f64) -> (Vec<DVec3>, Vec<f64>) {
    let rows = (length / spacing).round() as u32;
    let around = (TAU * RADIUS / spacing).round() as u32;
    let mut all = (Vec::new(), Vec::new());
    for layer in 0..3 {
        let depth = (f64::from(layer) + 0.5) * spacing;
        for row in 0..rows {
            for k in 0..around {
                // Turned from row to row, so that no particle is straight behind a point of the mesh.
                let angle = TAU * (f64::from(k) + 0.37 * f64::from(row)) / f64::from(around);
                let z = (f64::from(row) + 0.5) * spacing;
                all.0.push(DVec3::new(angle.cos(), angle.sin(), 0.0) * (RADIUS + depth) + z * DVec3::Z);
                all.1.push(depth);
            }
        }
    }
    all
}

/// The mesh of the pipe where each particle at `x` has gone to `place(x)` and moves with `velocity(x)`.
fn posed(
    place: impl Fn(DVec3) -> DVec3,
    velocity: impl Fn(DVec3) -> DVec3,
) -> (WallMesh, CarriedWall, WallPose) {
    let spacing = 2.0 * RADIUS / ACROSS;
    let vessel = pipe_vessel(spacing);
    let mesh = WallMesh::new(&vessel, spacing);
    let (position, depth) = layers(spacing, 14.0 * spacing);
    let volume = vec![spacing.powi(3); position.len()];
    let zero = vec![DVec3::ZERO; position.len()];
    let view = WallView { position: &position, velocity: &zero, depth: &depth, volume: &volume };
    let carried = CarriedWall::new(&mesh, &view, &SignedDistance::wall(&vessel), spacing);
    let there: Vec<DVec3> = position.iter().map(|x| place(*x)).collect();
    let moving: Vec<DVec3> = position.iter().map(|x| velocity(*x)).collect();
    let pose = carried.pose(&WallView { position: &there, velocity: &moving, ..view });
    (mesh, carried, pose)
}

#[test]
fn a_wall_that_turns_as_a_whole_is_met_exactly() {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -0.5).normalize(), 0.9);
    let shift = DVec3::new(0.3, -0.2, 0.1) * RADIUS;
    let spin = DVec3::new(0.4, 1.0, -2.0);
    let place = |x: DVec3| turn * x + shift;
    let (mesh, _, pose) = posed(place, |x| spin.cross(place(x)));
    let rotation = DMat3::from_quat(turn);
    for k in 0..mesh.position.len() {
        let exact = place(mesh.position[k]);
        assert!((pose.position[k] - exact).length() < 1e-10 * RADIUS, "point {k}");
        assert!((pose.normal[k] - turn * mesh.normal[k]).length() < 1e-9);
        assert!(pose.rotation[k].abs_diff_eq(rotation, 1e-9));
        assert!((pose.velocity[k] - spin.cross(exact)).length() < 1e-9 * RADIUS);
        // Along the wall the derivative is that of the turning.
        for along in [
            pose.normal[k].any_orthonormal_vector(),
            pose.normal[k].cross(pose.normal[k].any_orthonormal_vector()),
        ] {
            assert!((pose.gradient[k] * along - spin.cross(along)).length() < 1e-6);
        }
    }
}

/// A tube that widens by a tenth while it does so at a tenth of its radius a second. Means over neighbours on a curved wall fall short of
/// its widening by `spacing^2 / 2 R^2`.
#[test]
fn a_widened_tube_is_as_wide_as_its_particles_say() {
    let radial = |x: DVec3| x.with_z(0.0).normalize() * RADIUS;
    let (mesh, carried, pose) = posed(|x| x + 0.1 * radial(x), |x| 0.1 * radial(x));
    let distance = carried.distance(&pose);
    for k in 0..mesh.position.len() {
        let (x, rest) = (pose.position[k], mesh.position[k]);
        // The mesh is one of flat facets: it lies within the cylinder by as much as at rest.
        let widened = x.with_z(0.0).length() - rest.with_z(0.0).length();
        assert!((widened / (0.1 * RADIUS) - 1.0).abs() < 0.01, "{widened} at point {k}");
        assert!((x.z - rest.z).abs() < 1e-3 * RADIUS);
        assert!((pose.velocity[k] - 0.1 * radial(x)).length() < 0.01 * 0.1 * RADIUS);
        assert!(distance.query(x - 0.05 * RADIUS * pose.normal[k]).distance < 0.0);
        // The circumference grows by a tenth of its radius over the present one, the length not at all.
        let around = DVec3::Z.cross(pose.normal[k]).normalize();
        let rates = [around, DVec3::Z].map(|along| (pose.gradient[k] * along).dot(along));
        assert!((rates[0] - 0.1 / 1.1).abs() < 0.01 && rates[1].abs() < 0.005, "{rates:?} at {rest}");
    }
}

/// Poiseuille flow in the widened, turned tube that goes on widening: the stress is that of the parabola, whatever the wall does.
#[test]
fn a_parabola_in_a_widening_tube_has_its_stress() {
    const MU: f64 = 3.5e-3;
    let spacing = 2.0 * RADIUS / ACROSS;
    let turn = DQuat::from_rotation_y(0.4);
    let radial = |x: DVec3| x.with_z(0.0) * (RADIUS / x.with_z(0.0).length());
    let (mesh, carried, pose) = posed(|x| turn * (x + 0.1 * radial(x)), |x| turn * (0.1 * radial(x)));
    // The blood widens with the tube: at its wall it has the velocity of the wall.
    let particles: Vec<DVec3> =
        relaxed_pipe(spacing).iter().map(|x| turn * DVec3::new(1.1 * x.x, 1.1 * x.y, x.z)).collect();
    let velocity: Vec<DVec3> = particles
        .iter()
        .map(|x| {
            let own = turn.inverse() * *x;
            let r = own.with_z(0.0);
            turn * ((1.0 - r.length_squared() / (1.1 * RADIUS).powi(2)) * DVec3::Z + 0.1 / 1.1 * r)
        })
        .collect();
    let exact = carried.distance(&pose);
    struct Everywhere<'a>(&'a SignedDistance);
    impl WallDistance for Everywhere<'_> {
        fn sample(&self, x: DVec3) -> (f64, DVec3) {
            let nearest = self.0.query(x);
            (nearest.distance, nearest.normal)
        }
    }
    let coarse = Everywhere(&exact);
    let distance = NearWallDistance { coarse: &coarse, exact: &exact, reach: 4.0 * spacing };
    let shear = WallShear::new(pose.position.clone(), pose.normal.clone(), spacing).expect("valid");
    let motion = WallMotion { velocity: &pose.velocity, gradient: &pose.gradient };
    let sample = shear
        .evaluate_moving(&particles, &velocity, &distance, Viscosity::Constant(MU), motion)
        .expect("equal lengths");
    let theory = 2.0 * MU / (1.1 * RADIUS);
    let (mut sum, mut worst, mut n) = (DVec3::ZERO, 0.0_f64, 0);
    for (k, stress) in sample.stress.iter().enumerate() {
        if mesh.rim_distance[k] < 4.0 * spacing {
            continue;
        }
        let Some(stress) = stress else { panic!("point {k} has no value") };
        // Told in the directions the wall had at rest.
        let own = pose.rotation[k].transpose() * *stress;
        (sum, n) = (sum + own, n + 1);
        worst = worst.max((own - theory * DVec3::Z).length() / theory);
    }
    let mean = sum / f64::from(n);
    println!("mean {:.4}, worst {worst:.4} of the stress", mean.z / theory);
    assert!((mean.z / theory - 1.0).abs() < 0.02, "{mean} of {theory}");
    assert!(worst < 0.03, "{worst}");
}

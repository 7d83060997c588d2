//! What holds a body and what acts on it.

use crate::support;

use glam::DVec3;
use support::{Body, lattice};
use vaso_particles::WallLoad;
use vaso_solid::{
    Face, HolzapfelGasserOgden, Isa, Material, NeoHookean, Numbers, Particles, Solid, SolidError,
};

const SPACING: f64 = 1e-3;
const YOUNG: f64 = 4e5;

fn material(poisson: f64) -> Material {
    Material::NeoHookean(NeoHookean::new(YOUNG, poisson).expect("in range"))
}

/// A bar along x of 16 by 4 by 4 cells; x from 0 on.
fn bar() -> Body {
    lattice(DVec3::ZERO, [16, 4, 4], SPACING)
}

fn solid(body: &Body, material: Material) -> Solid<f64> {
    Solid::new(&body.particles(), material, Numbers::new(1000.0, SPACING), Isa::detect())
        .expect("a sound body")
}

/// Outer face of the bar at its end in x, loaded by a pressure.
fn end_face(body: &Body) -> Face {
    let end = body.select(|x| x.x > 15.0 * SPACING);
    let volumes: Vec<f64> = end.iter().map(|&i| body.volume[i as usize]).collect();
    Face::by_volume(end.clone(), &vec![DVec3::X; end.len()], &volumes).expect("one normal each")
}

#[test]
fn clamps_bear_the_weight() {
    let body = bar();
    let mut solid = solid(&body, material(0.4));
    solid.clamp(&body.select(|x| x.x < 2.5 * SPACING)).expect("particles exist");
    let gravity = DVec3::new(0.0, 0.0, -20.0);
    solid.set_gravity(gravity);
    let (steps, residual) = solid.settle(1e-3, 50_000).expect("a gentle load");
    assert!(residual < 1e-3, "{residual:e} after {steps} steps");
    let mass: f64 = solid.state.mass.iter().sum();
    let error = (solid.reaction() + mass * gravity).length() / (mass * gravity.length());
    assert!(error < 1e-3, "{error:e}");
    for &i in &body.select(|x| x.x < 2.5 * SPACING) {
        assert_eq!(solid.state.displacement[solid.place(i as usize)], DVec3::ZERO);
    }
}

/// Between two sliding ends a bar under an even stress stays straight and does not bend: uniaxial tension by Hooke's law.
#[test]
fn a_bar_on_a_sliding_end_follows_hooke() {
    let body = bar();
    let mut solid = solid(&body, material(0.3));
    solid.slide(&body.select(|x| x.x < SPACING), DVec3::X).expect("particles exist");
    let tension = 400.0;
    solid.add_pressure(&end_face(&body), -tension).expect("particles exist");
    let (_, residual) = solid.settle(1e-5, 50_000).expect("a gentle load");
    assert!(residual < 1e-5, "{residual:e}");
    // In the middle, away from both ends.
    for i in 0..solid.state.len() {
        let x = solid.state.reference_position[i];
        if (x.x - 8.0 * SPACING).abs() < SPACING {
            let f = solid.deformation_gradient(i);
            let (along, across) = (f.x_axis.x - 1.0, f.y_axis.y - 1.0);
            // A strain of a thousandth; the error is that of the gradients at the surface of a bar of four cells.
            assert!((along * YOUNG / tension - 1.0).abs() < 0.05, "{along:e}");
            assert!((-across / along - 0.3).abs() < 0.03, "{}", across / along);
            assert!((solid.von_mises(i) / tension - 1.0).abs() < 0.05);
            let [first, _, third] = solid.principal_stretches(i);
            assert!(first > 1.0 && third < 1.0 && (first - f.x_axis.x).abs() < 1e-6);
            assert!(solid.cauchy_stress(i).y_axis.y.abs() < 0.05 * tension);
        }
        // Free to shrink across, held along.
        if x.x < SPACING {
            assert_eq!(solid.state.displacement[i].x, 0.0);
        }
    }
    let pulled = solid.reaction();
    let area = 16.0 * SPACING * SPACING;
    assert!((pulled + tension * area * DVec3::X).length() < 0.01 * tension * area, "{pulled}");
}

/// A stiff block on tissue is a mass on a spring.
#[test]
fn tissue_is_a_spring_and_a_dashpot() {
    let body = lattice(DVec3::ZERO, [4, 4, 4], SPACING);
    let bottom = body.select(|x| x.z < SPACING);
    let volumes = vec![SPACING.powi(3); bottom.len()];
    let face = Face::by_volume(bottom.clone(), &vec![-DVec3::Z; bottom.len()], &volumes).expect("one each");
    let mass = 1000.0 * 64.0 * SPACING.powi(3);
    let area = 16.0 * SPACING * SPACING;
    let (stiffness, ratio) = (1e4, 0.1);
    let omega = (stiffness * area / mass).sqrt();
    let damping = 2.0 * ratio * mass * omega / area;
    let mut solid = solid(&body, material(0.3));
    solid.add_tissue(&face, stiffness, damping).expect("particles exist");
    let speed = 1e-3;
    solid.state.velocity.fill(speed * DVec3::Z);
    let damped = omega * f64::sqrt(1.0 - ratio * ratio);
    let quarter = 0.5 * std::f64::consts::PI / damped;
    for k in 1..=8 {
        solid.advance(0.5 * quarter).expect("a gentle motion");
        let t = 0.5 * quarter * f64::from(k);
        let expected = speed / damped * (-ratio * omega * t).exp() * (damped * t).sin();
        let mean = solid.state.displacement.iter().map(|u| u.z).sum::<f64>() / 64.0;
        // The block is not rigid: its own compliance, height over Young's modulus, is a hundredth of that of the tissue.
        assert!((mean - expected).abs() < 0.02 * speed / damped, "{k}: {mean:e} {expected:e}");
    }
    let energies = solid.energies();
    let spring: f64 = bottom
        .iter()
        .map(|&i| solid.state.displacement[solid.place(i as usize)].length_squared())
        .map(|u2| 0.5 * stiffness * SPACING * SPACING * u2)
        .sum();
    let start = 0.5 * mass * speed * speed;
    assert!((energies.load_work + spring).abs() < 1e-3 * start, "what the springs hold has been taken");
    assert!((energies.balance() / start - 1.0).abs() < 0.01, "{}", energies.balance() / start);
}

/// A pressure follows the face it acts on, in direction and in area.
#[test]
fn pressure_follows_the_surface() {
    let body = bar();
    let mut solid = solid(&body, material(0.45));
    let number = solid.add_pressure(&end_face(&body), 1e3).expect("particles exist");
    let (turn, stretch) = (glam::DMat3::from_rotation_z(0.7), DVec3::new(1.0, 1.1, 1.2));
    for i in 0..solid.state.len() {
        let x = solid.state.reference_position[i];
        solid.state.displacement[i] = turn * (stretch * x) - x;
    }
    solid.refresh().expect("turned");
    let force = |solid: &mut Solid<f64>| {
        solid.state.velocity.fill(DVec3::ZERO);
        let dt = 1e-9;
        solid.advance_in(dt, 1).expect("next to nothing");
        (0..solid.state.len()).map(|i| solid.state.mass[i] * solid.state.velocity[i]).sum::<DVec3>() / dt
    };
    // Stress is in balance within itself, so that the sum over the body is the load.
    let expected = -1e3 * 16.0 * SPACING * SPACING * 1.1 * 1.2 * (turn * DVec3::X);
    assert!((force(&mut solid) - expected).length() < 1e-6 * expected.length());
    solid.set_pressure(number, 0.0);
    assert!(force(&mut solid).length() < 1e-6 * expected.length());
}

/// A fluid that answers the velocity of the last step by its impedance makes a light wall swing up; taken half implicitly it
/// cannot, however light the wall: `v -> v (1 - a/2) / (1 + a/2)`.
#[test]
fn impedance_keeps_a_light_wall_stable() {
    let body = lattice(DVec3::ZERO, [4, 4, 4], SPACING);
    let all: Vec<u32> = (0..64).collect();
    let face = Face::by_volume(all, &[DVec3::Z; 64], &body.volume).expect("one each");
    let depth = vec![SPACING; 64];
    let particles = Particles { depth: &depth, ..body.particles() };
    let (impedance, a) = (1e4, 4.0);
    let mass = 1000.0 * SPACING.powi(3);
    let dt = a * mass / (impedance * SPACING * SPACING);
    let run = |share: Option<f64>| {
        let mut solid =
            Solid::<f64>::new(&particles, material(0.4), Numbers::new(1000.0, SPACING), Isa::detect())
                .expect("a sound body");
        if let Some(share) = share {
            solid.add_impedance(&face, impedance, share).expect("in range");
        }
        solid.state.velocity.fill(1e-3 * DVec3::Z);
        let none = [DVec3::ZERO; 64];
        for _ in 0..5 {
            let answer = solid.state.velocity.iter().map(|v| -impedance * SPACING * SPACING * *v);
            let pressure_force: Vec<DVec3> = answer.collect();
            solid
                .set_load(&WallLoad {
                    pressure_force: &pressure_force,
                    viscous_force: &none,
                    face_pressure: &[],
                })
                .expect("64");
            solid.advance_in(dt, 1).expect("a rigid motion");
        }
        solid.state.velocity[0].z / 1e-3
    };
    assert!((run(None) - (1.0 - a).powi(5)).abs() < 1e-6, "{}", run(None));
    let expected = ((1.0 - 0.5 * a) / (1.0 + 0.5 * a)).powi(5);
    assert!((run(Some(0.5)) - expected).abs() < 1e-9, "{}", run(Some(0.5)));
}

/// The same bits on any number of threads, and after going on from columns that were kept.
#[test]
fn threads_and_restarts_change_no_bit() {
    struct Collect(Vec<u64>);
    impl vaso_particles::Visitor for Collect {
        fn scalar(&mut self, column: &mut vaso_particles::ScalarColumn) {
            self.0.extend(column.iter().map(|x| x.to_bits()));
        }
        fn vector(&mut self, column: &mut vaso_particles::VectorColumn) {
            self.0.extend(column.iter().flat_map(|x| x.to_array()).map(f64::to_bits));
        }
        fn integer(&mut self, column: &mut vaso_particles::Column<u64>) {
            self.0.extend(column.iter());
        }
        fn label(&mut self, column: &mut vaso_particles::Column<i32>) {
            self.0.extend(column.iter().map(|x| *x as u64));
        }
    }
    let body = bar().jittered(0.1, SPACING);
    let fresh = || {
        let numbers = Numbers { viscosity: 0.1, ..Numbers::new(1000.0, SPACING) };
        let mut solid = Solid::<f32>::new(&body.particles(), material(0.4), numbers, Isa::detect())
            .expect("a sound body");
        solid.clamp(&body.select(|x| x.x < 2.5 * SPACING)).expect("particles exist");
        solid.set_gravity(DVec3::new(0.0, -9.81, 0.0));
        solid.add_pressure(&end_face(&body), 50.0).expect("particles exist");
        solid
    };
    let bits = |solid: &mut Solid<f32>| {
        let mut collect = Collect(Vec::new());
        vaso_particles::Columns::visit(solid, &mut collect);
        collect.0
    };
    let on_threads = |n: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("threads");
        pool.install(|| {
            let mut solid = fresh();
            for _ in 0..10 {
                solid.advance(2e-5).expect("a gentle load");
            }
            let kept = solid.state.clone();
            for _ in 0..10 {
                solid.advance(2e-5).expect("a gentle load");
            }
            (kept, bits(&mut solid))
        })
    };
    let (kept, one) = on_threads(1);
    assert!(one == on_threads(3).1, "one thread and three");
    let mut restarted = fresh();
    restarted.state = kept;
    restarted.resume().expect("sound columns");
    for _ in 0..10 {
        restarted.advance(2e-5).expect("a gentle load");
    }
    assert!(one == bits(&mut restarted), "unbroken and restarted");
}

/// The contract with a fluid: forces in, positions, velocities and acceleration of the step out.
#[test]
fn a_fluid_sees_what_its_forces_do() {
    let body = bar();
    let depth: Vec<f64> = body.position.iter().map(|x| x.z).collect();
    let particles = Particles { depth: &depth, ..body.particles() };
    let mut solid =
        Solid::<f64>::new(&particles, material(0.4), Numbers::new(1000.0, SPACING), Isa::detect())
            .expect("a sound body");
    let n = solid.state.len();
    let (pressure_force, viscous_force) = (vec![2e-6 * DVec3::Z; n], vec![1e-6 * DVec3::X; n]);
    let load =
        WallLoad { pressure_force: &pressure_force, viscous_force: &viscous_force, face_pressure: &[] };
    solid.set_load(&load).expect("one force a particle");
    let before = solid.wall_view().position.to_vec();
    let dt = 3.5 * solid.stable_step();
    let n_substeps = solid.advance(dt).expect("a gentle load");
    assert_eq!(n_substeps, 4);
    let (view, motion) = (solid.wall_view(), solid.wall_motion());
    assert_eq!(view.position.len(), n);
    let pushed = (2e-6 * DVec3::Z + 1e-6 * DVec3::X) / (1000.0 * SPACING.powi(3));
    for i in 0..n {
        // Every particle is pushed alike, so that the body moves as a whole.
        assert!((motion.acceleration[i] - pushed).length() < 1e-9 * pushed.length());
        assert!((view.velocity[i] - dt * pushed).length() < 1e-9 * dt * pushed.length());
        assert!((motion.mean_velocity[i] - 0.5 * dt * pushed).length() < 1e-6 * dt * pushed.length());
        let moved = view.position[i] - before[i] - dt * motion.mean_velocity[i];
        assert!(moved.length() < 1e-15);
        assert!((view.depth[i] - solid.state.reference_position[i].z).abs() < 1e-15);
    }
    let energies = solid.energies();
    assert!((energies.load_work / energies.kinetic - 1.0).abs() < 1e-9, "work becomes motion");
    let short =
        WallLoad { pressure_force: &pressure_force[1..], viscous_force: &viscous_force, face_pressure: &[] };
    assert!(matches!(solid.set_load(&short), Err(SolidError::Count { what: "pressure_force", .. })));
}

#[test]
fn one_layer_is_refused_and_bad_numbers_are_named() {
    let sheet = lattice(DVec3::ZERO, [6, 6, 1], SPACING);
    let made =
        Solid::<f32>::new(&sheet.particles(), material(0.4), Numbers::new(1000.0, SPACING), Isa::detect());
    let message = made.err().expect("a sheet is no solid").to_string();
    assert!(message.contains("one particle thick") && message.contains("shell"), "{message}");
    let refused = |change: &dyn Fn(&mut Numbers)| {
        let mut numbers = Numbers::new(1000.0, SPACING);
        change(&mut numbers);
        let made = Solid::<f32>::new(&bar().particles(), material(0.4), numbers, Isa::detect());
        made.err().expect("refused").to_string()
    };
    assert!(refused(&|n| n.damping = -1.0).contains("`damping` is -1"));
    assert!(refused(&|n| n.smoothing_length = 5.0 * SPACING).contains("`smoothing_length`"));
    assert!(refused(&|n| n.density = f64::NAN).contains("`density` is NaN"));
    let message = NeoHookean::new(1e5, 0.5).expect_err("incompressible").to_string();
    assert!(message.contains("`poisson` is 0.5"), "{message}");
    let mut solid = solid(&bar(), material(0.4));
    assert!(matches!(solid.clamp(&[256]), Err(SolidError::NoSuchParticle { particle: 256, len: 256, .. })));
    let short = Particles { volume: &[1.0], position: &[DVec3::ZERO, DVec3::X], ..Particles::default() };
    let made = Solid::<f32>::new(&short, material(0.4), Numbers::new(1000.0, SPACING), Isa::detect());
    assert!(matches!(made.err(), Some(SolidError::Count { what: "volume", given: 1, expected: 2 })));
}

#[test]
fn a_body_turned_inside_out_is_named() {
    let body = bar();
    let mut solid = solid(&body, material(0.4));
    for i in 0..solid.state.len() {
        let x = solid.state.reference_position[i];
        solid.state.displacement[i].x = -2.0 * x.x;
    }
    let error = solid.refresh().expect_err("a mirror image");
    assert!(matches!(error, SolidError::Inverted { determinant, .. } if (determinant + 1.0).abs() < 1e-9));
    assert!(error.to_string().contains("inside out"));
}

/// Fibres around a bar: it stretches less along them than across.
#[test]
fn fibres_hold_the_body_along_their_direction() {
    let body = bar();
    let mean = |angle: f64| {
        let fibred = HolzapfelGasserOgden::new(1.5e5, 5e5, 1.0, 0.0, angle, 1.5e6).expect("in range");
        let directions = vec![[DVec3::X, DVec3::Y]; body.position.len()];
        let particles = Particles { directions: &directions, ..body.particles() };
        let numbers = Numbers::new(1000.0, SPACING);
        let material = Material::HolzapfelGasserOgden(fibred);
        let mut solid =
            Solid::<f64>::new(&particles, material, numbers, Isa::detect()).expect("a sound body");
        solid.slide(&body.select(|x| x.x < SPACING), DVec3::X).expect("particles exist");
        solid.add_pressure(&end_face(&body), -4e3).expect("particles exist");
        solid.settle(1e-4, 50_000).expect("a gentle load");
        let middle = |i: &usize| (solid.state.reference_position[*i].x - 8.0 * SPACING).abs() < SPACING;
        let stretches: Vec<f64> =
            (0..solid.state.len()).filter(middle).map(|i| solid.deformation_gradient(i).x_axis.x).collect();
        stretches.iter().sum::<f64>() / stretches.len() as f64 - 1.0
    };
    let (along, across) = (mean(0.0), mean(std::f64::consts::FRAC_PI_2));
    // Along: fibres add 8 k1 to the modulus. Across: they are slack, and the bar is neo-Hookean.
    let bulk = 1.5e6;
    let young = 9.0 * bulk * 1.5e5 / (3.0 * bulk + 1.5e5);
    assert!((across * young / 4e3 - 1.0).abs() < 0.08, "{across:e}");
    assert!((along * (young + 8.0 * 5e5) / 4e3 - 1.0).abs() < 0.1, "{along:e}");
}

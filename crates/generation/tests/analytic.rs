//! Particles in pipes whose volume and wall are known by formula.

use glam::DVec3;
use std::f64::consts::PI;
use vaso_generation::{Body, GenerationError, Lattice, Settings, Warning, fluid, rigid_wall, warnings};
use vaso_geometry::{LengthUnit, SignedDistance, Vessel, prepare, shapes};

const RADIUS: f64 = 3.2e-3;
const LENGTH: f64 = 12e-3;
const SPACING: f64 = 0.4e-3;
const SEGMENTS: usize = 96;

/// A direction that is no axis of symmetry.
fn axis() -> DVec3 {
    DVec3::new(0.3, -0.8, 0.5).normalize()
}

fn pipe() -> Vessel {
    let surface = shapes::pipe(RADIUS * 1e3, LENGTH * 1e3, axis(), SEGMENTS);
    prepare(surface, Some(LengthUnit::Millimetre)).expect("a closed pipe is a vessel")
}

fn quiet(_: usize, _: f64) {}

/// Distance from the axis and along it \[m\].
fn cylindrical(x: DVec3) -> (f64, f64) {
    let z = x.dot(axis());
    ((x - z * axis()).length(), z)
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[test]
fn fluid_fills_the_pipe_evenly() {
    let vessel = pipe();
    let body = fluid(&vessel, &Settings::new(SPACING), &mut quiet).expect("the pipe is wide enough");
    let polygon = SEGMENTS as f64 / (2.0 * PI) * (2.0 * PI / SEGMENTS as f64).sin();
    let exact = PI * RADIUS * RADIUS * LENGTH * polygon;
    let filled = body.volume.iter().sum::<f64>();
    assert!((filled / exact - 1.0).abs() < 1e-9, "{filled} instead of {exact}");

    let q = &body.quality;
    assert_eq!(q.count, body.position.len());
    assert_eq!(q.outside, 0);
    assert!(q.volume_error.abs() < 1e-3, "{q:?}");
    assert!(q.nearest_neighbor_min > 0.65, "{q:?}");
    assert!(q.nearest_neighbor_cv < 0.06, "{q:?}");
    assert!((q.kernel_sum_mean.expect("the axis is deep inside") - 1.0).abs() < 0.015, "{q:?}");
    assert!(q.kernel_sum_std.expect("the axis is deep inside") < 0.005, "{q:?}");
    assert!(q.gradient_residual_rms < 0.015, "{q:?}");

    // The first layer stands half a spacing from wall and caps; the next is more than a spacing deep.
    let first_layer = |depth: fn(f64, f64) -> f64| -> Vec<f64> {
        let depths = body.position.iter().map(|&x| cylindrical(x)).map(|(r, z)| depth(r, z) / SPACING);
        depths.filter(|d| *d < 0.8).collect()
    };
    for gaps in [first_layer(|r, _| RADIUS - r), first_layer(|_, z| z), first_layer(|_, z| LENGTH - z)] {
        assert!(gaps.len() > 100);
        assert!((mean(&gaps) - 0.5).abs() < 0.05, "gap {}", mean(&gaps));
    }
}

#[test]
fn wall_surrounds_the_pipe_and_leaves_its_ends_open() {
    let settings = Settings::new(SPACING);
    let body = rigid_wall(&pipe(), &settings, &mut quiet).expect("the pipe is wide enough");
    let (thickness, collar) = (4.0 * SPACING, 2.0 * settings.smoothing * SPACING);
    let ring = PI * ((RADIUS + thickness).powi(2) - RADIUS.powi(2)) * (LENGTH + 2.0 * collar);
    let filled = body.volume.iter().sum::<f64>();
    assert!((filled / ring - 1.0).abs() < 2e-3, "{} of the ring", filled / ring);
    assert!((body.volume[0] / SPACING.powi(3) - 1.0).abs() < 1e-3);
    assert_eq!(body.quality.outside, 0);
    assert!(body.quality.nearest_neighbor_min > 0.65, "{:?}", body.quality);
    assert!(body.quality.nearest_neighbor_cv < 0.06, "{:?}", body.quality);
    assert!(body.quality.gradient_residual_rms < 0.015, "{:?}", body.quality);

    assert_eq!(body.normal.len(), body.position.len());
    assert_eq!(body.depth.len(), body.position.len());
    let sagitta = RADIUS * (1.0 - (PI / SEGMENTS as f64).cos());
    for ((&x, &normal), &depth) in body.position.iter().zip(&body.normal).zip(&body.depth) {
        let (r, z) = cylindrical(x);
        assert!(r > RADIUS - sagitta, "{x} stands in the lumen or in front of an opening");
        assert!(-collar < z && z < LENGTH + collar, "{x} stands beyond the collar");
        assert!((depth - (r - RADIUS)).abs() < 2.0 * sagitta, "depth {depth} at {x}");
        let radial = (x - z * axis()) / r;
        assert!(normal.dot(radial) > 0.999, "normal {normal} at {x}");
    }
}

/// What a fluid particle finds around it where the wall completes its kernel.
#[test]
fn fluid_and_wall_together_complete_the_kernel() {
    let (vessel, settings) = (pipe(), Settings::new(SPACING));
    let blood = fluid(&vessel, &settings, &mut quiet).expect("the pipe is wide enough");
    let wall = rigid_wall(&vessel, &settings, &mut quiet).expect("the pipe is wide enough");
    let kernel = vaso_kernels::Wendland::new(settings.smoothing * SPACING);
    let support = kernel.support();
    // Kernel sum, and h times the kernel gradient sum, over the particles of one body.
    let sums = |body: &Body, x: DVec3| {
        let near = body.position.iter().map(|y| x - *y).filter(|d| d.length() < support);
        near.fold((0.0, DVec3::ZERO), |(sum, gradient), d| {
            let push = kernel.derivative(d.length()) * d.normalize_or_zero();
            (sum + body.volume[0] * kernel.value(d.length()), gradient + body.volume[0] * kernel.h * push)
        })
    };
    let near_wall = blood.position.iter().filter(|x| {
        let (r, z) = cylindrical(**x);
        r > RADIUS - support && z > support && z < LENGTH - support
    });
    let (mut first_layer, mut all, mut residual) = (Vec::new(), Vec::new(), Vec::new());
    for &x in near_wall.step_by(3) {
        let (a, b) = (sums(&blood, x), sums(&wall, x));
        let sum = (a.0 + b.0) / kernel.lattice_sum(SPACING);
        all.push(sum);
        residual.push((a.1 + b.1).length_squared());
        if cylindrical(x).0 > RADIUS - 0.8 * SPACING {
            first_layer.push(sum);
        }
    }
    assert!(all.len() > 500 && first_layer.len() > 200);
    assert!((mean(&all) - 1.0).abs() < 0.005, "mean {}", mean(&all));
    assert!((mean(&first_layer) - 1.0).abs() < 0.01, "mean {}", mean(&first_layer));
    assert!(all.iter().all(|s| (s - 1.0).abs() < 0.03), "a sum is off by more than 3 %");
    let residual = mean(&residual).sqrt();
    assert!(residual < 0.015, "rms h|G| {residual}");
}

/// Two limbs three spacings apart, whose walls must merge and whose caps lie in one plane.
#[test]
fn limbs_side_by_side_share_a_wall() {
    let vessel = prepare(shapes::bent_pipe(2.0, 2.6, PI, 64), Some(LengthUnit::Millimetre)).expect("a bend");
    let settings = Settings::new(SPACING);
    let blood = fluid(&vessel, &settings, &mut quiet).expect("the bend is wide enough");
    let wall = rigid_wall(&vessel, &settings, &mut quiet).expect("the bend is wide enough");
    assert_eq!(blood.quality.outside, 0);
    // Room of three spacings is no whole number of layers, so the spread is larger than in a free wall.
    for (q, cv) in [(&blood.quality, 0.06), (&wall.quality, 0.08)] {
        assert!(q.nearest_neighbor_min > 0.65 && q.nearest_neighbor_cv < cv, "{q:?}");
    }
    let closed = SignedDistance::closed(&vessel);
    assert!(wall.position.iter().all(|x| closed.query(*x).distance > 0.0), "wall stands in a lumen");
    let between = wall.position.iter().filter(|x| (x.x - 2.6e-3).abs() < 0.6e-3 && x.z.abs() < 1e-3).count();
    // Room of 1.2 mm at the narrowest, 2 mm along, and the height over which limbs are that near.
    assert!(between > 60, "{between} particles between the limbs");
}

#[test]
fn the_same_bits_on_one_and_two_threads() {
    let vessel = pipe();
    let settings = Settings { steps: 30, ..Settings::new(1.5 * SPACING) };
    let generate = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
        pool.install(|| {
            let blood = fluid(&vessel, &settings, &mut quiet).expect("the pipe is wide enough");
            (blood, rigid_wall(&vessel, &settings, &mut quiet).expect("the pipe is wide enough"))
        })
    };
    assert_eq!(generate(1), generate(2));
}

#[test]
fn the_seed_and_the_lattice_matter() {
    let vessel = pipe();
    let settings = Settings { steps: 3, ..Settings::new(2.0 * SPACING) };
    let positions = |s: &Settings| fluid(&vessel, s, &mut quiet).expect("the pipe is wide enough").position;
    let first = positions(&settings);
    assert_ne!(first, positions(&Settings { seed: 1, ..settings.clone() }));
    assert_ne!(first, positions(&Settings { lattice: Lattice::Bcc, ..settings.clone() }));
}

#[test]
fn progress_is_told_every_step_and_decays() {
    let mut told = Vec::new();
    let settings = Settings { steps: 40, ..Settings::new(2.0 * SPACING) };
    let body = fluid(&pipe(), &settings, &mut |step, moved| told.push((step, moved))).expect("wide enough");
    assert_eq!(told.len(), body.quality.iterations);
    assert!(told.iter().enumerate().all(|(k, t)| t.0 == k + 1));
    assert!(told[told.len() - 1].1 < 0.3 * told[0].1, "{told:?}");
}

#[test]
fn spacings_that_cannot_work_are_refused() {
    let vessel = pipe();
    let coarse = fluid(&vessel, &Settings::new(1.01 * RADIUS), &mut quiet).expect_err("no ring fits");
    let GenerationError::TooCoarse { opening, needed, .. } = coarse else { panic!("{coarse}") };
    assert!(opening < 2 && (needed * 3.0 / RADIUS - 1.0).abs() < 0.01);
    let fine = rigid_wall(&vessel, &Settings::new(1e-8), &mut quiet).expect_err("1e18 particles");
    assert!(matches!(fine, GenerationError::TooFine { .. }), "{fine}");
    for spacing in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let error = fluid(&vessel, &Settings::new(spacing), &mut quiet).expect_err("no spacing");
        assert!(error.to_string().starts_with("`spacing` is"), "{error}");
    }
    let flat = Settings { smoothing: 0.9, ..Settings::new(SPACING) };
    assert!(fluid(&vessel, &flat, &mut quiet).is_err());
}

#[test]
fn a_narrow_opening_is_warned_of() {
    let vessel = pipe();
    assert!(warnings(&vessel, &Settings::new(0.33 * RADIUS)).is_empty());
    let found = warnings(&vessel, &Settings::new(0.5 * RADIUS));
    assert_eq!(found.len(), 2, "both openings are narrow");
    assert!(matches!(found[0], Warning::Unresolved { needed, .. } if needed < 0.34 * RADIUS));
    assert!(found[0].to_string().contains("2.0 spacings"), "{}", found[0]);
}

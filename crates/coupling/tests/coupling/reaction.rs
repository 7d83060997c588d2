//! What the wall gets is what the fluid loses.

use glam::DVec3;
use vaso_coupling::{Coupling, Prescribed};
use vaso_fluid::Rheology;
use vaso_fluid::{CapZone, Fluid, FluidState, Isa, Numbers};
use vaso_particles::WallDistance;

const SPACING: f64 = 1e-3;
const HALF: f64 = 4.0 * SPACING;

/// Cubic room from `-HALF` to `HALF`.
struct Room;

impl WallDistance for Room {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        let size = x.abs();
        let along = if size.x >= size.y && size.x >= size.z {
            DVec3::X * x.x.signum()
        } else if size.y >= size.z {
            DVec3::Y * x.y.signum()
        } else {
            DVec3::Z * x.z.signum()
        };
        (size.max_element() - HALF, along)
    }
}

/// Numbers from -1 to 1.
fn noise() -> impl FnMut() -> f64 {
    let mut state = 11_u64;
    move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    }
}

/// Sites of a lattice of twice `half` sites an edge.
fn lattice(half: i32) -> impl Iterator<Item = DVec3> {
    let sites = move || (-half..half).map(|k| SPACING * (f64::from(k) + 0.5));
    sites().flat_map(move |x| sites().flat_map(move |y| sites().map(move |z| DVec3::new(x, y, z))))
}

/// Change of momentum of the fluid and impulse on the wall in one acoustic step, over the sum of the sizes of the latter.
///
/// Away from caps the viscosity between fluid particles takes off what each for itself takes for linear, which leaves them a
/// resultant: here either all are near a cap, or there is but one.
fn imbalance(rheology: Option<Rheology>, is_alone: bool) -> f64 {
    let mut next = noise();
    let mut random = move || DVec3::new(next(), next(), next());
    let mut fluid: Vec<DVec3> = lattice(4).map(|x| x + 0.1 * SPACING * random()).collect();
    if is_alone {
        fluid = vec![DVec3::new(0.7, -0.6, 0.8) * HALF];
    }
    let n = fluid.len();
    let zone = |particle| CapZone {
        particle,
        opening: 0,
        normal: DVec3::Z,
        depth: HALF,
        is_imposed: false,
        in_buffer: false,
        takes_pressure: false,
        share: 1.0,
    };
    let zones: Vec<CapZone> = if is_alone { Vec::new() } else { (0..n as u32).map(zone).collect() };
    let wall: Vec<DVec3> =
        lattice(7).filter(|x| Room.sample(*x).0 > 0.0).map(|x| x + 0.1 * SPACING * random()).collect();
    let depth: Vec<f64> = wall.iter().map(|x| Room.sample(*x).0.max(0.1 * SPACING)).collect();
    let volume = vec![SPACING.powi(3); wall.len()];
    assert!(wall.len() > 1000, "{} particles in the wall", wall.len());
    let spin = move |x: DVec3| 0.05 * DVec3::new(3.0 * x.y - x.z, x.z + x.x, 2.0 * x.y - x.x) / SPACING;
    let mut structure = Prescribed::new(wall, depth, volume, move |x: DVec3, t| (x + t * spin(x), spin(x)));
    // The room has edges where a curvature would mean nothing: forces go to the particles as they are.
    structure.thinning = 0.5;
    let mut numbers = Numbers::new(1050.0, 7e-3, 0.5, SPACING);
    // Mass over density is then the volume in the records to the last bit, and all pairs of the fluid cancel.
    numbers.density_blend = 0.0;
    numbers.rheology = rheology;
    let mut state = FluidState::at_rest(fluid, &vec![SPACING.powi(3); n], numbers.rest_density);
    for i in 0..state.len() {
        state.velocity[i] = 0.2 * random();
        state.density_change[i] = 5.0 * random().x;
    }
    let bounds = (DVec3::splat(-2.0 * HALF), DVec3::splat(2.0 * HALF));
    let view = vaso_coupling::MovingWall::view(&structure);
    let mut fluid = Fluid::<f64>::new(state, view, Box::new(Room), bounds, numbers, Isa::detect());
    let mut coupling = Coupling::new(structure, &mut fluid);
    fluid.sort();
    coupling.show(&mut fluid);
    fluid.search(&zones);
    fluid.summation(&zones);
    fluid.viscosity();
    fluid.shear_thinning();
    coupling.take_drag(&mut fluid);
    fluid.offsets();
    let dt = 1e-6;
    let momentum = |fluid: &Fluid<f64>| -> DVec3 {
        (0..fluid.state.len()).map(|i| fluid.state.mass[i] * fluid.state.velocity[i]).sum()
    };
    fluid.begin_acoustic(dt);
    fluid.wall_pressure();
    let before = momentum(&fluid);
    fluid.kick(dt);
    coupling.take_pressure(&mut fluid);
    coupling.advance(dt).expect("a prescribed wall does not fail");
    // Pairs of the fluid have the difference of their pressures: what uneven neighbours would leave of the own pressure is taken
    // back, which no wall gives.
    let taken_back: DVec3 = (0..fluid.state.len())
        .map(|i| {
            fluid.state.mass[i] / (numbers.rest_density + fluid.state.density_change[i])
                * fluid.acoustic_pressure(i)
                * fluid.missing_support(i)
        })
        .sum();
    let gained = momentum(&fluid) - before - dt * taken_back;
    let load = coupling.load();
    let forces = load.pressure_force.iter().zip(load.viscous_force);
    let (on_wall, size) = forces
        .fold((DVec3::ZERO, 0.0), |(sum, size), (p, v)| (sum + *p + *v, size + p.length() + v.length()));
    let viscous: f64 = load.viscous_force.iter().map(|f| f.length()).sum();
    assert!(viscous > 1e-3 * size && viscous < 0.9 * size, "both parts count: {viscous} of {size}");
    (gained / dt + on_wall).length() / size
}

#[test]
fn action_equals_reaction_to_rounding() {
    let thinning = Some(Rheology::PowerLaw { consistency: 17e-3, index: 0.708 });
    for (rheology, is_alone) in [(None, false), (thinning, false), (None, true)] {
        let imbalance = imbalance(rheology, is_alone);
        assert!(imbalance < 1e-11, "{imbalance:e}");
    }
}

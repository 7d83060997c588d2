//! The drag on the layers next to the wall of a pipe, of the exact parabola: one evaluation, no flow.
//!
//! The table of `docs/theory/flow.md` is printed by
//! `cargo test --release -p vaso-tests --lib -- flows::near_wall --ignored --nocapture`.

use crate::pipe::Pipe;
use glam::{DMat3, DVec3};
use vaso_driver::{Plan, world};
use vaso_kernels::{CellGrid, Wendland};

/// Radius of the pipe \[m\] and the axial velocity on its axis \[m/s\].
const RADIUS: f64 = 3.175e-3;
const PEAK: f64 = 0.108;
/// Kinematic viscosity \[m^2/s\].
const VISCOSITY: f64 = 3.6e-3 / 1050.0;

/// Distance from the wall \[m\].
fn distance(x: DVec3) -> f64 {
    RADIUS - x.truncate().length()
}

/// The parabola, also behind the wall.
fn velocity(x: DVec3) -> f64 {
    PEAK * (1.0 - x.truncate().length_squared() / (RADIUS * RADIUS))
}

/// Exact viscous acceleration \[m/s^2\].
const EXACT: f64 = -4.0 * VISCOSITY * PEAK / (RADIUS * RADIUS);

/// Layer of a particle in the middle of the pipe: the first is up to 0.9 spacings from the wall, the second up to 1.8.
fn layer(x: DVec3, spacing: f64) -> Option<usize> {
    let layer = (distance(x) / (0.9 * spacing)) as usize;
    ((10e-3..20e-3).contains(&x.z) && layer < 2).then_some(layer)
}

/// Mean of a value over each of the first two layers.
#[derive(Default)]
struct Layers([(f64, f64); 2]);

impl Layers {
    fn add(&mut self, layer: usize, value: f64) {
        self.0[layer].0 += value;
        self.0[layer].1 += 1.0;
    }

    fn means(&self) -> [f64; 2] {
        self.0.map(|(sum, n)| sum / n)
    }
}

fn bodies(across: f64) -> (vaso_driver::Case, Plan, world::Bodies) {
    let pipe = Pipe {
        inlet: "condition = \"velocity\"\nvalue = \"54 mm/s\"".into(),
        outlet: "condition = \"pressure\"".into(),
        ..Pipe::published(across)
    };
    let (case, plan) = pipe.plan();
    let bodies = world::Bodies::make(&case, |_, _, _| {}).expect("the spacing fits");
    (case, plan, bodies)
}

/// Drag over the exact one by the formula of the scheme, written out, with the exact distance: with walls that continue the velocity
/// by a straight line, by the parabola, and by the parabola with the linear part of the velocity taken off each pair.
fn by_formula(across: f64) -> [[f64; 2]; 3] {
    let (_, plan, bodies) = bodies(across);
    let kernel = Wendland::new(plan.numbers.smoothing_length);
    let (n, support) = (bodies.fluid.position.len(), kernel.support());
    let wall = bodies.wall.layers().expect("a rigid wall has layers");
    let position = [bodies.fluid.position, wall.position.clone()].concat();
    let volume = [bodies.fluid.volume, wall.volume.clone()].concat();
    let low = position.iter().fold(DVec3::INFINITY, |a, b| a.min(*b));
    let high = position.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b));
    let mut grid = CellGrid::new((low, high), support);
    let mut order = Vec::new();
    grid.sort(&position, &mut order);
    let neighbors = |i: usize| -> Vec<(usize, DVec3)> {
        let runs = grid.runs(position[i]).into_iter();
        runs.flat_map(|(begin, end)| &order[begin..end])
            .map(|&j| (j as usize, position[j as usize] - position[i]))
            .filter(|(j, d)| *j != i && d.length() < support)
            .collect()
    };
    let correction: Vec<DMat3> = (0..n)
        .map(|i| {
            let moment = |(j, d): (usize, DVec3)| {
                let weight = -volume[j] * kernel.derivative(d.length()) / d.length();
                DMat3::from_cols(weight * d.x * d, weight * d.y * d, weight * d.z * d)
            };
            neighbors(i).into_iter().map(moment).sum::<DMat3>().inverse()
        })
        .collect();
    let (mut straight, mut parabola) = (Layers::default(), Layers::default());
    let mut linear = Layers::default();
    for i in 0..n {
        let x = position[i];
        let Some(layer) = layer(x, plan.numbers.spacing) else { continue };
        let mut drag = [0.0; 2];
        let mut lean = DVec3::ZERO;
        let slope = -2.0 * PEAK / (RADIUS * RADIUS) * DVec3::new(x.x, x.y, 0.0);
        for (j, d) in neighbors(i) {
            let e = d.normalize();
            let weight = volume[j] * kernel.derivative(d.length()) / d.length();
            if j < n {
                let factor = e.dot((correction[i] + correction[j]) * e);
                lean += weight * factor * d;
                drag = drag.map(|sum| sum + weight * factor * (velocity(x) - velocity(position[j])));
            } else {
                let factor = 2.0 * e.dot(correction[i] * e);
                lean += weight * factor * d;
                let line = -velocity(x) * -distance(position[j]) / distance(x);
                for (sum, beyond) in drag.iter_mut().zip([line, velocity(position[j])]) {
                    *sum += weight * factor * (velocity(x) - beyond);
                }
            }
        }
        straight.add(layer, VISCOSITY * drag[0] / EXACT);
        linear.add(layer, VISCOSITY * (drag[1] + lean.dot(slope)) / EXACT);
        parabola.add(layer, VISCOSITY * drag[1] / EXACT);
    }
    [straight.means(), parabola.means(), linear.means()]
}

/// Drag over the exact one as the fluid finds it.
fn by_fluid(across: f64) -> [f64; 2] {
    let (case, plan, bodies) = bodies(across);
    let mut flow = world::build_flow::<f64>(&case, &plan, bodies).expect("a rigid wall is always built");
    let fluid = &mut flow.fluid;
    for i in 0..fluid.state.len() {
        fluid.state.velocity[i] = velocity(fluid.state.position[i]) * DVec3::Z;
    }
    fluid.sort();
    fluid.search(&[]);
    fluid.summation(&[]);
    fluid.viscosity();
    let mut layers = Layers::default();
    for i in 0..fluid.state.len() {
        if let Some(layer) = layer(fluid.state.position[i], plan.numbers.spacing) {
            layers.add(layer, fluid.viscous_acceleration(i).z / EXACT);
        }
    }
    layers.means()
}

#[test]
fn drag_next_to_the_wall_is_that_of_the_parabola() {
    let [straight, parabola, linear] = by_formula(10.0);
    let found = by_fluid(10.0);
    println!("straight {straight:.3?}, parabola {parabola:.3?}, linear {linear:.3?}, fluid {found:.3?}");
    assert!(straight[0] < 0.9, "a straight line is known to drag too little: {straight:?}");
    assert!(parabola[1] < 0.97, "uneven layers are known to take a slope for a bend: {parabola:?}");
    assert!(linear.iter().all(|drag| (drag - 1.0).abs() < 0.01), "{linear:?}");
    // The distance from the wall, of a lattice of half a spacing, is what the first layer misses.
    assert!((found[0] - 1.0).abs() < 0.04 && (found[1] - 1.0).abs() < 0.01, "{found:?}");
}

#[test]
#[ignore = "prints the table of docs/theory/flow.md"]
fn table() {
    for across in [10.0, 16.0, 20.0] {
        let [straight, parabola, linear] = by_formula(across);
        println!(
            "D/{across}: straight {straight:.2?}, parabola {parabola:.2?}, linear {linear:.2?}, fluid {:.3?}",
            by_fluid(across)
        );
    }
}

//! Elastic tubes filled with blood: inflated to rest, and with a pulse that travels along them.

use vaso_driver::Flow;
use vaso_tests::pipe::Pipe;

/// A tube whose inner radius is 5 mm, with a given wall beyond the rings that are held at its ends.
fn tube(across: f64, free_length: f64, wall: &str, more: &str) -> Pipe {
    let spacing = 10e-3 / across;
    Pipe {
        diameter: 10e-3,
        length: free_length + 8.0 * spacing,
        density: 1000.0,
        viscosity: 3e-3,
        more: format!("{more}\n[wall]\nmodel = \"solid\"\n{wall}\n"),
        ..Pipe::published(across)
    }
}

/// Radial displacement of the innermost layer over that of Lame's thick tube, mean over the middle of the tube.
fn over_lame(flow: &Flow<f32>, pipe: &Pipe, young: f64, nu: f64, thickness: f64, pressure: f64) -> f64 {
    let solid = &flow.wall.as_ref().expect("the wall deforms").wall;
    let (a, b) = (pipe.radius(), pipe.radius() + thickness);
    let lame = |r: f64| {
        pressure * a * a * (1.0 + nu) / (young * (b * b - a * a)) * ((1.0 - 2.0 * nu) * r + b * b / r)
    };
    let spacing = solid.numbers().spacing;
    let (sum, expected) = (0..solid.state.len())
        .filter_map(|i| {
            let x = solid.state.reference_position[i];
            let r = x.x.hypot(x.y);
            let is_in = (x.z - 0.5 * pipe.length).abs() < 0.1 * pipe.length && r < a + spacing;
            let u = solid.state.displacement[i];
            is_in.then(|| ((u.x * x.x + u.y * x.y) / r, lame(r)))
        })
        .fold((0.0, 0.0), |(s, e), (u, l)| (s + u, e + l));
    sum / expected
}

#[test]
fn a_tube_under_pressure_widens_as_lame_says() {
    let (young, nu, thickness, pressure): (f64, f64, f64, f64) = (150e3, 0.45, 2e-3, 500.0);
    let wall = format!(
        "material = \"saint-venant-kirchhoff\"\nyoung_modulus = \"{young} Pa\"\npoisson_ratio = {nu}\n\
         thickness = \"{thickness} m\"\ndensity = \"1000 kg/m^3\"\ndamping = \"quasi-static\""
    );
    let end = format!("condition = \"pressure\"\nvalue = \"{pressure} Pa\"\nramp = \"8 ms\"");
    for across in [10.0] {
        let pipe = Pipe {
            inlet: end.clone(),
            outlet: end.clone(),
            viscosity: 0.3,
            ..tube(across, 20e-3, &wall, "")
        };
        let (mut flow, _, plan) = pipe.flow::<f32>();
        println!("{} {:?}", plan.sound_speed_reason, plan.predicted);
        let mut next = 0.0;
        while flow.time < 0.04 {
            flow.step(0.04).unwrap_or_else(|e| panic!("{e}"));
            if flow.time >= next {
                next += 0.002;
                let ratio = over_lame(&flow, &pipe, young, nu, thickness, pressure);
                let state = &flow.fluid.state;
                let middle: Vec<usize> = (0..state.len())
                    .filter(|&i| (state.position[i].z - 0.5 * pipe.length).abs() < 0.1 * pipe.length)
                    .collect();
                let p = middle.iter().map(|&i| state.pressure[i]).sum::<f64>() / middle.len() as f64;
                let coupling = flow.wall.as_ref().expect("it is there");
                let (solid, load) = (&coupling.wall, coupling.load());
                let (mut work, mut total) = (0.0, 0.0);
                for i in 0..solid.state.len() {
                    let x = solid.state.position(i);
                    let r = x.x.hypot(x.y);
                    if (x.z - 0.5 * pipe.length).abs() < 0.1 * pipe.length {
                        let f = load.pressure_force[i];
                        let radial = (f.x * x.x + f.y * x.y) / r;
                        total += radial;
                        work += radial * pipe.radius() / r;
                    }
                }
                let exact = std::f64::consts::TAU * pipe.radius() * 0.2 * pipe.length;
                println!("load total {:.4}, virtual work {:.4} of p", total / exact / p, work / exact / p);
                let e = flow.wall.as_mut().expect("it is there").wall.energies();
                println!(
                    "{:.4} s: u/u_Lame {ratio:.4}, p/p_0 {:.4}, kinetic {:.2e} strain {:.2e} balance {:.2e}, steps {} {}",
                    flow.time,
                    p / pressure,
                    e.kinetic,
                    e.strain,
                    e.balance(),
                    flow.acoustic_steps,
                    flow.advective_steps
                );
            }
        }
    }
}

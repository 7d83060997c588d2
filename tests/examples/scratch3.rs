//! x
use vaso_coupling::ShellWall;
use vaso_tests::pipe::Pipe;
const LUMEN: f64 = 5e-3;
fn e(name: &str, d: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(d)
}
fn main() {
    let (young, thickness, density, sound) = (300e3, e("T", 1e-3), 1000.0, e("C", 30.0));
    let (rise, height) = (40e-3, 150.0);
    let wave = (young * thickness / (2.0 * density * (LUMEN + 0.5 * thickness))).sqrt();
    let expected = 1.0 / (1.0_f64 / (wave * wave) + 1.0 / (sound * sound)).sqrt();
    let front: Vec<[f64; 2]> = (0..=20)
        .map(|k| {
            let s = f64::from(k) / 20.0;
            [s * rise, 0.5 * height * (1.0 - (std::f64::consts::PI * s).cos())]
        })
        .chain([[1.0, height]])
        .collect();
    let pipe = Pipe {
        diameter: 2.0 * LUMEN,
        length: 300e-3,
        density,
        viscosity: e("MU", 1e-4),
        inlet: "condition = \"pressure\"\nwaveform = \"inflow.csv\"".into(),
        outlet: "condition = \"pressure\"\nvalue = \"0 Pa\"".into(),
        inflow: front,
        end_time: 75e-3,
        more: format!(
            "[numerics]\nsound_speed = \"{sound} m/s\"\n{}\n[wall]\nmodel = \"shell\"\nmaterial = \"saint-venant-kirchhoff\"\nyoung_modulus = \"{young} Pa\"\npoisson_ratio = 0.0\nthickness = \"{thickness} m\"\ndensity = \"{density} kg/m^3\"\n{}\n",
            std::env::var("NUM").unwrap_or_default(),
            std::env::var("MORE").unwrap_or_default()
        ),
        ..Pipe::published(e("ACROSS", 10.0))
    };
    println!("expected {expected}");
    let (mut flow, _, _) = pipe.flow_in::<f32, ShellWall<f32>>();
    let mut next = 0.0;
    while flow.time < pipe.end_time {
        if let Err(x) = flow.step(pipe.end_time) {
            println!("{x}");
            return;
        }
        if flow.time < next {
            continue;
        }
        next += 2.5e-3;
        let state = &flow.fluid.state;
        let shell = &flow.wall.as_ref().unwrap().wall.shell;
        print!("{:.2} ", 1e3 * flow.time);
        for k in 1..9 {
            let z0 = 0.1 * f64::from(k) * pipe.length - if k == 1 { 0.0 } else { 0.0 };
            let near = (0..state.len()).filter(|&i| (state.position[i].z - z0).abs() < 5e-3);
            let (sum, su, n) = near.fold((0.0, 0.0, 0.0), |(s, u, n), i| {
                (s + state.pressure[i], u + state.velocity[i].z, n + 1.0)
            });
            let (mut ur, mut m) = (0.0, 0.0);
            for i in 0..shell.state.len() {
                let x = shell.state.reference_position[i];
                if (x.z - z0).abs() < 5e-3 {
                    ur += (shell.state.displacement[i].x * x.x + shell.state.displacement[i].y * x.y)
                        / x.x.hypot(x.y);
                    m += 1.0;
                }
            }
            let r = LUMEN + 0.5 * thickness;
            let pw = ur / m * young * thickness / (LUMEN * r);
            print!(" {:6.1}/{:5.1}/{:6.1}", sum / n, pw, 1000.0 * su / n * expected);
        }
        println!();
    }
}

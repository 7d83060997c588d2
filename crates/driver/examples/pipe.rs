//! Scratch: pipe flow.
use glam::DVec3;
use vaso_boundary::*;
use vaso_driver::*;
use vaso_fluid::*;
use vaso_geometry::*;
use vaso_particles::*;
struct D(DistanceGrid);
impl WallDistance for D {
    fn sample(&self, x: DVec3) -> (f64, DVec3) {
        self.0.sample(x)
    }
}
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let nd: f64 = a[1].parse().unwrap();
    let ld: f64 = a[2].parse().unwrap();
    let tend: f64 = a[3].parse().unwrap();
    let prec = a.get(4).map(|s| s.as_str()).unwrap_or("mixed");
    let r = 3.175e-3;
    let d = 2.0 * r;
    let dp = d / nd;
    let l = ld * d;
    let surf = shapes::pipe(r, l, DVec3::Z, 96);
    let vessel = prepare(surf, Some(LengthUnit::Metre)).unwrap();
    let t0 = std::time::Instant::now();
    let set = vaso_generation::Settings::new(dp);
    let f = vaso_generation::fluid(&vessel, &set, &mut |_, _| {}).unwrap();
    let w = vaso_generation::rigid_wall(&vessel, &set, &mut |_, _| {}).unwrap();
    println!("fluid {:?}\nwall {:?} in {:.1}s", f.quality, w.quality, t0.elapsed().as_secs_f64());
    if prec == "double" {
        go::<f64>(&vessel, f, w, dp, r, l, tend)
    } else {
        go::<f32>(&vessel, f, w, dp, r, l, tend)
    }
}
fn go<R: Real>(
    vessel: &Vessel,
    f: vaso_generation::Body,
    w: vaso_generation::Body,
    dp: f64,
    r: f64,
    l: f64,
    tend: f64,
) {
    let (rho, mu) = (1050.0, 3.6e-3);
    let um = 100.0 * mu / rho / (2.0 * r);
    let mut num = Numbers::new(rho, mu, 2.0 * um, dp);
    if let Ok(b) = std::env::var("BLEND") {
        num.density_blend = b.parse().unwrap();
    } else if 2.0 * r / dp < 13.0 {
        num.density_blend = 0.2;
    }
    let sd = SignedDistance::wall(vessel);
    let lo = w.position.iter().fold(DVec3::INFINITY, |a, b| a.min(*b)) - DVec3::splat(dp);
    let hi = w.position.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b)) + DVec3::splat(dp);
    let grid = DistanceGrid::build(&sd, (lo, hi), dp, 5.0 * dp);
    let vel = vec![DVec3::ZERO; w.position.len()];
    let vol = vec![w.volume; w.position.len()];
    let st = FluidState::at_rest(f.position, f.volume, rho);
    let n0 = st.len();
    let fl = Fluid::<R>::new(
        st,
        WallView { position: &w.position, velocity: &vel, depth: &w.depth, volume: &vol },
        Box::new(D(grid)),
        (lo, hi),
        num,
        Isa::detect(),
    );
    let (mut inlet, mut outlet) = (vessel.openings[0].clone(), vessel.openings[1].clone());
    if inlet.center.z > outlet.center.z {
        std::mem::swap(&mut inlet, &mut outlet);
    }
    println!("openings {:?} {:?} n_wall {} area {}", inlet.center, outlet.center, fl.n_wall(), inlet.area);
    let z0 = inlet.center.z;
    let q = um * inlet.area;
    let op = Openings::new(
        vec![
            (
                inlet,
                Condition::Velocity {
                    profile: Profile::Parabolic,
                    mean: Signal { source: Source::Constant(um), ramp: 0.1 },
                },
            ),
            (outlet, Condition::Pressure { value: Signal::constant(0.0) }),
        ],
        &num,
        true,
    );
    let mut flow = Flow::new(fl, op, false);
    let t0 = std::time::Instant::now();
    let mut next = 0.0;
    let mut last = (0.0, [0.0; 2]);
    let mut acc = [0.0f64; 3];
    let (mut e2, mut tr, mut n, mut qs, mut ns) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let mut pbin = vec![(0.0, 0.0); (l / dp) as usize + 1];
    while flow.time < tend {
        if let Err(e) = flow.step(tend) {
            println!("{e}");
            break;
        }
        if flow.time > 0.75 * tend {
            let (mut a2, mut t2, mut m, mut qq) = (0.0, 0.0, 0.0, 0.0);
            for i in 0..flow.fluid.state.len() {
                let x = flow.fluid.state.position[i];
                let v = flow.fluid.state.velocity[i];
                let s = x.z - z0;
                let b = (s / dp) as usize;
                if b < pbin.len() {
                    pbin[b].0 += flow.fluid.pressure(i);
                    pbin[b].1 += 1.0;
                }
                if s > 0.4 * l && s < 0.6 * l {
                    let rr = (x.x * x.x + x.y * x.y) / (r * r);
                    a2 += (v.z - 2.0 * um * (1.0 - rr)).powi(2);
                    t2 += v.x * v.x + v.y * v.y;
                    m += 1.0;
                    qq += v.z * flow.fluid.state.mass[i] / rho / (0.2 * l);
                }
            }
            e2 += a2;
            tr += t2;
            n += m;
            qs += qq / q;
            ns += 1.0;
        }
        acc[0] -= flow.readings[0].flow;
        acc[1] += flow.readings[1].flow;
        acc[2] += 1.0;
        if flow.time >= next {
            let v: Vec<f64> = flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect();
            println!(
                "   counters in {:.4} out {:.4} mean readings {:.4} {:.4}",
                -(v[0] - last.1[0]) / (flow.time - last.0) / q,
                (v[1] - last.1[1]) / (flow.time - last.0) / q,
                acc[0] / acc[2] / q,
                acc[1] / acc[2] / q
            );
            last = (flow.time, [v[0], v[1]]);
            acc = [0.0; 3];
            next += tend / 10.0;
            println!(
                "t {:.3} N {:+.2}% qin {:.4} qout {:.4} dens {:.4} mach {:.3} ret {} esc {} strays {:?} steps {} {} wall {:.1}s {:.2}M/s",
                flow.time,
                100.0 * (flow.fluid.state.len() as f64 / n0 as f64 - 1.0),
                -flow.readings[0].flow / q,
                flow.readings[1].flow / q,
                flow.watch.max_density_error,
                flow.watch.max_mach,
                flow.watch.returned,
                flow.watch.escaped,
                flow.openings.ports().iter().map(|p| p.counters.strays).collect::<Vec<_>>(),
                flow.advective_steps,
                flow.acoustic_steps,
                t0.elapsed().as_secs_f64(),
                flow.particle_substeps as f64 / t0.elapsed().as_secs_f64() / 1e6
            );
        }
    }
    println!(
        "profile {:.3}% transv {:.3}% Q {:+.3}%",
        100.0 * (e2 / n as f64).sqrt() / (2.0 * um),
        100.0 * (tr / n).sqrt() / (2.0 * um),
        100.0 * (qs / ns - 1.0)
    );
    let (mut sx, mut sy, mut sxx, mut sxy, mut k) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for (b, p) in pbin.iter().enumerate() {
        let s = (b as f64 + 0.5) * dp;
        if s > 2.0 * r && s < l - 2.0 * r && p.1 > 0.0 {
            let y = p.0 / p.1;
            sx += s;
            sy += y;
            sxx += s * s;
            sxy += s * y;
            k += 1.0;
        }
    }
    let gr = (k * sxy - sx * sy) / (k * sxx - sx * sx);
    let ex = -8.0 * mu * um / (r * r);
    println!("dp/ds {gr:.3} exact {ex:.3} err {:+.2}%", 100.0 * (gr / ex - 1.0));
    for s in Stage::ALL {
        println!(
            "{:20} {:7.3}s {:5.1} ns/p/substep",
            s.name(),
            flow.ledger.seconds(s),
            flow.ledger.seconds(s) / flow.particle_substeps as f64 * 1e9
        );
    }
    println!("bytes/p {}", flow.fluid.bytes() / flow.fluid.state.len());
    println!("pairs {:?}", flow.fluid.n_pairs());
}

//! scratch
use vaso_tests::pipe::Pipe;
use vaso_tests::validation::ends::along;
fn main() {
    let a: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let (across, diameters, re, end) = (a[0], a[1], a[2], a[3]);
    let driven = a.get(4).copied().unwrap_or(0.0);
    let mut pipe = Pipe::published(across);
    pipe.length = diameters * pipe.diameter;
    pipe.end_time = end;
    let mean = re * pipe.viscosity / pipe.density / pipe.diameter;
    let g = 8.0 * pipe.viscosity * mean / pipe.radius().powi(2);
    pipe.inlet = if driven > 0.0 { format!("condition = \"pressure\"\nvalue = \"{} Pa\"\n", g * pipe.length) } else { format!("condition = \"velocity\"\nprofile = \"parabolic\"\nvalue = \"{mean} m/s\"\nramp = \"100 ms\"") };
    pipe.outlet = "condition = \"pressure\"\nvalue = \"0 Pa\"".into();
    let start = std::time::Instant::now();
    let r = along::<f32>(&pipe);
    let u = 2.0 * mean;
    let scale = pipe.density * u * u;
    println!("# {a:?} {:.1} s; G dp / rho U^2 = {:.4}", start.elapsed().as_secs_f64(), g * pipe.spacing() / scale);
    let n = r.place.len();
    let (lo, hi) = ((across as usize), n - across as usize);
    let (mut sx, mut sy, mut sxx, mut sxy, mut c) = (0.0, 0.0, 0.0, 0.0, 0.0);
    for k in lo..hi { let x = r.place[k]; let y = r.pressure[k]; sx += x; sy += y; sxx += x * x; sxy += x * y; c += 1.0; }
    let slope = (c * sxy - sx * sy) / (c * sxx - sx * sx);
    let at = |x: f64| sy / c + slope * (x - sx / c);
    println!("# slope/exact {:.4}; line at outlet {:+.4} rho U^2; exact-line-at mid offset {:+.4}", -slope / g, at(pipe.length) / scale, (at(0.5*pipe.length) - 0.5*g*pipe.length) / scale);
    for k in 0..n {
        if k < 14 || k + 14 >= n {
            println!("{:3} {:3} p-exact {:+.4} p-line {:+.4} core-line {:+.4} filled {:.4} u/mean {:.4} across {:.4} along {:.4} beta {:.4} radial {:+.4}", k, n - 1 - k, (r.pressure[k] - g * (pipe.length - r.place[k])) / scale, (r.pressure[k] - at(r.place[k])) / scale, (r.core[k] - at(r.place[k])) / scale, r.filled[k], r.velocity[k] / mean, r.noise[k][0], r.noise[k][1], r.noise[k][2], r.noise[k][3]);
        }
    }
}

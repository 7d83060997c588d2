//! The common carotid benchmark: an elastic vessel between a measured inflow and a Windkessel.

use vaso_coupling::ShellWall;
use vaso_driver::Flow;

use super::measure::{Flown, Series, flow_within};
use super::{Case, Outcome, Tolerance, Unit};
use crate::data;
use crate::pipe::Pipe;

/// The benchmark with a shell.
pub const CASE: Case = Case {
    name: "common-carotid",
    title: "Common carotid with an elastic wall, against finite elements",
    setup: "Radius 3 mm, 126 mm long, shell of 0.3 mm and 700 kPa in the shape it has at 10.9 kPa, clamped at its ends, 1060 kg/m^3, 4 mPa s, published \
            inflow as a parabola, R_p 2.4875e8, R_d 1.8697e9, C 1.7529e-10, D/8; 1.3 cycles of 1.1 s, of which the last whole one counts.",
    reference: "Three-dimensional finite elements of Xiao et al. (2014), middle of the vessel; Boileau et al. (2015), case of the common carotid.",
    remark: "The references start their cycles at different times: ours is moved to where its pressure differs least. One-dimensional codes differ from \
             the reference by 0.19, 0.6 and 1.0 % rms. The wall is nearly incompressible here, 0.49 for 0.5. The largest radius change is 0.200 mm, of \
             the reference 0.184: its wall is a membrane on the lumen, ours has the pressure across it, by which a wall of a tenth of the radius \
             widens by 5 % more.",
    quick: None,
    full: || run(8.0),
};

const PERIOD: f64 = 1.1;
/// Where the cycle that counts begins \[s\].
const FROM: f64 = 0.22;
/// Pressure at which the wall has the shape of the surface \[Pa\].
const DIASTOLE: f64 = 10.9e3;

/// Pressure \[Pa\], flow \[m^3/s\] and radial displacement \[m\] of the middle in time.
type Middle = [Series; 3];

fn run(across: f64) -> Option<Outcome> {
    let folder = data()?.join("reference/boileau2015_cca");
    let inflow = table(&folder.join("cca_inlet.dat"));
    let reference = table(&folder.join("original_curves/B3D_commoncarotid.txt"));
    let mut pipe = Pipe {
        diameter: 6e-3,
        length: 0.126,
        density: 1060.0,
        viscosity: 4e-3,
        inlet: "condition = \"flow\"\nprofile = \"parabolic\"\nwaveform = \"inflow.csv\"\nramp = \"20 ms\"".into(),
        outlet: "condition = \"windkessel\"\nproximal_resistance = \"2.4875e8 Pa s/m^3\"\ndistal_resistance = \"1.8697e9 Pa s/m^3\"\n\
                 compliance = \"1.7529e-10 m^3/Pa\"\ninitial_pressure = \"10.05 kPa\"\ndistal_pressure = \"0 Pa\""
            .into(),
        end_time: FROM + PERIOD,
        inflow: inflow.iter().map(|row| [row[0], row[1]]).collect(),
        ..Pipe::published(across)
    };
    pipe.more = format!(
        "period = \"{PERIOD} s\"\n[wall]\nmodel = \"shell\"\nmaterial = \"saint-venant-kirchhoff\"\nyoung_modulus = \"700 kPa\"\n\
         poisson_ratio = 0.49\nthickness = \"0.3 mm\"\ndensity = \"1060 kg/m^3\"\nunloaded_pressure = \"{DIASTOLE} Pa\"\n"
    );
    let mut outcome = Outcome::new();
    let (middle, flown) = fly(&pipe);
    outcome.cost(&flown);

    let [pressure, flow, widening] = middle.map(|series| series.from(FROM).smoothed(2e-3));
    let curve = |column: usize, scale: f64, t: f64| scale * at(&reference, column, t);
    let off = |shift: f64| pressure.minus(|t| curve(1, 1e3, t + shift));
    let rms = |series: &Series| {
        (series.points.iter().map(|p| p.1 * p.1).sum::<f64>() / series.points.len() as f64).sqrt()
    };
    let shifts = (0..1100).map(|k| 1e-3 * f64::from(k));
    let best = shifts.min_by(|a, b| rms(&off(*a)).total_cmp(&rms(&off(*b)))).expect("there are shifts");
    let largest = |column: usize| reference.iter().map(|row| row[column]).fold(f64::NEG_INFINITY, f64::max);
    let pulse = 1e3 * (largest(1) - reference.iter().map(|row| row[1]).fold(f64::INFINITY, f64::min));
    // Displacements of the reference are those since diastole.
    let least = widening.points.iter().map(|p| p.1).fold(f64::INFINITY, f64::min);
    for (what, series, column, scale, whole, asked) in [
        ("pressure, rms, of the pulse", &pressure, 1, 1e3, pulse, Tolerance::Asked(0.03)),
        ("flow, rms, of the peak", &flow, 2, 1e-6, 1e-6 * largest(2), Tolerance::Asked(0.03)),
        (
            "radius change, rms, of the largest",
            &widening.minus(|_| least),
            3,
            1e-3,
            1e-3 * largest(3),
            Tolerance::Missed { asked: 0.05, held: 0.07 },
        ),
    ] {
        let difference = series.minus(|t| curve(column, scale, t + best));
        outcome.figure(what, rms(&difference) / whole, Unit::Part, asked);
    }
    let extremes = |series: &Series| {
        let values = series.points.iter().map(|p| p.1);
        [values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max)]
    };
    println!(
        "moved by {best} s; pressure {:?} Pa, flow {:?} m^3/s, radius {:?} m",
        extremes(&pressure),
        extremes(&flow),
        extremes(&widening)
    );
    let ends = [pressure.points[0].1, pressure.points[pressure.points.len() - 1].1];
    outcome.figure(
        "pressure at the end of the cycle by its start, of the pulse",
        (ends[1] - ends[0]) / pulse,
        Unit::Part,
        Tolerance::Held(0.05),
    );
    outcome.figure("particles lost", flown.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    outcome.figure(
        "minutes a cycle",
        flown.seconds / 60.0 / (pipe.end_time / PERIOD),
        Unit::Number,
        Tolerance::Missed { asked: 5.0, held: 60.0 },
    );
    Some(outcome)
}

fn fly(pipe: &Pipe) -> (Middle, Flown) {
    let (mut flow, _, plan) = pipe.flow_in::<f32, ShellWall<f32>>();
    let mut middle = Middle::default();
    let is_middle = |z: f64| (z / pipe.length - 0.5).abs() < 0.03;
    let mut told = 0.1;
    while flow.time < plan.end_time {
        flow.step(plan.end_time).unwrap_or_else(|e| panic!("{e}"));
        if flow.time > told {
            told += 0.1;
            println!("{:.2} s in {:.0} s", flow.time, flow.ledger.total());
        }
        let now = [pressure(&flow, &is_middle), through(&flow, pipe), widening(&flow, &is_middle)];
        middle.iter_mut().zip(now).for_each(|(series, value)| series.add(flow.time, value));
    }
    let flown = Flown {
        particles: flow.fluid.state.len(),
        escaped: flow.watch.escaped,
        density: flow.watch.max_density_error,
        seconds: flow.ledger.total(),
    };
    (middle, flown)
}

type ShellFlow = Flow<f32, ShellWall<f32>>;

fn pressure(flow: &ShellFlow, is_middle: &impl Fn(f64) -> bool) -> f64 {
    let state = &flow.fluid.state;
    DIASTOLE + mean((0..state.len()).filter(|&i| is_middle(state.position[i].z)).map(|i| state.pressure[i]))
}

fn through(flow: &ShellFlow, pipe: &Pipe) -> f64 {
    flow_within(pipe, &flow.fluid.state, pipe.density, [0.47, 0.53])
}

fn widening(flow: &ShellFlow, is_middle: &impl Fn(f64) -> bool) -> f64 {
    let state = &flow.wall.as_ref().expect("the wall deforms").wall.shell.state;
    let place = &state.reference_position;
    mean(
        (0..state.len())
            .filter(|&i| is_middle(place[i].z))
            .map(|i| state.displacement[i].dot(place[i].with_z(0.0).normalize())),
    )
}

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0.0), |(sum, n), value| (sum + value, n + 1.0));
    sum / n
}

/// Rows of numbers.
fn table(file: &std::path::Path) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(file).expect("the data hold the benchmark");
    let row = |line: &str| line.split_whitespace().map(|v| v.parse().expect("a number")).collect();
    text.lines().filter(|line| !line.trim().is_empty()).map(row).collect()
}

/// Linear interpolation in a column of a table over one period.
fn at(table: &[Vec<f64>], column: usize, t: f64) -> f64 {
    let t = t.rem_euclid(PERIOD);
    let next = table.partition_point(|row| row[0] <= t);
    let last = table.len() - 1;
    let (a, b) = (&table[next.checked_sub(1).unwrap_or(last)], &table[next % table.len()]);
    let (from, to) = (a[0], if next > last { b[0] + PERIOD } else { b[0] });
    a[column] + (b[column] - a[column]) * ((t - from) / (to - from)).clamp(0.0, 1.0)
}

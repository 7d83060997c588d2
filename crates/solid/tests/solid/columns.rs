//! Columns of 1 x 1 x 6 m that bend and twist (Aguirre, Gil, Bonet 2014), against published tracks of their ends.

use crate::support;

use glam::DVec3;
use support::{at_time, data, lattice, table};
use vaso_solid::{Isa, Material, NeoHookean, Numbers, Real, Solid};

const DENSITY: f64 = 1100.0;

/// Column along x from the clamp at x = 0 on; its cross-section begins at `corner`.
fn column<R: Real>(
    layers: usize,
    corner: f64,
    poisson: f64,
    (damping, hourglass): (f64, f64),
    velocity: impl Fn(DVec3) -> DVec3,
) -> Solid<R> {
    let spacing = 1.0 / layers as f64;
    let low = DVec3::new(-4.0 * spacing, corner, corner);
    let body = lattice(low, [6 * layers + 4, layers, layers], spacing);
    let material = Material::NeoHookean(NeoHookean::new(17e6, poisson).expect("in range"));
    let numbers = Numbers { max_substeps: 100_000, damping, hourglass, ..Numbers::new(DENSITY, spacing) };
    let mut solid = Solid::new(&body.particles(), material, numbers, Isa::detect()).expect("a sound body");
    for i in 0..solid.state.len() {
        solid.state.velocity[i] = velocity(solid.state.reference_position[i]);
    }
    solid.clamp(&body.select(|x| x.x < 0.0)).expect("particles exist");
    solid
}

/// Damping and hourglass control as they are unless somebody asks for others.
fn usual() -> (f64, f64) {
    let numbers = Numbers::new(DENSITY, 1.0);
    (numbers.damping, numbers.hourglass)
}

fn nearest<R: Real>(solid: &Solid<R>, x: DVec3) -> usize {
    let distance = |i: &usize| solid.state.reference_position[*i].distance(x);
    (0..solid.state.len()).min_by(|i, j| distance(i).total_cmp(&distance(j))).expect("there are particles")
}

#[test]
#[ignore = "minutes: 1 s of 11 000 particles"]
fn a_bending_column_follows_the_published_track() {
    let Some(data) = data() else { return };
    let track = table(&data.join("reference/tlsph_solids/bending_column_sphinxsys_tip.csv"));
    let start = DVec3::new(track[0][1], track[0][2], track[0][3]);
    let mut solid = column::<f32>(12, 0.0, 0.45, usual(), |_| DVec3::new(0.0, 5.0 * 3.0_f64.sqrt(), 5.0));
    let tip = nearest(&solid, start);
    let range = |k: usize| {
        let values = track.iter().map(|row| row[k]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    };
    let begin = solid.energies().balance();
    let (mut time, mut error, mut hourglass) = (0.0, 0.0_f64, 0.0_f64);
    while time < 3.0 - 1e-9 {
        solid.advance(0.03).expect("published to be stable");
        time += 0.03;
        let x = solid.state.position(tip) - solid.state.reference_position[tip] + start;
        let miss =
            x.to_array().into_iter().enumerate().map(|(k, x)| (x - at_time(&track, k + 1, time)).abs());
        let miss = miss.fold(0.0, f64::max) / range(2);
        let energies = solid.energies();
        hourglass = hourglass.max(energies.hourglass / energies.strain);
        if (time * 100.0).round() % 12.0 == 0.0 {
            println!(
                "t {time:.2} s: tip {x:.3}, {:.2} % of the swing off the track; energy lost {:.2} %, not accounted for {:+.2} %, \
                 hourglass {:.2} % of strain",
                100.0 * miss,
                100.0 * energies.dissipated / begin,
                100.0 * (energies.balance() / begin - 1.0),
                100.0 * energies.hourglass / energies.strain
            );
        }
        if time < 1.0 {
            error = error.max(miss);
        }
    }
    assert!(hourglass < 0.02, "hourglass energy {hourglass}");
    assert!(error < 0.05, "off the track by {error} of its swing within 1 s");
}

/// Root mean square deviation from the mean of the neighbours of the lattice, in spacings: a pattern of zero energy shows.
fn zigzag<R: Real>(solid: &Solid<R>) -> f64 {
    let spacing = solid.numbers().spacing;
    let n = solid.state.len();
    let mut lookup: Vec<(i64, usize)> = (0..n)
        .map(|i| {
            let k = (solid.state.reference_position[i] / spacing - DVec3::splat(0.5)).round().as_i64vec3();
            (k.x * 1_000_000 + k.y * 1_000 + k.z, i)
        })
        .collect();
    lookup.sort_unstable();
    let find = |key: i64| lookup.binary_search_by_key(&key, |entry| entry.0).ok().map(|at| lookup[at].1);
    let (mut sum, mut count) = (0.0, 0);
    for &(key, i) in &lookup {
        let around: Vec<usize> =
            [1, -1, 1_000, -1_000, 1_000_000, -1_000_000].iter().filter_map(|d| find(key + d)).collect();
        if around.len() == 6 {
            let mean = around.iter().map(|&j| solid.state.displacement[j]).sum::<DVec3>() / 6.0;
            sum += (solid.state.displacement[i] - mean).length_squared();
            count += 1;
        }
    }
    (sum / f64::from(count)).sqrt() / spacing
}

fn twist(omega: f64) -> impl Fn(DVec3) -> DVec3 {
    move |x| omega * (std::f64::consts::PI * x.x.max(0.0) / 12.0).sin() * DVec3::new(0.0, -x.z, x.y)
}

/// The usual variant, by what it must not show: a pattern, lost energy, collapse.
#[test]
#[ignore = "minutes: 0.5 s of 1 500 particles, three Poisson ratios"]
fn a_twisting_column_shows_no_hourglass_pattern() {
    for (poisson, lost) in [(0.45, 0.05), (0.49, 0.09), (0.499, 0.20)] {
        let mut solid = column::<f64>(6, -0.5, poisson, usual(), twist(105.0));
        let begin = solid.energies().kinetic;
        let (mut hourglass, mut pattern, mut low, mut high) = (0.0_f64, 0.0_f64, 6.0_f64, 6.0_f64);
        let tip = nearest(&solid, DVec3::new(6.0, 0.08, 0.08));
        for _ in 0..50 {
            solid.advance(0.01).expect("published to be stable");
            let energies = solid.energies();
            hourglass = hourglass.max(energies.hourglass / energies.strain);
            pattern = pattern.max(zigzag(&solid));
            let x = solid.state.position(tip).x;
            (low, high) = (low.min(x), high.max(x));
        }
        let energies = solid.energies();
        println!(
            "nu {poisson}: zigzag {pattern:.3} dp, hourglass / strain {hourglass:.4}, tip {low:.2} to {high:.2} m, lost {:.3}, \
             not accounted for {:+.4}",
            energies.dissipated / begin,
            energies.balance() / begin - 1.0
        );
        assert!(pattern < 0.1, "nu {poisson}: {pattern}");
        assert!(hourglass < 0.02, "nu {poisson}: {hourglass}");
        assert!(energies.dissipated / begin < lost, "nu {poisson}");
        assert!((energies.balance() / begin - 1.0).abs() < 0.02, "nu {poisson}");
    }
}

/// The extreme variant of 400 rad/s: it stays whole and accounts for its energy. It does not follow the published track, whose
/// scheme takes shear between pairs; with the hourglass control as stiff as the shear the swings are the same, and smaller.
#[test]
#[ignore = "two minutes: 0.5 s of 6 400 particles, twice"]
fn a_column_twisted_violently_stays_whole() {
    let Some(data) = data() else { return };
    let track = table(&data.join("reference/tlsph_solids/twisting_column_sphinxsys_tip.csv"));
    let (damped, hourglass) = usual();
    for (damping, hourglass) in [(damped, hourglass), (0.0, 1.0 / 1.45)] {
        let mut solid = column::<f32>(10, -0.5, 0.45, (damping, hourglass), twist(400.0));
        let begin = solid.energies().kinetic;
        let tip = nearest(&solid, DVec3::new(6.0, 0.0, 0.0));
        let (mut time, mut error) = (0.0, 0.0_f64);
        for row in &track[1..] {
            let dt = row[0] * 0.5 / 3126.0 - time;
            solid.advance(dt).expect("published to be stable");
            time += dt;
            let x = solid.state.position(tip).x - solid.state.reference_position[tip].x + track[0][1];
            error = error.max((x - row[1]).abs());
            if (row[0] as usize).is_multiple_of(200) {
                println!("t {time:.3} s: tip {x:.3} m, track {:.3} m", row[1]);
            }
        }
        let energies = solid.energies();
        println!(
            "damping {damping}, hourglass {hourglass:.2}: largest distance {error:.3} m, energy lost {:.3}, not accounted for \
             {:+.4}",
            energies.dissipated / begin,
            energies.balance() / begin - 1.0
        );
        assert!((energies.balance() / begin - 1.0).abs() < 0.05);
    }
}

//! A made-up run of about 20 000 particles: a bent pipe with a side branch, parabolic profiles, pulsating flow.

mod wall;

use glam::DVec3;
use std::f64::consts::TAU;
use std::path::Path;
use vaso_io::{
    CycleSummary, EffectEntry, EndReason, EnergySummary, Frame, IoError, Numbers, OpeningCycleSummary,
    OpeningEntry, OpeningSummary, ParticleCounts, PeriodicitySummary, PressureDropSummary, SeriesWriter,
    Stability, Status, StepCounts, Summary, SurfaceReport, Table,
};

/// Particle spacing [m].
const SPACING: f64 = 4.5e-4;
const PERIOD: f64 = 0.8;
const FRAMES: usize = 9;

/// A limb: centreline points and radius [m], mean speed at rest of the pulse [m/s].
struct Limb {
    line: Vec<DVec3>,
    radius: f64,
    speed: f64,
}

fn limbs() -> Vec<Limb> {
    let arc = (0..=40).map(|k| {
        let angle = -0.7 + 1.4 * f64::from(k) / 40.0;
        DVec3::new(0.03 * angle.sin(), 0.012 * (angle * 2.0).sin() * 0.6, 0.03 * angle.cos() - 0.02)
    });
    let branch = (0..=20)
        .map(|k| DVec3::new(0.004, 0.0, 0.009) + DVec3::new(0.006, 0.004, 0.009) * (f64::from(k) / 20.0));
    vec![
        Limb { line: arc.collect(), radius: 0.0032, speed: 0.25 },
        Limb { line: branch.collect(), radius: 0.0022, speed: 0.18 },
    ]
}

/// Centres and outward normals of the inlet, the outlet and the branch.
fn mouths() -> [(DVec3, DVec3); 3] {
    let limbs = limbs();
    let end = |at: DVec3, before: DVec3| (at, (at - before).normalize());
    let last = |line: &[DVec3]| end(line[line.len() - 1], line[line.len() - 2]);
    [end(limbs[0].line[0], limbs[0].line[1]), last(&limbs[0].line), last(&limbs[1].line)]
}

/// Distance to a centreline and its direction at the nearest point.
fn nearest(line: &[DVec3], x: DVec3) -> (f64, DVec3, f64) {
    let mut best = (f64::INFINITY, DVec3::X, 0.0);
    for (k, pair) in line.windows(2).enumerate() {
        let along = pair[1] - pair[0];
        let part = (x - pair[0]).dot(along) / along.length_squared();
        // Flat ends: no point beyond them belongs to the limb.
        if (k == 0 && part < 0.0) || (k + 2 == line.len() && part > 1.0) {
            continue;
        }
        let distance = (x - pair[0] - part.clamp(0.0, 1.0) * along).length();
        if distance < best.0 {
            let place = (k as f64 + part.clamp(0.0, 1.0)) / (line.len() - 1) as f64;
            best = (distance, along.normalize(), place);
        }
    }
    best
}

/// Writes `fluid.vtkhdf`, `wall.vtkhdf`, `openings.csv` and `summary.json` of a finished run.
pub(crate) fn write(out: &Path) -> Result<(), IoError> {
    let limbs = limbs();
    let mut position = Vec::new();
    let mut rest_velocity = Vec::new();
    let mut drop = Vec::new();
    let range = |reach: f64| (-(reach / SPACING) as i64)..=((reach / SPACING) as i64);
    for (i, j, k) in
        range(0.025).flat_map(|i| range(0.015).flat_map(move |j| range(0.025).map(move |k| (i, j, k))))
    {
        let x = DVec3::new(i as f64, j as f64, k as f64) * SPACING;
        // The limb in whose middle the particle lies most.
        let inside = limbs.iter().map(|limb| (nearest(&limb.line, x), limb));
        let best = inside.min_by(|(a, p), (b, q)| (a.0 / p.radius).total_cmp(&(b.0 / q.radius)));
        if let Some(((distance, direction, place), limb)) = best
            && distance < limb.radius - 0.4 * SPACING
        {
            // A little disorder, as particles have it.
            let phase = (i * 31 + j * 17 + k * 7) as f64;
            position
                .push(x + 0.12 * SPACING * DVec3::new(phase.sin(), (2.0 * phase).sin(), (3.0 * phase).cos()));
            rest_velocity.push(direction * 2.0 * limb.speed * (1.0 - (distance / limb.radius).powi(2)));
            drop.push(place);
        }
    }
    let ids: Vec<u64> = (0..position.len() as u64).collect();

    let mut series = SeriesWriter::create(out.join("fluid.vtkhdf"));
    for step in 0..FRAMES {
        let time = PERIOD * step as f64 / (FRAMES - 1) as f64;
        let velocity: Vec<DVec3> = rest_velocity.iter().map(|&v| v * pulse(time - 0.55)).collect();
        let pressure: Vec<f64> =
            drop.iter().map(|place| 11_000.0 + 900.0 * pulse(time) - 260.0 * place).collect();
        let density: Vec<f64> = pressure.iter().map(|p| 1060.0 + p / 144.0).collect();
        series.append(&Frame {
            time,
            position: &position,
            scalars: vec![("Pressure", &pressure), ("Density", &density)],
            vectors: vec![("Velocity", &velocity)],
            ids: Some(&ids),
        })?;
    }

    let names = ["inlet", "outlet", "branch <left>"];
    let header: Vec<String> = std::iter::once("time_s".to_owned())
        .chain(names.iter().flat_map(|name| [format!("{name}.flow_m3_s"), format!("{name}.pressure_pa")]))
        .collect();
    let mut table = Table::create(out.join("openings.csv"), &header)?;
    for step in 0..=1600 {
        let time = PERIOD * f64::from(step) / 1600.0;
        let flow = 8e-6 * pulse(time);
        let noise = 4e-8 * (f64::from(step) * 2.7).sin();
        table.append(&[
            time,
            -flow + noise,
            12_000.0 + 900.0 * pulse(time),
            0.7 * flow - noise,
            11_800.0 + 880.0 * pulse(time - 0.01),
            0.3 * flow,
            if step < 30 { f64::NAN } else { 11_700.0 + 860.0 * pulse(time - 0.015) },
        ])?;
    }
    let mut summary = summary(position.len() as u64, &names);
    summary.wall = Some(wall::write(out)?);
    summary.write(&out.join("summary.json"))
}

/// A heartbeat around 1.
fn pulse(time: f64) -> f64 {
    let phase = time / PERIOD;
    let peak = |center: f64, width: f64| (-((phase - phase.floor() - center) / width).powi(2)).exp();
    0.55 + 1.6 * peak(0.22, 0.09) + 0.35 * peak(0.52, 0.08) + 0.05 * (TAU * phase).sin()
}

fn cycle(index: u64, names: &[&str]) -> CycleSummary {
    let change = [0.31, 0.042, 0.006].get(index as usize - 1).copied();
    let opening = |(name, share): (&&str, f64)| OpeningCycleSummary {
        name: (*name).to_owned(),
        mean_flow_m3_s: share * 8e-6,
        min_flow_m3_s: share.min(0.0) * 16e-6 + share.max(0.0) * 3e-6,
        max_flow_m3_s: share.max(0.0) * 16e-6 + share.min(0.0) * 3e-6,
        mean_pressure_pa: 12_400.0,
        systolic_pressure_pa: 15_900.0,
        diastolic_pressure_pa: 10_300.0,
        pulse_pressure_pa: 5_600.0,
        flow_split: (share > 0.0).then_some(share),
        pulsatility_index: Some(1.6),
        resistive_index: Some(0.81),
    };
    CycleSummary {
        index,
        start_s: PERIOD * index as f64,
        end_s: PERIOD * (index + 1) as f64,
        openings: names.iter().zip([-1.0, 0.7, 0.3]).map(opening).collect(),
        periodicity: change.map(|flow| PeriodicitySummary {
            flow,
            pressure: 0.6 * flow,
            wall_shear: Some(1.4 * flow),
        }),
        mass_balance_error: Some(0.0011),
        pressure_drops: vec![PressureDropSummary {
            proximal: names[0].to_owned(),
            distal: names[2].to_owned(),
            mean_pa: 310.0,
            min_pa: -90.0,
            max_pa: 840.0,
            fractional_flow_reserve: Some(0.975),
        }],
        mean_tawss_pa: Some(1.31),
    }
}

fn summary(fluid: u64, names: &[&str]) -> Summary {
    let effect = |name: &str, on, called_for, reason: &str, seconds, bytes| EffectEntry {
        name: name.into(),
        on,
        called_for,
        reason: reason.into(),
        seconds: Some(seconds),
        bytes: Some(bytes),
    };
    let shares = [(-8e-6, 3.2e-5), (5.6e-6, 3.2e-5), (2.4e-6, 1.5e-5)];
    Summary {
        vaso_version: "0.1.0".into(),
        status: Status::Completed,
        case: "Bent pipe with a branch & parabolic profiles".into(),
        time_s: PERIOD,
        wall_clock_s: 754.0,
        threads: 2,
        particles: ParticleCounts { fluid, wall: 9120, shell: 0 },
        steps: StepCounts { advection: 5120, acoustic: 25_010, solid: 0 },
        particle_substeps_per_s: 9.1e6,
        spacing_m: SPACING,
        sound_speed_m_s: 12.0,
        precision: "mixed".into(),
        stability: Stability {
            max_density_error: 0.008,
            max_mach: 0.09,
            escaped_particles: 3,
            mass_balance_error: 0.004,
            energy_growth: f64::NAN,
            ..Default::default()
        },
        openings: names
            .iter()
            .zip(shares)
            .zip(mouths())
            .map(|((name, (flow, area)), (center, normal))| OpeningSummary {
                opening: OpeningEntry {
                    name: (*name).to_owned(),
                    center_m: center.to_array(),
                    normal: normal.to_array(),
                    area_m2: area,
                    radius_m: (area / std::f64::consts::PI).sqrt(),
                },
                mean_flow_m3_s: flow,
                mean_pressure_pa: 12_100.0,
            })
            .collect(),
        effects: vec![
            effect("fluid.pressure", true, true, "blood is present", 402.0, 9_000_000),
            effect("fluid.viscosity", true, true, "blood is present", 121.0, 0),
            effect("neighbours", true, true, "particles move", 96.0, 31_000_000),
            effect("openings.buffers", true, true, "three openings", 20.0, 800_000),
            effect(
                "wall.shell",
                false,
                true,
                "the wall is given as rigid, but a radial strain of 6 % is expected",
                0.0,
                0,
            ),
            effect("output", true, true, "a frame every 100 ms", 11.0, 0),
        ],
        end_reason: Some(EndReason::Periodic),
        cycles: (1..=3).map(|index| cycle(index, names)).collect(),
        energy: Some(EnergySummary {
            inflow_j: 2.1e-3,
            throughput_j: 0.19,
            dissipated_j: 1.4e-3,
            kinetic_change_j: 2e-5,
            residual_j: 6.8e-4,
            relative_residual: Some(0.0036),
            damped_backflow_j: Some(1.2e-5),
        }),
        surface: Some(SurfaceReport {
            triangles: 15_068,
            volume_m3: 1.86683e-6,
            area_m2: 1.32166e-3,
            watertight: true,
            components: 1,
            self_intersections: 0,
            repairs: vec!["reversed all triangles".into()],
            unit: "mm".into(),
        }),
        numbers: Some(Numbers {
            reynolds_peak: Some(420.0),
            womersley: Some(4.7),
            radial_strain: Some(0.057),
            sound_speed_m_s: Some(12.0),
        }),
        warnings: vec!["`wall.model` is \"rigid\" though the scene calls for a deformable wall".into()],
        ..Default::default()
    }
}

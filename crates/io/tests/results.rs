//! The JSON files keep to the names promised to scripts, and stay JSON when numbers are missing.

use serde_json::{Value, json};
use vaso_io::{
    CheckReport, CycleSummary, Distribution, EffectEntry, EndReason, EnergySummary, Numbers,
    OpeningCycleSummary, OpeningEntry, OpeningSummary, ParticleCounts, ParticlesReport, PeriodicitySummary,
    Predicted, PressureDropSummary, Quality, Stability, Status, StepCounts, Summary, SurfaceReport,
    WallSummary,
};

/// Every key of `promised` is in `written` with a value of the same kind; arrays are compared by their first
/// entry.
fn holds(written: &Value, promised: &Value, place: &str) {
    match (written, promised) {
        (Value::Object(written), Value::Object(promised)) => {
            for (key, value) in promised {
                let found = written.get(key).unwrap_or_else(|| panic!("{place}.{key} is missing"));
                holds(found, value, &format!("{place}.{key}"));
            }
        }
        (Value::Array(written), Value::Array(promised)) => {
            if let (Some(written), Some(promised)) = (written.first(), promised.first()) {
                holds(written, promised, &format!("{place}[0]"));
            }
        }
        (Value::Number(_), Value::Number(_))
        | (Value::String(_), Value::String(_))
        | (Value::Bool(_), Value::Bool(_))
        | (Value::Null, Value::Null) => {}
        _ => panic!("{place} is {written}, promised is something like {promised}"),
    }
}

fn opening() -> OpeningEntry {
    OpeningEntry {
        name: "cca".into(),
        center_m: [0.0, 0.0, -0.02],
        normal: [0.0, 0.0, -1.0],
        area_m2: 3.0917e-5,
        radius_m: 3.137e-3,
    }
}

fn surface() -> SurfaceReport {
    SurfaceReport {
        triangles: 15068,
        volume_m3: 1.86683e-6,
        area_m2: 1.32166e-3,
        watertight: true,
        components: 1,
        self_intersections: 0,
        repairs: vec!["reversed all triangles".into()],
        unit: "mm".into(),
    }
}

fn effect() -> EffectEntry {
    EffectEntry {
        name: "wall.shell".into(),
        on: true,
        called_for: true,
        reason: "soft".into(),
        ..Default::default()
    }
}

fn summary() -> Summary {
    Summary {
        vaso_version: "0.1.0".into(),
        status: Status::Completed,
        case: "Carotid \"left\"".into(),
        time_s: 1.0,
        wall_clock_s: 93.2,
        threads: 2,
        particles: ParticleCounts { fluid: 110_023, wall: 0, shell: 18_112 },
        steps: StepCounts { advection: 5120, acoustic: 25_010, solid: 0 },
        particle_substeps_per_s: 9.1e6,
        spacing_m: 5e-4,
        sound_speed_m_s: 12.0,
        precision: "mixed".into(),
        stability: Stability { max_density_error: 0.008, max_mach: 0.09, ..Default::default() },
        openings: vec![OpeningSummary {
            opening: opening(),
            mean_flow_m3_s: -6.1e-6,
            mean_pressure_pa: 12_000.0,
        }],
        effects: vec![EffectEntry { seconds: Some(31.0), bytes: Some(5_242_880), ..effect() }],
        surface: Some(surface()),
        numbers: Some(Numbers { reynolds_peak: Some(420.0), ..Default::default() }),
        ..Default::default()
    }
}

fn parsed(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn summary_has_the_promised_names() {
    let promised = json!({
        "vaso_version": "", "status": "completed", "case": "", "message": null,
        "time_s": 1.0, "wall_clock_s": 93.2, "threads": 2,
        "particles": {"fluid": 1, "wall": 0, "shell": 1},
        "steps": {"advection": 1, "acoustic": 1, "solid": 0},
        "particle_substeps_per_s": 9.1e6,
        "spacing_m": 5e-4, "sound_speed_m_s": 12.0, "precision": "mixed",
        "stability": {"max_density_error": 0.008, "max_mach": 0.09, "escaped_particles": 0, "non_finite": 0,
                      "mass_balance_error": 0.004, "energy_growth": 0.0},
        "openings": [{"name": "cca", "area_m2": 3.1e-5, "center_m": [0.0], "normal": [0.0],
                      "mean_flow_m3_s": -6.1e-6, "mean_pressure_pa": 12000.0}],
        "effects": [{"name": "", "on": true, "reason": "", "seconds": 31.0, "bytes": 5_242_880}]
    });
    let written = parsed(&summary().to_json());
    holds(&written, &promised, "summary");
    assert_eq!(written["status"], "completed");
    assert_eq!(written["particles"]["fluid"], 110_023);
}

fn pulsatile_summary() -> Summary {
    let opening = OpeningCycleSummary {
        name: "ica".into(),
        mean_flow_m3_s: 4e-6,
        flow_split: Some(0.67),
        pulsatility_index: Some(1.1),
        ..Default::default()
    };
    let drop = PressureDropSummary {
        proximal: "cca".into(),
        distal: "ica".into(),
        mean_pa: 120.0,
        fractional_flow_reserve: Some(0.99),
        ..Default::default()
    };
    let cycle = CycleSummary {
        index: 1,
        start_s: 0.8,
        end_s: 1.6,
        openings: vec![opening],
        periodicity: Some(PeriodicitySummary { flow: 0.004, pressure: 0.02, wall_shear: Some(0.01) }),
        mass_balance_error: Some(1e-3),
        pressure_drops: vec![drop],
        mean_tawss_pa: Some(1.2),
    };
    let tawss = Distribution { mean: 1.2, percentile_1: 0.1, median: 1.0, percentile_99: 4.0, missing: 0.0 };
    Summary {
        end_reason: Some(EndReason::Periodic),
        cycles: vec![cycle],
        energy: Some(EnergySummary { inflow_j: 1e-3, relative_residual: Some(0.03), ..Default::default() }),
        wall: Some(WallSummary { points: 5000, tawss_pa: Some(tawss), cycle: Some(1), ..Default::default() }),
        ..summary()
    }
}

#[test]
fn cycles_energy_and_wall_stand_in_the_summary_where_there_are_any() {
    let promised = json!({
        "end_reason": "periodic",
        "cycles": [{"index": 1, "start_s": 0.8, "end_s": 1.6, "mass_balance_error": 1e-3, "mean_tawss_pa": 1.2,
            "openings": [{"name": "ica", "mean_flow_m3_s": 4e-6, "min_flow_m3_s": 0.0, "max_flow_m3_s": 0.0,
                "mean_pressure_pa": 0.0, "systolic_pressure_pa": 0.0, "diastolic_pressure_pa": 0.0,
                "pulse_pressure_pa": 0.0, "flow_split": 0.67, "pulsatility_index": 1.1}],
            "periodicity": {"flow": 0.004, "pressure": 0.02, "wall_shear": 0.01},
            "pressure_drops": [{"proximal": "cca", "distal": "ica", "mean_pa": 120.0, "min_pa": 0.0, "max_pa": 0.0,
                "fractional_flow_reserve": 0.99}]}],
        "energy": {"inflow_j": 1e-3, "throughput_j": 0.0, "dissipated_j": 0.0, "kinetic_change_j": 0.0,
            "residual_j": 0.0, "relative_residual": 0.03},
        "wall": {"points": 5000, "triangles": 0, "area_m2": 0.0, "counted_area_m2": 0.0, "cycle": 1,
            "tawss_pa": {"mean": 1.2, "percentile_1": 0.1, "median": 1.0, "percentile_99": 4.0, "missing": 0.0}}
    });
    let written = parsed(&pulsatile_summary().to_json());
    holds(&written, &promised, "summary");
    assert_eq!(written["end_reason"], "periodic");
    assert!(written["cycles"][0]["openings"][0].get("resistive_index").is_none());

    let steady = parsed(&summary().to_json());
    for name in ["end_reason", "cycles", "energy", "wall"] {
        assert!(steady.get(name).is_none(), "{name} is there without a value");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    pulsatile_summary().write(&path).unwrap();
    assert_eq!(Summary::read(&path).unwrap(), pulsatile_summary());
}

#[test]
fn check_has_the_promised_names() {
    let report = CheckReport {
        surface: surface(),
        openings: vec![opening()],
        numbers: Some(Numbers {
            reynolds_peak: Some(420.0),
            womersley: Some(4.7),
            radial_strain: Some(0.057),
            sound_speed_m_s: Some(33.0),
        }),
        effects: vec![effect()],
        predicted: Some(Predicted { memory_bytes: 90_000_000, wall_clock_s: 210.0, ..Default::default() }),
        warnings: vec!["thin".into()],
    };
    let promised = json!({
        "surface": {"triangles": 1, "volume_m3": 1.0, "area_m2": 1.0, "watertight": true,
                    "components": 1, "repairs": [""], "unit": "mm"},
        "openings": [{"name": "cca", "center_m": [0.0], "normal": [0.0], "area_m2": 3e-5, "radius_m": 3e-3}],
        "numbers": {"reynolds_peak": 420.0, "womersley": 4.7, "radial_strain": 0.057, "sound_speed_m_s": 33.0},
        "effects": [{"name": "wall.shell", "on": true, "called_for": true, "reason": ""}],
        "predicted": {"particles": {"fluid": 1, "wall": 0, "shell": 1}, "memory_bytes": 1, "wall_clock_s": 210.0},
        "warnings": [""]
    });
    let written = parsed(&report.to_json());
    holds(&written, &promised, "check");
    // What a plan does not know yet is absent, not zero.
    assert!(written["effects"][0].get("seconds").is_none());
}

#[test]
fn particles_have_the_promised_names() {
    let quality = Quality {
        count: 2,
        kernel_sum_mean: Some(1.0),
        kernel_sum_std: Some(0.01),
        seconds: Some(1.5),
        ..Default::default()
    };
    let report = ParticlesReport {
        surface: surface(),
        quality: [("fluid".to_owned(), quality)].into(),
        ..Default::default()
    };
    let promised = json!({
        "surface": {"triangles": 1}, "openings": [], "particles": {"fluid": 1},
        "quality": {"fluid": {
            "count": 1, "volume_error": 0.0, "nearest_neighbor_min": 0.0, "nearest_neighbor_cv": 0.0,
            "kernel_sum_mean": 1.0, "kernel_sum_std": 0.0, "gradient_residual_rms": 0.0, "volume_cv": 0.0,
            "outside": 0, "seconds": 0.0, "iterations": 0
        }}
    });
    holds(&parsed(&report.to_json()), &promised, "particles");
}

#[test]
fn numbers_that_do_not_exist_are_null_and_come_back_as_nan() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("summary.json");
    let mut broken = summary();
    broken.status = Status::Failed;
    broken.message = Some("diverged at 0.2 s".into());
    broken.stability.max_mach = f64::INFINITY;
    broken.stability.energy_growth = f64::NAN;
    broken.openings[0].opening.center_m[1] = f64::NAN;
    broken.write(&path).unwrap();

    let text = std::fs::read_to_string(&path).unwrap();
    assert!(parsed(&text)["stability"]["max_mach"].is_null(), "{text}");
    let read = Summary::read(&path).unwrap();
    assert!(read.stability.max_mach.is_nan() && read.stability.energy_growth.is_nan());
    assert!(read.openings[0].opening.center_m[1].is_nan());
    assert_eq!(read.openings[0].mean_flow_m3_s, -6.1e-6);
    assert_eq!((read.status, read.message.as_deref()), (Status::Failed, Some("diverged at 0.2 s")));

    summary().write(&path).unwrap();
    assert_eq!(Summary::read(&path).unwrap(), summary());
    std::fs::write(&path, &text[..text.len() / 2]).unwrap();
    let error = Summary::read(&path).unwrap_err().to_string();
    assert!(error.contains("summary.json") && error.contains("line"), "{error}");
}

//! The plan as a person reads it, before the run and with the cost after it.

use crate::case::Case;
use crate::ledger::{Ledger, Stage};
use crate::plan::Plan;
use crate::quality::generator_name;
use std::fmt::Write;
use vaso_boundary::{Condition, Signal, Source};
use vaso_scene::Word;
use vaso_units::significant;

/// The geometry audit, in lines.
pub fn audit(vessel: &vaso_geometry::Vessel, file: &std::path::Path) -> String {
    let a = &vessel.audit;
    let mut out = String::new();
    let _ = writeln!(
        out,
        "surface  {} · {} triangles · {:.2} mm3 · {:.2} mm2 · {}",
        file.display(),
        vessel.surface.triangles.len(),
        vessel.surface.volume() * 1e9,
        vessel.surface.area() * 1e6,
        if a.watertight { "watertight" } else { "not watertight" },
    );
    for repair in &a.repairs {
        let _ = writeln!(out, "repair   {repair}");
    }
    out
}

/// The plan, in lines.
pub fn plan(case: &Case, plan: &Plan) -> String {
    let mut out = String::new();
    let n = &plan.numbers;
    let p = plan.expected();
    let viscosity = match n.rheology {
        None => format!("{:.3}", 1e3 * n.viscosity),
        Some(law) => {
            let [thick, thin] = law.extremes().map(|eta| 1e3 * eta);
            format!("{thin:.3} to {thick:.3}")
        }
    };
    let _ = writeln!(
        out,
        "plan     {} · {} · {} · {} threads · seed {}",
        case.scene.title,
        plan.precision.word(),
        plan.isa.name(),
        rayon::current_num_threads(),
        case.scene.numerics.seed
    );
    let _ = writeln!(
        out,
        "bodies   blood   fluid {:>9}   {}   spacing {:.3} mm   density {} kg/m3   viscosity {} mPa s",
        p.particles.fluid,
        generator_name(case.scene.particles.generator),
        n.spacing * 1e3,
        n.rest_density,
        viscosity
    );
    let kind = match (&plan.wall, &plan.shell) {
        (Some(wall), _) => format!(
            "solid, {:.1} layers   spacing {:.3} mm   density {} kg/m3   pulse wave {}",
            wall.layers(),
            wall.numbers.spacing * 1e3,
            wall.numbers.density,
            wall.pulse
        ),
        (None, Some(shell)) => format!(
            "deforms, {:.3} mm thick   spacing {:.3} mm   density {} kg/m3   pulse wave {}",
            shell.thickness * 1e3,
            shell.numbers.spacing * 1e3,
            shell.numbers.density,
            shell.pulse
        ),
        (None, None) if p.particles.shell > 0 => "rigid, one layer with ghosts behind it".to_owned(),
        (None, None) => "rigid, four layers".to_owned(),
    };
    let (body, n_wall) =
        if p.particles.shell > 0 { ("shell", p.particles.shell) } else { ("wall", p.particles.wall) };
    let _ = writeln!(out, "         vessel  {body:<5} {n_wall:>9}   {kind}");
    let reach = n.smoothing_length / n.spacing * 2.0;
    let _ = writeln!(
        out,
        "links    blood←blood about {:.0} a particle · blood←vessel and vessel←blood within {reach:.1} spacings; found anew \
         each advective step",
        4.0 / 3.0 * std::f64::consts::PI * reach.powi(3)
    );
    for o in &plan.openings {
        let _ = writeln!(
            out,
            "opening  {:<10} {:7.3} mm2  radius {:.3} mm  {}",
            o.name,
            o.opening.area * 1e6,
            o.opening.radius * 1e3,
            condition(&o.condition)
        );
    }
    let _ = writeln!(
        out,
        "numbers  Reynolds {:.0}{}{} · density blend {}",
        plan.reynolds_peak,
        plan.womersley.map_or(String::new(), |w| format!(" · Womersley {w:.1}")),
        plan.radial_strain.map_or(String::new(), |e| format!(" · radial strain {:.1} %", 100.0 * e)),
        n.density_blend
    );
    let _ = writeln!(out, "sound    {:.3} m/s: {}", n.sound_speed, plan.sound_speed_reason);
    let _ = writeln!(
        out,
        "pressure {}",
        plan.reference_pressure.map_or_else(
            || "the first pressure outlet is the reference, or else the common pressure of the outlet models: the uniform part stays \
             out of the equation of state".to_owned(),
            |p| {
                let why = if plan.deforms() { "at all times, as the wall deforms" } else { "as given in the case" };
                format!("relative to {p} Pa{}{why}", if plan.deforms() { " " } else { ", " })
            },
        )
    );
    let _ = writeln!(
        out,
        "advect   exchange · sort · rows · summation · viscosity{} · guard   at most {:.3} ms",
        if n.transport_velocity { " · transport" } else { "" },
        1e3 * n.advective_step(0.0, 0.0)
    );
    let _ = writeln!(
        out,
        "acoustic wall pressure · momentum · openings · continuity   about {:.1} us",
        1e6 * n.acoustic_step(0.5 * n.reference_speed)
    );
    for e in &plan.effects {
        let against = match (e.on, e.called_for) {
            (false, true) => "; called for",
            (true, false) => "; not called for",
            _ => "",
        };
        let state = if e.on { "effect" } else { "absent" };
        let _ = writeln!(out, "{state:<8} {:<26} {}{against}", e.name, e.reason);
    }
    let _ = writeln!(
        out,
        "cost     about {} and {:.0} MB for {} s of flow",
        duration(p.wall_clock_s),
        p.memory_bytes as f64 / 1e6,
        plan.end_time
    );
    for w in &plan.warnings {
        let _ = writeln!(out, "warning  {w}");
    }
    out
}

fn condition(c: &Condition) -> String {
    match c {
        Condition::Velocity { profile, mean } => {
            let ramp = significant(1e3 * mean.ramp);
            format!("velocity {}, {profile:?} profile, ramp {ramp} ms", signal(mean, "m/s"))
                .replace("Plug", "plug")
                .replace("Parabolic", "parabolic")
                .replace("FullyDeveloped", "fully developed")
        }
        Condition::Pressure { value } => format!("pressure {}", signal(value, "Pa")),
        Condition::Resistance { resistance, distal_pressure } => {
            format!("resistance {resistance:.4e} Pa s/m3 over {} Pa", significant(*distal_pressure))
        }
        Condition::Windkessel { model, initial_pressure } => format!(
            "windkessel Rp {:.4e} Rd {:.4e} Pa s/m3, C {:.4e} m3/Pa over {} Pa, from {initial_pressure:.0} Pa",
            model.proximal_resistance,
            model.distal_resistance,
            model.compliance,
            significant(model.distal_pressure)
        ),
    }
}

fn signal(s: &Signal, unit: &str) -> String {
    match &s.source {
        Source::Constant(v) => format!("{} {unit}", significant(*v)),
        Source::Waveform(w) => {
            let (low, high) = w.range();
            format!("waveform from {} to {} {unit}", significant(low), significant(high))
        }
    }
}

/// A time span as people say it.
pub fn duration(seconds: f64) -> String {
    if seconds < 100.0 {
        format!("{seconds:.1} s")
    } else if seconds < 6000.0 {
        format!("{:.1} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}

/// A length \[m\] as people say it, to three digits.
pub fn length(metres: f64) -> String {
    let (value, unit) = match metres {
        x if x >= 1.0 => (x, "m"),
        x if x >= 1e-3 => (1e3 * x, "mm"),
        x => (1e6 * x, "um"),
    };
    let decimals = (2.0 - value.max(1e-9).log10().floor()).clamp(0.0, 9.0) as usize;
    format!("{value:.decimals$} {unit}")
}

/// The stages that ran, with what they cost.
pub fn ledger(ledger: &Ledger, particle_substeps: u64) -> String {
    let total = ledger.total();
    let mut out = String::new();
    for (stage, spent) in Stage::ALL.map(|s| (s, ledger.seconds(s))) {
        if spent == 0.0 {
            continue;
        }
        let _ = writeln!(
            out,
            "stage    {:<18} {:9.2} s  {:5.1} %  {:6.1} ns a particle and acoustic step",
            stage.name(),
            spent,
            100.0 * spent / total.max(f64::MIN_POSITIVE),
            1e9 * spent / particle_substeps.max(1) as f64
        );
    }
    out
}

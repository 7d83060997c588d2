//! `vaso particles`: surface to particles, with their quality.

use crate::case::Case;
use crate::error::DriverError;
use crate::progress::Progress;
use crate::results::{opening_entry, surface_report};
use crate::run::Talk;
use crate::world::{Bodies, generation_settings};
use crate::{print, supported};
use std::path::Path;
use vaso_generation::Body;
use vaso_io::particles::{BodyKind, BodyParticles, write_particles};
use vaso_io::{OutputDir, ParticleCounts, ParticlesReport, Quality};

/// Generates the particles of a case and writes `particles.vtkhdf` and `particles.json` into `out`.
///
/// # Errors
/// When the case is wrong or the folder cannot be written.
pub fn particles(case: &Case, out: &Path, talk: &Talk) -> Result<ParticlesReport, DriverError> {
    supported::check(case)?;
    talk.say(&print::audit(&case.vessel, &case.scene.geometry.surface));
    let mut progress = Progress::new(talk.quiet);
    let bodies = Bodies::make(case, |body, step, moved| progress.relaxation(body, step, moved))?;
    progress.finish();
    let out = OutputDir::open(out)?;
    write_particles(
        &out.file("particles.vtkhdf"),
        &[
            BodyParticles {
                kind: BodyKind::Fluid,
                position: &bodies.fluid.position,
                volume: &bodies.fluid.volume,
                normal: &bodies.fluid.normal,
                depth: &bodies.fluid.depth,
            },
            BodyParticles {
                kind: BodyKind::Wall,
                position: &bodies.wall.position,
                volume: &bodies.wall.volume,
                normal: &bodies.wall.normal,
                depth: &bodies.wall.depth,
            },
        ],
    )?;
    let settings = generation_settings(&case.scene);
    let quality = |body: &Body, seconds: f64| {
        let q = &body.quality;
        Quality {
            count: q.count as u64,
            volume_error: q.volume_error,
            nearest_neighbor_min: q.nearest_neighbor_min,
            nearest_neighbor_cv: q.nearest_neighbor_cv,
            kernel_sum_mean: q.kernel_sum_mean,
            kernel_sum_std: q.kernel_sum_std,
            gradient_residual_rms: q.gradient_residual_rms,
            volume_cv: q.volume_cv,
            outside: q.outside as u64,
            seconds: Some(seconds),
            iterations: q.iterations as u64,
        }
    };
    let doubts = vaso_generation::warnings(&case.vessel, &settings);
    let warnings = doubts.iter().map(ToString::to_string);
    let report = ParticlesReport {
        vaso_version: env!("CARGO_PKG_VERSION").into(),
        case: case.scene.title.clone(),
        generator: "relaxed-lattice".into(),
        spacing_m: settings.spacing,
        surface: surface_report(&case.vessel),
        openings: case
            .vessel
            .openings
            .iter()
            .enumerate()
            .map(|(k, o)| opening_entry(&case.opening_name(k), o))
            .collect(),
        particles: ParticleCounts {
            fluid: bodies.fluid.position.len() as u64,
            wall: bodies.wall.position.len() as u64,
            shell: 0,
        },
        quality: [
            ("fluid".to_owned(), quality(&bodies.fluid, bodies.seconds[0])),
            ("wall".to_owned(), quality(&bodies.wall, bodies.seconds[1])),
        ]
        .into(),
        warnings: case.vessel.audit.notices.iter().cloned().chain(warnings).collect(),
    };
    report.write(&out.file("particles.json"))?;
    for (name, q) in &report.quality {
        talk.say(&format!(
            "{name:<8} {} particles · nearest neighbour {:.3} min, {:.4} variation · volume error {:.2e} · {} outside · \
             {} steps",
            q.count, q.nearest_neighbor_min, q.nearest_neighbor_cv, q.volume_error, q.outside, q.iterations
        ));
    }
    Ok(report)
}

//! `vaso particles`: surface to particles, with their quality.

use crate::bodies::{FluidBody, Made, Maker, shell_settings, wall_shape};
use crate::case::Case;
use crate::error::DriverError;
use crate::extrusion::{self, ExtrusionRequest};
use crate::print;
use crate::progress::Progress;
use crate::quality;
use crate::results::{opening_entry, surface_report};
use crate::run::Talk;
use std::path::Path;
use vaso_generation::{Body, Ends, ShellBody, ShellReference, Wall};
use vaso_io::particles::{BodyKind, BodyParticles, write_particles};
use vaso_io::{OutputDir, ParticleCounts, ParticlesReport, ShellReport, WallReport, schema};
use vaso_scene::{OpenEnds, Word};

/// Bodies that are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// Blood.
    pub fluid: bool,
    /// Wall of several layers.
    pub wall: bool,
    /// Wall of one layer.
    pub shell: bool,
}

impl Wanted {
    /// The bodies a case calls for.
    pub fn by(case: &Case) -> Self {
        use vaso_scene::Wall::{RigidShell, Shell};
        let shell = matches!(case.scene.wall, RigidShell | Shell(_));
        Self { fluid: case.scene.blood.is_some(), wall: !shell, shell }
    }

    /// The bodies of a list such as `fluid,wall`.
    ///
    /// # Errors
    /// When a word is not the name of a body.
    pub fn listed(text: &str) -> Result<Self, DriverError> {
        let mut wanted = Self::default();
        for word in text.split(',').map(str::trim) {
            match word {
                "fluid" => wanted.fluid = true,
                "wall" => wanted.wall = true,
                "shell" => wanted.shell = true,
                _ => {
                    return Err(DriverError::input(format!(
                        "--bodies: \"{word}\" is no body; allowed: fluid, wall, shell, with commas between them"
                    )));
                }
            }
        }
        Ok(wanted)
    }
}

/// What `vaso particles` is to do.
#[derive(Clone, Debug, Default)]
pub struct ParticlesJob {
    /// Bodies wanted; `None` for those the case calls for.
    pub bodies: Option<Wanted>,
    /// Outer surface wanted.
    pub extrusion: Option<ExtrusionRequest>,
    /// Write over files that are in the way.
    pub force: bool,
}

/// Bodies that were made.
struct Bodies {
    fluid: Option<Made<FluidBody>>,
    wall: Option<Made<Wall>>,
    shell: Option<Made<ShellBody>>,
}

/// Generates the particles of a case and writes `particles.vtkhdf` and `particles.json` into `out`.
///
/// # Errors
/// When the case is wrong, a file is in the way, or the folder cannot be written. With wrong input nothing has been
/// written.
pub fn particles(
    case: &Case,
    job: &ParticlesJob,
    out: &Path,
    talk: &Talk,
) -> Result<ParticlesReport, DriverError> {
    let own = ["particles.vtkhdf", "particles.json"].map(|name| out.join(name));
    job.extrusion.as_ref().map_or(Ok(()), ExtrusionRequest::check)?;
    let outer = job.extrusion.iter().map(|e| e.file.clone());
    OutputDir::keep_clear(own.into_iter().chain(outer), job.force)?;
    talk.say(&print::audit(&case.vessel, &case.scene.geometry.surface));
    let extruded = job.extrusion.as_ref().map(|request| request.make(&case.vessel)).transpose()?;
    let bodies = make(case, job.bodies.unwrap_or_else(|| Wanted::by(case)), talk)?;

    let out = OutputDir::open(out)?;
    write_particles(&out.file("particles.vtkhdf"), &bodies.columns())?;
    let mut report = report(case, &bodies);
    if let Some((request, extruded)) = job.extrusion.as_ref().zip(extruded) {
        let unit = case.vessel.unit;
        let extrusion = request.write(&case.vessel, &extruded)?;
        talk.say(&extrusion::lines(&extrusion, &request.file, unit.metres(), unit.symbol()));
        report.extrusion = Some(extrusion);
    }
    report.write(&out.file("particles.json"))?;
    for (name, q) in &report.quality {
        talk.say(&quality::line(name, q));
    }
    if let Some(blocks) = &report.blocks {
        talk.say(&quality::blocks_line(blocks));
    }
    for warning in &report.warnings {
        talk.say(&format!("warning  {warning}"));
    }
    Ok(report)
}

/// Makes bodies; only when all of them are there does the cache get any.
fn make(case: &Case, wanted: Wanted, talk: &Talk) -> Result<Bodies, DriverError> {
    let mut progress = Progress::new(talk.quiet);
    let mut maker = Maker::new(case, |body: &str, step, moved| progress.relaxation(body, step, moved));
    let bodies = Bodies {
        fluid: wanted.fluid.then(|| maker.fluid()).transpose()?,
        wall: wanted.wall.then(|| maker.wall()).transpose()?,
        shell: wanted.shell.then(|| maker.shell()).transpose()?,
    };
    bodies.fluid.iter().for_each(|made| maker.keep(made));
    bodies.wall.iter().for_each(|made| maker.keep(made));
    bodies.shell.iter().for_each(|made| maker.keep(made));
    progress.finish();
    Ok(bodies)
}

impl Bodies {
    /// The bodies as the file has them.
    fn columns(&self) -> Vec<BodyParticles<'_>> {
        let flags = |flags: &[bool]| flags.iter().map(|&flag| f64::from(u8::from(flag))).collect();
        let layers = |kind, body: &'_ Body| {
            let mut scalars = vec![(schema::VOLUME, body.volume.clone())];
            if !body.depth.is_empty() {
                scalars.push((schema::DEPTH, body.depth.clone()));
            }
            (kind, scalars)
        };
        let mut columns = Vec::new();
        if let Some(Made { body: FluidBody { body, .. }, .. }) = &self.fluid {
            let (kind, scalars) = layers(BodyKind::Fluid, body);
            columns.push(BodyParticles { kind, position: &body.position, normal: &body.normal, scalars });
        }
        if let Some(Made { body: Wall { body, clamped, .. }, .. }) = &self.wall {
            let (kind, mut scalars) = layers(BodyKind::Wall, body);
            scalars.push((schema::CLAMPED, flags(clamped)));
            columns.push(BodyParticles { kind, position: &body.position, normal: &body.normal, scalars });
        }
        if let Some(Made { body: shell, .. }) = &self.shell {
            let volume = shell.area.iter().zip(&shell.thickness).map(|(area, thickness)| area * thickness);
            let scalars = vec![
                (schema::VOLUME, volume.collect()),
                (schema::AREA, shell.area.clone()),
                (schema::THICKNESS, shell.thickness.clone()),
                (schema::CURVATURE_MAX, shell.curvature.iter().map(|k| k[0]).collect()),
                (schema::CURVATURE_MIN, shell.curvature.iter().map(|k| k[1]).collect()),
                (schema::CLAMPED, flags(&shell.clamped)),
            ];
            let (position, normal) = (&shell.position, &shell.normal);
            columns.push(BodyParticles { kind: BodyKind::Shell, position, normal, scalars });
        }
        columns
    }
}

fn report(case: &Case, bodies: &Bodies) -> ParticlesReport {
    let Bodies { fluid, wall, shell } = bodies;
    let scene = &case.scene;
    let mut report = ParticlesReport {
        vaso_version: env!("CARGO_PKG_VERSION").into(),
        case: scene.title.clone(),
        generator: quality::generator_name(scene.particles.generator).into(),
        spacing_m: scene.particles.spacing,
        seed: scene.numerics.seed,
        surface: surface_report(&case.vessel),
        openings: case
            .vessel
            .openings
            .iter()
            .enumerate()
            .map(|(k, o)| opening_entry(&case.opening_name(k), o))
            .collect(),
        particles: ParticleCounts {
            fluid: fluid.as_ref().map_or(0, |f| f.body.body.position.len() as u64),
            wall: wall.as_ref().map_or(0, |w| w.body.body.position.len() as u64),
            shell: shell.as_ref().map_or(0, |s| s.body.position.len() as u64),
        },
        warnings: case.vessel.audit.notices.clone(),
        ..ParticlesReport::default()
    };
    let doubts = vaso_generation::warnings(&case.vessel, &crate::bodies::settings(scene));
    report.warnings.extend(doubts.iter().map(ToString::to_string));
    if let Some(Made { body, seconds, .. }) = fluid {
        report.quality.insert("fluid".into(), quality::entry(&body.body.quality, *seconds));
        report.blocks = quality::blocks(body, &scene.particles);
        report.warnings.extend(body.warnings());
    }
    if let Some(Made { body, seconds, .. }) = wall {
        report.quality.insert("wall".into(), quality::entry(&body.body.quality, *seconds));
        report.wall = Some(wall_report(body, case));
        // Layers that only stand in for a rigid wall may belong to two limbs.
        let is_stand_in =
            matches!(scene.wall, vaso_scene::Wall::Rigid) && scene.wall_body.thickness.is_none();
        let doubt = body.warning().filter(|_| !is_stand_in);
        report.warnings.extend(doubt.map(|doubt| doubt.to_string()));
    }
    if let Some(Made { body, seconds, .. }) = shell {
        report.quality.insert("shell".into(), quality::shell_entry(body, *seconds));
        report.shell = Some(shell_report(body, case));
        if body.quality.folded > 0 {
            report.warnings.push(format!(
                "{} particles of the shell stand where the wall folds onto itself: half its thickness is more than a \
                 radius of curvature",
                body.quality.folded
            ));
        }
    }
    report
}

fn count_true(flags: &[bool]) -> u64 {
    flags.iter().filter(|&&flag| flag).count() as u64
}

fn wall_report(wall: &Wall, case: &Case) -> WallReport {
    let open_ends = match wall_shape(&case.scene).1 {
        Ends::ClosestCap => OpenEnds::ClosestCap,
        Ends::Boxes => OpenEnds::Boxes,
        Ends::Collar { .. } => OpenEnds::Collar,
    };
    WallReport {
        thickness_m: wall.thickness,
        open_ends: open_ends.word().into(),
        clamped: count_true(&wall.clamped),
        shared: wall.shared,
    }
}

fn shell_report(shell: &ShellBody, case: &Case) -> ShellReport {
    let settings = shell_settings(&case.scene);
    let open_ends = if settings.collar > 0.0 { OpenEnds::Collar } else { OpenEnds::ClosestCap };
    ShellReport {
        thickness_m: settings.thickness,
        reference: match settings.reference {
            ShellReference::Lumen => "lumen".into(),
            ShellReference::MidSurface => "mid-surface".into(),
        },
        open_ends: open_ends.word().into(),
        area_m2: shell.area.iter().sum(),
        wall_area_m2: case.vessel.wall_area(),
        surface_distance_max: shell.quality.surface_distance_max,
        folded: shell.quality.folded as u64,
        clamped: count_true(&shell.clamped),
    }
}

//! `vaso run`: from the case to the report.

use crate::case::Case;
use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::flow::{Diverged, Flow};
use crate::plan::Plan;
use crate::progress::Progress;
use crate::results::{Results, append_frame};
use crate::world::{Bodies, build_flow_in};
use crate::{checkpoint, print};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use vaso_coupling::{MovingWall, ShellWall};
use vaso_fluid::Real;
use vaso_io::{EndReason, IoError, OutputDir, SeriesWriter, Status, Summary};
use vaso_scene::{Precision, Wall};
use vaso_solid::Solid;

/// How a command talks to the person.
pub struct Talk {
    /// Say nothing but errors.
    pub quiet: bool,
}

impl Talk {
    /// Says a line on standard error.
    pub fn say(&self, text: &str) {
        if !self.quiet {
            eprintln!("{}", text.trim_end());
        }
    }
}

/// Runs a case into `out`. `stop` is looked at after every step.
///
/// # Errors
/// With wrong input, nothing has been written. A run that breaks down or is stopped leaves its
/// results so far, a summary, and a post-mortem frame or a checkpoint.
pub fn run(
    case: &Case,
    plan: &Plan,
    out: &Path,
    force: bool,
    stop: &AtomicBool,
    talk: &Talk,
) -> Result<Summary, DriverError> {
    // Asked again when the folder is taken; here it saves making particles for nothing.
    if !force && Summary::read(&out.join("summary.json")).is_ok_and(|s| s.status == Status::Completed) {
        return Err(IoError::Finished { path: out.to_owned() }.into());
    }
    talk.say(&print::audit(&case.vessel, &case.scene.geometry.surface));
    talk.say(&print::plan(case, plan));
    let started = Instant::now();
    let mut progress = Progress::new(talk.quiet);
    let bodies = Bodies::make(case, |body, step, moved| progress.relaxation(body, step, moved))?;
    progress.relaxed();
    talk.say(&format!(
        "made     {} fluid and {} wall particles in {:.1} s{}",
        bodies.fluid.position.len(),
        bodies.wall.len(),
        bodies.seconds.iter().sum::<f64>(),
        if bodies.cached { " (from the cache)" } else { "" }
    ));
    let mut plan = plan.clone();
    for notice in &bodies.notices {
        talk.say(&format!("warning  {notice}"));
        plan.warnings.push(notice.clone());
    }
    let plan = &plan;
    let out = OutputDir::prepare(out, force)?;
    let is_shell = matches!(case.scene.wall, Wall::Shell(_));
    let run = match (plan.precision, is_shell) {
        (Precision::Mixed, false) => run_kind::<f32, Solid<f32>>,
        (Precision::Double, false) => run_kind::<f64, Solid<f64>>,
        (Precision::Mixed, true) => run_kind::<f32, ShellWall<f32>>,
        (Precision::Double, true) => run_kind::<f64, ShellWall<f64>>,
    };
    run(case, plan, bodies, &out, stop, talk, progress, started)
}

#[expect(clippy::too_many_arguments, reason = "the one place where all parts of a run meet")]
fn run_kind<R: Real, W: Deforming>(
    case: &Case,
    plan: &Plan,
    bodies: Bodies,
    out: &OutputDir,
    stop: &AtomicBool,
    talk: &Talk,
    mut progress: Progress,
    started: Instant,
) -> Result<Summary, DriverError> {
    let counts = bodies.counts();
    let mut flow = build_flow_in::<R, W>(case, plan, bodies)?;
    let mut results = Results::create(out, case, plan, &flow)?;
    let ended = advance(&mut flow, &mut results, case, plan, stop, &mut progress);
    progress.finish();
    let (ended, settled) = match ended {
        Ok(settled) => (results.finish(&flow, case), settled),
        Err(error) => (Err(error), None),
    };
    if let Some((_, words)) = &settled {
        talk.say(&format!("ended early at {:.4} s: {words}", flow.time));
    }
    let mut summary = results.summary(&mut flow, case, plan, counts, started.elapsed().as_secs_f64());
    summary.end_reason = ended.is_ok().then(|| settled.as_ref().map_or(EndReason::EndTime, |s| s.0));
    summary.message = settled.map(|s| s.1);
    if ended.is_ok() {
        talk.say(&print::ledger(&flow.ledger, flow.particle_substeps));
    }
    if let Err(error) = &ended {
        summary.status = match error {
            DriverError::Interrupted { .. } => Status::Interrupted,
            _ => Status::Failed,
        };
        summary.message = Some(error.to_string());
    }
    // After a full disk the summary may not find room either; the first error is the one to tell.
    let written = summary.write(&out.file("summary.json")).map_err(DriverError::from);
    let reported = vaso_report::write_report(out.path()).map_err(DriverError::from);
    ended.and(written).and(reported)?;
    Ok(summary)
}

/// Goes on to the end, or to where the results say that it has settled; tells why then.
fn advance<R: Real, W: Deforming>(
    flow: &mut Flow<R, W>,
    results: &mut Results<W::File>,
    case: &Case,
    plan: &Plan,
    stop: &AtomicBool,
    progress: &mut Progress,
) -> Result<Option<(EndReason, String)>, DriverError> {
    while flow.time < plan.end_time {
        let stepped = flow.step(plan.end_time);
        if let Err(diverged) = stepped {
            return Err(post_mortem(flow, results, case, diverged));
        }
        if let Some(reason) = results.after_step(flow, case, plan)? {
            return Ok(Some(reason));
        }
        progress.flow(flow.time, plan.end_time, flow.particle_substeps);
        if stop.load(Ordering::Relaxed) {
            results.write_frame(flow, case)?;
            checkpoint::write(results.folder(), flow)?;
            return Err(DriverError::Interrupted { time: flow.time, out: results.folder().to_owned() });
        }
    }
    Ok(None)
}

/// Leaves the broken state beside the results; the series keeps only sound frames.
fn post_mortem<R: Real, W: MovingWall, F>(
    flow: &Flow<R, W>,
    results: &Results<F>,
    case: &Case,
    diverged: Diverged,
) -> DriverError {
    let file: PathBuf = results.folder().join("failure.vtkhdf");
    let mut series = SeriesWriter::create(file);
    match append_frame(&mut series, flow, &case.scene.output.fields) {
        // A frame may hold values the format refuses; the message is what matters then.
        Ok(()) | Err(_) => diverged.into(),
    }
}

//! `vaso run`: from the case to the report.

use crate::case::Case;
use crate::checkpoint::{self, Checkpoint, Due, Ending, Origin, Surroundings};
use crate::deforming::Deforming;
use crate::diverged::Diverged;
use crate::error::{DriverError, POST_MORTEM};
use crate::flow::Flow;
use crate::kind::{OfKind, with_kind};
use crate::ledger::Stage;
use crate::plan::Plan;
use crate::print;
use crate::progress::Progress;
use crate::results::{Results, append_frame};
use crate::world::{Bodies, build_flow_in};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_io::{EndReason, OutputDir, SeriesWriter, Status, Summary};

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

/// Where a run starts.
#[derive(Clone, Copy)]
pub enum Start<'a> {
    /// At rest; `force` writes over a finished folder.
    Anew {
        /// Whether it does.
        force: bool,
    },
    /// Where a checkpoint was written.
    From(&'a Checkpoint),
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
    OutputDir::keep_run(out, force)?;
    go(case, plan, out, Start::Anew { force }, stop, talk)
}

/// Runs a case from its start or from a checkpoint, as [`run`] and [`resume`](crate::resume::resume) do.
pub(crate) fn go(
    case: &Case,
    plan: &Plan,
    out: &Path,
    start: Start,
    stop: &AtomicBool,
    talk: &Talk,
) -> Result<Summary, DriverError> {
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
    let job = Job { case, plan: &plan, out, start, stop, talk, started };
    with_kind(case, &plan, Go { job, bodies, progress })
}

/// A run that is to be made.
struct Go<'a> {
    job: Job<'a>,
    bodies: Bodies,
    progress: Progress,
}

impl OfKind for Go<'_> {
    type Done = Result<Summary, DriverError>;

    fn of<R: Real, W: Deforming + Send + 'static>(self) -> Self::Done {
        run_kind::<R, W>(self.job, self.bodies, self.progress)
    }
}

/// All that belongs to a run but its particles.
struct Job<'a> {
    case: &'a Case,
    plan: &'a Plan,
    out: &'a Path,
    start: Start<'a>,
    stop: &'a AtomicBool,
    talk: &'a Talk,
    started: Instant,
}

impl Job<'_> {
    /// Wall time spent on the run so far \[s\].
    fn wall_clock(&self) -> f64 {
        let before = match self.start {
            Start::Anew { .. } => 0.0,
            Start::From(checkpoint) => checkpoint.surroundings.wall_clock,
        };
        before + self.started.elapsed().as_secs_f64()
    }
}

/// A run on its way.
struct Running<R, W: Deforming> {
    flow: Flow<R, W>,
    results: Results<W::File>,
    origin: Origin,
}

impl<R: Real, W: Deforming> Running<R, W> {
    /// Builds the flow, takes the folder and opens its files. Where that fails nothing has been changed but what a checkpoint brings
    /// back.
    fn new(job: &Job, bodies: Bodies) -> Result<Self, DriverError> {
        let &Job { case, plan, out, start, .. } = job;
        let wall = bodies.wall.clone();
        let mut flow = build_flow_in::<R, W>(case, plan, bodies)?;
        match start {
            Start::Anew { force } => {
                let folder = OutputDir::prepare(out, force)?;
                let results = Results::create(&folder, case, plan, &flow, None)?;
                let origin = Origin::new(case, plan, out)?.in_wall(&wall);
                let mut running = Self { flow, results, origin };
                // From here on a kill at any moment leaves something to go on from.
                running.write_checkpoint(job, None)?;
                Ok(running)
            }
            Start::From(checkpoint) => {
                let origin = Origin::new(case, plan, out)?.in_wall(&wall);
                checkpoint.origin.check_wall(&origin, case)?;
                checkpoint.restore(&mut flow)?;
                let folder = OutputDir::go_on(out).map_err(|error| match error.is_disk_full() {
                    true => error.into(),
                    false => DriverError::input(error.to_string()),
                })?;
                let mut results = Results::create(&folder, case, plan, &flow, Some(&checkpoint.standing))?;
                checkpoint.restore_results(&mut results)?;
                Ok(Self { flow, results, origin })
            }
        }
    }

    fn write_checkpoint(&mut self, job: &Job, ending: Ending) -> Result<(), DriverError> {
        let start = Instant::now();
        let surroundings = Surroundings { wall_clock: job.wall_clock(), ending };
        checkpoint::write(&self.origin, &mut self.flow, &mut self.results, &surroundings)?;
        self.flow.ledger.add(Stage::Output, start.elapsed());
        Ok(())
    }

    /// Goes on to the end, or to where the results say that it has settled; tells why then. A checkpoint is left there, too, so that a
    /// kill while the last files are written loses nothing.
    fn advance(&mut self, job: &Job, progress: &mut Progress) -> Result<Ending, DriverError> {
        let &Job { case, plan, .. } = job;
        if let Start::From(Checkpoint { surroundings: Surroundings { ending: Some(ending), .. }, .. }) =
            job.start
        {
            return Ok(Some(ending.clone()));
        }
        let mut due = Due::new(case.scene.output.checkpoint_every, self.flow.time);
        progress.start(self.flow.time / plan.end_time, self.flow.particle_substeps);
        let mut ending = None;
        while self.flow.time < plan.end_time && ending.is_none() {
            if due.is_due(self.flow.time) {
                self.write_checkpoint(job, None)?;
            }
            if let Err(diverged) = self.flow.step(plan.end_time) {
                return Err(post_mortem(&self.flow, &self.results, case, diverged));
            }
            ending = self.results.after_step(&mut self.flow, case, plan)?;
            progress.flow(self.flow.time, plan.end_time, self.flow.particle_substeps);
            if ending.is_none() && job.stop.load(Ordering::Relaxed) {
                self.write_checkpoint(job, None)?;
                self.results.write_frame(&self.flow, case)?;
                let out = self.results.folder().to_owned();
                return Err(DriverError::Interrupted { time: self.flow.time, out });
            }
        }
        self.write_checkpoint(job, ending.clone())?;
        Ok(ending)
    }
}

fn run_kind<R: Real, W: Deforming>(
    job: Job,
    bodies: Bodies,
    mut progress: Progress,
) -> Result<Summary, DriverError> {
    let counts = bodies.counts();
    let &Job { case, plan, talk, .. } = &job;
    let mut running = Running::<R, W>::new(&job, bodies)?;
    let ended = running.advance(&job, &mut progress);
    progress.finish();
    let Running { mut flow, mut results, .. } = running;
    let (ended, settled) = match ended {
        Ok(settled) => (results.finish(&flow, case), settled),
        Err(error) => (Err(error), None),
    };
    if let Some((_, words)) = &settled {
        talk.say(&format!("ended early at {:.4} s: {words}", flow.time));
    }
    let mut summary = results.summary(&mut flow, case, plan, counts, job.wall_clock());
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
    let folder = results.folder().to_owned();
    // Takes the hidden copies of the series away, before the summary says that the run is finished.
    drop(results);
    // After a full disk the summary may not find room either; the first error is the one to tell.
    let written = summary.write(&folder.join("summary.json")).map_err(DriverError::from);
    let reported = vaso_report::write_report(&folder).map_err(DriverError::from);
    ended.and(written).and(reported)?;
    Ok(summary)
}

/// Leaves the broken state beside the results; the series keeps only sound frames.
fn post_mortem<R: Real, W: MovingWall, F>(
    flow: &Flow<R, W>,
    results: &Results<F>,
    case: &Case,
    diverged: Diverged,
) -> DriverError {
    let out = results.folder().to_owned();
    let mut series = SeriesWriter::create(out.join(POST_MORTEM));
    // A frame may hold values the format refuses; the message is what matters then.
    let post_mortem = append_frame(&mut series, flow, &case.scene.output.fields).is_ok();
    DriverError::Diverged { diverged: Box::new(diverged), out, last: results.last_frame(), post_mortem }
}

//! `vaso resume`: goes on from the last checkpoint, to the same bits as an unbroken run.

use crate::checkpoint::Checkpoint;
use crate::error::DriverError;
use crate::run::{Start, Talk, go};
use std::path::Path;
use std::sync::atomic::AtomicBool;
use vaso_io::{Status, Summary};

/// Goes on with the run in the folder `out`; one that is finished stays as it is, and its summary is returned. `stop` is looked at after
/// every step.
///
/// # Errors
/// With a checkpoint, case or folder that does not do, nothing has been changed. Otherwise as [`run`](crate::run::run).
pub fn resume(out: &Path, stop: &AtomicBool, talk: &Talk) -> Result<Summary, DriverError> {
    if !out.is_dir() {
        return Err(DriverError::input(format!(
            "{}: there is no such folder; `vaso resume` takes the output folder of a run, by default `out` in the case folder",
            out.display()
        )));
    }
    if let Ok(summary) = Summary::read(&out.join("summary.json"))
        && summary.status == Status::Completed
    {
        // A kill after the summary may have left no report, or an earlier one.
        let written = |name: &str| std::fs::metadata(out.join(name)).and_then(|file| file.modified()).ok();
        if written("report.html") < written("summary.json") {
            vaso_report::write_report(out)?;
        }
        talk.say(&format!("finished {} holds a finished run: nothing to do", out.display()));
        return Ok(summary);
    }
    let checkpoint = Checkpoint::read(out)?;
    let (case, plan) = checkpoint.origin.reopen(out)?;
    let mut series = vec!["fluid.vtkhdf"];
    series.extend((plan.wall_metrics || plan.deforms()).then_some("wall.vtkhdf"));
    series.extend((plan.wall_metrics && plan.wall.is_some()).then_some("lumen.vtkhdf"));
    let has_probes = !case.scene.probes.is_empty();
    let tables: &[&str] = if has_probes { &["openings.csv", "probes.csv"] } else { &["openings.csv"] };
    checkpoint.standing.check(out, &series, tables)?;
    talk.say(&format!(
        "resume   {} at {:.6e} of {} s, from its checkpoint",
        case.scene.file.display(),
        checkpoint.standing.time,
        plan.end_time
    ));
    go(&case, &plan, out, Start::From(&checkpoint), stop, talk)
}

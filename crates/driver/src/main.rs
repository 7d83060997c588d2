//! The `vaso` binary: commands on case folders.

mod examples;
mod flags;
mod manual;

use clap::Parser;
use flags::{Cli, Command, Common, ParticlesFlags};
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use vaso_driver::run::Talk;
use vaso_driver::{Case, DriverError, Plan, check, compare, new, particles, resume, run, study, tune};
use vaso_geometry::LengthUnit;
use vaso_io::{StudyReport, Summary};

fn main() -> ExitCode {
    let cli = Cli::parse();
    match among_workers(threads(&cli.command), || execute(cli.command)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn execute(command: Command) -> Result<(), DriverError> {
    match command {
        Command::New(flags) => {
            let made = new::new(&flags.dir, &flags.surface, length_unit(flags.unit.as_deref())?)?;
            if flags.json {
                put(made.report.to_json() + "\n")?;
            } else if !flags.quiet {
                put(made.text)?;
            }
            Ok(())
        }
        Command::Check { common, unit } => {
            let checked = if is_surface(&common.case) {
                check::surface(&common.case, length_unit(unit.as_deref())?)?
            } else {
                let mut set = common.set.clone();
                set.extend(unit.map(|u| ("geometry.unit".to_owned(), u)));
                check::case(&common.case, &set)?
            };
            if common.json {
                put(checked.report.to_json() + "\n")?;
            } else if !common.quiet {
                put(checked.text)?;
            }
            Ok(())
        }
        Command::Particles(flags) => make_particles(&flags),
        Command::Run { common, force } => {
            let case = Case::load(&common.case, &common.set)?;
            let plan = Plan::new(&case)?;
            let out = out_folder(&common, &case);
            let stop = stop_on_interrupt();
            let summary = run::run(&case, &plan, &out, force, &stop, &talk(&common))?;
            tell(&summary, &out, &talk(&common), common.json)
        }
        Command::Resume { out, quiet, json, .. } => {
            let talk = Talk { quiet };
            let summary = resume::resume(&out, &stop_on_interrupt(), &talk)?;
            tell(&summary, &out, &talk, json)
        }
        Command::Study(flags) => {
            let common = &flags.common;
            let case = Case::load(&common.case, &common.set)?;
            // Where the report of a run of the case looks for it.
            let out = common.out.clone().unwrap_or_else(|| case.scene.directory.join("study"));
            let stop = stop_on_interrupt();
            let report = study::study(&case, &flags.request(), &out, flags.force, &stop, &talk(common))?;
            if common.json { put(report.to_json() + "\n") } else { Ok(()) }
        }
        Command::Tune(flags) => {
            let case = Case::load(&flags.common.case, &flags.common.set)?;
            put(tune::tune(&case, &flags.request())?)
        }
        Command::Report { out, against } => {
            let study = out.join("study.json");
            let file = match against {
                Some(other) => vaso_report::write_report_against(&out, &other)?,
                None if study.exists() => vaso_report::write_study(&out, &StudyReport::read(&study)?)?,
                None => vaso_report::write_report(&out)?,
            };
            put(format!("{}\n", file.display()))
        }
        Command::Schema => put(vaso_scene::case_schema()),
        Command::Completions { shell } => put(manual::completions(shell)),
        Command::Man { dir } => {
            let pages = manual::write(&dir)?;
            put(pages.iter().map(|page| format!("{}\n", page.display())).collect::<String>())
        }
    }
}

/// Says what a run came to.
fn tell(summary: &Summary, out: &Path, talk: &Talk, json: bool) -> Result<(), DriverError> {
    talk.say(&format!(
        "done     {:.4} s of flow in {:.1} s · {:.2} M particle steps/s · report {}",
        summary.time_s,
        summary.wall_clock_s,
        1e-6 * summary.particle_substeps_per_s,
        out.join("report.html").display()
    ));
    if json { put(summary.to_json() + "\n") } else { Ok(()) }
}

/// Writes to standard output. A reader that has seen enough and is gone, as `head` is, is no error.
fn put(text: impl AsRef<str>) -> Result<(), DriverError> {
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_ref().as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(DriverError::input(format!("standard output: {e}; give it a place that can be written")))
        }
        _ => Ok(()),
    }
}

/// A unit as given by `--unit`.
fn length_unit(text: Option<&str>) -> Result<Option<LengthUnit>, DriverError> {
    let unit = text.map(str::parse::<LengthUnit>).transpose();
    unit.map_err(|e| DriverError::input(format!("--unit: {e}")))
}

fn make_particles(flags: &ParticlesFlags) -> Result<(), DriverError> {
    let common = &flags.common;
    let settings = flags.settings();
    let case = if is_surface(&common.case) {
        if !settings.iter().any(|(key, _)| key == "particles.spacing") {
            let file = common.case.display();
            return Err(DriverError::input(format!(
                "{file}: a bare surface says nothing about the spacing of its particles; give it by --spacing, such as \
                 --spacing \"0.4 mm\""
            )));
        }
        Case::of_surface(&common.case, &settings)?
    } else {
        Case::load(&common.case, &settings)?
    };
    let (out, talk) = (out_folder(common, &case), talk(common));
    let answer = match &flags.compare {
        Some(generators) => compare::compare(&case, generators, &out, flags.force, &talk)?.to_json(),
        None => {
            let job = flags.job(case.scene.wall_body.thickness)?;
            particles::particles(&case, &job, &out, &talk)?.to_json()
        }
    };
    if common.json { put(answer + "\n") } else { Ok(()) }
}

fn talk(common: &Common) -> Talk {
    Talk { quiet: common.quiet }
}

/// Whether a path is a surface file rather than a case.
fn is_surface(path: &Path) -> bool {
    path.is_file() && path.extension().is_none_or(|e| e != "toml")
}

fn out_folder(common: &Common, case: &Case) -> PathBuf {
    common.out.clone().unwrap_or_else(|| case.scene.directory.join("out"))
}

/// Worker threads that a command asks for; `None` where it leaves that open.
fn threads(command: &Command) -> Option<usize> {
    match command {
        Command::Check { common, .. } | Command::Run { common, .. } => common.threads,
        Command::Particles(flags) => flags.common.threads,
        Command::Study(flags) => flags.common.threads,
        Command::Tune(flags) => flags.common.threads,
        Command::Resume { threads, .. } => *threads,
        Command::New(_)
        | Command::Report { .. }
        | Command::Schema
        | Command::Completions { .. }
        | Command::Man { .. } => None,
    }
}

/// Stack of a worker: that of a main thread, whose work they do.
const STACK: usize = 8 << 20;

/// Does `work` on one of the worker threads. From outside of them each parallel loop, some fifty in a step, would wake a worker and put
/// the caller to sleep.
fn among_workers<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, DriverError> + Send,
) -> Result<T, DriverError> {
    if threads == Some(0) {
        return Err(DriverError::input("--threads: 0 is no number of threads; give 1 or more"));
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads.unwrap_or(0))
        .stack_size(STACK)
        .build_global()
        .map_err(|e| DriverError::input(format!("worker threads: {e}")))?;
    rayon::scope(|_| work())
}

/// Flag raised by Ctrl-C and by termination; the run then ends after its step. A second one ends at once.
fn stop_on_interrupt() -> Arc<AtomicBool> {
    let stop = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stop);
    let installed = ctrlc::set_handler(move || {
        if raised.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    // Without a handler the run still works; it only cannot say goodbye.
    if let Err(error) = installed {
        eprintln!("warning: Ctrl-C will end the run without a checkpoint: {error}");
    }
    stop
}

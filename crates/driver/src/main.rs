//! The `vaso` binary: commands on case folders.

use clap::{Args, Parser, Subcommand};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use vaso_driver::run::Talk;
use vaso_driver::{Case, DriverError, Plan, check, particles, run};
use vaso_geometry::LengthUnit;

/// Blood flow in a vessel surface by smoothed particle hydrodynamics.
#[derive(Parser)]
#[command(name = "vaso", version, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Read everything, build nothing heavy: audit, openings, plan, expected cost.
    Check {
        #[command(flatten)]
        common: Common,
        /// Unit of the coordinates, for a bare surface: m, cm, mm or um.
        #[arg(long)]
        unit: Option<String>,
    },
    /// Surface to particles only, with a quality report.
    Particles {
        #[command(flatten)]
        common: Common,
    },
    /// The main job: everything from the case to the report.
    Run {
        #[command(flatten)]
        common: Common,
        /// Write over a finished output folder.
        #[arg(long)]
        force: bool,
    },
    /// Make the one-file report of an output folder again.
    Report {
        /// Output folder of a run.
        out: PathBuf,
    },
}

#[derive(Args)]
struct Common {
    /// Case folder or case.toml (for `check` also a bare surface).
    case: PathBuf,
    /// Output folder; default: `out` in the case folder.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Worker threads; default: one a core.
    #[arg(long)]
    threads: Option<usize>,
    /// Override of the case, `key.path=value`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE", value_parser = setting)]
    set: Vec<(String, String)>,
    /// Say nothing but errors.
    #[arg(long)]
    quiet: bool,
    /// Machine-readable result on standard output.
    #[arg(long)]
    json: bool,
}

fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err(format!("\"{text}\" is not of the form key.path=value")),
    }
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    match execute(cli.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(error.exit_code())
        }
    }
}

fn execute(command: Command) -> Result<(), DriverError> {
    match command {
        Command::Check { common, unit } => {
            set_threads(&common)?;
            let checked = if is_surface(&common.case) {
                let unit = unit.map(|u| u.parse::<LengthUnit>()).transpose();
                check::surface(&common.case, unit.map_err(|e| DriverError::input(format!("--unit: {e}")))?)?
            } else {
                let mut set = common.set.clone();
                set.extend(unit.map(|u| ("geometry.unit".to_owned(), u)));
                check::case(&common.case, &set)?
            };
            if common.json {
                println!("{}", checked.report.to_json());
            } else if !common.quiet {
                print!("{}", checked.text);
            }
            Ok(())
        }
        Command::Particles { common } => {
            set_threads(&common)?;
            let case = Case::load(&common.case, &common.set)?;
            let report = particles::particles(&case, &out_folder(&common, &case), &talk(&common))?;
            if common.json {
                println!("{}", report.to_json());
            }
            Ok(())
        }
        Command::Run { common, force } => {
            set_threads(&common)?;
            let case = Case::load(&common.case, &common.set)?;
            let plan = Plan::new(&case)?;
            let out = out_folder(&common, &case);
            let stop = stop_on_interrupt();
            let summary = run::run(&case, &plan, &out, force, &stop, &talk(&common))?;
            talk(&common).say(&format!(
                "done     {:.4} s of flow in {:.1} s · {:.2} M particle steps/s · report {}",
                summary.time_s,
                summary.wall_clock_s,
                1e-6 * summary.particle_substeps_per_s,
                out.join("report.html").display()
            ));
            if common.json {
                println!("{}", summary.to_json());
            }
            Ok(())
        }
        Command::Report { out } => {
            let file = vaso_report::write_report(&out)?;
            println!("{}", file.display());
            Ok(())
        }
    }
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

fn set_threads(common: &Common) -> Result<(), DriverError> {
    let Some(n) = common.threads else { return Ok(()) };
    if n == 0 {
        return Err(DriverError::input("--threads: 0 is no number of threads; give 1 or more"));
    }
    rayon::ThreadPoolBuilder::new()
        .num_threads(n)
        .build_global()
        .map_err(|e| DriverError::input(format!("--threads {n}: {e}")))
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

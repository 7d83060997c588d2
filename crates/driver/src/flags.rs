//! Commands and flags of the program.

use crate::examples;
use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;
use vaso_boundary::Split;
use vaso_driver::DriverError;
use vaso_driver::extrusion::ExtrusionRequest;
use vaso_driver::particles::{ParticlesJob, Wanted};
use vaso_driver::study::{Goal, StudyRequest, Wish};
use vaso_driver::tune::TuneRequest;
use vaso_units::{dimension, parse_as};

/// Blood flow in a vessel surface by smoothed particle hydrodynamics.
#[derive(Parser)]
#[command(name = "vaso", version, arg_required_else_help = true, after_help = examples::VASO)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Subcommand)]
pub(crate) enum Command {
    /// A case from a surface: openings found and named, unit guessed, inflow and outlets estimated; it runs as it is.
    #[command(after_help = examples::NEW)]
    New(NewFlags),
    /// Read everything, build nothing heavy: audit, openings, plan, expected cost.
    #[command(after_help = examples::CHECK)]
    Check {
        #[command(flatten)]
        common: Common,
        /// Unit of the coordinates: m, cm, mm or um.
        #[arg(long)]
        unit: Option<String>,
    },
    /// Surface to particles only, with a quality report.
    #[command(after_help = examples::PARTICLES)]
    Particles(Box<ParticlesFlags>),
    /// The main job: everything from the case to the report.
    #[command(after_help = examples::RUN)]
    Run {
        #[command(flatten)]
        common: Common,
        /// Write over a finished output folder.
        #[arg(long)]
        force: bool,
    },
    /// Go on with an interrupted or killed run from its last checkpoint, to the same bits as an unbroken one.
    #[command(after_help = examples::RESUME)]
    Resume {
        /// Output folder of the run.
        out: PathBuf,
        /// Worker threads; default: one a core.
        #[arg(long)]
        threads: Option<usize>,
        /// Say nothing but errors.
        #[arg(long)]
        quiet: bool,
        /// Machine-readable result on standard output.
        #[arg(long)]
        json: bool,
    },
    /// What accuracy costs in time: the case run along ladders of settings, errors and orders, or settings for an error or a time.
    #[command(after_help = examples::STUDY)]
    Study(Box<StudyFlags>),
    /// Windkessel parameters from cuff pressures, ready to paste into the case.
    #[command(after_help = examples::TUNE)]
    Tune(TuneFlags),
    /// Make the one-file report of an output folder again.
    #[command(after_help = examples::REPORT)]
    Report {
        /// Output folder of a run or of a study.
        out: PathBuf,
        /// Output folder of another run of the vessel, with whose pressures those of this one are compared: of a rigid wall, say.
        #[arg(long, value_name = "OTHER")]
        against: Option<PathBuf>,
    },
    /// The JSON Schema of case.toml, by which editors complete and check it.
    #[command(after_help = examples::SCHEMA)]
    Schema,
    /// A script that completes commands and flags in a shell.
    #[command(after_help = examples::COMPLETIONS)]
    Completions {
        /// The shell.
        shell: Shell,
    },
    /// The manual as man pages, one for each command.
    #[command(after_help = examples::MAN)]
    Man {
        /// Folder to write them to, such as that of `man1` in the manual path.
        dir: PathBuf,
    },
}

#[derive(Args)]
pub(crate) struct NewFlags {
    /// Folder of the case: one that is new or empty.
    pub(crate) dir: PathBuf,
    /// Surface of the lumen, STL or VTP, with open or capped ends; it is copied.
    #[arg(long, value_name = "FILE")]
    pub(crate) surface: PathBuf,
    /// Unit of its coordinates: m, cm, mm or um; default: the one in which it is as large as vessels are.
    #[arg(long)]
    pub(crate) unit: Option<String>,
    /// Say nothing but errors.
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Machine-readable result on standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Args)]
pub(crate) struct StudyFlags {
    #[command(flatten)]
    pub(crate) common: Common,
    /// Ladders to climb, of spacing, sound-speed, precision, operators, generator, wall, viscosity and coupling; default: those that the
    /// case calls for.
    #[arg(long, value_name = "NAME,...", value_parser = Wish::ladders)]
    ladders: Option<std::vec::Vec<String>>,
    /// Spacings of the first ladder, such as "0.6 mm,0.4 mm,0.3 mm"; default: 1.69, 1.3 and 1 times that of the case.
    #[arg(long, value_name = "LENGTH,...", value_parser = lengths)]
    spacings: Option<std::vec::Vec<f64>>,
    /// A key of the case with values to run it with at the middle spacing, such as `numerics.smoothing_length=1.2|1.5`; in place of
    /// the ladders but that of the spacing. May be given several times.
    #[arg(long, value_name = "KEY=VALUE|VALUE", value_parser = values)]
    vary: Vec<(String, Vec<String>)>,
    /// The error that prices and goals go by; default: the largest of all.
    #[arg(long, value_name = "NAME")]
    of: Option<String>,
    /// Find the spacing for this error, such as 2%, and run it.
    #[arg(long, value_name = "SHARE", value_parser = share, conflicts_with = "budget")]
    error: Option<f64>,
    /// Find the finest spacing that this time allows, such as "10 min", and run it.
    #[arg(long, value_name = "TIME", value_parser = time)]
    budget: Option<f64>,
    /// Run everything so many times and take the median of the times.
    #[arg(long, value_name = "TIMES", default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..))]
    repeat: u8,
    /// Write over an older study.
    #[arg(long)]
    pub(crate) force: bool,
}

impl StudyFlags {
    pub(crate) fn request(&self) -> StudyRequest {
        let goal = self.error.map(Goal::Error).or(self.budget.map(Goal::Budget));
        StudyRequest {
            wish: Wish {
                ladders: self.ladders.clone(),
                spacings: self.spacings.clone(),
                vary: self.vary.clone(),
            },
            goal,
            judged_by: self.of.clone(),
            repeat: usize::from(self.repeat),
        }
    }
}

fn lengths(list: &str) -> Result<Vec<f64>, String> {
    let length = |text: &str| match parse_as(text.trim(), dimension::LENGTH) {
        Ok(length) if length > 0.0 && length.is_finite() => Ok(length),
        Ok(_) => Err(format!("\"{}\" is out of range; a spacing is above 0", text.trim())),
        Err(error) => Err(error.to_string()),
    };
    list.split(',').map(length).collect()
}

fn values(text: &str) -> Result<(String, Vec<String>), String> {
    let (key, values) = setting(text)?;
    Ok((key, values.split('|').map(|value| value.trim().to_owned()).collect()))
}

fn share(text: &str) -> Result<f64, String> {
    match parse_as(text, dimension::NUMBER) {
        Ok(share) if share > 0.0 && share < 1.0 => Ok(share),
        Ok(_) => Err(format!("\"{text}\" is out of range; allowed: a share above 0 and below 1, such as 2%")),
        Err(error) => Err(error.to_string()),
    }
}

fn time(text: &str) -> Result<f64, String> {
    match parse_as(text, dimension::TIME) {
        Ok(time) if time > 0.0 && time.is_finite() => Ok(time),
        Ok(_) => Err(format!("\"{text}\" is out of range; a time is above 0")),
        Err(error) => Err(error.to_string()),
    }
}

#[derive(Args)]
pub(crate) struct TuneFlags {
    #[command(flatten)]
    pub(crate) common: Common,
    /// Highest pressure of the cycle, such as "120 mmHg".
    #[arg(long, value_parser = pressure)]
    systolic: f64,
    /// Lowest pressure of the cycle.
    #[arg(long, value_parser = pressure)]
    diastolic: f64,
    /// Pressure behind the outlets.
    #[arg(long, value_parser = pressure, default_value = "0 mmHg")]
    distal: f64,
    /// How the flow parts: `area`, `murray`, or a share for each outlet in the order of `vaso check`, as `0.67,0.33`.
    #[arg(long, default_value = "murray", value_parser = split)]
    split: Split,
    /// Speed of pulse waves behind the outlets, which sets their proximal resistance.
    #[arg(long, default_value = "7 m/s", value_parser = speed)]
    wave_speed: f64,
}

impl TuneFlags {
    pub(crate) fn request(&self) -> TuneRequest {
        TuneRequest {
            systolic: self.systolic,
            diastolic: self.diastolic,
            distal_pressure: self.distal,
            wave_speed: self.wave_speed,
            split: self.split.clone(),
        }
    }
}

fn pressure(text: &str) -> Result<f64, String> {
    parse_as(text, dimension::PRESSURE).map_err(|e| e.to_string())
}

fn speed(text: &str) -> Result<f64, String> {
    parse_as(text, dimension::VELOCITY).map_err(|e| e.to_string())
}

fn split(text: &str) -> Result<Split, String> {
    match text {
        "area" => Ok(Split::AREA),
        "murray" => Ok(Split::MURRAY),
        shares => {
            let share = |s: &str| s.trim().parse::<f64>();
            let shares: Result<Vec<f64>, _> = shares.split(',').map(share).collect();
            shares
                .map(Split::Given)
                .map_err(|_| "allowed: area, murray, or shares such as 0.67,0.33".to_owned())
        }
    }
}

#[derive(Args)]
pub(crate) struct Common {
    /// Case folder or case.toml (for `check` and `particles` also a bare surface).
    pub(crate) case: PathBuf,
    /// Output folder; default: `out` in the case folder.
    #[arg(long)]
    pub(crate) out: Option<PathBuf>,
    /// Worker threads; default: one a core.
    #[arg(long)]
    pub(crate) threads: Option<usize>,
    /// Override of the case, `key.path=value`; may be given several times.
    #[arg(long, value_name = "KEY=VALUE", value_parser = setting)]
    pub(crate) set: Vec<(String, String)>,
    /// Say nothing but errors.
    #[arg(long)]
    pub(crate) quiet: bool,
    /// Machine-readable result on standard output.
    #[arg(long)]
    pub(crate) json: bool,
}

fn setting(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((key, value)) if !key.trim().is_empty() => Ok((key.trim().to_owned(), value.trim().to_owned())),
        _ => Err(format!("\"{text}\" is not of the form key.path=value")),
    }
}

#[derive(Args)]
pub(crate) struct ParticlesFlags {
    #[command(flatten)]
    pub(crate) common: Common,
    /// Unit of the coordinates: m, cm, mm or um.
    #[arg(long)]
    unit: Option<String>,
    /// Distance between particles, such as "0.4 mm".
    #[arg(long)]
    spacing: Option<String>,
    /// Generator of the fluid: relaxed-lattice or multiblock.
    #[arg(long)]
    generator: Option<String>,
    /// Lattice a relaxed lattice starts from: cubic or bcc.
    #[arg(long)]
    lattice: Option<String>,
    /// Arrangement of blocks in a section: single, nine-block or o-grid.
    #[arg(long)]
    topology: Option<String>,
    /// Sweeps of elliptic smoothing of the sections of blocks.
    #[arg(long, value_name = "SWEEPS")]
    smoothing: Option<String>,
    /// Seed of everything random.
    #[arg(long)]
    seed: Option<String>,
    /// Thickness of the wall, such as "0.6 mm".
    #[arg(long, value_name = "LENGTH")]
    wall_thickness: Option<String>,
    /// Where the wall ends at the openings: closest-cap, boxes or collar.
    #[arg(long)]
    ends: Option<String>,
    /// Bodies to make, of fluid, wall and shell; default: those the case calls for.
    #[arg(long, value_name = "BODY,...")]
    bodies: Option<String>,
    /// Write the outer surface of the wall to this STL file, in the unit of the vessel's surface.
    #[arg(long, value_name = "FILE.stl", conflicts_with = "compare")]
    extrude: Option<PathBuf>,
    /// How far out the outer surface lies; default: the thickness of the wall.
    #[arg(long, value_name = "LENGTH", requires = "extrude")]
    extrude_by: Option<String>,
    /// Make the fluid by each of these generators and compare them: relaxed-lattice, relaxed-lattice:bcc, multiblock,
    /// multiblock:single, multiblock:nine-block, multiblock:o-grid.
    #[arg(long, value_name = "GENERATOR,...", conflicts_with_all = ["generator", "lattice", "topology", "bodies"])]
    pub(crate) compare: Option<String>,
    /// Write over files that are in the way.
    #[arg(long)]
    pub(crate) force: bool,
}

impl ParticlesFlags {
    /// The settings of the case that the flags stand for, after those of `--set`.
    pub(crate) fn settings(&self) -> Vec<(String, String)> {
        let flags = [
            ("geometry.unit", &self.unit),
            ("particles.spacing", &self.spacing),
            ("particles.generator", &self.generator),
            ("particles.lattice", &self.lattice),
            ("particles.topology", &self.topology),
            ("particles.smoothing_sweeps", &self.smoothing),
            ("numerics.seed", &self.seed),
            ("wall.thickness", &self.wall_thickness),
            ("wall.open_ends", &self.ends),
        ];
        let given = flags.iter().filter_map(|(key, value)| Some(((*key).to_owned(), (*value).clone()?)));
        self.common.set.iter().cloned().chain(given).collect()
    }

    /// What is to be done; `thickness` is that of the wall, where one is given \[m\].
    ///
    /// # Errors
    /// When a flag is wrong.
    pub(crate) fn job(&self, thickness: Option<f64>) -> Result<ParticlesJob, DriverError> {
        let length = |text: &String| {
            parse_as(text, dimension::LENGTH).map_err(|e| DriverError::input(format!("--extrude-by: {e}")))
        };
        let distance = self.extrude_by.as_ref().map(length).transpose()?;
        let extrusion = match (&self.extrude, distance.or(thickness)) {
            (None, _) => None,
            (Some(file), Some(distance)) => Some(ExtrusionRequest { file: file.clone(), distance }),
            (Some(_), None) => {
                return Err(DriverError::input(
                    "--extrude: nothing says how far; add --extrude-by or --wall-thickness, such as \"0.6 mm\"",
                ));
            }
        };
        let bodies = self.bodies.as_deref().map(Wanted::listed).transpose()?;
        Ok(ParticlesJob { bodies, extrusion, force: self.force })
    }
}

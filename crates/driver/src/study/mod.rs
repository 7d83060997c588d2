//! `vaso study`: what accuracy costs in time, by running a case along ladders of settings.

mod analysis;
mod goal;
pub(crate) mod identity;
mod ladder;
mod map;
mod measure;
mod table;

pub use goal::Goal;
pub use ladder::Wish;

use crate::case::Case;
use crate::error::DriverError;
use crate::plan::Plan;
use crate::run::{self, Talk};
use analysis::WORST;
use ladder::{Settings, Variant};
use map::StressMap;
use measure::Target;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use vaso_io::{NamedValue, OutputDir, StudyReport, StudyRun, StudyStatus, Summary};
use vaso_scene::Expectation;

/// What is asked of a study.
#[derive(Clone, Debug, Default)]
pub struct StudyRequest {
    /// What is varied.
    pub wish: Wish,
    /// An error or a time to be met.
    pub goal: Option<Goal>,
    /// Name of the error that counts; `None` for the largest of all.
    pub judged_by: Option<String>,
    /// How often each run is made; its time is the median.
    pub repeat: usize,
}

/// Names of the files of a study.
const FILES: [&str; 4] = ["study.csv", "study.json", "study.svg", "report.html"];
/// Effects that a wall that deforms costs.
const WALLS: [&str; 3] = ["wall.solid", "wall.shell", "wall.coupling"];
/// Part of a budget that its ladder may take.
const LADDER_SHARE: f64 = 0.3;

/// Studies a case, and writes `study.csv`, `study.json`, `study.svg` and `report.html` into `out`, beside the folder `runs` with the
/// results of each run.
///
/// # Errors
/// With wrong input, nothing has been written. An interruption or a full disk leaves what was found so far.
pub fn study(
    case: &Case,
    request: &StudyRequest,
    out: &Path,
    force: bool,
    stop: &AtomicBool,
    talk: &Talk,
) -> Result<StudyReport, DriverError> {
    let expected = Expectation::load(&case.scene)?;
    let plan = Plan::new(case)?;
    let targets = measure::targets(&plan, &expected);
    let judged_by = judged_by(request, &targets)?;
    let wish = bounded(&request.wish, request.goal, case, &plan);
    let variants = ladder::climb(case, &wish, !expected.is_empty())?;
    OutputDir::keep_clear(FILES.map(|name| out.join(name)), force)?;
    OutputDir::keep_run(out, force)?;
    let folder = OutputDir::open(out)?;
    let mut climb = Climb {
        case,
        targets,
        runs: Vec::new(),
        maps: Vec::new(),
        out,
        stop,
        talk,
        repeat: request.repeat.max(1),
    };
    let judged = Judged { by: &judged_by };
    let mut report = StudyReport {
        vaso_version: env!("CARGO_PKG_VERSION").into(),
        case: case.scene.title.clone(),
        identity: identity::identity(case),
        threads: rayon::current_num_threads() as u64,
        reference: reference(&expected),
        judged_by: judged_by.clone(),
        ..StudyReport::default()
    };
    let mut ended = climb.run_all(&variants);
    if let (Ok(()), Some(goal)) = (&ended, request.goal) {
        match goal::pursue(&mut climb, goal, &judged) {
            Ok(entry) => report.goal = Some(entry),
            Err(error) => ended = Err(error),
        }
    }
    report.errors = climb.analyse();
    report.front = analysis::front(&climb.runs, &judged_by);
    report.warnings = warnings(&climb);
    report.runs = climb.runs;
    report.write(&folder.file("study.json"))?;
    vaso_io::write_whole(&folder.file("study.csv"), report.to_csv().as_bytes())?;
    vaso_report::write_study(folder.path(), &report)?;
    talk.say(&table::table(&report));
    ended?;
    Ok(report)
}

/// The error that counts.
struct Judged<'a> {
    by: &'a str,
}

fn judged_by(request: &StudyRequest, targets: &[Target]) -> Result<String, DriverError> {
    let Some(name) = &request.judged_by else { return Ok(WORST.into()) };
    let mut names = analysis::names(targets);
    names.push(WORST.into());
    match names.contains(name) {
        true => Ok(name.clone()),
        false => Err(DriverError::input(format!(
            "--of: there is no error `{name}`; there are {}",
            names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ")
        ))),
    }
}

/// What is varied where a goal is pursued: the spacing alone unless more is asked for, and for a budget as finely as a part of it
/// is expected to allow.
fn bounded(wish: &Wish, goal: Option<Goal>, case: &Case, plan: &Plan) -> Wish {
    let mut wish = wish.clone();
    if goal.is_some() && wish.ladders.is_none() && wish.vary.is_empty() {
        wish.ladders = Some(vec![ladder::SPACING.into()]);
    }
    if let (Some(Goal::Budget(budget)), None) = (goal, &wish.spacings) {
        let own = case.scene.particles.spacing;
        wish.spacings = Some(ladder::within(own, plan.expected().wall_clock_s, LADDER_SHARE * budget));
    }
    wish
}

fn reference(expected: &[Expectation]) -> String {
    if expected.is_empty() {
        return "the value that the three finest spacings converge to, or that of the finest where they do not; nothing outside \
                of this program"
            .into();
    }
    let mut sources: Vec<&str> = Vec::new();
    for source in expected.iter().filter_map(|e| e.source.as_deref()) {
        if !sources.contains(&source) {
            sources.push(source);
        }
    }
    if sources.is_empty() { "expect.toml".into() } else { format!("expect.toml: {}", sources.join("; ")) }
}

fn warnings(climb: &Climb) -> Vec<String> {
    let mut warnings = Vec::new();
    if climb.repeat == 1 {
        warnings.push("each run was timed once; other work on the machine is part of the times".to_owned());
    }
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    if rayon::current_num_threads() > cores {
        warnings.push(format!("more threads than the {cores} cores there are"));
    }
    warnings
}

/// The runs of a study, as far as they have been made.
struct Climb<'a> {
    case: &'a Case,
    targets: Vec<Target>,
    runs: Vec<StudyRun>,
    /// Wall shear stress of each run.
    maps: Vec<Option<StressMap>>,
    out: &'a Path,
    stop: &'a AtomicBool,
    talk: &'a Talk,
    repeat: usize,
}

impl Climb<'_> {
    fn run_all(&mut self, variants: &[Variant]) -> Result<(), DriverError> {
        for (k, variant) in variants.iter().enumerate() {
            self.talk.say(&format!("run      {} of {}: {}", k + 1, variants.len(), variant.name));
            self.run(variant)?;
        }
        Ok(())
    }

    /// Makes a run and keeps what it came to. One that breaks down, or whose settings are refused, is a finding.
    ///
    /// # Errors
    /// When the person stops it, or results cannot be written.
    fn run(&mut self, variant: &Variant) -> Result<(), DriverError> {
        let mut row = StudyRun {
            name: variant.name.clone(),
            ladder: variant.ladder.clone(),
            settings: variant.settings.iter().map(|(k, v)| [k.clone(), v.clone()]).collect(),
            wall_clock_s: f64::NAN,
            predicted_s: f64::NAN,
            spacing_m: spacing(variant).unwrap_or(self.case.scene.particles.spacing),
            ..StudyRun::default()
        };
        let ended = self.fill(variant, &mut row);
        let (fatal, map) = match ended {
            Ok(map) => (None, map),
            Err(error) => {
                // A row of the table is a line.
                let lines = error.to_string();
                row.message = Some(lines.lines().map(str::trim).collect::<Vec<_>>().join(" "));
                row.status = match (&error, error.exit_code()) {
                    (DriverError::Interrupted { .. }, _) => StudyStatus::Interrupted,
                    (_, 2) => StudyStatus::Refused,
                    _ => StudyStatus::Failed,
                };
                let stops = matches!(error, DriverError::Interrupted { .. } | DriverError::Io(_));
                (stops.then_some(error), None)
            }
        };
        self.talk.say(&table::outcome(&row));
        row.wall_shear_correlation = self.correlation(&row, map.as_ref());
        self.runs.push(row);
        self.maps.push(map);
        fatal.map_or(Ok(()), Err)
    }

    /// How alike the wall shear stress of a run and of that of the ladder of spacings at the same spacing is.
    fn correlation(&self, row: &StudyRun, map: Option<&StressMap>) -> Option<f64> {
        let is_base = |run: &StudyRun| run.ladder == ladder::SPACING && run.spacing_m == row.spacing_m;
        let base = self.runs.iter().position(is_base)?;
        map?.correlation(self.maps[base].as_ref()?)
    }

    fn fill(&self, variant: &Variant, row: &mut StudyRun) -> Result<Option<StressMap>, DriverError> {
        let mut case = ladder::with(self.case, &thinned(self.case, &variant.settings))?;
        // Particles made once and found again would make the second run look faster than it is.
        case.cache = None;
        let plan = Plan::new(&case)?;
        row.predicted_s = plan.expected().wall_clock_s;
        let out = self.out.join("runs").join(&variant.name);
        let mut times = Vec::with_capacity(self.repeat);
        let mut last = Summary::default();
        for _ in 0..self.repeat {
            last = run::run(&case, &plan, &out, true, self.stop, &Talk { quiet: true })?;
            times.push(last.wall_clock_s);
        }
        times.sort_by(f64::total_cmp);
        row.wall_clock_s = times[times.len() / 2];
        row.particles = last.particles;
        row.steps = last.steps;
        let walls = last.effects.iter().filter(|e| e.on && WALLS.contains(&e.name.as_str()));
        row.wall_s = plan.deforms().then(|| walls.filter_map(|e| e.seconds).sum());
        row.memory_bytes = last.effects.iter().filter_map(|e| e.bytes).sum();
        row.sound_speed_m_s = last.sound_speed_m_s;
        row.max_density_error = last.stability.max_density_error;
        row.mass_balance_error = last.stability.mass_balance_error;
        let values = measure::values(&out, &last, &plan, &self.targets)?;
        row.values = self
            .targets
            .iter()
            .zip(values)
            .map(|(target, value)| NamedValue { name: target.label.clone(), value })
            .collect();
        StressMap::read(&out, &case, &plan)
    }

    fn analyse(&mut self) -> Vec<vaso_io::ErrorEntry> {
        analysis::analyse(&mut self.runs, &self.targets)
    }

    /// Wall time of all runs \[s\].
    fn seconds(&self) -> f64 {
        self.runs.iter().map(|run| run.wall_clock_s).filter(|s| s.is_finite()).sum()
    }
}

/// The spacing that a variant sets \[m\].
fn spacing(variant: &Variant) -> Option<f64> {
    let (_, value) = variant.settings.iter().find(|(key, _)| key == "particles.spacing")?;
    value.strip_suffix(" m")?.parse().ok()
}

/// The settings with one frame of the particle series, at the end, unless the person has asked for more: writing is not what is
/// studied. The tables keep their interval.
fn thinned(case: &Case, settings: &Settings) -> Settings {
    let mut all = Settings::new();
    let asked = case.overrides.iter().any(|(key, _)| key == "output.every");
    if !asked {
        let seconds = |s: f64| format!("{s:e} s");
        all.push(("output.table_every".into(), seconds(case.scene.output.table_every)));
        all.push(("output.every".into(), seconds(case.scene.run.end_time)));
    }
    all.extend(settings.iter().cloned());
    all
}

//! `vaso new`: a case from a surface, with what is not known estimated and marked.

mod drawing;
mod inflow;
mod spacing;
mod text;
mod unit;

use crate::case::{Case, load_vessel, too_few_openings};
use crate::error::DriverError;
use crate::plan::Plan;
use crate::print::{self, duration, length};
use crate::tune::MMHG;
use inflow::Inflow;
use serde::Serialize;
use spacing::Chosen;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use text::{DIASTOLIC, DISTAL, Draft, SCHEMA, SYSTOLIC, WAVEFORM};
use vaso_boundary::{Split, Target, Tuned};
use vaso_geometry::{LengthUnit, Vessel};
use vaso_io::{CheckReport, write_whole};
use vaso_scene::Scene;

/// Speed of pulse waves in the vessels behind the outlets \[m/s\], the default of `vaso tune`.
const WAVE_SPEED: f64 = 7.0;
/// Density of the blood \[kg/m^3\].
const DENSITY: f64 = 1060.0;
const CASE: &str = "case.toml";
const DRAWING: &str = "openings.svg";

/// What was made, as data.
#[derive(Debug, Clone, Serialize)]
pub struct NewReport {
    /// The case file.
    pub case: PathBuf,
    /// All files written.
    pub files: Vec<PathBuf>,
    /// Unit of the coordinates.
    pub unit: String,
    /// Whether it was guessed.
    pub unit_guessed: bool,
    /// Why it is that one.
    pub unit_reason: String,
    /// Name of the opening taken for the inlet.
    pub inlet: String,
    /// Flow into it, mean over a beat \[m^3/s\].
    pub mean_inflow_m3_s: f64,
    /// Distance between particles \[m\].
    pub spacing_m: f64,
    /// Particles across the narrowest opening.
    pub particles_across: f64,
    /// What `vaso check` says of the case.
    pub check: CheckReport,
}

/// A case that was made, for people and for programs.
pub struct NewCase {
    /// Lines to read.
    pub text: String,
    /// The same as data.
    pub report: NewReport,
}

impl NewReport {
    /// The report as indented JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a report has texts for keys and no values that can fail")
    }
}

/// Makes the folder `folder` a case of the surface `file`, whose coordinates are in `unit` if that is given.
///
/// The case is planned before anything is written.
///
/// # Errors
/// When the folder holds something, the surface is wrong, it is as large as vessels are in no unit, or it has fewer than two openings; nothing is
/// written then. When the disk refuses.
pub fn new(folder: &Path, file: &Path, unit: Option<LengthUnit>) -> Result<NewCase, DriverError> {
    is_free(folder)?;
    let name = surface_name(file)?;
    let (vessel, unit_reason) = measure(file, unit)?;
    let names: Vec<String> = (0..vessel.openings.len()).map(opening_name).collect();
    let inflow = Inflow::new(&vessel.openings[0], &vessel.openings[1..]);
    let outlets = outlets(&vessel, &inflow, file)?;
    let draft = Draft {
        vessel: &vessel,
        surface: &name,
        unit: &unit_reason,
        names: &names,
        inflow: &inflow,
        outlets: &outlets,
    };
    let load = |chosen: &Chosen| load(&draft, chosen);
    let narrowest = vessel.openings.iter().map(|o| o.radius).fold(f64::INFINITY, f64::min);
    let chosen = spacing::choose(narrowest, |millimetres| {
        Plan::new(&load(&Chosen { millimetres, across: 0.0, reason: String::new() })?)
    })?;
    let case = load(&chosen)?;
    let plan = Plan::new(&case)?;

    let surface = std::fs::read(file).map_err(|source| DriverError::Geometry {
        file: file.to_owned(),
        source: vaso_geometry::GeometryError::Read { path: file.to_owned(), source },
    })?;
    let label = format!("openings of {name}");
    // The case last: a folder without it is none, whatever ends the writing early.
    let files = [
        (name.as_str(), surface),
        (WAVEFORM, inflow.table().into_bytes()),
        (SCHEMA, vaso_scene::case_schema().into_bytes()),
        (DRAWING, drawing::draw(&vessel, &names, &label).into_bytes()),
        (CASE, draft.text(&chosen).into_bytes()),
    ];
    std::fs::create_dir_all(folder).map_err(|e| {
        DriverError::input(format!("{}: the folder cannot be made: {e}; name another", folder.display()))
    })?;
    for (name, bytes) in &files {
        write_whole(&folder.join(name), bytes)?;
    }
    let report = NewReport {
        case: folder.join(CASE),
        files: files.iter().map(|(name, _)| folder.join(name)).collect(),
        unit: vessel.unit.to_string(),
        unit_guessed: unit.is_none(),
        unit_reason: unit_reason.clone(),
        inlet: names[0].clone(),
        mean_inflow_m3_s: inflow.mean,
        spacing_m: 1e-3 * chosen.millimetres,
        particles_across: chosen.across,
        check: crate::check::planned(&case, &plan),
    };
    let text = words(&case, &plan, &report, &inflow, &chosen, (file, folder));
    Ok(NewCase { text, report })
}

/// Whether a case may be made in a folder: one that is not there yet, or empty.
fn is_free(folder: &Path) -> Result<(), DriverError> {
    let refuse = |seen: String| {
        Err(DriverError::input(format!(
            "{}: {seen}; nothing was written over: name a folder that is new or empty",
            folder.display()
        )))
    };
    match std::fs::read_dir(folder) {
        Ok(mut entries) => match entries.next() {
            None => Ok(()),
            Some(_) if folder.join(CASE).exists() => {
                refuse(format!("there is a {CASE} in this folder already"))
            }
            Some(_) => refuse("the folder is not empty".to_owned()),
        },
        Err(_) if folder.exists() => refuse("is there, and is no folder that can be read".to_owned()),
        Err(_) => Ok(()),
    }
}

/// Name of the copy of the surface.
fn surface_name(file: &Path) -> Result<String, DriverError> {
    let name = file.file_name().and_then(|name| name.to_str()).ok_or_else(|| {
        DriverError::input(format!("{}: the surface has no name that is UTF-8; rename it", file.display()))
    })?;
    if [CASE, WAVEFORM, SCHEMA, DRAWING].iter().any(|own| own.eq_ignore_ascii_case(name)) {
        return Err(DriverError::input(format!(
            "{}: a case has a file of this name that is something else; rename the surface",
            file.display()
        )));
    }
    Ok(name.to_owned())
}

/// The vessel with what is to be said about its unit.
fn measure(file: &Path, unit: Option<LengthUnit>) -> Result<(Vessel, String), DriverError> {
    let enough = |vessel: &Vessel| match vessel.openings.len() {
        0 | 1 => Err(DriverError::input(format!("{}: {}", file.display(), too_few_openings(vessel)))),
        _ => Ok(()),
    };
    // Without a unit it is measured as if in millimetres; what is found does not depend on it.
    let vessel = load_vessel(file, Some(unit.unwrap_or(LengthUnit::Millimetre)))?;
    enough(&vessel)?;
    if unit.is_some() {
        let reason = unit::given(&vessel);
        return Ok((vessel, reason));
    }
    let (guess, reason) = unit::guess(&vessel, file)?;
    if guess == vessel.unit {
        return Ok((vessel, reason));
    }
    let vessel = load_vessel(file, Some(guess))?;
    enough(&vessel)?;
    Ok((vessel, reason))
}

/// Name of opening `k`, by area.
fn opening_name(k: usize) -> String {
    if k == 0 { "inlet".to_owned() } else { format!("outlet-{k}") }
}

/// Windkessels for the cuff pressures of a healthy adult, as `vaso tune` would find them.
fn outlets(vessel: &Vessel, inflow: &Inflow, file: &Path) -> Result<Vec<Tuned>, DriverError> {
    let wrong = |text: String| DriverError::input(format!("{}: {text}", file.display()));
    let areas: Vec<f64> = vessel.openings[1..].iter().map(|o| o.area).collect();
    let target = Target {
        systolic: SYSTOLIC * MMHG,
        diastolic: DIASTOLIC * MMHG,
        distal_pressure: DISTAL * MMHG,
        split: Split::MURRAY,
        wave_speed: WAVE_SPEED,
        density: DENSITY,
    };
    let waveform = inflow.waveform().map_err(|e| wrong(e.to_string()))?;
    vaso_boundary::tune(&waveform, &areas, &target).map_err(|e| wrong(e.to_string()))
}

/// The case as it will be read, before it is written.
fn load(draft: &Draft<'_>, chosen: &Chosen) -> Result<Case, DriverError> {
    let files = [(draft.surface, String::new()), (WAVEFORM, draft.inflow.table())];
    let files: BTreeMap<PathBuf, String> =
        files.into_iter().map(|(name, text)| (PathBuf::from(name), text)).collect();
    let scene = Scene::parse(&draft.text(chosen), &[], &files)?;
    Case::of_parts(scene, draft.vessel.clone())
}

fn words(
    case: &Case,
    plan: &Plan,
    report: &NewReport,
    inflow: &Inflow,
    chosen: &Chosen,
    (file, folder): (&Path, &Path),
) -> String {
    let mut text = print::audit(&case.vessel, file);
    let mut line = |label: &str, words: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{label:<8} {words}");
    };
    line("unit", format!("\"{}\", {}", report.unit, report.unit_reason));
    for (k, opening) in plan.openings.iter().enumerate() {
        let (area, radius) = (1e6 * opening.opening.area, length(opening.opening.radius));
        let role = if k == 0 { "assumed, as it is the largest" } else { "Windkessel" };
        line("opening", format!("{:<10} {area:8.3} mm2  radius {radius:<8}  {role}", opening.name));
    }
    line("inflow", format!("{:.3} ml/s in the mean: {}", 1e6 * inflow.mean, inflow.reason));
    line(
        "outlets",
        format!(
            "for {SYSTOLIC}/{DIASTOLIC} mmHg, the flow split by the cubes of the radii; `vaso tune` for others"
        ),
    );
    line(
        "spacing",
        format!(
            "{} mm, {:.1} particles across the narrowest opening: {}",
            chosen.millimetres, chosen.across, chosen.reason
        ),
    );
    line(
        "cost",
        format!(
            "about {} here for {} s of flow, {} particles of blood",
            duration(plan.expected().wall_clock_s),
            plan.end_time,
            plan.predicted.particles.fluid
        ),
    );
    for warning in &plan.warnings {
        line("warning", warning.clone());
    }
    let names: Vec<String> = report.files.iter().map(|file| file.display().to_string()).collect();
    line("wrote", names.join(", "));
    line("next", format!("vaso run {}", folder.display()));
    text
}

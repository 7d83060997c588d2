//! `vaso check`: what would run, without running it.

use crate::bodies::remembered_warnings;
use crate::case::{Case, load_vessel, rank_name, too_few_openings};
use crate::error::DriverError;
use crate::plan::Plan;
use crate::print;
use crate::results::{numbers, opening_entry, surface_report};
use std::fmt::Write;
use std::path::Path;
use vaso_geometry::{LengthUnit, Vessel};
use vaso_io::CheckReport;

/// Answer of a check, for people and for programs.
pub struct Checked {
    /// Lines to read.
    pub text: String,
    /// The same as data.
    pub report: CheckReport,
}

/// Checks a case: audit, openings, plan, prediction. A case without `[[opening]]` lists the openings found.
///
/// # Errors
/// When the case or the surface is wrong.
pub fn case(path: &Path, overrides: &[(String, String)]) -> Result<Checked, DriverError> {
    let case = Case::load(path, overrides)?;
    if case.scene.openings.is_empty() {
        return Ok(vessel(&case.vessel, &case.scene.geometry.surface));
    }
    let mut plan = Plan::new(&case)?;
    plan.warnings.extend(remembered_warnings(&case));
    let report = planned(&case, &plan);
    let text = print::audit(&case.vessel, &case.scene.geometry.surface) + &print::plan(&case, &plan);
    Ok(Checked { text, report })
}

/// The answer about a case that was planned.
pub(crate) fn planned(case: &Case, plan: &Plan) -> CheckReport {
    CheckReport {
        surface: surface_report(&case.vessel),
        openings: plan.openings.iter().map(|o| opening_entry(&o.name, &o.opening)).collect(),
        numbers: Some(numbers(plan)),
        effects: plan.effects.clone(),
        predicted: Some(plan.expected()),
        warnings: plan.warnings.clone(),
    }
}

/// Checks a bare surface.
///
/// # Errors
/// When it cannot be read or encloses nothing.
pub fn surface(file: &Path, unit: Option<LengthUnit>) -> Result<Checked, DriverError> {
    Ok(vessel(&load_vessel(file, unit)?, file))
}

fn vessel(vessel: &Vessel, file: &Path) -> Checked {
    let mut text = print::audit(vessel, file);
    let metres = vessel.unit.metres();
    for (k, o) in vessel.openings.iter().enumerate() {
        let (c, n) = (o.center / metres, o.normal);
        let _ = writeln!(
            text,
            "opening  {:<10} near [{:.4}, {:.4}, {:.4}] {}  normal [{:.4}, {:.4}, {:.4}]  area {:.3} mm2  radius {:.3} mm",
            rank_name(k),
            c.x,
            c.y,
            c.z,
            vessel.unit,
            n.x,
            n.y,
            n.z,
            o.area * 1e6,
            o.radius * 1e3
        );
    }
    let mut warnings = vessel.audit.notices.clone();
    if vessel.openings.len() < 2 {
        warnings.push(too_few_openings(vessel));
    }
    for warning in &warnings {
        let _ = writeln!(text, "warning  {warning}");
    }
    let report = CheckReport {
        surface: surface_report(vessel),
        openings: vessel.openings.iter().enumerate().map(|(k, o)| opening_entry(&rank_name(k), o)).collect(),
        warnings,
        ..CheckReport::default()
    };
    Checked { text, report }
}

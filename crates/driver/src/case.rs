//! A case with its vessel: the scene and the surface brought together.

use crate::error::{DriverError, problem};
use glam::DVec3;
use std::path::{Path, PathBuf};
use vaso_geometry::{LengthUnit, Vessel, prepare, read_surface};
use vaso_scene::Scene;

/// A case ready to be planned.
pub struct Case {
    /// What the file says.
    pub scene: Scene,
    /// The `--set` overrides it was read with.
    pub overrides: Vec<(String, String)>,
    /// The surface, repaired, with its openings.
    pub vessel: Vessel,
    /// For each opening of the vessel, the opening of the scene it is.
    pub scene_opening: Vec<Option<usize>>,
    /// Folder of the particle cache; a bare surface has none.
    pub cache: Option<PathBuf>,
}

/// Farthest a `near` point may lie from its opening, in radii of the opening.
const NEAR: f64 = 3.0;

impl Case {
    /// Reads the case at `path` (folder or file) with `--set` overrides, and its surface.
    ///
    /// # Errors
    /// When either is wrong, or the openings of the case are not those of the surface.
    pub fn load(path: &Path, overrides: &[(String, String)]) -> Result<Self, DriverError> {
        let scene = Scene::load(path, overrides)?;
        let vessel = load_vessel(&scene.geometry.surface, unit(&scene)?)?;
        let scene_opening = match_openings(&scene, &vessel)?;
        let cache = Some(scene.directory.join(".vaso-cache"));
        Ok(Self { scene, overrides: overrides.to_vec(), vessel, scene_opening, cache })
    }

    /// A scene and its vessel where neither has to be read.
    ///
    /// # Errors
    /// When the openings of the scene are not those of the vessel.
    pub(crate) fn of_parts(scene: Scene, vessel: Vessel) -> Result<Self, DriverError> {
        let scene_opening = match_openings(&scene, &vessel)?;
        Ok(Self { scene, overrides: Vec::new(), vessel, scene_opening, cache: None })
    }

    /// A bare surface with all that is to be said about its particles in `settings`, as for `--set`.
    ///
    /// # Errors
    /// When a setting or the surface is wrong.
    pub fn of_surface(file: &Path, settings: &[(String, String)]) -> Result<Self, DriverError> {
        let scene = Scene::of_surface(file, settings)?;
        let vessel = load_vessel(file, unit(&scene)?)?;
        let scene_opening = vec![None; vessel.openings.len()];
        Ok(Self { scene, overrides: settings.to_vec(), vessel, scene_opening, cache: None })
    }

    /// Name of opening `k` of the vessel: that of the case, or its rank by area.
    pub fn opening_name(&self, k: usize) -> String {
        match self.scene_opening[k] {
            Some(s) => self.scene.openings[s].name.clone(),
            None => rank_name(k),
        }
    }
}

/// Unit of the coordinates, where the scene names one.
fn unit(scene: &Scene) -> Result<Option<LengthUnit>, DriverError> {
    let parsed = scene.geometry.unit.as_deref().map(str::parse::<LengthUnit>).transpose();
    parsed.map_err(|e| DriverError::input(format!("{}: `geometry.unit`: {e}", scene.file.display())))
}

/// Name of an opening the case says nothing about.
pub fn rank_name(k: usize) -> String {
    format!("opening{}", k + 1)
}

/// Reads and repairs a surface.
///
/// # Errors
/// When the file cannot be read or encloses nothing.
pub fn load_vessel(file: &Path, unit: Option<LengthUnit>) -> Result<Vessel, DriverError> {
    let wrong = |source| DriverError::Geometry { file: file.to_owned(), source };
    prepare(read_surface(file).map_err(wrong)?, unit).map_err(wrong)
}

fn match_openings(scene: &Scene, vessel: &Vessel) -> Result<Vec<Option<usize>>, DriverError> {
    let mut found = vec![None; vessel.openings.len()];
    let mut problems = Vec::new();
    let list = || {
        let metres = vessel.unit.metres();
        let rows = vessel.openings.iter().enumerate().map(|(k, o)| {
            let c = o.center / metres;
            format!(
                "    {}: near = [{:.3}, {:.3}, {:.3}], radius {:.3}",
                rank_name(k),
                c.x,
                c.y,
                c.z,
                o.radius / metres
            )
        });
        rows.collect::<Vec<_>>().join("\n")
    };
    for (s, opening) in scene.openings.iter().enumerate() {
        let point = DVec3::from_array(opening.near) * vessel.unit.metres();
        let Some(k) = vessel.opening_near(point) else { continue };
        let away = vessel.openings[k].distance(point) / vessel.openings[k].radius;
        if away > NEAR {
            problems.push(problem(
                scene,
                &format!("opening.{}.near", opening.name),
                format!("is {away:.1} radii from the nearest opening of the surface"),
                format!("at most {NEAR} radii, in the unit of the surface (\"{}\")", vessel.unit),
                format!("take one of these, or correct `geometry.unit`\n{}", list()),
            ));
        } else if let Some(other) = found[k].replace(s) {
            problems.push(problem(
                scene,
                &format!("opening.{}.near", opening.name),
                format!("is at the same opening as that of `{}`", scene.openings[other].name),
                "a point near another opening for each",
                format!("take one of these\n{}", list()),
            ));
        }
    }
    if vessel.openings.len() < 2 && scene.blood.is_some() {
        problems.push(format!("{}: {}", scene.geometry.surface.display(), too_few_openings(vessel)));
    }
    if problems.is_empty() { Ok(found) } else { Err(DriverError::Input { problems }) }
}

/// What to say of a vessel that blood cannot go through.
pub(crate) fn too_few_openings(vessel: &Vessel) -> String {
    let candidates = vessel.audit.flat_regions.iter().filter_map(|region| {
        let (c, rejected) = (region.center / vessel.unit.metres(), region.rejected?);
        Some(format!("\n    flat region at [{:.3}, {:.3}, {:.3}]: {rejected}", c.x, c.y, c.z))
    });
    let candidates: String = candidates.collect();
    format!(
        "{} openings found, blood needs at least 2; cut the surface open where blood goes in and out, or close it there by \
         flat caps across the vessel{}{candidates}",
        vessel.openings.len(),
        if candidates.is_empty() { "" } else { "; these flat parts are none:" },
    )
}

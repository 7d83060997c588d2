//! A case with its vessel: the scene and the surface brought together.

use crate::error::DriverError;
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
    let file = scene.file.display();
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
            problems.push(format!(
                "{file}: `opening.{}.near`: {:?} is {away:.1} radii from the nearest opening, allowed are {NEAR}; \
                 coordinates are in the unit of the surface (\"{}\"), and its openings are\n{}",
                opening.name, opening.near, vessel.unit, list()
            ));
        } else if let Some(other) = found[k].replace(s) {
            problems.push(format!(
                "{file}: `opening.{}.near`: {:?} is at the same opening as `{}`; each needs one of\n{}",
                opening.name,
                opening.near,
                scene.openings[other].name,
                list()
            ));
        }
    }
    if vessel.openings.len() < 2 && scene.blood.is_some() {
        let candidates = vessel.audit.flat_regions.iter().map(|r| {
            let c = r.center / vessel.unit.metres();
            format!("    flat region at [{:.3}, {:.3}, {:.3}]: {:?}", c.x, c.y, c.z, r.rejected)
        });
        problems.push(format!(
            "{}: {} openings found, blood needs at least 2; open ends or flat caps across the vessel are \
             recognised{}{}",
            scene.geometry.surface.display(),
            vessel.openings.len(),
            if vessel.audit.flat_regions.is_empty() { "" } else { ", these were looked at:\n" },
            candidates.collect::<Vec<_>>().join("\n")
        ));
    }
    if problems.is_empty() { Ok(found) } else { Err(DriverError::Input { problems }) }
}

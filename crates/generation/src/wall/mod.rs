//! Walls: the layer of a given thickness around the lumen, open at its ends.

mod closed;
mod collared;

use crate::ends::{self, Ends};
use crate::frame::Frame;
use crate::region::Region;
use crate::{Body, GenerationError, Settings, Warning, error, fill, lattice};
use closed::ClosedLayer;
use collared::CollaredLayer;
use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::{SignedDistance, Vessel};

/// Thickness of a rigid wall, in spacings: one kernel support and more at the usual smoothing length.
pub const WALL_LAYERS: f64 = 4.0;

/// Particles of a wall.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// The particles. With ends that are opened after the relaxation its quality is that before.
    pub body: Body,
    /// Whether the particle belongs to the ring that is held at an opening.
    pub clamped: Vec<bool>,
    /// Share of the wall that is also within its thickness of another part of the lumen surface that looks
    /// the other way: where limbs are nearer than two thicknesses they have one wall.
    pub shared: f64,
    /// Thickness t \[m\].
    pub thickness: f64,
}

impl Wall {
    /// What is doubtful about the wall.
    pub fn warning(&self) -> Option<Warning> {
        let &Self { shared, thickness, .. } = self;
        (shared > 0.0).then_some(Warning::SharedWall { shared, thickness })
    }
}

/// Surrounds the lumen of `vessel` with a wall of `thickness` \[m\], at least one spacing, with `ends` at its
/// openings.
///
/// The wall is the layer within that distance of the lumen surface: it needs no offset surface, cannot cut
/// itself, and where limbs come close their walls merge, which [`Wall::shared`] tells.
///
/// # Errors
/// As for [`fluid`](crate::fluid), and a thickness or collar out of range.
pub fn wall(
    vessel: &Vessel,
    settings: &Settings,
    thickness: f64,
    ends: Ends,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Wall, GenerationError> {
    let frame = Frame::of(vessel);
    let vessel = &frame.localize(vessel);
    let mut body = match ends {
        Ends::Collar { length } => collared(vessel, settings, thickness, length, progress)?,
        Ends::ClosestCap | Ends::Boxes => opened(vessel, settings, thickness, ends, progress)?,
    };
    let &Settings { spacing, smoothing, .. } = settings;
    let ring = ends::ring(spacing, smoothing);
    let lateral = thickness + ends::LATERAL * spacing;
    let clamped = ends::clamped(vessel, &body.position, &body.normal, ring, lateral);
    let closed = SignedDistance::closed(vessel);
    let is_shared = |(x, normal): (&DVec3, &DVec3)| closed.facing(*x, *normal, thickness).is_some();
    let shared = body.position.par_iter().zip(&body.normal).filter(|pair| is_shared(*pair)).count();
    let shared = shared as f64 / body.position.len().max(1) as f64;
    frame.restore(&mut body);
    Ok(Wall { body, clamped, shared, thickness })
}

/// Surrounds the lumen of `vessel` with a wall of [`WALL_LAYERS`] spacings.
///
/// The wall is the layer within that distance of the lumen surface, so walls of limbs that come close
/// merge, and none enters a lumen. At each opening it goes on straight for 2h; nothing stands in front
/// of the opening.
///
/// # Errors
/// As for [`fluid`](crate::fluid).
pub fn rigid_wall(
    vessel: &Vessel,
    settings: &Settings,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Body, GenerationError> {
    let frame = Frame::of(vessel);
    let (thickness, collar) = (WALL_LAYERS * settings.spacing, 2.0 * settings.smoothing_length());
    let mut body = collared(&frame.localize(vessel), settings, thickness, collar, progress)?;
    frame.restore(&mut body);
    Ok(body)
}

/// A wall that goes on straight for `collar` \[m\] beyond each opening, relaxed with its ends.
fn collared(
    vessel: &Vessel,
    settings: &Settings,
    thickness: f64,
    collar: f64,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Body, GenerationError> {
    check(vessel, settings, thickness)?;
    if !(collar >= 0.0 && collar.is_finite()) {
        return Err(GenerationError::Setting { key: "collar", value: collar, allowed: "0 m or more" });
    }
    let dp = settings.spacing;
    let region = CollaredLayer::new(vessel, thickness, collar, dp, settings.smoothing_length());
    let volume = lattice::volume(&region, 0.5 * dp);
    let mut body = fill(&region, volume, settings, progress)?;
    // Between limbs nearer than a spacing there is no room: what is left in a lumen is taken out.
    let closed = SignedDistance::closed(vessel);
    let keep = |x: &DVec3| closed.query(*x).distance > 0.0 && region.exact_level(*x) < 0.0;
    let kept: Vec<DVec3> = body.position.par_iter().copied().filter(keep).collect();
    body.quality.count = kept.len();
    body.quality.volume_error = kept.len() as f64 * dp.powi(3) / volume - 1.0;
    body.volume.truncate(kept.len());
    body.position = kept;
    (body.depth, body.normal) = body.position.par_iter().map(|x| region.depth(*x)).unzip();
    Ok(body)
}

/// A wall around the closed surface, relaxed without ends and opened afterwards by the rule of `ends`.
fn opened(
    vessel: &Vessel,
    settings: &Settings,
    thickness: f64,
    ends: Ends,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Body, GenerationError> {
    check(vessel, settings, thickness)?;
    let dp = settings.spacing;
    let region = ClosedLayer::new(vessel, thickness, dp, settings.smoothing_length());
    let volume = lattice::volume(&region, 0.5 * dp);
    let mut body = fill(&region, volume, settings, progress)?;
    let lateral = thickness + ends::LATERAL * dp;
    let height = thickness.max(ends::BOX_HEIGHT * dp);
    let kept: Vec<(DVec3, f64, DVec3)> = body
        .position
        .par_iter()
        .filter_map(|&x| {
            let nearest = region.exact.query(x);
            let is_end = match ends {
                Ends::Boxes => ends::in_box(vessel, x, height, lateral),
                _ => ends::beyond_cap(vessel, x, &nearest, lateral),
            };
            (nearest.distance > 0.0 && !is_end).then_some((x, nearest.distance, nearest.normal))
        })
        .collect();
    body.volume.truncate(kept.len());
    body.position = kept.iter().map(|k| k.0).collect();
    body.depth = kept.iter().map(|k| k.1).collect();
    body.normal = kept.iter().map(|k| k.2).collect();
    body.quality.count = kept.len();
    Ok(body)
}

fn check(vessel: &Vessel, settings: &Settings, thickness: f64) -> Result<(), GenerationError> {
    error::check(vessel, settings)?;
    // A layer thinner than the distance its particles keep from both faces has no inside.
    if !(thickness >= settings.spacing && thickness.is_finite()) {
        let allowed = "one spacing or more; a thinner wall is a shell";
        return Err(GenerationError::Setting { key: "thickness", value: thickness, allowed });
    }
    error::particle_count(vessel.surface.area() * thickness, settings.spacing)?;
    Ok(())
}

//! A shell: one layer of particles on the wall of a vessel.

mod allotment;
mod curvature;
mod plane_kernel;
mod quality;
mod relax;
mod sheet;

pub use allotment::Allotment;
pub use quality::ShellQuality;

use crate::frame::Frame;
use crate::{GenerationError, ends, error, extended};
use glam::DVec3;
use plane_kernel::PlaneKernel;
use relax::SheetRelaxation;
use serde::{Deserialize, Serialize};
use sheet::{Foot, Sheet};
use vaso_geometry::Vessel;

/// The surface the particles of a shell stand on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ShellReference {
    /// The surface of the lumen; right for a rigid shell.
    Lumen,
    /// Half a thickness outside it, the surface a shell deforms about; where a wall would fold onto itself it is thinner.
    #[default]
    MidSurface,
}

/// How the particles of a shell are made.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellSettings {
    /// Distance between particles dp \[m\].
    pub spacing: f64,
    /// Smoothing length over spacing h/dp, 1 to 2.
    pub smoothing: f64,
    /// Thickness of the wall t \[m\].
    pub thickness: f64,
    /// The surface the particles stand on.
    pub reference: ShellReference,
    /// How far the wall goes on straight beyond each opening \[m\], less where another limb is in the way.
    pub collar: f64,
    /// How particles are shared out among triangles.
    pub allotment: Allotment,
    /// Most relaxation steps.
    pub steps: usize,
    /// Seed of the random start displacement.
    pub seed: u64,
}

impl ShellSettings {
    /// The usual settings for a `spacing` \[m\] and a `thickness` \[m\]: mid-surface, h = 1.15 dp, no collar,
    /// 500 steps.
    pub fn new(spacing: f64, thickness: f64) -> Self {
        Self {
            spacing,
            smoothing: 1.15,
            thickness,
            reference: ShellReference::MidSurface,
            collar: 0.0,
            allotment: Allotment::Cumulative,
            steps: 500,
            seed: 0,
        }
    }
}

/// Particles of a shell.
#[derive(Clone, Debug, PartialEq)]
pub struct ShellBody {
    /// Positions \[m\], neighbours near each other in memory.
    pub position: Vec<DVec3>,
    /// Smoothed unit normals, away from the lumen.
    pub normal: Vec<DVec3>,
    /// Area of each particle where it stands \[m^2\]: on the lumen surface the same for all, on the
    /// mid-surface stretched by the curvature.
    pub area: Vec<f64>,
    /// Thickness of the wall \[m\], less than asked for where it would fold onto itself.
    pub thickness: Vec<f64>,
    /// Principal curvatures of the surface the particles stand on, the larger first \[1/m\]; positive where
    /// normals spread, 1/R and 0 on a tube of radius R.
    pub curvature: Vec<[f64; 2]>,
    /// Whether the particle belongs to the ring that is held at an opening.
    pub clamped: Vec<bool>,
    /// How good the set is.
    pub quality: ShellQuality,
}

impl ShellBody {
    /// Mean curvature (k1 + k2) / 2 of particle `i` \[1/m\].
    ///
    /// # Panics
    /// When `i` is out of range.
    pub fn mean_curvature(&self, i: usize) -> f64 {
        0.5 * (self.curvature[i][0] + self.curvature[i][1])
    }
}

/// Covers the wall of `vessel` with one layer of relaxed particles.
///
/// There are `ceil(A / dp^2)` of them, A the area of the wall without caps (Wu et al. 2025, eq 1, there with
/// the caps, which are removed afterwards), and on the lumen surface their areas add up to A. They are relaxed
/// on the wall alone, which at a rim is thought to go on straight; so none has to be removed at the ends.
/// `progress` is told the relaxation step and the mean displacement in spacings.
///
/// # Errors
/// A setting out of range, or a spacing too coarse or too fine for the vessel.
pub fn shell(
    vessel: &Vessel,
    settings: &ShellSettings,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<ShellBody, GenerationError> {
    check(vessel, settings)?;
    let frame = Frame::of(vessel);
    let mut body = shell_of(&frame.localize(vessel), settings, progress)?;
    frame.restore_points(&mut body.position, &mut body.normal);
    Ok(body)
}

fn shell_of(
    vessel: &Vessel,
    settings: &ShellSettings,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<ShellBody, GenerationError> {
    let &ShellSettings { spacing, smoothing, steps, seed, .. } = settings;
    let drawn_out = (settings.collar > 0.0).then(|| extended::with_collars(vessel, settings.collar, spacing));
    let vessel = drawn_out.as_ref().unwrap_or(vessel);
    let area = vessel.wall_area();
    if area <= 0.0 {
        return Err(GenerationError::NoWall { openings: vessel.openings.len() });
    }
    let count = error::shell_count(area, vessel.surface.bounds(), spacing)?;

    let sheet = Sheet::new(vessel);
    let mut particles = start(vessel, &sheet, count, settings.allotment);
    let kernel = PlaneKernel::new(smoothing * spacing);
    let relaxation = SheetRelaxation { sheet: &sheet, kernel, spacing, area: area / count as f64 };
    let iterations = relaxation.run(&mut particles, steps, seed, progress);
    let listed = relaxation.list(&mut particles, 0.0);
    let mut quality = ShellQuality::measure(&relaxation, &listed, &particles, area);
    quality.iterations = iterations;
    let curvature = curvature::smooth(&mut particles, &listed, &kernel);

    let ring = ends::ring(spacing, smoothing);
    let position: Vec<DVec3> = particles.iter().map(|foot| foot.point).collect();
    let normal: Vec<DVec3> = particles.iter().map(|foot| foot.normal).collect();
    let lateral = settings.thickness + ends::LATERAL * spacing;
    let clamped = ends::clamped(vessel, &position, &normal, ring, lateral);
    let thickness = vec![settings.thickness; count];
    let area = vec![relaxation.area; count];
    let mut body = ShellBody { position, normal, area, thickness, curvature, clamped, quality };
    if settings.reference == ShellReference::MidSurface {
        let sharpest = curvature::sharpest(&particles, &listed, CLOSE * spacing);
        body.offset(&sharpest);
    }
    Ok(body)
}

/// The start: particles shared out among the wall triangles along a space-filling curve.
fn start(vessel: &Vessel, sheet: &Sheet<'_>, count: usize, allotment: Allotment) -> Vec<Foot> {
    let surface = &vessel.surface;
    let wall: Vec<u32> =
        (0..surface.triangles.len() as u32).filter(|&t| vessel.face_opening[t as usize].is_none()).collect();
    let order = allotment::morton_order(surface, &wall);
    let areas: Vec<f64> = order.iter().map(|&t| surface.triangle_area(t as usize)).collect();
    let shares = allotment::allot(&areas, count, allotment);
    allotment::places(surface, &order, &shares).map(|(x, t)| sheet.foot(x, t)).collect()
}

fn check(vessel: &Vessel, settings: &ShellSettings) -> Result<(), GenerationError> {
    error::check_spacing(vessel, settings.spacing, settings.smoothing)?;
    let &ShellSettings { thickness, collar, .. } = settings;
    if !(thickness > 0.0 && thickness.is_finite()) {
        return Err(GenerationError::Setting { key: "thickness", value: thickness, allowed: "above 0 m" });
    }
    if !(collar >= 0.0 && collar.is_finite()) {
        return Err(GenerationError::Setting { key: "collar", value: collar, allowed: "0 m or more" });
    }
    Ok(())
}

/// Distance up to which particles are close, in spacings: more than to the nearest, less than to the next but one.
const CLOSE: f64 = 1.6;
/// Least factor by which a wall may shrink a length between the lumen and its outer face.
const LEAST_STRETCH: f64 = 0.2;

impl ShellBody {
    /// Moves the particles along their normals to the middle of the wall; areas and curvatures follow by Steiner's formula,
    /// `A (1 + k1 d)(1 + k2 d)` and `k / (1 + k d)`.
    ///
    /// Beyond a centre of curvature, as between two branches, a wall would fold onto itself. What would lie there belongs to the other
    /// side already, so the wall ends before it, and is thinner there than asked for.
    ///
    /// `sharpest` is the least curvature \[1/m\] between each particle and those close to it: at a crease smoothed ones tell too little.
    fn offset(&mut self, sharpest: &[f64]) {
        for (i, k) in self.curvature.iter_mut().enumerate() {
            let least = k[0].min(k[1]).min(sharpest[i]);
            let largest = (1.0 - LEAST_STRETCH) / (-least).max(0.0);
            self.quality.folded += usize::from(self.thickness[i] > largest);
            self.thickness[i] = self.thickness[i].min(largest);
            let distance = 0.5 * self.thickness[i];
            let stretch = k.map(|k| 1.0 + k * distance);
            self.position[i] += distance * self.normal[i];
            self.area[i] *= stretch[0] * stretch[1];
            *k = [k[0] / stretch[0], k[1] / stretch[1]];
        }
    }
}

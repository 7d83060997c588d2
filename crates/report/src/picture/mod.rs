//! Pictures of a vessel drawn from its particles or its wall, without a graphics card or a window.
//!
//! Particles are opaque spheres and walls opaque triangles in parallel projection with a depth buffer; the view follows the
//! vessel's own principal axes. The same frame gives the same pixels on every machine.

mod canvas;
mod cut;
mod figure;
mod samples;
mod smooth;
mod splat;
mod surface;
mod view;

pub use canvas::Picture;
pub use figure::render_vessel_png;
pub(crate) use smooth::mean_at;
pub use surface::draw_surface;
pub(crate) use view::principal_axes;

use crate::ReportError;
use crate::scale::ticks;
use glam::DVec3;
use std::path::Path;
use vaso_io::{FrameData, schema};
use view::{Eye, View};

/// The quantity that colours particles or a wall.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Quantity {
    /// Magnitude of the velocity \[m/s\].
    Speed,
    /// Pressure \[Pa\], averaged over the particles within two spacings.
    Pressure,
    /// Magnitude of the wall shear stress \[Pa\].
    WallShear,
    /// Time-averaged wall shear stress of a cycle \[Pa\].
    Tawss,
    /// Oscillatory shear index of a cycle.
    Osi,
    /// Transverse wall shear stress of a cycle \[Pa\].
    TransverseWss,
    /// Volume of the particles, in cubed spacings where a field `Volume` has been made so.
    Volume,
}

impl Quantity {
    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Speed => "speed",
            Self::Pressure => "pressure",
            Self::WallShear => "wall shear stress",
            Self::Tawss => "time-averaged wall shear stress",
            Self::Osi => "oscillatory shear index",
            Self::TransverseWss => "transverse wall shear stress",
            Self::Volume => "volume",
        }
    }

    /// Name for beside a colour bar: that of the field where the whole one is long.
    pub(crate) fn short_name(self) -> &'static str {
        match self {
            Self::WallShear | Self::Tawss | Self::Osi | Self::TransverseWss => self.field(),
            _ => self.name(),
        }
    }

    /// Unit of the values; empty for a pure number.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Speed => "m/s",
            Self::Pressure | Self::WallShear | Self::Tawss | Self::TransverseWss => "Pa",
            Self::Osi => "",
            Self::Volume => "dp³",
        }
    }

    pub(crate) fn field(self) -> &'static str {
        match self {
            Self::Speed => schema::VELOCITY,
            Self::Pressure => schema::PRESSURE,
            Self::WallShear => schema::WSS,
            Self::Tawss => schema::TAWSS,
            Self::Osi => schema::OSI,
            Self::TransverseWss => schema::TRANSVERSE_WSS,
            Self::Volume => schema::VOLUME,
        }
    }

    /// Its values in a frame; `path` names the series in the error.
    pub(crate) fn values(self, frame: &FrameData, path: &Path) -> Result<Vec<f64>, ReportError> {
        if let Some(vectors) = frame.vector(self.field()) {
            return Ok(vectors.iter().map(|v| v.length()).collect());
        }
        frame.scalar(self.field()).map(<[f64]>::to_vec).ok_or_else(|| {
            let names = frame.scalars.iter().map(|(n, _)| n).chain(frame.vectors.iter().map(|(n, _)| n));
            ReportError::NoField {
                path: path.to_owned(),
                field: self.field().to_owned(),
                present: names.map(String::as_str).collect::<Vec<_>>().join(", "),
            }
        })
    }
}

/// What of the vessel is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Style {
    /// The half of the vessel behind its middle: the cut follows bends and branches.
    Cut,
    /// The vessel from outside.
    Outside,
    /// The largest value along each line of sight, seen across the direction of [`Style::Cut`].
    Peak,
}

/// How a picture is to be made.
#[derive(Debug, Clone, Copy)]
pub struct PictureOptions {
    /// What colours the particles.
    pub quantity: Quantity,
    /// What is shown.
    pub style: Style,
    /// Width \[pixels\]; the height follows from the vessel, up to the width.
    pub width: u32,
    /// Particle spacing \[m\]; measured from the particles when `None`.
    pub spacing: Option<f64>,
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self { quantity: Quantity::Speed, style: Style::Cut, width: 1600, spacing: None }
    }
}

/// A drawn vessel on a transparent ground with what its colours and lengths mean.
#[derive(Debug, Clone)]
pub struct VesselPicture {
    /// The pixels.
    pub picture: Picture,
    /// Value of the lowest colour.
    pub low: f64,
    /// Value of the highest colour.
    pub high: f64,
    /// Round values within the range, for the colour bar.
    pub ticks: Vec<f64>,
    /// Width of a pixel \[m\].
    pub pixel: f64,
}

/// Draws a frame of a particle series.
///
/// # Errors
/// [`ReportError::NoFrame`] for a frame without particles, [`ReportError::NoField`] when the field to be shown is
/// not in it; `path` names the series in both.
pub fn draw(frame: &FrameData, path: &Path, options: &PictureOptions) -> Result<VesselPicture, ReportError> {
    if frame.position.is_empty() {
        return Err(ReportError::NoFrame { path: path.to_owned() });
    }
    let values = options.quantity.values(frame, path)?;
    let spacing = options.spacing.filter(|&s| s > 0.0).unwrap_or_else(|| nearest_distance(&frame.position));
    let values = match options.quantity {
        Quantity::Pressure => smooth::local_mean(&frame.position, &values, spacing),
        _ => values,
    };
    let (low, high, ticks) = range(options.quantity, &values);

    let eye = if options.style == Style::Peak { Eye::Side } else { Eye::Front };
    let view = View::new(&frame.position, spacing, options.width, eye);
    let seen: Vec<DVec3> = frame.position.iter().map(|&x| view.to_pixels(x)).collect();
    let shown: Vec<usize> = match options.style {
        Style::Cut => cut::behind_the_middle(&seen, view.pixels(spacing)),
        Style::Outside | Style::Peak => (0..seen.len()).collect(),
    };
    let spheres = shown
        .iter()
        .filter(|&&i| seen[i].is_finite())
        .map(|&i| splat::Sphere { center: seen[i], value: (values[i] - low) / (high - low) });
    let spheres: Vec<splat::Sphere> = spheres.collect();
    let picture = splat::draw(&view, &spheres, view.pixels(spacing), options.style == Style::Peak);
    Ok(VesselPicture { picture, low, high, ticks, pixel: view.pixel() })
}

/// Colour range: what all but one in a hundred values at either end fit into, widened to round numbers.
/// Volumes are the same colours in every picture, so that pictures compare.
fn range(quantity: Quantity, values: &[f64]) -> (f64, f64, Vec<f64>) {
    if quantity == Quantity::Volume {
        return (0.5, 1.5, ticks(0.5, 1.5, 4));
    }
    let mut sorted: Vec<f64> = values.iter().copied().filter(|x| x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let at =
        |part: f64| sorted.get(((sorted.len().max(1) - 1) as f64 * part) as usize).copied().unwrap_or(0.0);
    let low = if quantity == Quantity::Pressure { at(0.01) } else { 0.0 };
    let ticks = ticks(low, at(0.99), 5);
    (ticks[0], ticks[ticks.len() - 1], ticks)
}

/// Median distance to the nearest other particle over a sample \[m\].
fn nearest_distance(position: &[DVec3]) -> f64 {
    const SAMPLE: usize = 200;
    let step = position.len().div_ceil(SAMPLE);
    let mut nearest: Vec<f64> = position
        .iter()
        .enumerate()
        .step_by(step)
        .map(|(i, x)| {
            let others = position.iter().enumerate().filter(|&(j, _)| j != i);
            others.map(|(_, y)| x.distance_squared(*y)).fold(f64::INFINITY, f64::min).sqrt()
        })
        .filter(|distance| distance.is_finite() && *distance > 0.0)
        .collect();
    nearest.sort_by(f64::total_cmp);
    // One particle alone has no neighbour; any radius shows it.
    nearest.get(nearest.len() / 2).copied().unwrap_or(1.0)
}

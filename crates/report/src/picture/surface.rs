//! Triangles onto pixels.

use super::samples::{SAMPLES, Samples, brightness};
use super::view::{Eye, View};
use super::{Picture, Quantity, VesselPicture, range};
use crate::ReportError;
use glam::DVec3;
use std::path::Path;
use vaso_io::FrameData;

/// Distance between the two views as a part of the picture's width.
const GAP: f64 = 0.03;
/// Height over width above which the two views stand side by side.
const TALL: f64 = 0.5;
/// Reach of the shading as a part of the picture's width.
const SHADE_REACH: f64 = 0.004;
/// How much nearer parts darken those behind them: enough to part limbs, too little to change a colour on a slope.
const SHADE: f64 = 0.04;

/// Draws a frame of a surface, `width` pixels wide, seen from two opposite sides: one above the other, or side by side where the
/// vessel is about as high as long. Where the surface has no value it is grey.
///
/// # Errors
/// [`ReportError::NoFrame`] without points, triangles or any value, [`ReportError::NoField`] when the quantity is not in the frame;
/// `path` names the series in both.
pub fn draw_surface(
    frame: &FrameData,
    triangles: &[[u32; 3]],
    path: &Path,
    quantity: Quantity,
    width: u32,
) -> Result<VesselPicture, ReportError> {
    let values = quantity.values(frame, path)?;
    if triangles.is_empty() || !values.iter().any(|v| v.is_finite()) {
        return Err(ReportError::NoFrame { path: path.to_owned() });
    }
    let (low, high, ticks) = range(quantity, &values);
    let surface = Surface {
        position: &frame.position,
        normal: normals(&frame.position, triangles),
        value: values.iter().map(|v| (v - low) / (high - low)).collect(),
        triangles,
    };
    let gap = GAP * f64::from(width);
    let half = ((f64::from(width) - gap) / 2.0) as u32;
    let side_by_side = {
        let view = View::new(&frame.position, 0.0, width, Eye::Front);
        f64::from(view.height) > TALL * f64::from(width)
    };
    let each = if side_by_side { half } else { width };
    let views = [Eye::Front, Eye::Back].map(|eye| View::new(&frame.position, 0.0, each, eye));
    let [front, back] = views.each_ref().map(|view| surface.draw(view));
    let (height, place) = if side_by_side {
        (front.height.max(back.height), (i64::from(width - half), 0))
    } else {
        let below = front.height + gap as u32;
        (below + back.height, (0, i64::from(below)))
    };
    let mut picture = Picture::filled(width, height, [0; 4]);
    picture.overlay(&front, 0, 0);
    picture.overlay(&back, place.0, place.1);
    Ok(VesselPicture { picture, low, high, ticks, pixel: views[0].pixel() })
}

/// A surface to be drawn.
struct Surface<'a> {
    position: &'a [DVec3],
    /// Unit normals of the points.
    normal: Vec<DVec3>,
    /// Place in the colour map, 0 to 1; NaN without a value.
    value: Vec<f64>,
    triangles: &'a [[u32; 3]],
}

/// A corner as the picture has it.
#[derive(Clone, Copy)]
struct Corner {
    /// Place \[samples\], z toward the eye.
    place: DVec3,
    /// Unit normal in the axes of the picture.
    normal: DVec3,
    value: f64,
}

impl Surface<'_> {
    fn draw(&self, view: &View) -> Picture {
        let mut samples = Samples::empty(view);
        for triangle in self.triangles {
            let corners = triangle.map(|v| v as usize).map(|v| Corner {
                place: view.to_pixels(self.position[v]) * SAMPLES as f64,
                normal: view.turned(self.normal[v]),
                value: self.value[v],
            });
            fill(&mut samples, &corners);
        }
        samples.shade(SHADE_REACH * samples.width as f64, SHADE);
        samples.to_picture(view.width, view.height)
    }
}

/// Fills the samples whose middle lies in a triangle, with depth, value and normal interpolated between its corners.
fn fill(samples: &mut Samples, corners: &[Corner; 3]) {
    let [a, b, c] = corners.map(|corner| corner.place);
    let area = (b - a).cross(c - a).z;
    if !area.is_finite() || area == 0.0 {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let span = |low: f64, high: f64, limit: usize| {
        let end = (high + 0.5).floor().clamp(0.0, limit as f64) as usize;
        ((low - 0.5).ceil().max(0.0) as usize).min(end)..end
    };
    for y in span(low.y, high.y, samples.height) {
        for x in span(low.x, high.x, samples.width) {
            let at = DVec3::new(x as f64 + 0.5, y as f64 + 0.5, 0.0);
            let part = |p: DVec3, q: DVec3| (q - p).cross(at - p).z / area;
            let weight = [part(b, c), part(c, a), part(a, b)];
            if weight.iter().any(|&w| w < 0.0) {
                continue;
            }
            let mix =
                |of: fn(&Corner) -> f64| weight.iter().zip(corners).map(|(w, k)| w * of(k)).sum::<f64>();
            let normal: DVec3 = weight.iter().zip(corners).map(|(w, k)| *w * k.normal).sum();
            // Through an open end the inner side is seen.
            let facing = if normal.z < 0.0 { -normal } else { normal };
            let light = brightness(facing.normalize_or_zero());
            samples.put(x, y, mix(|k| k.place.z), mix(|k| k.value), light);
        }
    }
}

/// Unit normals of points: those of their triangles by area.
fn normals(position: &[DVec3], triangles: &[[u32; 3]]) -> Vec<DVec3> {
    let mut normal = vec![DVec3::ZERO; position.len()];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| position[v as usize]);
        let twice_area = (b - a).cross(c - a);
        for &v in triangle {
            normal[v as usize] += twice_area;
        }
    }
    normal.into_iter().map(DVec3::normalize_or_zero).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::viridis;

    /// A square of two triangles at height z, and the view of it from +z.
    fn square(z: f64) -> [DVec3; 4] {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 0.5), (0.0, 0.5)].map(|(x, y)| DVec3::new(x, y, z))
    }

    const HALVES: [[u32; 3]; 2] = [[0, 1, 2], [0, 2, 3]];

    /// Colour without light: the largest channel is scaled back to that of the map.
    fn resembles(pixel: &[u8], value: f64) -> bool {
        let map = viridis(value);
        let light = f64::from(pixel[1]) / map[1];
        pixel[3] == 255
            && (0.5..1.05).contains(&light)
            && (0..3).all(|c| (f64::from(pixel[c]) - light * map[c]).abs() < 3.0)
    }

    fn view() -> View {
        View::new(&square(0.0), 0.0, 200, Eye::Front)
    }

    fn pixel(picture: &Picture, view: &View, x: DVec3) -> [u8; 4] {
        let at = view.to_pixels(x);
        let start = 4 * (at.y as usize * picture.width as usize + at.x as usize);
        std::array::from_fn(|c| picture.rgba[start + c])
    }

    fn surface<'a>(position: &'a [DVec3], triangles: &'a [[u32; 3]], value: &[f64]) -> Surface<'a> {
        Surface { position, normal: normals(position, triangles), value: value.to_vec(), triangles }
    }

    #[test]
    fn values_are_interpolated_and_nothing_is_left_out() {
        let corners = square(0.0);
        let value: Vec<f64> = corners.iter().map(|x| x.x).collect();
        let view = view();
        let picture = surface(&corners, &HALVES, &value).draw(&view);
        for x in [0.1, 0.25, 0.5, 0.75, 0.9] {
            let seen = pixel(&picture, &view, DVec3::new(x, 0.2, 0.0));
            assert!(resembles(&seen, x), "{seen:?} at {x}");
        }
        let covered = picture.rgba.chunks_exact(4).map(|p| f64::from(p[3]) / 255.0).sum::<f64>();
        // Half of the square of the unit, in pixels, seen under the tilt of the view.
        let expected = 0.5 * view.pixels(1.0).powi(2) * view.turned(DVec3::Z).z.abs();
        assert!((covered / expected - 1.0).abs() < 0.01, "{covered} of {expected}");
    }

    #[test]
    fn the_nearer_side_is_seen_from_either_side_whatever_the_order() {
        let position: Vec<DVec3> = square(0.0).into_iter().chain(square(0.2)).collect();
        let value = [0.2, 0.2, 0.2, 0.2, 0.8, 0.8, 0.8, 0.8];
        let upper = HALVES.map(|t| t.map(|v| v + 4));
        let orders = [[HALVES, upper].concat(), [upper, HALVES].concat()];
        let middle = DVec3::new(0.5, 0.25, 0.1);
        for eye in [Eye::Front, Eye::Back] {
            let view = View::new(&position, 0.0, 200, eye);
            let [one, other] = orders.each_ref().map(|order| surface(&position, order, &value).draw(&view));
            assert!(one == other);
            let from_above = view.turned(DVec3::Z).z > 0.0;
            let nearer = if from_above { 0.8 } else { 0.2 };
            assert!(resembles(&pixel(&one, &view, middle), nearer), "{eye:?}");
        }
    }

    #[test]
    fn without_a_value_it_is_grey() {
        let corners = square(0.0);
        let view = view();
        let picture = surface(&corners, &HALVES, &[f64::NAN; 4]).draw(&view);
        let [r, g, b, a] = pixel(&picture, &view, DVec3::new(0.5, 0.2, 0.0));
        assert!(r == g && g == b && a == 255 && r > 60);
    }

    #[test]
    fn what_lies_outside_or_nowhere_does_no_harm() {
        let far = [DVec3::splat(1e9), DVec3::new(-1e9, 1e9, 0.0), DVec3::NAN, DVec3::ZERO];
        let view = view();
        let picture = surface(&far, &[[0, 1, 2], [3, 3, 3]], &[0.5; 4]).draw(&view);
        assert!(picture.rgba.iter().all(|&byte| byte == 0));
    }
}

//! Where the eye is.

use glam::{DMat3, DVec3};
use nalgebra::{Matrix3, SymmetricEigen};

/// Margin around the vessel as a part of the picture's width.
const MARGIN: f64 = 0.02;
/// The eye is raised by this angle over the vessel's main plane \[rad\], so that depth shows.
const TILT: f64 = 0.22;

/// The side a vessel is looked at from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Eye {
    /// Along the axis of least extent.
    Front,
    /// The same from behind.
    Back,
    /// Along the second axis.
    Side,
}

/// A parallel projection that fills the picture with the vessel.
#[derive(Debug, Clone)]
pub(super) struct View {
    pub(super) width: u32,
    pub(super) height: u32,
    /// Rows: right, down, toward the eye.
    rotation: DMat3,
    scale: f64,
    shift: DVec3,
}

impl View {
    /// Looks at `position` \[m\] from `eye`, the longest axis lying across, with a rim of `spacing` \[m\] around.
    pub(super) fn new(position: &[DVec3], spacing: f64, width: u32, eye: Eye) -> Self {
        let [longest, second, least] = principal_axes(position);
        let (right, up, toward) = match eye {
            Eye::Front => (longest, second, least),
            Eye::Back => (-longest, second, -least),
            Eye::Side => (longest, least, -second),
        };
        let (sin, cos) = TILT.sin_cos();
        let (up, toward) = (up * cos - toward * sin, toward * cos + up * sin);
        let rotation = DMat3::from_cols(right, -up, toward).transpose();

        let turned = position.iter().filter(|x| x.is_finite()).map(|&x| rotation * x);
        let (low, high) =
            turned.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let (low, high) = (low - spacing, high + spacing);
        let extent = high - low;
        let inner = f64::from(width) * (1.0 - 2.0 * MARGIN);
        let scale = inner / extent.x.max(extent.y);
        let margin = f64::from(width) * MARGIN;
        let height = (extent.y * scale + 2.0 * margin).ceil().clamp(1.0, f64::from(width));
        let middle = DVec3::new(f64::from(width) / 2.0, height / 2.0, 0.0);
        Self { width, height: height as u32, rotation, scale, shift: middle - scale * (low + high) / 2.0 }
    }

    /// Pixel coordinates: x to the right, y down, z toward the eye, all in pixels.
    pub(super) fn to_pixels(&self, x: DVec3) -> DVec3 {
        self.rotation * x * self.scale + self.shift
    }

    /// A direction in the axes of the picture: right, down, toward the eye.
    pub(super) fn turned(&self, direction: DVec3) -> DVec3 {
        self.rotation * direction
    }

    /// A length \[m\] in pixels.
    pub(super) fn pixels(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// Width of a pixel \[m\].
    pub(super) fn pixel(&self) -> f64 {
        1.0 / self.scale
    }
}

/// Unit axes of the cloud from the longest to the least, right-handed, each with its largest component
/// positive as far as handedness allows.
pub(crate) fn principal_axes(position: &[DVec3]) -> [DVec3; 3] {
    let finite = || position.iter().copied().filter(|x| x.is_finite());
    let count = finite().count().max(1) as f64;
    let mean = finite().sum::<DVec3>() / count;
    let mut moment = Matrix3::zeros();
    for x in finite() {
        let d = nalgebra::Vector3::from((x - mean).to_array());
        moment += d * d.transpose();
    }
    let eigen = SymmetricEigen::new(moment / moment.trace().max(f64::MIN_POSITIVE));
    let mut order = [0, 1, 2];
    order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]).then(a.cmp(&b)));
    let axis = |k: usize| {
        let column = eigen.eigenvectors.column(order[k]);
        let axis = DVec3::new(column[0], column[1], column[2]);
        let largest = axis.to_array().into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs())).unwrap_or(1.0);
        axis * largest.signum()
    };
    let (longest, second) = (axis(0), axis(1));
    [longest, second, longest.cross(second)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_follow_a_turned_box() {
        let turn = DMat3::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.0);
        let corners: Vec<DVec3> = (0..8)
            .map(|k| {
                let sign = |bit: i32| if k & bit == 0 { -1.0 } else { 1.0 };
                turn * DVec3::new(9.0 * sign(1), 4.0 * sign(2), sign(4)) + DVec3::splat(100.0)
            })
            .collect();
        let axes = principal_axes(&corners);
        for (axis, column) in axes.iter().zip([turn.x_axis, turn.y_axis, turn.z_axis]) {
            assert!((axis.dot(column).abs() - 1.0).abs() < 1e-12, "{axes:?}");
        }
        assert!((axes[0].cross(axes[1]) - axes[2]).length() < 1e-12);
    }

    #[test]
    fn everything_is_inside_the_picture_and_lengths_are_true() {
        let points = [
            DVec3::ZERO,
            DVec3::new(0.1, 0.0, 0.0),
            DVec3::new(0.05, 0.02, 0.0),
            DVec3::new(0.05, 0.0, 0.01),
        ];
        for eye in [Eye::Front, Eye::Back, Eye::Side] {
            let view = View::new(&points, 1e-3, 800, eye);
            for x in points {
                let p = view.to_pixels(x);
                assert!(p.x > 0.0 && p.x < 800.0 && p.y > 0.0 && p.y < f64::from(view.height), "{p}");
            }
            let length = (view.to_pixels(points[1]) - view.to_pixels(points[0])).length() * view.pixel();
            assert!((length - 0.1).abs() < 1e-12);
            // Seen from anywhere, it is not its mirror image.
            let [x, y, z] =
                [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| view.turned(axis) * DVec3::new(1.0, -1.0, 1.0));
            assert!((x.cross(y).dot(z) - 1.0).abs() < 1e-12);
        }
        // A point alone and a degenerate line still have a view.
        for few in [&points[..1], &points[..2]] {
            let view = View::new(few, 1e-3, 100, Eye::Front);
            assert!(view.to_pixels(few[0]).is_finite() && view.height >= 1);
        }
    }
}

//! Line drawings of what lies in space, seen along the normal of a plane: sections, blocks, particles of a slab.

use crate::color::viridis;
use crate::html::escape;
use crate::picture::principal_axes;
use crate::scale::{number, ticks};
use glam::{DVec2, DVec3};
use std::fmt::Write;

/// A plane to draw on, with its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// A point of it \[m\].
    pub origin: DVec3,
    /// Unit vector to the right.
    pub right: DVec3,
    /// Unit vector upwards, at right angles to it.
    pub up: DVec3,
}

impl Plane {
    /// The planes that show most of a cloud of points \[m\]: from the front, and the same from the side.
    pub fn facing(points: &[DVec3]) -> [Self; 2] {
        let [longest, second, least] = principal_axes(points);
        let origin = points.iter().copied().sum::<DVec3>() / points.len().max(1) as f64;
        [second, least].map(|up| Self { origin, right: longest, up })
    }

    /// The plane through `origin` \[m\] at right angles to `normal`, which points to the eye; its axes are chosen.
    pub fn across(origin: DVec3, normal: DVec3) -> Self {
        let (right, up) = normal.normalize_or(DVec3::Z).any_orthonormal_pair();
        Self { origin, right, up }
    }

    /// Where a point falls onto the plane \[m\].
    pub fn project(&self, x: DVec3) -> DVec2 {
        DVec2::new((x - self.origin).dot(self.right), (x - self.origin).dot(self.up))
    }

    /// Height of a point over the plane, towards the eye \[m\].
    pub fn height(&self, x: DVec3) -> f64 {
        (x - self.origin).dot(self.right.cross(self.up))
    }
}

/// How a line is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Red, green, blue.
    pub color: [u8; 3],
    /// Width \[pixels\].
    pub width: f64,
}

/// Something drawn.
#[derive(Debug, Clone)]
enum Mark {
    Line(Vec<DVec2>, Pen),
    Dot { center: DVec2, radius: f64, color: [u8; 3] },
    Label { at: DVec2, text: String, color: [u8; 3] },
}

/// A drawing on a plane; what is nearer to the eye covers what is farther.
#[derive(Debug, Clone)]
pub struct Drawing {
    plane: Plane,
    /// Marks with their mean heights.
    marks: Vec<(f64, Mark)>,
}

/// Part of a pixel below which points of a line are left out.
const FINE: f64 = 0.3;
/// Margin around a drawing, and height of the text below it \[pixels\].
const MARGIN: f64 = 10.0;
const FOOT: f64 = 26.0;
/// How much of their colour the farthest lines keep.
const FARTHEST: f64 = 0.45;

impl Drawing {
    /// An empty drawing.
    pub fn new(plane: Plane) -> Self {
        Self { plane, marks: Vec::new() }
    }

    /// Adds a line through points \[m\].
    pub fn line(&mut self, points: &[DVec3], pen: Pen) {
        let height = points.iter().map(|x| self.plane.height(*x)).sum::<f64>() / points.len().max(1) as f64;
        let points = points.iter().map(|x| self.plane.project(*x)).collect();
        self.marks.push((height, Mark::Line(points, pen)));
    }

    /// Adds a disc around a point, both in \[m\]; its colour is `value` between 0 and 1 on the colour map.
    pub fn dot(&mut self, center: DVec3, radius: f64, value: f64) {
        let color = viridis(value).map(|c| c.round() as u8);
        let mark = Mark::Dot { center: self.plane.project(center), radius, color };
        self.marks.push((self.plane.height(center), mark));
    }

    /// Writes `text` at a point \[m\], in front of everything.
    pub fn label(&mut self, at: DVec3, text: &str, color: [u8; 3]) {
        let mark = Mark::Label { at: self.plane.project(at), text: text.to_owned(), color };
        self.marks.push((f64::INFINITY, mark));
    }

    /// Lower left and upper right corner of what is drawn \[m\].
    fn bounds(&self) -> (DVec2, DVec2) {
        let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let add = |(low, high): (DVec2, DVec2), x: DVec2, r: f64| (low.min(x - r), high.max(x + r));
        self.marks.iter().fold(start, |box_, (_, mark)| match mark {
            Mark::Line(points, _) => points.iter().fold(box_, |b, x| add(b, *x, 0.0)),
            Mark::Dot { center, radius, .. } => add(box_, *center, *radius),
            Mark::Label { at, .. } => add(box_, *at, 0.0),
        })
    }

    /// The drawing as a group of SVG elements `width` pixels wide with a scale bar below, and its height; `scale` is
    /// that of pixels to metres.
    fn group(&self, width: f64, scale: f64) -> (String, f64) {
        let (low, high) = self.bounds();
        let extent = high - low;
        if !(scale.is_finite() && extent.is_finite()) {
            return (String::new(), FOOT);
        }
        let height = extent.y * scale + 2.0 * MARGIN;
        let middle = 0.5 * (low + high);
        let place = |x: DVec2| {
            DVec2::new(0.5 * width + (x.x - middle.x) * scale, 0.5 * height - (x.y - middle.y) * scale)
        };
        let mut order: Vec<usize> = (0..self.marks.len()).collect();
        order.sort_by(|&a, &b| self.marks[a].0.total_cmp(&self.marks[b].0).then(a.cmp(&b)));
        let heights = || self.marks.iter().map(|m| m.0).filter(|height| height.is_finite());
        let (far, near) =
            (heights().fold(f64::INFINITY, f64::min), heights().fold(f64::NEG_INFINITY, f64::max));
        // Drawings of one plane have no depth to show.
        let is_flat = near - far < 0.05 * extent.max_element();
        let mut svg = String::new();
        for (depth, mark) in order.iter().map(|&k| &self.marks[k]) {
            let nearness = if is_flat { 1.0 } else { (depth - far) / (near - far) };
            match mark {
                Mark::Line(points, pen) => {
                    let keep = FARTHEST + (1.0 - FARTHEST) * nearness;
                    let [r, g, b] = pen.color.map(|c| (255.0 - (255.0 - f64::from(c)) * keep).round() as u8);
                    let path = path(&points.iter().map(|x| place(*x)).collect::<Vec<_>>());
                    let _ = write!(
                        svg,
                        "<path fill=\"none\" stroke=\"#{r:02x}{g:02x}{b:02x}\" stroke-width=\"{}\" d=\"{path}\"/>",
                        pen.width
                    );
                }
                Mark::Dot { center, radius, color: [r, g, b] } => {
                    let c = place(*center);
                    let _ = write!(
                        svg,
                        "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{:.1}\" fill=\"#{r:02x}{g:02x}{b:02x}\"/>",
                        c.x,
                        c.y,
                        radius * scale
                    );
                }
                Mark::Label { at, text, color: [r, g, b] } => {
                    let at = place(*at);
                    // Towards the middle, so that it stays within the drawing; with a halo, as it stands before lines.
                    let (anchor, shift) = if at.x < 0.5 * width { ("start", 6.0) } else { ("end", -6.0) };
                    let _ = write!(
                        svg,
                        "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\" fill=\"#{r:02x}{g:02x}{b:02x}\" \
                         stroke=\"#fff\" stroke-width=\"3\" paint-order=\"stroke\" font-weight=\"600\">{}</text>",
                        at.x + shift,
                        at.y + 4.0,
                        escape(text)
                    );
                }
            }
            svg.push('\n');
        }
        let length = ticks(0.0, 1e3 * width / scale / 8.0, 1)[1];
        let _ = writeln!(
            svg,
            "<path fill=\"none\" stroke=\"#444\" stroke-width=\"2\" d=\"M{MARGIN} {y:.1}h{:.1}\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\">{} mm</text>",
            length * 1e-3 * scale,
            MARGIN + length * 1e-3 * scale + 6.0,
            height + 14.0,
            number(length, 3),
            y = height + 10.0
        );
        (svg, height + FOOT)
    }
}

/// Path through pixels, without points that no eye can tell from the line.
fn path(points: &[DVec2]) -> String {
    let mut text = String::new();
    let mut next = 0;
    while let Some(x) = points.get(next) {
        let _ = write!(text, "{}{:.1} {:.1}", if next == 0 { "M" } else { "L" }, x.x, x.y);
        let last = (next + 1..points.len()).take_while(|&end| is_straight(&points[next..=end])).last();
        next = last.unwrap_or(points.len());
    }
    text
}

/// Whether the points between the ends lie on the line between these.
fn is_straight(points: &[DVec2]) -> bool {
    let [first, inner @ .., last] = points else { return true };
    let way = (last - first).normalize_or_zero();
    let foot = |x: DVec2| *first + way * (x - first).dot(way).clamp(0.0, first.distance(*last));
    inner.iter().all(|x| foot(*x).distance(*x) < FINE)
}

/// Drawings with titles beside each other on one scale, `columns` in a row of `width` pixels, as one SVG element.
///
/// `label` says what is seen. A file of its own needs `is_file`; within a page the element goes without the name of
/// its language. The ground is white on purpose, as colours are chosen for it.
pub fn sheet(panels: &[(&str, &Drawing)], columns: usize, width: u32, label: &str, is_file: bool) -> String {
    const TITLE: f64 = 24.0;
    let columns = columns.clamp(1, panels.len().max(1));
    let panel = f64::from(width) / columns as f64;
    let extents =
        panels.iter().map(|(_, drawing)| drawing.bounds()).map(|(low, high)| (high - low).max_element());
    let scale = (panel - 2.0 * MARGIN) / extents.fold(0.0, f64::max);
    let (mut body, mut top) = (String::new(), 0.0);
    for row in panels.chunks(columns) {
        let groups: Vec<(String, f64)> = row.iter().map(|(_, drawing)| drawing.group(panel, scale)).collect();
        for (k, ((title, _), (svg, _))) in row.iter().zip(&groups).enumerate() {
            let left = k as f64 * panel;
            let _ = write!(
                body,
                "<g transform=\"translate({left:.1} {top:.1})\"><text x=\"{MARGIN}\" y=\"17\" font-weight=\"600\">{}</text>\
                 <g transform=\"translate(0 {TITLE})\">\n{svg}</g></g>\n",
                escape(title)
            );
        }
        top += TITLE + groups.iter().map(|g| g.1).fold(0.0, f64::max);
    }
    let name = if is_file { " xmlns=\"http://www.w3.org/2000/svg\"" } else { "" };
    format!(
        "<svg{name} viewBox=\"0 0 {width} {top:.0}\" width=\"{width}\" height=\"{top:.0}\" role=\"img\" aria-label=\"{}\" \
         font-family=\"system-ui, sans-serif\" font-size=\"13\" fill=\"#333\">\
         <rect width=\"{width}\" height=\"{top:.0}\" fill=\"#fff\"/>\n{body}</svg>\n",
        escape(label)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const PEN: Pen = Pen { color: [0, 0, 0], width: 1.0 };

    #[test]
    fn planes_measure_in_their_own_axes() {
        let plane = Plane::across(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 3.0, 4.0));
        let x = plane.origin + 2.0 * plane.right - 0.5 * plane.up + 7.0 * DVec3::new(0.0, 0.6, 0.8);
        assert!(plane.project(x).distance(DVec2::new(2.0, -0.5)) < 1e-12);
        assert!((plane.height(x) - 7.0).abs() < 1e-12);
    }

    #[test]
    fn labels_stand_in_front_and_what_they_say_is_no_markup() {
        let mut drawing = Drawing::new(Plane { origin: DVec3::ZERO, right: DVec3::X, up: DVec3::Y });
        drawing.label(DVec3::ZERO, "a<b", [1, 2, 3]);
        drawing.line(&[DVec3::ZERO, DVec3::new(5e-3, 1e-3, 1e-3)], PEN);
        let svg = sheet(&[("one", &drawing)], 1, 300, "a line with a name", true);
        let (line, label) = (svg.find("<path"), svg.find("a&lt;b"));
        assert!(line.zip(label).is_some_and(|(line, label)| line < label), "{svg}");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn straight_lines_lose_their_inner_points_and_corners_stay() {
        let straight: Vec<DVec2> = (0..=100).map(|k| DVec2::new(f64::from(k), 0.5 * f64::from(k))).collect();
        assert_eq!(path(&straight), "M0.0 0.0L100.0 50.0");
        let corner = [DVec2::ZERO, DVec2::new(50.0, 0.0), DVec2::new(50.0, 50.0)];
        assert_eq!(path(&corner), "M0.0 0.0L50.0 0.0L50.0 50.0");
    }

    #[test]
    fn nearer_marks_come_later_and_nothing_is_no_harm() {
        let plane = Plane { origin: DVec3::ZERO, right: DVec3::X, up: DVec3::Y };
        let mut drawing = Drawing::new(plane);
        drawing.dot(DVec3::new(0.0, 0.0, 1e-3), 1e-3, 1.0);
        drawing.line(&[DVec3::new(-5e-3, 0.0, -1e-3), DVec3::new(5e-3, 1e-3, -1e-3)], PEN);
        let svg = sheet(&[("both", &drawing)], 1, 300, "a dot over a line", true);
        let (line, dot) = (svg.find("<path"), svg.find("<circle"));
        assert!(line.zip(dot).is_some_and(|(line, dot)| line < dot), "{svg}");
        assert!(svg.contains("2 mm") && !svg.contains("NaN"), "{svg}");
        let nothing = sheet(&[("none", &Drawing::new(plane))], 3, 300, "nothing", false);
        assert!(
            !nothing.contains("NaN") && !nothing.contains("inf") && !nothing.contains("http"),
            "{nothing}"
        );
    }
}

//! What the script of the page gets: a table of contents as JSON, and all numbers as codes.

use super::body::{Body, Coloring, Shape, Track};
use super::codes::{Bounds, Payload, STEPS, Span};
use super::fields::{Tick, colors};
use crate::color::VIRIDIS;
use crate::picture::principal_axes;
use glam::DVec3;
use serde::Serialize;
use vaso_io::OpeningSummary;

/// The table of contents. Places in the payload are counted in codes.
#[derive(Debug, Serialize)]
pub(super) struct Scene {
    /// Unit vectors right, up and toward the eye, one after the other.
    view: [f64; 9],
    /// Colours as sRGB, evenly from low to high.
    map: Vec<[u8; 3]>,
    openings: Vec<Mouth>,
    bodies: Vec<Shown>,
}

/// An opening where its name goes.
#[derive(Debug, Serialize)]
struct Mouth {
    name: String,
    center: [f64; 3],
    normal: [f64; 3],
    radius: f64,
}

/// A body. A position \[m\] is `low + step * code` along each axis.
#[derive(Debug, Serialize)]
struct Shown {
    name: &'static str,
    /// Where the triangles are and their number; absent for particles.
    #[serde(skip_serializing_if = "Option::is_none")]
    triangles: Option<[usize; 2]>,
    /// Diameter of particles \[m\]; absent for a surface.
    #[serde(skip_serializing_if = "Option::is_none")]
    diameter: Option<f64>,
    low: [f64; 3],
    step: [f64; 3],
    times: Vec<f64>,
    /// Where the positions of each frame are, and the number of points.
    places: Vec<[usize; 2]>,
    fields: Vec<Painted>,
}

/// A field. A value in `unit` is `low + step * code`; the highest code is no value.
#[derive(Debug, Serialize)]
struct Painted {
    name: &'static str,
    title: &'static str,
    short: &'static str,
    unit: &'static str,
    of_cycle: bool,
    low: f64,
    step: f64,
    ticks: Vec<Tick>,
    /// Where the values of each frame are.
    values: Vec<usize>,
}

impl Scene {
    /// The bodies with the numbers that go to `payload`.
    pub(super) fn new(bodies: &[Body], openings: &[OpeningSummary], payload: &mut Payload) -> Self {
        let shown: Vec<Shown> = bodies.iter().filter_map(|body| Shown::new(body, payload)).collect();
        let last = bodies.iter().find_map(|body| body.position.states.last());
        // Without the tilt of the pictures, so that a cut goes along the middle.
        let axes = principal_axes(last.map_or(&[][..], Vec::as_slice));
        let [right, up, toward] = axes.map(|axis| axis.to_array());
        let view = [right, up, toward].concat();
        let mouth = |entry: &OpeningSummary| Mouth {
            name: entry.opening.name.clone(),
            center: entry.opening.center_m,
            normal: entry.opening.normal,
            radius: entry.opening.radius_m,
        };
        let placed = |entry: &&OpeningSummary| entry.opening.center_m.iter().all(|x| x.is_finite());
        Self {
            view: std::array::from_fn(|k| view[k]),
            map: VIRIDIS.to_vec(),
            openings: openings.iter().filter(placed).map(mouth).collect(),
            bodies: shown,
        }
    }

    /// True without a body.
    pub(super) fn is_empty(&self) -> bool {
        self.bodies.is_empty()
    }

    /// The table as JSON that cannot end the element it stands in.
    pub(super) fn json(&self) -> String {
        // No map with keys that are not texts and no writer that fails: there is nothing that can go wrong.
        serde_json::to_string(self).unwrap_or_default().replace('<', "\\u003c")
    }
}

impl Shown {
    fn new(body: &Body, payload: &mut Payload) -> Option<Self> {
        let bounds = Bounds::of(body.position.states.iter().flatten())?;
        let places = stored(&body.position, payload, |state: &[DVec3]| bounds.codes(state));
        let (triangles, diameter) = match &body.shape {
            Shape::Surface(triangles) => {
                // A surface has at most as many points as there are codes.
                let corners: Vec<u16> = triangles.iter().flatten().map(|&v| v as u16).collect();
                (Some([payload.push(&corners), triangles.len()]), None)
            }
            Shape::Points(diameter) => (None, Some(*diameter)),
        };
        let count = |frame: usize| body.position.states[body.position.at[frame]].len();
        Some(Self {
            name: body.name,
            triangles,
            diameter,
            low: bounds.0.map(|span| span.low),
            step: bounds.0.map(|span| span.step()),
            times: body.times.clone(),
            places: places.iter().enumerate().map(|(frame, &at)| [at, count(frame)]).collect(),
            fields: body.fields.iter().filter_map(|field| Painted::new(field, payload)).collect(),
        })
    }
}

impl Painted {
    fn new(field: &Coloring, payload: &mut Payload) -> Option<Self> {
        let all = || field.values.states.iter().flatten().copied();
        let span = Span::of(all())?;
        let colors = colors(&field.known, all());
        Some(Self {
            name: field.known.name,
            title: field.known.title,
            short: field.known.short,
            unit: colors.unit,
            of_cycle: field.known.of_cycle,
            low: colors.factor * span.low,
            step: colors.factor * span.step(),
            ticks: colors.ticks,
            values: stored(&field.values, payload, |state| state.iter().map(|&x| span.code(x)).collect()),
        })
    }
}

/// Puts each state away once; where that of each frame is.
fn stored<T>(track: &Track<T>, payload: &mut Payload, codes: impl Fn(&[T]) -> Vec<u16>) -> Vec<usize> {
    let places: Vec<usize> = track.states.iter().map(|state| payload.push(&codes(state))).collect();
    track.at.iter().map(|&state| places[state]).collect()
}

/// Codes of a value are at most this number, which the script knows too.
const _: () = assert!(STEPS as u16 == u16::MAX - 1);

//! A body of a run as the viewer shows it: positions and fields of chosen frames, read from a series.

use super::budget;
use super::coarse::{Coarse, coarse};
use super::fields::{Known, OF_BLOOD, OF_WALL, PRESSURE};
use crate::picture::mean_at;
use crate::scale::count;
use glam::DVec3;
use std::collections::BTreeMap;
use vaso_io::{FrameData, IoError, SeriesReader};

/// Bytes of a number in the page before it is written as text.
const CODE: usize = 2;
/// Points of a surface at most, so that their numbers fit into a code, and fewer for more frames.
const POINTS: [usize; 3] = [60_000, 30_000, 15_000];
/// Frames of a surface for which points are given up.
const FRAMES: usize = 10;
/// Particles at most and, where there is room for more frames, at least.
const PARTICLES: (usize, usize) = (40_000, 8_000);
/// Frames of particles there should be room for before there are more particles.
const WANTED_FRAMES: usize = 24;

/// Width of the mean that gives the pressure at the wall, in spacings; it is cut at twice that. On the wall only half of it is blood.
const AT_WALL: f64 = 1.5;

/// What changes from frame to frame, each state held once.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Track<T> {
    /// States in the order in which they come.
    pub(super) states: Vec<Vec<T>>,
    /// State of each frame.
    pub(super) at: Vec<usize>,
    rows: BTreeMap<usize, usize>,
}

impl<T> Default for Track<T> {
    fn default() -> Self {
        Self { states: Vec::new(), at: Vec::new(), rows: BTreeMap::new() }
    }
}

impl<T> Track<T> {
    /// Adds a frame. Frames of the same row of the file are alike; without a row each is its own.
    fn push(&mut self, row: Option<usize>, state: impl FnOnce() -> Vec<T>) {
        let place = row.and_then(|row| self.rows.get(&row).copied()).unwrap_or_else(|| {
            self.states.push(state());
            self.states.len() - 1
        });
        if let Some(row) = row {
            self.rows.insert(row, place);
        }
        self.at.push(place);
    }
}

/// A field of a body.
pub(super) struct Coloring {
    pub(super) known: Known,
    /// Values in SI, magnitudes of vectors.
    pub(super) values: Track<f64>,
}

/// What a body is made of.
pub(super) enum Shape {
    /// Triangles between the points, the same in all frames.
    Surface(Vec<[u32; 3]>),
    /// Spheres of this diameter \[m\].
    Points(f64),
}

/// A body with all that is shown of it.
pub(super) struct Body {
    pub(super) name: &'static str,
    pub(super) shape: Shape,
    /// Times of the frames \[s\].
    pub(super) times: Vec<f64>,
    /// Positions \[m\].
    pub(super) position: Track<DVec3>,
    pub(super) fields: Vec<Coloring>,
    /// What of the run is here, in words.
    pub(super) extent: String,
}

/// The frames chosen, in words.
fn frames_in_words(chosen: usize, all: usize) -> String {
    match (chosen, all) {
        (1, 1) => "the one saved step".to_owned(),
        (chosen, all) if chosen == all => format!("all {} saved steps", count(all as u64)),
        (1, all) => format!("the last of {} saved steps", count(all as u64)),
        (chosen, all) => {
            format!("{} of {} saved steps, evenly over time", count(chosen as u64), count(all as u64))
        }
    }
}

/// A surface of triangles in at most `room` bytes; `None` where it has no points or not even its last frame fits. The pressure at it is read off `blood`, with the
/// particle spacing \[m\].
///
/// # Errors
/// [`IoError`] when a series cannot be read.
pub(super) fn surface(
    wall: &SeriesReader,
    blood: Option<&SeriesReader>,
    spacing: f64,
    room: usize,
) -> Result<Option<Body>, IoError> {
    let Some(last) = wall.last_frame()? else { return Ok(None) };
    let all = wall.triangles()?;
    let has = |field: &&Known| wall.info().fields.iter().any(|info| info.name == field.name);
    let known: Vec<Known> = OF_WALL.iter().filter(has).copied().collect();
    let blood = blood
        .filter(|_| !known.iter().any(|field| field.name == PRESSURE.name))
        .filter(|blood| blood.info().fields.iter().any(|info| info.name == PRESSURE.name))
        .filter(|_| spacing > 0.0);
    let cost = |shape: &Coarse, frames: &[usize]| {
        let distinct = |row: &dyn Fn(usize) -> Option<usize>| {
            let mut rows: Vec<Option<usize>> = frames.iter().map(|&k| row(k)).collect();
            rows.sort_unstable();
            rows.dedup();
            rows.len()
        };
        let fields: usize = known.iter().map(|f| distinct(&|k| wall.field_row(f.name, k))).sum();
        let pressure = if blood.is_some() { frames.len() } else { 0 };
        let positions = 3 * distinct(&|k| wall.position_row(k));
        CODE * (3 * shape.triangles.len() + shape.kept.len() * (positions + fields + pressure))
    };
    let times = &wall.info().times;
    let mut chosen = Vec::new();
    let mut shape = Coarse { kept: Vec::new(), triangles: Vec::new() };
    for most in POINTS {
        shape = coarse(&last.position, &all, most);
        chosen = budget::frames(times, room, |frames| cost(&shape, frames));
        if chosen.len() >= FRAMES.min(times.len()) {
            break;
        }
    }
    let points = shape.kept.len();
    if chosen.is_empty() || points == 0 {
        return Ok(None);
    }
    let mut body = Body {
        name: "Vessel wall",
        extent: format!(
            "{} points and {} triangles{}, {}",
            count(points as u64),
            count(shape.triangles.len() as u64),
            if points < last.position.len() {
                format!(", thinned from {} points", count(last.position.len() as u64))
            } else {
                String::new()
            },
            frames_in_words(chosen.len(), times.len())
        ),
        shape: Shape::Surface(shape.triangles),
        times: chosen.iter().map(|&k| times[k]).collect(),
        position: Track::default(),
        fields: colorings(&known),
    };
    let mut pressure = Track::default();
    for &k in &chosen {
        let frame = wall.frame(k)?;
        body.take(&frame, &shape.kept, wall, k);
        if let Some(blood) = blood {
            let near = blood.frame(budget::nearest(&blood.info().times, frame.time))?;
            let values = near.scalar(PRESSURE.name).unwrap_or_default();
            let at: Vec<DVec3> =
                shape.kept.iter().map(|&i| frame.position.get(i).copied().unwrap_or(DVec3::NAN)).collect();
            pressure.push(None, || mean_at(&at, &near.position, values, AT_WALL * spacing));
        }
    }
    if blood.is_some() {
        // Where the menu has it: after the stresses of the blood, before those of the wall.
        let place = |name: &str| OF_WALL.iter().position(|field| field.name == name);
        let after = body.fields.iter().filter(|f| place(f.known.name) < place(PRESSURE.name)).count();
        body.fields.insert(after, Coloring { known: PRESSURE, values: pressure });
        body.extent += "; pressure is a mean over the blood within three spacings";
    }
    body.drop_empty_fields();
    Ok(Some(body))
}

/// Particles in at most `room` bytes: those of the blood, or of a wall that is made of them. `None` where there are none.
///
/// # Errors
/// [`IoError`] when the series cannot be read.
pub(super) fn particles(
    series: &SeriesReader,
    is_blood: bool,
    spacing: f64,
    room: usize,
) -> Result<Option<Body>, IoError> {
    let info = series.info();
    let table: &[Known] = if is_blood { &OF_BLOOD } else { &OF_WALL };
    let known: Vec<Known> =
        table.iter().filter(|field| info.fields.iter().any(|i| i.name == field.name)).copied().collect();
    let largest = info.counts.iter().copied().max().unwrap_or(0);
    let each = CODE * (3 + known.len());
    let wanted = room / (each * info.times.len().clamp(1, WANTED_FRAMES));
    let most = wanted.clamp(PARTICLES.1, PARTICLES.0).min(largest).min(room / each);
    let chosen = budget::frames(&info.times, room, |frames| {
        each * frames.iter().map(|&k| info.counts[k].min(most)).sum::<usize>()
    });
    if chosen.is_empty() || most == 0 {
        return Ok(None);
    }
    let mut body = Body {
        name: if is_blood { "Blood" } else { "Vessel wall" },
        // Of fewer particles each stands for more of the volume.
        shape: Shape::Points(spacing * (largest as f64 / most as f64).cbrt()),
        times: chosen.iter().map(|&k| info.times[k]).collect(),
        position: Track::default(),
        fields: colorings(&known),
        extent: String::new(),
    };
    let mut shown = 0;
    for &k in &chosen {
        let frame = series.frame(k)?;
        let mut kept = budget::particles(frame.ids.as_deref(), frame.position.len(), largest, most);
        kept.retain(|&i| frame.position[i].is_finite());
        shown = kept.len();
        body.take(&frame, &kept, series, k);
        if is_blood {
            body.smooth_pressure(&frame, spacing);
        }
    }
    let last = chosen.last().map_or(0, |&k| info.counts[k]);
    let part = if largest <= most {
        format!("all {} particles", count(shown as u64))
    } else {
        format!(
            "{} of {} particles, chosen at random and drawn larger",
            count(shown as u64),
            count(last as u64)
        )
    };
    body.extent = format!("{part}, {}", frames_in_words(chosen.len(), info.times.len()));
    if is_blood && known.iter().any(|field| field.name == PRESSURE.name) {
        body.extent += "; pressure is averaged over two spacings";
    }
    body.drop_empty_fields();
    Ok(Some(body))
}

fn colorings(known: &[Known]) -> Vec<Coloring> {
    known.iter().map(|&known| Coloring { known, values: Track::default() }).collect()
}

impl Body {
    /// Takes what it shows of frame number `index`, of the points `kept`.
    fn take(&mut self, frame: &FrameData, kept: &[usize], series: &SeriesReader, index: usize) {
        // Which particles are kept may differ from frame to frame, so only a surface has states that stay.
        let same = matches!(self.shape, Shape::Surface(_));
        let row = |row: Option<usize>| row.filter(|_| same);
        let place = |i: &usize| frame.position.get(*i).copied().unwrap_or(DVec3::NAN);
        self.position.push(row(series.position_row(index)), || kept.iter().map(place).collect());
        for field in &mut self.fields {
            let name = field.known.name;
            field.values.push(row(series.field_row(name, index)), || match frame.vector(name) {
                Some(vectors) => {
                    kept.iter().map(|&i| vectors.get(i).map_or(f64::NAN, |v| v.length())).collect()
                }
                None => {
                    let values = frame.scalar(name).unwrap_or_default();
                    kept.iter().map(|&i| values.get(i).copied().unwrap_or(f64::NAN)).collect()
                }
            });
        }
    }

    /// Puts the mean over the blood nearby in place of the pressures of the last frame, which scatter from particle to particle.
    fn smooth_pressure(&mut self, frame: &FrameData, spacing: f64) {
        let (Some(at), Some(values)) = (self.position.states.last(), frame.scalar(PRESSURE.name)) else {
            return;
        };
        let pressure = self.fields.iter_mut().find(|field| field.known.name == PRESSURE.name);
        if let Some(shown) = pressure.and_then(|field| field.values.states.last_mut())
            && spacing > 0.0
        {
            *shown = mean_at(at, &frame.position, values, spacing);
        }
    }

    /// Bytes it takes in the page before they are written as text.
    pub(super) fn bytes(&self) -> usize {
        let corners = if let Shape::Surface(triangles) = &self.shape { 3 * triangles.len() } else { 0 };
        let positions: usize = self.position.states.iter().map(|state| 3 * state.len()).sum();
        let values: usize = self.fields.iter().flat_map(|f| &f.values.states).map(Vec::len).sum();
        CODE * (corners + positions + values)
    }

    /// Forgets fields that have no value in any frame, as indices have before the first cycle has ended.
    fn drop_empty_fields(&mut self) {
        self.fields.retain(|field| field.values.states.iter().flatten().any(|x| x.is_finite()));
    }
}

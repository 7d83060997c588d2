//! The vessel in the page, to be turned by the mouse: WebGL in a script of our own, with the numbers in the page itself.
//!
//! Positions and values are codes of 16 bits over their range. How many frames and particles go in follows from the bytes there is room for;
//! what is left out is said under the picture.

mod body;
mod budget;
mod coarse;
mod codes;
mod fields;
mod scene;

use crate::ReportError;
use crate::html::{escape, prose};
use body::{Body, Shape};
use codes::Payload;
use scene::Scene;
use std::path::Path;
use vaso_io::{IoError, SeriesReader, Summary};

/// Style of what stands here, for the page.
pub(crate) const STYLE: &str = include_str!("viewer.css");

/// Room the codes take at most, however small the rest of the page \[bytes\].
const MOST_ROOM: usize = 6_600_000;
/// Part of the room that a wall may take where there is blood to show as well.
const WALL_SHARE: f64 = 0.55;
/// Characters of the page besides the codes: the script, the table of contents and the elements around.
const AROUND: usize = 200_000;

/// The parts of the script, in the order in which they build on each other.
const SCRIPT: [&str; 10] = [
    include_str!("numbers.js"),
    include_str!("data.js"),
    include_str!("camera.js"),
    include_str!("shaders.js"),
    include_str!("draw.js"),
    include_str!("pick.js"),
    include_str!("menu.js"),
    include_str!("hands.js"),
    include_str!("viewer.js"),
    include_str!("start.js"),
];

/// The viewer of a run, in at most `room` characters; empty where there is nothing to turn, and a note where what there is cannot be read.
pub(crate) fn viewer(out: &Path, summary: &Summary, room: usize) -> String {
    match bodies(out, summary.spacing_m, (room.saturating_sub(AROUND) / 4 * 3).min(MOST_ROOM)) {
        Ok(bodies) => markup(&bodies, summary),
        Err(error) => {
            format!(
                "<p class=\"note\">Nothing to turn: {}</p>\n",
                prose(&ReportError::from(error).to_string())
            )
        }
    }
}

/// The wall and the blood, as far as there are files, in at most `room` bytes together.
fn bodies(out: &Path, spacing: f64, room: usize) -> Result<Vec<Body>, IoError> {
    let open = |name: &str| {
        let path = out.join(name);
        path.exists().then(|| SeriesReader::open(&path)).transpose()
    };
    let (wall, blood) = (open("wall.vtkhdf")?, open("fluid.vtkhdf")?);
    let mut bodies = Vec::new();
    let mut left = room;
    if let Some(wall) = &wall {
        let share = if blood.is_some() { (WALL_SHARE * room as f64) as usize } else { room };
        let body = if wall.triangles()?.is_empty() {
            body::particles(wall, false, spacing, share)?
        } else {
            body::surface(wall, blood.as_ref(), spacing, share)?
        };
        left -= body.as_ref().map_or(0, Body::bytes).min(left);
        bodies.extend(body);
    }
    if let Some(blood) = &blood {
        bodies.extend(body::particles(blood, true, spacing, left)?);
    }
    Ok(bodies)
}

/// Elements, numbers and script. What needs the script is hidden until it runs.
fn markup(bodies: &[Body], summary: &Summary) -> String {
    let mut payload = Payload::default();
    let scene = Scene::new(bodies, &summary.openings, &mut payload);
    if scene.is_empty() {
        return String::new();
    }
    let extents: Vec<String> =
        bodies.iter().map(|body| format!("{}: {}.", escape(body.name), escape(&body.extent))).collect();
    let inside = bodies.iter().any(|body| matches!(body.shape, Shape::Points(_)));
    format!(
        "{}<script type=\"application/json\" id=\"viewer-scene\">{}</script>\n\
         <script type=\"text/plain\" id=\"viewer-codes\">{}</script>\n<script type=\"module\">\n{}</script>\n",
        include_str!("viewer.html")
            .replace("{extents}", &extents.join(" "))
            .replace("{cut}", if inside { "shows the inside" } else { "opens it" }),
        scene.json(),
        payload.base64(),
        SCRIPT.concat()
    )
}

#[cfg(test)]
mod tests;

//! The pictures of the vessel as figures of the page.

use crate::ReportError;
use crate::color::css_gradient;
use crate::html::{escape, prose};
use crate::picture::{PictureOptions, Quantity, Style, VesselPicture, draw};
use crate::scale::{number, ticks};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::path::Path;
use vaso_io::{FrameData, SeriesReader};

/// Width of the pictures \[pixels\]: twice what a page shows, for sharp screens.
pub(crate) const WIDTH: u32 = 1400;

/// Figures of the last frame of the fluid series in a folder; a note where there is nothing to draw.
pub(crate) fn figures(out: &Path, spacing: f64) -> String {
    let options = |quantity, style| PictureOptions { quantity, style, width: WIDTH, spacing: Some(spacing) };
    let mut html = String::new();
    let fluid = out.join("fluid.vtkhdf");
    if fluid.exists() {
        html += &series(
            &fluid,
            &[
                ("Speed, cut along the middle of the vessel", options(Quantity::Speed, Style::Cut)),
                (
                    "Largest speed along each line of sight, seen from the side",
                    options(Quantity::Speed, Style::Peak),
                ),
                (
                    "Pressure averaged over two spacings, cut along the middle of the vessel",
                    options(Quantity::Pressure, Style::Cut),
                ),
            ],
        );
    }
    html
}

/// One figure a view of the last frame; what cannot be read is said in its place, the rest of the page stands.
fn series(path: &Path, views: &[(&str, PictureOptions)]) -> String {
    let frame = SeriesReader::open(path).and_then(|reader| reader.last_frame());
    let frame = match frame {
        Ok(Some(frame)) => frame,
        Ok(None) => return note(&ReportError::NoFrame { path: path.to_owned() }),
        Err(error) => return note(&error.into()),
    };
    views
        .iter()
        .map(|(title, options)| {
            let when = format!("at {} s", number(frame.time, 4));
            figure(&frame, path, title, &when, options).unwrap_or_else(|error| note(&error))
        })
        .collect()
}

pub(crate) fn note(error: &ReportError) -> String {
    format!("<p class=\"note\">No picture: {}</p>\n", prose(&error.to_string()))
}

/// A picture of a frame with its colours and lengths; `when` stands beside the title.
pub(crate) fn figure(
    frame: &FrameData,
    path: &Path,
    title: &str,
    when: &str,
    options: &PictureOptions,
) -> Result<String, ReportError> {
    let what = format!("{} particles", frame.position.len());
    enclosed(&draw(frame, path, options)?, title, when, &what, options.quantity)
}

/// A picture that is drawn already as a figure; `what` is coloured in it.
pub(crate) fn enclosed(
    drawn: &VesselPicture,
    title: &str,
    when: &str,
    what: &str,
    quantity: Quantity,
) -> Result<String, ReportError> {
    let (name, unit) = (quantity.name(), quantity.unit());
    let alternative = format!(
        "{title} {when}: {what} coloured by {name} from {} to {} {unit}",
        number(drawn.low, 3),
        number(drawn.high, 3)
    );
    Ok(format!(
        "<figure class=\"vessel\"><figcaption><b>{}</b> <small>{when}</small></figcaption>\
         <img decoding=\"async\" width=\"{}\" height=\"{}\" alt=\"{}\" src=\"data:image/png;base64,{}\">{}{}</figure>\n",
        escape(title),
        drawn.picture.width,
        drawn.picture.height,
        escape(&alternative),
        STANDARD.encode(drawn.picture.to_png()?),
        color_bar(drawn, quantity.short_name(), unit),
        ruler(drawn)
    ))
}

fn color_bar(drawn: &VesselPicture, quantity: &str, unit: &str) -> String {
    let labels: String = drawn
        .ticks
        .iter()
        .map(|tick| {
            let percent = 100.0 * (tick - drawn.low) / (drawn.high - drawn.low);
            format!("<span style=\"bottom:{percent:.2}%\">{}</span>", number(*tick, 4))
        })
        .collect();
    format!(
        "<div class=\"bar\" aria-hidden=\"true\">{quantity}<small>{unit}</small>\
         <div class=\"map\" style=\"background:{}\">{labels}</div></div>",
        css_gradient()
    )
}

/// A line of round length, to judge sizes by.
fn ruler(drawn: &VesselPicture) -> String {
    let width = f64::from(drawn.picture.width) * drawn.pixel * 1e3;
    let length = ticks(0.0, width / 6.0, 1)[1];
    format!(
        "<div class=\"ruler\"><i style=\"width:{:.2}%\"></i>{} mm</div>",
        100.0 * length / width,
        number(length, 3)
    )
}

//! A picture that stands alone: vessel, colour bar, scale bar and time on white.

use super::canvas::LETTER;
use super::{Picture, PictureOptions, Style, VesselPicture, draw, draw_surface};
use crate::ReportError;
use crate::color::viridis;
use crate::scale::{number, ticks};
use std::path::Path;
use vaso_io::{FrameData, SeriesReader};

const INK: [u8; 3] = [34, 38, 46];
const PAD: i64 = 28;
const BAR_WIDTH: i64 = 26;
/// Room for a tick label of six letters.
const LABELS: i64 = 12 + 6 * LETTER.0;

/// Draws the last frame of a series of particles or of a surface, or the one nearest to `time` \[s\], with its colour bar, scale bar and time, and
/// returns the content of a PNG file.
///
/// # Errors
/// As [`super::draw`], and [`ReportError::Io`] when the series cannot be read.
pub fn render_vessel_png(
    series: &Path,
    time: Option<f64>,
    options: &PictureOptions,
) -> Result<Vec<u8>, ReportError> {
    let reader = SeriesReader::open(series)?;
    let times = &reader.info().times;
    let distance = |k: &usize| time.map_or(-times[*k], |time| (times[*k] - time).abs());
    let nearest = (0..times.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let Some(index) = nearest else { return Err(ReportError::NoFrame { path: series.to_owned() }) };
    let frame = reader.frame(index)?;
    let triangles = reader.triangles()?;
    if !triangles.is_empty() {
        let drawn = draw_surface(&frame, &triangles, series, options.quantity, options.width)?;
        return compose(&drawn, &frame, options, "from both sides").to_png();
    }
    let note = match options.style {
        Style::Cut => "cut along the middle",
        Style::Outside => "from outside",
        Style::Peak => "largest along the line of sight",
    };
    compose(&draw(&frame, series, options)?, &frame, options, note).to_png()
}

fn compose(drawn: &VesselPicture, frame: &FrameData, options: &PictureOptions, note: &str) -> Picture {
    let vessel = &drawn.picture;
    let title = match options.quantity.unit() {
        "" => options.quantity.short_name().to_owned(),
        unit => format!("{} [{unit}]", options.quantity.short_name()),
    };
    let head = PAD + LETTER.1 + PAD / 2;
    let bar_height = i64::from(vessel.height).max(260);
    let side = PAD + BAR_WIDTH + LABELS + PAD;
    let width = i64::from(vessel.width) + side;
    let height = head + bar_height + PAD + LETTER.1 + PAD;
    let mut page = Picture::filled(width as u32, height as u32, [255; 4]);

    page.overlay(vessel, 0, head + (bar_height - i64::from(vessel.height)) / 2);
    page.text(PAD, PAD, &format!("t = {} s, {note}", plain(frame.time)), INK);
    page.text(width - PAD - title.chars().count() as i64 * LETTER.0, PAD, &title, INK);
    color_bar(&mut page, drawn, i64::from(vessel.width) + PAD, head + LETTER.1 / 2, bar_height - LETTER.1);
    scale_bar(&mut page, drawn.pixel, vessel.width, head + bar_height + PAD);
    page
}

fn color_bar(page: &mut Picture, drawn: &VesselPicture, x: i64, y: i64, height: i64) {
    for row in 0..height {
        let color = viridis(1.0 - row as f64 / (height - 1) as f64).map(|c| c.round() as u8);
        page.rectangle(x, y + row, BAR_WIDTH, 1, color);
    }
    for &tick in &drawn.ticks {
        let part = (tick - drawn.low) / (drawn.high - drawn.low);
        let row = y + ((1.0 - part) * (height - 1) as f64).round() as i64;
        page.rectangle(x + BAR_WIDTH, row, 8, 2, INK);
        page.text(x + BAR_WIDTH + 14, row - LETTER.1 / 2, &plain(tick), INK);
    }
}

/// A bar of round length, about a fifth of the vessel's width.
fn scale_bar(page: &mut Picture, pixel: f64, width: u32, y: i64) {
    let fifth = f64::from(width) / 5.0 * pixel * 1e3;
    let length = ticks(0.0, fifth, 1)[1];
    let pixels = (length * 1e-3 / pixel).round() as i64;
    page.rectangle(PAD, y + LETTER.1 / 2 - 2, pixels, 4, INK);
    page.text(PAD + pixels + 16, y, &format!("{} mm", plain(length)), INK);
}

/// The figures of [`number`] in letters the bitmap font has.
fn plain(value: f64) -> String {
    let text: String = number(value, 3)
        .chars()
        .map(|c| match c {
            '−' | '⁻' => '-',
            '⁰' => '0',
            '¹' => '1',
            '²' => '2',
            '³' => '3',
            '⁴'..='⁹' => char::from(b'4' + (c as u32 - '⁴' as u32) as u8),
            c => c,
        })
        .collect();
    text.replace(" × 10", "e")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_use_letters_the_font_has() {
        assert_eq!(plain(-6.1e-6), "-6.1e-6");
        assert_eq!(plain(2.5e17), "2.5e17");
        assert_eq!(plain(0.25), "0.25");
    }
}

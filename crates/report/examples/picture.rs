//! Draws a frame of a run as a PNG file.
//!
//! `cargo run --release -p vaso-report --example picture -- OUT PICTURE.png [speed|pressure|wss|tawss|osi]
//! [cut|outside|peak] [TIME]`

use std::path::Path;
use vaso_report::picture::{PictureOptions, Quantity, Style, render_vessel_png};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [out, picture, rest @ ..] = arguments.as_slice() else {
        return Err(
            "usage: picture OUT PICTURE.png [speed|pressure|wss|tawss|osi] [cut|outside|peak] [TIME]".into(),
        );
    };
    let mut options = PictureOptions::default();
    let mut time = None;
    for word in rest {
        match word.as_str() {
            "speed" => options.quantity = Quantity::Speed,
            "pressure" => options.quantity = Quantity::Pressure,
            "wss" => options.quantity = Quantity::WallShear,
            "tawss" => options.quantity = Quantity::Tawss,
            "osi" => options.quantity = Quantity::Osi,
            "cut" => options.style = Style::Cut,
            "outside" => options.style = Style::Outside,
            "peak" => options.style = Style::Peak,
            number => time = Some(number.parse()?),
        }
    }
    let series = match options.quantity {
        Quantity::Speed | Quantity::Pressure => "fluid.vtkhdf",
        _ => "wall.vtkhdf",
    };
    let png = render_vessel_png(&Path::new(out).join(series), time, &options)?;
    std::fs::write(picture, png)?;
    Ok(())
}

//! The page of a finished run, and of runs that left little or nonsense behind.

mod synthetic;

use std::path::Path;
use vaso_io::{Status, Summary, SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter};
use vaso_report::picture::{PictureOptions, Quantity, Style, draw};
use vaso_report::{ReportError, render_vessel_png, write_report, write_report_against};

fn page(out: &Path) -> String {
    std::fs::read_to_string(write_report(out).unwrap()).unwrap()
}

/// The text between tags.
fn words(html: &str) -> String {
    let mut plain = html.to_owned();
    for tag in ["style", "script"] {
        let (open, close) = (format!("<{tag}"), format!("</{tag}>"));
        plain = plain.split(&open).map(|part| part.split(&close).last().unwrap()).collect();
    }
    plain
        .split('<')
        .filter_map(|part| part.split_once('>'))
        .map(|(_, text)| text)
        .collect::<Vec<_>>()
        .join(" ")
}

#[test]
fn a_finished_run_has_every_part_and_needs_nothing_else() {
    let out = tempfile::tempdir().unwrap();
    synthetic::write(out.path()).unwrap();
    let html = page(out.path());
    for needle in ["http://", "https://", "url(", "@import", "<link", "<script src", "import("] {
        assert!(!html.contains(needle), "the page contains {needle}");
    }
    assert!(html.contains("default-src 'none'"));
    // Of those, one is a script: the others are its numbers.
    assert_eq!(html.matches("<script").count(), 3);
    assert_eq!(html.matches("src=\"").count(), html.matches("src=\"data:image/png;base64,").count());
    assert_eq!(html.matches("<img ").count(), 6);
    assert_eq!(html.matches("alt=\"").count(), 6);
    assert_eq!(html.matches("class=\"chart\"").count(), 2);

    let words = words(&html);
    assert!(!words.contains("NaN") && !words.contains(" inf "), "{words}");
    for part in [
        "Bent pipe with a branch &amp; parabolic profiles",
        "completed",
        "12 min 34 s",
        "branch &lt;left&gt;",
        "off, called for",
        "borderline",
        "not measured",
        "What this does not prove",
        "The wall does not move",
        "reversed all triangles",
        "the last two were alike",
        "Time-averaged wall shear stress",
        "over cycle 2, from both sides",
        "1/T int |tau| dt",
        "He, Ku 1996",
        "inlet → branch &lt;left&gt;",
        "119.3 / 77.26",
        "Fractional flow reserve is a clinical number only where",
        "numerical dissipation",
    ] {
        assert!(words.contains(part), "\"{part}\" is missing from:\n{words}");
    }
    // fluid.pressure: 402 of 650 s.
    assert!(words.contains("62 %"), "{words}");
    assert!(html.len() < 15_000_000, "{} bytes", html.len());
    // Every tag that is opened is closed.
    for tag in
        ["div", "section", "table", "figure", "svg", "g", "tr", "td", "ul", "dl", "span", "main", "header"]
    {
        let opened = html.matches(&format!("<{tag}>")).count() + html.matches(&format!("<{tag} ")).count();
        assert_eq!(opened, html.matches(&format!("</{tag}>")).count(), "<{tag}>");
    }
}

/// The other run has twice the pulse and no shell.
#[test]
fn the_pulse_is_told_against_that_of_another_run() {
    let (out, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    synthetic::write(out.path()).unwrap();
    synthetic::write(other.path()).unwrap();
    let file = other.path().join("summary.json");
    let mut summary = Summary::read(&file).unwrap();
    summary.spacing_m *= 2.0;
    summary.effects.iter_mut().for_each(|effect| effect.on = false);
    summary.cycles.iter_mut().flat_map(|cycle| &mut cycle.openings).for_each(|o| o.pulse_pressure_pa *= 2.0);
    summary.write(&file).unwrap();
    let html = std::fs::read_to_string(write_report_against(out.path(), other.path()).unwrap()).unwrap();
    // Flow and pressure of the run, and the pressure of each of its three openings beside that of the other.
    assert_eq!(html.matches("class=\"chart\"").count(), 5);
    let words = words(&html);
    for part in ["Against another run", "50 %", "Spacings are 0.45 and 0.9 mm", "Only"] {
        assert!(words.contains(part), "{part}: {words}");
    }
    assert!(!words.contains("NaN"), "{words}");
    std::fs::remove_file(other.path().join("openings.csv")).unwrap();
    let error = write_report_against(out.path(), other.path()).unwrap_err();
    assert!(error.to_string().contains("openings.csv"), "{error}");
    assert!(!page(out.path()).contains("Against another run"));
}

#[test]
fn the_same_run_gives_the_same_page() {
    let out = tempfile::tempdir().unwrap();
    synthetic::write(out.path()).unwrap();
    assert!(page(out.path()) == page(out.path()), "two reports of one run differ");
}

#[test]
fn a_run_that_broke_down_still_gets_its_page() {
    let out = tempfile::tempdir().unwrap();
    let failed = Summary {
        status: Status::Failed,
        message: Some("density of particle 7 is not finite at 0.2 s".into()),
        time_s: 0.2,
        ..Summary::default()
    };
    failed.write(&out.path().join("summary.json")).unwrap();
    let alone = page(out.path());
    assert!(alone.contains("density of particle 7") && !alone.contains("<img"));

    std::fs::write(out.path().join("fluid.vtkhdf"), "torn").unwrap();
    std::fs::write(out.path().join("openings.csv"), "time_s,a.flow_m3_s\n0,x\n").unwrap();
    let html = page(out.path());
    assert!(html.contains("No picture: ") && html.contains("No waveforms: "), "{}", words(&html));
}

#[test]
fn a_wall_whose_first_cycle_has_not_ended_shows_what_there_is() {
    let out = tempfile::tempdir().unwrap();
    synthetic::write(out.path()).unwrap();
    let path = out.path().join("wall.vtkhdf");
    let reader = vaso_io::SeriesReader::open(&path).unwrap();
    let (frame, triangles) = (reader.frame(2).unwrap(), reader.triangles().unwrap());
    drop(reader);
    let field =
        |name, components| SurfaceField { name, components, unit: "Pa", definition: "", citation: "" };
    let mesh = SurfaceMesh { points: &frame.position, triangles: &triangles };
    let mut series = SurfaceSeriesWriter::create(&path, mesh, &[field("WSS", 3), field("TAWSS", 1)]).unwrap();
    let vectors = vec![("WSS", frame.vector("WSS").unwrap())];
    series.append(&SurfaceFrame { time: 0.2, vectors, ..SurfaceFrame::default() }).unwrap();
    drop(series);
    let html = page(out.path());
    assert_eq!(html.matches("<img ").count(), 4);
    assert!(!html.contains("No picture: "), "{}", words(&html));

    std::fs::write(&path, "torn").unwrap();
    assert!(page(out.path()).contains("No picture: "));
}

#[test]
fn without_a_summary_there_is_no_page() {
    let out = tempfile::tempdir().unwrap();
    let error = write_report(out.path()).unwrap_err();
    assert!(matches!(error, ReportError::Io(_)) && error.to_string().contains("summary.json"), "{error}");
    assert!(!out.path().join("report.html").exists());
}

#[test]
fn the_cut_shows_the_fast_core_and_the_outside_does_not() {
    let out = tempfile::tempdir().unwrap();
    synthetic::write(out.path()).unwrap();
    let series = out.path().join("fluid.vtkhdf");
    let frame = vaso_io::SeriesReader::open(&series).unwrap().last_frame().unwrap().unwrap();
    let bright = |style| {
        let options = PictureOptions { style, width: 400, ..PictureOptions::default() };
        let drawn = draw(&frame, &series, &options).unwrap();
        // Yellow end of the map: much green, little blue.
        let pixels = drawn.picture.rgba.chunks_exact(4).filter(|p| p[3] == 255);
        let (bright, all) =
            pixels.fold((0, 0), |(bright, all), p| (bright + usize::from(p[1] > 120 && p[2] < 90), all + 1));
        bright as f64 / f64::from(all)
    };
    let (cut, outside) = (bright(Style::Cut), bright(Style::Outside));
    assert!(cut > 0.25 && outside < 0.1, "cut {cut}, outside {outside}");
}

#[test]
fn pictures_stand_alone_as_png() {
    let out = tempfile::tempdir().unwrap();
    synthetic::write(out.path()).unwrap();
    let series = out.path().join("fluid.vtkhdf");
    let options = PictureOptions { width: 500, ..PictureOptions::default() };
    let png = render_vessel_png(&series, Some(0.2), &options).unwrap();
    assert_eq!(&png[1..4], b"PNG");
    let shear = PictureOptions { quantity: Quantity::WallShear, ..options };
    let wall = render_vessel_png(&out.path().join("wall.vtkhdf"), None, &shear).unwrap();
    assert_eq!(&wall[1..4], b"PNG");
    let error = render_vessel_png(&series, None, &shear).unwrap_err().to_string();
    assert!(error.contains("`WSS`") && error.contains("Pressure"), "{error}");
}

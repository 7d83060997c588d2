//! A process that writes a series is killed at arbitrary moments; the public file must stay whole.
#![cfg(unix)]

use glam::DVec3;
use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;
use vaso_io::{
    FrameData, SeriesReader, SeriesWriter, SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter,
};

const FOLDER: &str = "VASO_KILL_TEST_FOLDER";
const TRIALS: u64 = 24;

/// Frame `step` of a body whose content follows from the step alone.
fn expected(step: usize) -> FrameData {
    let count = 3000 + 700 * (step % 5);
    let at = |i: usize| f64::from(((i * 7 + step * 13) % 1000) as f32 / 1000.0);
    FrameData {
        time: step as f64,
        position: (0..count).map(|i| DVec3::new(at(i), at(i + 1), at(i + 2))).collect(),
        scalars: vec![("Pressure".into(), (0..count).map(at).collect())],
        vectors: vec![("Velocity".into(), (0..count).map(|i| DVec3::splat(at(3 * i))).collect())],
        ids: Some((0..count as u64).collect()),
    }
}

/// The child: appends frames until it is killed, and says after each one that it is done.
#[test]
#[ignore = "started and killed by `the_public_file_survives_a_kill_at_any_moment`"]
fn writes_until_killed() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let path = Path::new(&folder).join("fluid.vtkhdf");
    let mut series = SeriesWriter::continue_at(&path, f64::INFINITY).unwrap();
    for step in series.len().. {
        series.append(&expected(step).view()).unwrap();
        println!("done {}", step + 1);
        std::io::stdout().flush().unwrap();
    }
}

/// Frame `step` of a surface whose points stay and whose `TAWSS` comes every fifth frame.
fn expected_surface(step: usize) -> FrameData {
    let tawss = if step < 4 { f64::INFINITY } else { ((step + 1) / 5) as f64 };
    FrameData {
        time: step as f64,
        position: expected(0).position,
        scalars: vec![("TAWSS".into(), vec![tawss; 3000])],
        vectors: vec![("WSS".into(), (0..3000).map(|i| DVec3::splat((i * step % 1000) as f64)).collect())],
        ids: None,
    }
}

/// The child for a surface.
#[test]
#[ignore = "started and killed by `a_surface_series_survives_a_kill_at_any_moment`"]
fn writes_a_surface_until_killed() {
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let path = Path::new(&folder).join("wall.vtkhdf");
    let points = expected(0).position;
    let triangles: Vec<[u32; 3]> = (0..2998).map(|k| [k, k + 1, k + 2]).collect();
    let mesh = SurfaceMesh { points: &points, triangles: &triangles };
    let field =
        |name, components| SurfaceField { name, components, unit: "Pa", definition: "", citation: "" };
    let fields = [field("WSS", 3), field("TAWSS", 1)];
    let mut series = SurfaceSeriesWriter::continue_at(&path, mesh, &fields, f64::INFINITY).unwrap();
    for step in series.len().. {
        let frame = expected_surface(step);
        let ends_a_cycle = step == 0 || step % 5 == 4;
        let mut view = SurfaceFrame { time: frame.time, ..SurfaceFrame::default() };
        view.vectors.push(("WSS", frame.vector("WSS").unwrap()));
        view.scalars.extend(ends_a_cycle.then(|| ("TAWSS", frame.scalar("TAWSS").unwrap())));
        series.append(&view).unwrap();
        println!("done {}", step + 1);
        std::io::stdout().flush().unwrap();
    }
}

#[test]
fn the_public_file_survives_a_kill_at_any_moment() {
    survives("writes_until_killed", "fluid.vtkhdf", expected);
}

#[test]
fn a_surface_series_survives_a_kill_at_any_moment() {
    survives("writes_a_surface_until_killed", "wall.vtkhdf", expected_surface);
}

fn survives(child: &str, file: &str, expected: fn(usize) -> FrameData) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(file);
    let mut frames_seen = 0;
    for trial in 0..TRIALS {
        // Delays that fall into different phases of an append: golden-ratio steps between 2 and 120 ms after
        // the first frame of this trial.
        let delay = Duration::from_secs_f64(0.002 + 0.118 * (trial as f64 * 0.618_034).fract());
        let promised = frames_promised_before_kill(child, folder.path(), delay).max(frames_seen);

        let reader = SeriesReader::open(&path).unwrap_or_else(|error| panic!("trial {trial}: {error}"));
        let found = reader.info().times.len();
        assert!(found >= promised, "trial {trial}: {found} frames in the file, {promised} were promised");
        for step in frames_seen.saturating_sub(2)..found {
            assert_eq!(reader.frame(step).unwrap(), expected(step), "trial {trial}, frame {step}");
        }
        frames_seen = found;
    }
    assert!(frames_seen > TRIALS as usize, "only {frames_seen} frames: the kills came before any work");
    let reader = SeriesReader::open(&path).unwrap();
    for step in 0..frames_seen {
        assert_eq!(reader.frame(step).unwrap(), expected(step), "frame {step} of the final file");
    }
}

/// Runs the child, kills it `delay` after its first frame, and returns how many frames it said are in the file.
fn frames_promised_before_kill(child: &str, folder: &Path, delay: Duration) -> usize {
    let mut child = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", child, "--ignored", "--nocapture"])
        .env(FOLDER, folder)
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines().map_while(Result::ok);
    let count = |line: &String| line.strip_prefix("done ").and_then(|text| text.parse().ok());
    let mut promised: usize = lines.by_ref().find_map(|line| count(&line)).unwrap();
    std::thread::sleep(delay);
    child.kill().unwrap();
    child.wait().unwrap();
    // What the pipe still holds was said before the kill.
    for line in lines {
        promised = count(&line).unwrap_or(promised);
    }
    promised
}

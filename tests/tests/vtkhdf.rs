//! The reader that matters for a particle series is VTK's: it opens what we wrote and must find every value.

use glam::DVec3;
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::Command;
use vaso_io::{Frame, SeriesWriter};

/// An interpreter with VTK: the one named by `VASO_PYTHON`, else the one `.ci/python.sh` makes.
///
/// Without one the test is skipped, except on the machine whose job it is to run it.
fn python_with_vtk() -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let candidate =
        std::env::var_os("VASO_PYTHON").map_or_else(|| root.join(".venv/bin/python"), PathBuf::from);
    let found = Command::new(&candidate).args(["-c", "import vtkmodules.vtkIOHDF"]).output();
    if found.is_ok_and(|output| output.status.success()) {
        return Some(candidate);
    }
    let reason = format!("{} has no VTK: run `.ci/python.sh` or set VASO_PYTHON", candidate.display());
    assert!(std::env::var("CI").as_deref() != Ok("true"), "{reason}");
    println!("skipped: {reason}");
    None
}

/// The frames of a small body whose number of particles grows, shrinks and stays.
struct Body {
    time: f64,
    position: Vec<DVec3>,
    velocity: Vec<DVec3>,
    pressure: Vec<f64>,
    ids: Vec<u64>,
}

impl Body {
    fn fluid(step: usize) -> Self {
        let count = [5, 9000, 1, 4096, 4096, 12_345][step];
        let at = |i: usize| (i as f64 * 0.618_033_988_749 + step as f64 * 0.1).fract();
        Self {
            time: 0.01 * step as f64,
            position: (0..count).map(|i| DVec3::new(at(i), at(2 * i), at(3 * i)) * 0.02).collect(),
            velocity: (0..count).map(|i| DVec3::new(-at(i), 0.3, at(5 * i))).collect(),
            pressure: (0..count).map(|i| 1e4 * at(7 * i)).collect(),
            ids: (0..count as u64).rev().map(|i| i + (1 << 40)).collect(),
        }
    }

    /// A rigid wall: nothing but the pressure changes, so all else is stored once.
    fn wall(step: usize) -> Self {
        let at = |i: usize| (i as f64 * 0.618_033_988_749).fract();
        let mut body = Self::fluid(3);
        body.time = 0.01 * step as f64;
        body.pressure = (0..4096).map(|i| 1e4 * at(7 * i + step)).collect();
        body
    }

    fn frame(&self) -> Frame<'_> {
        Frame {
            time: self.time,
            position: &self.position,
            scalars: vec![("Pressure", &self.pressure)],
            vectors: vec![("Velocity", &self.velocity)],
            ids: Some(&self.ids),
        }
    }

    fn expected(&self) -> serde_json::Value {
        let rows = |list: &[DVec3]| list.iter().map(|v| v.to_array()).collect::<Vec<_>>();
        json!({
            "time": self.time,
            "points": rows(&self.position),
            "fields": { "Pressure": self.pressure, "Velocity": rows(&self.velocity), "Id": self.ids },
        })
    }
}

fn check(python: &Path, series: &Path, bodies: &[Body]) {
    let expected = series.with_extension("json");
    let frames: Vec<_> = bodies.iter().map(Body::expected).collect();
    std::fs::write(&expected, json!({ "frames": frames }).to_string()).unwrap();
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/check_vtkhdf.py");
    let output = Command::new(python).arg(script).args([series, &expected]).output().unwrap();
    let text =
        String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    println!("{text}");
}

#[test]
fn vtk_reads_a_fluid_whose_particle_number_changes() {
    let Some(python) = python_with_vtk() else { return };
    let folder = tempfile::tempdir().unwrap();
    let bodies: Vec<Body> = (0..6).map(Body::fluid).collect();
    let mut series = SeriesWriter::create(folder.path().join("fluid.vtkhdf"));
    for (written, body) in bodies.iter().enumerate() {
        series.append(&body.frame()).unwrap();
        check(&python, series.path(), &bodies[..=written]);
    }
}

#[test]
fn vtk_reads_a_wall_whose_fixed_fields_are_stored_once() {
    let Some(python) = python_with_vtk() else { return };
    let folder = tempfile::tempdir().unwrap();
    let bodies: Vec<Body> = (0..8).map(Body::wall).collect();
    let mut series = SeriesWriter::create(folder.path().join("wall.vtkhdf"));
    bodies.iter().for_each(|body| series.append(&body.frame()).unwrap());
    check(&python, series.path(), &bodies);
}

#[test]
fn vtk_reads_a_series_that_was_cut_back_and_continued() {
    let Some(python) = python_with_vtk() else { return };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    let bodies: Vec<Body> = (0..6).map(Body::fluid).collect();
    let mut series = SeriesWriter::create(&path);
    bodies.iter().for_each(|body| series.append(&body.frame()).unwrap());
    drop(series);
    let mut series = SeriesWriter::continue_at(&path, bodies[2].time).unwrap();
    assert_eq!(series.len(), 3);
    bodies[3..].iter().for_each(|body| series.append(&body.frame()).unwrap());
    check(&python, &path, &bodies);
}

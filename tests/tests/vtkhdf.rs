//! The reader that matters for a particle series is VTK's: it opens what we wrote and must find every value.

use glam::DVec3;
use serde_json::json;
use std::path::Path;
use std::process::Command;
use vaso_io::{Frame, SeriesWriter, SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter};
use vaso_tests::python;

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
    let frames: Vec<_> = bodies.iter().map(Body::expected).collect();
    check_frames(python, series, &frames);
}

fn check_frames(python: &Path, series: &Path, frames: &[serde_json::Value]) {
    let expected = series.with_extension("json");
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
    let Some(python) = python("vtkmodules.vtkIOHDF") else { return };
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
    let Some(python) = python("vtkmodules.vtkIOHDF") else { return };
    let folder = tempfile::tempdir().unwrap();
    let bodies: Vec<Body> = (0..8).map(Body::wall).collect();
    let mut series = SeriesWriter::create(folder.path().join("wall.vtkhdf"));
    bodies.iter().for_each(|body| series.append(&body.frame()).unwrap());
    check(&python, series.path(), &bodies);
}

#[test]
fn vtk_reads_a_series_that_was_cut_back_and_continued() {
    let Some(python) = python("vtkmodules.vtkIOHDF") else { return };
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

/// A strip of triangles with a stress in every frame, and a mean that comes with frames 2 and 5.
struct Strip {
    points: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Strip {
    const POINTS: usize = 5001;

    fn new() -> Self {
        let point = |k: usize| DVec3::new(k as f64, (k % 2) as f64, (k as f64).sin()) * 1e-4;
        let triangle = |k: u32| if k.is_multiple_of(2) { [k, k + 1, k + 2] } else { [k + 1, k, k + 2] };
        Self {
            points: (0..Self::POINTS).map(point).collect(),
            triangles: (0..Self::POINTS as u32 - 2).map(triangle).collect(),
        }
    }

    fn mesh(&self) -> SurfaceMesh<'_> {
        SurfaceMesh { points: &self.points, triangles: &self.triangles }
    }

    fn fields() -> [SurfaceField<'static>; 2] {
        let stress = "the drag on the wall";
        let mean = "1/T int |tau| dt";
        [
            SurfaceField { name: "WSS", components: 3, unit: "Pa", definition: stress, citation: "" },
            SurfaceField {
                name: "TAWSS",
                components: 1,
                unit: "Pa",
                definition: mean,
                citation: "Ku et al. 1985",
            },
        ]
    }

    fn stress(step: usize) -> Vec<DVec3> {
        (0..Self::POINTS).map(|k| DVec3::new(k as f64, step as f64, (k * step % 97) as f64)).collect()
    }

    fn mean(step: usize) -> Option<Vec<f64>> {
        let cycle = (step + 1) / 3;
        (cycle > 0).then(|| (0..Self::POINTS).map(|k| (k * cycle) as f64).collect())
    }

    /// Points of the frame where the strip moves from frame 3 on.
    fn moved(&self, step: usize) -> Vec<DVec3> {
        self.points.iter().map(|x| *x + DVec3::Z * 1e-3 * step.saturating_sub(2) as f64).collect()
    }

    fn append(&self, series: &mut SurfaceSeriesWriter, step: usize, moves: bool) {
        let (stress, mean, moved) = (Self::stress(step), Self::mean(step), self.moved(step));
        series
            .append(&SurfaceFrame {
                time: 0.1 * step as f64,
                points: (moves && step > 2).then_some(&moved[..]),
                scalars: mean.iter().filter(|_| step % 3 == 2).map(|mean| ("TAWSS", &mean[..])).collect(),
                vectors: vec![("WSS", &stress)],
            })
            .unwrap();
    }

    fn expected(&self, step: usize, moves: bool) -> serde_json::Value {
        let rows = |list: &[DVec3]| list.iter().map(|v| v.to_array()).collect::<Vec<_>>();
        let points = if moves { self.moved(step) } else { self.points.clone() };
        // JSON has no NaN: `null` stands for it.
        let mean = Self::mean(step).map_or(vec![None; Self::POINTS], |m| m.into_iter().map(Some).collect());
        json!({
            "time": 0.1 * step as f64,
            "points": rows(&points),
            "triangles": self.triangles,
            "fields": { "WSS": rows(&Self::stress(step)), "TAWSS": mean },
        })
    }
}

#[test]
fn vtk_reads_a_surface_whose_triangles_are_stored_once() {
    let Some(python) = python("vtkmodules.vtkIOHDF") else { return };
    let folder = tempfile::tempdir().unwrap();
    let strip = Strip::new();
    for moves in [false, true] {
        let path = folder.path().join("wall.vtkhdf");
        let mut series = SurfaceSeriesWriter::create(&path, strip.mesh(), &Strip::fields()).unwrap();
        (0..7).for_each(|step| strip.append(&mut series, step, moves));
        drop(series);
        // A resumed series has to be as good as an unbroken one.
        let mut series =
            SurfaceSeriesWriter::continue_at(&path, strip.mesh(), &Strip::fields(), 0.45).unwrap();
        (5..7).for_each(|step| strip.append(&mut series, step, moves));
        let expected: Vec<_> = (0..7).map(|step| strip.expected(step, moves)).collect();
        check_frames(&python, &path, &expected);
    }
}

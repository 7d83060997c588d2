//! What a surface series promises to the program that writes it.

use glam::DVec3;
use std::path::Path;
use vaso_io::{IoError, SeriesReader, SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter};

const POINTS: usize = 20_000;

fn points() -> Vec<DVec3> {
    (0..POINTS).map(|k| DVec3::new((k as f32 * 0.618).fract().into(), (k % 2) as f64, 0.25)).collect()
}

fn triangles() -> Vec<[u32; 3]> {
    (0..POINTS as u32 - 2).map(|k| [k, k + 1, k + 2]).collect()
}

const FIELDS: [SurfaceField<'static>; 3] = [
    SurfaceField {
        name: "WSS",
        components: 3,
        unit: "Pa",
        definition: "mu (I - n n) (grad v + grad v^T) m",
        citation: "",
    },
    SurfaceField {
        name: "TAWSS",
        components: 1,
        unit: "Pa",
        definition: "1/T int |tau| dt",
        citation: "Ku, Giddens, Zarins, Glagov 1985",
    },
    SurfaceField { name: "OSI", components: 1, unit: "", definition: "", citation: "He, Ku 1996" },
];

/// Frame `step`: a stress always, indices at steps 3 and 6.
fn append(series: &mut SurfaceSeriesWriter, step: usize) {
    let stress: Vec<DVec3> = (0..POINTS).map(|k| DVec3::new((k % 100) as f64, step as f64, 0.5)).collect();
    let index = vec![step as f64; POINTS];
    let ends_a_cycle = step > 0 && step.is_multiple_of(3);
    let scalars = if ends_a_cycle { vec![("TAWSS", &index[..]), ("OSI", &index[..])] } else { Vec::new() };
    let vectors = vec![("WSS", &stress[..])];
    series.append(&SurfaceFrame { time: step as f64, points: None, scalars, vectors }).unwrap();
}

fn write(path: &Path, steps: usize) {
    let (points, triangles) = (points(), triangles());
    let mesh = SurfaceMesh { points: &points, triangles: &triangles };
    let mut series = SurfaceSeriesWriter::create(path, mesh, &FIELDS).unwrap();
    assert!(series.is_empty() && series.last_time().is_none());
    (0..steps).for_each(|step| append(&mut series, step));
    assert_eq!((series.len(), series.last_time()), (steps, Some((steps - 1) as f64)));
}

#[test]
fn what_a_frame_leaves_out_stays_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.vtkhdf");
    write(&path, 8);
    let reader = SeriesReader::open(&path).unwrap();
    assert_eq!(reader.triangles().unwrap(), triangles());
    assert_eq!(reader.info().counts, [POINTS; 8]);
    for (step, known) in
        [None, None, None, Some(3.0), Some(3.0), Some(3.0), Some(6.0), Some(6.0)].into_iter().enumerate()
    {
        let frame = reader.frame(step).unwrap();
        assert_eq!(frame.position, points());
        assert_eq!(frame.vector("WSS").unwrap()[7], DVec3::new(7.0, step as f64, 0.5));
        for name in ["TAWSS", "OSI"] {
            let values = frame.scalar(name).unwrap();
            assert!(values.iter().all(|x| known.map_or(x.is_nan(), |known| *x == known)), "{name} {step}");
        }
    }
}

#[test]
fn the_file_says_what_its_fields_are() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.vtkhdf");
    write(&path, 2);
    let reader = SeriesReader::open(&path).unwrap();
    let fields: Vec<_> = reader
        .info()
        .fields
        .iter()
        .map(|f| {
            (&f.name[..], f.components, f.unit.as_deref(), f.definition.as_deref(), f.citation.as_deref())
        })
        .collect();
    assert_eq!(
        fields,
        [
            ("OSI", 1, Some("1"), None, Some("He, Ku 1996")),
            ("TAWSS", 1, Some("Pa"), Some("1/T int |tau| dt"), Some("Ku, Giddens, Zarins, Glagov 1985")),
            ("WSS", 3, Some("Pa"), Some("mu (I - n n) (grad v + grad v^T) m"), None),
        ]
    );
}

#[test]
fn what_does_not_change_is_stored_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.vtkhdf");
    let (points, triangles) = (points(), triangles());
    let mesh = SurfaceMesh { points: &points, triangles: &triangles };
    let mut series = SurfaceSeriesWriter::create(&path, mesh, &FIELDS).unwrap();
    let noise =
        |seed: usize| -> Vec<f64> { (0..POINTS).map(|k| ((k * seed) as f64 * 0.618).fract()).collect() };
    let mut sizes = Vec::new();
    for step in 0..12 {
        let mean = noise(step + 1);
        let scalars = if step == 0 { vec![("TAWSS", &mean[..])] } else { Vec::new() };
        series.append(&SurfaceFrame { time: step as f64, scalars, ..SurfaceFrame::default() }).unwrap();
        sizes.push(std::fs::metadata(&path).unwrap().len());
    }
    assert!(sizes[11] - sizes[0] < 4 * POINTS as u64 / 10, "eleven frames without news: {sizes:?}");
}

#[test]
fn a_resumed_series_equals_an_unbroken_one() {
    let folder = tempfile::tempdir().unwrap();
    let (broken, unbroken) = (folder.path().join("a.vtkhdf"), folder.path().join("b.vtkhdf"));
    write(&unbroken, 8);
    write(&broken, 7);
    let (points, triangles) = (points(), triangles());
    let mesh = SurfaceMesh { points: &points, triangles: &triangles };
    let mut series = SurfaceSeriesWriter::continue_at(&broken, mesh, &FIELDS, 4.5).unwrap();
    assert_eq!(series.last_time(), Some(4.0));
    (5..8).for_each(|step| append(&mut series, step));
    drop(series);
    // The C library does not promise equal bytes for equal content.
    let bytes = |path: &Path| std::fs::read(path).unwrap();
    assert!(cfg!(feature = "hdf5-c") || bytes(&broken) == bytes(&unbroken), "the files differ");

    let refused = |mesh, fields: &[SurfaceField<'_>]| match SurfaceSeriesWriter::continue_at(
        &broken, mesh, fields, 4.5,
    ) {
        Err(IoError::Mismatch { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    assert!(refused(SurfaceMesh { triangles: &triangles[1..], ..mesh }, &FIELDS).contains("other triangles"));
    assert!(refused(mesh, &FIELDS[1..]).contains("other fields"));
    assert!(bytes(&broken) == bytes(&unbroken) || cfg!(feature = "hdf5-c"), "a refusal changed the file");
}

#[test]
fn points_may_move() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.vtkhdf");
    let (start, triangles) = (points(), triangles());
    let mesh = SurfaceMesh { points: &start, triangles: &triangles };
    let mut series = SurfaceSeriesWriter::create(&path, mesh, &[]).unwrap();
    let moved: Vec<DVec3> = start.iter().map(|x| *x + DVec3::X).map(|x| x.as_vec3().as_dvec3()).collect();
    for (step, points) in [None, Some(&moved[..]), None].into_iter().enumerate() {
        series.append(&SurfaceFrame { time: step as f64, points, ..SurfaceFrame::default() }).unwrap();
    }
    let reader = SeriesReader::open(&path).unwrap();
    let position = |step| reader.frame(step).unwrap().position;
    assert_eq!((position(0), position(1), position(2)), (start.clone(), moved.clone(), moved));
    assert_eq!(reader.triangles().unwrap(), triangles);
}

#[test]
fn what_does_not_fit_is_refused_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.vtkhdf");
    let (points, triangles) = (points(), triangles());
    let mesh = SurfaceMesh { points: &points, triangles: &triangles };
    let words = |error: IoError| match error {
        IoError::Mismatch { what, .. } => what,
        other => panic!("{other:?}"),
    };
    let create = |mesh, fields: &[SurfaceField<'_>]| {
        words(SurfaceSeriesWriter::create(&path, mesh, fields).unwrap_err())
    };
    assert!(create(SurfaceMesh { points: &points[1..], ..mesh }, &FIELDS).contains("corner 19999 of 19999"));
    assert!(create(mesh, &[FIELDS[0], FIELDS[0]]).contains("twice"));
    assert!(create(mesh, &[SurfaceField { components: 2, ..FIELDS[0] }]).contains("2 components"));

    let mut series = SurfaceSeriesWriter::create(&path, mesh, &FIELDS).unwrap();
    append(&mut series, 1);
    let before = std::fs::read(&path).unwrap();
    let values = vec![1.0; POINTS];
    let frame = |scalars| SurfaceFrame { time: 2.0, points: None, scalars, vectors: Vec::new() };
    let mut refused = |frame: SurfaceFrame<'_>| words(series.append(&frame).unwrap_err());
    assert!(refused(frame(vec![("OSI", &values[1..])])).contains("19999 values for 20000 points"));
    assert!(refused(frame(vec![("RRT", &values)])).contains("no field `RRT`"));
    assert!(refused(frame(vec![("WSS", &values)])).contains("no field `WSS` with 1 components"));
    assert!(refused(frame(vec![("OSI", &values), ("OSI", &values)])).contains("twice"));
    assert!(refused(SurfaceFrame { time: 1.0, ..frame(Vec::new()) }).contains("after the last one"));
    assert!(refused(SurfaceFrame { points: Some(&points[1..]), ..frame(Vec::new()) }).contains("points"));
    assert!(std::fs::read(&path).unwrap() == before, "the file has changed");
    append(&mut series, 2);
    assert_eq!(SeriesReader::open(&path).unwrap().info().times, [1.0, 2.0]);
}

#[test]
fn damaged_surfaces_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.vtkhdf");
    write(&path, 3);
    let whole = std::fs::read(&path).unwrap();
    for cut in (0..whole.len()).step_by(whole.len() / 40) {
        std::fs::write(&path, &whole[..cut]).unwrap();
        // Reading may fail anywhere; it must not panic, and what it gives must be right.
        if let Ok(reader) = SeriesReader::open(&path) {
            assert!(reader.triangles().map_or(true, |read| read == triangles()), "cut at {cut}");
            assert!(reader.frame(1).map_or(true, |read| read.position == points()), "cut at {cut}");
        }
    }
}

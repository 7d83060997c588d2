//! What a particle series promises to the program that writes it.

use glam::DVec3;
use std::path::Path;
use vaso_io::{Frame, FrameData, IoError, SeriesReader, SeriesWriter, read_series_info};

fn frame(step: usize, count: usize) -> FrameData {
    let at = |i: usize| f64::from(((i * 31 + step * 17) % 997) as f32 / 997.0);
    FrameData {
        time: 0.01 * step as f64,
        position: (0..count).map(|i| DVec3::new(at(i), at(i + 1), at(2 * i))).collect(),
        scalars: vec![
            ("Density".into(), (0..count).map(|i| 1000.0 + at(i)).map(|x| f64::from(x as f32)).collect()),
            ("Pressure".into(), (0..count).map(at).collect()),
        ],
        vectors: vec![("Velocity".into(), (0..count).map(|i| DVec3::splat(at(5 * i))).collect())],
        ids: Some((0..count as u64).map(|i| i + (1 << 45)).collect()),
    }
}

fn write(path: &Path, frames: &[FrameData]) {
    let mut series = SeriesWriter::create(path);
    frames.iter().for_each(|frame| series.append(&frame.view()).unwrap());
}

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn frames_of_changing_size_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    let frames: Vec<FrameData> =
        [3, 4096, 0, 9001, 4095, 4097, 20_000].iter().enumerate().map(|(k, &n)| frame(k, n)).collect();
    write(&path, &frames);
    let reader = SeriesReader::open(&path).unwrap();
    assert_eq!(reader.info().counts, [3, 4096, 0, 9001, 4095, 4097, 20_000]);
    let fields: Vec<_> =
        reader.info().fields.iter().map(|f| (f.name.as_str(), f.components, f.unit.as_deref())).collect();
    assert_eq!(
        fields,
        [
            ("Density", 1, Some("kg/m^3")),
            ("Id", 1, Some("1")),
            ("Pressure", 1, Some("Pa")),
            ("Velocity", 3, Some("m/s"))
        ]
    );
    for (k, frame) in frames.iter().enumerate() {
        assert_eq!(reader.frame(k).unwrap(), *frame, "frame {k}");
    }
    assert_eq!(reader.last_frame().unwrap().unwrap(), frames[6]);
    assert!(matches!(reader.frame(7), Err(IoError::Mismatch { .. })));
}

#[test]
fn the_public_file_is_whole_after_every_frame_and_alone_at_the_end() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    let mut series = SeriesWriter::create(&path);
    for k in 0..6 {
        series.append(&frame(k, 1000 + k).view()).unwrap();
        let reader = SeriesReader::open(&path).unwrap();
        assert_eq!(reader.info().times.len(), k + 1);
        for j in 0..=k {
            assert_eq!(reader.frame(j).unwrap(), frame(j, 1000 + j));
        }
    }
    drop(series);
    assert_eq!(names(folder.path()), ["fluid.vtkhdf"]);
}

#[test]
fn a_program_that_holds_the_file_open_keeps_reading_what_it_opened() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    let mut series = SeriesWriter::create(&path);
    series.append(&frame(0, 5000).view()).unwrap();
    series.append(&frame(1, 5000).view()).unwrap();
    let held = SeriesReader::open(&path).unwrap();
    for k in 2..8 {
        series.append(&frame(k, 5000).view()).unwrap();
        assert_eq!(held.frame(0).unwrap(), frame(0, 5000));
        assert_eq!(held.frame(1).unwrap(), frame(1, 5000));
    }
    assert_eq!(held.info().times.len(), 2);
    assert_eq!(read_series_info(&path).unwrap().times.len(), 8);
    assert_eq!(SeriesReader::open(&path).unwrap().frame(7).unwrap(), frame(7, 5000));
}

#[test]
fn a_resumed_series_equals_an_unbroken_one() {
    let folder = tempfile::tempdir().unwrap();
    let (broken, unbroken) = (folder.path().join("a.vtkhdf"), folder.path().join("b.vtkhdf"));
    let frames: Vec<FrameData> = (0..8).map(|k| frame(k, 3000 + 500 * (k % 3))).collect();
    write(&unbroken, &frames);
    write(&broken, &frames[..6]);
    // A draft left by a kill must not matter.
    std::fs::write(folder.path().join("a.vtkhdf.a.tmp"), "torn").unwrap();

    let mut series = SeriesWriter::continue_at(&broken, 0.035).unwrap();
    assert_eq!((series.len(), series.last_time()), (4, Some(0.03)));
    frames[4..].iter().for_each(|frame| series.append(&frame.view()).unwrap());
    drop(series);
    assert_eq!(names(folder.path()), ["a.vtkhdf", "b.vtkhdf"]);
    // The C library does not promise equal bytes for equal content.
    let bytes = |path: &Path| std::fs::read(path).unwrap();
    assert!(cfg!(feature = "hdf5-c") || bytes(&broken) == bytes(&unbroken), "the files differ");
    let (a, b) = (SeriesReader::open(&broken).unwrap(), SeriesReader::open(&unbroken).unwrap());
    assert_eq!(a.info(), b.info());
    (0..8).for_each(|k| assert_eq!(a.frame(k).unwrap(), b.frame(k).unwrap()));
    drop((a, b));

    assert!(SeriesWriter::continue_at(&broken, -1.0).unwrap().is_empty());
    assert!(!broken.exists(), "no frame is left before the start, so no file is");
}

#[test]
fn what_does_not_change_is_stored_once() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wall.vtkhdf");
    let mut still = frame(0, 20_000);
    let mut series = SeriesWriter::create(&path);
    let mut sizes = Vec::new();
    for k in 0..10 {
        still.time = k as f64;
        series.append(&still.view()).unwrap();
        sizes.push(std::fs::metadata(&path).unwrap().len());
    }
    assert!(sizes[9] - sizes[0] < sizes[0] / 20, "{sizes:?}");
    assert_eq!(SeriesReader::open(&path).unwrap().frame(9).unwrap(), still);
}

#[test]
fn frames_that_do_not_fit_are_refused_and_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    let mut series = SeriesWriter::create(&path);
    series.append(&frame(1, 10).view()).unwrap();
    let before = std::fs::read(&path).unwrap();

    let good = frame(2, 10);
    let pressure = good.scalar("Pressure").unwrap();
    let refused = |frame: Frame<'_>, series: &mut SeriesWriter| match series.append(&frame) {
        Err(IoError::Mismatch { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    let short = Frame { scalars: vec![("Pressure", &pressure[..9]), ("Density", pressure)], ..good.view() };
    assert!(refused(short, &mut series).contains("`Pressure` has 9 values for 10"));
    let fewer = Frame { scalars: vec![("Pressure", pressure)], ..good.view() };
    assert!(refused(fewer, &mut series).contains("Density"));
    let twice = Frame { scalars: vec![("Pressure", pressure), ("Pressure", pressure)], ..good.view() };
    assert!(refused(twice, &mut series).contains("twice"));
    assert!(refused(Frame { time: 0.01, ..good.view() }, &mut series).contains("after the last one"));
    assert!(refused(Frame { time: f64::NAN, ..good.view() }, &mut series).contains("NaN"));
    assert!(std::fs::read(&path).unwrap() == before, "the file has changed");

    series.append(&good.view()).unwrap();
    assert_eq!(SeriesReader::open(&path).unwrap().frame(1).unwrap(), good);
}

#[test]
fn after_a_failed_write_the_series_goes_on_where_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let home = folder.path().join("out");
    std::fs::create_dir(&home).unwrap();
    let path = home.join("fluid.vtkhdf");
    let mut series = SeriesWriter::create(&path);
    for k in 0..3 {
        series.append(&frame(k, 5000).view()).unwrap();
    }
    // The disk goes away and comes back.
    let away = folder.path().join("away");
    std::fs::rename(&home, &away).unwrap();
    let error = series.append(&frame(3, 5000).view()).unwrap_err();
    assert!(error.to_string().contains("fluid.vtkhdf"), "{error}");
    std::fs::rename(&away, &home).unwrap();
    for k in 3..6 {
        series.append(&frame(k, 5000).view()).unwrap();
    }
    let reader = SeriesReader::open(&path).unwrap();
    for k in 0..6 {
        assert_eq!(reader.frame(k).unwrap(), frame(k, 5000));
    }
}

#[test]
fn other_and_damaged_files_are_errors() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("fluid.vtkhdf");
    assert!(SeriesReader::open(&path).is_err());
    std::fs::write(&path, "solid cube").unwrap();
    assert!(matches!(SeriesReader::open(&path), Err(IoError::Hdf5 { .. })));
    let other = folder.path().join("other.h5");
    vaso_io::Archive::new("checkpoint", 1).write(&other).unwrap();
    assert!(matches!(SeriesReader::open(&other), Err(IoError::Kind { .. })));

    let frames: Vec<FrameData> = (0..3).map(|k| frame(k, 300)).collect();
    write(&path, &frames);
    let whole = std::fs::read(&path).unwrap();
    for cut in (0..whole.len()).step_by(whole.len() / 60) {
        std::fs::write(&path, &whole[..cut]).unwrap();
        // Reading may fail at the opening or at the frame; it must not panic, and what it gives must be right.
        if let Ok(reader) = SeriesReader::open(&path) {
            for (k, frame) in frames.iter().enumerate() {
                assert!(reader.frame(k).map_or(true, |read| read == *frame), "cut at {cut}");
            }
        }
    }
}

//! Files damaged in every single line: loading never panics, and what is refused has problems to show.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use vaso_scene::material::ElasticWall;
use vaso_scene::{Drive, Scene, Wall};

fn load_text(folder: &Path, text: &str) -> bool {
    let file = folder.join("damaged.toml");
    fs::write(&file, text).unwrap();
    match Scene::load(&file, &[]) {
        Ok(_) => true,
        Err(error) => {
            assert!(!error.problems.is_empty() && !error.to_string().is_empty());
            false
        }
    }
}

/// A folder beside which `../files` is what the good cases expect.
fn workplace() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("case")).unwrap();
    fs::create_dir(folder.path().join("files")).unwrap();
    for file in fs::read_dir("tests/files").unwrap() {
        let path = file.unwrap().path();
        fs::copy(&path, folder.path().join("files").join(path.file_name().unwrap())).unwrap();
    }
    folder
}

fn good_texts() -> Vec<String> {
    let files = fs::read_dir("tests/good").unwrap().map(|file| file.unwrap().path());
    files.map(|path| fs::read_to_string(path).unwrap()).collect()
}

#[test]
fn a_missing_line_never_panics() {
    let folder = workplace();
    let case = folder.path().join("case");
    let (mut accepted, mut refused) = (0, 0);
    for text in good_texts() {
        assert!(load_text(&case, &text));
        let lines: Vec<&str> = text.lines().collect();
        for skipped in 0..lines.len() {
            let rest =
                lines.iter().enumerate().filter(|&(number, _)| number != skipped).map(|(_, line)| *line);
            match load_text(&case, &rest.collect::<Vec<_>>().join("\n")) {
                true => accepted += 1,
                false => refused += 1,
            }
        }
    }
    assert!(accepted > 40 && refused > 40, "{accepted} accepted, {refused} refused");
}

#[test]
fn a_wrong_value_never_panics() {
    let values = [
        "-1",
        "1e999",
        "\"x\"",
        "\"1 mm\"",
        "\"-1 Pa s\"",
        "true",
        "[]",
        "[{}]",
        "{}",
        "{ model = 1 }",
        "1979-05-27",
    ];
    let folder = workplace();
    let case = folder.path().join("case");
    let mut refused = 0;
    for text in good_texts() {
        let lines: Vec<&str> = text.lines().collect();
        for (number, line) in lines.iter().enumerate().filter(|(_, line)| !line.starts_with('#')) {
            let Some((key, _)) = line.split_once(" = ") else { continue };
            for value in values {
                let changed = format!("{key} = {value}");
                let mut lines = lines.clone();
                lines[number] = &changed;
                refused += usize::from(!load_text(&case, &lines.join("\n")));
            }
        }
    }
    assert!(refused > 700, "{refused} refused");
}

#[test]
fn any_start_of_a_file_never_panics() {
    let folder = workplace();
    let case = folder.path().join("case");
    for text in good_texts() {
        for end in (0..text.len()).step_by(5).filter(|&end| text.is_char_boundary(end)) {
            load_text(&case, &text[..end]);
        }
    }
}

#[test]
fn a_text_in_memory_is_read_like_a_file() {
    let table = fs::read_to_string("tests/files/rise.csv").unwrap();
    let text = fs::read_to_string("tests/good/wall_alone.toml").unwrap();
    let files = [("../files/vessel.stl".into(), String::new()), ("../files/rise.csv".into(), table)];
    let parsed = Scene::parse(&text, &[], &BTreeMap::from(files)).unwrap();
    let loaded = Scene::load(Path::new("tests/good/wall_alone.toml"), &[]).unwrap();
    assert_eq!((parsed.numerics, parsed.run, parsed.output), (loaded.numerics, loaded.run, loaded.output));
    let pressure = |wall| match wall {
        Wall::Solid(ElasticWall { pressure: Some(Drive::Waveform(wave)), .. }) => (wave.time, wave.value),
        other => panic!("{other:?}"),
    };
    assert_eq!(pressure(parsed.wall), pressure(loaded.wall));
    let problems = Scene::parse(&text, &[], &BTreeMap::new()).expect_err("no files were given").problems;
    let missing: Vec<&str> = problems.iter().map(|problem| problem.message.as_str()).collect();
    assert!(missing.contains(&"there is no file \"../files/vessel.stl\""), "{missing:?}");
}

/// Each part of a key made a table within a table, and a hundred thousand of them more than the stack could hold.
#[test]
fn an_override_of_very_many_parts_is_refused() {
    let deep = ("a.".repeat(100_000) + "a", "1".to_owned());
    let error = Scene::parse(&good_texts()[0], &[deep], &BTreeMap::new()).expect_err("there is no such key");
    let found = error.problems.iter().find(|problem| problem.setting.is_some()).unwrap();
    assert_eq!(found.message, "the key has too many parts");
}

/// A hundred thousand faults of syntax took a minute to place and are of no use to anybody.
#[test]
fn a_text_that_is_no_toml_has_few_problems() {
    for text in ["\r".repeat(100_000), "=\n".repeat(100_000)] {
        let error = Scene::parse(&text, &[], &BTreeMap::new()).expect_err("no TOML");
        assert_eq!(error.problems.len(), 20);
        assert_eq!(error.problems[0].line, Some(1));
    }
}

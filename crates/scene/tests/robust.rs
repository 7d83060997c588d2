//! Files damaged in every single line: loading never panics, and what is refused has problems to show.

use std::fs;
use std::path::Path;

use vaso_scene::Scene;

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

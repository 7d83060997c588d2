//! Wrong cases, each with the whole message it gets: `tests/bad/NAME.toml` and `NAME.expected`.
//!
//! A case is run as `case.toml` in a folder with the pipe of `cases` and the files of `tests/bad/files`; a first line
//! `# $ vaso ...` asks for another command. With `VASO_BLESS` set the messages are written anew, to be read before they are
//! committed.

use assert_cmd::Command;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/bad")
}

fn cases() -> Vec<PathBuf> {
    let entries = fs::read_dir(folder()).expect("the folder of wrong cases can be read");
    let mut cases: Vec<PathBuf> =
        entries.map(|entry| entry.expect("its entries can be read").path()).collect();
    cases.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    cases.sort();
    cases
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("a folder can be read");
    entries
        .map(|entry| entry.expect("its entries can be read").file_name().to_string_lossy().into_owned())
        .collect()
}

/// The message of a case, without the end of it where there is none.
fn message(case: &Path) -> (Option<i32>, String, bool) {
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    let files = folder().join("files");
    for name in names(&files) {
        fs::copy(files.join(&name), here.path().join(&name)).expect("copied");
    }
    let pipe = folder().join("../../cases/pipe/pipe.stl");
    fs::copy(pipe, here.path().join("pipe.stl")).expect("copied");
    let text = fs::read_to_string(case).expect("a case is UTF-8");
    fs::write(here.path().join("case.toml"), &text).expect("written");
    let before = names(here.path());
    let command = text
        .lines()
        .next()
        .and_then(|line| line.strip_prefix("# $ vaso "))
        .unwrap_or("run case.toml --quiet");
    let output = Command::new(env!("CARGO_BIN_EXE_vaso"))
        .args(command.split_whitespace())
        .current_dir(here.path())
        .output()
        .expect("the program can be started");
    let stderr = String::from_utf8(output.stderr).expect("messages are UTF-8");
    (output.status.code(), stderr, names(here.path()) == before && output.stdout.is_empty())
}

#[test]
fn wrong_cases_get_the_whole_of_their_message_and_write_nothing() {
    let bless = std::env::var_os("VASO_BLESS").is_some();
    let cases = cases();
    assert!(cases.len() >= 90, "only {} wrong cases", cases.len());
    let mut faults = Vec::new();
    for case in cases {
        let name = case.display();
        let (code, text, is_untouched) = message(&case);
        if code != Some(2) {
            faults.push(format!("{name} ended with {code:?}:\n{text}"));
        }
        if !is_untouched {
            faults.push(format!("{name} wrote something"));
        }
        let file = case.with_extension("expected");
        if bless {
            fs::write(&file, &text).expect("written");
        } else if fs::read_to_string(&file).unwrap_or_default() != text {
            faults.push(format!("{name} got another message than in {}:\n{text}", file.display()));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// What no message may lack: the file or flag it is about, and what is allowed or to be done.
#[test]
fn every_message_says_where_and_what_to_do() {
    for case in cases() {
        let file = case.with_extension("expected");
        let text = fs::read_to_string(&file).unwrap_or_default();
        assert!(text.starts_with("error: "), "{}:\n{text}", file.display());
        let place = [".toml", ".stl", ".vtp", ".csv", "--", "'", "no-such-case"];
        assert!(place.iter().any(|word| text.contains(word)), "{} names no place:\n{text}", file.display());
        let words = ["allowed", "advice", "tip:", ";", "--help", "?", "expected"];
        assert!(
            words.iter().any(|word| text.contains(word)),
            "{} says not what to do:\n{text}",
            file.display()
        );
    }
}

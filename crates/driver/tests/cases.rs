//! The shipped cases: each can be planned, and has what a reader looks for.

use assert_cmd::Command;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// Folders of the shipped cases.
fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let entries = std::fs::read_dir(folder).expect("there are cases");
    let mut cases: Vec<PathBuf> = entries
        .map(|entry| entry.expect("entries can be read").path())
        .filter(|path| path.join("case.toml").exists())
        .collect();
    cases.sort();
    assert!(cases.len() >= 9, "only {} cases found", cases.len());
    cases
}

#[test]
fn shipped_cases_can_be_planned() {
    for case in cases() {
        let output = Command::new(env!("CARGO_BIN_EXE_vaso"))
            .arg("check")
            .arg(&case)
            .arg("--json")
            .output()
            .expect("the program can be started");
        assert!(output.status.success(), "{}: {}", case.display(), String::from_utf8_lossy(&output.stderr));
        let answer: Value = serde_json::from_slice(&output.stdout).expect("standard output is JSON");
        let fluid = answer["predicted"]["particles"]["fluid"].as_u64();
        assert!(fluid.is_some_and(|n| (1_000..200_000).contains(&n)), "{}: {fluid:?}", case.display());
        assert_eq!(answer["surface"]["watertight"], true, "{}", case.display());
        assert_eq!(answer["surface"]["repairs"].as_array().map(Vec::len), Some(0), "{}", case.display());
    }
}

/// A README with the question, the source and the result, and surfaces small enough for a repository.
#[test]
fn shipped_cases_say_what_they_are_for() {
    for case in cases() {
        let readme = std::fs::read_to_string(case.join("README.md")).expect("cases have a README");
        for part in ["**Question.**", "**Source.**", "**Result.**"] {
            assert!(readme.contains(part), "{}: no {part}", case.display());
        }
        for entry in std::fs::read_dir(&case).expect("folders can be read") {
            let path = entry.expect("entries can be read").path();
            if path.extension().is_some_and(|extension| extension == "stl") {
                let size = path.metadata().expect("files have a size").len();
                assert!(size < 1_700_000, "{} has {size} bytes", path.display());
            }
        }
    }
}

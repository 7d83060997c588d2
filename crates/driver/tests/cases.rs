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

/// What a plan says, without what differs between machines.
fn plan(case: &Path) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_vaso"))
        .arg("check")
        .arg(case)
        .output()
        .expect("the program can be started");
    assert!(output.status.success(), "{}: {}", case.display(), String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("plans are UTF-8");
    let of_machine = |line: &&str| ["surface ", "plan ", "cost "].iter().any(|head| line.starts_with(head));
    text.lines().filter(|line| !of_machine(line)).map(|line| format!("{line}\n")).collect()
}

/// Which effects a scene gets, why, and with which numbers: each plan is kept in `tests/plans`, and a change of it is there to be read.
/// With `VASO_BLESS` set they are written anew.
#[test]
fn the_plans_of_the_shipped_cases_are_those_that_are_kept() {
    let kept = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/plans");
    let mut faults = Vec::new();
    for case in cases() {
        let name = case.file_name().expect("a folder has a name").to_string_lossy().into_owned();
        let (file, now) = (kept.join(format!("{name}.txt")), plan(&case));
        if std::env::var_os("VASO_BLESS").is_some() {
            std::fs::write(&file, &now).expect("written");
        }
        let before = std::fs::read_to_string(&file).unwrap_or_default();
        let new = now.lines().filter(|line| !before.lines().any(|old| old == *line));
        let new: Vec<&str> = new.collect();
        if before != now {
            faults.push(format!(
                "{name} has another plan than in {}, new are:\n{}",
                file.display(),
                new.join("\n")
            ));
        }
    }
    assert!(faults.is_empty(), "{}\n`just bless` writes them anew", faults.join("\n"));
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

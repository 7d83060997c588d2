//! The JSON Schema of case.toml by an implementation that is not ours: cases that load are valid, and mistakes it can know are not.

use glam::DVec3;
use std::path::{Path, PathBuf};
use std::process::Command;
use vaso_geometry::{shapes, write_stl};
use vaso_tests::{python, root};

/// Wrong cases whose mistake is one of keys, types and words.
const WRONG: &[&str] = &[
    "key-misspelt",
    "key-of-another-condition",
    "key-of-another-generator",
    "key-of-a-condition-missing",
    "table-missing",
    "openings-in-single-brackets",
    "unit-missing",
    "unit-missing-in-the-string",
    "value-out-of-range",
    "count-in-quotes",
    "count-negative",
    "flag-in-quotes",
    "word-misspelt",
    "wall-thickness-missing",
    "name-of-digits",
    "near-of-two-coordinates",
    "condition-missing",
    "output-without-fields",
    "viscosity-law-misspelt",
];

fn cases_in(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("folders of the project can be read");
    let paths = entries.map(|entry| entry.expect("its entries can be read").path());
    paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

#[test]
fn cases_are_valid_by_the_schema_and_mistakes_are_not() {
    let Some(python) = python("jsonschema") else { return };
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    let surface = here.path().join("vessel.stl");
    write_stl(&surface, &shapes::pipe(3.0, 30.0, DVec3::Z, 32)).expect("written");
    let made = vaso_driver::new::new(&here.path().join("case"), &surface, None).expect("a pipe is a vessel");

    let mut right = cases_in(&root().join("crates/scene/tests/good"));
    right.extend(["pipe", "carotid"].map(|case| root().join("cases").join(case).join("case.toml")));
    right.push(made.report.case);
    assert!(right.len() >= 8, "only {} cases", right.len());
    let wrong = WRONG.iter().map(|name| root().join(format!("tests/bad/{name}.toml")));
    let argument = |sign: char| move |path: PathBuf| format!("{sign}{}", path.display());
    let output = Command::new(python)
        .arg(root().join("tests/python/check_case_schema.py"))
        .arg(root().join("docs/case.schema.json"))
        .args(right.into_iter().map(argument('+')))
        .args(wrong.map(argument('-')))
        .output()
        .expect("Python starts");
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{told}{}", String::from_utf8_lossy(&output.stderr));
}

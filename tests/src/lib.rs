//! Tools of the tests that span crates: cases run through the library, and flows compared with formulas.

pub mod accuracy;
#[cfg(test)]
mod flows;
pub mod generators;
pub mod pipe;
pub mod poiseuille;
pub mod shear_thinning;
pub mod stability;
pub mod validation;

use std::path::PathBuf;
use vaso_driver::{Case, Flow, Plan, world};
use vaso_fluid::Real;

/// Does `work` on a worker thread, as the program does: from outside every parallel loop would wake a worker and put the caller to sleep,
/// and the times of small flows would be too long.
///
/// # Panics
/// If there are workers already.
pub fn among_workers<T: Send>(work: impl FnOnce() -> T + Send) -> T {
    // As much stack as the main thread of a program has.
    let workers = rayon::ThreadPoolBuilder::new().stack_size(8 << 20).build_global();
    workers.expect("no workers have been started");
    rayon::scope(|_| work())
}

/// The workspace root.
pub fn root() -> PathBuf {
    let tests = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    tests.parent().map(PathBuf::from).unwrap_or(tests)
}

/// A Python interpreter that has a module: the one named by `VASO_PYTHON`, else the one `.ci/python.sh` makes. Without one says
/// that the test is skipped.
///
/// # Panics
/// When there is none in continuous integration, where these tests must run.
pub fn python(module: &str) -> Option<PathBuf> {
    let python =
        std::env::var_os("VASO_PYTHON").map_or_else(|| root().join(".venv/bin/python"), PathBuf::from);
    let found = std::process::Command::new(&python).args(["-c", &format!("import {module}")]).output();
    if found.is_ok_and(|output| output.status.success()) {
        return Some(python);
    }
    let reason = format!("{} has no {module}: run `.ci/python.sh` or set VASO_PYTHON", python.display());
    assert!(std::env::var("CI").as_deref() != Ok("true"), "{reason}");
    println!("skipped: {reason}");
    None
}

/// The folder of outside data, where there is one; else says that the test is skipped.
///
/// # Panics
/// When there is none in continuous integration, where these tests must run.
pub fn data() -> Option<PathBuf> {
    match std::env::var_os("VASO_DATA") {
        Some(folder) => Some(PathBuf::from(folder)),
        None => {
            assert!(std::env::var_os("CI").is_none(), "VASO_DATA is not set, but CI is");
            println!("skipped: VASO_DATA is not set");
            None
        }
    }
}

/// Folder of particles that cases without one of their own share.
pub fn cache() -> PathBuf {
    root().join("tests/.vaso-cache")
}

/// A flow of `case` from rest, with the particles made anew or taken from the cache.
///
/// # Panics
/// When the case is wrong: these are the project's own.
pub fn flow<R: Real>(case: &Case) -> (Flow<R>, Plan) {
    let plan = Plan::new(case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = world::Bodies::make(case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let flow = world::build_flow(case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));
    (flow, plan)
}

/// A case of the folder `cases` with overrides.
///
/// # Panics
/// When the case is wrong.
pub fn case(name: &str, overrides: &[(&str, &str)]) -> Case {
    let set: Vec<(String, String)> = overrides.iter().map(|(k, v)| ((*k).into(), (*v).into())).collect();
    Case::load(&root().join("cases").join(name), &set).unwrap_or_else(|e| panic!("{e}"))
}

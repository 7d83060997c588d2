//! `case.toml` to a scene, in memory.

use std::collections::BTreeMap;
use std::path::PathBuf;

use vaso_scene::Scene;

/// Tables a case of the corpus may name.
const TABLES: [(&str, &str); 2] = [
    ("rise.csv", "time,flow\n0,0\n0.5,1\n"),
    ("beat.csv", "time [ms];velocity (cm/s)\n0;1\n400;30\n800;1\n"),
];

/// Reads a text as a case.
///
/// Comments of two kinds say what is not part of a case file, so that the text remains one: `#set KEY=VALUE` is an
/// override, and what follows the line `#file` is the table `own.csv`.
pub fn case(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let (text, table) = text.split_once("\n#file\n").unwrap_or((text, ""));
    let mut files: BTreeMap<PathBuf, String> =
        TABLES.iter().map(|&(name, table)| (name.into(), table.to_owned())).collect();
    files.insert("pipe.stl".into(), String::new());
    files.insert("own.csv".into(), table.to_owned());
    let overrides: Vec<(String, String)> = text
        .lines()
        .filter_map(|line| line.strip_prefix("#set ")?.split_once('='))
        .map(|(key, value)| (key.to_owned(), value.to_owned()))
        .collect();
    match Scene::parse(text, &overrides, &files) {
        Ok(scene) => {
            assert!(scene.particles.spacing > 0.0 && scene.particles.spacing.is_finite());
            assert!(scene.run.end_time > 0.0 && scene.run.end_time.is_finite());
            assert!(!scene.problem("run", "any").to_string().is_empty());
        }
        Err(error) => {
            assert!(!error.problems.is_empty());
            assert!(error.problems.iter().all(|problem| !problem.message.is_empty()));
            assert!(!error.to_string().is_empty());
        }
    }
}

//! The rules of the house that a compiler does not check: who may depend on whom, where things may happen, and how long
//! a file may be.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

/// Which crates of ours a crate may use. An arrow more is a decision, to be seen as a change of this table.
const MAY_USE: &[(&str, &[&str])] = &[
    ("units", &[]),
    ("geometry", &[]),
    ("particles", &[]),
    ("kernels", &[]),
    ("study", &[]),
    ("scene", &["units"]),
    ("generation", &["geometry", "kernels", "particles"]),
    ("fluid", &["kernels", "particles"]),
    ("shell", &["kernels", "particles"]),
    ("solid", &["kernels", "particles"]),
    ("metrics", &["geometry", "kernels", "particles"]),
    ("io", &["particles"]),
    ("boundary", &["fluid", "geometry", "particles"]),
    ("coupling", &["fluid", "kernels", "particles", "shell", "solid"]),
    ("report", &["io"]),
    (
        "driver",
        &[
            "units",
            "geometry",
            "particles",
            "kernels",
            "scene",
            "generation",
            "fluid",
            "io",
            "boundary",
            "coupling",
            "solid",
            "shell",
            "metrics",
            "report",
            "study",
        ],
    ),
];

/// Dependencies that one crate keeps to itself, so that the rest does not know the format or library behind it.
const KEPT_BY: &[(&str, &str)] = &[
    ("toml", "scene"),
    ("rust-hdf5", "io"),
    ("hdf5-metno", "io"),
    ("parry3d-f64", "geometry"),
    ("stl_io", "geometry"),
    ("roxmltree", "geometry"),
    ("clap", "driver"),
    ("clap_complete", "driver"),
    ("clap_mangen", "driver"),
    ("indicatif", "driver"),
    ("ctrlc", "driver"),
];

/// What only the driver may do: speak, end the program, ask the environment, look at the clock.
const ONLY_IN_DRIVER: &[&str] = &[
    "println!",
    "eprintln!",
    "print!(",
    "eprint!(",
    "process::exit",
    "env::var",
    "Instant::now",
    "SystemTime::now",
];

const LONGEST_FILE: usize = 500;
const LONG_FILE: usize = 400;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("this crate lies in the workspace").to_owned()
}

/// Normal dependencies of every package, by package name.
fn dependencies() -> BTreeMap<String, BTreeSet<String>> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--format-version", "1", "--offline"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo metadata prints JSON");
    let text = |value: &Value| value.as_str().expect("names are strings").to_owned();
    let packages = metadata["packages"].as_array().expect("packages are listed");
    packages
        .iter()
        .map(|package| {
            let all = package["dependencies"].as_array().expect("dependencies are listed");
            let normal = all.iter().filter(|dependency| dependency["kind"].is_null());
            (text(&package["name"]), normal.map(|dependency| text(&dependency["name"])).collect())
        })
        .collect()
}

/// Files of the project as they would be committed, in order.
fn files() -> Vec<PathBuf> {
    fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("folders of the project can be read") {
            let path = entry.expect("entries of the project can be read").path();
            let name = path.file_name().expect("entries have names").to_string_lossy().into_owned();
            if name.starts_with('.') || ["target", "out"].contains(&name.as_str()) {
                continue;
            }
            if path.is_dir() { collect(&path, files) } else { files.push(path) }
        }
    }
    let mut files = Vec::new();
    collect(&root(), &mut files);
    files.sort();
    assert!(files.len() > 100, "only {} files found", files.len());
    files
}

/// Rust sources with their path from the root.
fn sources() -> Vec<(String, String)> {
    files()
        .into_iter()
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .map(|path| {
            let text = fs::read_to_string(&path).expect("sources are UTF-8");
            (from_root(&path), text)
        })
        .collect()
}

fn from_root(path: &Path) -> String {
    path.strip_prefix(root()).expect("files lie below the root").to_string_lossy().replace('\\', "/")
}

/// The code of a line, without a comment at its end.
fn code(line: &str) -> &str {
    line.split_once("//").map_or(line, |(code, _)| code)
}

/// Whether a word stands in the code, not as a part of a longer one.
fn has_word(code: &str, word: &str) -> bool {
    let part_of_word = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(word).any(|(at, _)| {
        !code[..at].ends_with(part_of_word) && !code[at + word.len()..].starts_with(part_of_word)
    })
}

fn assert_none(faults: &[String]) {
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

#[test]
fn crates_use_only_those_below_them() {
    let found: BTreeMap<String, BTreeSet<String>> = dependencies()
        .into_iter()
        .filter_map(|(package, dependencies)| {
            let crates = root().join("crates").join(package.strip_prefix("vaso-")?);
            let ours = dependencies.iter().filter_map(|name| name.strip_prefix("vaso-")).map(str::to_owned);
            crates.is_dir().then(|| (package["vaso-".len()..].to_owned(), ours.collect()))
        })
        .collect();
    let allowed: BTreeMap<&str, &[&str]> = MAY_USE.iter().copied().collect();
    let mut faults = Vec::new();
    for (name, used) in &found {
        match allowed.get(name.as_str()) {
            None => faults.push(format!("`{name}` has no row in the table of layers")),
            Some(allowed) => {
                let excess = used.iter().filter(|other| !allowed.contains(&other.as_str()));
                faults.extend(excess.map(|other| format!("`{name}` must not use `{other}`")));
            }
        }
    }
    let missing = allowed.keys().filter(|name| !found.contains_key(**name));
    faults.extend(missing.map(|name| format!("`{name}` of the table of layers does not exist")));
    assert_none(&faults);
}

#[test]
fn formats_and_libraries_stay_in_one_crate() {
    let mut faults = Vec::new();
    let dependencies = dependencies();
    for (library, keeper) in KEPT_BY {
        let users =
            dependencies.iter().filter(|(_, used)| used.contains(*library)).map(|(package, _)| package);
        let others = users.filter(|package| **package != format!("vaso-{keeper}"));
        faults
            .extend(others.map(|package| format!("only `vaso-{keeper}` may use {library}, not `{package}`")));
    }
    assert_none(&faults);
}

#[test]
fn every_readme_is_tested_documentation() {
    let mut faults = Vec::new();
    for (name, _) in MAY_USE {
        let folder = root().join("crates").join(name);
        let readme = fs::read_to_string(folder.join("README.md")).unwrap_or_default();
        if !readme.contains("\n```") {
            faults.push(format!("crates/{name}/README.md has no example"));
        }
        let library = ["src/lib.rs", "src/main.rs"].map(|file| fs::read_to_string(folder.join(file)));
        let library = library.into_iter().find_map(Result::ok).unwrap_or_default();
        if !library.contains("#![doc = include_str!(\"../README.md\")]") {
            faults.push(format!("crates/{name} does not include its README as documentation"));
        }
    }
    assert_none(&faults);
}

#[test]
fn no_source_file_is_too_long() {
    let mut faults = Vec::new();
    for (path, text) in sources() {
        let lines = text.lines().count();
        if lines > LONGEST_FILE {
            faults.push(format!("{path} has {lines} lines, more than {LONGEST_FILE}"));
        } else if lines > LONG_FILE {
            println!("{path} has {lines} lines");
        }
    }
    assert_none(&faults);
}

#[test]
fn code_that_is_not_checked_for_memory_safety_stays_in_the_kernels() {
    let word = concat!("un", "safe");
    let mut faults = Vec::new();
    let mut in_kernels = 0;
    for (path, text) in sources() {
        for (number, line) in text.lines().enumerate().filter(|(_, line)| has_word(code(line), word)) {
            if path.starts_with("crates/kernels/src/") {
                in_kernels += 1;
            } else {
                faults.push(format!("{path}:{}: {}", number + 1, line.trim()));
            }
        }
    }
    assert!(in_kernels > 0, "the search finds nothing even where something is");
    assert_none(&faults);
}

#[test]
fn libraries_neither_speak_nor_look_around() {
    let mut faults = Vec::new();
    for (path, text) in sources() {
        let library =
            path.starts_with("crates/") && path.contains("/src/") && !path.starts_with("crates/driver/");
        if !library || path.ends_with("/tests.rs") || path.contains("/src/tests/") {
            continue;
        }
        let shipped = text.split_once("#[cfg(test)]\nmod ").map_or(text.as_str(), |(shipped, _)| shipped);
        for (number, line) in shipped.lines().enumerate() {
            if let Some(call) = ONLY_IN_DRIVER.iter().find(|call| code(line).contains(**call)) {
                faults.push(format!("{path}:{}: {call} belongs in the driver", number + 1));
            }
        }
    }
    assert_none(&faults);
}

#[test]
fn nothing_knows_the_machine_it_was_written_on() {
    let folders = ["home", "root", "Users", "work", "tmp"].map(|name| format!("/{name}/"));
    let mut faults = Vec::new();
    for path in files() {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        for (number, line) in text.lines().enumerate() {
            let absolute = |folder: &String| {
                let part_of_path = |c: char| c.is_alphanumeric() || "._-~$})".contains(c);
                line.match_indices(folder.as_str()).any(|(at, _)| !line[..at].ends_with(part_of_path))
            };
            if folders.iter().any(absolute) {
                faults.push(format!("{}:{}: {}", from_root(&path), number + 1, line.trim()));
            }
        }
    }
    assert_none(&faults);
}

/// A merge that was not finished leaves marks that no compiler sees in documents and recipes.
#[test]
fn no_merge_is_left_half_done() {
    let marks = ["<", ">"].map(|mark| mark.repeat(7) + " ");
    let mut faults = Vec::new();
    for path in files() {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        for (number, line) in text.lines().enumerate() {
            if marks.iter().any(|mark| line.starts_with(mark.as_str())) {
                faults.push(format!("{}:{}: {}", from_root(&path), number + 1, line));
            }
        }
    }
    assert_none(&faults);
}

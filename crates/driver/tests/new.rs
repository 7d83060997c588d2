//! `vaso new`: what it writes runs as it is, what it cannot know it asks, and what is there it leaves alone.

use assert_cmd::Command;
use glam::DVec3;
use serde_json::Value;
use std::path::{Path, PathBuf};
use vaso_geometry::{Surface, shapes, write_stl};

fn vaso() -> Command {
    Command::new(env!("CARGO_BIN_EXE_vaso"))
}

/// Runs a command that must succeed, and takes what it prints as JSON.
fn json(command: &mut Command) -> Value {
    let output = command.output().expect("the program can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("standard output is JSON and nothing else")
}

/// Runs a command that must refuse its input, and gives its message.
fn refused(command: &mut Command) -> String {
    let output = command.output().expect("the program can be started");
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{text}");
    text
}

/// A pipe of a radius and ten times that length, in whatever unit.
fn pipe(radius: f64) -> Surface {
    shapes::pipe(radius, 10.0 * radius, DVec3::new(1.0, 2.0, 2.0).normalize(), 32)
}

fn write(folder: &Path, surface: &Surface) -> PathBuf {
    let file = folder.join("vessel.stl");
    write_stl(&file, surface).expect("written");
    file
}

/// Ten milliseconds at a coarse spacing, without the fields that need a whole beat.
fn begins_to_run(case: &Path, spacing: &str) {
    let spacing = format!("particles.spacing={spacing}");
    let mut run = vaso();
    run.arg("run").arg(case).args([
        "--json",
        "--quiet",
        "--set",
        &spacing,
        "--set",
        "output.fields=[\"wss\"]",
    ]);
    let summary = json(run.args(["--set", "run={ end_time = \"10 ms\", period = \"0.9 s\" }"]));
    assert_eq!(summary["status"], "completed", "{}", case.display());
    assert_eq!(summary["stability"]["escaped_particles"], 0, "{}", case.display());
}

#[test]
fn a_new_case_is_checked_and_begins_to_run() {
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    let file = write(here.path(), &pipe(3.0));
    let case = here.path().join("deep/case");
    let answer = json(vaso().arg("new").arg(&case).arg("--surface").arg(&file).arg("--json"));
    assert_eq!((&answer["unit"], &answer["unit_guessed"]), (&"mm".into(), &true.into()));
    assert_eq!(answer["inlet"], "inlet");
    // A first run takes minutes: no more than five on two cores.
    let across = answer["particles_across"].as_f64().expect("a number");
    assert!((6.0..21.0).contains(&across), "{across}");
    for name in ["case.toml", "vessel.stl", "inflow.csv", "openings.svg", "case.schema.json"] {
        assert!(case.join(name).is_file(), "{name} is missing");
    }
    assert_eq!(std::fs::read(case.join("vessel.stl")).expect("read"), std::fs::read(&file).expect("read"));
    let drawing = std::fs::read_to_string(case.join("openings.svg")).expect("read");
    assert!(drawing.contains("inlet (") && drawing.contains("outlet-1 ("));
    let checked = json(vaso().arg("check").arg(&case).arg("--json"));
    assert_eq!(checked["numbers"], answer["check"]["numbers"]);
    let names: Vec<&Value> =
        checked["openings"].as_array().expect("a list").iter().map(|o| &o["name"]).collect();
    assert_eq!(names, ["inlet", "outlet-1"]);
    begins_to_run(&case, "0.9 mm");

    let text = refused(vaso().arg("new").arg(&case).arg("--surface").arg(&file));
    assert!(text.contains("there is a case.toml in this folder already"), "{text}");
}

#[test]
fn what_it_says_and_writes_names_the_guesses() {
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    let file = write(here.path(), &pipe(3e-3));
    let case = here.path().join("case");
    let output = vaso().arg("new").arg(&case).arg("--surface").arg(&file).output().expect("starts");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        output.status.success() && output.stderr.is_empty(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    for words in [
        "\"m\", guessed: in m its largest opening has a radius of 2.99 mm",
        "in um",
        "assumed",
        "ml/s",
        "vaso run",
    ] {
        assert!(said.contains(words), "{words}: {said}");
    }
    let written = std::fs::read_to_string(case.join("case.toml")).expect("written");
    assert!(written.starts_with("#:schema ./case.schema.json\n"), "{written}");
    assert!(written.matches("ASSUMED").count() >= 4, "{written}");
    let silent = here.path().join("silent");
    let output =
        vaso().arg("new").arg(&silent).arg("--surface").arg(&file).arg("--quiet").output().expect("starts");
    assert!(output.status.success() && output.stdout.is_empty() && output.stderr.is_empty());
}

#[test]
fn open_ends_are_openings_too() {
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    let capped = shapes::pipe(4.0, 30.0, DVec3::Z, 32);
    let is_cap = |t: &[u32; 3]| {
        let z = t.map(|k| capped.vertices[k as usize].z);
        (z[0] - z[1]).abs() < 1e-9 && (z[0] - z[2]).abs() < 1e-9
    };
    let triangles = capped.triangles.iter().filter(|t| !is_cap(t)).copied().collect();
    let file = write(here.path(), &Surface { triangles, vertices: capped.vertices.clone() });
    let case = here.path().join("case");
    let answer = json(vaso().arg("new").arg(&case).arg("--surface").arg(&file).arg("--json"));
    let repairs = &answer["check"]["surface"]["repairs"];
    assert!(repairs.as_array().is_some_and(|r| !r.is_empty()), "{repairs}");
    begins_to_run(&case, "1.2 mm");
}

#[test]
fn a_unit_in_doubt_is_guessed_with_a_warning() {
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    // An aorta in centimetres, or a coronary artery in millimetres.
    let file = write(here.path(), &pipe(1.4));
    let case = here.path().join("case");
    let text = refused(vaso().arg("new").arg(&case).arg("--surface").arg(&file).args(["--unit", "inch"]));
    assert!(text.contains("inch") && !case.exists(), "{text}");
    let answer = json(vaso().arg("new").arg(&case).arg("--surface").arg(&file).arg("--json"));
    assert_eq!((&answer["unit"], &answer["unit_guessed"]), (&"cm".into(), &true.into()));
    let reason = answer["unit_reason"].as_str().expect("a reason");
    assert!(reason.contains("IN DOUBT, in mm"), "{reason}");
    let other = here.path().join("other");
    let answer =
        json(vaso().arg("new").arg(&other).arg("--surface").arg(&file).args(["--unit", "mm", "--json"]));
    assert_eq!((&answer["unit"], &answer["unit_guessed"]), (&"mm".into(), &false.into()));
}

#[test]
fn what_is_no_vessel_is_refused_and_what_is_there_stays() {
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    let bad = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/bad/files");
    let case = here.path().join("case");
    for (file, words) in [
        ("tetrahedron.stl", "openings found, blood needs at least 2"),
        ("flat.stl", "encloses no volume"),
        ("text.stl", "neither STL nor VTP"),
        ("no-such.stl", "cannot read surface"),
    ] {
        let text = refused(vaso().arg("new").arg(&case).arg("--surface").arg(bad.join(file)));
        assert!(text.contains(words) && text.contains(file), "{text}");
        assert!(!case.exists(), "{file} left something");
    }
    let file = write(here.path(), &pipe(3.0));
    let taken = here.path().join("taken");
    std::fs::create_dir(&taken).expect("made");
    std::fs::write(taken.join("notes.txt"), "mine").expect("written");
    for (folder, words) in [(&taken, "the folder is not empty"), (&file, "no folder that can be read")] {
        let text = refused(vaso().arg("new").arg(folder).arg("--surface").arg(&file));
        assert!(text.contains(words), "{text}");
    }
    assert_eq!(std::fs::read_dir(&taken).expect("read").count(), 1);
    std::fs::remove_file(taken.join("notes.txt")).expect("removed");
    assert!(
        vaso().arg("new").arg(&taken).arg("--surface").arg(&file).output().expect("starts").status.success()
    );
}

/// Every sound surface of the outside data becomes a case that is planned; those of persons begin to run.
#[test]
fn outside_surfaces_become_cases() {
    let Some(data) = std::env::var_os("VASO_DATA").map(|data| PathBuf::from(data).join("geometry")) else {
        assert!(std::env::var_os("CI").is_none(), "VASO_DATA is not set, but CI is");
        println!("skipped: VASO_DATA is not set");
        return;
    };
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    let surfaces = [
        ("carotid_bifurcation/carotid_lumen.stl", "mm", Some("0.8 mm")),
        ("carotid_bifurcation/carotid_lumen_m.vtp", "m", None),
        ("aorta_arch_vmr0024/aorta_lumen.stl", "cm", Some("2 mm")),
        ("synthetic/carotid_open.stl", "mm", Some("0.9 mm")),
        ("synthetic/carotid_dirty.stl", "mm", None),
        ("synthetic/curved_tube_180.stl", "mm", None),
        ("synthetic/stenosis_75.stl", "mm", None),
        ("synthetic/straight_tube_ascii.vtp", "mm", None),
        ("synthetic/straight_tube_coarse.stl", "mm", None),
        ("synthetic/t_junction.stl", "mm", None),
        ("defects/05_all_caps_open.stl", "mm", None),
        ("defects/13_metres.stl", "m", None),
    ];
    for (k, (file, unit, spacing)) in surfaces.into_iter().enumerate() {
        let case = here.path().join(format!("case-{k}"));
        let answer = json(vaso().arg("new").arg(&case).arg("--surface").arg(data.join(file)).arg("--json"));
        assert_eq!(answer["unit"], unit, "{file}");
        let seconds = answer["check"]["predicted"]["wall_clock_s"].as_f64().expect("a number");
        println!("{file}: {} mm, {seconds:.0} s", 1e3 * answer["spacing_m"].as_f64().expect("a number"));
        if let Some(spacing) = spacing {
            begins_to_run(&case, spacing);
        } else {
            json(vaso().arg("check").arg(&case).arg("--json"));
        }
    }
}

//! The program at the terminal: answers, exit codes, what is written and what is not.

use assert_cmd::Command;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn vaso() -> Command {
    Command::new(env!("CARGO_BIN_EXE_vaso"))
}

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The folder of outside data; without it the test is skipped, but not in continuous integration.
fn data() -> Option<PathBuf> {
    let folder = std::env::var_os("VASO_DATA").map(PathBuf::from);
    if folder.is_none() {
        assert!(std::env::var_os("CI").is_none(), "VASO_DATA is not set, but CI is");
        println!("skipped: VASO_DATA is not set");
    }
    folder
}

fn json(command: &mut Command) -> Value {
    let output = command.output().expect("the program can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("standard output is JSON and nothing else")
}

/// A copy of the pipe case in a folder of its own.
fn pipe(folder: &Path) {
    for file in ["case.toml", "pipe.stl"] {
        std::fs::copy(root().join("cases/pipe").join(file), folder.join(file)).expect("cases can be copied");
    }
}

fn coarse(folder: &Path, command: &str) -> Command {
    let mut vaso = vaso();
    vaso.arg(command).arg(folder).args(["--set", "particles.spacing=0.8 mm", "--set", "run.end_time=20 ms"]);
    vaso
}

#[test]
fn check_answers_in_json() {
    let answer = json(vaso().arg("check").arg(root().join("cases/carotid")).arg("--json"));
    assert_eq!(answer["openings"].as_array().map(Vec::len), Some(3));
    assert!(answer["predicted"]["particles"]["fluid"].as_u64().is_some_and(|n| n > 10_000));
    assert!(answer["numbers"]["sound_speed_m_s"].as_f64().is_some_and(|c| c > 1.0));
    assert!(answer["effects"].as_array().is_some_and(|e| e.iter().any(|e| e["on"] == false)));
}

/// What every flow calls for can be left out, and `check` says what that costs.
#[test]
fn check_says_what_is_left_out_and_called_for() {
    let check = |settings: &[&str]| {
        let mut command = vaso();
        command.arg("check").arg(root().join("cases/carotid")).arg("--json");
        settings.iter().for_each(|setting| {
            command.args(["--set", setting]);
        });
        json(&mut command)
    };
    let state = |answer: &Value, name: &str| {
        let effects = answer["effects"].as_array().expect("effects are listed");
        let effect = effects.iter().find(|e| e["name"] == name).expect("it is one of them");
        (effect["on"] == true, effect["called_for"] == true)
    };
    let names = ["blood.density_blend", "blood.gradient_correction", "blood.transport_velocity"];
    let without = check(&[
        "numerics.density_blend=0",
        "numerics.gradient_correction=false",
        "numerics.transport_velocity=false",
    ]);
    let with = check(&[]);
    for name in names {
        assert_eq!((state(&with, name), state(&without, name)), ((true, true), (false, true)), "{name}");
        let said = format!("`{name}` is off");
        assert!(without["warnings"].to_string().contains(&said), "{}", without["warnings"]);
        assert!(!with["warnings"].to_string().contains(&said));
    }
}

#[test]
fn check_reads_bare_surfaces() {
    let Some(data) = data() else { return };
    let file = data.join("geometry/aorta_arch_vmr0024/aorta_lumen.stl");
    let answer = json(vaso().arg("check").arg(file).args(["--unit", "cm", "--json"]));
    assert_eq!(answer["openings"].as_array().map(Vec::len), Some(6));
    let volume = answer["surface"]["volume_m3"].as_f64().unwrap_or(f64::NAN);
    assert!((volume - 65.10e-6).abs() < 0.01e-6, "{volume}");
}

/// Every file of the set of defects does what its README expects.
#[test]
fn defects_are_mended_or_refused() {
    let Some(data) = data() else { return };
    let folder = data.join("geometry/defects");
    let accepted = [
        "00_base",
        "01_reversed_normals",
        "02_mixed_winding",
        "04_open_inlet",
        "05_all_caps_open",
        "06_duplicate_triangles",
        "07_zero_area_slivers",
        "08_floating_component",
        "13_metres",
        "18_binary_starting_with_solid",
    ];
    for name in accepted {
        let unit = if name == "13_metres" { "m" } else { "mm" };
        let file = folder.join(format!("{name}.stl"));
        let answer = json(vaso().arg("check").arg(file).args(["--unit", unit, "--json"]));
        let volume = answer["surface"]["volume_m3"].as_f64().unwrap_or(f64::NAN);
        assert!((volume / 1865.3e-9 - 1.0).abs() < 1e-3, "{name}: {volume}");
        assert_eq!(answer["openings"].as_array().map(Vec::len), Some(3), "{name}");
        let told = answer["surface"]["repairs"].as_array().map_or(0, Vec::len);
        let clean = ["00_base", "13_metres", "18_binary_starting_with_solid"].contains(&name);
        assert_eq!(told == 0, clean, "{name}: {}", answer["surface"]["repairs"]);
    }
    for (name, word) in [("19_truncated", "length"), ("20_empty", "triangle")] {
        let output = vaso().arg("check").arg(folder.join(format!("{name}.stl"))).output().expect("starts");
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{name}: {text}");
        assert!(text.contains(name) && text.contains(word), "{name}: {text}");
    }
}

#[test]
fn a_run_leaves_all_its_files_and_guards_them() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    pipe(folder.path());
    let summary = json(coarse(folder.path(), "run").arg("--json"));
    assert_eq!(summary["status"], "completed");
    assert_eq!(summary["stability"]["escaped_particles"], 0);
    let out = folder.path().join("out");
    for file in ["fluid.vtkhdf", "openings.csv", "summary.json", "report.html"] {
        assert!(out.join(file).metadata().is_ok_and(|m| m.len() > 0), "{file} is missing");
    }
    let table = vaso_io::read_table(&out.join("openings.csv")).expect("the table can be read");
    assert_eq!(table.header[0], "time_s");
    assert!(table.column("inlet.flow_m3_s").is_some() && table.column("outlet.pressure_pa").is_some());
    let before = std::fs::read(out.join("summary.json")).expect("summary");
    let again = coarse(folder.path(), "run").arg("--quiet").output().expect("starts");
    assert_eq!(again.status.code(), Some(2), "a finished folder is not written over");
    assert_eq!(std::fs::read(out.join("summary.json")).expect("summary"), before);
    assert!(coarse(folder.path(), "run").args(["--quiet", "--force"]).status_ok());
}

trait StatusOk {
    fn status_ok(&mut self) -> bool;
}

impl StatusOk for Command {
    fn status_ok(&mut self) -> bool {
        self.output().is_ok_and(|o| o.status.success())
    }
}

#[test]
fn wrong_input_ends_with_two_and_writes_nothing() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    pipe(folder.path());
    for (set, word) in [
        ("particles.spacing=8 mm", "spacing"),
        ("particles.spacing=-1 mm", "spacing"),
        ("blood.viscosity=3.5", "viscosity"),
        ("wall.model=shell", "wall"),
        ("wall.open_ends=boxes", "wall.open_ends"),
        ("wall.thickness=0.5 mm", "wall.thickness"),
        ("opening.outlet.condition=windkessel", "outlet"),
        ("opening.inlet.near=[100.0, 0.0, 0.0]", "near"),
        ("nonsense.key=1", "nonsense"),
    ] {
        let output = vaso().arg("run").arg(folder.path()).args(["--set", set]).output().expect("starts");
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{set}: {text}");
        assert!(text.contains(word), "{set}: {text}");
        assert!(!folder.path().join("out").exists(), "{set} wrote something");
    }
    let output = vaso().args(["run", "no-such-case"]).output().expect("starts");
    assert_eq!(output.status.code(), Some(2));
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_says_so_and_leaves_a_checkpoint() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    pipe(folder.path());
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_vaso"))
        .arg("run")
        .arg(folder.path())
        .args(["--quiet", "--set", "particles.spacing=0.8 mm", "--set", "run.end_time=100 s"])
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("starts");
    let out = folder.path().join("out");
    // The table appears with the first rows, when the flow runs.
    let started = std::time::Instant::now();
    while !out.join("openings.csv").exists() {
        assert!(started.elapsed().as_secs() < 120, "the run does not start");
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    let kill = std::process::Command::new("kill").arg("-INT").arg(child.id().to_string()).status();
    assert!(kill.is_ok_and(|s| s.success()));
    assert_eq!(child.wait().expect("ends").code(), Some(130));
    assert!(out.join("checkpoint.h5").exists() && out.join("report.html").exists());
    let summary: Value =
        serde_json::from_slice(&std::fs::read(out.join("summary.json")).expect("summary")).expect("JSON");
    assert_eq!(summary["status"], "interrupted");
}

/// A pulse of 5 mL/s in the mean into one outlet: what is printed is a case again, and reaches the pressures asked for.
#[test]
fn tuned_outlets_can_be_pasted() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    pipe(folder.path());
    let rows: Vec<String> = (0..=20)
        .map(|k| {
            let t = 0.04 * f64::from(k);
            format!("{t},{}", 0.16 + 0.12 * (std::f64::consts::TAU * t / 0.8).sin())
        })
        .collect();
    std::fs::write(folder.path().join("in.csv"), format!("t_s,u_m_s\n{}\n", rows.join("\n")))
        .expect("written");
    let text = std::fs::read_to_string(folder.path().join("case.toml")).expect("copied");
    let pulsing = text
        .replace("value = \"53.99325 mm/s\"       # Re mu / (rho D)", "waveform = \"in.csv\"")
        .replace("end_time = \"1.2 s\"", "period = \"0.8 s\"\ncycles = 1");
    assert_ne!(pulsing, text);
    std::fs::write(folder.path().join("case.toml"), &pulsing).expect("written");
    let tuned = vaso()
        .arg("tune")
        .arg(folder.path())
        .args(["--systolic", "120 mmHg", "--diastolic", "80 mmHg"])
        .output()
        .expect("starts");
    let block = String::from_utf8_lossy(&tuned.stdout).into_owned();
    assert!(tuned.status.success(), "{}", String::from_utf8_lossy(&tuned.stderr));
    assert!(block.contains("100.0 % of the flow, 120.0/80.0 mmHg"), "{block}");
    let start = pulsing.find("[[opening]]\nname = \"outlet\"").expect("the outlet is there");
    let end = pulsing.find("[run]").expect("the run is there");
    let pasted = format!("{}{block}\n{}", &pulsing[..start], &pulsing[end..]);
    std::fs::write(folder.path().join("case.toml"), pasted).expect("written");
    let answer = json(vaso().arg("check").arg(folder.path()).arg("--json"));
    let effects = answer["effects"].as_array().expect("a list");
    assert!(effects.iter().any(|e| e["name"] == "opening.windkessel" && e["on"] == true), "{answer}");

    let steady = vaso()
        .arg("tune")
        .arg(root().join("cases/pipe"))
        .args(["--systolic", "120 mmHg", "--diastolic", "130 mmHg"])
        .output()
        .expect("starts");
    assert_eq!(steady.status.code(), Some(2));
}

/// A run that has to stop says where in it, what is left, and what to change; its files stay, and the exit code is 1.
#[test]
fn a_run_that_breaks_down_says_all_that_is_known() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    pipe(folder.path());
    let out = folder.path().join("out");
    let mut vaso = coarse(folder.path(), "run");
    // So slow a sound that the inflow has a Mach number of a half.
    vaso.args(["--set", "numerics.sound_speed=0.2 m/s", "--set", "opening.inlet.ramp=10 ms"]);
    vaso.args(["--set", "output.every=1 ms", "--quiet", "--out"]).arg(&out);
    let output = vaso.output().expect("the program can be started");
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{text}");
    let words = [
        "particle",
        " m moves at ",
        "stage `guard` of step ",
        " s\n",
        "last good snapshot: ",
        "fluid.vtkhdf at 0.0",
        "failure.vtkhdf",
    ];
    for word in words.iter().chain(&["to change: raise `numerics.sound_speed`"]) {
        assert!(text.contains(word), "\"{word}\" is not in {text}");
    }
    for file in ["failure.vtkhdf", "fluid.vtkhdf", "checkpoint.h5", "report.html"] {
        assert!(out.join(file).is_file(), "{file} is not there");
    }
    let summary = std::fs::read(out.join("summary.json")).expect("a run leaves a summary");
    let summary: Value = serde_json::from_slice(&summary).expect("it is JSON");
    assert_eq!(summary["status"], "failed");
    assert!(summary["message"].as_str().is_some_and(|m| m.contains("to change: ")), "{summary}");
}

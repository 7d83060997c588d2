//! `vaso study` on a small pipe: what is run, what is written, what is refused.

use glam::DVec3;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use vaso_geometry::{shapes, write_stl};
use vaso_io::{StudyReport, StudyStatus};

const CASE: &str = r#"
[geometry]
surface = "pipe.stl"
unit = "mm"
[particles]
spacing = "0.9 mm"
[blood]
[[opening]]
name = "inlet"
near = [0, 0, 0]
condition = "velocity"
value = "5 cm/s"
ramp = "2 ms"
[[opening]]
name = "outlet"
near = [0, 0, 24]
condition = "pressure"
[[probe]]
name = "axis"
at = [0, 0, 12]
[run]
end_time = "8 ms"
[output]
table_every = "1 ms"
"#;

/// A flow that has just begun: its mean is that of a solid body pushed by the inlet, which is what the case says and no more.
const EXPECT: &str = "[[expect]]\nname = \"speed\"\nof = \"speed\"\nprobe = \"axis\"\nvalue = \"5 cm/s\"\n\
                      [[expect]]\nname = \"outflow\"\nof = \"flow\"\nopening = \"outlet\"\nvalue = \"1.4137 ml/s\"\n";

fn case(folder: &Path) {
    write_stl(&folder.join("pipe.stl"), &shapes::pipe(3.0, 24.0, DVec3::Z, 32)).expect("written");
    fs::write(folder.join("case.toml"), CASE).expect("written");
}

fn study(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_vaso"))
        .arg("study")
        .arg(folder)
        .arg("--out")
        .arg(folder.join("study"))
        .args(arguments)
        .output()
        .expect("the program can be started")
}

fn report(folder: &Path) -> StudyReport {
    StudyReport::read(&folder.join("study/study.json")).expect("a study leaves its JSON")
}

/// The report of a run between two rungs says how far off it is, and not so once the case is another.
fn run_knows_its_study(folder: &Path) {
    let page = |settings: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vaso"));
        command.arg("run").arg(folder).arg("--force");
        settings.iter().for_each(|s| {
            command.args(["--set", s]);
        });
        let output = command.output().expect("the program can be started");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        fs::read_to_string(folder.join("out/report.html")).expect("a run leaves its page")
    };
    let same = page(&["particles.spacing=1.1 mm"]);
    assert!(same.contains("How far off") && same.contains("Errors expected at a spacing of 1.1 mm"));
    let other = page(&["particles.spacing=1.1 mm", "blood.viscosity=4 mPa s"]);
    assert!(other.contains("tells nothing of it: <code>blood</code> of the case said something else"));
}

#[test]
fn a_study_runs_its_ladders_and_tells_errors_and_prices() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    case(folder.path());
    fs::write(folder.path().join("expect.toml"), EXPECT).expect("written");
    let flags = [
        "--spacings",
        "1.3 mm,1 mm,5 mm",
        "--vary",
        "numerics.sound_speed=0.06 m/s|2 m/s",
        "--ladders",
        "spacing,precision",
    ];
    let output = study(folder.path(), &flags);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{told}");
    let report = report(folder.path());
    run_knows_its_study(folder.path());
    let names: Vec<(&str, StudyStatus)> = report.runs.iter().map(|r| (r.name.as_str(), r.status)).collect();
    // A pipe three millimetres in radius has no ring of particles five millimetres apart; the slow sound breaks at the inlet's
    // velocity. Both are findings, and the rest goes on.
    assert_eq!(
        names,
        [
            ("spacing-5.0000mm", StudyStatus::Refused),
            ("spacing-1.3000mm", StudyStatus::Completed),
            ("spacing-1.0000mm", StudyStatus::Completed),
            ("precision-double", StudyStatus::Completed),
            ("numerics.sound_speed-0.06-m-s", StudyStatus::Failed),
            ("numerics.sound_speed-2-m-s", StudyStatus::Completed),
        ]
    );
    let errors: Vec<&str> = report.errors.iter().map(|e| e.name.as_str()).collect();
    assert_eq!(errors, ["speed", "outflow", "worst"]);
    for run in report.runs.iter().filter(|run| run.status == StudyStatus::Completed) {
        assert!(run.wall_clock_s > 0.0 && run.predicted_s > 0.0 && run.memory_bytes > 0, "{run:?}");
        let worst = run.error("speed").max(run.error("outflow"));
        assert_eq!(run.error("worst"), worst, "{run:?}");
        assert!(folder.path().join("study/runs").join(&run.name).join("summary.json").exists());
    }
    let failed = &report.runs[4];
    assert!(failed.message.as_deref().is_some_and(|m| m.contains("sound speed")), "{failed:?}");
    assert!(!report.front.is_empty() && told.contains("no other run beats it"), "{told}");
    let csv = fs::read_to_string(folder.path().join("study/study.csv")).expect("a table");
    let header = csv.lines().next().expect("a header");
    for column in
        ["particles.spacing", "numerics.precision", "wall_clock_s", "particles", "error_speed", "status"]
    {
        assert!(header.split(',').any(|c| c == column), "{column} is not in {header}");
    }
    assert_eq!(csv.lines().count(), 7);
    let page = fs::read_to_string(folder.path().join("study/report.html")).expect("a page");
    assert!(page.contains("<svg") && page.contains("Not completed"));

    // What is there is kept, and the page can be made again.
    let output = study(folder.path(), &flags);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("--force"));
    fs::remove_file(folder.path().join("study/report.html")).expect("removed");
    let again =
        Command::new(env!("CARGO_BIN_EXE_vaso")).arg("report").arg(folder.path().join("study")).output();
    assert!(again.expect("it starts").status.success());
    assert_eq!(fs::read_to_string(folder.path().join("study/report.html")).expect("a page"), page);
}

#[test]
fn a_budget_is_kept_and_used() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    case(folder.path());
    let output = study(folder.path(), &["--budget", "12 s", "--quiet", "--json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "quiet");
    let report = report(folder.path());
    let goal = report.goal.expect("what was asked for is answered");
    assert_eq!(goal.budget_s, Some(12.0));
    let chosen = report.runs.iter().find(|run| Some(&run.name) == goal.run.as_ref()).expect("a run");
    let finest = report.runs.iter().map(|run| run.spacing_m).fold(f64::INFINITY, f64::min);
    assert_eq!(chosen.spacing_m, finest);
    assert!(goal.verdict.contains("12 s were given"), "{}", goal.verdict);
    // Nothing is known of this flow: errors are those against its own finest runs, and that is said.
    assert!(report.reference.contains("nothing outside"), "{}", report.reference);
}

#[test]
fn wrong_wishes_are_refused_before_anything_is_written() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    case(folder.path());
    fs::write(folder.path().join("expect.toml"), EXPECT.replace("\"axis\"", "\"axs\"")).expect("written");
    let output = study(folder.path(), &[]);
    let told = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("expect.toml") && told.contains("\"axis\""), "{told}");
    fs::write(folder.path().join("expect.toml"), EXPECT).expect("written");
    for (flags, words) in [
        (vec!["--of", "pressure"], "`outflow`"),
        (vec!["--ladders", "grid"], "sound-speed"),
        (vec!["--spacings", "1 s"], "length"),
        (vec!["--error", "3"], "share"),
        (vec!["--budget", "0 s"], "above 0"),
        (vec!["--repeat", "0"], "0"),
    ] {
        let output = study(folder.path(), &flags);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{flags:?}: {told}");
        assert!(told.contains(words), "{flags:?}: {told}");
    }
    assert!(!folder.path().join("study").exists());
}

//! What `--help` shows is run: every line of its examples, in a folder that has what they name.

#![cfg(unix)]

use glam::DVec3;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use vaso_geometry::{shapes, write_stl};

fn help(command: Option<&str>) -> String {
    let output =
        Command::new(env!("CARGO_BIN_EXE_vaso")).args(command).arg("--help").output().expect("starts");
    assert!(output.status.success(), "{command:?} has no help");
    String::from_utf8(output.stdout).expect("help is UTF-8")
}

/// Commands as `vaso --help` lists them.
fn commands() -> Vec<String> {
    let help = help(None);
    let list = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let rows = list
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "));
    let names = rows.filter_map(|line| line.split_whitespace().next()).map(str::to_owned);
    names.filter(|name| name != "help").collect()
}

/// Lines of a help that are examples, without what is said beside them.
fn examples(help: &str) -> Vec<String> {
    let lines = help.lines().filter(|line| line.starts_with("  vaso "));
    lines.map(|line| line.trim().split("   ").next().unwrap_or_default().to_owned()).collect()
}

const CASE: &str = r#"
[geometry]
surface = "../vessel.stl"
unit = "mm"
[particles]
spacing = "0.9 mm"
[blood]
[[opening]]
name = "inlet"
near = [0, 0, 0]
condition = "velocity"
value = "5 cm/s"
[[opening]]
name = "outlet"
near = [0, 0, 24]
condition = "pressure"
[run]
end_time = "5 ms"
"#;

const BEAT: &str = "time_s,velocity_m_s\n0,0.02\n0.2,0.1\n0.4,0.05\n0.6,0.03\n0.8,0.02\n";

fn prepare(folder: &Path) {
    write_stl(&folder.join("vessel.stl"), &shapes::pipe(3.0, 24.0, DVec3::Z, 32)).expect("written");
    for name in ["my-case", "pulsing-case"] {
        fs::create_dir(folder.join(name)).expect("made");
    }
    fs::write(folder.join("my-case/case.toml"), CASE).expect("written");
    let pulsing = CASE
        .replace("value = \"5 cm/s\"", "waveform = \"beat.csv\"")
        .replace("end_time = \"5 ms\"", "period = \"0.8 s\"\ncycles = 1");
    fs::write(folder.join("pulsing-case/case.toml"), pulsing).expect("written");
    fs::write(folder.join("pulsing-case/beat.csv"), BEAT).expect("written");
}

#[test]
fn every_example_runs() {
    let here = tempfile::tempdir().expect("a temporary folder can be made");
    prepare(here.path());
    let binary = Path::new(env!("CARGO_BIN_EXE_vaso")).parent().expect("it lies in a folder");
    let path = std::env::var("PATH").unwrap_or_default();
    let helps = std::iter::once(None).chain(commands().into_iter().map(Some));
    for command in helps {
        let lines = examples(&help(command.as_deref()));
        assert!(!lines.is_empty(), "the help of {command:?} has no example");
        for line in lines {
            let output = Command::new("sh")
                .args(["-c", &line])
                .env("PATH", format!("{}:{path}", binary.display()))
                .current_dir(here.path())
                .output()
                .expect("there is a shell");
            assert!(output.status.success(), "{line}:\n{}", String::from_utf8_lossy(&output.stderr));
        }
    }
    for (file, words) in [
        ("vaso.bash", "--surface"),
        ("_vaso", "--surface"),
        ("vaso.fish", "surface"),
        ("case.schema.json", "draft-07"),
        ("man1/vaso.1", "vaso\\-run(1)"),
        ("man1/vaso-new.1", "surface"),
        ("my-case/out/report.html", "</html>"),
    ] {
        let text = fs::read_to_string(here.path().join(file)).unwrap_or_default();
        assert!(text.contains(words), "{file} lacks {words}");
    }
}

/// Colours are for people: what is not a terminal gets none.
#[test]
fn nothing_is_coloured_where_no_terminal_is() {
    for arguments in
        [vec!["--help"], vec!["run", "--help"], vec!["run"], vec!["rnu"], vec!["run", "no-such-case"]]
    {
        let output = Command::new(env!("CARGO_BIN_EXE_vaso")).args(&arguments).output().expect("starts");
        let bytes = [output.stdout, output.stderr].concat();
        assert!(!bytes.contains(&0x1b), "{arguments:?}: {}", String::from_utf8_lossy(&bytes));
    }
}

/// As `vaso schema | head` does.
#[test]
fn a_reader_that_has_seen_enough_is_no_error() {
    let mut vaso = Command::new(env!("CARGO_BIN_EXE_vaso"))
        .arg("schema")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program can be started");
    drop(vaso.stdout.take());
    let output = vaso.wait_with_output().expect("it ends");
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}

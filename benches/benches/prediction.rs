//! What `vaso check` says a case will take, against what it takes.
//!
//! `cargo bench -p vaso-benches --bench prediction -- --write` writes `docs/prediction.md`; `--test` takes the shortest look at one case
//! and writes nothing.

use std::path::Path;
use std::process::Command;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use vaso_benches::speed::root;
use vaso_driver::run::{Talk, run};
use vaso_driver::{Case, DriverError, Plan, world::Bodies};

/// Time each case runs before it is stopped, and in a look \[s\].
const SECONDS: f64 = 20.0;
const LOOK: f64 = 2.0;

const HEAD: &str = "\
# What is predicted and what it takes

Made by `cargo bench -p vaso-benches --bench prediction -- --write`; do not edit. `vaso check` and `vaso run` say beforehand what a run will take.
Here each case that comes with the program runs as it stands, with its output, on all threads, and is stopped after 20 seconds; the rest is
projected by the simulated time it has got to. The measurement by which the prediction knows the machine comes first, as for anybody. Particles are
in the cache.

| case | predicted, min | projected, min | projected over predicted | of the case, run |
|---|---|---|---|---|
";

/// Simulated time \[s\] that a run gets to when it is stopped after `seconds`, and the time it takes for that \[s\].
fn stopped_after(case: &Case, plan: &Plan, seconds: f64) -> (f64, f64) {
    let folder = root().join("target/prediction");
    let stop = AtomicBool::new(seconds == 0.0);
    std::thread::scope(|threads| {
        threads.spawn(|| {
            std::thread::sleep(Duration::from_secs_f64(seconds));
            stop.store(true, Ordering::Relaxed);
        });
        match run(case, plan, &folder, true, &stop, &Talk { quiet: true }) {
            Ok(_) | Err(DriverError::Interrupted { .. }) => {}
            Err(error) => panic!("{error}"),
        }
    });
    let text = std::fs::read(folder.join("summary.json")).expect("a run leaves a summary");
    let summary: serde_json::Value = serde_json::from_slice(&text).expect("it is JSON");
    let wall_clock = summary["wall_clock_s"].as_f64().expect("it says what it took");
    (summary["time_s"].as_f64().expect("it says how far it came"), wall_clock)
}

/// The row of one case; `None` where it asks for what is not here. On a worker thread, as the program works: from outside every parallel
/// loop would wake a worker and put the caller to sleep.
fn row(name: &str, seconds: f64) -> Option<String> {
    rayon::scope(|_| row_here(name, seconds))
}

fn row_here(name: &str, seconds: f64) -> Option<String> {
    let mut case = Case::load(&root().join("cases").join(name), &[]).ok()?;
    case.cache = Some(root().join("target/ladder"));
    let plan = Plan::new(&case).ok()?;
    let predicted = plan.expected().wall_clock_s;
    Bodies::make(&case, |_, _, _| {}).ok()?;
    // The difference of two runs leaves out what is before the first step.
    let (start, before) = stopped_after(&case, &plan, 0.0);
    let (end, after) = stopped_after(&case, &plan, seconds);
    let projected = before + (after - before) / (end - start) * (plan.end_time - start);
    Some(format!(
        "| `{name}` | {:.1} | {:.1} | {:.2} | {:.0} % |",
        predicted / 60.0,
        projected / 60.0,
        projected / predicted,
        100.0 * end / plan.end_time
    ))
}

/// The row of a case that asks for what is not here.
fn absent(name: &str) -> String {
    format!("| `{name}`, not run: its surface is not here | – | – | – | – |")
}

/// Names of the cases, in order.
fn cases() -> Vec<String> {
    let entries = std::fs::read_dir(root().join("cases")).expect("the cases are there");
    let folders = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let is_case = |folder: &Path| folder.join("case.toml").is_file();
    let named = folders
        .filter(|folder| is_case(folder))
        .filter_map(|folder| folder.file_name()?.to_str().map(str::to_owned));
    let mut names: Vec<String> = named.collect();
    names.sort();
    names
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let asked = |flag: &str| arguments.iter().any(|a| a == flag);
    if let Some(at) = arguments.iter().position(|a| a == "--case") {
        return println!(
            "{}",
            row(&arguments[at + 1], SECONDS).unwrap_or_else(|| absent(&arguments[at + 1]))
        );
    }
    if asked("--test") {
        return println!("{}", row("pipe", LOOK).expect("the pipe is there"));
    }
    let mut page = HEAD.to_owned();
    for name in cases() {
        // Each in a process of its own, which measures the machine when its turn comes.
        let program = std::env::current_exe().expect("it runs");
        let output = Command::new(program).args(["--case", &name]).output().expect("it can be started again");
        let row = String::from_utf8_lossy(&output.stdout);
        println!("{}", row.trim_end());
        page += &row;
    }
    if asked("--write") {
        std::fs::write(root().join("docs/prediction.md"), page).expect("the page can be written");
    }
}

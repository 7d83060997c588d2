//! Bodies that come from the cache know what those that were made knew.

use std::path::Path;
use std::sync::atomic::AtomicBool;
use vaso_driver::bodies::Maker;
use vaso_driver::run::{Talk, run};
use vaso_driver::{Case, Plan, check};

#[test]
fn what_became_of_blocks_reaches_check_and_run_through_the_cache() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let pipe = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/pipe");
    for file in ["case.toml", "pipe.stl"] {
        std::fs::copy(pipe.join(file), folder.path().join(file)).expect("cases can be copied");
    }
    let settings = [
        ("particles.spacing", "0.9 mm"),
        ("particles.generator", "multiblock"),
        ("run.end_time", "5 ms"),
        ("numerics.seed", "3"),
    ];
    let set = settings.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let case = Case::load(folder.path(), &set).expect("the case is sound");
    let knows = |warnings: &[String]| warnings.iter().any(|w| w.contains("a junction that is none"));
    assert!(!knows(&check::case(folder.path(), &set).expect("checks").report.warnings));

    // A pipe has no junction that could be left to the lattice, so its report is given one.
    let mut maker = Maker::new(&case, |_, _, _| {});
    let mut made = maker.fluid().expect("blocks fit into a pipe");
    assert!(!made.cached);
    let blocks = made.body.blocks.as_mut().expect("blocks are reported");
    blocks.unblocked_junctions.push("a junction that is none is filled by the lattice".into());
    maker.keep(&made);

    let again = maker.fluid().expect("the cache has it");
    assert!(again.cached && again.body == made.body && again.seconds == made.seconds);
    assert!(knows(&check::case(folder.path(), &set).expect("checks").report.warnings));
    let plan = Plan::new(&case).expect("the case can run");
    let out = folder.path().join("out");
    let summary =
        run(&case, &plan, &out, false, &AtomicBool::new(false), &Talk { quiet: true }).expect("runs");
    assert!(knows(&summary.warnings), "{:?}", summary.warnings);
    let written = vaso_io::Summary::read(&out.join("summary.json")).expect("it is written");
    assert_eq!(written.warnings, summary.warnings);

    // Another setting is another body.
    let other = [set.as_slice(), &[("particles.topology".to_owned(), "single".to_owned())]].concat();
    assert!(!knows(&check::case(folder.path(), &other).expect("checks").report.warnings));
}

/// Walls and shells come back from the cache to the bit.
#[test]
fn walls_and_shells_are_kept_whole() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let pipe = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/pipe");
    let set = [("particles.spacing".to_owned(), "1 mm".to_owned())];
    let mut case = Case::load(&pipe, &set).expect("the case is sound");
    case.cache = Some(folder.path().join("cache"));
    let mut maker = Maker::new(&case, |_, _, _| {});
    let (wall, shell) = (maker.wall().expect("fits"), maker.shell().expect("fits"));
    assert!(!wall.cached && !shell.cached);
    maker.keep(&wall);
    maker.keep(&shell);
    let (old_wall, old_shell) = (maker.wall().expect("kept"), maker.shell().expect("kept"));
    assert!(old_wall.cached && old_wall.body == wall.body);
    assert!(old_shell.cached && old_shell.body == shell.body);
}

//! The targets of the fuzzer without the fuzzer: the committed corpus, mutations of it, and files made to exhaust the
//! readers, each held to a time and a memory.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use peak_alloc::PeakAlloc;
use vaso_fuzz::TARGETS;
use vaso_geometry::parse_surface;

#[path = "../../crates/geometry/src/read/hostile.rs"]
mod hostile;
mod mutate;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// The allocator counts for all threads, so one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// Most seconds for a file of up to 100 kB; they take some milliseconds.
const MOST_SECONDS: f64 = 1.0;
/// Most bytes for each byte of a file, above what any file may take.
const MOST_BYTES: (usize, usize) = (64, 4 << 20);
/// Mutations of each corpus.
const MUTATIONS: usize = 10_000;

/// Runs a target on a file, and complains where that panics, takes too long or takes too much; returns the memory
/// \[bytes\] and the time \[s\] it took.
fn run(target: impl Fn(&[u8]), name: &str, bytes: &[u8]) -> (usize, f64) {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let began = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| target(bytes)));
    let took = began.elapsed().as_secs_f64();
    let peak = MEMORY.peak_usage().saturating_sub(before);
    let (each, free) = MOST_BYTES;
    let size = bytes.len();
    let fault = if outcome.is_err() {
        "panics".to_owned()
    } else if peak > free + each * size {
        format!("takes {peak} bytes of memory for {size}")
    } else if took > MOST_SECONDS * (1.0f64).max(size as f64 / 1e5) {
        format!("takes {took} s for {size} bytes")
    } else {
        return (peak, took);
    };
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name.replace(['/', ' '], "_"));
    fs::write(&kept, bytes).expect("the target folder can be written");
    panic!("{name} {fault}; it is kept as {}", kept.display());
}

fn run_and_print(target: impl Fn(&[u8]), name: &str, bytes: &[u8]) {
    let (peak, took) = run(target, name, bytes);
    println!("{name:<44} {:>9} bytes {:>10.1} kB {:>10.3} ms", bytes.len(), peak as f64 / 1e3, took * 1e3);
}

fn corpus(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    let mut paths: Vec<PathBuf> = fs::read_dir(&folder)
        .expect("each target has a corpus")
        .map(|entry| entry.expect("it can be read").path())
        .collect();
    paths.sort();
    let name = |path: &Path| {
        path.strip_prefix(env!("CARGO_MANIFEST_DIR")).expect("it lies there").display().to_string()
    };
    paths
        .into_iter()
        .map(|path| (name(&path), fs::read(&path).expect("files of the corpus can be read")))
        .collect()
}

#[test]
fn the_corpus_passes() {
    let _alone = ALONE.lock();
    for (name, target) in TARGETS {
        let files = corpus(name);
        assert!(files.len() >= 4, "{name}: only {} files", files.len());
        for (name, bytes) in files {
            run_and_print(target, &name, &bytes);
        }
    }
}

#[test]
fn mutations_of_the_corpus_pass() {
    let _alone = ALONE.lock();
    for (seed, (name, target)) in TARGETS.into_iter().enumerate() {
        let files: Vec<Vec<u8>> = corpus(name).into_iter().map(|(_, bytes)| bytes).collect();
        let mut mutator = mutate::Mutator::new(seed as u64);
        for number in 0..MUTATIONS {
            let bytes = mutator.mutate(&files[number % files.len()], &files);
            run(target, &format!("{name}, mutation {number}"), &bytes);
        }
    }
}

#[test]
fn files_made_to_exhaust_the_readers_do_not() {
    let _alone = ALONE.lock();
    for size in [1000, 100_000, 3_000_000] {
        for file in hostile::hostile(size) {
            let refused = |bytes: &[u8]| {
                let error = parse_surface(bytes, Path::new("input")).expect_err("it is a lie").to_string();
                assert!(error.contains(file.error), "{error}");
            };
            run_and_print(refused, &format!("{} of {size}", file.name), &file.bytes);
        }
    }
}

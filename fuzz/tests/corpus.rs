//! The targets of the fuzzer without the fuzzer: the committed corpus, mutations of it, and files made to exhaust the
//! readers, each held to a time and a memory.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Instant;

use glam::DVec3;
use peak_alloc::PeakAlloc;
use vaso_fuzz::TARGETS;
use vaso_geometry::{LengthUnit, Surface, parse_surface};

#[path = "../../crates/geometry/src/read/hostile.rs"]
mod hostile;
mod mutate;

#[global_allocator]
static MEMORY: PeakAlloc = PeakAlloc;

/// The allocator counts for all threads, so one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

/// Most seconds for a file of up to 100 kB. The worst surface takes 0.4 s, files take milliseconds.
const MOST_SECONDS: f64 = 2.0;
/// Bytes of memory that any file may take.
const FREE_BYTES: usize = 4 << 20;
/// Most bytes of memory for each byte of a surface, and for each byte of a case: those are small, and the parser of TOML
/// keeps 500 bytes for a mistake.
const SURFACE: usize = 40;
const CASE: usize = 640;
/// Mutations of each corpus.
const MUTATIONS: usize = 10_000;

/// Runs a target on a file, and complains where that panics, takes too long or takes too much; returns the memory
/// \[bytes\] and the time \[s\] it took.
fn run(target: impl Fn(&[u8]), name: &str, bytes: &[u8], memory: usize) -> (usize, f64) {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let began = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| target(bytes)));
    let took = began.elapsed().as_secs_f64();
    let peak = MEMORY.peak_usage().saturating_sub(before);
    let size = bytes.len();
    let fault = if outcome.is_err() {
        "panics".to_owned()
    } else if peak > FREE_BYTES + memory * size {
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

fn run_and_print(target: impl Fn(&[u8]), name: &str, bytes: &[u8], memory: usize) {
    let (peak, took) = run(target, name, bytes, memory);
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
            run_and_print(target, &name, &bytes, CASE);
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
            run(target, &format!("{name}, mutation {number}"), &bytes, CASE);
        }
    }
}

#[test]
fn files_made_to_exhaust_the_readers_do_not() {
    let _alone = ALONE.lock();
    for size in [100_000, 3_000_000] {
        for file in hostile::hostile(size) {
            let refused = |bytes: &[u8]| {
                let error = parse_surface(bytes, Path::new("input")).expect_err("it is a lie").to_string();
                assert!(error.contains(file.error), "{error}");
            };
            run_and_print(refused, &format!("{} of {size}", file.name), &file.bytes, SURFACE);
        }
    }
}

/// Surfaces of 2000 triangles, 100 kB in a file, on which every step of the repair could take its longest.
#[test]
fn surfaces_made_to_exhaust_the_repair_do_not() {
    let _alone = ALONE.lock();
    let n = 2000;
    let mut random = mutate::Mutator::new(7);
    let mut place = || DVec3::from([0; 3].map(|_| random.below(1 << 20) as f64));
    let anywhere: Vec<DVec3> = (0..n + 2).map(|_| place()).collect();
    let around = |i: u32| {
        let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / f64::from(n)).sin_cos();
        DVec3::new(cos, sin, f64::from(i % 2))
    };
    let strip: Vec<[u32; 3]> =
        (0..n).map(|i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] }).collect();
    let tetrahedra =
        (0..n / 4).flat_map(|i| [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]].map(|t| t.map(|v| v + 4 * i)));
    let corner = |i: u32| {
        DVec3::from([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]][i as usize % 4].map(f64::from))
    };
    let pipe = strip.iter().map(|t| t.map(|v| v % n)).collect();
    let mut heap = mutate::Mutator::new(8);
    let mut any = || heap.below(n as usize) as u32;
    let surfaces = [
        ("a loop of 2000 corners that crosses itself", anywhere.clone(), strip),
        ("a pipe of two rings of 1000 corners", (0..n).map(around).collect(), pipe),
        ("triangles around one corner", anywhere.clone(), (0..n).map(|i| [0, i + 1, i + 2]).collect()),
        ("triangles around one edge", anywhere.clone(), (0..n).map(|i| [0, 1, i + 2]).collect()),
        (
            "tetrahedra through each other",
            (0..n).map(|i| corner(i) + 1e-5 * f64::from(i / 4)).collect(),
            tetrahedra.collect(),
        ),
        ("a heap of triangles", anywhere, (0..n).map(|_| [any(), any(), any()]).collect()),
    ];
    let as_a_file = vec![0; 50 * n as usize];
    for (name, vertices, triangles) in surfaces {
        let surface = Surface { vertices, triangles };
        let prepare = |_: &[u8]| drop(vaso_geometry::prepare(surface.clone(), Some(LengthUnit::Metre)));
        run_and_print(prepare, name, &as_a_file, SURFACE);
    }
}

#[test]
fn texts_made_to_exhaust_the_case_do_not() {
    let _alone = ALONE.lock();
    let n = 100_000;
    let numbered = |line: &dyn Fn(usize) -> String, count: usize| (0..count).map(line).collect::<String>();
    let texts = [
        ("arrays in arrays", format!("a = {}", "[".repeat(n))),
        ("tables in tables", format!("a = {}", "{ a = ".repeat(n / 6))),
        ("a key of many parts", format!("{}a = 1", "a.".repeat(n / 2))),
        ("a table of many parts", format!("[{}a]", "a.".repeat(n / 2))),
        ("a key of one part", format!("[blood]\n{} = 1", "a".repeat(n))),
        ("unknown keys", numbered(&|i| format!("a{i}=1\n"), n / 8)),
        ("unknown keys of a table", format!("[run]\n{}", numbered(&|i| format!("end_tim{i}=1\n"), n / 16))),
        ("the same key", "[run]\n".to_owned() + &"period=1\n".repeat(n / 9)),
        ("many openings", "[[opening]]\n".repeat(n / 12)),
        ("openings of one name", "[[opening]]\nname=\"a\"\n".repeat(n / 21)),
        ("many probes", numbered(&|i| format!("[[probe]]\nname=\"p{i}\"\nat=[0,0,0]\n"), n / 32)),
        ("a long unit", format!("[blood]\ndensity = \"1 {}\"", "m*".repeat(n / 2))),
        ("an unknown unit", format!("[blood]\ndensity = \"1 {}\"", "x".repeat(n))),
        ("many units", format!("[blood]\n{}", numbered(&|i| format!("density{i} = \"1 xx\"\n"), n / 20))),
        ("a long number", format!("[blood]\ndensity = \"{} kg/m^3\"", "1".repeat(n))),
        ("a long integer", format!("[numerics]\nseed = {}", "1".repeat(n))),
        ("a long word", format!("[wall]\nmodel = \"{}\"", "shell".repeat(n / 5))),
        ("many fields", format!("[output]\nfields = [{}]", "\"velocty\",".repeat(n / 10))),
        ("many overrides", "#set run.period=1\n".repeat(n / 18)),
        ("an override of many parts", format!("#set {}a=1", "a.".repeat(n / 2))),
        ("an override of arrays in arrays", format!("#set a={}", "[".repeat(n))),
        (
            "a table of many rows",
            format!("[[opening]]\nwaveform=\"own.csv\"\n#file\n{}", numbered(&|i| format!("{i},1\n"), n / 8)),
        ),
        ("quotes", "\"".repeat(n)),
        ("carriage returns", "\r".repeat(n)),
        ("lines of errors", "=\n".repeat(n / 2)),
    ];
    for (name, text) in texts {
        run_and_print(vaso_fuzz::case, name, text.as_bytes(), CASE);
    }
}

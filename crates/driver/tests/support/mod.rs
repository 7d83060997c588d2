//! Small runs of the real program that are broken off and go on, and what is left of them.

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};
use vaso_io::Archive;

/// A case in a folder of its own.
pub(crate) struct Setup {
    folder: tempfile::TempDir,
}

/// A pipe six particles across under a beat of a few milliseconds that a Windkessel takes up, with shear stress over cycles.
pub(crate) const RIGID: &[&str] = &[];

const CASE: &str = r#"
[geometry]
surface = "pipe.stl"
unit = "mm"
[particles]
spacing = "1.1 mm"
[blood]
density = "1050 kg/m^3"
viscosity = "3.6 mPa s"
[wall]
model = "rigid"
[[opening]]
name = "inlet"
near = [0.0, 0.0, 0.0]
condition = "velocity"
profile = "womersley"
waveform = "in.csv"
ramp = "4 ms"
[[opening]]
name = "outlet"
near = [0.0, 0.0, 31.75]
condition = "windkessel"
proximal_resistance = "2e7 Pa s/m^3"
distal_resistance = "1e8 Pa s/m^3"
compliance = "1e-10 m^3/Pa"
[[probe]]
name = "middle"
at = [0.0, 0.0, 16.0]
[run]
period = "20 ms"
cycles = 2
[output]
every = "4 ms"
table_every = "1 ms"
checkpoint_every = "2 ms"
fields = ["velocity", "pressure", "wss", "tawss", "osi"]
"#;

impl Setup {
    /// The pipe with its waveform.
    pub(crate) fn new() -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder can be had");
        let pipe = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/pipe/pipe.stl");
        std::fs::copy(pipe, folder.path().join("pipe.stl")).expect("the surface can be copied");
        std::fs::write(folder.path().join("case.toml"), CASE).expect("the case can be written");
        let beat = "time_s,u_m_s\n0,0.05\n0.004,0.25\n0.008,0.15\n0.012,-0.02\n0.016,0.04\n0.02,0.05\n";
        std::fs::write(folder.path().join("in.csv"), beat).expect("the waveform can be written");
        Self { folder }
    }

    /// A file of the case.
    pub(crate) fn file(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `vaso run` into the folder `out` beside the case.
    pub(crate) fn run(&self, out: &str, threads: usize, settings: &[&str]) -> Command {
        let mut vaso = Command::new(env!("CARGO_BIN_EXE_vaso"));
        vaso.arg("run").arg(self.folder.path()).arg("--out").arg(self.file(out)).arg("--quiet");
        vaso.arg("--threads").arg(threads.to_string());
        for setting in settings {
            vaso.args(["--set", setting]);
        }
        vaso.stdout(Stdio::null()).stderr(Stdio::piped());
        vaso
    }

    /// `vaso resume` of that folder.
    pub(crate) fn resume(&self, out: &str, threads: usize) -> Command {
        let mut vaso = Command::new(env!("CARGO_BIN_EXE_vaso"));
        vaso.arg("resume").arg(self.file(out)).arg("--quiet").arg("--threads").arg(threads.to_string());
        vaso.stdout(Stdio::null()).stderr(Stdio::piped());
        vaso
    }
}

/// Runs to the end, which has to be a good one.
pub(crate) fn succeed(mut command: Command) {
    let output = command.output().expect("the program can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// Runs to the end, which has to be one with this code and these words; returns all that was said.
pub(crate) fn fail(mut command: Command, code: i32, words: &[&str]) -> String {
    let Output { status, stderr, .. } = command.output().expect("the program can be started");
    let text = String::from_utf8_lossy(&stderr).into_owned();
    assert_eq!(status.code(), Some(code), "{text}");
    for word in words {
        assert!(text.contains(word), "\"{word}\" is not in {text}");
    }
    text
}

/// Starts a run and waits until its table has so many rows. `None` where it came to its end before.
pub(crate) fn start_and_wait(mut command: Command, out: &Path, rows: usize) -> Option<Child> {
    let mut child = command.spawn().expect("the program can be started");
    let started = Instant::now();
    loop {
        let seen = std::fs::read_to_string(out.join("openings.csv")).map_or(0, |text| text.lines().count());
        if seen > rows {
            return Some(child);
        }
        if child.try_wait().expect("children can be asked").is_some() {
            return None;
        }
        assert!(started.elapsed() < Duration::from_secs(300), "the run does not get anywhere");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// All files of a folder with their content.
pub(crate) fn content(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).expect("the folder can be read");
    let files = entries.map(|entry| entry.expect("entries can be read").path()).filter(|path| path.is_file());
    let name = |path: &Path| path.file_name().expect("files have names").to_string_lossy().into_owned();
    files.map(|path| (name(&path), std::fs::read(&path).expect("files can be read"))).collect()
}

/// Both folders hold the same results: frames and rows byte for byte, every array of the last checkpoint bit for bit, and the
/// summary but for what time was spent.
pub(crate) fn assert_same(unbroken: &Path, resumed: &Path, what: &str) {
    let (a, b) = (content(unbroken), content(resumed));
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>(), "{what}: files");
    for name in ["fluid.vtkhdf", "wall.vtkhdf", "lumen.vtkhdf", "openings.csv", "probes.csv"] {
        assert!(a.get(name) == b.get(name), "{what}: {name} differs");
    }
    let [a, b] = [unbroken, resumed].map(arrays);
    assert_eq!(a.keys().collect::<Vec<_>>(), b.keys().collect::<Vec<_>>(), "{what}: arrays");
    let different: Vec<&String> =
        a.iter().filter(|(name, bits)| b[*name] != **bits).map(|(name, _)| name).collect();
    assert!(different.is_empty(), "{what}: {different:?} differ");
    assert_eq!(summary(unbroken), summary(resumed), "{what}: summary");
}

/// The arrays of a checkpoint as bits, without the time that was spent.
fn arrays(folder: &Path) -> BTreeMap<String, Vec<u64>> {
    let path = folder.join("checkpoint.h5");
    let archive = Archive::read(&path, "checkpoint", vaso_driver::checkpoint::VERSION).expect("sound");
    let bits = |name: &str| -> Vec<u64> {
        let floats = archive.floats(name).map(|values| values.iter().map(|x| x.to_bits()).collect());
        let vectors = || {
            let flat =
                |vectors: Vec<glam::DVec3>| vectors.iter().flat_map(|v| v.to_array()).collect::<Vec<_>>();
            archive.vectors(name).map(|v| flat(v).iter().map(|x| x.to_bits()).collect())
        };
        let integers = || archive.integers(name).map(<[u64]>::to_vec);
        let bytes = || archive.bytes(name).map(|bytes| bytes.iter().map(|&b| u64::from(b)).collect());
        floats.or_else(vectors).or_else(integers).or_else(bytes).expect("of one of the types")
    };
    let is_time = |name: &&str| !["ledger.seconds", "wall_clock_s"].contains(name);
    archive.names().filter(is_time).map(|name| (name.to_owned(), bits(name))).collect()
}

/// The summary without what depends on the time that was spent and on where memory was taken.
fn summary(folder: &Path) -> Value {
    let text = std::fs::read(folder.join("summary.json")).expect("the summary is there");
    let mut summary: Value = serde_json::from_slice(&text).expect("it is JSON");
    for key in ["wall_clock_s", "threads", "particle_substeps_per_s"] {
        summary[key] = Value::Null;
    }
    for effect in summary["effects"].as_array_mut().expect("effects are listed") {
        (effect["seconds"], effect["bytes"]) = (Value::Null, Value::Null);
    }
    summary
}

//! What a run reads off its flow: wall shear stress on the surface, cycles, whether it has settled.

use serde_json::Value;
use std::f64::consts::PI;
use std::path::Path;
use std::process::Command;

/// Radius of the pipe of `cases/pipe` \[m\].
const RADIUS: f64 = 3.175e-3;
/// Its length \[m\].
const LENGTH: f64 = 31.75e-3;
/// Dynamic viscosity \[Pa s\].
const VISCOSITY: f64 = 3.6e-3;

/// Runs the pipe with 10 particles across, at a mean velocity given by the last lines of its inlet.
fn run(folder: &Path, inlet: &str, rest: &str) -> Value {
    let pipe = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/pipe/pipe.stl");
    std::fs::copy(pipe, folder.join("pipe.stl")).expect("the surface can be copied");
    let case = format!(
        r#"
[geometry]
surface = "pipe.stl"
unit = "mm"
[particles]
spacing = "0.635 mm"
[blood]
density = "1050 kg/m^3"
viscosity = "3.6 mPa s"
[wall]
model = "rigid"
[[opening]]
name = "inlet"
near = [0.0, 0.0, 0.0]
condition = "velocity"
profile = "parabolic"
{inlet}
[[opening]]
name = "outlet"
near = [0.0, 0.0, 31.75]
condition = "pressure"
value = "0 Pa"
{rest}
"#
    );
    std::fs::write(folder.join("case.toml"), case).expect("the case can be written");
    let mut vaso = Command::new(env!("CARGO_BIN_EXE_vaso"));
    let output = vaso.arg("run").arg(folder).arg("--json").output().expect("the program can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("standard output is JSON")
}

/// Mean over the wall of a field of the last frame, in the middle of the pipe.
fn middle(folder: &Path, field: &str) -> f64 {
    mean(folder, field, 8e-3..24e-3)
}

/// The same over the points whose height lies in `part` \[m\].
fn mean(folder: &Path, field: &str, part: std::ops::Range<f64>) -> f64 {
    let series = vaso_io::SeriesReader::open(&folder.join("out/wall.vtkhdf")).expect("the wall is there");
    let last = series.info().times.len() - 1;
    let frame = series.frame(last).expect("the last frame can be read");
    let scalar = frame.scalars.iter().find(|(name, _)| name == field).map(|(_, values)| values.clone());
    let vector =
        || frame.vectors.iter().find(|(name, _)| name == field).map(|(_, v)| v.iter().map(|v| v.z).collect());
    let values: Vec<f64> = scalar.or_else(vector).expect("the field is there");
    let inner: Vec<f64> =
        (0..values.len()).filter(|&k| part.contains(&frame.position[k].z)).map(|k| values[k]).collect();
    assert!(inner.len() > 100 && inner.iter().all(|v| v.is_finite()), "every point has a value");
    inner.iter().sum::<f64>() / inner.len() as f64
}

/// The run ends when its flow does not change any more, and drags on the wall as Poiseuille's formula says: with ten particles across
/// within 7 %, which the validation suite follows to finer ones.
#[test]
fn a_steady_flow_ends_once_it_has_settled() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let rest = "[run]\nend_time = \"20 s\"\nsteady = 0.01\n[output]\nevery = \"0.1 s\"\nfields = [\"velocity\", \"wss\"]";
    let summary = run(folder.path(), "value = \"54 mm/s\"", rest);
    let time = summary["time_s"].as_f64().unwrap_or(f64::NAN);
    assert!((0.9..4.0).contains(&time), "ended at {time} s");
    assert!(summary["message"].as_str().is_some_and(|m| m.contains("settled")), "{}", summary["message"]);
    let expected = 4.0 * VISCOSITY * 0.054 / RADIUS;
    let error = middle(folder.path(), "WSS") / expected - 1.0;
    println!("wall shear stress: {:+.2} % at D/10", 100.0 * error);
    assert!(error.abs() < 0.07, "{error}");
    let growth = summary["stability"]["energy_growth"].as_f64().unwrap_or(f64::NAN);
    assert!(growth < 0.05, "energy from nowhere: {growth}");
}

/// A pulse that never turns back: indices of the wall follow from the flow, and the summary from the last cycle.
#[test]
fn cycles_are_told_at_their_ends() {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    let (speed, period) = (0.05, 0.1);
    let wave: String = (0..=20)
        .map(|k| {
            let t = period * f64::from(k) / 20.0;
            format!("{t},{}\n", speed * (1.0 + 0.1 * (2.0 * PI * t / period).sin()))
        })
        .collect();
    std::fs::write(folder.path().join("wave.csv"), wave).expect("the waveform can be written");
    let rest = "[run]\nperiod = \"0.1 s\"\ncycles = 3\n[output]\nevery = \"0.02 s\"\n\
                fields = [\"velocity\", \"wss\", \"tawss\", \"osi\", \"rrt\"]";
    let summary = run(folder.path(), "waveform = \"wave.csv\"", rest);
    assert!((summary["time_s"].as_f64().unwrap_or(f64::NAN) - 0.3).abs() < 1e-9);
    let inlet = summary["openings"].as_array().and_then(|o| o.iter().find(|o| o["name"] == "inlet"));
    let flow = inlet.and_then(|o| o["mean_flow_m3_s"].as_f64()).unwrap_or(f64::NAN);
    let expected = -speed * PI * RADIUS * RADIUS;
    assert!((flow / expected - 1.0).abs() < 0.01, "{flow} against {expected}");
    let (tawss, osi, rrt) =
        (middle(folder.path(), "TAWSS"), middle(folder.path(), "OSI"), middle(folder.path(), "RRT"));
    println!("TAWSS {tawss:.4} Pa, OSI {osi:.4}, RRT {rrt:.3} 1/Pa");
    // The boundary layer is still growing after three pulses, so the stress is above that of the parabola.
    let steady = 4.0 * VISCOSITY * speed / RADIUS;
    assert!((1.0..1.3).contains(&(tawss / steady)), "{tawss} against {steady}");
    let cycles = summary["cycles"].as_array().expect("cycles are told");
    assert_eq!(cycles.len(), 3);
    let told = cycles[2]["mean_tawss_pa"].as_f64().unwrap_or(f64::NAN);
    let outside = mean(folder.path(), "TAWSS", 4.0 * 0.635e-3..LENGTH - 4.0 * 0.635e-3);
    assert!(
        (told / outside - 1.0).abs() < 0.02,
        "{told} by area against {outside} by points, outside the buffers"
    );
    // The change of the mean is at most the mean of the changes, and no more than a little less where all change alike.
    let change = cycles[2]["periodicity"]["wall_shear"].as_f64().unwrap_or(f64::NAN);
    let before = cycles[1]["mean_tawss_pa"].as_f64().unwrap_or(f64::NAN);
    let of_means = (told / before - 1.0).abs() * before / told;
    assert!(
        (0.9 * change..=1.001 * change).contains(&of_means),
        "{change}, and that of the means {of_means}"
    );
    assert!(cycles[0]["periodicity"].is_null(), "nothing comes before the first cycle");
    assert!((0.0..0.02).contains(&osi), "the stress never turns: {osi}");
    assert!((rrt * tawss - 1.0).abs() < 0.1, "RRT is the inverse of a stress that never turns");
}

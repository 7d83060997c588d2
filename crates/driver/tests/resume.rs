//! `vaso resume`: a run that is broken off at any moment goes on and ends with the same bits as an unbroken one.
#![cfg(unix)]

mod support;

use std::time::{Duration, Instant};
use support::{RIGID, Setup, assert_same, fail, start_and_wait, succeed};

/// The pulse of [`RIGID`] in a wall of two layers.
const SOLID: &[&str] = &[
    "wall.model=solid",
    "wall.thickness=1.8 mm",
    "wall.young_modulus=0.5 MPa",
    "wall.spacing=0.9 mm",
    "run.cycles=1",
    "output.fields=[\"velocity\", \"displacement\", \"von_mises\", \"wss\", \"tawss\"]",
];

/// The same with a shell, in tissue.
const SHELL: &[&str] = &[
    "wall.model=shell",
    "wall.thickness=0.6 mm",
    "wall.young_modulus=0.5 MPa",
    "wall.support.stiffness=1e6 Pa/m",
    "wall.support.damping=1e4 Pa s/m",
    "run.cycles=1",
    "output.fields=[\"velocity\", \"displacement\", \"von_mises\", \"wss\", \"tawss\"]",
];

/// Kills a run twice, each time after some more rows, and goes on with another number of threads.
fn goes_on_alike(what: &str, settings: &[&str], rows: [usize; 2]) {
    let setup = Setup::new();
    succeed(setup.run("unbroken", 1, settings));
    let out = setup.file("broken");
    let mut killed = 0;
    let sessions = [setup.run("broken", 1, settings), setup.resume("broken", 2)];
    for (command, rows) in sessions.into_iter().zip(rows) {
        if let Some(mut child) = start_and_wait(command, &out, rows) {
            child.kill().expect("children can be killed");
            killed += i32::from(!child.wait().expect("it ends").success());
        }
    }
    assert_eq!(killed, 2, "{what}: the run was over before it could be killed");
    succeed(setup.resume("broken", 4));
    assert_same(&setup.file("unbroken"), &out, what);
}

#[test]
fn a_pulse_in_a_rigid_vessel_goes_on_alike() {
    goes_on_alike("rigid", RIGID, [10, 25]);
}

#[test]
fn a_solid_wall_goes_on_alike() {
    goes_on_alike("solid", SOLID, [5, 12]);
}

#[test]
fn a_shell_goes_on_alike() {
    goes_on_alike("shell", SHELL, [5, 12]);
}

/// Every effect that leaves something to remember, at one, two and four threads, twice broken off.
#[test]
#[ignore = "takes minutes; `cargo test --release -p vaso-driver --test resume -- --ignored`"]
fn every_effect_goes_on_alike() {
    let with = |base: &[&'static str], more: &[&'static str]| [base, more].concat();
    let cases = [
        ("double precision", with(RIGID, &["numerics.precision=double"])),
        ("mass held", with(RIGID, &["numerics.hold_mass=true"])),
        ("shear thinning", with(RIGID, &["blood.viscosity={ model = \"casson\" }"])),
        ("rigid shell", with(RIGID, &["wall.model=rigid-shell"])),
        (
            "window of an outlet",
            with(RIGID, &["opening.outlet.coupling=window", "opening.outlet.window=0.7 ms"]),
        ),
        ("periodicity", with(RIGID, &["run.periodicity=0.5", "run.cycles=5"])),
        ("hypoelastic solid", with(SOLID, &["wall.material=hypoelastic"])),
        (
            "solid in tissue",
            with(SOLID, &["wall.support.stiffness=1e6 Pa/m", "wall.support.damping=1e4 Pa s/m"]),
        ),
        ("solid in double precision", with(SOLID, &["numerics.precision=double"])),
        ("linear shell", with(SHELL, &["wall.material=saint-venant-kirchhoff"])),
        ("thin shell", with(SHELL, &["wall.thickness=0.4 mm", "wall.ends=sliding"])),
        ("shell in double precision", with(SHELL, &["numerics.precision=double"])),
    ];
    for (what, settings) in cases {
        goes_on_alike(what, &settings, [5, 12]);
    }
}

/// Kills as many times as `kills` says at moments without any order, starting anew whenever the run has come to its end; each that has
/// is compared with an unbroken one. Returns how many runs that were.
fn survives_kills(what: &str, settings: &[&str], kills: usize) -> usize {
    let setup = Setup::new();
    succeed(setup.run("unbroken", 1, settings));
    // The particles are in the cache by now, as for those that are killed.
    let started = Instant::now();
    succeed(setup.run("timed", 2, settings));
    let whole = started.elapsed().as_secs_f64();
    let out = setup.file("broken");
    let (mut killed, mut runs, mut seed) = (0, 0, 7_u64);
    while killed < kills {
        seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let part = (seed >> 11) as f64 / (1_u64 << 53) as f64;
        let threads = [1, 2, 4][killed % 3];
        // Killed before its first checkpoint, a run has nothing to go on from, and nothing that could be lost.
        let mut command = if out.join("checkpoint.h5").exists() {
            setup.resume("broken", threads)
        } else {
            setup.run("broken", threads, settings)
        };
        let mut child = command.spawn().expect("the program can be started");
        std::thread::sleep(Duration::from_secs_f64(0.7 * part * whole));
        child.kill().expect("children can be killed");
        let output = child.wait_with_output().expect("it ends");
        match output.status.code() {
            None => killed += 1,
            Some(0) => {
                assert_same(&setup.file("unbroken"), &out, what);
                std::fs::remove_dir_all(&out).expect("the folder can be removed");
                runs += 1;
            }
            Some(code) => panic!("{what}: code {code}: {}", String::from_utf8_lossy(&output.stderr)),
        }
    }
    let last = if out.join("checkpoint.h5").exists() {
        setup.resume("broken", 1)
    } else {
        setup.run("broken", 1, settings)
    };
    succeed(last);
    assert_same(&setup.file("unbroken"), &out, what);
    runs + 1
}

#[test]
fn nothing_is_lost_by_a_few_kills() {
    for (what, settings) in [("rigid", RIGID), ("solid", SOLID), ("shell", SHELL)] {
        survives_kills(what, settings, 2);
    }
}

/// The figure that is promised: 200 kills over three kinds of walls.
fn survives_many_kills(what: &str, settings: &[&str], kills: usize) {
    let runs = survives_kills(what, settings, kills);
    println!("{what}: {kills} kills, {runs} runs came to their end, all as the unbroken one");
}

#[test]
#[ignore = "takes minutes; `cargo test --release -p vaso-driver --test resume -- --ignored --nocapture`"]
fn a_rigid_vessel_loses_nothing_by_68_kills() {
    survives_many_kills("rigid", RIGID, 68);
}

#[test]
#[ignore = "takes minutes; `cargo test --release -p vaso-driver --test resume -- --ignored --nocapture`"]
fn a_solid_wall_loses_nothing_by_66_kills() {
    survives_many_kills("solid", SOLID, 66);
}

#[test]
#[ignore = "takes minutes; `cargo test --release -p vaso-driver --test resume -- --ignored --nocapture`"]
fn a_shell_loses_nothing_by_66_kills() {
    survives_many_kills("shell", SHELL, 66);
}

/// Ctrl-C and termination end a run in order, after its step.
#[test]
fn an_interrupted_run_says_how_to_go_on_and_does() {
    let setup = Setup::new();
    succeed(setup.run("unbroken", 2, RIGID));
    let out = setup.file("broken");
    let signals = [("-INT", setup.run("broken", 2, RIGID), 10), ("-TERM", setup.resume("broken", 1), 25)];
    for (signal, command, rows) in signals {
        let child = start_and_wait(command, &out, rows).expect("the run lasts for longer");
        let sent = std::process::Command::new("kill").arg(signal).arg(child.id().to_string()).status();
        assert!(sent.is_ok_and(|s| s.success()));
        let output = child.wait_with_output().expect("it ends");
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(130), "{signal}: {text}");
        assert!(text.contains("interrupted at") && text.contains("vaso resume"), "{signal}: {text}");
        let text = std::fs::read_to_string(out.join("summary.json")).expect("the summary is there");
        assert!(text.contains("\"interrupted\""), "{text}");
    }
    succeed(setup.resume("broken", 2));
    assert_same(&setup.file("unbroken"), &out, "interrupted");

    // A finished run stays as it is.
    let before = support::content(&out);
    let mut again = setup.resume("broken", 1);
    assert!(again.status().is_ok_and(|status| status.success()));
    assert!(support::content(&out) == before, "a finished run has been changed");
    let text = fail(setup.run("broken", 1, RIGID), 2, &["--force"]);
    assert!(text.contains("finished"), "{text}");
}

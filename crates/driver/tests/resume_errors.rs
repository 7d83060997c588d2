//! What `vaso resume` refuses, and that nothing is lost by it.
#![cfg(unix)]

mod support;

use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;
use support::{RIGID, Setup, assert_same, content, fail, start_and_wait, succeed};

/// A case with an unbroken run in `unbroken`, and one killed on its way in `broken`.
fn broken() -> Setup {
    let setup = Setup::new();
    succeed(setup.run("unbroken", 2, RIGID));
    let out = setup.file("broken");
    let mut child =
        start_and_wait(setup.run("broken", 2, RIGID), &out, 15).expect("the run lasts for longer");
    child.kill().expect("children can be killed");
    child.wait().expect("it ends");
    setup
}

/// `vaso resume` is refused with these words, and leaves all files as they are.
fn refused(setup: &Setup, words: &[&str]) {
    let before = content(&setup.file("broken"));
    fail(setup.resume("broken", 2), 2, words);
    assert!(content(&setup.file("broken")) == before, "{words:?}: files have been changed");
}

#[test]
fn what_has_changed_is_refused_by_name_and_nothing_is_lost() {
    let setup = broken();
    let checkpoint = setup.file("broken/checkpoint.h5");

    let sound = std::fs::read(&checkpoint).expect("the checkpoint is there");
    for length in [0, 7, 600, sound.len() / 2, sound.len() * 9 / 10] {
        std::fs::write(&checkpoint, &sound[..length]).expect("files can be written");
        refused(&setup, &["checkpoint.h5", "vaso run", "can still be read"]);
    }
    let mut flipped = sound.clone();
    // Within the numbers, which are most of the file.
    flipped[sound.len() / 2] ^= 0x10;
    std::fs::write(&checkpoint, &flipped).expect("files can be written");
    refused(&setup, &["checkpoint.h5", "digest"]);
    vaso_io::Archive::new("checkpoint", 1).write(&checkpoint).expect("archives can be written");
    refused(&setup, &["checkpoint.h5", "version \"1\"", "version \"2\""]);
    std::fs::remove_file(&checkpoint).expect("files can be removed");
    refused(&setup, &["checkpoint.h5", "nothing to go on from", "vaso run"]);
    std::fs::write(&checkpoint, &sound).expect("files can be written");

    for (name, from, to, words) in [
        ("case.toml", "3.6 mPa s", "3.7 mPa s", ["case.toml", "`blood`"]),
        ("case.toml", "cycles = 2", "cycles = 3", ["case.toml", "`run`"]),
        ("in.csv", "0.25", "0.26", ["case.toml", "`opening`"]),
        ("case.toml", "density", "denisty", ["denisty", "density"]),
    ] {
        let text = std::fs::read_to_string(setup.file(name)).expect("files can be read");
        let changed = text.replacen(from, to, 1);
        assert_ne!(changed, text);
        std::fs::write(setup.file(name), changed).expect("files can be written");
        refused(&setup, &words);
        std::fs::write(setup.file(name), text).expect("files can be written");
    }
    let surface = std::fs::read(setup.file("pipe.stl")).expect("files can be read");
    let mut renamed = surface.clone();
    renamed[10] ^= 1; // in the title, which says nothing of the vessel
    std::fs::write(setup.file("pipe.stl"), renamed).expect("files can be written");
    refused(&setup, &["pipe.stl", "not the one the run began with"]);
    std::fs::write(setup.file("pipe.stl"), surface).expect("files can be written");

    for missing in ["case.toml", "pipe.stl", "in.csv", "broken/fluid.vtkhdf", "broken/openings.csv"] {
        let aside = setup.file("aside");
        std::fs::rename(setup.file(missing), &aside).expect("files can be moved");
        refused(&setup, &[missing.rsplit('/').next().expect("a name")]);
        std::fs::rename(&aside, setup.file(missing)).expect("files can be moved");
    }
    fail(setup.resume("nowhere", 1), 2, &["nowhere", "no such folder"]);

    // A comment is no change; with all back in place the run goes on as if nothing had been.
    let text = std::fs::read_to_string(setup.file("case.toml")).expect("files can be read");
    std::fs::write(setup.file("case.toml"), format!("# on\n{text}")).expect("files can be written");
    succeed(setup.resume("broken", 2));
    assert_same(&setup.file("unbroken"), &setup.file("broken"), "refused and resumed");
}

/// Whether this user may write where the permissions say no, as an administrator may.
fn is_above_permissions(folder: &Path) -> bool {
    let probe = folder.join("probe");
    let may = std::fs::write(&probe, "").is_ok();
    let _ = std::fs::remove_file(probe);
    may
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error_and_loses_nothing() {
    let setup = broken();
    let out = setup.file("broken");
    let permit = |mode| {
        std::fs::set_permissions(&out, std::fs::Permissions::from_mode(mode))
            .expect("permissions can be set");
    };
    permit(0o555);
    if is_above_permissions(&out) {
        println!("skipped: this user may write to read-only folders");
    } else {
        refused(&setup, &["broken", "check who owns the folder"]);
    }
    permit(0o755);

    // What permissions do not keep an administrator from, a folder in the way does: the draft of the summary cannot be made.
    std::fs::create_dir(out.join("summary.json.new.tmp")).expect("folders can be made");
    refused(&setup, &["summary.json"]);
    std::fs::remove_dir(out.join("summary.json.new.tmp")).expect("folders can be removed");
    // And here the draft of the checkpoint, when the run is on its way: the one before stays.
    std::fs::create_dir(out.join("checkpoint.h5.new.tmp")).expect("folders can be made");
    let checkpoint = std::fs::read(out.join("checkpoint.h5")).expect("the checkpoint is there");
    fail(setup.resume("broken", 2), 1, &["checkpoint.h5"]);
    assert!(std::fs::read(out.join("checkpoint.h5")).expect("it stays") == checkpoint);
    std::fs::remove_dir(out.join("checkpoint.h5.new.tmp")).expect("folders can be removed");

    succeed(setup.resume("broken", 2));
    assert_same(&setup.file("unbroken"), &out, "refused and resumed");
}

/// A limit on the size of files stands for a full disk: what is written fails on its way.
#[test]
fn a_full_disk_ends_a_run_in_order_and_loses_nothing() {
    let setup = broken();
    let out = setup.file("broken");
    let checkpoint = std::fs::metadata(out.join("checkpoint.h5")).expect("the checkpoint is there").len();
    // The signal would end the program before it can say anything; without it writing fails as on a full disk.
    let limited = |blocks: u64| {
        let command = setup.resume("broken", 2);
        let words = std::iter::once(command.get_program()).chain(command.get_args());
        let words: Vec<String> = words.map(|w| format!("'{}'", w.to_string_lossy())).collect();
        let mut shell = Command::new("bash");
        shell.arg("-c").arg(format!("trap '' XFSZ; ulimit -f {blocks}; exec {}", words.join(" ")));
        shell.stderr(std::process::Stdio::piped());
        shell
    };
    let text = fail(limited(checkpoint / 2048), 1, &["limits the file size"]);
    assert!(text.contains("vtkhdf") || text.contains("checkpoint.h5"), "{text}");
    let series = vaso_io::read_series_info(&out.join("fluid.vtkhdf")).expect("the frames can be read");
    assert!(!series.times.is_empty());
    succeed(setup.resume("broken", 2));
    assert_same(&setup.file("unbroken"), &out, "after a full disk");
}

//! `vaso particles` at the terminal: bodies, flags, files, and what is refused.

use assert_cmd::Command;
use serde_json::Value;
use std::path::{Path, PathBuf};
use vaso_geometry::{LengthUnit, prepare, read_surface};
use vaso_io::SeriesReader;

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases").join(name)
}

/// A folder with the pipe case, and `vaso particles` on it at a coarse spacing.
fn pipe() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder can be had");
    for file in ["case.toml", "pipe.stl"] {
        std::fs::copy(case("pipe").join(file), folder.path().join(file)).expect("cases can be copied");
    }
    folder
}

fn particles(what: &Path) -> Command {
    let mut vaso = Command::new(env!("CARGO_BIN_EXE_vaso"));
    vaso.arg("particles").arg(what).args(["--spacing", "0.9 mm", "--quiet"]);
    vaso
}

fn json(command: &mut Command) -> Value {
    let output = command.arg("--json").output().expect("the program can be started");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).expect("standard output is JSON and nothing else")
}

/// Ends with code 2 and these words.
fn refused(command: &mut Command, words: &[&str]) {
    let output = command.output().expect("the program can be started");
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{text}");
    for word in words {
        assert!(text.contains(word), "\"{word}\" is not in {text}");
    }
}

fn float(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

#[test]
fn particles_come_with_their_quality_and_are_not_written_over() {
    let folder = pipe();
    let report = json(&mut particles(folder.path()));
    let fluid = &report["quality"]["fluid"];
    assert_eq!((&fluid["outside"], &report["generator"]), (&0.into(), &"relaxed-lattice".into()));
    assert!(float(&fluid["nearest_neighbor_min"]) > 0.65, "{fluid}");
    assert_eq!(report["blocks"], Value::Null);
    assert_eq!(report["wall"]["open_ends"], "collar");

    let file = folder.path().join("out/particles.json");
    let written = std::fs::read_to_string(&file).expect("it is there");
    assert_eq!(serde_json::from_str::<Value>(&written).expect("it is JSON"), report);
    std::fs::write(&file, "mine").expect("it can be written");
    refused(&mut particles(folder.path()), &["particles", "--force"]);
    assert_eq!(std::fs::read_to_string(&file).expect("it is there"), "mine");
    // From the cache: the same numbers, seconds included.
    assert_eq!(json(particles(folder.path()).arg("--force")), report);
}

/// A wall on purpose, by every end, beside a shell; the columns say which particles are held.
#[test]
fn bare_surfaces_get_all_bodies() {
    let folder = pipe();
    let surface = folder.path().join("pipe.stl");
    let bare = |ends: &str| {
        let mut vaso = particles(&surface);
        vaso.args([
            "--unit",
            "mm",
            "--bodies",
            "fluid,wall,shell",
            "--wall-thickness",
            "1.8 mm",
            "--ends",
            ends,
        ]);
        vaso.arg("--out").arg(folder.path().join(ends));
        vaso
    };
    let closed = json(&mut bare("closest-cap"));
    let collared = json(&mut bare("collar"));
    for (report, ends) in [(&closed, "closest-cap"), (&collared, "collar")] {
        assert_eq!(report["wall"]["open_ends"], ends);
        assert!((float(&report["wall"]["thickness_m"]) - 1.8e-3).abs() < 1e-12);
    }
    let walls = [&closed, &collared].map(|report| float(&report["particles"]["wall"]));
    // The collar is 2.34 mm long at each end of 31.75 mm.
    assert!((walls[1] / walls[0] - 1.147).abs() < 0.03, "{walls:?}");

    // One layer, its number by the area and its areas the wall's.
    let shell = &closed["shell"];
    let area = float(&shell["wall_area_m2"]);
    assert_eq!(float(&closed["particles"]["shell"]), (area / (0.9e-3 * 0.9e-3)).ceil());
    assert!((float(&shell["area_m2"]) / area - 1.0).abs() < 1e-12);
    assert!(float(&closed["quality"]["shell"]["nearest_neighbor_cv"]) < 0.06);

    let frame = SeriesReader::open(&folder.path().join("closest-cap/particles.vtkhdf"))
        .and_then(|reader| reader.frame(0))
        .expect("the particles can be read");
    let column = |name: &str| frame.scalar(name).unwrap_or_else(|| panic!("no column {name}"));
    let (body, clamped, curvature) = (column("Body"), column("Clamped"), column("CurvatureMax"));
    let held = |kind: f64| body.iter().zip(clamped).filter(|(b, c)| **b == kind && **c == 1.0).count();
    assert_eq!(held(0.0), 0);
    assert_eq!(Some(held(1.0) as u64), closed["wall"]["clamped"].as_u64());
    assert!(held(1.0) > 0 && held(2.0) > 0);
    for (i, x) in frame.position.iter().enumerate().filter(|(i, _)| body[*i] == 2.0) {
        // 1/R on a pipe of R = 3.175 mm; particles lie on it.
        assert!((curvature[i] * 3.175e-3 - 1.0).abs() < 0.05, "{}", curvature[i]);
        assert!((x.truncate().length() - 3.175e-3).abs() < 5e-6);
        assert!((column("Thickness")[i] / 1.8e-3 - 1.0).abs() < 1e-6 && column("Area")[i] > 0.0);
    }
    // No cache beside somebody's surface.
    assert!(!folder.path().join(".vaso-cache").exists());
}

#[test]
fn walls_can_be_filled_as_solids_and_as_shells() {
    let folder = pipe();
    let walls = |model: &str| {
        let mut vaso = Command::new(env!("CARGO_BIN_EXE_vaso"));
        vaso.arg("particles").arg(folder.path()).args(["--quiet", "--set", "particles.spacing=0.9 mm"]);
        vaso.args(["--set", &format!("wall.model={model}"), "--set", "wall.thickness=1.8 mm"]);
        vaso.args(["--set", "wall.young_modulus=0.5 MPa", "--out"]).arg(folder.path().join(model));
        vaso
    };
    let wall = json(&mut walls("solid"));
    assert_eq!(wall["wall"]["open_ends"], "collar");
    assert_eq!((&wall["quality"]["shell"], &wall["shell"]), (&Value::Null, &Value::Null));
    // A mid-surface of radius 3.175 + 0.9 mm has that much more area than the lumen, without the collars that blood calls for.
    let shell = json(walls("shell").args(["--set", "wall.open_ends=closest-cap"]));
    assert_eq!(
        (&shell["shell"]["reference"], &shell["particles"]["wall"]),
        (&"mid-surface".into(), &0.into())
    );
    let stretch = float(&shell["shell"]["area_m2"]) / float(&shell["shell"]["wall_area_m2"]);
    assert!((stretch / (1.0 + 0.9 / 3.175) - 1.0).abs() < 0.01, "{stretch}");
}

#[test]
fn blocks_are_told_of_and_kept_with_what_became_of_them() {
    let folder = pipe();
    let blocks = |out: &str| {
        let mut vaso = particles(folder.path());
        vaso.args(["--generator", "multiblock", "--topology", "nine-block", "--smoothing", "5", "--out"]);
        vaso.arg(folder.path().join(out));
        vaso
    };
    let made = json(&mut blocks("a"));
    assert_eq!(
        (&made["generator"], &made["blocks"]["topology"]),
        (&"multiblock".into(), &"nine-block".into())
    );
    assert_eq!(made["blocks"]["smoothing_sweeps"], 5);
    assert!(float(&made["quality"]["fluid"]["volume_cv"]) > 0.0 && float(&made["blocks"]["cells"]) > 100.0);
    assert_eq!(json(&mut blocks("b")), made);
}

#[test]
fn the_outer_surface_is_written_in_the_unit_of_the_inner() {
    let folder = pipe();
    let file = folder.path().join("outer.stl");
    let extrude = |out: &str, by: &[&str]| {
        let mut vaso = particles(&folder.path().join("pipe.stl"));
        vaso.args(["--unit", "mm", "--bodies", "shell", "--out"]).arg(folder.path().join(out));
        vaso.arg("--extrude").arg(&file).args(by);
        vaso
    };
    refused(&mut extrude("out", &[]), &["--extrude-by"]);
    refused(&mut extrude("out", &["--extrude-by=-1 mm"]), &["outer.stl"]);
    refused(&mut extrude("out", &["--extrude-by", "0.6"]), &["--extrude-by", "unit"]);
    assert!(!file.exists() && !folder.path().join("out").exists());
    let report = json(&mut extrude("out", &["--extrude-by", "0.6 mm"]));
    assert_eq!(
        (&report["extrusion"]["sound"], &report["extrusion"]["intersections"]),
        (&true.into(), &0.into())
    );
    let outer =
        read_surface(&file).and_then(|s| prepare(s, Some(LengthUnit::Millimetre))).expect("it can be read");
    let expected = std::f64::consts::PI * 3.775e-3 * 3.775e-3 * 31.75e-3;
    assert!((outer.surface.volume() / expected - 1.0).abs() < 2e-3, "{}", outer.surface.volume());
    refused(&mut extrude("elsewhere", &["--extrude-by", "0.6 mm"]), &["outer.stl", "--force"]);
    assert!(!folder.path().join("elsewhere").exists());
}

#[test]
fn generators_are_compared_by_figures_and_pictures() {
    let folder = pipe();
    let compare = |list: &str| {
        let mut vaso = particles(folder.path());
        vaso.args(["--compare", list]);
        vaso
    };
    refused(&mut compare("multiblock,grid"), &["\"grid\"", "relaxed-lattice"]);
    refused(compare("multiblock").args(["--generator", "multiblock"]), &["--compare"]);
    assert!(!folder.path().join("out").exists());

    let report = json(&mut compare("multiblock:o-grid,relaxed-lattice:bcc,multiblock:single"));
    let generators = report["generators"].as_array().expect("a list");
    let names: Vec<&str> = generators.iter().filter_map(|g| g["name"].as_str()).collect();
    assert_eq!(names, ["multiblock:o-grid", "relaxed-lattice:bcc", "multiblock:single"]);
    for generator in generators {
        let count = generator["quality"]["count"].as_u64();
        for histogram in ["nearest_neighbor", "volume"] {
            let counts = generator[histogram]["counts"].as_array().expect("a list");
            assert_eq!(Some(counts.iter().filter_map(Value::as_u64).sum()), count);
        }
        assert!(float(&generator["quality"]["seconds"]) > 0.0);
    }
    let spread = |k: usize| float(&generators[k]["quality"]["volume_cv"]);
    assert!(spread(1) < 1e-12 && spread(0) < spread(2), "o-grid {}, single {}", spread(0), spread(2));

    let out = folder.path().join("out");
    let page = std::fs::read_to_string(out.join("compare.html")).expect("it is there");
    for needle in ["<script", "http://", "https://", "url(", "<link"] {
        assert!(!page.contains(needle), "the page contains {needle}");
    }
    // Two sets of histograms, a sheet with a section and a cut for each generator.
    assert_eq!(page.matches("class=\"bars\"").count(), 6);
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3);
    assert_eq!(page.matches("class=\"sheet\"").count(), 1);
    assert!(page.matches("<circle").count() > 60);
    for name in names {
        assert!(page.matches(name).count() >= 4, "{name} is missing from the page");
    }
    assert!(out.join("compare.json").exists() && !out.join("particles.json").exists());
    refused(&mut compare("multiblock"), &["compare.json", "--force"]);
}

#[test]
fn wrong_flags_end_with_two_and_write_nothing() {
    let folder = pipe();
    let surface = folder.path().join("pipe.stl");
    let out = folder.path().join("out");
    for (flags, word) in [
        (["--generator", "lattice"], "relaxed-lattice"),
        (["--topology", "o-grid"], "generator"),
        (["--lattice", "fcc"], "bcc"),
        (["--seed", "-1"], "numerics.seed"),
        (["--bodies", "fluid,skin"], "\"skin\""),
        (["--wall-thickness", "0.1 mm"], "wall.thickness"),
        (["--ends", "open"], "closest-cap"),
        (["--smoothing", "5"], "multiblock"),
        (["--unit", "ft"], "geometry.unit"),
        (["--extrude-by", "1 mm"], "--extrude"),
        (["--extrude", "no/such/folder/outer.stl"], "nothing says how far"),
    ] {
        for what in [folder.path(), &surface] {
            let flag = |pair: [&str; 2]| pair.map(str::to_owned).join("=");
            refused(particles(what).arg(flag(flags)).arg("--out").arg(&out), &[word]);
            assert!(
                !out.exists() && !folder.path().join(".vaso-cache").exists(),
                "{flags:?} wrote something"
            );
        }
    }
    let mut bare = Command::new(env!("CARGO_BIN_EXE_vaso"));
    refused(bare.arg("particles").arg(&surface), &["--spacing"]);
}

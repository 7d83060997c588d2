//! Whole files: those that load, and those whose every problem is listed in their head.

use std::fs;
use std::path::{Path, PathBuf};

use vaso_scene::material::{Damping, Ends, Fibers, Material, Viscosity};
use vaso_scene::{
    Condition, Coupling, Drive, Field, Generator, Interpolation, Lattice, OpenEnds, Precision, Problem,
    Profile, Scene, SceneError, Topology, Wall, WallBody,
};

fn good(name: &str) -> Scene {
    let path = Path::new("tests/good").join(name);
    Scene::load(&path, &[]).unwrap_or_else(|error| panic!("{}:\n{error}", path.display()))
}

fn waveform(drive: &Drive) -> &vaso_scene::Waveform {
    match drive {
        Drive::Waveform(waveform) => waveform,
        Drive::Constant(value) => panic!("a constant {value}"),
    }
}

#[test]
fn the_example_of_the_contract() {
    let scene = good("contract.toml");
    assert_eq!(scene.title, "Carotid bifurcation");
    assert_eq!(scene.geometry.unit.as_deref(), Some("mm"));
    assert_eq!(scene.particles.spacing, 5e-4);
    assert_eq!(scene.particles.generator, Generator::RelaxedLattice(Lattice::Cubic));
    assert_eq!(scene.blood.unwrap().viscosity, Viscosity::Newtonian { viscosity: 3.5e-3 });
    assert_eq!(scene.wall, Wall::Rigid);
    assert_eq!(scene.openings[0].near, [0.0, 0.0, -20.0]);
    let inlet = Condition::Velocity { profile: Profile::Parabolic, value: Drive::Constant(0.3) };
    assert_eq!(scene.openings[0].condition, inlet);
    let outlet = Condition::Windkessel {
        proximal_resistance: 1.5e8,
        distal_resistance: 1.2e9,
        compliance: 8e-10,
        initial_pressure: 85.0 * 133.322387415,
        periodic_start: false,
        distal_pressure: 0.0,
    };
    assert_eq!(scene.openings[1].condition, outlet);
    assert_eq!((scene.run.end_time, scene.run.period), (1.0, None));
    assert_eq!((scene.output.every, scene.output.table_every), (0.01, 0.001));
}

#[test]
fn defaults_fill_what_is_left_out() {
    let scene = good("smallest.toml");
    assert_eq!(scene.title, "good");
    assert_eq!(scene.directory, Path::new("tests/good"));
    assert_eq!(scene.geometry.unit, None);
    assert_eq!(scene.particles.relaxation_steps, 200);
    assert_eq!(scene.blood.unwrap().density, 1060.0);
    assert_eq!(scene.wall, Wall::Rigid);
    assert!(scene.openings.is_empty() && scene.probes.is_empty());
    assert_eq!(scene.numerics.precision, Precision::Mixed);
    assert_eq!((scene.numerics.sound_speed, scene.numerics.sound_speed_factor), (None, 10.0));
    assert_eq!((scene.numerics.density_blend, scene.numerics.reference_pressure), (None, None));
    assert_eq!((scene.numerics.smoothing_length, scene.numerics.seed), (1.3, 0));
    assert_eq!(scene.output.fields, [Field::Velocity, Field::Pressure]);
    assert_eq!((scene.output.every, scene.output.checkpoint_every), (0.01, None));
}

#[test]
fn a_pulsatile_case_with_everything() {
    let scene = good("pulsatile.toml");
    assert_eq!(scene.particles.generator, Generator::Multiblock(Topology::NineBlock));
    let law = Viscosity::CarreauYasuda {
        zero_shear_viscosity: 0.16,
        infinite_shear_viscosity: 0.0035,
        relaxation_time: 1.902,
        index: 0.22,
        transition: 0.64,
    };
    assert_eq!(scene.blood.unwrap().viscosity, law);
    let Wall::Shell(wall) = scene.wall else { panic!("not a shell") };
    let Material::NeoHookean(elasticity) = wall.material else { panic!("not neo-Hookean") };
    assert_eq!((elasticity.young_modulus, elasticity.poisson_ratio), (8e5, 0.49));
    assert_eq!((wall.ends, wall.damping, wall.pressure), (Ends::Sliding, Damping::None, None));
    assert_eq!(wall.support.map(|support| (support.stiffness, support.damping)), Some((1e6, 1e4)));
    assert_eq!(scene.openings.len(), 5);
    assert_eq!((scene.openings[0].ramp, scene.openings[1].ramp), (Some(0.0), None));

    let Condition::Flow { profile: Profile::Womersley, value } = &scene.openings[0].condition else {
        panic!("not a Womersley inflow")
    };
    let flow = waveform(value);
    assert_eq!(flow.period, Some(0.8));
    // The fifth row stands for the first one of the next beat. 300 ml/min are 5 ml/s.
    assert_eq!(flow.time, [0.0, 0.2, 0.4, 0.6]);
    for (read, ml_per_s) in flow.value.iter().zip([5.0, 15.0, 10.0, 4.0]) {
        assert!((read / 1e-6 - ml_per_s).abs() < 1e-12 * ml_per_s);
    }

    let Condition::Pressure { value } = &scene.openings[2].condition else { panic!("not a pressure") };
    assert_eq!(waveform(value).time, [0.0, 0.2, 0.4, 0.6]);
    assert_eq!(waveform(value).value, [1e4, 1.6e4, 1.2e4, 1.1e4]);

    let Condition::Windkessel { proximal_resistance, compliance, initial_pressure, distal_pressure, .. } =
        scene.openings[4].condition
    else {
        panic!("not a Windkessel")
    };
    assert!(
        (proximal_resistance / 1.383e8 - 1.0).abs() < 1e-15 && (compliance / 1.2504e-9 - 1.0).abs() < 1e-15
    );
    assert_eq!(initial_pressure, distal_pressure);

    assert_eq!(scene.numerics.seed, u64::MAX);
    assert_eq!(scene.numerics.reference_pressure, Some(80.0 * 133.322387415));
    assert!(scene.numerics.allow_mach);
    assert_eq!((scene.run.cycles, scene.run.end_time, scene.run.steady), (Some(3), 3.0 * 0.8, Some(0.01)));
    let fields = [Field::Velocity, Field::Displacement, Field::Wss, Field::Tawss, Field::Osi, Field::Rrt];
    assert_eq!(scene.output.fields, fields);
    assert_eq!(scene.probes[0].at, [0.1, 0.2, 0.3]);
}

#[test]
fn a_case_with_options() {
    let scene = good("options.toml");
    let Condition::Flow { profile, value } = &scene.openings[0].condition else { panic!("not a flow") };
    assert_eq!(*profile, Profile::Power { exponent: 9.0 });
    assert_eq!(waveform(value).interpolation, Interpolation::Monotone);
    let flow = waveform(value).value.clone();
    // The unit is named by the key here, by the header there, and is the same.
    let Condition::Flow { value, .. } = &scene.openings[1].condition else { panic!("not a flow") };
    assert_eq!(waveform(value).interpolation, Interpolation::Fourier { harmonics: 2 });
    assert_eq!(waveform(value).time, [0.0, 0.2, 0.4, 0.6]);
    for (read, expected) in
        [&flow, &waveform(value).value].into_iter().flatten().zip([5.0, 15.0, 10.0, 4.0].repeat(2))
    {
        assert!((read / 1e-6 - expected).abs() < 1e-12 * expected, "{read}");
    }
    let Condition::Pressure { value } = &scene.openings[2].condition else { panic!("not a pressure") };
    assert_eq!(waveform(value).interpolation, Interpolation::Linear);
    assert_eq!(waveform(value).value[1], 120.0 * 133.322387415);

    let outlets: Vec<_> = scene.openings.iter().map(|o| (o.coupling, o.backflow_damping)).collect();
    let none = (Coupling::Impedance, None);
    let expected = [
        none,
        none,
        none,
        (Coupling::Window { duration: 6e-3 }, Some(0.0)),
        (Coupling::Impedance, Some(0.5)),
    ];
    assert_eq!(outlets, expected);
    assert_eq!((scene.run.periodicity, scene.run.cycles), (Some(0.01), Some(8)));
    let fields =
        [Field::Wss, Field::Tawss, Field::Osi, Field::Rrt, Field::Ecap, Field::TransverseWss, Field::PeakWss];
    assert_eq!(scene.output.fields, fields);
    assert!(!fields[0].is_of_a_cycle() && fields[1..].iter().all(|field| field.is_of_a_cycle()));
    assert_eq!(scene.output.fractional_flow_reserve, [["cca", "ica"], ["cca", "eca"]]);
}

#[test]
fn a_wall_without_blood() {
    let scene = good("wall_alone.toml");
    assert_eq!(scene.blood, None);
    assert_eq!(scene.particles.generator, Generator::RelaxedLattice(Lattice::BodyCentred));
    let Wall::Solid(wall) = scene.wall else { panic!("not solid") };
    let Material::HolzapfelGasserOgden(Fibers { fiber_angle, fiber_dispersion, poisson_ratio, .. }) =
        wall.material
    else {
        panic!("no fibres")
    };
    assert_eq!((fiber_angle, fiber_dispersion, poisson_ratio), (29.0f64.to_radians(), 0.0, 0.45));
    let load = wall.pressure.unwrap();
    assert_eq!(waveform(&load).period, None);
    assert_eq!(waveform(&load).value, [0.0, 5e3, 1e4]);
    assert_eq!(scene.output.fields, [Field::Displacement, Field::VonMises]);
}

#[test]
fn viscosity_laws_bring_their_published_constants() {
    let law = |table: &str| {
        let scene =
            Scene::load(Path::new("tests/good/smallest.toml"), &[("blood.viscosity".into(), table.into())]);
        scene.unwrap().blood.unwrap().viscosity
    };
    let carreau = Viscosity::CarreauYasuda {
        zero_shear_viscosity: 0.056,
        infinite_shear_viscosity: 0.0035,
        relaxation_time: 3.313,
        index: 0.3568,
        transition: 2.0,
    };
    assert_eq!(law("{ model = \"carreau\" }"), carreau);
    let casson = Viscosity::Casson { yield_stress: 0.005, infinite_shear_viscosity: 0.0035 };
    assert_eq!(law("{ model = \"casson\" }"), casson);
    let power = Viscosity::PowerLaw { consistency: 0.017, index: 0.708 };
    assert_eq!(law("{ model = \"power-law\" }"), power);
    assert_eq!(law("{ model = \"newtonian\" }"), Viscosity::Newtonian { viscosity: 0.0035 });
}

#[test]
fn overrides_go_over_the_file() {
    let overrides = [
        ("particles.spacing", "0.25 mm"),
        ("opening.cca.value", "20 cm/s"),
        ("opening.1.compliance", "\"1 ml/mmHg\""),
        ("numerics.seed", "7"),
        ("wall.model", "rigid-shell"),
        ("run", "{ cycles = 2, period = \"1 s\" }"),
        ("output.fields", "[\"pressure\"]"),
    ];
    let overrides = overrides.map(|(key, value)| (key.to_owned(), value.to_owned()));
    let scene = Scene::load(Path::new("tests/good/contract.toml"), &overrides).unwrap();
    assert_eq!(scene.particles.spacing, 2.5e-4);
    let inlet = Condition::Velocity { profile: Profile::Parabolic, value: Drive::Constant(0.2) };
    assert_eq!(scene.openings[0].condition, inlet);
    let Condition::Windkessel { compliance, .. } = scene.openings[1].condition else {
        panic!("not a Windkessel")
    };
    assert_eq!(compliance, 1e-6 / 133.322387415);
    assert_eq!((scene.numerics.seed, scene.wall), (7, Wall::RigidShell));
    assert_eq!((scene.run.end_time, scene.run.cycles), (2.0, Some(2)));
    assert_eq!(scene.output.fields, [Field::Pressure]);
}

/// A switch of the generator or model at the command line leaves keys of the old one behind in the file.
#[test]
fn an_override_of_the_kind_passes_over_keys_of_the_old_one() {
    let load = |overrides: &[(&str, &str)]| {
        let overrides: Vec<_> = overrides.iter().map(|&(k, v)| (k.to_owned(), v.to_owned())).collect();
        Scene::load(Path::new("tests/good/pulsatile.toml"), &overrides)
    };
    let scene = load(&[("particles.generator", "relaxed-lattice"), ("particles.lattice", "bcc")]).unwrap();
    assert_eq!(scene.particles.generator, Generator::RelaxedLattice(Lattice::BodyCentred));
    let error =
        load(&[("particles.generator", "relaxed-lattice"), ("particles.topology", "o-grid")]).unwrap_err();
    assert!(error.to_string().contains("`particles.topology`"), "{error}");
    assert_eq!(error.problems.len(), 1, "{error}");
}

#[test]
fn walls_say_how_they_are_made_of_particles() {
    let load = |path: &str, overrides: &[(&str, &str)]| {
        let overrides: Vec<_> = overrides.iter().map(|&(k, v)| (k.to_owned(), v.to_owned())).collect();
        Scene::load(Path::new(path), &overrides)
    };
    let contract = "tests/good/contract.toml";
    assert_eq!(load(contract, &[]).unwrap().wall_body, WallBody::default());
    let scene = load(contract, &[("wall.thickness", "1 mm"), ("wall.open_ends", "boxes")]).unwrap();
    assert_eq!(scene.wall_body, WallBody { thickness: Some(1e-3), open_ends: Some(OpenEnds::Boxes) });
    let error = load(contract, &[("wall.model", "rigid-shell"), ("wall.open_ends", "boxes")]).unwrap_err();
    assert!(error.to_string().contains("\"closest-cap\", \"collar\""), "{error}");
    let blocks = [("particles.generator", "multiblock"), ("particles.smoothing_sweeps", "20")];
    assert_eq!(load(contract, &blocks).unwrap().particles.smoothing_sweeps, 20);
}

#[test]
fn a_bare_surface_needs_a_spacing_and_nothing_else() {
    let surface = Path::new("tests/files/vessel.stl");
    let spacing = ("particles.spacing".to_owned(), "0.5 mm".to_owned());
    let scene = Scene::of_surface(surface, &[spacing]).unwrap();
    assert_eq!((scene.title.as_str(), scene.geometry.surface.as_path()), ("vessel", surface));
    assert_eq!((scene.wall.clone(), scene.openings.len(), scene.particles.spacing), (Wall::Rigid, 0, 5e-4));
    let error = Scene::of_surface(surface, &[]).unwrap_err();
    assert!(error.to_string().contains("`particles`"), "{error}");
    assert!(Scene::of_surface(Path::new("tests/files/none.stl"), &[]).is_err());
}

fn refused(path: &str, overrides: &[(&str, &str)]) -> SceneError {
    let overrides: Vec<_> =
        overrides.iter().map(|&(key, value)| (key.to_owned(), value.to_owned())).collect();
    Scene::load(Path::new(path), &overrides).expect_err("a bad case was accepted")
}

#[test]
fn overrides_are_named_in_their_problems() {
    let table: &[(&str, &str, &str)] = &[
        ("particles.spacing", "5e-4", "a number without a unit, but a length needs one"),
        ("particles.spacing", "1 ms", "\"1 ms\" is a time, not a length"),
        (
            "opening.eca.value",
            "1 m/s",
            "there is no `eca` here\n  seen     1 m/s\n  allowed  `cca`, `ica`, or a number",
        ),
        ("opening.2.value", "1 m/s", "there is no `2` here"),
        ("opening.value", "1 m/s", "there is no `value` here"),
        ("run.end_time.unit", "s", "`unit` cannot be set in a string"),
        ("run..period", "1 s", "the key has an empty part"),
        ("wal.model", "shell", "did you mean `wall`?"),
        ("opening.cca.compliance", "1 ml/mmHg", "has no meaning with condition = \"velocity\""),
    ];
    for &(key, value, fragment) in table {
        let error = refused("tests/good/contract.toml", &[(key, value)]);
        assert_eq!(error.problems.len(), 1, "{error}");
        let text = error.to_string();
        assert!(text.starts_with(&format!("--set {key}={value}: `")), "{text}");
        assert!(text.contains(fragment), "{text}");
        assert_eq!((error.problems[0].line, error.problems[0].column), (None, None));
    }
}

#[test]
fn a_case_is_a_folder_or_a_file() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("case.toml"), fs::read_to_string("tests/good/smallest.toml").unwrap())
        .unwrap();
    let surface = ("geometry.surface".to_owned(), fs::canonicalize("tests/files/vessel.stl").unwrap());
    let overrides = [(surface.0, surface.1.to_string_lossy().into_owned())];
    let by_folder = Scene::load(folder.path(), &overrides).unwrap();
    let by_file = Scene::load(&folder.path().join("case.toml"), &overrides).unwrap();
    assert_eq!(by_folder, by_file);
    assert_eq!(by_folder.directory, folder.path());

    let error = refused("tests/files/absent", &[]);
    assert!(error.to_string().starts_with("tests/files/absent: cannot be read: "), "{error}");
}

/// The problems a file says it has, one to a line: `#! place key message`. The place is `line:column`, with the name of
/// the file before it for another file, and `-` stands for no place or no key.
fn expected(text: &str) -> Vec<[String; 3]> {
    let lines = text.lines().filter_map(|line| line.strip_prefix("#! "));
    lines
        .map(|line| {
            let mut parts = line.splitn(3, ' ').map(str::to_owned);
            std::array::from_fn(|_| parts.next().expect("a place, a key and a message"))
        })
        .collect()
}

/// A problem in the form of [`expected`].
fn found(problem: &Problem, case: &Path) -> [String; 3] {
    let or_dash = |text: String| if text.is_empty() { "-".to_owned() } else { text };
    let other =
        (problem.file != case).then(|| problem.file.file_name().unwrap().to_string_lossy().into_owned());
    let numbers = [problem.line, problem.column].into_iter().flatten().map(|number| number.to_string());
    let place = other.into_iter().chain(numbers).collect::<Vec<_>>().join(":");
    [or_dash(place), or_dash(problem.key.clone()), problem.message.clone()]
}

#[test]
fn bad_files_are_refused_for_exactly_the_reasons_they_list() {
    let mut files: Vec<PathBuf> =
        fs::read_dir("tests/bad").unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    assert!(files.len() >= 11, "only {} bad files", files.len());
    for file in files {
        let expected = expected(&fs::read_to_string(&file).unwrap());
        assert!(!expected.is_empty(), "{} lists no problems", file.display());
        let error = Scene::load(&file, &[]).expect_err(&format!("{} was accepted", file.display()));
        let found: Vec<_> = error.problems.iter().map(|problem| found(problem, &file)).collect();
        assert_eq!(found, expected, "{}:\n{error}", file.display());
    }
}

#[test]
fn a_problem_prints_as_a_block() {
    let error = refused("tests/bad/cycles.toml", &[]);
    let block = "tests/bad/cycles.toml:7:23: `blood.viscosity.model`: is not one of the words allowed
  7 | viscosity = { model = \"careau\" }
    |                       ^^^^^^^^
  allowed  \"newtonian\", \"carreau\", \"carreau-yasuda\", \"casson\", \"power-law\"
  advice   did you mean \"carreau\"?
";
    assert!(error.to_string().contains(block), "{error}");
}

#[test]
fn later_problems_name_their_place_too() {
    let overrides = [("opening.ica.near".to_owned(), "[9, 9, 9]".to_owned())];
    let scene = Scene::load(Path::new("tests/good/contract.toml"), &overrides).unwrap();
    let place = |key| {
        let problem = scene.problem(key, "is far from every opening");
        (problem.line, problem.column, problem.setting, problem.seen)
    };
    assert_eq!(place("opening.cca.near"), (Some(22), Some(8), None, "[0.0, 0.0, -20.0]".into()));
    assert_eq!(
        place("opening.ica.near"),
        (None, None, Some("opening.ica.near=[9, 9, 9]".into()), "[9, 9, 9]".into())
    );
    assert_eq!(place("opening.cca.ramp"), (Some(20), Some(1), None, String::new()));
    assert_eq!(place("wall.model"), (Some(18), Some(9), None, "\"rigid\"".into()));
    assert_eq!(place("probe.p.at"), (None, None, None, String::new()));
    let text = scene.problem("opening.cca.near", "is far from every opening").to_string();
    let start = "tests/good/contract.toml:22:8: `opening.cca.near`: is far from every opening
  22 | near = [0.0, 0.0, -20.0]         # any point near the opening, in the unit of the surface
     |        ^^^^^^^^^^^^^^^^^";
    assert_eq!(text, start);
}

#[test]
fn every_problem_says_what_to_do() {
    for file in fs::read_dir("tests/bad").unwrap() {
        let error = Scene::load(&file.unwrap().path(), &[]).unwrap_err();
        for problem in &error.problems {
            assert!(!problem.allowed.is_empty() || !problem.advice.is_empty(), "{problem}");
        }
    }
}

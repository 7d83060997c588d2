//! Loading a case: the file, the overrides, then what must agree with what.

use std::collections::BTreeMap;
use std::path::Path;

use crate::build::Builder;
use crate::document::{Source, case_file};
use crate::error::{Problem, SceneError};
use crate::files::Files;
use crate::material::{Blood, Wall};
use crate::opening::{ConditionKind, Opening};
use crate::overrides;
use crate::reader::Reader;
use crate::scene::{Field, Output, Run, Scene};
use crate::schema::KEYS;
use crate::section::Section;
use crate::words::Word;

/// Reads a case from disk.
pub(crate) fn load(path: &Path, overrides: &[(String, String)]) -> Result<Scene, SceneError> {
    let file = case_file(path);
    let overrides = overrides.to_vec();
    match std::fs::read_to_string(&file) {
        Ok(text) => scene(Source::new(file, text, overrides, Files::Disk)),
        Err(error) => {
            let allowed = "a case folder, or the path of a case.toml in UTF-8".into();
            let message = format!("cannot be read: {error}");
            Err(SceneError { problems: vec![Problem { allowed, message, ..Problem::of_file(file) }] })
        }
    }
}

/// What stands in the case of a bare surface: enough to be complete, and nothing about its openings.
const BARE: &str = "[blood]\n[run]\nend_time = \"1 s\"\n";

pub(crate) fn of_surface(surface: &Path, overrides: &[(String, String)]) -> Result<Scene, SceneError> {
    let name = |part: Option<&std::ffi::OsStr>| {
        toml::Value::from(part.unwrap_or_default().to_string_lossy().as_ref())
    };
    let (title, file) = (name(surface.file_stem()), name(surface.file_name()));
    let text = format!("{BARE}[case]\ntitle = {title}\n[geometry]\nsurface = {file}\n");
    scene(Source::new(surface.to_owned(), text, overrides.to_vec(), Files::Disk))
}

/// From the text of a case to its scene.
pub(crate) fn scene(source: Source) -> Result<Scene, SceneError> {
    let mut root = source.parse().map_err(|problems| SceneError { problems })?;
    let overriding = overrides::apply(&source, &mut root);
    let directory = match source.file.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let mut reader = Reader { source: &source, schema: KEYS, directory, problems: overriding };
    let sections = reader.root(&root);
    let mut builder = Builder { source: &source, problems: reader.problems };
    let scene = builder.scene(&sections, directory);
    if builder.problems.is_empty() {
        return Ok(scene.expect("a part that cannot be built has been reported"));
    }
    Err(in_order(builder.problems, &source))
}

/// Problems in the order in which they stand in the file, then those of other files, then those of overrides.
pub(crate) fn in_order(mut problems: Vec<Problem>, source: &Source) -> SceneError {
    problems.sort_by_key(|problem| {
        (
            problem.setting.is_some(),
            problem.file != source.file,
            problem.file.clone(),
            problem.line,
            problem.column,
        )
    });
    SceneError { problems }
}

impl Builder<'_> {
    fn scene(&mut self, root: &Section, directory: &Path) -> Option<Scene> {
        let run = root.section("run").map(|section| self.run(section));
        let blood = root.section("blood").map(|section| self.blood(section));
        let wall =
            root.section("wall").and_then(|section| self.wall(section, root.has("blood"), run.as_ref()));
        let openings: Vec<Option<Opening>> =
            root.sections("opening").iter().map(|section| self.opening(section, run.as_ref())).collect();
        let probes = root.sections("probe").iter().map(|section| self.probe(section)).collect();
        let output =
            root.section("output").map(|section| self.output(section, &run, root.has("blood"), &wall));
        self.flow_reserve(root, run.as_ref());
        self.unique_names(root.sections("opening"));
        self.unique_names(root.sections("probe"));
        self.outlets(root);
        self.something_to_simulate(root, &wall);
        Some(Scene {
            file: self.source.file.clone(),
            directory: directory.to_owned(),
            title: self.title(root.section("case")?, directory),
            geometry: self.geometry(root.section("geometry")?)?,
            particles: self.particles(root.section("particles")?)?,
            blood: blood.map_or(Some(None), |blood: Option<Blood>| blood.map(Some))?,
            wall: wall?,
            wall_body: root.section("wall").map(|section| self.wall_body(section)).unwrap_or_default(),
            openings: openings.into_iter().collect::<Option<_>>()?,
            probes,
            numerics: self.numerics(root.section("numerics")?)?,
            run: run?,
            output: output?,
            written: self.written(root),
        })
    }

    fn written(&self, root: &Section) -> BTreeMap<String, Problem> {
        let mut written = BTreeMap::new();
        root.visit_written(&mut |key, spot| {
            written.insert(key.to_owned(), self.source.problem(spot, key, ""));
        });
        written
    }

    fn unique_names(&mut self, sections: &[Section]) {
        let mut taken: BTreeMap<&str, &Section> = BTreeMap::new();
        for section in sections {
            let Some(name) = section.text("name") else { continue };
            let first = *taken.entry(name).or_insert(section);
            if !std::ptr::eq(first, section) {
                let line = self.source.problem(first.spot("name"), "", "").line;
                let place = line.map_or_else(String::new, |line| format!(" in line {line}"));
                self.report(
                    section,
                    "name",
                    format!("the name is taken{place}"),
                    "a name for each",
                    "rename one",
                );
            }
        }
    }

    /// Blood that is nearly incompressible must be free to leave: where every opening prescribes its flow, the
    /// slightest mismatch of their sum would drive the pressure without bound.
    fn outlets(&mut self, root: &Section) {
        let sections = root.sections("opening");
        let Some(first) = sections.first() else { return };
        if !root.has("blood") {
            let problem = self.source.problem(&first.spot, "opening", "needs blood to flow through it");
            let advice = "add `[blood]` or remove the openings".into();
            self.problems.push(Problem { advice, ..problem });
        }
        let prescribed = |section: &Section| {
            matches!(section.word("condition"), Some(ConditionKind::Velocity | ConditionKind::Flow))
        };
        if sections.iter().all(prescribed) {
            let problem = self.source.problem(&first.spot, "opening", "every opening prescribes its flow");
            let allowed = "at least one of condition \"pressure\", \"resistance\" or \"windkessel\"".into();
            self.problems.push(Problem {
                seen: String::new(),
                allowed,
                advice: "give the vessel an outlet".into(),
                ..problem
            });
        }
    }

    /// Pairs must be of two openings of the case, in a run of a whole cycle to take means over.
    fn flow_reserve(&mut self, root: &Section, run: Option<&Run>) {
        let Some(output) = root.section("output") else { return };
        let names: Vec<&str> = root.sections("opening").iter().filter_map(|s| s.text("name")).collect();
        let key = "fractional_flow_reserve";
        if output.has(key) && run.is_some_and(|run| run.period.is_none() || !run.holds_cycles(1)) {
            let message = "is of means over a cycle, and needs `run.period` and a run of a whole one";
            self.report(output, key, message, "", "give the period, let the run last, or remove the key");
        }
        for pair in output.pairs(key) {
            if pair[0] == pair[1] {
                let message = format!("\"{}\" is compared with itself", pair[0]);
                self.report(
                    output,
                    key,
                    message,
                    "two different openings",
                    "name the proximal, then the distal one",
                );
            }
            for name in pair.iter().filter(|name| !names.contains(&name.as_str())) {
                let known = names.iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
                let advice = match vaso_units::nearest(name, names.iter().copied()) {
                    Some(near) => format!("did you mean \"{near}\"?"),
                    None => "name an `[[opening]]` of this file".to_owned(),
                };
                self.report(output, key, format!("there is no opening \"{name}\""), known, advice);
            }
        }
    }

    fn something_to_simulate(&mut self, root: &Section, wall: &Option<Wall>) {
        if !root.has("blood") && matches!(wall, Some(Wall::Rigid | Wall::RigidShell)) {
            let message = "is missing, and the wall does not move: there is nothing to simulate";
            let advice = "add `[blood]`, or a wall of model \"solid\" or \"shell\" with a `pressure`";
            self.report(root, "blood", message, "", advice);
        }
    }

    fn output(&mut self, section: &Section, run: &Option<Run>, blood: bool, wall: &Option<Wall>) -> Output {
        let elastic = matches!(wall, Some(Wall::Solid(_) | Wall::Shell(_)));
        let end_time = run.as_ref().map_or(f64::NAN, |run| run.end_time);
        let every = section.optional_number("every").unwrap_or(end_time / 100.0);
        let fields = section.words::<Field>("fields");
        for field in fields.iter().flatten() {
            let (available, needs) = match field {
                Field::Velocity | Field::Pressure | Field::Density | Field::Wss => (blood, "`[blood]`"),
                // A wall that could not be read has been reported already.
                Field::Displacement | Field::VonMises => {
                    (elastic || wall.is_none(), "a wall of model \"solid\" or \"shell\"")
                }
                _ if !blood => (false, "`[blood]`"),
                _ if run.as_ref().is_some_and(|run| run.period.is_none()) => (false, "`run.period`"),
                // The direction it is across is that of the cycle before.
                Field::TransverseWss => {
                    (run.as_ref().is_none_or(|run| run.holds_cycles(2)), "a run of two cycles")
                }
                _ => (run.as_ref().is_none_or(|run| run.holds_cycles(1)), "a run of a whole cycle"),
            };
            if !available {
                let message = format!("the field \"{}\" needs {needs}", field.word());
                self.report(section, "fields", message, "", "add it or remove the field");
            }
        }
        let default = || {
            let fluid = [Field::Velocity, Field::Pressure].into_iter().filter(|_| blood);
            fluid.chain([Field::Displacement, Field::VonMises].into_iter().filter(|_| elastic)).collect()
        };
        let mut fields = fields.unwrap_or_else(default);
        fields.sort_unstable();
        Output {
            every,
            table_every: section.optional_number("table_every").unwrap_or(every / 10.0),
            fields,
            checkpoint_every: section.optional_number("checkpoint_every"),
            fractional_flow_reserve: section.pairs("fractional_flow_reserve").to_vec(),
        }
    }
}

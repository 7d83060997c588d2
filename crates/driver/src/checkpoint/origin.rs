//! Which run a checkpoint belongs to: where its case is, and what it was when the run began.

use crate::case::Case;
use crate::error::DriverError;
use crate::plan::Plan;
use crate::world::WallParticles;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use vaso_fluid::Isa;
use vaso_io::KeyBuilder;

/// Where a run comes from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Origin {
    /// Version of the program.
    program: String,
    /// The case file: from the output folder where that lies in the folder of the case, otherwise from the root.
    case: String,
    /// `--set` overrides.
    overrides: Vec<(String, String)>,
    /// Tables of the case with digests of what they say.
    tables: Vec<(String, String)>,
    /// Digest of the surface file.
    surface: String,
    /// Digest of the particles of the wall.
    wall: String,
    /// Instruction set of the pair loops.
    isa: String,
}

impl Origin {
    /// That of a run of `case` with its results in the folder `out`, which is there.
    ///
    /// # Errors
    /// When the surface cannot be read any more.
    pub fn new(case: &Case, plan: &Plan, out: &Path) -> Result<Self, DriverError> {
        let surface = &case.scene.geometry.surface;
        let bytes = std::fs::read(surface).map_err(|error| {
            DriverError::input(format!("{}: cannot be read again: {error}", surface.display()))
        })?;
        let digest = |(name, text): (&str, String)| {
            (name.to_owned(), KeyBuilder::new(name).text(&text).finish().to_string())
        };
        Ok(Self {
            program: env!("CARGO_PKG_VERSION").to_owned(),
            case: path_from(out, &case.scene.file),
            overrides: case.overrides.clone(),
            tables: case.scene.contents().into_iter().map(digest).collect(),
            surface: KeyBuilder::new("surface").bytes(&bytes).finish().to_string(),
            wall: String::new(),
            isa: plan.isa.name().to_owned(),
        })
    }

    /// The same once the particles of its wall are made.
    #[must_use]
    pub fn in_wall(self, wall: &WallParticles) -> Self {
        Self { wall: wall.digest(), ..self }
    }

    /// The case file, for a run with its results in `out`.
    fn case_file(&self, out: &Path) -> PathBuf {
        let mut base = out.canonicalize().unwrap_or_else(|_| out.to_owned());
        let mut rest = Path::new(&self.case);
        while let Ok(inner) = rest.strip_prefix("..") {
            base.pop();
            rest = inner;
        }
        base.join(rest)
    }

    /// Reads the case again and plans it. Results of another processor or version are not the same bit for bit, which the plan then
    /// warns of.
    ///
    /// # Errors
    /// When the case is not where it was, is wrong, or says something else than when the run began.
    pub fn reopen(&self, out: &Path) -> Result<(Case, Plan), DriverError> {
        let file = self.case_file(out);
        if !file.is_file() {
            return Err(DriverError::input(format!(
                "{}: the case of the run in {} is not there any more; put it back, with its surface and waveforms",
                file.display(),
                out.display()
            )));
        }
        let case = Case::load(&file, &self.overrides)?;
        let mut plan = Plan::new(&case)?;
        self.check(&Self::new(&case, &plan, out)?, &case)?;
        match Isa::available().into_iter().find(|isa| isa.name() == self.isa) {
            Some(isa) => plan.isa = isa,
            None => plan.warnings.push(format!(
                "the run began with the instruction set \"{}\", which this processor does not have: it goes on with \"{}\", and its \
                 results differ in the last digits from those of an unbroken run",
                self.isa,
                plan.isa.name()
            )),
        }
        let program = env!("CARGO_PKG_VERSION");
        if self.program != program {
            plan.warnings.push(format!(
                "the run began with version {} of the program, this is {program}: results may differ from those of an unbroken run",
                self.program
            ));
        }
        Ok((case, plan))
    }

    /// Refuses to go on where something is not as it was when the run began; `now` is the origin of the same case today.
    fn check(&self, now: &Self, case: &Case) -> Result<(), DriverError> {
        let file = case.scene.file.display();
        let mut problems = Vec::new();
        for ((name, before), (_, today)) in self.tables.iter().zip(&now.tables) {
            if before != today {
                problems.push(format!(
                    "{file}: `{name}`: it says something else than when the run began; change it back, or start anew with `vaso run`"
                ));
            }
        }
        if self.surface != now.surface {
            problems.push(format!(
                "{}: the surface is not the one the run began with; put that back, or start anew with `vaso run`",
                case.scene.geometry.surface.display()
            ));
        }
        if problems.is_empty() { Ok(()) } else { Err(DriverError::Input { problems }) }
    }

    /// Refuses a wall that has been made anew and is another one.
    ///
    /// # Errors
    /// When its particles are not those the run began with.
    pub fn check_wall(&self, now: &Self, case: &Case) -> Result<(), DriverError> {
        if self.wall == now.wall {
            return Ok(());
        }
        Err(DriverError::input(format!(
            "{}: the particles of the wall are not those the run began with, although the case is: another version of the program has \
             made them; go on with that one, or start anew with `vaso run`",
            case.scene.file.display()
        )))
    }
}

/// The way from the folder `out` to `file`, where it goes up only; else from the root.
fn path_from(out: &Path, file: &Path) -> String {
    let whole = |path: &Path| path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let (out, file) = (whole(out), whole(file));
    let below = file.parent().and_then(|folder| out.strip_prefix(folder).ok());
    let path = match (below, file.file_name()) {
        (Some(below), Some(name)) => below.components().map(|_| "..").collect::<PathBuf>().join(name),
        _ => file,
    };
    path.to_string_lossy().into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_case_is_found_again_where_its_folder_has_moved() {
        let folder = tempfile::tempdir().expect("a temporary folder can be had");
        let case = folder.path().join("case");
        let out = case.join("runs/first");
        std::fs::create_dir_all(&out).expect("folders can be made");
        std::fs::write(case.join("case.toml"), "").expect("files can be written");
        let inside = path_from(&out, &case.join("case.toml"));
        assert_eq!(Path::new(&inside), Path::new("../../case.toml"));
        let outside = path_from(folder.path(), &case.join("case.toml"));
        assert!(Path::new(&outside).is_absolute());

        let origin = |case: &str| Origin {
            program: String::new(),
            case: case.to_owned(),
            overrides: Vec::new(),
            tables: Vec::new(),
            surface: String::new(),
            wall: String::new(),
            isa: String::new(),
        };
        std::fs::rename(&case, folder.path().join("moved")).expect("folders can be moved");
        assert!(origin(&inside).case_file(&folder.path().join("moved/runs/first")).is_file());
        assert!(!origin(&outside).case_file(folder.path()).is_file());
    }
}

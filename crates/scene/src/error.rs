//! What is wrong with a case, all at once.

use std::fmt;
use std::path::PathBuf;

/// Everything that is wrong with a case; never empty.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{}", paragraphs(problems))]
pub struct SceneError {
    /// The problems in the order of files and lines, those of overrides last.
    pub problems: Vec<Problem>,
}

fn paragraphs(problems: &[Problem]) -> String {
    problems.iter().map(Problem::to_string).collect::<Vec<_>>().join("\n")
}

/// One thing that is wrong, where it stands, and what to do about it.
///
/// Texts are empty where there is nothing to say.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// The file it stands in.
    pub file: PathBuf,
    /// Line from 1; `None` for the file as a whole and for overrides.
    pub line: Option<usize>,
    /// Column from 1, counted in characters.
    pub column: Option<usize>,
    /// The override it stands in, as `key=value`, if it does not come from a file.
    pub setting: Option<String>,
    /// The dotted key, such as `opening.cca.value`.
    pub key: String,
    /// What is wrong.
    pub message: String,
    /// The value as written.
    pub seen: String,
    /// What may be written.
    pub allowed: String,
    /// What to do.
    pub advice: String,
}

impl Problem {
    /// A problem of a file as a whole, with nothing said yet.
    pub(crate) fn of_file(file: PathBuf) -> Self {
        Self {
            file,
            line: None,
            column: None,
            setting: None,
            key: String::new(),
            message: String::new(),
            seen: String::new(),
            allowed: String::new(),
            advice: String::new(),
        }
    }
}

/// A block of lines: place, key and fault, then indented what was seen, what is allowed and what to do.
impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.setting {
            Some(setting) => write!(f, "--set {setting}: ")?,
            None => {
                write!(f, "{}", self.file.display())?;
                for number in [self.line, self.column].into_iter().flatten() {
                    write!(f, ":{number}")?;
                }
                f.write_str(": ")?;
            }
        }
        if !self.key.is_empty() {
            write!(f, "`{}`: ", self.key)?;
        }
        f.write_str(&self.message)?;
        for (label, text) in [("seen", &self.seen), ("allowed", &self.allowed), ("advice", &self.advice)] {
            if !text.is_empty() {
                write!(f, "\n  {label:<8} {text}")?;
            }
        }
        Ok(())
    }
}

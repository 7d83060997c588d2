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

/// The line a problem stands in, to be shown with a mark under what is wrong.
#[derive(Debug, Clone, PartialEq)]
pub struct Excerpt {
    /// The whole line as written.
    pub line: String,
    /// How many characters are wrong, from the column of the problem on.
    pub marked: usize,
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
    /// That line; `None` for overrides, for the file as a whole, for tables of numbers, and for lines too long to be shown.
    pub excerpt: Option<Excerpt>,
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
            excerpt: None,
            setting: None,
            key: String::new(),
            message: String::new(),
            seen: String::new(),
            allowed: String::new(),
            advice: String::new(),
        }
    }
}

/// Longest line shown with a mark \[characters\]; a longer one would wrap and its mark stand anywhere.
pub(crate) const LONGEST_LINE: usize = 160;

impl Problem {
    /// The line with its mark, where it has one that can be shown.
    fn marked_line(&self) -> Option<String> {
        let (excerpt, line, column) = (self.excerpt.as_ref()?, self.line?, self.column?);
        if excerpt.line.chars().count() > LONGEST_LINE {
            return None;
        }
        let number = line.to_string();
        // Tabs are as wide as each terminal likes; a blank for each keeps the mark in its place.
        let text = excerpt.line.replace(|c: char| c.is_control(), " ");
        let (gutter, before) = (" ".repeat(number.len()), " ".repeat(column - 1));
        let mark = "^".repeat(excerpt.marked.max(1));
        Some(format!("\n  {number} | {text}\n  {gutter} | {before}{mark}"))
    }
}

/// A block of lines: place, key and fault, the line with a mark or what was seen, then what is allowed and what to do.
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
        let nothing = String::new();
        let seen = match self.marked_line() {
            Some(line) => {
                f.write_str(&line)?;
                &nothing
            }
            None => &self.seen,
        };
        for (label, text) in [("seen", seen), ("allowed", &self.allowed), ("advice", &self.advice)] {
            if !text.is_empty() {
                write!(f, "\n  {label:<8} {text}")?;
            }
        }
        Ok(())
    }
}

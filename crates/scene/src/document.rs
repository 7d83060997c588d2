//! The text of a case as a tree whose every node knows where it was written.

use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::de::{DeArray, DeTable, DeValue};

use crate::error::{Excerpt, LONGEST_LINE, Problem};
use crate::files::Files;

/// Where a node was written.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Spot {
    /// Bytes of the case file.
    File(Range<usize>),
    /// Number of the override.
    Override(usize),
    /// Not written anywhere.
    Nowhere,
}

/// Faults of syntax reported; a file that is no TOML has one at every character.
const MOST_SYNTAX_PROBLEMS: usize = 20;

/// A value with the place it was written at.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub(crate) content: Content,
    pub(crate) spot: Spot,
}

/// A value of the file.
#[derive(Debug, Clone)]
pub(crate) enum Content {
    Text(String),
    /// Saturated where the file has more digits.
    Integer(i128),
    Float(f64),
    Flag(bool),
    Date,
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key with its value.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) key: String,
    pub(crate) key_spot: Spot,
    pub(crate) node: Node,
}

impl Content {
    /// What the value is, with an article.
    pub(crate) fn kind(&self) -> &'static str {
        match self {
            Self::Text(_) => "a string",
            Self::Integer(_) => "an integer",
            Self::Float(_) => "a number",
            Self::Flag(_) => "a boolean",
            Self::Date => "a date",
            Self::List(_) => "an array",
            Self::Table(_) => "a table",
        }
    }
}

/// The text of a case, the overrides to lay over it, and the files it may name.
#[derive(Debug)]
pub(crate) struct Source {
    pub(crate) file: PathBuf,
    pub(crate) text: String,
    pub(crate) overrides: Vec<(String, String)>,
    pub(crate) files: Files,
    /// The byte at which each line starts.
    lines: Vec<usize>,
}

impl Source {
    pub(crate) fn new(file: PathBuf, text: String, overrides: Vec<(String, String)>, files: Files) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, byte)| *byte == b'\n').map(|(at, _)| at + 1);
        let lines = std::iter::once(0).chain(starts).collect();
        Self { file, text, overrides, files, lines }
    }

    /// The tree of the file.
    pub(crate) fn parse(&self) -> Result<Node, Vec<Problem>> {
        let (table, errors) = DeTable::parse_recoverable(&self.text);
        if errors.is_empty() {
            return Ok(Node { content: table_of(table.get_ref(), &Spot::File), spot: Spot::Nowhere });
        }
        let mut problems: Vec<Problem> = errors
            .iter()
            .take(MOST_SYNTAX_PROBLEMS)
            .map(|error| {
                let spot = error.span().map_or(Spot::Nowhere, Spot::File);
                Problem {
                    advice: "correct the TOML syntax".into(),
                    ..self.problem(&spot, "", error.message())
                }
            })
            .collect();
        problems.sort_by_key(|problem| (problem.line, problem.column));
        Err(problems)
    }

    /// A problem at a spot, with what is written there as the value seen.
    pub(crate) fn problem(&self, spot: &Spot, key: &str, message: impl Into<String>) -> Problem {
        let mut problem =
            Problem { key: key.to_owned(), message: message.into(), ..Problem::of_file(self.file.clone()) };
        match spot {
            Spot::Override(number) => {
                let (key, value) = &self.overrides[*number];
                problem.setting = Some(format!("{key}={value}"));
                problem.seen = shortened(value);
            }
            Spot::Nowhere => {}
            Spot::File(span) => {
                let (line, column) = self.line_and_column(span.start);
                (problem.line, problem.column) = (Some(line), Some(column));
                let written = self.text.get(span.clone()).unwrap_or_default();
                problem.seen = shortened(written);
                // What goes on in other lines is marked to the end of its first.
                let marked = written.lines().next().unwrap_or_default().trim_end().chars().count();
                // What is too long to be shown is not kept: a line may have as many problems as words.
                let text = self.line(line);
                let is_shown = text.chars().nth(LONGEST_LINE).is_none();
                problem.excerpt = is_shown.then(|| Excerpt { line: text.to_owned(), marked });
            }
        }
        problem
    }

    /// The text of a line, counted from 1.
    fn line(&self, number: usize) -> &str {
        let start = self.lines.get(number - 1).copied().unwrap_or(self.text.len());
        self.text[start..].lines().next().unwrap_or_default()
    }

    /// Line and column, both from 1, the column in characters.
    fn line_and_column(&self, byte: usize) -> (usize, usize) {
        let before = self.text.get(..byte).unwrap_or(&self.text);
        let line = self.lines.partition_point(|&start| start <= before.len());
        (line, before[self.lines[line - 1]..].chars().count() + 1)
    }

    /// The spot of some bytes within the string written at `spot`: the same characters of the file where the string
    /// is written without escapes, otherwise the whole value.
    pub(crate) fn within(&self, spot: &Spot, content: &str, part: Range<usize>) -> Spot {
        let Spot::File(span) = spot else { return spot.clone() };
        let written = self.text.get(span.clone()).unwrap_or_default();
        let plain = written.len() == content.len() + 2 && written.get(1..written.len() - 1) == Some(content);
        if plain { Spot::File(span.start + 1 + part.start..span.start + 1 + part.end) } else { spot.clone() }
    }
}

/// The value of an override: TOML where it is TOML, a string otherwise.
pub(crate) fn override_value(text: &str, number: usize) -> Node {
    let spot = Spot::Override(number);
    match DeValue::parse(text.trim()) {
        Ok(value) => Node { content: content_of(value.get_ref(), &|_| Spot::Override(number)), spot },
        Err(_) => Node { content: Content::Text(text.to_owned()), spot },
    }
}

fn table_of(table: &DeTable<'_>, spot: &dyn Fn(Range<usize>) -> Spot) -> Content {
    let entries = table.iter().map(|(key, value)| Entry {
        key: key.get_ref().to_string(),
        key_spot: spot(key.span()),
        node: Node { content: content_of(value.get_ref(), spot), spot: spot(value.span()) },
    });
    Content::Table(entries.collect())
}

fn content_of(value: &DeValue<'_>, spot: &dyn Fn(Range<usize>) -> Spot) -> Content {
    match value {
        DeValue::String(text) => Content::Text(text.to_string()),
        DeValue::Integer(integer) => {
            Content::Integer(i128::from_str_radix(integer.as_str(), integer.radix()).unwrap_or(i128::MAX))
        }
        DeValue::Float(float) => Content::Float(float.as_str().parse().expect("TOML floats are Rust floats")),
        DeValue::Boolean(flag) => Content::Flag(*flag),
        DeValue::Datetime(_) => Content::Date,
        DeValue::Array(array) => list_of(array, spot),
        DeValue::Table(table) => table_of(table, spot),
    }
}

fn list_of(array: &DeArray<'_>, spot: &dyn Fn(Range<usize>) -> Spot) -> Content {
    let nodes = array
        .iter()
        .map(|value| Node { content: content_of(value.get_ref(), spot), spot: spot(value.span()) });
    Content::List(nodes.collect())
}

/// The first line, at most 60 characters of it.
fn shortened(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    let cut: String = line.chars().take(60).collect();
    if cut.len() < text.len() { format!("{cut}...") } else { cut }
}

/// The case file that a path means: itself, or `case.toml` in the folder.
pub(crate) fn case_file(path: &Path) -> PathBuf {
    if path.is_dir() { path.join("case.toml") } else { path.to_owned() }
}

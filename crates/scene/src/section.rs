//! One table of the case, read by the schema.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::document::Spot;
use crate::expect;
use crate::schema::KEYS;
use crate::words::Word;

/// A table whose keys have been read. What could not be read has been reported and is [`Value::Bad`]; accessors then
/// return a stand-in, which never reaches a user because a case with problems is never returned.
#[derive(Debug)]
pub(crate) struct Section {
    /// Path in the schema, such as `opening`.
    pub(crate) path: String,
    /// Key to show, such as `opening.cca`.
    pub(crate) shown: String,
    /// Where the table is written.
    pub(crate) spot: Spot,
    pub(crate) fields: BTreeMap<String, Field>,
}

/// A key that was written or has a default.
#[derive(Debug)]
pub(crate) struct Field {
    pub(crate) value: Value,
    /// Where the value is written; `None` for a default.
    pub(crate) spot: Option<Spot>,
}

/// A value as its kind in the schema says.
#[derive(Debug)]
pub(crate) enum Value {
    /// Reported as a problem.
    Bad,
    Text(String),
    Path(PathBuf),
    Flag(bool),
    Count(i128),
    /// In SI units.
    Number(f64),
    Words(Vec<String>),
    Point([f64; 3]),
    Pairs(Vec<[String; 2]>),
    Section(Section),
    Sections(Vec<Section>),
}

impl Section {
    fn field(&self, name: &str) -> Option<&Field> {
        debug_assert!(
            KEYS.iter()
                .chain(expect::KEYS)
                .any(|key| key.path.rsplit_once('.').unwrap_or(("", key.path)) == (&self.path, name)),
            "the schema has no `{name}` in `{}`",
            self.path
        );
        self.fields.get(name)
    }

    /// Calls `visit` with the key to show and the place of everything that is written in this table and below.
    pub(crate) fn visit_written(&self, visit: &mut dyn FnMut(&str, &Spot)) {
        for (name, field) in &self.fields {
            if let Some(spot) = &field.spot {
                visit(&self.key(name), spot);
            }
            match &field.value {
                Value::Section(section) => section.visit_written(visit),
                Value::Sections(sections) => {
                    for section in sections {
                        visit(&section.shown, &section.spot);
                        section.visit_written(visit);
                    }
                }
                _ => {}
            }
        }
    }

    /// True when the key stands in the file or in an override, rightly or wrongly.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.field(name).is_some_and(|field| field.spot.is_some())
    }

    /// Where the value of a key is written, or the table for one that is not.
    pub(crate) fn spot(&self, name: &str) -> &Spot {
        self.field(name).and_then(|field| field.spot.as_ref()).unwrap_or(&self.spot)
    }

    /// The key to show for a key of this table.
    pub(crate) fn key(&self, name: &str) -> String {
        if self.shown.is_empty() { name.to_owned() } else { format!("{}.{name}", self.shown) }
    }

    /// A number in SI units; NaN for one that could not be read, which passes every check that follows.
    pub(crate) fn number(&self, name: &str) -> f64 {
        self.optional_number(name).unwrap_or(f64::NAN)
    }

    /// A number in SI units, or `None` where it is not given or a word stands in its place.
    pub(crate) fn optional_number(&self, name: &str) -> Option<f64> {
        match self.field(name)?.value {
            Value::Number(number) => Some(number),
            _ => None,
        }
    }

    pub(crate) fn optional_count(&self, name: &str) -> Option<i128> {
        match self.field(name)?.value {
            Value::Count(count) => Some(count),
            _ => None,
        }
    }

    /// An integer whose range in the schema fits the type.
    pub(crate) fn count<T: TryFrom<i128> + Default>(&self, name: &str) -> T {
        self.optional_count(name).and_then(|count| T::try_from(count).ok()).unwrap_or_default()
    }

    pub(crate) fn flag(&self, name: &str) -> bool {
        matches!(self.field(name), Some(Field { value: Value::Flag(true), .. }))
    }

    pub(crate) fn text(&self, name: &str) -> Option<&str> {
        match &self.field(name)?.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    pub(crate) fn path(&self, name: &str) -> Option<&PathBuf> {
        match &self.field(name)?.value {
            Value::Path(path) => Some(path),
            _ => None,
        }
    }

    pub(crate) fn word<W: Word>(&self, name: &str) -> Option<W> {
        self.text(name).and_then(W::from_word)
    }

    pub(crate) fn words<W: Word>(&self, name: &str) -> Option<Vec<W>> {
        match &self.field(name)?.value {
            Value::Words(words) => words.iter().map(|word| W::from_word(word)).collect(),
            _ => None,
        }
    }

    pub(crate) fn point(&self, name: &str) -> [f64; 3] {
        match self.field(name) {
            Some(Field { value: Value::Point(point), .. }) => *point,
            _ => [f64::NAN; 3],
        }
    }

    pub(crate) fn pairs(&self, name: &str) -> &[[String; 2]] {
        match self.field(name) {
            Some(Field { value: Value::Pairs(pairs), .. }) => pairs,
            _ => &[],
        }
    }

    pub(crate) fn section(&self, name: &str) -> Option<&Section> {
        match &self.field(name)?.value {
            Value::Section(section) => Some(section),
            _ => None,
        }
    }

    pub(crate) fn sections(&self, name: &str) -> &[Section] {
        match self.field(name) {
            Some(Field { value: Value::Sections(sections), .. }) => sections,
            _ => &[],
        }
    }
}

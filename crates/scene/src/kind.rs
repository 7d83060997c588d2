//! What a key may hold.

use vaso_units::{Dimension, pretty};

/// One key of `case.toml`. A key may appear several times in the schema with different conditions.
#[derive(Debug)]
pub(crate) struct Key {
    /// Dotted path without element numbers, such as `opening.compliance`.
    pub(crate) path: &'static str,
    pub(crate) kind: Kind,
    pub(crate) presence: Presence,
    /// The key belongs here only if every one of these holds.
    pub(crate) when: &'static [When],
    /// What it does, for the reference.
    pub(crate) meaning: &'static str,
}

impl Key {
    /// Its name in its table.
    pub(crate) fn name(&self) -> &'static str {
        self.path.rsplit_once('.').map_or(self.path, |(_, name)| name)
    }

    /// Path of its table; empty for the root.
    pub(crate) fn parent(&self) -> &'static str {
        self.path.rsplit_once('.').map_or("", |(parent, _)| parent)
    }
}

/// Names of keys, each once, in their order.
pub(crate) fn names(keys: &[&Key]) -> Vec<&'static str> {
    let mut names = Vec::new();
    for name in keys.iter().map(|key| key.name()) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// A sibling key holds one of these words.
#[derive(Debug)]
pub(crate) struct When {
    pub(crate) key: &'static str,
    pub(crate) words: &'static [&'static str],
}

/// What a key may hold.
#[derive(Debug)]
pub(crate) enum Kind {
    /// A table of keys.
    Table,
    /// An array of tables.
    Tables,
    /// Any text.
    Text,
    /// A name that is safe in file headers and in override keys.
    Name,
    /// The path of an existing file, relative to the case folder.
    File,
    Flag,
    /// An integer between two bounds.
    Count(i128, i128),
    /// A number without dimension.
    Number(Range),
    /// A number with a unit.
    Quantity(Dimension, Range),
    /// A number with a unit, or a word.
    QuantityOr(&'static str, Dimension, Range),
    /// A number with a unit, or a table of keys.
    QuantityOrTable(Dimension, Range),
    /// One of some words.
    Choice(&'static [&'static str]),
    /// An array of different words.
    Choices(&'static [&'static str]),
    /// Three coordinates.
    Point,
    /// An array of pairs of names.
    Pairs,
}

/// What the absence of a key means.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Presence {
    /// It is an error.
    Required,
    /// The same as this value, written as in the file without quotes; for a table, the same as an empty one.
    Default(&'static str),
    /// What is said here.
    Optional(&'static str),
}

/// An interval of SI values.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Range {
    low: Low,
    high: Option<f64>,
}

#[derive(Debug, Clone, Copy)]
enum Low {
    None,
    Including(f64),
    Excluding(f64),
}

impl Range {
    pub(crate) const ANY: Self = Self { low: Low::None, high: None };
    pub(crate) const POSITIVE: Self = Self { low: Low::Excluding(0.0), high: None };
    pub(crate) const NON_NEGATIVE: Self = Self { low: Low::Including(0.0), high: None };

    /// From `low` to `high`, both allowed.
    pub(crate) const fn closed(low: f64, high: f64) -> Self {
        Self { low: Low::Including(low), high: Some(high) }
    }

    /// Above `low` and up to `high`.
    pub(crate) const fn above(low: f64, high: f64) -> Self {
        Self { low: Low::Excluding(low), high: Some(high) }
    }

    /// Neither NaN nor infinity is inside any range.
    pub(crate) fn contains(self, value: f64) -> bool {
        let above = match self.low {
            Low::None => true,
            Low::Including(low) => value >= low,
            Low::Excluding(low) => value > low,
        };
        value.is_finite() && above && self.high.is_none_or(|high| value <= high)
    }

    /// The lower bound and whether it is included, and the upper bound, which always is.
    pub(crate) fn bounds(self) -> (Option<(f64, bool)>, Option<f64>) {
        let low = match self.low {
            Low::None => None,
            Low::Including(low) => Some((low, true)),
            Low::Excluding(low) => Some((low, false)),
        };
        (low, self.high)
    }

    /// The range in words, such as `above 0 and at most 1`; empty for any value.
    pub(crate) fn words(self, dimension: Dimension) -> String {
        let number = |value: f64| if value == 0.0 { "0".to_owned() } else { pretty(value, dimension) };
        match (self.low, self.high) {
            (Low::None, _) => String::new(),
            (Low::Including(low), None) => format!("of at least {}", number(low)),
            (Low::Excluding(low), None) => format!("above {}", number(low)),
            (Low::Including(low), Some(high)) => format!("from {} to {}", number(low), number(high)),
            (Low::Excluding(low), Some(high)) => {
                format!("above {} and at most {}", number(low), number(high))
            }
        }
    }
}

impl Kind {
    /// What is allowed, in words.
    pub(crate) fn words(&self) -> String {
        let list =
            |words: &[&str]| words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
        match self {
            Self::Table => "a table".into(),
            Self::Tables => "an array of tables".into(),
            Self::Text => "a string".into(),
            Self::Name => "a string of letters, digits, `_` and `-`, not a number".into(),
            Self::File => "the path of a file".into(),
            Self::Flag => "true or false".into(),
            Self::Count(low, high) if *high == i128::from(u64::MAX) => {
                format!("an integer of at least {low}")
            }
            Self::Count(low, high) => format!("an integer from {low} to {high}"),
            Self::Number(range) => joined("a number", &range.words(vaso_units::dimension::NUMBER)),
            Self::Quantity(dimension, range) => joined(&dimension.name(), &range.words(*dimension)),
            Self::QuantityOr(word, dimension, range) => {
                format!("\"{word}\" or {}", joined(&dimension.name(), &range.words(*dimension)))
            }
            Self::QuantityOrTable(dimension, range) => {
                format!("{}, or a table", joined(&dimension.name(), &range.words(*dimension)))
            }
            Self::Choice(words) => list(words),
            Self::Choices(words) => format!("an array of {}", list(words)),
            Self::Point => "an array of three numbers".into(),
            Self::Pairs => "an array of pairs of names".into(),
        }
    }

    /// The dimension of what carries a unit.
    pub(crate) fn dimension(&self) -> Option<Dimension> {
        match self {
            Self::Quantity(dimension, _)
            | Self::QuantityOr(_, dimension, _)
            | Self::QuantityOrTable(dimension, _) => Some(*dimension),
            _ => None,
        }
    }
}

fn joined(what: &str, range: &str) -> String {
    if range.is_empty() { what.to_owned() } else { format!("{what} {range}") }
}

//! What can be wrong with the text of a quantity.

use std::ops::Range;

use crate::Dimension;

/// A quantity that could not be read. Every variant knows the bytes of the text at fault ([`UnitError::span`]).
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum UnitError {
    /// The text does not begin with a number.
    #[error("\"{text}\" does not begin with a number")]
    Number {
        /// The whole text.
        text: String,
        /// Bytes of the text that should be the number.
        span: Range<usize>,
    },
    /// The number is too large for a double.
    #[error("\"{text}\" is too large")]
    TooLarge {
        /// The whole text.
        text: String,
        /// Bytes of the number.
        span: Range<usize>,
    },
    /// A number stands without the unit it needs.
    #[error("\"{text}\" has no unit, but {} needs one", expected.name())]
    MissingUnit {
        /// The whole text.
        text: String,
        /// The dimension asked for.
        expected: Dimension,
    },
    /// No such unit.
    #[error("the unit \"{unit}\" is not known{}", suggestion(nearest))]
    UnknownUnit {
        /// The symbol as written.
        unit: String,
        /// Its bytes in the text.
        span: Range<usize>,
        /// The known unit that is spelt most like it, if one comes close.
        nearest: Option<String>,
    },
    /// The unit cannot be taken apart: a stray sign, a missing factor, an exponent that is not a small integer.
    #[error("the unit \"{unit}\" cannot be read{}", if unit.is_empty() { " because a factor is missing" } else { "" })]
    Syntax {
        /// The part that could not be read.
        unit: String,
        /// Its bytes in the text.
        span: Range<usize>,
    },
    /// A product follows a quotient without parentheses, which may be read in two ways.
    #[error("\"{unit}\" after a `/` can be read in two ways")]
    Ambiguous {
        /// The factor after the quotient.
        unit: String,
        /// Its bytes in the text.
        span: Range<usize>,
    },
    /// A good quantity of another kind than the one asked for.
    #[error("\"{text}\" is {}, not {}", found.name(), expected.name())]
    WrongDimension {
        /// The whole text.
        text: String,
        /// Bytes of the unit.
        span: Range<usize>,
        /// The dimension of the text.
        found: Dimension,
        /// The dimension asked for.
        expected: Dimension,
    },
}

fn suggestion(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |unit| format!("; did you mean \"{unit}\"?"))
}

impl UnitError {
    /// Bytes of the text at fault; empty and at the end for a missing unit.
    pub fn span(&self) -> Range<usize> {
        match self {
            Self::MissingUnit { text, .. } => text.len()..text.len(),
            Self::Number { span, .. }
            | Self::TooLarge { span, .. }
            | Self::UnknownUnit { span, .. }
            | Self::Syntax { span, .. }
            | Self::Ambiguous { span, .. }
            | Self::WrongDimension { span, .. } => span.clone(),
        }
    }

    /// The text with a second line that points at the fault:
    ///
    /// ```
    /// let error = vaso_units::parse("120 mmHq").unwrap_err();
    /// assert_eq!(error.caret("120 mmHq"), "120 mmHq\n    ^^^^");
    /// ```
    pub fn caret(&self, text: &str) -> String {
        let span = self.span();
        let before = text.get(..span.start).map_or(0, |head| head.chars().count());
        let marked = text.get(span).map_or(1, |part| part.chars().count().max(1));
        format!("{text}\n{}{}", " ".repeat(before), "^".repeat(marked))
    }
}

//! Values that are not tables: texts, words, numbers, quantities, points.

use vaso_units::dimension::NUMBER;
use vaso_units::{Dimension, UnitError, nearest, parse_as};

use crate::document::{Content, Node, Spot};
use crate::error::Problem;
use crate::kind::{Kind, Range};
use crate::reader::Reader;
use crate::section::Value;

const OUT_OF_RANGE: &str = "change the value, or its unit if that is wrong";
const COORDINATES: &str = "write x, y and z in the unit of the surface";

impl Reader<'_> {
    /// Reads a value of a kind other than tables.
    pub(crate) fn plain(&mut self, kind: &Kind, shown: &str, node: &Node) -> Value {
        match (kind, &node.content) {
            (Kind::Text, Content::Text(text)) => Value::Text(text.clone()),
            (Kind::Name, Content::Text(text)) if is_name(text) => Value::Text(text.clone()),
            (Kind::Name, Content::Text(_)) => self.refuse(
                kind,
                shown,
                &node.spot,
                "cannot be used as a name",
                "call it \"inlet_1\", for example",
            ),
            (Kind::File, Content::Text(text)) => {
                let path = self.directory.join(text);
                if self.source.files.has(&path) {
                    return Value::Path(path);
                }
                let path = path.strip_prefix(".").unwrap_or(&path);
                let message = format!("there is no file \"{}\"", path.display());
                self.refuse(
                    kind,
                    shown,
                    &node.spot,
                    message,
                    "correct the path, which starts from the case folder",
                )
            }
            (Kind::Flag, Content::Flag(flag)) => Value::Flag(*flag),
            (Kind::Count(low, high), Content::Integer(count)) if (low..=high).contains(&count) => {
                Value::Count(*count)
            }
            (Kind::Count(..), Content::Integer(_)) => {
                self.refuse(kind, shown, &node.spot, "is out of range", OUT_OF_RANGE)
            }
            (Kind::Number(range), Content::Integer(_) | Content::Float(_)) => {
                self.in_range(number(&node.content), *range, kind, shown, &node.spot)
            }
            (Kind::Number(range), Content::Text(text)) => {
                self.quantity(text, NUMBER, *range, kind, shown, node)
            }
            (Kind::QuantityOr(word, ..), Content::Text(text)) if text == word => Value::Text(text.clone()),
            (
                Kind::Quantity(dimension, range)
                | Kind::QuantityOr(_, dimension, range)
                | Kind::QuantityOrTable(dimension, range),
                Content::Text(text),
            ) => self.quantity(text, *dimension, *range, kind, shown, node),
            (Kind::Choice(words), Content::Text(text)) if words.contains(&text.as_str()) => {
                Value::Text(text.clone())
            }
            (Kind::Choice(words), Content::Text(text)) => {
                self.unknown_word(text, words, kind, shown, &node.spot)
            }
            (Kind::Choices(words), Content::List(nodes)) => {
                self.choices(words, nodes, kind, shown, &node.spot)
            }
            (Kind::Point, Content::List(nodes)) => match nodes.as_slice() {
                [x, y, z] => {
                    let point = [x, y, z].map(|node| number(&node.content));
                    if point.iter().all(|coordinate| coordinate.is_finite()) {
                        return Value::Point(point);
                    }
                    self.refuse(
                        kind,
                        shown,
                        &node.spot,
                        "has a coordinate that is not a finite number",
                        COORDINATES,
                    )
                }
                _ => self.refuse(
                    kind,
                    shown,
                    &node.spot,
                    format!("has {} coordinates", nodes.len()),
                    COORDINATES,
                ),
            },
            (Kind::Pairs, Content::List(nodes)) => self.pairs(nodes, kind, shown),
            (_, content) => {
                match (kind.dimension(), content) {
                    (Some(dimension), Content::Integer(_) | Content::Float(_)) => {
                        self.bare_number(dimension, kind, shown, node);
                    }
                    _ => self.wrong_type(kind, shown, node, content),
                }
                Value::Bad
            }
        }
    }

    fn quantity(
        &mut self,
        text: &str,
        dimension: Dimension,
        range: Range,
        kind: &Kind,
        shown: &str,
        node: &Node,
    ) -> Value {
        match parse_as(text, dimension) {
            Ok(value) => self.in_range(value, range, kind, shown, &node.spot),
            Err(error) => {
                let spot = self.source.within(&node.spot, text, error.span());
                let at_fault = self.source.problem(&spot, shown, error.to_string());
                let whole = self.source.problem(&node.spot, shown, "");
                let advice = match error {
                    UnitError::Ambiguous { .. } => "use parentheses, as in \"1/(Pa s)\"".into(),
                    UnitError::MissingUnit { .. } => with_units(text, dimension),
                    _ => units_in_use(dimension),
                };
                self.problems.push(Problem { seen: whole.seen, allowed: kind.words(), advice, ..at_fault });
                Value::Bad
            }
        }
    }

    fn in_range(&mut self, value: f64, range: Range, kind: &Kind, shown: &str, spot: &Spot) -> Value {
        if range.contains(value) {
            Value::Number(value)
        } else {
            self.refuse(kind, shown, spot, "is out of range", OUT_OF_RANGE)
        }
    }

    fn bare_number(&mut self, dimension: Dimension, kind: &Kind, shown: &str, node: &Node) {
        let message = format!("is a number without a unit, but {} needs one", dimension.name());
        let problem = self.source.problem(&node.spot, shown, message);
        let advice = with_units(&problem.seen, dimension);
        self.problems.push(Problem { allowed: kind.words(), advice, ..problem });
    }

    fn unknown_word(&mut self, text: &str, words: &[&str], kind: &Kind, shown: &str, spot: &Spot) -> Value {
        self.refuse(kind, shown, spot, "is not one of the words allowed", "take one of these");
        if let (Some(near), Some(problem)) = (nearest(text, words.iter().copied()), self.problems.last_mut())
        {
            problem.advice = format!("did you mean \"{near}\"?");
        }
        Value::Bad
    }

    fn choices(&mut self, words: &[&str], nodes: &[Node], kind: &Kind, shown: &str, spot: &Spot) -> Value {
        let mut chosen: Vec<String> = Vec::new();
        for node in nodes {
            match &node.content {
                Content::Text(text) if chosen.contains(text) => {
                    self.refuse(kind, shown, &node.spot, "is named twice", "name it once");
                }
                Content::Text(text) if words.contains(&text.as_str()) => chosen.push(text.clone()),
                Content::Text(text) => {
                    self.unknown_word(text, words, kind, shown, &node.spot);
                }
                other => self.wrong_type(kind, shown, node, other),
            }
        }
        if nodes.is_empty() {
            self.refuse(kind, shown, spot, "is empty", "name something, or remove the key");
        }
        Value::Words(chosen)
    }

    fn pairs(&mut self, nodes: &[Node], kind: &Kind, shown: &str) -> Value {
        let mut pairs = Vec::new();
        for node in nodes {
            let names = match &node.content {
                Content::List(names) => names.as_slice(),
                _ => &[],
            };
            let text = |node: &Node| match &node.content {
                Content::Text(text) => Some(text.clone()),
                _ => None,
            };
            match names {
                [a, b] if text(a).zip(text(b)).is_some() => {
                    pairs.extend(text(a).zip(text(b)).map(<[String; 2]>::from))
                }
                _ => {
                    let advice = "write two names in brackets, as in [\"inlet\", \"outlet\"]";
                    self.refuse(kind, shown, &node.spot, "is not a pair of names", advice);
                }
            }
        }
        Value::Pairs(pairs)
    }

    fn refuse(
        &mut self,
        kind: &Kind,
        shown: &str,
        spot: &Spot,
        message: impl Into<String>,
        advice: &str,
    ) -> Value {
        let problem = self.source.problem(spot, shown, message);
        self.problems.push(Problem { allowed: kind.words(), advice: advice.into(), ..problem });
        Value::Bad
    }
}

fn number(content: &Content) -> f64 {
    match content {
        Content::Integer(integer) => *integer as f64,
        Content::Float(float) => *float,
        _ => f64::NAN,
    }
}

/// A name goes into column titles and override keys; one made of digits would be taken for a number.
pub(crate) fn is_name(text: &str) -> bool {
    let safe = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    !text.is_empty() && text.chars().all(safe) && !text.chars().all(|c| c.is_ascii_digit())
}

fn with_units(number: &str, dimension: Dimension) -> String {
    let number = number.trim_matches('"');
    let examples: Vec<String> =
        dimension.units().iter().take(3).map(|unit| format!("\"{number} {unit}\"")).collect();
    format!("write the unit too, as in {}", examples.join(" or "))
}

/// The units people write a dimension in.
pub(crate) fn units_in_use(dimension: Dimension) -> String {
    let units: Vec<String> =
        dimension.units().iter().filter(|unit| !unit.is_empty()).map(|unit| format!("\"{unit}\"")).collect();
    if units.is_empty() { String::new() } else { format!("units in use: {}", units.join(", ")) }
}

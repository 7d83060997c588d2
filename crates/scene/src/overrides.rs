//! Laying `--set key=value` over the tree of the file.

use crate::document::{Content, Entry, Node, Source, Spot, override_value};
use crate::error::Problem;

/// Parts of a key at most: more than any key of the schema has, so that one that goes on is refused before a tree as
/// deep is built for it.
const MOST_PARTS: usize = 8;

/// Applies all overrides in order; those that cannot be applied are reported and left out.
pub(crate) fn apply(source: &Source, root: &mut Node) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (number, (key, value)) in source.overrides.iter().enumerate() {
        let node = override_value(value, number);
        let segments: Vec<&str> = key.split('.').map(str::trim).take(MOST_PARTS + 1).collect();
        if segments.len() > MOST_PARTS {
            problems.push(Problem {
                allowed: "names joined by dots, such as `particles.spacing`".into(),
                ..source.problem(&Spot::Override(number), key, "the key has too many parts")
            });
        } else if segments.iter().any(|segment| segment.is_empty()) {
            problems.push(Problem {
                allowed: "names joined by dots, such as `particles.spacing`".into(),
                ..source.problem(&Spot::Override(number), key, "the key has an empty part")
            });
        } else if let Err((message, allowed)) = set(root, &segments, node) {
            problems.push(Problem { allowed, ..source.problem(&Spot::Override(number), key, message) });
        }
    }
    problems
}

/// Sets the value at the end of the path, making the tables on the way; the error is what is wrong and what is
/// allowed.
fn set(node: &mut Node, path: &[&str], value: Node) -> Result<(), (String, String)> {
    let Some((name, rest)) = path.split_first() else {
        *node = value;
        return Ok(());
    };
    match &mut node.content {
        Content::Table(entries) => {
            let at = entries.iter().position(|entry| entry.key == *name).unwrap_or_else(|| {
                let spot = value.spot.clone();
                let node = Node { content: Content::Table(Vec::new()), spot: spot.clone() };
                entries.push(Entry { key: (*name).to_owned(), key_spot: spot, node });
                entries.len() - 1
            });
            set(&mut entries[at].node, rest, value)
        }
        Content::List(elements) => {
            let at = element(elements, name).ok_or_else(|| {
                let names: Vec<String> =
                    elements.iter().filter_map(name_of).map(|name| format!("`{name}`")).collect();
                (format!("there is no `{name}` here"), allowed_elements(elements.len(), &names))
            })?;
            set(&mut elements[at], rest, value)
        }
        other => {
            let allowed = "a key of a table; set the whole value instead".to_owned();
            Err((format!("`{name}` cannot be set in {}", other.kind()), allowed))
        }
    }
}

fn allowed_elements(count: usize, names: &[String]) -> String {
    match (count, names) {
        (0, _) => "nothing, the array is empty".into(),
        (_, []) => format!("a number from 0 to {}", count - 1),
        (_, names) => format!("{}, or a number from 0 to {}", names.join(", "), count - 1),
    }
}

/// The element of that name, or else of that number.
fn element(elements: &[Node], name: &str) -> Option<usize> {
    let named = elements.iter().position(|element| name_of(element) == Some(name));
    named.or_else(|| name.parse().ok().filter(|&index| index < elements.len()))
}

fn name_of(node: &Node) -> Option<&str> {
    let Content::Table(entries) = &node.content else { return None };
    let entry = entries.iter().find(|entry| entry.key == "name")?;
    match &entry.node.content {
        Content::Text(name) => Some(name),
        _ => None,
    }
}

//! From the tree of the file to sections, by the schema: unknown, missing and misplaced keys, types, units and ranges.

use std::collections::BTreeMap;
use std::path::Path;

use vaso_units::nearest;

use crate::document::{Content, Entry, Node, Source, Spot};
use crate::error::Problem;
use crate::kind::{Key, Kind, Presence, When, names};
use crate::plain::{is_name, units_in_use};
use crate::section::{Field, Section, Value};

/// Reads tables and collects what is wrong with them.
pub(crate) struct Reader<'a> {
    pub(crate) source: &'a Source,
    /// The schema the file is read by.
    pub(crate) schema: &'static [Key],
    /// Where relative paths start.
    pub(crate) directory: &'a Path,
    pub(crate) problems: Vec<Problem>,
}

impl Reader<'_> {
    /// Reads the whole file.
    pub(crate) fn root(&mut self, root: &Node) -> Section {
        self.section("", String::new(), root)
    }

    /// Reads a table; `path` is its path in the schema, `shown` the key to show.
    pub(crate) fn section(&mut self, path: &str, shown: String, node: &Node) -> Section {
        let Content::Table(entries) = &node.content else {
            unreachable!("callers have seen that the node is a table")
        };
        let mut section =
            Section { path: path.into(), shown, spot: node.spot.clone(), fields: BTreeMap::new() };
        let keys: Vec<&Key> = self.schema.iter().filter(|key| key.parent() == path).collect();
        for entry in entries {
            let value = self.entry(&section, &keys, entries, entry);
            section.fields.insert(entry.key.clone(), Field { value, spot: Some(entry.node.spot.clone()) });
        }
        for key in
            keys.iter().filter(|key| !section.fields.contains_key(key.name())).copied().collect::<Vec<_>>()
        {
            if applies(key, &keys, entries) == Some(true) {
                self.absent(&mut section, key);
            }
        }
        section
    }

    fn entry(&mut self, section: &Section, keys: &[&Key], entries: &[Entry], entry: &Entry) -> Value {
        let shown = section.key(&entry.key);
        let same_name: Vec<&&Key> = keys.iter().filter(|key| key.name() == entry.key).collect();
        if same_name.is_empty() {
            self.unknown(section, keys, entry);
            return Value::Bad;
        }
        if let Some(key) = same_name.iter().find(|key| applies(key, keys, entries) == Some(true)) {
            return self.value(key, &shown, &entry.node);
        }
        if same_name.iter().all(|key| applies(key, keys, entries) == Some(false)) {
            self.misplaced(section, &same_name, keys, entries, entry);
        }
        Value::Bad
    }

    fn unknown(&mut self, section: &Section, keys: &[&Key], entry: &Entry) {
        let names = names(keys);
        let elsewhere = self.schema.iter().find(|key| key.name() == entry.key && !key.parent().is_empty());
        let advice = match (nearest(&entry.key, names.iter().copied()), elsewhere) {
            (Some(near), _) => format!("did you mean `{near}`?"),
            (None, Some(key)) => format!("`{}` belongs in `{}`", entry.key, key.parent()),
            (None, None) => "remove it".into(),
        };
        let allowed = names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let problem = self.source.problem(&entry.key_spot, &section.key(&entry.key), "there is no such key");
        self.problems.push(Problem { allowed, advice, ..problem });
    }

    /// A key of another model, condition or generator. Where an override has changed that, keys of the file that belong
    /// to the old one are passed over: they cannot be taken out from there.
    fn misplaced(
        &mut self,
        section: &Section,
        same: &[&&Key],
        keys: &[&Key],
        entries: &[Entry],
        entry: &Entry,
    ) {
        let failing = |key: &Key| key.when.iter().find(|when| holds(when, keys, entries) == Some(false));
        let Some(when) = same.iter().find_map(|key| failing(key)) else { return };
        let is_overridden = |e: &Entry| e.key == when.key && matches!(e.node.spot, Spot::Override(_));
        if matches!(entry.node.spot, Spot::File(_)) && entries.iter().any(is_overridden) {
            return;
        }
        let governing = governing_word(when.key, keys, entries).unwrap_or_default();
        let conditions = same.iter().flat_map(|key| key.when).filter(|other| other.key == when.key);
        let mut words: Vec<&str> = conditions.flat_map(|condition| condition.words).copied().collect();
        words.sort_unstable();
        words.dedup();
        let words = words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
        let message = format!("has no meaning with {} = \"{governing}\"", when.key);
        let problem = self.source.problem(&entry.key_spot, &section.key(&entry.key), message);
        let allowed = format!("only with {} {words}", when.key);
        self.problems.push(Problem {
            allowed,
            advice: format!("remove it or change `{}`", when.key),
            ..problem
        });
    }

    fn absent(&mut self, section: &mut Section, key: &Key) {
        match key.presence {
            Presence::Optional(_) => {}
            Presence::Required => {
                let problem = self.source.problem(&section.spot, &section.key(key.name()), "is missing");
                let advice = match &key.kind {
                    Kind::Table => format!("add `[{}]`", section.key(key.name())),
                    kind => kind.dimension().map_or_else(String::new, units_in_use),
                };
                self.problems.push(Problem {
                    seen: String::new(),
                    allowed: key.kind.words(),
                    advice,
                    ..problem
                });
            }
            Presence::Default(text) => {
                let value = self.value(key, &section.key(key.name()), &default_node(&key.kind, text));
                section.fields.insert(key.name().to_owned(), Field { value, spot: None });
            }
        }
    }

    /// Reads a table or an array of tables, or hands a plain value on.
    fn value(&mut self, key: &Key, shown: &str, node: &Node) -> Value {
        match (&key.kind, &node.content) {
            (Kind::Table | Kind::QuantityOrTable(..), Content::Table(_)) => {
                Value::Section(self.section(key.path, shown.to_owned(), node))
            }
            (Kind::Tables, Content::List(nodes)) => {
                let sections = nodes.iter().enumerate().filter_map(|(number, node)| match &node.content {
                    Content::Table(entries) => {
                        let shown = format!("{shown}.{}", element_name(entries, number));
                        Some(self.section(key.path, shown, node))
                    }
                    other => {
                        self.wrong_type(&key.kind, &format!("{shown}.{number}"), node, other);
                        None
                    }
                });
                Value::Sections(sections.collect())
            }
            _ => self.plain(&key.kind, shown, node),
        }
    }

    pub(crate) fn wrong_type(&mut self, kind: &Kind, shown: &str, node: &Node, content: &Content) {
        let problem = self.source.problem(&node.spot, shown, format!("cannot be {}", content.kind()));
        let advice = match (kind, content) {
            (Kind::Table, _) => format!("write it as `[{shown}]`"),
            (Kind::Tables, _) => format!("write each as `[[{shown}]]`"),
            (Kind::Text | Kind::Name | Kind::File | Kind::Choice(_), _) => "write it in quotes".into(),
            (Kind::Flag | Kind::Count(..), Content::Text(_)) => "write it without quotes".into(),
            _ => String::new(),
        };
        self.problems.push(Problem { allowed: kind.words(), advice, ..problem });
    }
}

/// Whether a key belongs into the table; `None` while a key that decides it is missing or wrong.
fn applies(key: &Key, keys: &[&Key], entries: &[Entry]) -> Option<bool> {
    let answers: Vec<Option<bool>> = key.when.iter().map(|when| holds(when, keys, entries)).collect();
    if answers.contains(&Some(false)) {
        Some(false)
    } else {
        answers.into_iter().collect::<Option<Vec<_>>>().map(|_| true)
    }
}

fn holds(when: &When, keys: &[&Key], entries: &[Entry]) -> Option<bool> {
    governing_word(when.key, keys, entries).map(|word| when.words.contains(&word))
}

/// The word a deciding key holds, its default where it is not written.
fn governing_word<'a>(governing: &str, keys: &[&Key], entries: &'a [Entry]) -> Option<&'a str> {
    let key = keys.iter().find(|key| key.name() == governing)?;
    match (entries.iter().find(|entry| entry.key == governing), &key.kind, key.presence) {
        (Some(Entry { node: Node { content: Content::Text(word), .. }, .. }), Kind::Choice(words), _) => {
            words.contains(&word.as_str()).then_some(word)
        }
        (None, _, Presence::Default(word)) => Some(word),
        _ => None,
    }
}

/// How an element of `[[opening]]` is called in messages: by name where it has one.
fn element_name(entries: &[Entry], number: usize) -> String {
    let named =
        entries.iter().find(|entry| entry.key == "name").and_then(|entry| match &entry.node.content {
            Content::Text(name) if is_name(name) => Some(name.clone()),
            _ => None,
        });
    named.unwrap_or_else(|| number.to_string())
}

/// A default of the schema as if it stood in the file.
fn default_node(kind: &Kind, text: &str) -> Node {
    let content = match kind {
        Kind::Table => Content::Table(Vec::new()),
        Kind::Flag => Content::Flag(text == "true"),
        Kind::Count(..) => Content::Integer(text.parse().expect("defaults of the schema are valid")),
        Kind::Number(_) => Content::Float(text.parse().expect("defaults of the schema are valid")),
        _ => Content::Text(text.to_owned()),
    };
    Node { content, spot: Spot::Nowhere }
}

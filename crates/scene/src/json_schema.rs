//! The JSON Schema of `case.toml`, made from the schema: what editors complete and check it by.

use serde_json::{Map, Value, json};

use crate::kind::{Key, Kind, Presence, When, names};
use crate::schema::KEYS;

/// A number and something behind it that may be its unit. Which units there are is said in words: too many for a pattern.
const QUANTITY: &str = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*[^\s\d.+-]";
const NAME: &str = "^[0-9]*[A-Za-z_-][A-Za-z0-9_-]*$";

/// The JSON Schema (draft 7) of `case.toml`, as indented text.
///
/// It knows keys, types, words, numbers without dimension, and which key belongs to which model or condition. Ranges of
/// quantities, and what must agree with what across tables, it does not: `vaso check` does.
///
/// ```
/// assert!(vaso_scene::case_schema().contains("\"young_modulus\""));
/// ```
pub fn case_schema() -> String {
    let mut root = table("");
    root.insert("$schema".into(), "http://json-schema.org/draft-07/schema#".into());
    root.insert("title".into(), "case.toml of vaso".into());
    let text = serde_json::to_string_pretty(&Value::Object(root));
    text.expect("texts for keys and finite numbers are JSON") + "\n"
}

/// A table with all its keys.
fn table(path: &str) -> Map<String, Value> {
    let keys: Vec<&Key> = KEYS.iter().filter(|key| key.parent() == path).collect();
    let mut properties = Map::new();
    let mut rules = Vec::new();
    let mut required = Vec::new();
    for name in names(&keys) {
        let variants: Vec<&Key> = keys.iter().filter(|key| key.name() == name).copied().collect();
        properties.insert(name.into(), property(&variants));
        if variants.iter().all(|key| !key.when.is_empty()) {
            rules.push(belongs(name, &variants, &keys));
        }
        for key in variants.iter().filter(|key| matches!(key.presence, Presence::Required)) {
            if key.when.is_empty() {
                required.push(name);
            } else {
                rules.push(json!({ "if": condition(key.when, &keys), "then": { "required": [name] } }));
            }
        }
    }
    let mut table = Map::new();
    table.insert("type".into(), "object".into());
    table.insert("additionalProperties".into(), false.into());
    table.insert("properties".into(), properties.into());
    if !required.is_empty() {
        table.insert("required".into(), required.into());
    }
    if !rules.is_empty() {
        table.insert("allOf".into(), rules.into());
    }
    table
}

/// What a key may hold, with what it means.
fn property(variants: &[&Key]) -> Value {
    let mut values: Vec<Value> = Vec::new();
    for key in variants {
        let value = described(key);
        if !values.contains(&value) {
            values.push(value);
        }
    }
    if values.len() == 1 { values.remove(0) } else { json!({ "anyOf": values }) }
}

/// The value of one key with its documentation.
fn described(key: &Key) -> Value {
    let mut value = value(&key.kind, key.path);
    let units: &[&str] = key.kind.dimension().map_or(&[], vaso_units::Dimension::units);
    let units = if units.is_empty() { String::new() } else { format!(" Units: {}.", units.join(", ")) };
    let (default, absence) = match key.presence {
        Presence::Required => (None, " Required.".to_owned()),
        Presence::Optional(absence) => (None, format!(" Without it: {absence}.")),
        Presence::Default(text) => (written(&key.kind, text), String::new()),
    };
    let description = format!("{} Takes {}.{units}{absence}", key.meaning, key.kind.words());
    value["description"] = description.into();
    if let Some(default) = default {
        value["default"] = default;
    }
    value
}

/// A default of the schema as JSON; `None` for a table.
fn written(kind: &Kind, text: &str) -> Option<Value> {
    match kind {
        Kind::Table | Kind::Tables => None,
        Kind::Flag | Kind::Count(..) | Kind::Number(_) => serde_json::from_str(text).ok(),
        _ => Some(text.into()),
    }
}

fn value(kind: &Kind, path: &str) -> Value {
    let quantity = || json!({ "type": "string", "pattern": QUANTITY });
    match kind {
        Kind::Table => Value::Object(table(path)),
        Kind::Tables => json!({ "type": "array", "items": table(path) }),
        Kind::Text => json!({ "type": "string" }),
        Kind::Name => json!({ "type": "string", "pattern": NAME }),
        Kind::File => json!({ "type": "string", "minLength": 1 }),
        Kind::Flag => json!({ "type": "boolean" }),
        Kind::Count(low, high) => {
            let mut value = json!({ "type": "integer" });
            // Integers of TOML end long before the largest bound does.
            for (name, bound) in [("minimum", low), ("maximum", high)] {
                if let Ok(bound) = i64::try_from(*bound) {
                    value[name] = bound.into();
                }
            }
            value
        }
        Kind::Number(range) => {
            let mut value = json!({ "type": "number" });
            let (low, high) = range.bounds();
            if let Some((low, is_included)) = low {
                value[if is_included { "minimum" } else { "exclusiveMinimum" }] = low.into();
            }
            if let Some(high) = high {
                value["maximum"] = high.into();
            }
            // Also as text, for the sake of "49 %"; its range is seen to when the case is read.
            let text = r"^\s*[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?\s*%?\s*$";
            json!({ "anyOf": [value, { "type": "string", "pattern": text }] })
        }
        Kind::Quantity(..) => quantity(),
        Kind::QuantityOr(word, ..) => json!({ "anyOf": [{ "enum": [word] }, quantity()] }),
        Kind::QuantityOrTable(..) => json!({ "anyOf": [quantity(), table(path)] }),
        Kind::Choice(words) => json!({ "enum": words }),
        Kind::Choices(words) => {
            json!({ "type": "array", "items": { "enum": words }, "minItems": 1, "uniqueItems": true })
        }
        Kind::Point => {
            json!({ "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3 })
        }
        Kind::Pairs => {
            let pair =
                json!({ "type": "array", "items": { "type": "string" }, "minItems": 2, "maxItems": 2 });
            json!({ "type": "array", "items": pair })
        }
    }
}

/// Where a key is there, one of its conditions holds, and it holds what it may then.
fn belongs(name: &str, variants: &[&Key], keys: &[&Key]) -> Value {
    let allowed = variants.iter().map(|key| {
        let mut allowed = condition(key.when, keys);
        allowed["properties"][name] = value(&key.kind, key.path);
        allowed
    });
    let mut allowed: Vec<Value> = allowed.collect();
    let then = if allowed.len() == 1 { allowed.remove(0) } else { json!({ "anyOf": allowed }) };
    json!({ "if": { "required": [name] }, "then": then })
}

/// All of some conditions. A key that decides may be left out where its default is among the words.
fn condition(when: &[When], keys: &[&Key]) -> Value {
    let words = when.iter().map(|when| (when.key.to_owned(), json!({ "enum": when.words })));
    let properties: Map<String, Value> = words.collect();
    let is_default = |when: &When| {
        keys.iter().any(|key| {
            key.name() == when.key
                && matches!(key.presence, Presence::Default(word) if when.words.contains(&word))
        })
    };
    let required: Vec<&str> = when.iter().filter(|when| !is_default(when)).map(|when| when.key).collect();
    json!({ "properties": properties, "required": required })
}

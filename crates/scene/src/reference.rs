//! The reference of `case.toml`, made from the schema.

use std::fmt::Write;

use crate::expect;
use crate::kind::{Key, Kind, Presence};
use crate::schema::KEYS;

const HEAD: &str = "\
# Reference of case.toml

<!-- Made by `cargo run -p vaso-scene --example case_reference > docs/case-reference.md`; do not edit. -->

A number with a dimension is a string with its unit, such as `\"0.5 mm\"` or `\"3.5 mPa s\"`; any unit of the dimension
will do. Numbers without dimension are written bare. Pressures are gauge. Points are in the unit of the surface. Paths
start from the folder of the file. A key that is not listed here is an error.

Editors complete and check the file by [case.schema.json](case.schema.json), which `vaso schema` prints and `vaso new` puts beside
a case. The first line `#:schema ./case.schema.json` names it to those that speak through Taplo, such as Even Better TOML in VS
Code; elsewhere, tie the name `case.toml` to it in the settings of the language server.

`--set key=value` overrides a key: `--set particles.spacing=\"0.4 mm\"`, `--set opening.ica.compliance=\"1e-9 m^3/Pa\"`.
An opening or probe is addressed by its name or its number from 0. Where an override changes a model, generator or condition,
keys of the file that have no meaning with the new one are passed over.

A waveform is a text file of two columns, time and value, separated by commas, semicolons, tabs or spaces, in SI units
unless its header names others, in brackets as in `time [ms], flow [ml/min]` or by endings as in `time_ms, flow_ml_per_min`,
or `waveform_unit` does. `#` begins a comment. With `run.period` the table holds one period, with or without the first sample
repeated at its end; without, it covers the whole run.
";

const EXPECT: &str = "
# Reference of expect.toml

What is known of a flow beforehand, in a file of its own beside `case.toml`; `vaso study` counts errors from it. Without it,
errors are counted from the value that the finest runs point to. Openings and probes are those of the case, by name.
";

/// The reference as Markdown: every key with its type, default and meaning.
///
/// ```
/// assert!(vaso_scene::case_reference().contains("| `spacing` | a length above 0 | m, mm, um, cm | required |"));
/// ```
pub fn case_reference() -> String {
    let mut text = HEAD.to_owned();
    tables(KEYS, &mut text);
    text.push_str(EXPECT);
    tables(expect::KEYS, &mut text);
    text
}

fn tables(schema: &[Key], text: &mut String) {
    for table in
        schema.iter().filter(|key| matches!(key.kind, Kind::Table | Kind::Tables | Kind::QuantityOrTable(..)))
    {
        let keys: Vec<&Key> = schema.iter().filter(|key| key.parent() == table.path).collect();
        text.push_str(&heading(table));
        text.push_str("\n| key | value | units | default | meaning |\n|---|---|---|---|---|\n");
        for key in keys {
            text.push_str(&row(key, table.path.len() + 1));
        }
    }
}

fn heading(table: &Key) -> String {
    let (brackets, presence) = match (&table.kind, table.presence) {
        (Kind::Tables, _) => (format!("[[{}]]", table.path), String::new()),
        (Kind::QuantityOrTable(..), _) => (format!("{} = {{ ... }}", table.path), String::new()),
        (_, Presence::Required) => (format!("[{}]", table.path), " Required.".to_owned()),
        (_, Presence::Optional(absence)) => (format!("[{}]", table.path), format!(" Without it: {absence}.")),
        (_, Presence::Default(_)) => (format!("[{}]", table.path), String::new()),
    };
    format!("\n## `{brackets}`\n\n{}{presence}\n", table.meaning)
}

fn row(key: &Key, skip: usize) -> String {
    let default = match key.presence {
        Presence::Required => "required".to_owned(),
        Presence::Optional(absence) => absence.to_owned(),
        Presence::Default(text) if matches!(key.kind, Kind::Number(_) | Kind::Count(..) | Kind::Flag) => {
            format!("`{text}`")
        }
        Presence::Default(text) => format!("`\"{text}\"`"),
    };
    let mut meaning = key.meaning.to_owned();
    for when in key.when {
        let words = when.words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ");
        let _ = write!(meaning, " Only with {} {words}.", when.key);
    }
    let units = key.kind.dimension().map_or_else(String::new, |dimension| dimension.units().join(", "));
    format!("| `{}` | {} | {units} | {default} | {meaning} |\n", &key.path[skip..], key.kind.words())
}

//! The reference and the JSON Schema in `docs/` against the schema they are made from.

#[test]
fn the_reference_is_that_of_the_schema() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/case-reference.md");
    let written = std::fs::read_to_string(path).expect("docs/case-reference.md can be read");
    assert!(
        written == vaso_scene::case_reference(),
        "docs/case-reference.md is out of date; make it again with\n    \
         cargo run -p vaso-scene --example case_reference > docs/case-reference.md"
    );
}

#[test]
fn the_json_schema_is_that_of_the_schema() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/case.schema.json");
    let written = std::fs::read_to_string(path).expect("docs/case.schema.json can be read");
    assert!(
        written == vaso_scene::case_schema(),
        "docs/case.schema.json is out of date; make it again with\n    cargo run -- schema > docs/case.schema.json"
    );
}

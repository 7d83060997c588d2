//! The reference in `docs/` against the schema.

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

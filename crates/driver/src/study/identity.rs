//! What a case says at any spacing, by which the runs of a case and a study of it know each other.

use super::ladder;
use crate::case::Case;
use vaso_io::KeyBuilder;

/// Tables that change what is written, not what flows.
const SILENT: [&str; 2] = ["output", "probe"];

/// Tables of the case, and its surface, with digests of what they say. What follows from the spacing is as if that were a metre. Empty
/// where the case cannot be read again: then it knows no other.
pub(crate) fn identity(case: &Case) -> Vec<[String; 2]> {
    let spacing = ("particles.spacing".to_owned(), "1 m".to_owned());
    let Ok(nominal) = ladder::with(case, &[spacing]) else { return Vec::new() };
    let Ok(surface) = std::fs::read(&case.scene.geometry.surface) else { return Vec::new() };
    let contents = nominal.scene.contents();
    let tables = contents.iter().filter(|(name, _)| !SILENT.contains(name)).map(|(name, text)| {
        let digest = KeyBuilder::new(name).text(text).finish();
        [(*name).to_owned(), digest.to_string()]
    });
    let digest = KeyBuilder::new("surface").bytes(&surface).finish();
    tables.chain([["geometry.surface".to_owned(), digest.to_string()]]).collect()
}

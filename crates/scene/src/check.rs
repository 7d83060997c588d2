//! What must agree with what.

use std::path::Path;

use crate::error::{Problem, SceneError};
use crate::scene::Scene;

pub(crate) fn load(path: &Path, _overrides: &[(String, String)]) -> Result<Scene, SceneError> {
    Err(SceneError {
        problems: vec![Problem {
            file: path.to_owned(),
            line: None,
            column: None,
            setting: None,
            key: String::new(),
            message: "reading of cases is not there yet".into(),
            seen: String::new(),
            allowed: String::new(),
            advice: String::new(),
        }],
    })
}

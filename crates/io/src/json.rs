//! JSON with numbers that may be missing: NaN and infinities travel as `null`.

use crate::{IoError, atomic};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize};
use std::path::Path;

/// Writes `value` as indented JSON, whole or not at all.
pub(crate) fn write<T: Serialize>(path: &Path, value: &T) -> Result<(), IoError> {
    let mut text =
        serde_json::to_vec_pretty(value).map_err(|source| IoError::Json { path: path.to_owned(), source })?;
    text.push(b'\n');
    atomic::write(path, &text)
}

/// Reads what [`write`] wrote.
pub(crate) fn read<T: DeserializeOwned>(path: &Path) -> Result<T, IoError> {
    let text = std::fs::read(path).map_err(|source| IoError::system(path, "read", source))?;
    serde_json::from_slice(&text).map_err(|source| IoError::Json { path: path.to_owned(), source })
}

/// `null` reads as NaN: serde_json writes every non-finite number as `null`.
pub(crate) fn number<'de, D: Deserializer<'de>>(input: D) -> Result<f64, D::Error> {
    Ok(Option::<f64>::deserialize(input)?.unwrap_or(f64::NAN))
}

/// As [`number`], for the three components of a vector.
pub(crate) fn vector<'de, D: Deserializer<'de>>(input: D) -> Result<[f64; 3], D::Error> {
    Ok(<[Option<f64>; 3]>::deserialize(input)?.map(|x| x.unwrap_or(f64::NAN)))
}

/// Gives a struct the functions to be a JSON file: `write`, `read`, `to_json`.
macro_rules! file {
    ($type:ty) => {
        impl $type {
            /// Writes the file whole or not at all.
            ///
            /// # Errors
            /// [`IoError::System`](crate::IoError::System) when the disk or the folder refuses.
            pub fn write(&self, path: &std::path::Path) -> Result<(), $crate::IoError> {
                $crate::json::write(path, self)
            }

            /// Reads the file.
            ///
            /// # Errors
            /// [`IoError::System`](crate::IoError::System) or, when the content is not what it should be, [`IoError::Json`](crate::IoError::Json).
            pub fn read(path: &std::path::Path) -> Result<Self, $crate::IoError> {
                $crate::json::read(path)
            }

            /// The same text for a terminal.
            pub fn to_json(&self) -> String {
                serde_json::to_string_pretty(self)
                    .expect("plain structs with string keys always serialize; non-finite numbers become null")
            }
        }
    };
}

pub(crate) use file;

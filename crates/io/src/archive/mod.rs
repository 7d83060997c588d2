//! Named arrays of exact bits in one HDF5 file: checkpoints and caches.
//!
//! The file states what it is (`kind`), which layout of arrays it has (`version`) and the SHA-256 digest of
//! its content. Reading checks all three before it hands anything out: a file that was cut, altered or made
//! by another version is an error, never data.

mod columns;
mod memory;

use crate::hdf5::{Read, Reader, Values, Write, Writer};
use crate::{IoError, atomic};
use glam::DVec3;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::Path;

const GROUP: &str = "arrays";

/// Named arrays and what they are; the unit of a checkpoint or cache.
#[derive(Debug, Clone, PartialEq)]
pub struct Archive {
    kind: String,
    version: u32,
    arrays: BTreeMap<String, Array>,
}

/// One array; every bit is kept, those of NaN too.
#[derive(Debug, Clone)]
enum Array {
    Floats { values: Vec<f64>, columns: usize },
    Integers(Vec<u64>),
    Bytes(Vec<u8>),
}

impl PartialEq for Array {
    fn eq(&self, other: &Self) -> bool {
        self.tag() == other.tag() && self.bytes() == other.bytes()
    }
}

impl Array {
    /// First letter of the dataset name: says the type without trusting the file's own declaration.
    fn tag(&self) -> &'static str {
        match self {
            Self::Floats { columns: 1, .. } => "f",
            Self::Floats { .. } => "v",
            Self::Integers(_) => "u",
            Self::Bytes(_) => "b",
        }
    }

    fn bytes(&self) -> &[u8] {
        match self {
            Self::Floats { values, .. } => bytemuck::cast_slice(values),
            Self::Integers(values) => bytemuck::cast_slice(values),
            Self::Bytes(values) => values,
        }
    }
}

impl Archive {
    /// An empty archive of this kind (such as `"checkpoint"`) and layout version.
    pub fn new(kind: &str, version: u32) -> Self {
        Self { kind: kind.to_owned(), version, arrays: BTreeMap::new() }
    }

    /// Stores numbers under a name, replacing what was there. Names may contain dots, not slashes.
    pub fn put_floats(&mut self, name: &str, values: &[f64]) {
        self.put(name, Array::Floats { values: values.to_vec(), columns: 1 });
    }

    /// Stores vectors under a name.
    pub fn put_vectors(&mut self, name: &str, values: &[DVec3]) {
        let values = values.iter().flat_map(DVec3::to_array).collect();
        self.put(name, Array::Floats { values, columns: 3 });
    }

    /// Stores integers under a name.
    pub fn put_integers(&mut self, name: &str, values: &[u64]) {
        self.put(name, Array::Integers(values.to_vec()));
    }

    /// Stores bytes under a name, such as the text of the case.
    pub fn put_bytes(&mut self, name: &str, values: &[u8]) {
        self.put(name, Array::Bytes(values.to_vec()));
    }

    fn put(&mut self, name: &str, array: Array) {
        self.arrays.insert(name.replace('/', "."), array);
    }

    /// What the archive is.
    pub fn kind(&self) -> &str {
        &self.kind
    }

    /// Names in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.arrays.keys().map(String::as_str)
    }

    /// Numbers stored under a name; `None` when there are none or they are of another type.
    pub fn floats(&self, name: &str) -> Option<&[f64]> {
        match self.arrays.get(name) {
            Some(Array::Floats { values, columns: 1 }) => Some(values),
            _ => None,
        }
    }

    /// Vectors stored under a name.
    pub fn vectors(&self, name: &str) -> Option<Vec<DVec3>> {
        match self.arrays.get(name) {
            Some(Array::Floats { values, columns: 3 }) => {
                Some(values.chunks_exact(3).map(DVec3::from_slice).collect())
            }
            _ => None,
        }
    }

    /// Integers stored under a name.
    pub fn integers(&self, name: &str) -> Option<&[u64]> {
        match self.arrays.get(name) {
            Some(Array::Integers(values)) => Some(values),
            _ => None,
        }
    }

    /// Bytes stored under a name.
    pub fn bytes(&self, name: &str) -> Option<&[u8]> {
        match self.arrays.get(name) {
            Some(Array::Bytes(values)) => Some(values),
            _ => None,
        }
    }

    /// SHA-256 over kind, version, names, types, lengths and bits, as 64 hexadecimal digits.
    fn digest(&self) -> String {
        let mut hasher = Sha256::new();
        let mut part = |bytes: &[u8]| {
            hasher.update((bytes.len() as u64).to_le_bytes());
            hasher.update(bytes);
        };
        part(self.kind.as_bytes());
        part(&self.version.to_le_bytes());
        for (name, array) in &self.arrays {
            part(name.as_bytes());
            part(array.tag().as_bytes());
            part(array.bytes());
        }
        hex(&hasher.finalize())
    }

    /// Writes the file whole or not at all, and forces it to disk.
    ///
    /// # Errors
    /// [`IoError::System`] or [`IoError::Hdf5`]; a file that was there before is then untouched.
    pub fn write(&self, path: &Path) -> Result<(), IoError> {
        let draft = atomic::beside(path, "new");
        if let Err(text) = self.write_draft(&draft) {
            atomic::remove_if_present(&draft);
            return Err(IoError::hdf5(path, "write", text));
        }
        atomic::publish(&draft, path)
    }

    fn write_draft(&self, draft: &Path) -> Result<(), String> {
        let file = Writer::create(draft)?;
        file.text("", "Kind", &self.kind)?;
        file.text("", "Version", &self.version.to_string())?;
        file.text("", "Sha256", &self.digest())?;
        file.group(GROUP)?;
        for (name, array) in &self.arrays {
            let path = format!("{GROUP}/{}:{name}", array.tag());
            match array {
                Array::Floats { values, columns } => {
                    file.fixed(&path, Values::F64(values), (*columns > 1).then_some(*columns))?;
                }
                Array::Integers(values) => file.fixed(&path, Values::U64(values), None)?,
                Array::Bytes(values) => file.fixed(&path, Values::U8(values), None)?,
            }
        }
        file.close()
    }

    /// Reads an archive of this kind and layout version.
    ///
    /// # Errors
    /// [`IoError::System`] or [`IoError::Hdf5`] when it cannot be opened, [`IoError::Kind`] when it is of another
    /// kind or version, [`IoError::Damaged`] when the digest does not match the content.
    pub fn read(path: &Path, kind: &str, version: u32) -> Result<Self, IoError> {
        let failed = |text| IoError::hdf5(path, "read", text);
        // A missing file is the usual case for a cache; the system's own error says so without guessing.
        std::fs::metadata(path).map_err(|source| IoError::system(path, "read", source))?;
        let file = Reader::open(path).map_err(failed)?;
        let attribute = |name| file.text("", name).unwrap_or_default();
        let found = (attribute("Kind"), attribute("Version"));
        if found != (kind.to_owned(), version.to_string()) {
            return Err(IoError::Kind {
                path: path.to_owned(),
                found: format!("\"{}\" version \"{}\"", found.0, found.1),
                expected: format!("\"{kind}\" version \"{version}\""),
            });
        }
        let mut archive = Self::new(kind, version);
        for entry in file.datasets(GROUP).map_err(failed)? {
            let dataset = format!("{GROUP}/{entry}");
            let array = match entry.split_once(':') {
                Some(("f", _)) => Array::Floats { values: file.all(&dataset).map_err(failed)?, columns: 1 },
                Some(("v", _)) => Array::Floats { values: file.all(&dataset).map_err(failed)?, columns: 3 },
                Some(("u", _)) => Array::Integers(file.all(&dataset).map_err(failed)?),
                Some(("b", _)) => Array::Bytes(file.all(&dataset).map_err(failed)?),
                _ => continue,
            };
            archive.arrays.insert(entry[2..].to_owned(), array);
        }
        if archive.digest() != attribute("Sha256") {
            let what = "its content does not match its SHA-256 digest".to_owned();
            return Err(IoError::Damaged { path: path.to_owned(), what });
        }
        Ok(archive)
    }
}

/// Lower-case hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn example() -> Archive {
        let mut archive = Archive::new("checkpoint", 3);
        archive.put_floats("time", &[0.1 + 0.2]);
        archive.put_floats("fluid.density", &[f64::NAN, -0.0, f64::INFINITY, f64::from_bits(1)]);
        archive.put_vectors("fluid.position", &[DVec3::new(1.0, 2.0, 1.0 / 3.0), DVec3::NEG_ONE]);
        archive.put_integers("fluid.id", &[0, u64::MAX]);
        archive.put_bytes("case", "title = \"Größe\"".as_bytes());
        archive.put_vectors("wall.position", &[]);
        archive.put_floats("wall.density", &[]);
        archive.put_bytes("note", b"");
        archive
    }

    #[test]
    fn every_bit_comes_back() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.h5");
        example().write(&path).unwrap();
        let read = Archive::read(&path, "checkpoint", 3).unwrap();
        assert_eq!(read, example());
        assert_eq!(read.vectors("fluid.position").unwrap()[0].z, 1.0 / 3.0);
        assert_eq!(read.floats("fluid.density").unwrap()[1].to_bits(), (-0.0_f64).to_bits());
        assert_eq!(read.integers("fluid.id"), Some(&[0, u64::MAX][..]));
        assert_eq!(read.vectors("wall.position"), Some(Vec::new()));
        assert!(read.floats("fluid.id").is_none() && read.floats("fluid.position").is_none());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn other_kinds_and_versions_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.h5");
        example().write(&path).unwrap();
        let error = Archive::read(&path, "checkpoint", 4).unwrap_err();
        assert!(
            matches!(error, IoError::Kind { .. }) && error.to_string().contains("version \"3\""),
            "{error}"
        );
        assert!(matches!(Archive::read(&path, "particles", 3), Err(IoError::Kind { .. })));
        assert!(Archive::read(folder.path(), "checkpoint", 3).is_err());
        assert!(matches!(
            Archive::read(&folder.path().join("no.h5"), "checkpoint", 3),
            Err(IoError::System { .. })
        ));
    }

    // The C library runs for minutes on some of these files; what it makes of damage is not ours to test.
    #[cfg(not(feature = "hdf5-c"))]
    /// Flipping any byte either leaves every array as it was (the byte is padding) or is an error.
    #[test]
    fn no_flipped_byte_and_no_cut_is_ever_taken_for_data() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("checkpoint.h5");
        let original = example();
        original.write(&path).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        let mut refused = 0;
        for place in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[place] ^= 0x41;
            std::fs::write(&path, &damaged).unwrap();
            match Archive::read(&path, "checkpoint", 3) {
                Ok(read) => assert_eq!(read, original, "byte {place}"),
                Err(_) => refused += 1,
            }
        }
        assert!(refused > bytes.len() / 4, "only {refused} of {} flips were noticed", bytes.len());
        for length in (0..bytes.len()).step_by(7) {
            std::fs::write(&path, &bytes[..length]).unwrap();
            if let Ok(read) = Archive::read(&path, "checkpoint", 3) {
                assert_eq!(read, original, "cut to {length} bytes");
            }
        }
    }
}

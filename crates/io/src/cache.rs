//! Results worth keeping between runs, such as relaxed particles, found again by what they were made from.

use crate::IoError;
use crate::archive::{Archive, hex};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// Identity of a cached result: the SHA-256 digest of everything it depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct CacheKey([u8; 32]);

impl std::fmt::Display for CacheKey {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&hex(&self.0))
    }
}

/// Collects the inputs of a result. Each part is preceded by its length, so that parts cannot run together.
#[derive(Debug, Clone)]
pub struct KeyBuilder(Sha256);

impl KeyBuilder {
    /// Starts with the name of the step that makes the result; change it when the algorithm changes.
    pub fn new(step: &str) -> Self {
        Self(Sha256::new()).text(step)
    }

    /// Adds text.
    #[must_use]
    pub fn text(self, text: &str) -> Self {
        self.bytes(text.as_bytes())
    }

    /// Adds a number by its bits.
    #[must_use]
    pub fn number(self, value: f64) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    /// Adds numbers by their bits.
    #[must_use]
    pub fn numbers(self, values: &[f64]) -> Self {
        self.bytes(bytemuck::cast_slice(values))
    }

    /// Adds an integer.
    #[must_use]
    pub fn integer(self, value: u64) -> Self {
        self.bytes(&value.to_le_bytes())
    }

    /// Adds bytes, such as the content of a surface file.
    #[must_use]
    pub fn bytes(mut self, bytes: &[u8]) -> Self {
        self.0.update((bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
        self
    }

    /// The key.
    pub fn finish(self) -> CacheKey {
        CacheKey(self.0.finalize().into())
    }
}

/// A folder of cached results. Losing it costs time and nothing else.
#[derive(Debug, Clone)]
pub struct Cache {
    folder: PathBuf,
}

impl Cache {
    /// A cache in this folder, which is made with the first result.
    pub fn new(folder: impl Into<PathBuf>) -> Self {
        Self { folder: folder.into() }
    }

    fn path(&self, key: &CacheKey, kind: &str) -> PathBuf {
        self.folder.join(format!("{kind}-{}.h5", &key.to_string()[..16]))
    }

    /// The result of that key; `None` when there is none or when it cannot be trusted (damaged, another
    /// version, another key), in which case it is simply made again.
    pub fn load(&self, key: &CacheKey, kind: &str, version: u32) -> Option<Archive> {
        let archive = Archive::read(&self.path(key, kind), kind, version).ok()?;
        (archive.bytes(KEY) == Some(&key.0)).then_some(archive)
    }

    /// Keeps a result; the archive of a kind that [`Self::load`] will be asked for.
    ///
    /// # Errors
    /// [`IoError::System`] or [`IoError::Hdf5`]; a caller may well go on without.
    pub fn store(&self, key: &CacheKey, archive: &Archive) -> Result<PathBuf, IoError> {
        std::fs::create_dir_all(&self.folder)
            .map_err(|source| IoError::system(&self.folder, "make", source))?;
        let path = self.path(key, archive.kind());
        let mut archive = archive.clone();
        archive.put_bytes(KEY, &key.0);
        archive.write(&path)?;
        Ok(path)
    }

    /// Where the results are.
    pub fn folder(&self) -> &Path {
        &self.folder
    }
}

const KEY: &str = "cache.key";

#[cfg(test)]
mod tests {
    use super::*;

    fn key(spacing: f64) -> CacheKey {
        KeyBuilder::new("relax 1").bytes(b"solid ...").number(spacing).integer(200).finish()
    }

    fn result() -> Archive {
        let mut archive = Archive::new("particles", 1);
        archive.put_floats("fluid.volume", &[1.25e-10]);
        archive
    }

    #[test]
    fn results_are_found_by_their_inputs_only() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path().join("cache"));
        assert!(cache.load(&key(5e-4), "particles", 1).is_none());
        cache.store(&key(5e-4), &result()).unwrap();
        let found = cache.load(&key(5e-4), "particles", 1).unwrap();
        assert_eq!(found.floats("fluid.volume"), Some(&[1.25e-10][..]));
        assert!(cache.load(&key(5e-4_f64.next_up()), "particles", 1).is_none());
        assert!(cache.load(&key(5e-4), "particles", 2).is_none());
    }

    #[test]
    fn parts_do_not_run_together() {
        let two = |a: &str, b: &str| KeyBuilder::new("x").text(a).text(b).finish();
        assert_ne!(two("ab", "c"), two("a", "bc"));
        // Published test vector (FIPS 180-4 examples: "abc"), so that keys do not change with the crate.
        assert_eq!(
            hex(&Sha256::digest(b"abc")),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }

    #[test]
    fn a_file_under_the_name_of_another_key_is_not_believed() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path());
        let stored = cache.store(&key(5e-4), &result()).unwrap();
        std::fs::rename(stored, cache.path(&key(4e-4), "particles")).unwrap();
        assert!(cache.load(&key(4e-4), "particles", 1).is_none());
    }

    #[test]
    fn a_damaged_result_is_made_again() {
        let folder = tempfile::tempdir().unwrap();
        let cache = Cache::new(folder.path());
        let path = cache.store(&key(5e-4), &result()).unwrap();
        let bytes = std::fs::read(&path).unwrap();
        std::fs::write(&path, &bytes[..bytes.len() / 2]).unwrap();
        assert!(cache.load(&key(5e-4), "particles", 1).is_none());
        cache.store(&key(5e-4), &result()).unwrap();
        assert!(cache.load(&key(5e-4), "particles", 1).is_some());
    }
}

//! Bodies as the cache keeps them.

use crate::bodies::FluidBody;
use crate::case::Case;
use serde_json::{from_slice, to_vec};
use std::path::Path;
use vaso_generation::{Body, Ends, Lattice, Settings, ShellBody, ShellReference, ShellSettings, Wall};
use vaso_io::{Archive, Cache, CacheKey, KeyBuilder};
use vaso_scene::{Generator, Word};

/// Layout version of cached particles; to be raised whenever generation changes its results.
const VERSION: u32 = 6;

/// A body that can be kept.
pub trait Kept: Sized {
    /// Kind of its archive.
    const KIND: &'static str;

    /// Puts the body into an archive.
    fn put(&self, archive: &mut Archive);

    /// The body of an archive; `None` where something is missing.
    fn get(archive: &Archive) -> Option<Self>;
}

/// A body with the time it took \[s\], from the cache in `folder`.
pub(crate) fn load<T: Kept>(folder: &Path, key: &CacheKey) -> Option<(T, f64)> {
    let archive = Cache::new(folder).load(key, T::KIND, VERSION)?;
    Some((T::get(&archive)?, *archive.floats("seconds")?.first()?))
}

/// The archive of a body that took `seconds` \[s\].
pub(crate) fn pack<T: Kept>(body: &T, seconds: f64) -> Archive {
    let mut archive = Archive::new(T::KIND, VERSION);
    archive.put_floats("seconds", &[seconds]);
    body.put(&mut archive);
    archive
}

impl Kept for FluidBody {
    const KIND: &'static str = "fluid-particles";

    fn put(&self, archive: &mut Archive) {
        put_body(archive, &self.body);
        put_json(archive, "blocks", &self.blocks);
    }

    fn get(archive: &Archive) -> Option<Self> {
        Some(Self { body: get_body(archive)?, blocks: get_json(archive, "blocks")? })
    }
}

impl Kept for Wall {
    const KIND: &'static str = "wall-particles";

    fn put(&self, archive: &mut Archive) {
        put_body(archive, &self.body);
        put_flags(archive, "clamped", &self.clamped);
        archive.put_floats("shared", &[self.shared, self.thickness]);
    }

    fn get(archive: &Archive) -> Option<Self> {
        let [shared, thickness] = *archive.floats("shared")?.first_chunk::<2>()?;
        let (body, clamped) = (get_body(archive)?, get_flags(archive, "clamped")?);
        Some(Self { body, clamped, shared, thickness })
    }
}

impl Kept for ShellBody {
    const KIND: &'static str = "shell-particles";

    fn put(&self, archive: &mut Archive) {
        archive.put_vectors("position", &self.position);
        archive.put_vectors("normal", &self.normal);
        archive.put_floats("area", &self.area);
        archive.put_floats("thickness", &self.thickness);
        archive.put_floats("curvature", self.curvature.as_flattened());
        put_flags(archive, "clamped", &self.clamped);
        put_json(archive, "quality", &self.quality);
    }

    fn get(archive: &Archive) -> Option<Self> {
        Some(Self {
            position: archive.vectors("position")?,
            normal: archive.vectors("normal")?,
            area: archive.floats("area")?.to_vec(),
            thickness: archive.floats("thickness")?.to_vec(),
            curvature: archive.floats("curvature")?.as_chunks::<2>().0.to_vec(),
            clamped: get_flags(archive, "clamped")?,
            quality: get_json(archive, "quality")?,
        })
    }
}

fn put_body(archive: &mut Archive, body: &Body) {
    archive.put_vectors("position", &body.position);
    archive.put_vectors("normal", &body.normal);
    archive.put_floats("depth", &body.depth);
    archive.put_floats("volume", &body.volume);
    put_json(archive, "quality", &body.quality);
}

fn get_body(archive: &Archive) -> Option<Body> {
    Some(Body {
        position: archive.vectors("position")?,
        volume: archive.floats("volume")?.to_vec(),
        normal: archive.vectors("normal")?,
        depth: archive.floats("depth")?.to_vec(),
        quality: get_json(archive, "quality")?,
    })
}

fn put_json<T: serde::Serialize>(archive: &mut Archive, name: &str, value: &T) {
    let text = to_vec(value).expect("plain structs with string keys always serialize");
    archive.put_bytes(name, &text);
}

/// `None` also where a number was not finite, as JSON has none of those: such a body is made again.
fn get_json<T: serde::de::DeserializeOwned>(archive: &Archive, name: &str) -> Option<T> {
    from_slice(archive.bytes(name)?).ok()
}

fn put_flags(archive: &mut Archive, name: &str, flags: &[bool]) {
    archive.put_bytes(name, &flags.iter().map(|&flag| u8::from(flag)).collect::<Vec<_>>());
}

fn get_flags(archive: &Archive, name: &str) -> Option<Vec<bool>> {
    Some(archive.bytes(name)?.iter().map(|&byte| byte != 0).collect())
}

/// The key of a body, of everything it was made from.
pub(crate) struct BodyKey(KeyBuilder);

/// Starts the key of a body of that kind with the vessel of `case`.
pub(crate) fn key<T: Kept>(case: &Case) -> BodyKey {
    let surface = &case.vessel.surface;
    let mut builder = KeyBuilder::new(T::KIND).integer(u64::from(VERSION));
    for v in &surface.vertices {
        builder = builder.numbers(&v.to_array());
    }
    for t in &surface.triangles {
        builder = t.iter().fold(builder, |b, &i| b.integer(u64::from(i)));
    }
    for opening in &case.vessel.openings {
        builder = builder.numbers(&opening.center.to_array()).numbers(&opening.normal.to_array());
    }
    BodyKey(builder)
}

impl BodyKey {
    pub(crate) fn relaxed(self, settings: &Settings) -> Self {
        let &Settings { spacing, smoothing, lattice, steps, seed } = settings;
        let lattice = match lattice {
            Lattice::Bcc => "bcc",
            _ => "cubic",
        };
        Self(self.0.numbers(&[spacing, smoothing]).text(lattice).integer(steps as u64).integer(seed))
    }

    pub(crate) fn generator(self, generator: Generator, sweeps: usize) -> Self {
        let (kind, word) = match generator {
            Generator::RelaxedLattice(lattice) => ("relaxed-lattice", lattice.word()),
            Generator::Multiblock(topology) => ("multiblock", topology.word()),
        };
        Self(self.0.text(kind).text(word).integer(sweeps as u64))
    }

    pub(crate) fn number(self, value: f64) -> Self {
        Self(self.0.number(value))
    }

    pub(crate) fn ends(self, ends: Ends) -> Self {
        Self(match ends {
            Ends::ClosestCap => self.0.text("closest-cap"),
            Ends::Boxes => self.0.text("boxes"),
            Ends::Collar { length } => self.0.text("collar").number(length),
        })
    }

    pub(crate) fn shell(self, settings: &ShellSettings) -> Self {
        let &ShellSettings { spacing, smoothing, thickness, reference, collar, steps, seed, .. } = settings;
        let reference = match reference {
            ShellReference::Lumen => "lumen",
            ShellReference::MidSurface => "mid-surface",
        };
        let numbers = self.0.numbers(&[spacing, smoothing, thickness, collar]);
        Self(numbers.text(reference).integer(steps as u64).integer(seed))
    }

    pub(crate) fn finish(self) -> CacheKey {
        self.0.finish()
    }
}

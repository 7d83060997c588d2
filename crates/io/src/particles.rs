//! What `vaso particles` leaves: `particles.vtkhdf`, all bodies in one file of one frame, and
//! `particles.json`, their quality.

use crate::check::{OpeningEntry, SurfaceReport};
use crate::summary::ParticleCounts;
use crate::{Frame, IoError, SeriesWriter, json, schema};
use glam::DVec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Which body a particle belongs to: the value of the point field `Body`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum BodyKind {
    /// Blood: 0.
    Fluid,
    /// Wall of several layers: 1.
    Wall,
    /// Wall of one layer: 2.
    Shell,
}

impl BodyKind {
    /// The number in the field `Body`.
    pub fn number(self) -> f64 {
        match self {
            Self::Fluid => 0.0,
            Self::Wall => 1.0,
            Self::Shell => 2.0,
        }
    }
}

/// One generated body.
#[derive(Debug, Clone, Copy)]
pub struct BodyParticles<'a> {
    /// Which body.
    pub kind: BodyKind,
    /// Positions \[m\].
    pub position: &'a [DVec3],
    /// Volume of each particle \[m^3\].
    pub volume: &'a [f64],
    /// Unit normals out of the lumen; empty for a body without (written as zero vectors).
    pub normal: &'a [DVec3],
    /// Distances outside the lumen surface \[m\]; empty for a body without (written as zeros).
    pub depth: &'a [f64],
}

/// Writes all bodies into one VTKHDF file with the point fields `Body`, `Volume`, `Normal`, `Depth` and `Id`
/// (the index within the body). ParaView's threshold on `Body` shows one of them alone.
///
/// # Errors
/// [`IoError::Mismatch`] when an array has neither no entries nor one a particle, otherwise as
/// [`SeriesWriter::append`].
pub fn write_particles(path: &Path, bodies: &[BodyParticles<'_>]) -> Result<(), IoError> {
    let count = bodies.iter().map(|body| body.position.len()).sum();
    let mut position = Vec::with_capacity(count);
    let mut normal = Vec::with_capacity(count);
    let (mut kind, mut volume, mut depth) =
        (Vec::with_capacity(count), Vec::with_capacity(count), Vec::with_capacity(count));
    let mut ids = Vec::with_capacity(count);
    for body in bodies {
        let n = body.position.len();
        let lengths = [
            (schema::NORMAL, body.normal.len(), true),
            (schema::DEPTH, body.depth.len(), true),
            (schema::VOLUME, body.volume.len(), false),
        ];
        for (name, length, optional) in lengths {
            if length != n && !(optional && length == 0) {
                let what = format!("field `{name}` has {length} values for {n} particles");
                return Err(IoError::Mismatch { path: path.to_owned(), what });
            }
        }
        position.extend_from_slice(body.position);
        normal.extend_from_slice(body.normal);
        normal.resize(position.len(), DVec3::ZERO);
        depth.extend_from_slice(body.depth);
        depth.resize(position.len(), 0.0);
        kind.resize(position.len(), body.kind.number());
        volume.extend_from_slice(body.volume);
        ids.extend(0..n as u64);
    }
    SeriesWriter::create(path).append(&Frame {
        time: 0.0,
        position: &position,
        scalars: vec![(schema::BODY, &kind), (schema::VOLUME, &volume), (schema::DEPTH, &depth)],
        vectors: vec![(schema::NORMAL, &normal)],
        ids: Some(&ids),
    })
}

/// `particles.json`: the outcome of `vaso particles`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ParticlesReport {
    /// Version of the program.
    pub vaso_version: String,
    /// Title of the case.
    pub case: String,
    /// Generator used.
    pub generator: String,
    /// Particle spacing \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// The geometry audit.
    pub surface: SurfaceReport,
    /// Openings, largest first.
    pub openings: Vec<OpeningEntry>,
    /// Particles of each body.
    pub particles: ParticleCounts,
    /// Quality by body name (`fluid`, `wall`, `shell`).
    pub quality: BTreeMap<String, Quality>,
    /// Advice.
    #[serde(default)]
    pub warnings: Vec<String>,
}

/// Quality of one generated body; lengths in particle spacings.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Quality {
    /// Number of particles.
    pub count: u64,
    /// Sum of particle volumes over the volume they stand for, minus one \[-\].
    #[serde(deserialize_with = "json::number")]
    pub volume_error: f64,
    /// Smallest distance between two particles \[spacings\].
    #[serde(deserialize_with = "json::number")]
    pub nearest_neighbor_min: f64,
    /// Standard deviation over mean of the distance to the nearest particle \[-\].
    #[serde(deserialize_with = "json::number")]
    pub nearest_neighbor_cv: f64,
    /// Mean of the kernel sum over particles with full support \[-\]; `None` where no particle has it.
    pub kernel_sum_mean: Option<f64>,
    /// Standard deviation of the kernel sum \[-\].
    pub kernel_sum_std: Option<f64>,
    /// Root mean square of the kernel gradient sum, times the spacing \[-\].
    #[serde(deserialize_with = "json::number")]
    pub gradient_residual_rms: f64,
    /// Standard deviation over mean of the particle volumes \[-\].
    #[serde(deserialize_with = "json::number")]
    pub volume_cv: f64,
    /// Particles on the wrong side of the surface.
    pub outside: u64,
    /// Wall time of the generation \[s\].
    pub seconds: Option<f64>,
    /// Relaxation iterations.
    pub iterations: u64,
}

json::file!(ParticlesReport);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::SeriesReader;

    #[test]
    fn bodies_stay_apart_in_one_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("particles.vtkhdf");
        let fluid = [DVec3::ZERO, DVec3::X];
        let wall = [DVec3::Y];
        let body = BodyParticles {
            kind: BodyKind::Fluid,
            position: &fluid,
            volume: &[0.125; 2],
            normal: &[],
            depth: &[],
        };
        let outer = BodyParticles {
            kind: BodyKind::Wall,
            position: &wall,
            volume: &[0.25],
            normal: &[DVec3::Y],
            depth: &[0.5],
        };
        write_particles(&path, &[body, outer]).unwrap();
        let frame = SeriesReader::open(&path).unwrap().frame(0).unwrap();
        assert_eq!(frame.scalar("Body"), Some(&[0.0, 0.0, 1.0][..]));
        assert_eq!(frame.scalar("Volume"), Some(&[0.125, 0.125, 0.25][..]));
        assert_eq!(frame.scalar("Depth"), Some(&[0.0, 0.0, 0.5][..]));
        assert_eq!(frame.vector("Normal"), Some(&[DVec3::ZERO, DVec3::ZERO, DVec3::Y][..]));
        assert_eq!(frame.ids, Some(vec![0, 1, 0]));

        let short = BodyParticles { depth: &[0.5, 0.5], ..outer };
        assert!(matches!(write_particles(&path, &[short]), Err(IoError::Mismatch { .. })));
    }
}

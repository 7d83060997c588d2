//! `particles.vtkhdf`: all bodies that `vaso particles` made, in one file of one frame.

use crate::{Frame, IoError, SeriesWriter, schema};
use glam::DVec3;
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
#[derive(Debug, Clone)]
pub struct BodyParticles<'a> {
    /// Which body.
    pub kind: BodyKind,
    /// Positions \[m\].
    pub position: &'a [DVec3],
    /// Unit normals out of the lumen; empty for a body without (written as zero vectors).
    pub normal: &'a [DVec3],
    /// Other quantities by the name of their field, one value a particle. One that another body lacks is written as
    /// zeros there.
    pub scalars: Vec<(&'static str, Vec<f64>)>,
}

/// Writes all bodies into one VTKHDF file with the point fields `Body`, `Normal`, `Id` (the index within the body) and
/// the scalars of the bodies. ParaView's threshold on `Body` shows one of them alone.
///
/// # Errors
/// [`IoError::Mismatch`] when an array has not one entry a particle, otherwise as [`SeriesWriter::append`].
pub fn write_particles(path: &Path, bodies: &[BodyParticles<'_>]) -> Result<(), IoError> {
    let count = bodies.iter().map(|body| body.position.len()).sum();
    let mut position = Vec::with_capacity(count);
    let mut normal = Vec::with_capacity(count);
    let mut kind = Vec::with_capacity(count);
    let mut ids = Vec::with_capacity(count);
    let mut scalars: Vec<(&str, Vec<f64>)> = Vec::new();
    for body in bodies {
        let n = body.position.len();
        let lengths = body.scalars.iter().map(|(name, values)| (*name, values.len()));
        let vectors = (!body.normal.is_empty()).then_some((schema::NORMAL, body.normal.len()));
        if let Some((name, length)) = lengths.chain(vectors).find(|(_, length)| *length != n) {
            let what = format!("field `{name}` has {length} values for {n} particles");
            return Err(IoError::Mismatch { path: path.to_owned(), what });
        }
        for (name, values) in &body.scalars {
            let at = scalars.iter().position(|(known, _)| known == name).unwrap_or_else(|| {
                scalars.push((*name, Vec::with_capacity(count)));
                scalars.len() - 1
            });
            scalars[at].1.resize(position.len(), 0.0);
            scalars[at].1.extend_from_slice(values);
        }
        position.extend_from_slice(body.position);
        normal.extend_from_slice(body.normal);
        normal.resize(position.len(), DVec3::ZERO);
        kind.resize(position.len(), body.kind.number());
        ids.extend(0..n as u64);
    }
    for (_, values) in &mut scalars {
        values.resize(count, 0.0);
    }
    let kind = std::iter::once((schema::BODY, kind.as_slice()));
    SeriesWriter::create(path).append(&Frame {
        time: 0.0,
        position: &position,
        scalars: kind.chain(scalars.iter().map(|(name, values)| (*name, values.as_slice()))).collect(),
        vectors: vec![(schema::NORMAL, &normal)],
        ids: Some(&ids),
    })
}

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
            normal: &[],
            scalars: vec![("Volume", vec![0.125; 2])],
        };
        let outer = BodyParticles {
            kind: BodyKind::Wall,
            position: &wall,
            normal: &[DVec3::Y],
            scalars: vec![("Volume", vec![0.25]), ("Depth", vec![0.5])],
        };
        write_particles(&path, &[body.clone(), outer.clone()]).unwrap();
        let frame = SeriesReader::open(&path).unwrap().frame(0).unwrap();
        assert_eq!(frame.scalar("Body"), Some(&[0.0, 0.0, 1.0][..]));
        assert_eq!(frame.scalar("Volume"), Some(&[0.125, 0.125, 0.25][..]));
        assert_eq!(frame.scalar("Depth"), Some(&[0.0, 0.0, 0.5][..]));
        assert_eq!(frame.vector("Normal"), Some(&[DVec3::ZERO, DVec3::ZERO, DVec3::Y][..]));
        assert_eq!(frame.ids, Some(vec![0, 1, 0]));

        // What the last body lacks is filled up too.
        write_particles(&path, &[outer.clone(), body]).unwrap();
        let frame = SeriesReader::open(&path).unwrap().frame(0).unwrap();
        assert_eq!(frame.scalar("Depth"), Some(&[0.5, 0.0, 0.0][..]));

        let long = BodyParticles { scalars: vec![("Depth", vec![0.5, 0.5])], ..outer };
        assert!(matches!(write_particles(&path, &[long]), Err(IoError::Mismatch { .. })));
    }
}

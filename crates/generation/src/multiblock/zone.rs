//! What blocks leave over: a region filled by the relaxed lattice.

use crate::faces::Faces;
use crate::lumen::Lumen;
use crate::region::Region;
use crate::relax::Relaxation;
use crate::{GenerationError, Settings, lattice};
use glam::DVec3;
use rayon::prelude::*;
use vaso_geometry::SignedDistance;
use vaso_kernels::Wendland;

/// The lumen less the stretches filled by blocks.
pub(super) struct Zone<'a> {
    pub(super) lumen: &'a Lumen<'a>,
    /// Distance to the blocks, negative in them; `None` where there are none.
    pub(super) blocks: Option<SignedDistance>,
}

impl Zone<'_> {
    /// Distance outside the blocks \[m\], negative in them.
    pub(super) fn outside_blocks(&self, x: DVec3) -> f64 {
        self.blocks.as_ref().map_or(f64::INFINITY, |b| b.query(x).distance)
    }
}

impl Region for Zone<'_> {
    fn bounds(&self) -> (DVec3, DVec3) {
        self.lumen.bounds()
    }

    fn level(&self, x: DVec3) -> f64 {
        let level = self.lumen.level(x);
        // Far outside the lumen nobody asks how far the blocks are.
        if level > 0.0 { level } else { level.max(-self.outside_blocks(x)) }
    }

    fn exact_level(&self, x: DVec3) -> f64 {
        let level = self.lumen.exact_level(x);
        if level > 0.0 { level } else { level.max(-self.outside_blocks(x)) }
    }

    /// Faces of the lumen only: at the blocks their particles hold the place.
    fn faces(&self, x: DVec3) -> Faces {
        self.lumen.faces(x)
    }

    fn exact_faces(&self, x: DVec3) -> Faces {
        self.lumen.exact_faces(x)
    }
}

/// Fills what blocks left over, `volume` \[m^3\], with particles relaxed among theirs.
pub(super) fn fill(
    zone: &Zone<'_>,
    volume: f64,
    blocks: &[DVec3],
    settings: &Settings,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<(Vec<DVec3>, usize), GenerationError> {
    let &Settings { spacing, smoothing, lattice, steps, seed } = settings;
    let count = (volume / spacing.powi(3)).round().max(0.0) as usize;
    if count == 0 {
        return Ok((Vec::new(), 0));
    }
    let mut position = lattice::deepest_sites(zone, lattice, spacing, count)
        .ok_or(GenerationError::Empty { spacing, volume })?;
    let kernel = Wendland::new(smoothing * spacing);
    // Blocks deeper than this below their surface are out of reach.
    let reach = 2.0 * kernel.support();
    let fixed: Vec<DVec3> = blocks.par_iter().copied().filter(|x| zone.outside_blocks(*x) > -reach).collect();
    let relaxation = Relaxation { region: zone, kernel, spacing, volume: volume / count as f64 };
    let made = relaxation.run_among(&mut position, &fixed, steps, seed, progress);
    Ok((position, made.iterations))
}

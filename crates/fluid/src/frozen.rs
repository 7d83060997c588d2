//! What is found once an advective step and holds for its acoustic steps.

use crate::cap::CapZone;
use crate::law::pressure::FULL;
use crate::numbers::Numbers;
use glam::DVec3;
use vaso_kernels::{Real, Sym3};

/// What is found of a particle in an advective step, and kept at the precision of the pairs.
///
/// What some loop reads for itself stands in a column of its own ([`Columns`]), and what the acoustic steps read in [`ForMomentum`] and
/// [`ForContinuity`]: memory is what the loops of a large flow wait for.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frozen<R> {
    /// Correction matrix B.
    correction: [R; 6],
    /// `sum V grad W` over the fluid \[1/m\].
    fluid_gradient: [R; 3],
    /// `sum V grad W` over the wall \[1/m\].
    wall_gradient: [R; 3],
    /// What the own pressure multiplies \[1/m\]: `-B_i sum V grad W`, so that pairs have the difference of their pressures; where
    /// [`Self::takes_pressure`], `sum V B_j grad W` over the fluid plus `B_i` times that over the wall, the sum.
    own_pressure: [R; 3],
    /// Unit normal of the nearest wall, towards the fluid.
    wall_normal: [R; 3],
    /// `sum V (x_j - x_i) (x) grad W` over the fluid: the part of the moment matrix that continuity sees.
    fluid_moment: [R; 6],
    /// What continuity takes for compression in a flow that only shears, by uneven neighbours \[1/s\]; zero near caps.
    false_convergence: R,
    /// What the sum over the fluid finds of a divergence along the wall has to be multiplied by, as the fluid ends there; 1 away from walls.
    along_wall: R,
    /// `sum V |dW/dr|` over the wall \[1/m\].
    wall_area: R,
    /// Depth behind a cap \[supports\] as [`CapDivergence`](crate::law::density::CapDivergence) takes it; [`FAR`] away from
    /// caps.
    cap_depth: R,
    /// Whether the pressure of an opening enters here, see [`CapZone::takes_pressure`].
    takes_pressure: bool,
}

/// [`Frozen::cap_depth`] away from caps.
pub(crate) const FAR: f64 = 1e3;

/// Sums of the kernel over the neighbours of a particle, as they are found.
pub(crate) struct Moments {
    /// Correction matrix B.
    pub correction: Sym3,
    /// `sum V grad W` over the fluid \[1/m\].
    pub fluid_gradient: DVec3,
    /// The same over the wall \[1/m\].
    pub wall_gradient: DVec3,
    /// `sum V |dW/dr|` over the wall \[1/m\].
    pub wall_area: f64,
    /// Moment matrix of the fluid alone.
    pub fluid_moment: Sym3,
    /// See [`Frozen`].
    pub along_wall: f64,
}

impl<R: Real> Frozen<R> {
    /// Of a particle near the wall of unit normal `normal`, zero away from it, and near the cap of `zone`.
    pub(crate) fn new(normal: DVec3, zone: Option<&CapZone>, support: f64) -> Self {
        Self {
            correction: Sym3::IDENTITY.0.map(R::pack),
            fluid_gradient: Default::default(),
            wall_gradient: Default::default(),
            own_pressure: Default::default(),
            wall_normal: pack(normal),
            fluid_moment: Default::default(),
            false_convergence: R::default(),
            along_wall: R::pack(1.0),
            wall_area: R::default(),
            cap_depth: R::pack(zone.map_or(FAR, |zone| zone.open_depth() / support)),
            takes_pressure: zone.is_some_and(|zone| zone.takes_pressure),
        }
    }

    pub(crate) fn set_moments(&mut self, m: &Moments) {
        self.correction = m.correction.0.map(R::pack);
        self.fluid_gradient = pack(m.fluid_gradient);
        self.wall_gradient = pack(m.wall_gradient);
        self.wall_area = R::pack(m.wall_area);
        self.fluid_moment = m.fluid_moment.0.map(R::pack);
        self.along_wall = R::pack(m.along_wall);
    }

    /// Takes `neighbours`, the `sum V B_j grad W` over the fluid \[1/m\], and returns `sum V (B_i + B_j) grad W`.
    pub(crate) fn set_own_pressure(&mut self, neighbours: DVec3) -> DVec3 {
        let (b, wall) = (self.correction(), widen(self.wall_gradient));
        let own = b.mul(widen(self.fluid_gradient) + wall);
        let mirrored = neighbours + b.mul(wall);
        self.own_pressure = pack(if self.takes_pressure { mirrored } else { -own });
        mirrored + own
    }

    pub(crate) fn set_false_convergence(&mut self, value: f64) {
        self.false_convergence = R::pack(self.along_wall.widen() * value);
    }

    #[inline(always)]
    pub(crate) fn correction(&self) -> Sym3 {
        Sym3(self.correction.map(R::widen))
    }

    #[inline(always)]
    pub(crate) fn fluid_moment(&self) -> Sym3 {
        Sym3(self.fluid_moment.map(R::widen))
    }

    #[inline(always)]
    pub(crate) fn wall_normal(&self) -> DVec3 {
        widen(self.wall_normal)
    }

    pub(crate) fn is_near_cap(&self) -> bool {
        self.cap_depth.widen() < FAR
    }
}

/// What single loops read of the particles, each column by itself.
#[derive(Clone, Debug, Default)]
pub(crate) struct Columns<R> {
    /// Acceleration that changes only with the advective step: viscosity \[m/s^2\].
    pub acceleration: Vec<[R; 3]>,
    /// `sum V (B_i + B_j) grad W`, zero where the support is complete \[1/m\].
    pub support: Vec<[R; 3]>,
    /// Inverse distance to the wall \[1/m\]; zero where it is beyond reach.
    pub inverse_distance: Vec<R>,
}

impl<R: Real> Columns<R> {
    pub(crate) fn resize(&mut self, n: usize) {
        self.acceleration.resize(n, Default::default());
        self.support.resize(n, Default::default());
        self.inverse_distance.resize(n, R::default());
    }

    pub(crate) fn acceleration(&self, i: usize) -> DVec3 {
        widen(self.acceleration[i])
    }

    pub(crate) fn support(&self, i: usize) -> DVec3 {
        widen(self.support[i])
    }

    /// Distance to the wall \[m\]; zero where it is beyond reach.
    pub(crate) fn wall_distance(&self, i: usize) -> f64 {
        distance_of(self.inverse_distance[i])
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        size_of::<R>()
            * (3 * (self.acceleration.capacity() + self.support.capacity())
                + self.inverse_distance.capacity())
    }
}

/// What the momentum law reads of a particle in each acoustic step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ForMomentum<R> {
    correction: [R; 6],
    own_pressure: [R; 3],
    acceleration: [R; 3],
    normal: [R; 3],
    closing: [R; 3],
    /// Depth behind a cap, see [`Frozen`].
    pub(crate) cap_depth: R,
}

impl<R: Real> ForMomentum<R> {
    /// Of a wall at rest the dissipation pushes along the normal; of one that `moves` it is a pressure, with a pair for each wall
    /// particle, so that the wall gets back what it gives.
    pub(crate) fn new(frozen: &Frozen<R>, acceleration: [R; 3], moves: bool) -> Self {
        let closing = if moves {
            -frozen.correction().mul(widen(frozen.wall_gradient))
        } else {
            frozen.wall_area.widen() * frozen.wall_normal()
        };
        Self {
            correction: frozen.correction,
            own_pressure: frozen.own_pressure,
            acceleration,
            normal: frozen.wall_normal,
            closing: pack(closing),
            cap_depth: frozen.cap_depth,
        }
    }

    /// `B_i v`.
    #[inline(always)]
    pub(crate) fn correct(&self, v: DVec3) -> DVec3 {
        Sym3(self.correction.map(R::widen)).mul(v)
    }

    /// What the own pressure multiplies, see [`Frozen`] \[1/m\].
    #[inline(always)]
    pub(crate) fn own_pressure(&self) -> DVec3 {
        widen(self.own_pressure)
    }

    /// Acceleration that changes only with the advective step \[m/s^2\].
    #[inline(always)]
    pub(crate) fn acceleration(&self) -> DVec3 {
        widen(self.acceleration)
    }

    /// Force by volume of the dissipation between the particle and its mirror image behind the wall \[N/m^3\], at its velocity relative to
    /// the wall \[m/s\].
    #[inline(always)]
    pub(crate) fn dissipation(&self, relative: DVec3, numbers: &Numbers) -> DVec3 {
        self.closing_pressure(relative, numbers) * widen(self.closing)
    }

    /// Pressure of that dissipation \[Pa\].
    #[inline(always)]
    pub(crate) fn closing_pressure(&self, relative: DVec3, numbers: &Numbers) -> f64 {
        let closing = (-2.0 * relative.dot(widen(self.normal))).max(0.0);
        let limited = (FULL * closing / numbers.sound_speed).min(1.0);
        limited * numbers.rest_density * numbers.sound_speed * closing
    }
}

/// The same of the continuity law.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ForContinuity<R> {
    meeting: [R; 3],
    along_wall: R,
    false_convergence: R,
}

impl<R: Real> ForContinuity<R> {
    pub(crate) fn new(frozen: &Frozen<R>) -> Self {
        let normal = frozen.wall_normal();
        // The mirrored velocity doubles the part of the wall.
        let meeting = 2.0 * widen(frozen.wall_gradient).dot(normal) * normal;
        Self {
            meeting: pack(meeting),
            along_wall: frozen.along_wall,
            false_convergence: frozen.false_convergence,
        }
    }

    /// Convergence \[1/s\] between a particle of velocity `v` \[m/s\] and the wall as if that were at rest, less what continuity takes
    /// wrongly for one.
    #[inline(always)]
    pub(crate) fn convergence(&self, v: DVec3) -> f64 {
        v.dot(widen(self.meeting)) - self.false_convergence.widen()
    }

    /// Whether there is too little fluid beside the wall.
    #[inline(always)]
    pub(crate) fn is_beside_wall(&self) -> bool {
        self.along_wall() > 1.0
    }

    /// What a divergence along the wall has to be multiplied by, see [`Frozen`].
    #[inline(always)]
    pub(crate) fn along_wall(&self) -> f64 {
        self.along_wall.widen()
    }
}

/// Distance \[m\] by its inverse \[1/m\]; zero where that is.
#[inline(always)]
pub(crate) fn distance_of<R: Real>(inverse: R) -> f64 {
    let inverse = inverse.widen();
    if inverse > 0.0 { 1.0 / inverse } else { 0.0 }
}

#[inline(always)]
pub(crate) fn pack<R: Real>(v: DVec3) -> [R; 3] {
    v.to_array().map(R::pack)
}

#[inline(always)]
pub(crate) fn widen<R: Real>(v: [R; 3]) -> DVec3 {
    DVec3::from_array(v.map(R::widen))
}

/// What the particles of a chunk have among them, by which the laws of an acoustic step are chosen.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ChunkKind {
    /// Some are near a cap.
    pub(crate) near_cap: bool,
    /// Some have too little fluid beside the wall.
    pub(crate) beside_wall: bool,
}

impl ChunkKind {
    pub(crate) fn of<R: Real>(frozen: &[Frozen<R>]) -> Self {
        Self {
            near_cap: frozen.iter().any(Frozen::is_near_cap),
            beside_wall: frozen.iter().any(|f| f.along_wall.widen() > 1.0),
        }
    }
}

//! A wall that moves: what the fluid sees of it anew, and the forces it hands back.
//!
//! Positions are taken once an advective step ([`Fluid::take_wall`]), velocities after each acoustic step of the wall
//! ([`Fluid::set_wall_velocity`]). A fluid whose wall is at rest has none of this.

use crate::fluid::{Fluid, numbered};
use crate::law::moving::{self, SurfaceDisplacement, WallContact, WallVelocity};
use crate::wall::Arrangement;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Real, Records, Store, sweep};
use vaso_particles::WallView;

/// State of a wall that moves.
pub(crate) struct Moving<R> {
    /// The wall particles within reach, as they come in the view.
    pub(crate) arrangement: Arrangement,
    /// Where each particle of the view is among those within reach; [`OUT_OF_REACH`] for the others.
    pub(crate) place: Vec<u32>,
    /// Where the particles of the view were when the distance to the wall was measured \[m\].
    origin: Vec<DVec3>,
    /// What the motion of each particle of the view counts for at the lumen surface, see [`Fluid::release_wall`].
    pub(crate) lever: Vec<f64>,
    /// Acceleration of each wall particle within reach \[m/s^2\].
    acceleration: Vec<DVec3>,
    /// Displacement and depth \[supports\] of the wall within reach.
    displaced: Records<R>,
    /// Displacement of the lumen surface near each fluid particle \[m\].
    pub(crate) displacement: Vec<DVec3>,
    /// Velocity of the wall near each fluid particle \[m/s\].
    pub(crate) velocity: Vec<DVec3>,
    /// `sum V (v_a . n) (grad W . n)` at each fluid particle, with the other sign \[1/s\].
    flux: Vec<f64>,
    /// Bend of the velocity near the wall \[1/(m s)\], for the viscous force on it.
    pub(crate) bend: Vec<DVec3>,
    /// Correction matrices of the fluid, which the pair laws of the wall read.
    pub(crate) correction: Records<R>,
    /// Fluid as the wall sees it: its scalar is what the wall gets from it.
    pub(crate) seen: Records<R>,
    /// Sums over the fluid around each wall particle within reach, of which its pressure and its [`Contact`](crate::Contact) are made.
    pub(crate) contact: Vec<[f64; moving::CONTACT_SUMS]>,
    /// Sums of the viscous force on each wall particle within reach, and what is added to them.
    pub(crate) drag: Vec<[f64; 3]>,
    pub(crate) part: Vec<[f64; 3]>,
}

/// Place of a particle of the view that the fluid does not see.
pub(crate) const OUT_OF_REACH: u32 = u32::MAX;

/// Bounds of the factors of [`Fluid::release_wall`]: at creases the divergence of the normals is none of a surface.
const LEVERS: (f64, f64) = (0.7, 1.3);

/// What of a wall enters the acoustic step, at rest or in motion.
pub(crate) trait Wall: Sync {
    /// Velocity of the wall near particle `i` \[m/s\].
    fn velocity(&self, i: usize) -> DVec3;
    /// Half of the divergence at particle `i` that the motion of the wall adds, with the other sign \[1/s\].
    fn flux(&self, i: usize) -> f64;
}

/// A wall at rest.
pub(crate) struct AtRest;

impl Wall for AtRest {
    #[inline(always)]
    fn velocity(&self, _: usize) -> DVec3 {
        DVec3::ZERO
    }

    #[inline(always)]
    fn flux(&self, _: usize) -> f64 {
        0.0
    }
}

impl<R> Moving<R> {
    /// Place in the view of each wall particle within reach.
    pub(crate) fn source(&self) -> &[u32] {
        &self.arrangement.source
    }

    /// Takes accelerations in the order of the view.
    fn accelerate(&mut self, acceleration: &[DVec3]) {
        if acceleration.is_empty() {
            return self.acceleration.clear();
        }
        let source = &self.arrangement.source;
        self.acceleration.resize(source.len(), DVec3::ZERO);
        let columns = (&mut self.acceleration, source).into_par_iter().with_min_len(1024);
        columns.for_each(|(own, &a)| *own = acceleration[a as usize]);
    }
}

impl<R: Real> Wall for Moving<R> {
    #[inline(always)]
    fn velocity(&self, i: usize) -> DVec3 {
        self.velocity[i]
    }

    #[inline(always)]
    fn flux(&self, i: usize) -> f64 {
        self.flux[i]
    }
}

impl<R: Real> Fluid<R> {
    /// Lets the wall move from now on. `view` is the wall as it was when the distance to it was measured, in the order of all
    /// views to come.
    ///
    /// `thinning` is the strain across the wall per strain of its area. Behind a curved surface particles at the depth `s` move by
    /// `1 - thinning s (k1 + k2)` of what the surface does. Where they keep their volume, at a thinning of 1, sums over the kernel fall short of
    /// what is swept by as much as they exceed it where all move alike, at 0 (`docs/theory/coupling.md`); a half is right. So a velocity counts by
    /// `1 + (thinning - 1/2) s (k1 + k2)`, and so does the level of the pressure where a wall takes it from the sums, see `Contact`.
    ///
    /// # Panics
    /// If the lists of the view differ in length.
    pub fn release_wall(&mut self, view: &WallView, thinning: f64) {
        let n = view.position.len();
        assert!(
            view.velocity.len() == n && view.depth.len() == n && view.volume.len() == n,
            "an entry a particle"
        );
        self.moving = Some(Box::new(Moving {
            arrangement: Arrangement::default(),
            place: Vec::new(),
            origin: view.position.to_vec(),
            lever: if thinning == 0.5 { vec![1.0; n] } else { self.levers(view, thinning) },
            acceleration: Vec::new(),
            displaced: Records::default(),
            displacement: Vec::new(),
            velocity: Vec::new(),
            flux: Vec::new(),
            bend: Vec::new(),
            correction: Records::default(),
            seen: Records::default(),
            contact: Vec::new(),
            drag: Vec::new(),
            part: Vec::new(),
        }));
        self.take_wall(view, &[]);
    }

    /// Where the particles of a wall that moves were when the distance to it was measured \[m\], in the order of its views.
    pub fn wall_origin(&self) -> Option<&[DVec3]> {
        self.moving.as_ref().map(|moving| moving.origin.as_slice())
    }

    /// Factors for the particles of a wall, by the divergence of the normals at the lumen surface in front of each.
    fn levers(&self, view: &WallView, thinning: f64) -> Vec<f64> {
        let step = self.numbers.spacing;
        let lever = |(x, depth): (&DVec3, &f64)| {
            let (_, normal) = self.distance(*x);
            let foot = *x - *depth * normal;
            let bend = |axis: DVec3| {
                let [ahead, behind] = [1.0, -1.0].map(|side| self.distance(foot + side * step * axis).1);
                (ahead - behind).dot(axis) / (2.0 * step)
            };
            let curvature: f64 = DVec3::AXES.into_iter().map(bend).sum();
            (1.0 + (thinning - 0.5) * depth * curvature).clamp(LEVERS.0, LEVERS.1)
        };
        view.position.par_iter().zip(view.depth).with_min_len(1024).map(lever).collect()
    }

    /// Takes the wall anew before [`Self::search`]: positions, velocities and, in the same order, accelerations \[m/s^2\]. The
    /// latter may be empty, for a wall that is not accelerated.
    ///
    /// # Panics
    /// Without [`Self::release_wall`] before it, or if lists differ in length.
    pub fn take_wall(&mut self, view: &WallView, acceleration: &[DVec3]) {
        let moving = self.moving.as_mut().expect("the wall has been released");
        assert!(view.position.len() == moving.origin.len(), "the particles the wall was released with");
        assert!(acceleration.is_empty() || acceleration.len() == moving.origin.len(), "an entry a particle");
        self.wall.arrange(view, &self.frame, &mut moving.arrangement);
        let support = self.frame.support();
        let Moving { arrangement: Arrangement { source, .. }, place, origin, displaced, .. } = &mut **moving;
        place.clear();
        place.resize(origin.len(), OUT_OF_REACH);
        source.iter().enumerate().for_each(|(k, &a)| place[a as usize] = k as u32);
        displaced.resize(source.len());
        let records = self.wall.kinematic.as_slice();
        displaced.fill(|k| {
            let a = source[k] as usize;
            let u = view.position[a] - origin[a];
            let mut record = records[k];
            (record[4], record[5], record[6]) = (R::pack(u.x), R::pack(u.y), R::pack(u.z));
            record[7] = R::pack(view.depth[a] / support);
            record
        });
        moving.accelerate(acceleration);
    }

    /// Gives the wall its velocities \[m/s\] and accelerations \[m/s^2\] after an acoustic step of `dt` \[s\], in the order of its
    /// view. As for [`Self::take_wall`] there may be no accelerations.
    pub fn set_wall_velocity(&mut self, velocity: &[DVec3], acceleration: &[DVec3], dt: f64) {
        let Some(moving) = &mut self.moving else { return };
        moving.accelerate(acceleration);
        let (source, lever) = (moving.source(), &moving.lever);
        self.wall.dynamic.as_mut_slice().par_iter_mut().zip(source).with_min_len(1024).for_each(
            |(record, &a)| {
                let v = lever[a as usize] * velocity[a as usize];
                (record[4], record[5], record[6]) = (R::pack(v.x), R::pack(v.y), R::pack(v.z));
            },
        );
        self.see_wall_velocity();
        if let Some(moving) = &mut self.moving {
            let Moving { displacement, velocity, .. } = &mut **moving;
            displacement.par_iter_mut().zip(velocity).with_min_len(4096).for_each(|(u, v)| *u += dt * *v);
        }
    }

    /// Finds displacement and velocity of the wall near each particle, after the rows have been found.
    pub(crate) fn see_wall(&mut self) {
        let n = self.state.len();
        // Volumes and the like are filled in by the summation.
        self.fill_current(|_, _| [0.0; 2]);
        // The normals that the flux wants are known when the acoustic steps begin.
        self.second.resize(n);
        self.second.fill(|_| [R::pack(0.0); 8]);
        let Some(moving) = &mut self.moving else { return };
        moving.displacement.clear();
        moving.displacement.resize(n, DVec3::ZERO);
        let gather = Gather {
            frame: &self.frame,
            own: &self.current,
            other: &moving.displaced,
            own_second: None,
            other_second: None,
        };
        let isa = self.isa;
        (moving.displacement.par_chunks_mut(CHUNK), self.wall.fluid_rows.chunks())
            .into_par_iter()
            .enumerate()
            .filter(|(_, (_, row))| !row.has_no_pairs())
            .for_each(|(c, (displacement, row))| {
                let mut sums = [[0.0; moving::DISPLACEMENT_SUMS]; CHUNK];
                sweep(isa, &SurfaceDisplacement, &gather, numbered(row, c), Store::None, &mut sums);
                for (u, sums) in displacement.iter_mut().zip(&sums) {
                    *u = DVec3::from_array(moving::surface_displacement(sums));
                }
            });
        self.see_wall_velocity();
    }

    fn see_wall_velocity(&mut self) {
        let n = self.state.len();
        let gradient = self.kernel.gradient_scale();
        let Some(moving) = &mut self.moving else { return };
        moving.velocity.resize(n, DVec3::ZERO);
        moving.flux.resize(n, 0.0);
        let gather = Gather {
            frame: &self.frame,
            own: &self.current,
            other: &self.wall.dynamic,
            own_second: Some(&self.second),
            other_second: None,
        };
        let isa = self.isa;
        (
            moving.velocity.par_chunks_mut(CHUNK),
            moving.flux.par_chunks_mut(CHUNK),
            self.wall.fluid_rows.chunks(),
        )
            .into_par_iter()
            .enumerate()
            .for_each(|(c, (velocity, flux, row))| {
                if row.has_no_pairs() {
                    velocity.fill(DVec3::ZERO);
                    flux.fill(0.0);
                    return;
                }
                let mut sums = [[0.0; moving::VELOCITY_SUMS]; CHUNK];
                sweep(isa, &WallVelocity, &gather, numbered(row, c), Store::None, &mut sums);
                for (k, [divergence, weight, x, y, z]) in sums.into_iter().enumerate().take(velocity.len()) {
                    flux[k] = gradient * divergence;
                    velocity[k] = if weight > 0.0 { DVec3::new(x, y, z) / weight } else { DVec3::ZERO };
                }
            });
    }

    /// Pressure of the particles of a wall that moves: the kernel mean of that of the fluid, continued by the acceleration of the
    /// wall (Adami, Hu and Adams 2012, eq. 27). Of the same neighbours comes what the kick will do to the wall.
    pub(crate) fn moving_wall_pressure(&mut self) {
        let Some(mut moving) = self.moving.take() else { return };
        self.show_pressure(&mut moving);
        let per_separation = self.numbers.rest_density * self.frame.support();
        let dynamic = &self.wall.dynamic;
        let mut contact = std::mem::take(&mut moving.contact);
        self.gather_on_wall(&WallContact, dynamic, &moving, &mut contact);
        let records = self.wall.dynamic.as_mut_slice();
        (records, &mut contact).into_par_iter().enumerate().with_min_len(1024).for_each(
            |(k, (record, sums))| {
                let [weighted, weight, x, y, z, ..] = *sums;
                let near = record[7].widen();
                let a = moving.acceleration.get(k).copied().unwrap_or_default();
                let continued = weighted - per_separation * a.dot(DVec3::new(x, y, z));
                record[7] = R::pack(if weight > 0.0 { near + continued / weight } else { 0.0 });
                // From here on the first sum is the pressure that the others are relative to.
                sums[0] = near;
            },
        );
        moving.contact = contact;
        self.moving = Some(moving);
    }

    /// Bytes held for a wall that moves.
    pub(crate) fn moving_bytes(&self) -> usize {
        let Some(m) = &self.moving else { return 0 };
        let vectors = m.origin.capacity()
            + m.acceleration.capacity()
            + m.displacement.capacity()
            + m.velocity.capacity()
            + m.bend.capacity();
        size_of::<DVec3>() * vectors
            + 8 * (m.flux.capacity() + m.lever.capacity())
            + 4 * m.place.capacity()
            + m.arrangement.bytes()
            + size_of::<[f64; 3]>() * (m.drag.capacity() + m.part.capacity())
            + size_of::<[f64; moving::CONTACT_SUMS]>() * m.contact.capacity()
            + m.displaced.bytes()
            + m.correction.bytes()
            + m.seen.bytes()
    }
}

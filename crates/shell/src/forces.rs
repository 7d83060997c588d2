//! The way from positions and directors to accelerations: gradient, hourglass control and section, divergence.

use crate::damping::Damper;
use crate::error::ShellError;
use crate::lanes::{self, Section};
use crate::law::{DIRECTOR_UNIT, DISPLACEMENT_UNIT, Divergence, Gradient, Hourglass};
use crate::material::{Material, Model};
use crate::numbers::Numbers;
use crate::reference::Reference;
use crate::section::{Layer, Motion};
use crate::spread::Stretch;
use crate::state::ShellState;
use glam::{DMat3, DVec3};
use rayon::iter::Either;
use rayon::prelude::*;
use vaso_kernels::{
    BLOCK, BlockColumn, CHUNK, FIELDS, Gather, Isa, Real, Records, Store, reduce_in_order, run_on, sweep,
    sweep_links, sweep_points,
};

/// Working memory of a shell.
pub(crate) struct Forces<R> {
    pub(crate) material: Material,
    pub(crate) reference: Reference<R>,
    /// What never changes of the sections, block by block.
    fixed: Vec<BlockColumn>,
    n_fixed: usize,
    pub(crate) motion: Vec<Motion>,
    /// Displacement gradient of the mid-surface, `F - I`, the director its third column.
    pub(crate) gradient: Vec<DMat3>,
    /// Strain of the step before, for its rate, block by block; empty without damping.
    strain: Vec<[BlockColumn; 8]>,
    /// Areas where the shell stands; empty unless they have been asked for since it came there.
    pub(crate) stretch: Vec<Stretch>,
    /// Force \[Pa\] and couple \[N/m\] by area that the particle gives itself.
    pub(crate) own: Vec<[DVec3; 2]>,
    /// Displacement and change of the director; read for the gradient.
    pub(crate) kinematic: Records<R>,
    /// Reference position, displacement, and the last entry of the matrix in `matrix`.
    jump: Records<R>,
    matrix: Records<R>,
    /// Columns of the force and of the moment.
    pub(crate) force: Records<R>,
    pub(crate) moment: Records<R>,
    pub(crate) isa: Isa,
}

/// Points through the thickness; none for resultants.
fn points(material: &Material) -> usize {
    if let Model::NeoHookean { points } = material.model() { points } else { 0 }
}

impl<R: Real> Forces<R> {
    pub(crate) fn new(
        material: Material,
        reference: Reference<R>,
        thickness: &[f64],
        numbers: &Numbers,
        isa: Isa,
    ) -> Self {
        let n = reference.base.len();
        let sized = || {
            let mut records = Records::default();
            records.resize(n);
            records
        };
        let n_fixed = lanes::fixed_columns(points(&material));
        let mut fixed = vec![[0.0; BLOCK]; n.div_ceil(BLOCK) * n_fixed];
        // Its factors are those of a damping of one, which may change.
        let damper = Damper::new(&material, &Numbers { damping: 1.0, ..*numbers });
        for (i, base) in reference.base.iter().enumerate() {
            let layers: Vec<Layer> = Layer::of(base, thickness[i], points(&material)).collect();
            let block = &mut fixed[i / BLOCK * n_fixed..][..n_fixed];
            let viscous = damper.factors(thickness[i], numbers.rotary(thickness[i]));
            lanes::fix(block, i % BLOCK, base, thickness[i], viscous, &layers);
        }
        Self {
            material,
            fixed,
            n_fixed,
            motion: vec![Motion::default(); n],
            gradient: vec![DMat3::ZERO; n],
            strain: if numbers.damping > 0.0 { vec![lanes::blank(); n.div_ceil(BLOCK)] } else { Vec::new() },
            stretch: Vec::new(),
            own: vec![[DVec3::ZERO; 2]; n],
            kinematic: sized(),
            jump: reference.blank.clone(),
            matrix: sized(),
            force: sized(),
            moment: sized(),
            reference,
            isa,
        }
    }

    /// Layers of particle `i` of a `thickness` \[m\]; none for resultants.
    pub(crate) fn layers(&self, i: usize, thickness: f64) -> Vec<Layer> {
        Layer::of(&self.reference.base[i], thickness, points(&self.material)).collect()
    }

    /// Writes the accelerations of positions and directors; returns the power \[W\] that damping took in the step `dt` \[s\] that
    /// led here, 0 for none.
    pub(crate) fn accelerate(
        &mut self,
        state: &mut ShellState,
        numbers: &Numbers,
        dt: f64,
    ) -> Result<f64, ShellError> {
        self.stretch.clear();
        self.pack(state);
        self.differentiate(state);
        let power = self.resultants(state, numbers, dt)?;
        self.divergence(state);
        Ok(power)
    }

    fn pack(&mut self, state: &ShellState) {
        let (isa, in_supports) = (self.isa, 1.0 / self.reference.frame.support());
        let columns = (
            self.kinematic.as_mut_slice().par_chunks_mut(CHUNK),
            self.jump.as_mut_slice().par_chunks_mut(CHUNK),
            state.displacement.par_chunks(CHUNK),
            state.director.par_chunks(CHUNK),
            state.reference_director.par_chunks(CHUNK),
        );
        columns.into_par_iter().for_each(|(kinematic, jump, displacement, director, reference)| {
            let columns = kinematic.iter_mut().zip(jump).zip(displacement).zip(director).zip(reference);
            run_on(
                isa,
                #[inline(always)]
                || {
                    for ((((kinematic, jump), displacement), director), reference) in columns {
                        let u = (*displacement * in_supports).to_array();
                        let n = (*director - *reference).to_array();
                        for k in 0..3 {
                            // Wraps around far from the reference position: only differences are read.
                            kinematic[k] =
                                R::coordinate((u[k] * (1.0 / DISPLACEMENT_UNIT)) as i64 as i32, u[k]);
                            kinematic[3 + k] =
                                R::coordinate((n[k] * (1.0 / DIRECTOR_UNIT)) as i64 as i32, n[k]);
                        }
                        jump[4..7].copy_from_slice(&kinematic[..3]);
                    }
                },
            );
        });
    }

    /// Gradients of displacement and director.
    fn differentiate(&mut self, state: &ShellState) {
        let (isa, reference, kinematic) = (self.isa, &self.reference, &self.kinematic);
        let support = reference.frame.support();
        self.motion
            .par_chunks_mut(CHUNK)
            .zip(self.gradient.par_chunks_mut(CHUNK))
            .zip(self.jump.as_mut_slice().par_chunks_mut(CHUNK))
            .zip(self.matrix.as_mut_slice().par_chunks_mut(CHUNK))
            .zip(reference.rows.chunks())
            .enumerate()
            .for_each(|(c, ((((motion, gradient), jump), matrix), row))| {
                let mut sums = [[0.0; 12]; CHUNK];
                let stored = &reference.forward.chunks()[c];
                sweep_links(isa, &Gradient, (kinematic, None), (row, c * CHUNK), stored, &mut sums);
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for (k, motion) in motion.iter_mut().enumerate() {
                            let i = c * CHUNK + k;
                            let (s, base) = (&sums[k], &reference.base[i]);
                            // The sums are of own minus neighbour.
                            motion.u = [0, 1].map(|a| -support * DVec3::new(s[a], s[2 + a], s[4 + a]));
                            motion.n = [0, 1].map(|a| -DVec3::new(s[6 + a], s[8 + a], s[10 + a]));
                            let turn = state.director[i] - base.director;
                            let dual = &base.dual;
                            let column = |v: [f64; 3]| v[0] * motion.u[0] + v[1] * motion.u[1] + v[2] * turn;
                            gradient[k] = DMat3::from_cols(
                                column([dual[0].x, dual[1].x, dual[2].x]),
                                column([dual[0].y, dual[1].y, dual[2].y]),
                                column([dual[0].z, dual[1].z, dual[2].z]),
                            );
                            let [x, y, z] = [gradient[k].x_axis, gradient[k].y_axis, gradient[k].z_axis];
                            matrix[k] = [x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z].map(R::pack);
                            jump[k][7] = R::pack(z.z);
                        }
                    },
                );
            });
    }

    /// What the pair loops of the hourglass control gather.
    pub(crate) fn gather(&self) -> Gather<'_, R> {
        Gather {
            frame: &self.reference.frame,
            own: &self.jump,
            other: &self.jump,
            own_second: Some(&self.matrix),
            other_second: Some(&self.matrix),
        }
    }

    /// Resultants of all particles, packed for the divergence; returns the power of damping.
    fn resultants(&mut self, state: &ShellState, numbers: &Numbers, dt: f64) -> Result<f64, ShellError> {
        let (isa, material, reference) = (self.isa, self.material, &self.reference);
        let support = reference.frame.support();
        let modulus = numbers.hourglass * material.young();
        let gather = Gather {
            frame: &reference.frame,
            own: &self.jump,
            other: &self.jump,
            own_second: Some(&self.matrix),
            other_second: Some(&self.matrix),
        };
        let (motion, gradient) = (&self.motion, &self.gradient);
        let (fixed, n_fixed) = (&self.fixed, self.n_fixed);
        let damping = if self.strain.is_empty() { 0.0 } else { numbers.damping };
        let section = Section::new(material, damping, dt);
        let per_chunk = CHUNK / BLOCK;
        let strains = if self.strain.is_empty() {
            Either::Left((0..reference.rows.chunks().len()).into_par_iter().map(|_| Default::default()))
        } else {
            Either::Right(self.strain.par_chunks_mut(per_chunk))
        };
        let power = self
            .own
            .par_chunks_mut(CHUNK)
            .zip(self.force.as_mut_slice().par_chunks_mut(CHUNK))
            .zip(self.moment.as_mut_slice().par_chunks_mut(CHUNK))
            .zip(strains)
            .zip(reference.rows.chunks())
            .enumerate()
            .map(|(c, ((((own, force), moment), strains), row))| -> Result<f64, usize> {
                let mut sums = [[0.0; 12]; CHUNK];
                if modulus > 0.0 {
                    let stored = Store::Read(&reference.hourglass.chunks()[c]);
                    sweep(isa, &Hourglass, &gather, (row, c * CHUNK), stored, &mut sums);
                }
                let (mut read, mut found) =
                    (lanes::blank::<{ lanes::OWN }>(), lanes::blank::<{ lanes::OUT }>());
                let mut power = 0.0;
                for b in 0..own.len().div_ceil(BLOCK) {
                    let (first, n) = (b * BLOCK, BLOCK.min(own.len() - b * BLOCK));
                    let mut inverted = None;
                    run_on(
                        isa,
                        #[inline(always)]
                        || {
                            for k in 0..n {
                                let i = c * CHUNK + first + k;
                                let determinant = (DMat3::IDENTITY + gradient[i]).determinant();
                                if determinant <= 0.0 || determinant.is_nan() {
                                    inverted.get_or_insert(i);
                                }
                                // Lengths in supports: their product brings one support back, the weight the rest.
                                let twist = std::array::from_fn(|a| -0.5 * modulus * sums[first + k][3 + a]);
                                lanes::show(&mut read, k, &motion[i], state.director[i], twist);
                            }
                        },
                    );
                    if let Some(i) = inverted {
                        return Err(i);
                    }
                    let strain = strains.get_mut(b).filter(|_| damping > 0.0);
                    if let Some(strain) = &strain {
                        lanes::before(&mut read).copy_from_slice(&strain[..]);
                    }
                    let block = &fixed[(c * per_chunk + b) * n_fixed..][..n_fixed];
                    sweep_points(isa, &section, n, block, &read, &mut found);
                    if let Some(strain) = strain {
                        strain.copy_from_slice(lanes::strains(&found));
                    }
                    run_on(
                        isa,
                        #[inline(always)]
                        || {
                            for k in 0..n {
                                let (i, at) = (c * CHUNK + first + k, first + k);
                                let (t, m, q, damped) = lanes::found(&found, k);
                                power += state.area[i] * damped;
                                let sums = &sums[at];
                                let direct = (-modulus / support) * DVec3::new(sums[0], sums[1], sums[2]);
                                let [w0, w1] = reference.own[i];
                                own[at] = [w0 * t[0] + w1 * t[1] + direct, w0 * m[0] + w1 * m[1] - q];
                                force[at] = packed(&t);
                                moment[at] = packed(&m);
                            }
                        },
                    );
                }
                Ok(power)
            });
        reduce_in_order(power, |a, b| Ok(a? + b?)).unwrap_or(Ok(0.0)).map_err(|i| ShellError::Inverted {
            particle: state.id[i],
            position: state.position(i),
            determinant: (DMat3::IDENTITY + gradient[i]).determinant(),
        })
    }

    /// Accelerations by the divergence of the resultants.
    fn divergence(&self, state: &mut ShellState) {
        let (isa, reference, own) = (self.isa, &self.reference, &self.own);
        let records = (&self.force, Some(&self.moment));
        let ShellState { acceleration, director_acceleration, director, area, mass, rotary_inertia, .. } =
            state;
        let (director, area, mass, inertia) = (&**director, &**area, &**mass, &**rotary_inertia);
        acceleration
            .par_chunks_mut(CHUNK)
            .zip(director_acceleration.par_chunks_mut(CHUNK))
            .zip(reference.rows.chunks())
            .enumerate()
            .for_each(|(c, ((acceleration, turning), row))| {
                let mut sums = [[0.0; 6]; CHUNK];
                let stored = &reference.backward.chunks()[c];
                sweep_links(isa, &Divergence, records, (row, c * CHUNK), stored, &mut sums);
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for (k, (a, turn)) in acceleration.iter_mut().zip(turning).enumerate() {
                            let i = c * CHUNK + k;
                            let s = &sums[k];
                            *a = (area[i] / mass[i]) * (own[i][0] + DVec3::new(s[0], s[1], s[2]));
                            let couple = own[i][1] + DVec3::new(s[3], s[4], s[5]);
                            *turn = (area[i] / inertia[i]) * across(couple, director[i]);
                        }
                    },
                );
            });
    }

    pub(crate) fn bytes(&self) -> usize {
        let records = [&self.kinematic, &self.jump, &self.matrix, &self.force, &self.moment];
        self.reference.bytes()
            + records.iter().map(|r| r.bytes()).sum::<usize>()
            + size_of::<BlockColumn>() * (self.fixed.capacity() + 8 * self.strain.capacity())
            + size_of::<Motion>() * self.motion.capacity()
            + size_of::<DMat3>() * self.gradient.capacity()
            + size_of::<Stretch>() * self.stretch.capacity()
            + size_of::<[DVec3; 2]>() * self.own.capacity()
    }
}

/// Part of a vector across the unit vector `n`.
#[inline(always)]
pub(crate) fn across(v: DVec3, n: DVec3) -> DVec3 {
    v - v.dot(n) * n
}

#[inline(always)]
fn packed<R: Real>([a, b]: &[DVec3; 2]) -> [R; FIELDS] {
    [a.x, a.y, a.z, b.x, b.y, b.z, 0.0, 0.0].map(R::pack)
}

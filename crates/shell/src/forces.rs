//! The way from positions and directors to accelerations: gradient, hourglass control and section, divergence.

use crate::damping::Damper;
use crate::error::ShellError;
use crate::law::{DIRECTOR_UNIT, DISPLACEMENT_UNIT, Divergence, Gradient, Hourglass};
use crate::material::{Material, Model};
use crate::numbers::Numbers;
use crate::reference::Reference;
use crate::section::{Layer, Motion, Present, Resultants, Strain, linear, parts, strain};
use crate::state::ShellState;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, FIELDS, Gather, Isa, Real, Records, Store, sweep, sweep_links};

/// Working memory of a shell.
pub(crate) struct Forces<R> {
    pub(crate) material: Material,
    pub(crate) reference: Reference<R>,
    /// Points through the thickness, particle by particle; none for resultants.
    layers: Vec<Layer>,
    n_layers: usize,
    pub(crate) motion: Vec<Motion>,
    /// Displacement gradient of the mid-surface, `F - I`, the director its third column.
    pub(crate) gradient: Vec<DMat3>,
    /// Strain of the step before, for its rate; empty without damping.
    strain: Vec<Strain>,
    /// Force \[Pa\] and couple \[N/m\] by area that the particle gives itself.
    own: Vec<[DVec3; 2]>,
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

/// Matrix of sums taken row by row, times `scale`.
#[inline(always)]
fn from_rows(m: &[f64], scale: f64) -> DMat3 {
    let row = |k: usize| DVec3::new(m[k], m[k + 3], m[k + 6]);
    scale * DMat3::from_cols(row(0), row(1), row(2))
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
        let n_layers = if let Model::NeoHookean { points } = material.model() { points } else { 0 };
        let with_layers = reference.base.iter().zip(thickness).take(if n_layers > 0 { n } else { 0 });
        let layers = with_layers.flat_map(|(base, t)| Layer::of(base, *t, n_layers)).collect();
        Self {
            material,
            layers,
            n_layers,
            motion: vec![Motion::default(); n],
            gradient: vec![DMat3::ZERO; n],
            strain: vec![[0.0; 8]; if numbers.damping > 0.0 { n } else { 0 }],
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

    pub(crate) fn layers(&self, i: usize) -> &[Layer] {
        &self.layers[i * self.n_layers..(i + 1) * self.n_layers]
    }

    /// Writes the accelerations of positions and directors; returns the power \[W\] that damping took in the step `dt` \[s\] that
    /// led here, 0 for none.
    pub(crate) fn accelerate(
        &mut self,
        state: &mut ShellState,
        numbers: &Numbers,
        dt: f64,
    ) -> Result<f64, ShellError> {
        self.pack(state);
        self.differentiate(state);
        let power = self.resultants(state, numbers, dt)?;
        self.divergence(state);
        Ok(power)
    }

    fn pack(&mut self, state: &ShellState) {
        let in_supports = 1.0 / self.reference.frame.support();
        let records = (self.kinematic.as_mut_slice(), self.jump.as_mut_slice());
        records.into_par_iter().enumerate().with_min_len(1024).for_each(|(i, (kinematic, jump))| {
            let u = (state.displacement[i] * in_supports).to_array();
            let n = (state.director[i] - state.reference_director[i]).to_array();
            for k in 0..3 {
                // Wraps around far from the reference position: only differences are read.
                kinematic[k] = R::coordinate((u[k] * (1.0 / DISPLACEMENT_UNIT)) as i64 as i32, u[k]);
                kinematic[3 + k] = R::coordinate((n[k] * (1.0 / DIRECTOR_UNIT)) as i64 as i32, n[k]);
            }
            jump[4..7].copy_from_slice(&kinematic[..3]);
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
        let (layers, n_layers) = (&self.layers, self.n_layers);
        let damper = Damper::new(&material, numbers);
        let mut strains: Vec<&mut [Strain]> = self.strain.chunks_mut(CHUNK).collect();
        strains.resize_with(reference.rows.chunks().len(), Default::default);
        let chunks: Vec<Result<f64, usize>> = self
            .own
            .par_chunks_mut(CHUNK)
            .zip(self.force.as_mut_slice().par_chunks_mut(CHUNK))
            .zip(self.moment.as_mut_slice().par_chunks_mut(CHUNK))
            .zip(strains)
            .zip(reference.rows.chunks())
            .enumerate()
            .map(|(c, ((((own, force), moment), strains), row))| {
                let mut sums = [[0.0; 12]; CHUNK];
                if modulus > 0.0 {
                    let stored = Store::Read(&reference.hourglass.chunks()[c]);
                    sweep(isa, &Hourglass, &gather, (row, c * CHUNK), stored, &mut sums);
                }
                let mut power = 0.0;
                for (k, own) in own.iter_mut().enumerate() {
                    let i = c * CHUNK + k;
                    let determinant = (DMat3::IDENTITY + gradient[i]).determinant();
                    if determinant <= 0.0 || determinant.is_nan() {
                        return Err(i);
                    }
                    let (base, thickness, director) =
                        (&reference.base[i], state.thickness[i], state.director[i]);
                    let present = Present::new(base, &motion[i], director);
                    let mut r = Resultants::default();
                    let e = strain(base, &motion[i], director);
                    let mut linear_part = [0.0; 8];
                    if n_layers > 0 {
                        r.add_layers(&material, &layers[i * n_layers..(i + 1) * n_layers], &present);
                    } else {
                        linear_part = linear(&material, thickness, &e);
                    }
                    if let Some(before) = strains.get_mut(k) {
                        if dt > 0.0 {
                            let rate = std::array::from_fn(|k| (e[k] - before[k]) / dt);
                            let viscous = damper.resultants(thickness, numbers.rotary(thickness), &rate);
                            power += state.area[i] * parts(&viscous, &rate).iter().sum::<f64>();
                            linear_part = std::array::from_fn(|k| linear_part[k] + viscous[k]);
                        }
                        *before = e;
                    }
                    r.add(&linear_part, &present);
                    // Lengths in supports: their product brings one support back, the weight the rest.
                    r.add_gradient(&from_rows(&sums[k][3..], -0.5 * modulus), base);
                    let direct = (-modulus / support) * DVec3::new(sums[k][0], sums[k][1], sums[k][2]);
                    let [w0, w1] = reference.own[i];
                    *own = [w0 * r.t[0] + w1 * r.t[1] + direct, w0 * r.m[0] + w1 * r.m[1] - r.q];
                    force[k] = packed(&r.t);
                    moment[k] = packed(&r.m);
                }
                Ok(power)
            })
            .collect();
        let mut power = 0.0;
        for chunk in chunks {
            power += chunk.map_err(|i| ShellError::Inverted {
                particle: state.id[i],
                position: state.position(i),
                determinant: (DMat3::IDENTITY + gradient[i]).determinant(),
            })?;
        }
        Ok(power)
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
                for (k, (a, turn)) in acceleration.iter_mut().zip(turning).enumerate() {
                    let i = c * CHUNK + k;
                    let s = &sums[k];
                    *a = (area[i] / mass[i]) * (own[i][0] + DVec3::new(s[0], s[1], s[2]));
                    let couple = own[i][1] + DVec3::new(s[3], s[4], s[5]);
                    *turn = (area[i] / inertia[i]) * across(couple, director[i]);
                }
            });
    }

    pub(crate) fn bytes(&self) -> usize {
        let records = [&self.kinematic, &self.jump, &self.matrix, &self.force, &self.moment];
        self.reference.bytes()
            + records.iter().map(|r| r.bytes()).sum::<usize>()
            + size_of::<Layer>() * self.layers.capacity()
            + size_of::<Motion>() * self.motion.capacity()
            + size_of::<DMat3>() * self.gradient.capacity()
            + size_of::<Strain>() * self.strain.capacity()
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

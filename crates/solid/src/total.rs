//! Total-Lagrangian body: strain, stress and force by the frozen neighbours of the reference configuration.

use crate::error::SolidError;
use crate::formulation::{Formulation, total};
use crate::law::DISPLACEMENT_UNIT;
use crate::law::force::Force;
use crate::law::hourglass::{HourglassEnergy, NeighbourGradient};
use crate::law::strain::{DAMPED_SUMS, DampedGradient, DisplacementGradient, SUMS};
use crate::mat3::{from_rows, full, pack};
use crate::material::{Elastic, Fibres, young};
use crate::numbers::Numbers;
use crate::reference::Reference;
use crate::state::SolidState;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, FIELDS, Gather, Isa, Real, Records, Store, sweep};
use vaso_particles::Visitor;

/// Working memory of a total-Lagrangian body.
pub(crate) struct TotalLagrangian<R, E> {
    material: E,
    reference: Reference<R>,
    /// Directions of the fibres, empty where the material has none.
    fibres: Vec<Fibres>,
    /// Displacement gradient G = F - I.
    gradient: Vec<DMat3>,
    /// Its rate \[1/s\], empty without viscosity.
    rate: Vec<DMat3>,
    /// Acceleration by damping between pairs \[m/s^2\], empty without.
    damping: Vec<DVec3>,
    /// First Piola-Kirchhoff stress of the hourglass control \[Pa\], empty unless it is variational.
    hourglass: Vec<DMat3>,
    /// Reference position, volume and displacement; read for the strain.
    kinematic: Records<R>,
    /// Velocity, where there is damping.
    velocity: Records<R>,
    /// As `kinematic`, and the last entry of the matrix in `matrix`; read for the force.
    dynamic: Records<R>,
    matrix: Records<R>,
    isa: Isa,
}

impl<R: Real, E: Elastic> TotalLagrangian<R, E> {
    pub(crate) fn new(
        material: E,
        reference: Reference<R>,
        fibres: Vec<Fibres>,
        numbers: &Numbers,
        isa: Isa,
    ) -> Self {
        let n = reference.correction.len();
        let all = reference.blank.len();
        let zeros = |on: bool| vec![DMat3::ZERO; if on { n } else { 0 }];
        let sized = |on: bool| {
            let mut records = Records::default();
            records.resize(if on { all } else { 0 });
            records
        };
        let damped = numbers.damping > 0.0;
        Self {
            material,
            fibres,
            gradient: zeros(true),
            rate: zeros(numbers.viscosity > 0.0),
            damping: vec![DVec3::ZERO; if damped { n } else { 0 }],
            hourglass: zeros(numbers.hourglass.variational && numbers.hourglass.stiffness > 0.0),
            kinematic: reference.blank.clone(),
            velocity: sized(damped),
            dynamic: reference.blank.clone(),
            matrix: sized(true),
            reference,
            isa,
        }
    }

    /// Hourglass modulus `k E` \[Pa\].
    fn hourglass_modulus(&self, numbers: &Numbers) -> f64 {
        let (bulk, shear) = (self.material.bulk_modulus(), self.material.shear_modulus());
        numbers.hourglass.stiffness * young(bulk, shear)
    }

    fn fibres(&self, i: usize) -> Fibres {
        self.fibres.get(i).copied().unwrap_or_default()
    }

    /// Displacement gradients, and damping of the speed `damping` \[m/s\] times that of the pairs.
    fn strain(&mut self, dt: f64, damping: f64) {
        let (isa, reference) = (self.isa, &self.reference);
        let gradient_scale = reference.kernel.gradient_scale() * reference.kernel.support();
        // -beta/2 rho c h 9/r^2 (x.v) grad W (W/W_0), by the density; h is half a support.
        let damping_scale = -2.25 * reference.kernel.gradient_scale() * damping;
        let gather = Gather {
            frame: &reference.frame,
            own: &self.kinematic,
            other: &self.kinematic,
            own_second: Some(&self.velocity),
            other_second: Some(&self.velocity),
        };
        let damped = !self.damping.is_empty();
        let correction = &reference.correction;
        let update = |i: usize, sums: &[f64], gradient: &mut DMat3, rate: Option<&mut DMat3>| {
            let new = from_rows(sums, gradient_scale) * full(&correction[i]);
            if let Some(rate) = rate {
                *rate = if dt > 0.0 { (1.0 / dt) * (new - *gradient) } else { DMat3::ZERO };
            }
            *gradient = new;
        };
        let rows = reference.rows.chunks();
        self.gradient
            .par_chunks_mut(CHUNK)
            .zip(chunks_or_none(&mut self.rate, rows.len()))
            .zip(chunks_or_none(&mut self.damping, rows.len()))
            .zip(rows)
            .enumerate()
            .for_each(|(c, (((gradient, rate), damping), row))| {
                if damped {
                    let mut sums = [[0.0; DAMPED_SUMS]; CHUNK];
                    sweep(isa, &DampedGradient, &gather, (row, c * CHUNK), Store::None, &mut sums);
                    for (k, (gradient, sums)) in gradient.iter_mut().zip(&sums).enumerate() {
                        update(c * CHUNK + k, sums, gradient, rate.get_mut(k));
                        damping[k] = damping_scale * DVec3::new(sums[9], sums[10], sums[11]);
                    }
                } else {
                    let mut sums = [[0.0; SUMS]; CHUNK];
                    sweep(isa, &DisplacementGradient, &gather, (row, c * CHUNK), Store::None, &mut sums);
                    for (k, (gradient, sums)) in gradient.iter_mut().zip(&sums).enumerate() {
                        update(c * CHUNK + k, sums, gradient, rate.get_mut(k));
                    }
                }
            });
    }

    /// Stress of the hourglass control by its derivative through the deformation gradients:
    /// `-1/2 sum_b V_b c_ab d_ab (x) X_ab`, of which two of three parts are known from the sums of the strain.
    fn hourglass(&mut self, modulus: f64) {
        if self.hourglass.is_empty() {
            return;
        }
        self.pack_gradient();
        let (isa, reference, gradient) = (self.isa, &self.reference, &self.gradient);
        let scale = reference.kernel.gradient_scale() * reference.kernel.support();
        let gather = matrices(reference, &self.dynamic, &self.matrix);
        self.hourglass.par_chunks_mut(CHUNK).zip(reference.rows.chunks()).enumerate().for_each(
            |(c, (stress, row))| {
                let mut sums = [[0.0; 9]; CHUNK];
                sweep(isa, &NeighbourGradient, &gather, (row, c * CHUNK), Store::None, &mut sums);
                for (k, (stress, sums)) in stress.iter_mut().zip(&sums).enumerate() {
                    let i = c * CHUNK + k;
                    let own = gradient[i] * full(&reference.moment[i]);
                    *stress = (-0.25 * modulus) * (own - from_rows(sums, scale));
                }
            },
        );
    }

    /// Packs the displacement gradients where the pair loops find matrices.
    fn pack_gradient(&mut self) {
        let n = self.gradient.len();
        (&mut self.dynamic.as_mut_slice()[..n], &mut self.matrix.as_mut_slice()[..n])
            .into_par_iter()
            .zip(&self.gradient)
            .zip(&self.kinematic.as_slice()[..n])
            .with_min_len(1024)
            .for_each(|(((dynamic, matrix), gradient), kinematic)| {
                *dynamic = *kinematic;
                (*matrix, dynamic[7]) = pack(gradient);
            });
        self.reference.copy_to_images(&mut self.dynamic, 4);
        self.reference.copy_to_images(&mut self.matrix, 0);
    }

    /// Stress of all particles, packed with the hourglass control as `Q = P B - k G / 2`; returns the power taken by damping and
    /// viscosity \[W\].
    fn stress(&mut self, state: &SolidState, viscosity: f64, hourglass: f64) -> Result<f64, SolidError> {
        let n = state.len();
        let material = self.material;
        let (gradient, rate, damping) = (&self.gradient, &self.rate, &self.damping);
        let (correction, kinematic) = (&self.reference.correction, &self.kinematic);
        let (fibres, hourglass_stress) = (&self.fibres, &self.hourglass);
        let chunks: Vec<Result<f64, usize>> = self.dynamic.as_mut_slice()[..n]
            .par_chunks_mut(CHUNK)
            .zip(self.matrix.as_mut_slice()[..n].par_chunks_mut(CHUNK))
            .enumerate()
            .map(|(c, (dynamic, matrix))| {
                let mut power = 0.0;
                for (k, (dynamic, matrix)) in dynamic.iter_mut().zip(matrix).enumerate() {
                    let i = c * CHUNK + k;
                    let f = DMat3::IDENTITY + gradient[i];
                    let determinant = f.determinant();
                    if determinant <= 0.0 || determinant.is_nan() {
                        return Err(i);
                    }
                    let mut first_piola = material.stress(&f, &fibres.get(i).copied().unwrap_or_default());
                    if let Some(rate) = rate.get(i) {
                        let product = f.transpose() * *rate;
                        let viscous = f * ((0.5 * viscosity) * (product + product.transpose()));
                        first_piola += viscous;
                        power += state.volume[i] * contraction(&viscous, rate);
                    }
                    if let Some(acceleration) = damping.get(i) {
                        power -= state.mass[i] * acceleration.dot(state.velocity[i]);
                    }
                    if let Some(stress) = hourglass_stress.get(i) {
                        first_piola += *stress;
                    }
                    let q = first_piola * full(&correction[i]) - (0.5 * hourglass) * gradient[i];
                    *dynamic = kinematic.as_slice()[i];
                    (*matrix, dynamic[7]) = pack(&q);
                }
                Ok(power)
            })
            .collect();
        self.reference.copy_to_images(&mut self.dynamic, 4);
        self.reference.copy_to_images(&mut self.matrix, 0);
        let mut power = 0.0;
        for chunk in chunks {
            power += chunk.map_err(|i| SolidError::Inverted {
                particle: state.id[i],
                position: state.position(i),
                determinant: self.deformation(i).determinant(),
            })?;
        }
        Ok(power)
    }

    /// Accelerations by the divergence of the stress.
    fn divergence(&self, state: &mut SolidState, density: f64, hourglass: f64) {
        let (isa, reference, damping) = (self.isa, &self.reference, &self.damping);
        let scale = -reference.kernel.gradient_scale() / density;
        let gather = matrices(reference, &self.dynamic, &self.matrix);
        let law = Force { hourglass };
        state.acceleration.par_chunks_mut(CHUNK).zip(reference.rows.chunks()).enumerate().for_each(
            |(c, (acceleration, row))| {
                let mut sums = [[0.0; 3]; CHUNK];
                sweep(isa, &law, &gather, (row, c * CHUNK), Store::None, &mut sums);
                for (k, (acceleration, sums)) in acceleration.iter_mut().zip(sums).enumerate() {
                    let damping = damping.get(c * CHUNK + k).copied().unwrap_or_default();
                    *acceleration = scale * DVec3::from(sums) + damping;
                }
            },
        );
    }

    /// Energy of the hourglass control \[J\]. Uses the records of the force.
    fn hourglass_energy(&mut self, volume: &[f64], modulus: f64) -> f64 {
        self.pack_gradient();
        let (isa, reference) = (self.isa, &self.reference);
        // 1/4 sum V_a V_b k E (s u^3 / H) H^2 |...|^2.
        let scale = 0.25 * modulus * reference.kernel.gradient_scale() * reference.kernel.support();
        let gather = matrices(reference, &self.dynamic, &self.matrix);
        let chunks: Vec<f64> = reference
            .rows
            .chunks()
            .par_iter()
            .zip(volume.par_chunks(CHUNK))
            .enumerate()
            .map(|(c, (row, volume))| {
                let mut sums = [[0.0; 1]; CHUNK];
                sweep(isa, &HourglassEnergy, &gather, (row, c * CHUNK), Store::None, &mut sums);
                volume.iter().zip(sums).map(|(v, [s])| scale * v * s).sum::<f64>()
            })
            .collect();
        chunks.iter().sum()
    }
}

impl<R: Real, E: Elastic> Formulation for TotalLagrangian<R, E> {
    fn drift(&mut self, state: &mut SolidState, dt: f64) {
        let n = state.len();
        let in_supports = 1.0 / self.reference.kernel.support();
        let moved = |record: &mut [R; FIELDS], u: &mut DVec3, v: &DVec3| {
            *u += dt * *v;
            for (field, u) in record[4..7].iter_mut().zip((*u * in_supports).to_array()) {
                // Wraps around far from the reference position: only differences are read.
                *field = R::coordinate((u * (1.0 / DISPLACEMENT_UNIT)) as i64 as i32, u);
            }
        };
        let columns =
            (&mut self.kinematic.as_mut_slice()[..n], &mut state.displacement[..], &state.velocity[..]);
        columns.into_par_iter().with_min_len(1024).for_each(|(record, u, v)| moved(record, u, v));
        self.reference.copy_to_images(&mut self.kinematic, 4);
        if !self.damping.is_empty() {
            let records = &mut self.velocity.as_mut_slice()[..n];
            (records, &state.velocity[..]).into_par_iter().with_min_len(1024).for_each(|(record, v)| {
                record[..3].copy_from_slice(&v.to_array().map(R::pack));
            });
            self.reference.copy_to_images(&mut self.velocity, 0);
        }
    }

    fn accelerate(&mut self, state: &mut SolidState, numbers: &Numbers, dt: f64) -> Result<f64, SolidError> {
        let modulus = self.material.bulk_modulus() + 4.0 / 3.0 * self.material.shear_modulus();
        let hourglass = self.hourglass_modulus(numbers);
        self.strain(dt, numbers.damping * (modulus / numbers.density).sqrt());
        self.hourglass(hourglass);
        let power = self.stress(state, numbers.viscosity, hourglass)?;
        self.divergence(state, numbers.density, hourglass);
        Ok(dt * power)
    }

    fn modulus(&self) -> f64 {
        let modulus = |i: usize| self.material.modulus(&self.deformation(i), &self.fibres(i));
        (0..self.gradient.len()).into_par_iter().with_min_len(1024).map(modulus).reduce(|| 0.0, f64::max)
    }

    fn deformation(&self, i: usize) -> DMat3 {
        DMat3::IDENTITY + self.gradient[i]
    }

    fn cauchy_stress(&self, i: usize) -> DMat3 {
        let f = self.deformation(i);
        (1.0 / f.determinant()) * (self.material.stress(&f, &self.fibres(i)) * f.transpose())
    }

    fn energies(&mut self, state: &SolidState, numbers: &Numbers) -> [f64; 2] {
        let strain = total(state.len(), |i| {
            state.volume[i] * self.material.energy(&self.deformation(i), &self.fibres(i))
        });
        let modulus = self.hourglass_modulus(numbers);
        [strain, if modulus > 0.0 { self.hourglass_energy(&state.volume, modulus) } else { 0.0 }]
    }

    fn n_pairs(&self) -> usize {
        self.reference.rows.n_pairs()
    }

    fn bytes(&self) -> usize {
        let matrices = self.gradient.capacity() + self.rate.capacity() + self.hourglass.capacity();
        self.reference.bytes()
            + size_of::<Fibres>() * self.fibres.capacity()
            + size_of::<DMat3>() * matrices
            + size_of::<DVec3>() * self.damping.capacity()
            + self.kinematic.bytes()
            + self.velocity.bytes()
            + self.dynamic.bytes()
            + self.matrix.bytes()
    }

    fn visit(&mut self, _: &mut dyn Visitor) {
        // All of it follows from the displacements.
    }
}

/// What loops over matrices gather.
fn matrices<'a, R>(
    reference: &'a Reference<R>,
    dynamic: &'a Records<R>,
    matrix: &'a Records<R>,
) -> Gather<'a, R> {
    Gather {
        frame: &reference.frame,
        own: dynamic,
        other: dynamic,
        own_second: Some(matrix),
        other_second: Some(matrix),
    }
}

/// Sum of the products of all entries.
fn contraction(a: &DMat3, b: &DMat3) -> f64 {
    a.x_axis.dot(b.x_axis) + a.y_axis.dot(b.y_axis) + a.z_axis.dot(b.z_axis)
}

/// Chunks of a column, empty ones where the column is not there.
fn chunks_or_none<T: Send>(
    column: &mut [T],
    n_chunks: usize,
) -> impl IndexedParallelIterator<Item = &mut [T]> {
    let mut chunks: Vec<&mut [T]> = column.chunks_mut(CHUNK).collect();
    chunks.resize_with(n_chunks, Default::default);
    chunks.into_par_iter()
}

//! Total-Lagrangian body: strain, stress and force by the frozen neighbours of the reference configuration.

use crate::error::SolidError;
use crate::formulation::{Formulation, total};
use crate::law::DISPLACEMENT_UNIT;
use crate::law::force::Force;
use crate::law::hourglass::HourglassEnergy;
use crate::law::strain::{DAMPED_SUMS, DampedGradient, DisplacementGradient, SUMS};
use crate::mat3::pack;
use crate::material::{Elastic, Fibres, young};
use crate::numbers::Numbers;
use crate::points::{Constants, Points};
use crate::reference::Reference;
use crate::state::SolidState;
use glam::{DMat3, DVec3};
use rayon::iter::Either;
use rayon::prelude::*;
use vaso_kernels::{CHUNK, Gather, Isa, Real, Records, Store, reduce_in_order, run_on, sum_in_order, sweep};
use vaso_particles::Visitor;

/// Working memory of a total-Lagrangian body.
pub(crate) struct TotalLagrangian<R, E> {
    material: E,
    reference: Reference<R>,
    /// Directions of the fibres, empty where the material has none.
    fibres: Vec<Fibres>,
    /// Displacement gradient G = F - I.
    gradient: Vec<DMat3>,
    /// Acceleration by damping between pairs \[m/s^2\], empty without.
    damping: Vec<DVec3>,
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
        let sized = |on: bool| {
            let mut records = Records::default();
            records.resize(if on { all } else { 0 });
            records
        };
        let damped = numbers.damping > 0.0;
        Self {
            material,
            fibres,
            gradient: vec![DMat3::ZERO; n],
            damping: vec![DVec3::ZERO; if damped { n } else { 0 }],
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
        numbers.hourglass * young(bulk, shear)
    }

    fn fibres(&self, i: usize) -> Fibres {
        self.fibres.get(i).copied().unwrap_or_default()
    }

    /// Displacement gradients, damping of the speed `damping` \[m/s\] times that of the pairs, and what the force reads; returns
    /// the power taken by damping and viscosity \[W\]. One pass: the stress of a particle needs no gradient but its own.
    fn strain_and_stress(
        &mut self,
        state: &SolidState,
        (dt, damping): (f64, f64),
        (viscosity, hourglass): (f64, f64),
    ) -> Result<f64, SolidError> {
        let (isa, reference) = (self.isa, &self.reference);
        let scale = reference.kernel.gradient_scale();
        let constants = Constants {
            gradient_scale: scale * reference.kernel.support(),
            // -beta/2 rho c h 9/r^2 (x.v) grad W (W/W_0), by the density; h is half a support.
            damping_scale: -2.25 * scale * damping,
            rate: if dt > 0.0 { 1.0 / dt } else { 0.0 },
            viscosity,
            hourglass,
        };
        let (n, material) = (state.len(), self.material);
        let gather = Gather {
            frame: &reference.frame,
            own: &self.kinematic,
            other: &self.kinematic,
            own_second: Some(&self.velocity),
            other_second: Some(&self.velocity),
        };
        let damped = !self.damping.is_empty();
        let rows = reference.rows.chunks();
        let (fibres, kinematic) = (&self.fibres, self.kinematic.as_slice());
        let power = self
            .gradient
            .par_chunks_mut(CHUNK)
            .zip(self.dynamic.as_mut_slice()[..n].par_chunks_mut(CHUNK))
            .zip(self.matrix.as_mut_slice()[..n].par_chunks_mut(CHUNK))
            .zip(chunks_or_none(&mut self.damping, rows.len()))
            .zip(rows)
            .enumerate()
            .map(|(c, ((((gradient, dynamic), matrix), damping), row))| {
                let range = c * CHUNK..c * CHUNK + gradient.len();
                let points = Points {
                    material,
                    constants: &constants,
                    fibres: fibres.get(range.clone()).unwrap_or_default(),
                    correction: &reference.correction[range.clone()],
                    kinematic: &kinematic[range.clone()],
                    mass: &state.mass[range.clone()],
                    volume: &state.volume[range.clone()],
                    velocity: &state.velocity[range.clone()],
                    gradient,
                    dynamic,
                    matrix,
                    damping,
                };
                let power = if damped {
                    let mut sums = [[0.0; DAMPED_SUMS]; CHUNK];
                    sweep(isa, &DampedGradient, &gather, (row, range.start), Store::None, &mut sums);
                    points.pass(isa, &sums)
                } else {
                    let mut sums = [[0.0; SUMS]; CHUNK];
                    sweep(isa, &DisplacementGradient, &gather, (row, range.start), Store::None, &mut sums);
                    points.pass(isa, &sums)
                };
                power.map_err(|k| range.start + k)
            });
        let power = reduce_in_order(power, |a, b| Ok(a? + b?)).unwrap_or(Ok(0.0));
        self.reference.copy_to_images(&mut self.dynamic, 4);
        self.reference.copy_to_images(&mut self.matrix, 0);
        power.map_err(|i| SolidError::Inverted {
            particle: state.id[i],
            position: state.position(i),
            determinant: self.deformation(i).determinant(),
        })
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
                run_on(
                    isa,
                    #[inline(always)]
                    || {
                        for (k, (acceleration, sums)) in acceleration.iter_mut().zip(sums).enumerate() {
                            let damping = damping.get(c * CHUNK + k).copied().unwrap_or_default();
                            *acceleration = scale * DVec3::from(sums) + damping;
                        }
                    },
                );
            },
        );
    }

    /// Energy of the hourglass control \[J\]. Uses the records of the force.
    fn hourglass_energy(&mut self, volume: &[f64], modulus: f64) -> f64 {
        self.pack_gradient();
        let (isa, reference) = (self.isa, &self.reference);
        // 1/4 sum V_a V_b k E (s u^3 / H) H^2 |u_ab - G_a X_ab|^2.
        let scale = 0.25 * modulus * reference.kernel.gradient_scale() * reference.kernel.support();
        let gather = matrices(reference, &self.dynamic, &self.matrix);
        let energy = reference.rows.chunks().par_iter().zip(volume.par_chunks(CHUNK)).enumerate().map(
            |(c, (row, volume))| {
                let mut sums = [[0.0; 1]; CHUNK];
                sweep(isa, &HourglassEnergy, &gather, (row, c * CHUNK), Store::None, &mut sums);
                volume.iter().zip(sums).map(|(v, [s])| scale * v * s).sum::<f64>()
            },
        );
        sum_in_order(energy)
    }
}

impl<R: Real, E: Elastic> Formulation for TotalLagrangian<R, E> {
    fn drift(&mut self, state: &mut SolidState, dt: f64) {
        let n = state.len();
        let in_supports = 1.0 / self.reference.kernel.support();
        let isa = self.isa;
        let columns = (
            self.kinematic.as_mut_slice()[..n].par_chunks_mut(CHUNK),
            state.displacement.par_chunks_mut(CHUNK),
            state.velocity.par_chunks(CHUNK),
        );
        columns.into_par_iter().for_each(|(records, displacement, velocity)| {
            run_on(
                isa,
                #[inline(always)]
                || {
                    for ((record, u), v) in records.iter_mut().zip(displacement).zip(velocity) {
                        *u += dt * *v;
                        for (field, u) in record[4..7].iter_mut().zip((*u * in_supports).to_array()) {
                            // Wraps around far from the reference position: only differences are read.
                            *field = R::coordinate((u * (1.0 / DISPLACEMENT_UNIT)) as i64 as i32, u);
                        }
                    }
                },
            );
        });
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
        let damping = numbers.damping * (modulus / numbers.density).sqrt();
        let power = self.strain_and_stress(state, (dt, damping), (numbers.viscosity, hourglass))?;
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
        self.reference.bytes()
            + size_of::<Fibres>() * self.fibres.capacity()
            + size_of::<DMat3>() * self.gradient.capacity()
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

/// Chunks of a column, empty ones where the column is not there.
fn chunks_or_none<T: Send>(
    column: &mut [T],
    n_chunks: usize,
) -> impl IndexedParallelIterator<Item = &mut [T]> {
    if column.is_empty() {
        Either::Left((0..n_chunks).into_par_iter().map(|_| Default::default()))
    } else {
        Either::Right(column.par_chunks_mut(CHUNK))
    }
}

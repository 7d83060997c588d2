//! Updated-Lagrangian body of the multiblock paper: neighbours, density and stress follow the present configuration.
//!
//! For comparison. In tension it clumps in spite of the artificial stress, energy is not conserved, and the stress of a
//! closed cycle of strain need not come back to zero.

use crate::error::SolidError;
use crate::formulation::{Formulation, total};
use crate::law::updated::{GRADIENT_SUMS, Momentum, VelocityGradient};
use crate::mat3::{from_rows, full};
use crate::material::HypoElastic;
use crate::numbers::Numbers;
use crate::reference::Arrangement;
use crate::state::SolidState;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use vaso_kernels::{CHUNK, FIELDS, Gather, Isa, Real, Records, Store, Sym3, Wendland, sweep};
use vaso_particles::{Column, Columns, ScalarColumn, VectorColumn, Visitor};

/// Strength of the artificial stress against clumping (Gray, Monaghan, Swift 2001).
const ARTIFICIAL_STRESS: f64 = 0.3;

/// What the body remembers beside the columns of every solid.
#[derive(Clone, Debug)]
pub(crate) struct UpdatedState {
    /// Density by that of the reference configuration, minus one.
    density_change: ScalarColumn,
    /// Deviatoric Cauchy stress xx, yy, zz \[Pa\].
    stress_normal: VectorColumn,
    /// Deviatoric Cauchy stress xy, xz, yz \[Pa\].
    stress_shear: VectorColumn,
    /// Columns of the deformation gradient.
    deformation: [VectorColumn; 3],
}

impl Columns for UpdatedState {
    fn visit(&mut self, visitor: &mut dyn Visitor) {
        let Self { density_change, stress_normal, stress_shear, deformation: [x, y, z] } = self;
        visitor.scalar(density_change);
        visitor.vector(stress_normal);
        visitor.vector(stress_shear);
        visitor.vector(x);
        visitor.vector(y);
        visitor.vector(z);
    }
}

impl UpdatedState {
    fn at_rest(n: usize) -> Self {
        let all = |v: DVec3| vec![v; n];
        Self {
            density_change: Column::with("density_change", "", vec![0.0; n]),
            stress_normal: Column::with("stress_normal", "Pa", all(DVec3::ZERO)),
            stress_shear: Column::with("stress_shear", "Pa", all(DVec3::ZERO)),
            deformation: [
                Column::with("deformation_x", "", all(DVec3::X)),
                Column::with("deformation_y", "", all(DVec3::Y)),
                Column::with("deformation_z", "", all(DVec3::Z)),
            ],
        }
    }

    fn stress(&self, i: usize) -> DMat3 {
        let (n, s) = (self.stress_normal[i], self.stress_shear[i]);
        full(&Sym3([n.x, n.y, n.z, s.x, s.y, s.z]))
    }

    fn set_stress(&mut self, i: usize, s: &DMat3) {
        self.stress_normal[i] = DVec3::new(s.x_axis.x, s.y_axis.y, s.z_axis.z);
        self.stress_shear[i] = DVec3::new(s.y_axis.x, s.z_axis.x, s.z_axis.y);
    }

    fn deformation(&self, i: usize) -> DMat3 {
        let [x, y, z] = &self.deformation;
        DMat3::from_cols(x[i], y[i], z[i])
    }
}

/// Working memory of an updated-Lagrangian body.
pub(crate) struct UpdatedLagrangian<R> {
    material: HypoElastic,
    columns: UpdatedState,
    kernel: Wendland,
    period: Option<DVec3>,
    records: Records<R>,
    second: Records<R>,
    n_pairs: usize,
    isa: Isa,
}

impl<R: Real> UpdatedLagrangian<R> {
    pub(crate) fn new(
        material: HypoElastic,
        n: usize,
        kernel: Wendland,
        period: Option<DVec3>,
        isa: Isa,
    ) -> Self {
        Self {
            material,
            columns: UpdatedState::at_rest(n),
            kernel,
            period,
            records: Records::default(),
            second: Records::default(),
            n_pairs: 0,
            isa,
        }
    }

    /// Fills the first records: position `back` \[s\] earlier, what `weight` says of a particle, velocity.
    fn fill(
        &mut self,
        arrangement: &Arrangement,
        state: &SolidState,
        back: f64,
        weight: impl Fn(usize) -> f64 + Sync,
    ) {
        let n = state.len();
        let frame = &arrangement.frame;
        self.records.resize(n + arrangement.images.len());
        self.records.fill(|k| {
            let (k, shift) = if k < n {
                (k, DVec3::ZERO)
            } else {
                let (k, shift) = arrangement.images[k - n];
                (k as usize, shift)
            };
            let i = arrangement.order[k] as usize;
            let v = state.velocity[i];
            let x = arrangement.position[k] + shift - back * v;
            let (fixed, scaled) = (frame.fixed(x), frame.in_supports(x));
            [
                R::coordinate(fixed[0], scaled[0]),
                R::coordinate(fixed[1], scaled[1]),
                R::coordinate(fixed[2], scaled[2]),
                R::pack(weight(i)),
                R::pack(v.x),
                R::pack(v.y),
                R::pack(v.z),
                R::pack(0.0),
            ]
        });
    }

    /// Velocity gradients in the middle of the step, in the order of the arrangement: there a turning body shears nothing.
    fn velocity_gradients(&mut self, arrangement: &Arrangement, state: &SolidState, dt: f64) -> Vec<DMat3> {
        let columns = self.columns.density_change.to_vec();
        self.fill(arrangement, state, 0.5 * dt, |i| state.volume[i] / (1.0 + columns[i]));
        let records = &self.records;
        let gather = Gather {
            frame: &arrangement.frame,
            own: records,
            other: records,
            own_second: None,
            other_second: None,
        };
        let (isa, scale, support) = (self.isa, self.kernel.gradient_scale(), self.kernel.support());
        let mut gradients = vec![DMat3::ZERO; state.len()];
        gradients.par_chunks_mut(CHUNK).zip(arrangement.rows.chunks()).enumerate().for_each(
            |(c, (gradients, row))| {
                let mut sums = [[0.0; GRADIENT_SUMS]; CHUNK];
                sweep(isa, &VelocityGradient, &gather, (row, c * CHUNK), Store::None, &mut sums);
                for (gradient, s) in gradients.iter_mut().zip(&sums) {
                    let moment = Sym3([s[9], s[12], s[14], s[10], s[11], s[13]].map(|m| scale * support * m));
                    *gradient = from_rows(s, scale) * full(&correction(&moment));
                }
            },
        );
        gradients
    }

    /// Density, deviatoric stress and deformation gradient after the step.
    fn follow(
        &mut self,
        arrangement: &Arrangement,
        gradients: &[DMat3],
        state: &SolidState,
        dt: f64,
    ) -> Result<(), SolidError> {
        let material = self.material;
        for (l, &i) in gradients.iter().zip(&arrangement.order) {
            let i = i as usize;
            let (ahead, behind) = (DMat3::IDENTITY + 0.5 * dt * *l, DMat3::IDENTITY - 0.5 * dt * *l);
            let growth = ahead.determinant() / behind.determinant();
            let change = (1.0 + self.columns.density_change[i]) / growth - 1.0;
            let determinant = growth * self.columns.deformation(i).determinant();
            if growth <= 0.0 || !determinant.is_finite() {
                let (particle, position) = (state.id[i], state.position(i));
                return Err(SolidError::Inverted { particle, position, determinant });
            }
            self.columns.density_change[i] = change;
            let stress = material.advance(&self.columns.stress(i), l, dt);
            self.columns.set_stress(i, &stress);
            let deformation = behind.inverse() * ahead * self.columns.deformation(i);
            let columns = [deformation.x_axis, deformation.y_axis, deformation.z_axis];
            for (column, value) in self.columns.deformation.iter_mut().zip(columns) {
                column[i] = value;
            }
        }
        Ok(())
    }

    fn momentum(&mut self, arrangement: &Arrangement, state: &mut SolidState, numbers: &Numbers) {
        let material = self.material;
        self.fill(arrangement, state, 0.0, |i| state.mass[i]);
        let n = state.len();
        let columns = &self.columns;
        self.second.resize(n + arrangement.images.len());
        self.second.fill(|k| {
            let k = if k < n { k } else { arrangement.images[k - n].0 as usize };
            let i = arrangement.order[k] as usize;
            let density = numbers.density * (1.0 + columns.density_change[i]);
            let pressure = material.pressure(columns.density_change[i]);
            let (normal, shear) =
                (columns.stress_normal[i] - DVec3::splat(pressure), columns.stress_shear[i]);
            let artificial = -ARTIFICIAL_STRESS * (-pressure).max(0.0);
            let entries: [f64; FIELDS] =
                [normal.x, normal.y, normal.z, shear.x, shear.y, shear.z, artificial, 0.0];
            entries.map(|s| R::pack(s / (density * density)))
        });
        let wave_speed = ((material.bulk + 4.0 / 3.0 * material.shear) / numbers.density).sqrt();
        let law = Momentum {
            at_spacing: self.kernel.value(numbers.spacing) / self.kernel.value(0.0),
            damping: 2.25 * numbers.damping * wave_speed / numbers.density,
        };
        let gather = Gather {
            frame: &arrangement.frame,
            own: &self.records,
            other: &self.records,
            own_second: Some(&self.second),
            other_second: Some(&self.second),
        };
        let (isa, scale) = (self.isa, -self.kernel.gradient_scale());
        let mut accelerations = vec![DVec3::ZERO; n];
        accelerations.par_chunks_mut(CHUNK).zip(arrangement.rows.chunks()).enumerate().for_each(
            |(c, (a, row))| {
                let mut sums = [[0.0; 3]; CHUNK];
                sweep(isa, &law, &gather, (row, c * CHUNK), Store::None, &mut sums);
                for (a, sums) in a.iter_mut().zip(sums) {
                    *a = scale * DVec3::from(sums);
                }
            },
        );
        for (a, &i) in accelerations.iter().zip(&arrangement.order) {
            state.acceleration[i as usize] = *a;
        }
    }
}

/// Inverse moment matrix, so that a linear velocity has its gradient also at edges and corners; the unit matrix for a
/// particle that has lost the others, where the inverse would be all noise.
fn correction(moment: &Sym3) -> Sym3 {
    const LOST: f64 = 0.01; // a corner has an eighth
    if moment.determinant() > LOST { moment.inverse().unwrap_or(Sym3::IDENTITY) } else { Sym3::IDENTITY }
}

impl<R: Real> Formulation for UpdatedLagrangian<R> {
    fn drift(&mut self, state: &mut SolidState, dt: f64) {
        (&mut state.displacement[..], &state.velocity[..])
            .into_par_iter()
            .with_min_len(1024)
            .for_each(|(u, v)| *u += dt * *v);
    }

    fn accelerate(&mut self, state: &mut SolidState, numbers: &Numbers, dt: f64) -> Result<f64, SolidError> {
        let position: Vec<DVec3> = (0..state.len()).map(|i| state.position(i)).collect();
        let arrangement = Arrangement::new(&position, &self.kernel, self.period, self.isa);
        self.n_pairs = arrangement.rows.n_pairs();
        if dt > 0.0 {
            let gradients = self.velocity_gradients(&arrangement, state, dt);
            self.follow(&arrangement, &gradients, state, dt)?;
        }
        self.momentum(&arrangement, state, numbers);
        Ok(0.0)
    }

    fn modulus(&self) -> f64 {
        let top = self.columns.density_change.iter().fold(0.0_f64, |top, c| top.max(*c));
        // Waves cross present lengths: where the body is compressed they have less far to go.
        (self.material.bulk + 4.0 / 3.0 * self.material.shear) * (1.0 + top).powf(2.0 / 3.0)
    }

    fn deformation(&self, i: usize) -> DMat3 {
        self.columns.deformation(i)
    }

    fn cauchy_stress(&self, i: usize) -> DMat3 {
        let pressure = self.material.pressure(self.columns.density_change[i]);
        self.columns.stress(i) - DMat3::from_diagonal(DVec3::splat(pressure))
    }

    fn energies(&mut self, state: &SolidState, _: &Numbers) -> [f64; 2] {
        let (columns, material) = (&self.columns, self.material);
        let energy = |i: usize| material.energy(&columns.stress(i), columns.density_change[i]);
        [total(state.len(), |i| state.volume[i] * energy(i)), 0.0]
    }

    fn n_pairs(&self) -> usize {
        self.n_pairs
    }

    fn bytes(&self) -> usize {
        self.records.bytes() + self.second.bytes()
    }

    fn visit(&mut self, visitor: &mut dyn Visitor) {
        self.columns.visit(visitor);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::norm_squared;

    /// A block that is sheared and then turned by a quarter: stress turns with it, energy stays.
    #[test]
    fn a_turning_body_keeps_stress_and_energy() {
        const SPACING: f64 = 1e-3;
        let site = |k: usize| SPACING * k as f64;
        let position: Vec<DVec3> =
            (0..125).map(|k| DVec3::new(site(k / 25), site(k / 5 % 5), site(k % 5))).collect();
        let numbers = Numbers::new(1000.0, SPACING);
        let mut state = SolidState::at_rest(&position, &[SPACING.powi(3); 125], numbers.density);
        let material = HypoElastic::new(1e6, 0.4).expect("in range");
        let kernel = Wendland::new(numbers.smoothing_length);
        let mut body = UpdatedLagrangian::<f64>::new(material, 125, kernel, None, Isa::detect());
        let dt = 1e-3;
        let mut move_by = |map: DMat3, body: &mut UpdatedLagrangian<f64>| {
            for i in 0..125 {
                let x = state.position(i);
                state.velocity[i] = (map * x - x) / dt;
            }
            body.drift(&mut state, dt);
            body.accelerate(&mut state, &numbers, dt).expect("not inverted");
            body.energies(&state, &numbers)[0]
        };
        let shear = DMat3::from_cols(
            DVec3::new(1.0 + 2e-4, 1e-4, 0.0),
            DVec3::new(-3e-4, 1.0 - 1e-4, 2e-4),
            DVec3::new(0.0, 1e-4, 1.0 - 2e-4),
        );
        let start = (0..50).map(|_| move_by(shear, &mut body)).last().expect("fifty steps");
        let stress: Vec<DMat3> = (0..125).map(|i| body.cauchy_stress(i)).collect();
        let (axis, quarter) = (DVec3::new(1.0, -1.0, 2.0).normalize(), std::f64::consts::FRAC_PI_2);
        let part = DMat3::from_axis_angle(axis, quarter / 300.0);
        let end = (0..300).map(|_| move_by(part, &mut body)).last().expect("steps");
        assert!((end / start - 1.0).abs() < 1e-9, "{start:e} {end:e}");
        let turn = DMat3::from_axis_angle(axis, quarter);
        for (i, stress) in stress.iter().enumerate() {
            let difference = body.cauchy_stress(i) - turn * *stress * turn.transpose();
            assert!(norm_squared(&difference) < 1e-18 * norm_squared(stress), "particle {i}");
        }
    }
}

//! Strain of a section and the resultants that belong to it.
//!
//! Strains are those of the convected base (Simo and Fox 1989): `eps_ab = (g_a.g_b - G_a.G_b)/2`, `kap_ab` the symmetric part
//! of `g_a.n_,b - G_a.N_b`, `gam_a = g_a.n - G_a.N`. Resultants are the derivatives of an energy by area, so that forces are
//! those of an energy.

use crate::material::{Material, Model, SHEAR_CORRECTION, neo_hookean_energy};
use crate::reference::Base;
use glam::{DMat3, DVec3};

/// Change of a section since the reference configuration.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Motion {
    /// Gradient of the displacement along the tangents.
    pub u: [DVec3; 2],
    /// Gradient of the change of the director \[1/m\].
    pub n: [DVec3; 2],
}

/// Strains `eps` 11 22 12, `kap` 11 22 12 \[1/m\] and `gam` 1 2, without the doubling of engineering shear.
pub(crate) type Strain = [f64; 8];

/// Present convected base.
#[derive(Clone, Copy)]
pub(crate) struct Present {
    pub g: [DVec3; 2],
    pub n: [DVec3; 2],
    pub director: DVec3,
}

impl Present {
    pub(crate) fn new(base: &Base, motion: &Motion, director: DVec3) -> Self {
        let g = [base.g[0] + motion.u[0], base.g[1] + motion.u[1]];
        let n = [base.n[0] + motion.n[0], base.n[1] + motion.n[1]];
        Self { g, n, director }
    }
}

/// Strain from the changes: small strains keep their digits.
#[inline(always)]
pub(crate) fn strain(base: &Base, motion: &Motion, director: DVec3) -> Strain {
    let Present { g, .. } = Present::new(base, motion, director);
    let (u, n) = (&motion.u, &motion.n);
    let eps = |a: usize, b: usize| 0.5 * (base.g[a].dot(u[b]) + u[a].dot(base.g[b]) + u[a].dot(u[b]));
    let kap = |a: usize, b: usize| u[a].dot(base.n[b]) + g[a].dot(n[b]);
    let gam = |a: usize| u[a].dot(director) + base.g[a].dot(director - base.director);
    let twist = 0.5 * (kap(0, 1) + kap(1, 0));
    [eps(0, 0), eps(1, 1), eps(0, 1), kap(0, 0), kap(1, 1), twist, gam(0), gam(1)]
}

/// Normal forces, moments and transverse forces of an isotropic linear section, in the order of the strain.
#[inline(always)]
pub(crate) fn linear(material: &Material, thickness: f64, e: &Strain) -> [f64; 8] {
    let (plate, shear, nu) = (material.plate(), material.shear(), material.poisson());
    let (c, g) = (plate * thickness, 2.0 * shear * thickness);
    let lever = thickness * thickness / 12.0;
    let (d, h) = (c * lever, g * lever);
    let s = SHEAR_CORRECTION * shear * thickness;
    [
        c * (e[0] + nu * e[1]),
        c * (e[1] + nu * e[0]),
        g * e[2],
        d * (e[3] + nu * e[4]),
        d * (e[4] + nu * e[3]),
        h * e[5],
        s * e[6],
        s * e[7],
    ]
}

/// Product of resultants and strains; shear and twist stand for two entries.
#[inline(always)]
pub(crate) fn parts(r: &[f64; 8], e: &Strain) -> [f64; 3] {
    [
        r[0] * e[0] + r[1] * e[1] + 2.0 * r[2] * e[2],
        r[3] * e[3] + r[4] * e[4] + 2.0 * r[5] * e[5],
        r[6] * e[6] + r[7] * e[7],
    ]
}

/// A point through the thickness.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layer {
    /// Height over the mid-surface \[m\].
    zeta: f64,
    /// Weight by area times the volume of the shifted base \[m\].
    weight: f64,
    /// Inverse of the shifted base, along tangents and director: `F = [g + zeta n_,] inverse`.
    inverse: DMat3,
}

/// Places in half thicknesses and weights of the rules of Gauss.
fn rule(points: usize) -> &'static [[f64; 2]] {
    match points {
        1 => &[[0.0, 2.0]],
        3 => &[[-0.774_596_669_241_483_4, 5.0 / 9.0], [0.0, 8.0 / 9.0], [0.774_596_669_241_483_4, 5.0 / 9.0]],
        _ => &[
            [-0.906_179_845_938_664, 0.236_926_885_056_189_1],
            [-0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
            [0.0, 0.568_888_888_888_888_9],
            [0.538_469_310_105_683_1, 0.478_628_670_499_366_5],
            [0.906_179_845_938_664, 0.236_926_885_056_189_1],
        ],
    }
}

impl Layer {
    /// Layers of a particle of `thickness` \[m\].
    pub(crate) fn of(base: &Base, thickness: f64, points: usize) -> impl Iterator<Item = Self> + '_ {
        rule(points).iter().map(move |[xi, weight]| {
            let zeta = 0.5 * thickness * xi;
            let mut layer = Self::at(base, zeta);
            layer.weight *= 0.5 * thickness * weight;
            layer
        })
    }

    /// Layer at the height `zeta` \[m\], with the weight of the volume alone.
    pub(crate) fn at(base: &Base, zeta: f64) -> Self {
        let shifted = |k: usize| base.g[k] + zeta * base.n[k];
        let frame = DMat3::from_cols(base.tangent[0], base.tangent[1], base.director);
        let g = frame.transpose() * DMat3::from_cols(shifted(0), shifted(1), base.director);
        Self { zeta, weight: g.determinant(), inverse: g.inverse() }
    }

    /// Height, weight and the inverse of the shifted base row by row, without its last column, which is that of the director.
    pub(crate) fn numbers(&self) -> [f64; 8] {
        let (x, y) = (self.inverse.x_axis, self.inverse.y_axis);
        [self.zeta, self.weight, x.x, y.x, x.y, y.y, x.z, y.z]
    }

    /// Volume of the layer by area and height, where it was made by [`Self::at`].
    pub(crate) fn volume(&self) -> f64 {
        self.weight
    }

    /// Deformation gradient along tangents and director.
    #[inline(always)]
    pub(crate) fn deformation(&self, p: &Present) -> DMat3 {
        let shifted = DMat3::from_cols(p.g[0] + self.zeta * p.n[0], p.g[1] + self.zeta * p.n[1], p.director);
        shifted * self.inverse
    }
}

/// Components 11 22 12 13 23 of the Cauchy-Green tensor.
#[inline(always)]
pub(crate) fn cauchy_green(f: &DMat3) -> [f64; 5] {
    let (x, y, z) = (f.x_axis, f.y_axis, f.z_axis);
    [x.dot(x), y.dot(y), x.dot(y), x.dot(z), y.dot(z)]
}

/// `F S` for a stress 11 22 12 13 23.
#[inline(always)]
pub(crate) fn first_piola(f: &DMat3, s: &[f64; 5]) -> DMat3 {
    let (x, y, z) = (f.x_axis, f.y_axis, f.z_axis);
    DMat3::from_cols(s[0] * x + s[2] * y + s[3] * z, s[2] * x + s[1] * y + s[4] * z, s[3] * x + s[4] * y)
}

/// Energies by area \[J/m^2\] of membrane, bending and shear; with layers bending is what the mid-surface does not explain.
pub(crate) fn energy(
    material: &Material,
    thickness: f64,
    base: &Base,
    motion: &Motion,
    director: DVec3,
    layers: &[Layer],
) -> [f64; 3] {
    match material.model() {
        Model::Resultant => {
            let e = strain(base, motion, director);
            parts(&linear(material, thickness, &e), &e).map(|part| 0.5 * part)
        }
        Model::NeoHookean { .. } => {
            let p = Present::new(base, motion, director);
            let at = |layer: &Layer| {
                neo_hookean_energy(material.shear(), material.lame(), &cauchy_green(&layer.deformation(&p)))
            };
            let mut total = [0.0; 2];
            for layer in layers {
                let [plane, shear] = at(layer);
                total[0] += layer.weight * plane;
                total[1] += layer.weight * shear;
            }
            let volume: f64 = layers.iter().map(|layer| layer.weight).sum();
            let membrane = volume * at(&Layer::at(base, 0.0))[0];
            [membrane, total[0] - membrane, total[1]]
        }
    }
}

//! Sections of many particles at once: what `section.rs` and `damping.rs` say of one, a particle a lane.

mod columns;
mod section;

pub(crate) use columns::{OUT, OWN, before, blank, fix, fixed_columns, found, show, strains};
pub(crate) use section::Section;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::{Material, Model};
    use crate::reference::Base;
    use crate::section::{Layer, Motion, energy};
    use glam::{DMat3, DVec3};
    use vaso_kernels::{BLOCK, BlockColumn, Isa, sweep_points};

    const THICKNESS: f64 = 0.4;

    fn base() -> Base {
        let (g, director) = ([DVec3::new(1.0, 0.1, 0.05), DVec3::new(-0.05, 0.9, 0.2)], DVec3::Z);
        let dual = DMat3::from_cols(g[0], g[1], director).inverse().transpose();
        Base {
            tangent: [DVec3::X, DVec3::Y],
            director,
            g,
            n: [DVec3::new(0.3, 0.1, 0.0), DVec3::new(0.05, -0.2, 0.1)],
            dual: [dual.x_axis, dual.y_axis, dual.z_axis],
        }
    }

    /// Motion and director of one state, the same for all.
    fn state() -> [DVec3; 5] {
        [
            DVec3::new(0.1, 0.02, -0.03),
            DVec3::new(-0.04, 0.07, 0.05),
            DVec3::new(0.02, -0.05, 0.01),
            DVec3::new(0.03, 0.04, -0.02),
            DVec3::new(0.1, -0.05, 0.99),
        ]
    }

    fn layers(material: &Material) -> Vec<Layer> {
        let Model::NeoHookean { points } = material.model() else { return Vec::new() };
        Layer::of(&base(), THICKNESS, points).collect()
    }

    fn sections(
        isa: Isa,
        (material, section): (&Material, &Section),
        own: &[BlockColumn; OWN],
    ) -> [BlockColumn; OUT] {
        let layers = layers(material);
        let mut fixed = vec![[0.0; BLOCK]; fixed_columns(layers.len())];
        (0..BLOCK).for_each(|k| fix(&mut fixed, k, &base(), THICKNESS, [3.0, 2.0, 1.0], &layers));
        let mut out = blank();
        sweep_points(isa, section, BLOCK, &fixed, own, &mut out);
        out
    }

    #[test]
    fn resultants_are_derivatives_of_the_energy() {
        for model in [Model::Resultant, Model::NeoHookean { points: 3 }, Model::NeoHookean { points: 5 }] {
            let material = Material::new(7.0, 0.4, model).expect("in range");
            let layers = layers(&material);
            let of = |[u1, u2, n1, n2, director]: [DVec3; 5]| {
                let motion = Motion { u: [u1, u2], n: [n1, n2] };
                energy(&material, THICKNESS, &base(), &motion, director, &layers).iter().sum::<f64>()
            };
            let [u1, u2, n1, n2, director] = state();
            let mut own = blank();
            show(&mut own, 9, &Motion { u: [u1, u2], n: [n1, n2] }, director, [0.0; 9]);
            for isa in Isa::available() {
                let found = found(&sections(isa, (&material, &Section::new(material, 0.0, 0.0)), &own), 9);
                let found = [found.0[0], found.0[1], found.1[0], found.1[1], found.2];
                for (k, found) in found.into_iter().enumerate() {
                    for axis in DVec3::AXES {
                        let at = |e: f64| {
                            let mut moved = state();
                            moved[k] += e * axis;
                            of(moved)
                        };
                        let numeric = (at(1e-5) - at(-1e-5)) / 2e-5;
                        let difference = (numeric - found.dot(axis)).abs();
                        assert!(difference < 1e-8, "{model:?} {} {k}: {numeric} {found}", isa.name());
                    }
                }
            }
        }
    }

    #[test]
    fn damping_takes_what_the_rates_say_and_the_hourglass_goes_along_the_dual_base() {
        let material = Material::new(7.0, 0.4, Model::NeoHookean { points: 3 }).expect("in range");
        let [u1, u2, n1, n2, director] = state();
        let motion = Motion { u: [u1, u2], n: [n1, n2] };
        let e = crate::section::strain(&base(), &motion, director);
        let twist = std::array::from_fn(|k| 0.1 * k as f64 - 0.3);
        let matrix = DMat3::from_cols_array(&twist).transpose();
        for isa in Isa::available() {
            let mut own = blank();
            show(&mut own, 0, &motion, director, [0.0; 9]);
            let still = found(&sections(isa, (&material, &Section::new(material, 0.0, 0.0)), &own), 0);
            show(&mut own, 0, &motion, director, twist);
            let out = sections(isa, (&material, &Section::new(material, 0.5, 0.1)), &own);
            let (t, m, q, power) = found(&out, 0);
            let rate = e.map(|e| 10.0 * e);
            let viscous: [f64; 8] = std::array::from_fn(|k| 0.5 * [3.0, 2.0, 1.0][k / 3] * rate[k]);
            let expected: f64 = crate::section::parts(&viscous, &rate).iter().sum();
            assert!((power - expected).abs() < 1e-12 * expected.abs(), "{power} {expected}");
            assert!((0..8).all(|k| (strains(&out)[k][0] - e[k]).abs() < 1e-14));
            // Moments only feel the viscous part, T and Q the rest too.
            let (g, n) = ([base().g[0] + u1, base().g[1] + u2], [base().n[0] + n1, base().n[1] + n2]);
            let m1 = still.1[0] + viscous[3] * g[0] + viscous[5] * g[1];
            assert!((m[0] - m1).length() < 1e-12);
            let t1 = still.0[0]
                + viscous[0] * g[0]
                + viscous[2] * g[1]
                + viscous[3] * n[0]
                + viscous[5] * n[1]
                + viscous[6] * director
                + matrix * base().dual[0];
            assert!((t[0] - t1).length() < 1e-12, "{} {t1}", t[0]);
            let q1 = still.2 + viscous[6] * g[0] + viscous[7] * g[1] + matrix * base().dual[2];
            assert!((q - q1).length() < 1e-12);
        }
    }
}

//! Viscosity as a function of the shear rate.

/// Shear rates outside which the laws are held constant \[1/s\]: below, some grow without bound; above, no blood
/// flows.
const SHEAR_RATES: [f64; 2] = [0.1, 1e5];

/// Law for the dynamic viscosity eta of blood at a shear rate g = sqrt(2 D:D), D the symmetric velocity gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rheology {
    /// eta = eta_inf + (eta_0 - eta_inf) (1 + (lambda g)^a)^((n - 1)/a) (Carreau 1972; Yasuda, Armstrong and Cohen
    /// 1981); a = 2 is the law of Carreau.
    CarreauYasuda {
        /// eta_0, at rest \[Pa s\].
        zero_shear: f64,
        /// eta_inf, at a large shear rate \[Pa s\].
        infinite_shear: f64,
        /// lambda \[s\].
        relaxation_time: f64,
        /// n.
        index: f64,
        /// a.
        transition: f64,
    },
    /// sqrt(eta) = sqrt(tau_y / g) + sqrt(eta_c) (Casson 1959).
    Casson {
        /// tau_y \[Pa\].
        yield_stress: f64,
        /// eta_c, at a large shear rate \[Pa s\].
        infinite_shear: f64,
    },
    /// eta = k g^(n - 1) (Ostwald 1925).
    PowerLaw {
        /// k, the viscosity at a shear rate of 1/s \[Pa s\].
        consistency: f64,
        /// n.
        index: f64,
    },
}

impl Rheology {
    /// Viscosity \[Pa s\] at `shear_rate` \[1/s\], held between those at 0.1/s and 1e5/s.
    pub fn viscosity(&self, shear_rate: f64) -> f64 {
        let g = shear_rate.clamp(SHEAR_RATES[0], SHEAR_RATES[1]);
        match *self {
            Self::CarreauYasuda { zero_shear, infinite_shear, relaxation_time, index, transition } => {
                let bend = 1.0 + (relaxation_time * g).powf(transition);
                infinite_shear + (zero_shear - infinite_shear) * bend.powf((index - 1.0) / transition)
            }
            Self::Casson { yield_stress, infinite_shear } => {
                ((yield_stress / g).sqrt() + infinite_shear.sqrt()).powi(2)
            }
            Self::PowerLaw { consistency, index } => consistency * g.powf(index - 1.0),
        }
    }

    /// Largest and smallest viscosity of the law \[Pa s\].
    pub fn extremes(&self) -> [f64; 2] {
        let [a, b] = SHEAR_RATES.map(|g| self.viscosity(g));
        [a.max(b), a.min(b)]
    }
}

/// Shear rate sqrt(2 D:D) \[1/s\] of a symmetric velocity gradient D by its entries xx, yy, zz, xy, xz, yz.
pub(crate) fn shear_rate(d: &[f64; 6]) -> f64 {
    let diagonal = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    let mixed = d[3] * d[3] + d[4] * d[4] + d[5] * d[5];
    (2.0 * diagonal + 4.0 * mixed).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blood by Cho and Kensey (1991).
    const CARREAU_YASUDA: Rheology = Rheology::CarreauYasuda {
        zero_shear: 0.056,
        infinite_shear: 0.0035,
        relaxation_time: 1.902,
        index: 0.22,
        transition: 1.25,
    };

    #[test]
    fn blood_thins_from_rest_to_large_shear() {
        assert!((CARREAU_YASUDA.viscosity(0.0) / 0.056 - 1.0).abs() < 0.12);
        assert!((CARREAU_YASUDA.viscosity(1e5) / 0.0035 - 1.0).abs() < 1e-2);
        // (1 + 1)^((0.22 - 1) / 1.25) at lambda g = 1.
        let bend = 0.0035 + 0.0525 * 2_f64.powf(-0.78 / 1.25);
        assert!((CARREAU_YASUDA.viscosity(1.0 / 1.902) / bend - 1.0).abs() < 1e-12);
        let casson = Rheology::Casson { yield_stress: 0.005, infinite_shear: 0.0035 };
        assert!((casson.viscosity(0.005 / 0.0035) / (4.0 * 0.0035) - 1.0).abs() < 1e-12);
        let power = Rheology::PowerLaw { consistency: 0.017, index: 0.708 };
        assert!((power.viscosity(100.0) / (0.017 * 100_f64.powf(-0.292)) - 1.0).abs() < 1e-12);
        let [thick, thin] = casson.extremes();
        assert!(thick > 0.05 && thick < 0.1 && (thin / 0.0035 - 1.0).abs() < 1e-2);
    }

    #[test]
    fn simple_shear_has_its_rate() {
        assert!((shear_rate(&[0.0, 0.0, 0.0, 0.5 * 40.0, 0.0, 0.0]) - 40.0).abs() < 1e-12);
    }
}

//! The face towards the lumen, which bears the level of the blood's pressure.

use crate::error::SolidError;
use crate::face::Face;
use crate::formulation::Formulation;
use crate::material::cofactor;
use crate::solid::Solid;
use glam::DVec3;
use rayon::prelude::*;
use vaso_kernels::{CellGrid, Real};

/// Face with a pressure of its own on each particle.
pub(crate) struct Lumen {
    /// Places of the particles in the state.
    at: Vec<u32>,
    /// Areas in the reference configuration, out of the solid \[m^2\].
    area: Vec<DVec3>,
    /// Pressure on each \[Pa\].
    pressure: Vec<f64>,
    /// What it accelerates each particle of the face by \[m/s^2\].
    push: Vec<DVec3>,
    /// Number in the face of the particle nearest to each one in the state.
    nearest: Vec<u32>,
}

impl Lumen {
    /// Present area of number `k` of the face, out of the solid: `n da = J F^-T N dA` (Nanson).
    fn present(&self, body: &dyn Formulation, k: usize) -> DVec3 {
        cofactor(&body.deformation(self.at[k] as usize)) * self.area[k]
    }

    /// Number of particles.
    pub(crate) fn len(&self) -> usize {
        self.at.len()
    }

    /// Pressures on the face \[Pa\].
    pub(crate) fn pressure_mut(&mut self) -> &mut Vec<f64> {
        &mut self.pressure
    }

    /// Takes the pressures on the face \[Pa\].
    pub(crate) fn set_pressure(&mut self, pressure: &[f64]) {
        self.pressure.copy_from_slice(pressure);
    }

    /// Adds what the pressure accelerates particles of these masses \[kg\] by.
    pub(crate) fn push(&mut self, body: &dyn Formulation, mass: &[f64], acceleration: &mut [DVec3]) {
        let mut push = std::mem::take(&mut self.push);
        let by = |k: usize| (-self.pressure[k] / mass[self.at[k] as usize]) * self.present(body, k);
        (0..self.at.len()).into_par_iter().with_min_len(256).map(by).collect_into_vec(&mut push);
        // One after the other: a particle may stand for several parts of the face.
        for (&i, push) in self.at.iter().zip(&push) {
            acceleration[i as usize] += *push;
        }
        self.push = push;
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        let vectors =
            size_of::<DVec3>() * (self.area.capacity() + self.push.capacity()) + 8 * self.pressure.capacity();
        vectors + 4 * (self.at.capacity() + self.nearest.capacity())
    }
}

impl<R: Real> Solid<R> {
    /// Lets `face` bear the pressures of [`WallLoad::face_pressure`](vaso_particles::WallLoad), which follow its area. Particles nearer to
    /// the lumen than `reach` \[m\] are taken for those behind the nearest of the face.
    ///
    /// # Errors
    /// [`SolidError::NoSuchParticle`].
    pub fn bear(&mut self, face: &Face, reach: f64) -> Result<(), SolidError> {
        let at = self.places("lumen", &face.particles)?;
        let position = &self.state.reference_position;
        let on_face: Vec<DVec3> = at.iter().map(|&i| position[i as usize]).collect();
        let low = on_face.iter().fold(DVec3::INFINITY, |a, b| a.min(*b)) - reach;
        let high = on_face.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b)) + reach;
        let mut order = Vec::new();
        let mut grid = CellGrid::new((low, high), reach + self.numbers.spacing);
        grid.sort(&on_face, &mut order);
        let nearest = position[..].par_iter().with_min_len(256).map(|x| {
            let near = grid.runs(*x);
            let near = near.as_slice().iter().flat_map(|&(begin, end)| &order[begin..end]);
            let distance = |k: u32| (on_face[k as usize] - *x).length_squared();
            let nearest = near.copied().min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
            nearest.filter(|&k| distance(k) <= reach * reach).unwrap_or(u32::MAX)
        });
        let nearest = nearest.collect();
        self.loads.lumen = Some(Lumen {
            pressure: vec![0.0; at.len()],
            push: Vec::new(),
            area: face.area.clone(),
            nearest,
            at,
        });
        self.ready = false;
        Ok(())
    }

    /// For each particle, in the order of [`Self::wall_view`], the number in the face of [`Self::bear`] of the one it is behind;
    /// `u32::MAX` where it is behind none.
    pub fn behind(&self) -> Vec<u32> {
        match &self.loads.lumen {
            Some(lumen) => lumen.nearest.clone(),
            None => vec![u32::MAX; self.state.len()],
        }
    }

    /// Present area of number `k` of the face of [`Self::bear`], out of the solid \[m^2\], and its velocity \[m/s\].
    ///
    /// # Panics
    /// If there is none.
    pub fn borne(&self, k: usize) -> (DVec3, DVec3) {
        let lumen = self.loads.lumen.as_ref().expect("a face bears");
        (lumen.present(&*self.body, k), self.state.velocity[lumen.at[k] as usize])
    }
}

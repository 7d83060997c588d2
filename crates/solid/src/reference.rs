//! What is fixed by the reference configuration: cell order, neighbour rows, correction matrices.

use crate::error::SolidError;
use crate::law::moment::Moment;
use glam::DVec3;
use nalgebra::{Matrix3, SymmetricEigen};
use rayon::prelude::*;
use vaso_kernels::{
    CHUNK, CellGrid, FIELDS, Frame, Gather, Isa, Real, Records, Rows, SearchSet, Store, Sym3, Wendland, sweep,
};

/// Smallest eigenvalue of a moment matrix that a solid may have: in a corner it is 0.26, in a single layer 0.
const FLATTEST: f64 = 0.05;

/// Cell order of a body, with images where it repeats.
pub(crate) struct Arrangement {
    /// `order[new] = old` among the particles given.
    pub(crate) order: Vec<u32>,
    /// Positions in that order \[m\].
    pub(crate) position: Vec<DVec3>,
    /// Particle (in the new order) and shift \[m\] of each image.
    pub(crate) images: Vec<(u32, DVec3)>,
    /// Frame of the coordinates.
    pub(crate) frame: Frame,
    /// Neighbours; images stand behind the particles.
    pub(crate) rows: Rows,
}

impl Arrangement {
    /// Sorts `position` \[m\] and finds all pairs closer than the support of `kernel`; a body with a `period` \[m\] goes on
    /// beyond both ends of it.
    pub(crate) fn new(position: &[DVec3], kernel: &Wendland, period: Option<DVec3>, isa: Isa) -> Self {
        let support = kernel.support();
        let n = position.len();
        let mut all = position.to_vec();
        let mut source: Vec<(u32, DVec3)> = Vec::new();
        if let Some(period) = period {
            let (length, along) = (period.length(), period.normalize());
            let low = position.iter().map(|x| x.dot(along)).fold(f64::INFINITY, f64::min);
            let high = position.iter().map(|x| x.dot(along)).fold(f64::NEG_INFINITY, f64::max);
            // A support longer than the period holds several images of a particle, its own among them.
            let most = ((support + high - low) / length).ceil() as i32;
            for k in (-most..=most).filter(|&k| k != 0) {
                let shift = f64::from(k) * period;
                for (i, &x) in position.iter().enumerate() {
                    let s = (x + shift).dot(along);
                    if s > low - support && s < high + support {
                        source.push((i as u32, shift));
                        all.push(x + shift);
                    }
                }
            }
        }
        let low = all.iter().copied().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
        let high = all.iter().copied().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
        let frame = Frame::new((low, high), support);
        let mut grid = CellGrid::new((low, high), support);
        let mut sorted = Vec::new();
        grid.sort(&all, &mut sorted);
        let in_cells: Vec<DVec3> = sorted.iter().map(|&k| all[k as usize]).collect();
        let mut other = SearchSet::default();
        other.fill(&frame, &in_cells);

        let order: Vec<u32> = sorted.iter().copied().filter(|&k| (k as usize) < n).collect();
        let position: Vec<DVec3> = order.iter().map(|&k| all[k as usize]).collect();
        let mut rows = Rows::default();
        let mut images = Vec::new();
        if source.is_empty() {
            rows.build(isa, &frame, (&other, &position), &other, &grid, true);
        } else {
            let mut own = SearchSet::default();
            own.fill(&frame, &position);
            // A particle in its own row adds nothing to any sum: its separations are zero.
            rows.build(isa, &frame, (&own, &position), &other, &grid, false);
            let mut place = vec![0; n];
            for (new, &old) in order.iter().enumerate() {
                place[old as usize] = new as u32;
            }
            let mut to = Vec::with_capacity(sorted.len());
            for &k in &sorted {
                let k = k as usize;
                if k < n {
                    to.push(place[k]);
                } else {
                    to.push((n + images.len()) as u32);
                    let (i, shift) = source[k - n];
                    images.push((place[i as usize], shift));
                }
            }
            rows.redirect(&to, n + images.len());
        }
        Self { order, position, images, frame, rows }
    }
}

/// Frozen neighbours of a body and their correction matrices.
pub(crate) struct Reference<R> {
    pub(crate) kernel: Wendland,
    pub(crate) frame: Frame,
    pub(crate) rows: Rows,
    /// Inverse moment matrices: gradients of linear fields are exact (Bonet and Lok 1999).
    pub(crate) correction: Vec<Sym3>,
    /// Particle behind each image.
    pub(crate) images: Vec<u32>,
    /// Records with position and volume, images behind the particles; the rest is zero.
    pub(crate) blank: Records<R>,
}

impl<R: Real> Reference<R> {
    /// Corrections of an arrangement whose particles have the volumes \[m^3\] and, for messages, the numbers `id`.
    pub(crate) fn new(
        arrangement: Arrangement,
        kernel: Wendland,
        volume: &[f64],
        id: &[u64],
        isa: Isa,
    ) -> Result<Self, SolidError> {
        let Arrangement { position, images, frame, rows, .. } = arrangement;
        let n = position.len();
        let mut blank = Records::default();
        blank.resize(n + images.len());
        blank.fill(|k| {
            let (x, i) = if k < n {
                (position[k], k)
            } else {
                let (i, shift) = images[k - n];
                (position[i as usize] + shift, i as usize)
            };
            let (fixed, scaled) = (frame.fixed(x), frame.in_supports(x));
            let mut record = [R::default(); FIELDS];
            for c in 0..3 {
                record[c] = R::coordinate(fixed[c], scaled[c]);
                record[4 + c] = R::coordinate(0, 0.0);
            }
            record[3] = R::pack(volume[i]);
            record
        });
        let gather =
            Gather { frame: &frame, own: &blank, other: &blank, own_second: None, other_second: None };
        let scale = kernel.gradient_scale() * kernel.support();
        let mut moment = vec![Sym3::IDENTITY; n];
        moment.par_chunks_mut(CHUNK).zip(rows.chunks()).enumerate().for_each(|(c, (moment, row))| {
            let mut sums = [[0.0; 6]; CHUNK];
            sweep(isa, &Moment, &gather, (row, c * CHUNK), Store::None, &mut sums);
            for (m, s) in moment.iter_mut().zip(&sums) {
                *m = Sym3(s.map(|s| scale * s));
            }
        });
        let correction = moment
            .par_iter()
            .enumerate()
            .map(|(i, m)| {
                let eigenvalue = smallest_eigenvalue(m);
                m.inverse().filter(|_| eigenvalue > FLATTEST).ok_or(SolidError::Flat {
                    particle: id[i],
                    position: position[i],
                    eigenvalue,
                })
            })
            .collect::<Result<_, _>>()?;
        let images = images.into_iter().map(|(i, _)| i).collect();
        Ok(Self { kernel, frame, rows, correction, images, blank })
    }

    /// Gives images the fields from `from` on of the particles behind them.
    pub(crate) fn copy_to_images(&self, records: &mut Records<R>, from: usize) {
        let n = self.correction.len();
        let records = records.as_mut_slice();
        for (k, &i) in self.images.iter().enumerate() {
            let source = records[i as usize];
            records[n + k][from..].copy_from_slice(&source[from..]);
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        self.rows.bytes()
            + self.blank.bytes()
            + size_of::<Sym3>() * self.correction.capacity()
            + 4 * self.images.capacity()
    }
}

fn smallest_eigenvalue(m: &Sym3) -> f64 {
    let [xx, yy, zz, xy, xz, yz] = m.0;
    SymmetricEigen::new(Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)).eigenvalues.min()
}

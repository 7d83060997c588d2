//! What is fixed by the reference configuration: cell order, neighbours, the weights of gradients, base vectors.

use crate::error::ShellError;
use crate::numbers::Numbers;
use crate::weights::{Neighbour, gradient_weights};
use glam::{DMat3, DVec3};
use vaso_kernels::{CellGrid, FIELDS, Frame, Isa, LinkStore, Real, Records, Rows, SearchSet, Wendland};

/// Smallest eigenvalue of a moment matrix that a shell may have: in a corner it is 0.3, on a line 0.
const FLATTEST: f64 = 0.05;

/// Normalisation of the Wendland kernel in the plane over that in space at equal smoothing length, 7/(4 pi) / (21/(16 pi)).
const PLANE_OVER_SPACE: f64 = 4.0 / 3.0;

/// Convected base of one particle in the reference configuration, in global axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Base {
    /// Orthonormal tangents, with the director a right-handed frame.
    pub tangent: [DVec3; 2],
    /// Director.
    pub director: DVec3,
    /// Gradient of the position along the tangents, as the operator sees it.
    pub g: [DVec3; 2],
    /// Gradient of the director \[1/m\].
    pub n: [DVec3; 2],
    /// Dual base of `g` and the director.
    pub dual: [DVec3; 3],
}

/// Frozen neighbours of a shell.
pub(crate) struct Reference<R> {
    pub frame: Frame,
    pub rows: Rows,
    pub base: Vec<Base>,
    /// Sum of the weights of each particle's gradient \[1/m\].
    pub own: Vec<[f64; 2]>,
    /// Weights of the gradient of a particle, one pair a link.
    pub forward: LinkStore<R, 2>,
    /// Weights by which stresses of a neighbour act on a particle: the dual of its gradient.
    pub backward: LinkStore<R, 2>,
    /// Weights of the hourglass control, without its modulus.
    pub hourglass: LinkStore<R, 1>,
    /// Records with position; the rest is zero.
    pub blank: Records<R>,
}

/// Order in which particles near each other stand near each other, and the grid that found it.
pub(crate) struct Arrangement {
    pub order: Vec<u32>,
    frame: Frame,
    rows: Rows,
}

impl Arrangement {
    /// Sorts `position` \[m\] and finds all pairs closer than `support` \[m\].
    pub(crate) fn new(position: &[DVec3], support: f64, isa: Isa) -> Self {
        let low = position.iter().copied().reduce(DVec3::min).unwrap_or(DVec3::ZERO);
        let high = position.iter().copied().reduce(DVec3::max).unwrap_or(DVec3::ZERO);
        let frame = Frame::new((low, high), support);
        let mut grid = CellGrid::new((low, high), support);
        let mut order = Vec::new();
        grid.sort(position, &mut order);
        let sorted: Vec<DVec3> = order.iter().map(|&k| position[k as usize]).collect();
        let mut set = SearchSet::default();
        set.fill(&frame, &sorted);
        let mut rows = Rows::default();
        rows.build(isa, &frame, (&set, &sorted), &set, &grid, true);
        Self { order, frame, rows }
    }
}

/// Particles in the order of their arrangement.
pub(crate) struct Ordered<'a> {
    pub position: &'a [DVec3],
    pub director: &'a [DVec3],
    pub area: &'a [f64],
    pub thickness: &'a [f64],
    pub id: &'a [u64],
}

impl<R: Real> Reference<R> {
    /// Weights and bases of an arrangement. Neighbours whose directors point to the other side belong to another wall across a
    /// gap, and do not count.
    pub(crate) fn new(
        arrangement: Arrangement,
        particles: &Ordered,
        numbers: &Numbers,
        isa: Isa,
    ) -> Result<Self, ShellError> {
        let Arrangement { frame, rows, .. } = arrangement;
        let n = particles.position.len();
        let kernel = Wendland::new(numbers.smoothing_length);
        let tangent: Vec<[DVec3; 2]> = particles.director.iter().map(|n| tangents(*n)).collect();
        let links = Links::new(&rows, particles, &tangent, &kernel)?;

        let mut own = vec![[0.0; 2]; n];
        let mut base = Vec::with_capacity(n);
        for i in 0..n {
            let (mut g, mut turn) = ([DVec3::ZERO; 2], [DVec3::ZERO; 2]);
            for (j, w) in links.of(i) {
                // As the loops will see them.
                let w = w.map(|w| R::pack(w).widen());
                for k in 0..2 {
                    g[k] += w[k] * (particles.position[j] - particles.position[i]);
                    turn[k] += w[k] * (particles.director[j] - particles.director[i]);
                    own[i][k] += w[k];
                }
            }
            let director = particles.director[i];
            let dual = DMat3::from_cols(g[0], g[1], director).inverse().transpose();
            let dual = [dual.x_axis, dual.y_axis, dual.z_axis];
            base.push(Base { tangent: tangent[i], director, g, n: turn, dual });
        }

        let forward = LinkStore::new(isa, &rows, |i, j| links.weight(i, j));
        let backward = LinkStore::new(isa, &rows, |i, j| {
            links.weight(j, i).map(|w| -particles.area[j] / particles.area[i] * w)
        });
        let (value_scale, support) = (PLANE_OVER_SPACE * kernel.h, kernel.support());
        let hourglass = LinkStore::new(isa, &rows, |i, j| {
            if links.weight(i, j) == [0.0; 2] {
                return [0.0];
            }
            let r = particles.position[i].distance(particles.position[j]);
            let thickness = (particles.thickness[i] * particles.thickness[j]).sqrt();
            // c_ij by the modulus, for lengths in supports: the support comes back in the sums.
            [particles.area[j] * thickness * value_scale * kernel.value(r) * support * support / (r * r)]
        });
        let mut blank = Records::default();
        blank.resize(n);
        blank.fill(|i| {
            let (fixed, scaled) =
                (frame.fixed(particles.position[i]), frame.in_supports(particles.position[i]));
            let mut record = [R::coordinate(0, 0.0); FIELDS];
            for c in 0..3 {
                record[c] = R::coordinate(fixed[c], scaled[c]);
            }
            record
        });
        Ok(Self { frame, rows, base, own, forward, backward, hourglass, blank })
    }

    pub(crate) fn bytes(&self) -> usize {
        self.rows.bytes()
            + self.blank.bytes()
            + self.forward.bytes()
            + self.backward.bytes()
            + self.hourglass.bytes()
            + size_of::<Base>() * self.base.capacity()
            + size_of::<[f64; 2]>() * self.own.capacity()
    }
}

/// Weights of all links, by particle; neighbours of each in rising order.
struct Links {
    start: Vec<usize>,
    neighbour: Vec<usize>,
    weight: Vec<[f64; 2]>,
}

impl Links {
    fn new(
        rows: &Rows,
        particles: &Ordered,
        tangent: &[[DVec3; 2]],
        kernel: &Wendland,
    ) -> Result<Self, ShellError> {
        let (mut start, mut neighbour, mut weight) = (vec![0], Vec::new(), Vec::new());
        // With it the moment matrix is the unit matrix in the bulk.
        let scale = PLANE_OVER_SPACE * kernel.h * kernel.gradient_scale() * kernel.support();
        for i in 0..particles.position.len() {
            let mut row: Vec<usize> =
                rows.row(i).filter(|&j| particles.director[i].dot(particles.director[j]) > 0.0).collect();
            row.sort_unstable();
            let around: Vec<Neighbour> = row
                .iter()
                .map(|&j| {
                    let d = (particles.position[j] - particles.position[i]) / kernel.support();
                    let u = (1.0 - d.length()).max(0.0);
                    let influence = scale * particles.area[j] * u * u * u;
                    Neighbour { at: tangent[i].map(|t| t.dot(d)), influence }
                })
                .collect();
            let (weights, eigenvalue) = gradient_weights(&around);
            if eigenvalue <= FLATTEST || eigenvalue.is_nan() {
                let (particle, position) = (particles.id[i], particles.position[i]);
                return Err(ShellError::Lonely { particle, position, neighbours: row.len(), eigenvalue });
            }
            weight.extend(weights.iter().map(|w| w.map(|w| w / kernel.support())));
            neighbour.extend(row);
            start.push(neighbour.len());
        }
        Ok(Self { start, neighbour, weight })
    }

    fn of(&self, i: usize) -> impl Iterator<Item = (usize, [f64; 2])> + '_ {
        (self.start[i]..self.start[i + 1]).map(|k| (self.neighbour[k], self.weight[k]))
    }

    /// Weight of `j` in the gradient of `i`, zero where they do not see each other \[1/m\].
    fn weight(&self, i: usize, j: usize) -> [f64; 2] {
        let range = self.start[i]..self.start[i + 1];
        match self.neighbour[range.clone()].binary_search(&j) {
            Ok(k) => self.weight[range.start + k],
            Err(_) => [0.0; 2],
        }
    }
}

/// Two unit vectors that make a right-handed frame with the unit vector `n`.
fn tangents(n: DVec3) -> [DVec3; 2] {
    let axis = if n.z.abs() < 0.9 { DVec3::Z } else { DVec3::X };
    let t1 = axis.cross(n).normalize();
    [t1, n.cross(t1)]
}

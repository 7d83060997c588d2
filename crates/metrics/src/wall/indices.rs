//! Indices of a cycle of wall shear stress.

use crate::definition::Definition;
use glam::DVec3;
use vaso_particles::Memory;

/// Largest residence time and activation potential told \[1/Pa\]: beyond, they say no more than that there is hardly any shear.
pub const LARGEST_INVERSE: f64 = 1e3;
/// Mean stress over mean magnitude below which the mean is rounding error.
const NO_MEAN: f64 = 1e-9;

/// Indices of one point over one cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointIndices {
    /// Mean of the stress, a vector \[Pa\].
    pub mean: DVec3,
    /// Time-averaged wall shear stress: mean of the magnitude \[Pa\].
    pub tawss: f64,
    /// Oscillatory shear index, 0 to 0.5; `None` without any stress.
    pub osi: Option<f64>,
    /// Relative residence time \[1/Pa\], at most [`LARGEST_INVERSE`]; `None` where the mean vanishes.
    pub rrt: Option<f64>,
    /// Endothelial cell activation potential \[1/Pa\], at most [`LARGEST_INVERSE`]; `None` without any stress.
    pub ecap: Option<f64>,
    /// Transverse wall shear stress \[Pa\]; `None` in the first cycle, which has no mean direction to go by.
    pub transverse: Option<f64>,
    /// Largest magnitude in the cycle \[Pa\].
    pub peak: f64,
}

impl PointIndices {
    /// Indices from the mean \[Pa\], the mean magnitude \[Pa\], the transverse part \[Pa\] and the peak \[Pa\].
    pub(super) fn new(mean: DVec3, tawss: f64, transverse: Option<f64>, peak: f64) -> Self {
        // Rounding must not take the index below zero.
        let osi = (tawss > 0.0).then(|| (0.5 * (1.0 - mean.length() / tawss)).max(0.0));
        let rrt = (mean.length() > NO_MEAN * tawss).then(|| mean.length().recip().min(LARGEST_INVERSE));
        let ecap = osi.map(|osi| (osi / tawss).min(LARGEST_INVERSE));
        Self { mean, tawss, osi, rrt, ecap, transverse, peak }
    }

    /// Its numbers in the order of the fields; those that are missing are not numbers.
    fn to_array(self) -> [f64; 9] {
        let Self { mean, tawss, osi, rrt, ecap, transverse, peak } = self;
        let [osi, rrt, ecap, transverse] = [osi, rrt, ecap, transverse].map(|x| x.unwrap_or(f64::NAN));
        [mean.x, mean.y, mean.z, tawss, osi, rrt, ecap, transverse, peak]
    }

    /// The indices of which [`Self::to_array`] gave the numbers; `None` where none of them is one.
    fn from_array([x, y, z, tawss, osi, rrt, ecap, transverse, peak]: [f64; 9]) -> Option<Self> {
        let [osi, rrt, ecap, transverse] =
            [osi, rrt, ecap, transverse].map(|x| Some(x).filter(|x| !x.is_nan()));
        let indices = Self { mean: DVec3::new(x, y, z), tawss, osi, rrt, ecap, transverse, peak };
        (!tawss.is_nan()).then_some(indices)
    }
}

/// Indices of all points of a wall over one cycle.
#[derive(Clone, Debug, PartialEq)]
pub struct ShearCycle {
    /// Number of the cycle, from 0.
    pub number: u64,
    /// Indices of each point; `None` where it had no stress for a tenth of the cycle or more.
    pub point: Vec<Option<PointIndices>>,
}

/// What [`ShearSample::stress`](crate::ShearSample::stress) is.
pub const STRESS_DEFINITION: Definition = Definition {
    name: "WSS",
    unit: "Pa",
    formula: "mu (I - n n) (grad v + grad v^T) m, m = -n into the lumen: the drag on the wall",
    source: "moving least squares: Lancaster, Salkauskas 1981",
};

/// What the numbers of [`ShearCycle::fields`] are, in the same order.
pub const SHEAR_DEFINITIONS: [Definition; 6] = [
    Definition {
        name: "TAWSS",
        unit: "Pa",
        formula: "1/T int |tau| dt",
        source: "Ku, Giddens, Zarins, Glagov 1985; Malek, Alper, Izumo 1999",
    },
    Definition {
        name: "OSI",
        unit: "",
        formula: "1/2 (1 - |int tau dt| / int |tau| dt)",
        source: "He, Ku 1996",
    },
    Definition {
        name: "RRT",
        unit: "1/Pa",
        formula: "1 / ((1 - 2 OSI) TAWSS) = T / |int tau dt|, at most 1000",
        source: "Himburg et al. 2004",
    },
    Definition {
        name: "ECAP",
        unit: "1/Pa",
        formula: "OSI / TAWSS, at most 1000",
        source: "Di Achille, Tellides, Figueroa, Humphrey 2014",
    },
    Definition {
        name: "TransverseWSS",
        unit: "Pa",
        formula: "1/T int |tau . (n x d)| dt, d the direction of the mean stress of the cycle before",
        source: "Peiffer, Sherwin, Weinberg 2013",
    },
    Definition { name: "PeakWSS", unit: "Pa", formula: "max |tau| over the cycle", source: "" },
];

impl ShearCycle {
    /// A cycle of `n` points without values, to be filled by [`Self::remember`].
    pub fn empty(n: usize) -> Self {
        Self { number: 0, point: vec![None; n] }
    }

    /// Shows all of it, under `name`.
    pub fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { number, point } = self;
        memory.counts(&format!("{name}.number"), &mut [number]);
        let of = |p: &Option<PointIndices>| p.map_or([f64::NAN; 9], PointIndices::to_array);
        let mut numbers: Vec<f64> = point.iter().flat_map(of).collect();
        memory.fixed_numbers(&format!("{name}.indices"), &mut numbers);
        *point = numbers.as_chunks().0.iter().map(|p| PointIndices::from_array(*p)).collect();
    }

    /// The fields of [`SHEAR_DEFINITIONS`], one entry a point; not a number where there is no value.
    pub fn fields(&self) -> [Vec<f64>; 6] {
        let field = |value: fn(&PointIndices) -> Option<f64>| {
            self.point.iter().map(|p| p.as_ref().and_then(value).unwrap_or(f64::NAN)).collect()
        };
        [
            field(|p| Some(p.tawss)),
            field(|p| p.osi),
            field(|p| p.rrt),
            field(|p| p.ecap),
            field(|p| p.transverse),
            field(|p| Some(p.peak)),
        ]
    }

    /// How much the time-averaged stress differs from that of another cycle, over its mean; each point stands for its
    /// `area` \[m^2\]. Points without a value in either do not count; `None` where none is left.
    ///
    /// # Panics
    /// When the cycles or the areas are those of another number of points.
    pub fn change_from(&self, before: &ShearCycle, area: &[f64]) -> Option<f64> {
        assert_eq!((self.point.len(), before.point.len()), (area.len(), area.len()), "cycles of one wall");
        let (mut difference, mut sum) = (0.0, 0.0);
        for ((now, before), area) in self.point.iter().zip(&before.point).zip(area) {
            if let (Some(now), Some(before)) = (now, before) {
                difference += area * (now.tawss - before.tawss).abs();
                sum += area * now.tawss;
            }
        }
        (sum > 0.0).then(|| difference / sum)
    }

    /// Mean over the wall of the time-averaged stress \[Pa\], by area \[m^2\]; `None` where no point has a value.
    pub fn mean_tawss(&self, area: &[f64]) -> Option<f64> {
        let valued = self.point.iter().zip(area).filter_map(|(p, a)| p.as_ref().map(|p| (p.tawss, a)));
        let (sum, total) = valued.fold((0.0, 0.0), |(sum, total), (t, a)| (sum + a * t, total + a));
        (total > 0.0).then(|| sum / total)
    }
}

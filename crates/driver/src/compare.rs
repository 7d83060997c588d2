//! `vaso particles --compare`: generators of the fluid side by side, by quality and by cost.

use crate::bodies::{self, FluidBody};
use crate::case::Case;
use crate::error::DriverError;
use crate::print;
use crate::progress::Progress;
use crate::quality;
use crate::results::surface_report;
use crate::run::Talk;
use glam::DVec3;
use rayon::prelude::*;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;
use vaso_generation::Settings;
use vaso_geometry::{Centerlines, Vessel};
use vaso_io::{CompareReport, ComparedGenerator, Histogram, OutputDir, Quality};
use vaso_kernels::CellGrid;
use vaso_report::{ComparedParticles, Plane, write_comparison};
use vaso_scene::{Generator, Lattice, Particles, Topology, Word};

/// A generator by the name it was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The name, such as `multiblock:o-grid`.
    pub name: String,
    /// The generator.
    pub generator: Generator,
}

impl Candidate {
    /// The generators of a list such as `multiblock,relaxed-lattice:bcc`.
    ///
    /// # Errors
    /// When a name is not that of a generator, or stands there twice.
    pub fn listed(text: &str) -> Result<Vec<Self>, DriverError> {
        let mut candidates: Vec<Self> = Vec::new();
        for name in text.split(',').map(str::trim) {
            let generator = generator(name).ok_or_else(|| {
                DriverError::input(format!(
                    "--compare: \"{name}\" is no generator; allowed: relaxed-lattice, multiblock, and with a start or an \
                     arrangement {}",
                    variants().join(", ")
                ))
            })?;
            if candidates.iter().any(|c| c.generator == generator) {
                return Err(DriverError::input(format!(
                    "--compare: \"{name}\" names a generator for the second time"
                )));
            }
            candidates.push(Self { name: name.to_owned(), generator });
        }
        Ok(candidates)
    }
}

fn generator(name: &str) -> Option<Generator> {
    match name.split_once(':').unwrap_or((name, "")) {
        ("relaxed-lattice", "") => Some(Generator::RelaxedLattice(Lattice::Cubic)),
        ("relaxed-lattice", start) => Lattice::from_word(start).map(Generator::RelaxedLattice),
        ("multiblock", "") => Some(Generator::Multiblock(Topology::OGrid)),
        ("multiblock", arrangement) => Topology::from_word(arrangement).map(Generator::Multiblock),
        _ => None,
    }
}

fn variants() -> Vec<String> {
    let starts = Lattice::WORDS.iter().map(|word| format!("relaxed-lattice:{word}"));
    starts.chain(Topology::WORDS.iter().map(|word| format!("multiblock:{word}"))).collect()
}

/// One generator's particles with what they are worth and what they cost.
pub struct Compared {
    /// What is written of it.
    pub entry: ComparedGenerator,
    /// The particles.
    pub fluid: FluidBody,
}

/// Range of distances in the histograms \[spacings\], and of volumes \[cubed spacings\].
const DISTANCES: (f64, f64) = (0.4, 1.2);
const VOLUMES: (f64, f64) = (0.4, 1.6);
const BINS: usize = 80;

/// Makes and measures the fluid by one generator; the cache is left aside, as its time is asked for.
///
/// # Errors
/// When the spacing does not fit the vessel.
pub fn measure(
    vessel: &Vessel,
    settings: &Settings,
    candidate: &Candidate,
    smoothing_sweeps: usize,
    progress: &mut dyn FnMut(usize, f64),
) -> Result<Compared, vaso_generation::GenerationError> {
    let start = Instant::now();
    let fluid = bodies::fluid(vessel, settings, candidate.generator, smoothing_sweeps, progress)?;
    let seconds = start.elapsed().as_secs_f64();
    let spacing = settings.spacing;
    let distances = nearest_distances(&fluid.body.position, spacing);
    let volumes = fluid.body.volume.iter().map(|v| v / spacing.powi(3));
    let particles = Particles {
        spacing,
        generator: candidate.generator,
        smoothing_sweeps,
        relaxation_steps: settings.steps as u32,
    };
    let entry = ComparedGenerator {
        name: candidate.name.clone(),
        quality: quality::entry(&fluid.body.quality, seconds),
        blocks: quality::blocks(&fluid, &particles),
        nearest_neighbor: Histogram::of(distances, DISTANCES.0, DISTANCES.1, BINS),
        volume: Histogram::of(volumes, VOLUMES.0, VOLUMES.1, BINS),
    };
    Ok(Compared { entry, fluid })
}

/// Compares generators on the vessel of a case, prints a table and writes `compare.json` and `compare.html` into `out`.
///
/// # Errors
/// When a name or the case is wrong, a file is in the way, or the folder cannot be written. With wrong input nothing
/// has been written.
pub fn compare(
    case: &Case,
    generators: &str,
    out: &Path,
    force: bool,
    talk: &Talk,
) -> Result<CompareReport, DriverError> {
    let candidates = Candidate::listed(generators)?;
    OutputDir::keep_clear(["compare.json", "compare.html"].map(|name| out.join(name)), force)?;
    talk.say(&print::audit(&case.vessel, &case.scene.geometry.surface));
    let settings = bodies::settings(&case.scene);
    let sweeps = case.scene.particles.smoothing_sweeps;
    let mut progress = Progress::new(talk.quiet);
    let mut compared = Vec::with_capacity(candidates.len());
    for candidate in &candidates {
        let hear = &mut |step, moved| progress.relaxation(&candidate.name, step, moved);
        let made = measure(&case.vessel, &settings, candidate, sweeps, hear);
        compared.push(made.map_err(|source| DriverError::generation(case, &source))?);
    }
    progress.finish();
    let report = CompareReport {
        vaso_version: env!("CARGO_PKG_VERSION").into(),
        case: case.scene.title.clone(),
        spacing_m: settings.spacing,
        threads: rayon::current_num_threads() as u64,
        surface: surface_report(&case.vessel),
        generators: compared.iter().map(|c| c.entry.clone()).collect(),
    };
    talk.say(&table(&report));
    let out = OutputDir::open(out)?;
    report.write(&out.file("compare.json"))?;
    let particles: Vec<ComparedParticles<'_>> = compared
        .iter()
        .map(|c| ComparedParticles { position: &c.fluid.body.position, volume: &c.fluid.body.volume })
        .collect();
    write_comparison(out.path(), &report, &particles, middle(&case.vessel))?;
    Ok(report)
}

/// The plane across the vessel in the middle of its longest branch; across its box where no centreline is found.
pub fn middle(vessel: &Vessel) -> Plane {
    let lines = Centerlines::trace(vessel).unwrap_or_default();
    let longest = lines.branches.iter().max_by(|a, b| a.curve.length().total_cmp(&b.curve.length()));
    if let Some(branch) = longest {
        let arc = 0.5 * branch.curve.length();
        return Plane::across(branch.curve.at(arc), branch.curve.tangent(arc));
    }
    let (low, high) = vessel.surface.bounds();
    let extent = high - low;
    let axis = DVec3::AXES.into_iter().max_by(|a, b| extent.dot(*a).total_cmp(&extent.dot(*b)));
    Plane::across(0.5 * (low + high), axis.unwrap_or(DVec3::Z))
}

/// Distance of each particle to the nearest other \[spacings\], two spacings at most; in the order of the search.
fn nearest_distances(position: &[DVec3], spacing: f64) -> Vec<f64> {
    let start = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let bounds = position.iter().fold(start, |(low, high), x| (low.min(*x), high.max(*x)));
    let reach = 2.0 * spacing;
    let mut grid = CellGrid::new(bounds, reach);
    let mut order = Vec::new();
    grid.sort(position, &mut order);
    let sorted: Vec<DVec3> = order.iter().map(|&i| position[i as usize]).collect();
    let nearest = |(i, x): (usize, &DVec3)| {
        let runs = grid.runs(*x);
        let others = runs.as_slice().iter().flat_map(|&(a, b)| a..b).filter(|&j| j != i);
        others.map(|j| sorted[j].distance(*x)).fold(reach, f64::min) / spacing
    };
    sorted.par_iter().enumerate().map(nearest).collect()
}

/// Quality and cost in columns.
fn table(report: &CompareReport) -> String {
    let width = report.generators.iter().map(|g| g.name.len()).max().unwrap_or(0).max(9);
    let mut text = format!(
        "{:<width$} {:>9} {:>7} {:>7} {:>7} {:>15} {:>9} {:>9} {:>7} {:>8}\n",
        "generator",
        "count",
        "NN min",
        "NN CV",
        "vol CV",
        "kernel sum",
        "h|G| rms",
        "vol err",
        "outside",
        "seconds"
    );
    for generator in &report.generators {
        let Quality { kernel_sum_mean: mean, kernel_sum_std: std, seconds, .. } = generator.quality;
        let q = &generator.quality;
        let sum = mean.zip(std).map_or("-".to_owned(), |(mean, std)| format!("{mean:.4} ± {std:.4}"));
        let _ = writeln!(
            text,
            "{:<width$} {:>9} {:>7.3} {:>7.4} {:>7.4} {sum:>15} {:>9.4} {:>9.1e} {:>7} {:>8.2}",
            generator.name,
            q.count,
            q.nearest_neighbor_min,
            q.nearest_neighbor_cv,
            q.volume_cv,
            q.gradient_residual_rms,
            q.volume_error,
            q.outside,
            seconds.unwrap_or(f64::NAN)
        );
        for junction in generator.blocks.iter().flat_map(|b| &b.unblocked_junctions) {
            let _ = writeln!(text, "{:<width$} {junction}", "");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn generators_have_names_and_each_is_compared_once() {
        let list = Candidate::listed("multiblock, relaxed-lattice:bcc,multiblock:single")
            .expect("all are generators");
        let generators: Vec<Generator> = list.iter().map(|c| c.generator).collect();
        assert_eq!(
            generators,
            [
                Generator::Multiblock(Topology::OGrid),
                Generator::RelaxedLattice(Lattice::BodyCentred),
                Generator::Multiblock(Topology::Single)
            ]
        );
        for (text, word) in [
            ("multiblok", "\"multiblok\""),
            ("multiblock:cubic", "multiblock:o-grid"),
            ("multiblock,multiblock:o-grid", "second time"),
            ("", "no generator"),
        ] {
            let error = Candidate::listed(text).expect_err("not a list of generators").to_string();
            assert!(error.contains(word), "{text}: {error}");
        }
    }

    #[test]
    fn nearest_neighbours_of_a_lattice_are_a_spacing_away() {
        let lattice: Vec<DVec3> = (0..125)
            .map(|k| DVec3::new((k % 5) as f64, (k / 5 % 5) as f64, (k / 25) as f64) * 1e-3)
            .collect();
        let distances = nearest_distances(&lattice, 1e-3);
        assert!(distances.len() == 125 && distances.iter().all(|d| (d - 1.0).abs() < 1e-12));
        assert_eq!(nearest_distances(&[DVec3::ZERO], 1e-3), [2.0]);
    }
}

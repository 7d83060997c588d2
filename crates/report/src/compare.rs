//! `compare.html`: generators side by side.

use crate::drawing::{Drawing, Plane, sheet};
use crate::histogram::histograms;
use crate::html::{Column, escape, page, prose, section, table};
use crate::picture::{PictureOptions, Quantity, Style};
use crate::scale::{count, number};
use crate::vessel::figure;
use crate::{ReportError, vessel};
use glam::DVec3;
use std::path::{Path, PathBuf};
use vaso_io::{CompareReport, ComparedGenerator, FrameData, Histogram, schema, write_whole};

/// Particles of one generator, in the order of those in `compare.json`.
#[derive(Debug, Clone, Copy)]
pub struct ComparedParticles<'a> {
    /// Positions \[m\].
    pub position: &'a [DVec3],
    /// Volumes \[m^3\].
    pub volume: &'a [f64],
}

/// Width of the pictures \[pixels\].
const WIDTH: u32 = 1000;
/// Width of the sections \[pixels\], and their number in a row.
const SECTIONS: u32 = 960;
const COLUMNS: usize = 3;
/// Volumes at the ends of the colour map, in cubed spacings.
const VOLUMES: (f64, f64) = (0.5, 1.5);

/// Makes `compare.html` in `out_dir` from what was compared, and returns its path. The page is one file that needs no
/// network and no script.
///
/// `across` is a plane across the vessel: the particles next to it are drawn.
///
/// # Errors
/// [`ReportError::Io`] when the page cannot be written.
pub fn write_comparison(
    out_dir: &Path,
    report: &CompareReport,
    particles: &[ComparedParticles<'_>],
    across: Plane,
) -> Result<PathBuf, ReportError> {
    let path = out_dir.join("compare.html");
    let pick = |pick: fn(&ComparedGenerator) -> &Histogram| {
        report.generators.iter().map(|g| (g.name.as_str(), pick(g))).collect::<Vec<_>>()
    };
    let spacing = report.spacing_m;
    let body = [
        head(report),
        section("quality", "Quality and cost", &(qualities(report) + &junctions(report))),
        section(
            "spread",
            "How even the particles are",
            &(histograms("Distance to the nearest neighbour", "spacings", &pick(|g| &g.nearest_neighbor))
                + &histograms("Particle volume", "cubed spacings", &pick(|g| &g.volume))),
        ),
        section("section", "Across the vessel", &sections(report, particles, across)),
        section("cut", "Along the vessel", &cuts(report, particles, spacing, &path)),
    ];
    let foot = "Made by vaso with <code>compare.json</code> beside this file. Lengths are in spacings where no unit stands.";
    write_whole(&path, page(&report.case, "", &body.concat(), foot).as_bytes())?;
    Ok(path)
}

fn head(report: &CompareReport) -> String {
    format!(
        "<header><h1>{}</h1><p class=\"lead\">{} generators of particles at a spacing of {} mm in {} mm³</p></header>\n",
        escape(&report.case),
        report.generators.len(),
        number(1e3 * report.spacing_m, 3),
        number(1e9 * report.surface.volume_m3, 4)
    )
}

fn qualities(report: &CompareReport) -> String {
    let columns = [
        Column::Words("generator"),
        Column::Numbers("particles", ""),
        Column::Numbers("neighbour", "min"),
        Column::Numbers("", "variation"),
        Column::Numbers("volume", "variation"),
        Column::Numbers("kernel sum", ""),
        Column::Numbers("h|G|", "rms"),
        Column::Numbers("volume error", "%"),
        Column::Numbers("outside", ""),
        Column::Numbers("time", "s"),
    ];
    let row = |g: &ComparedGenerator| {
        let q = &g.quality;
        let sum = q.kernel_sum_mean.zip(q.kernel_sum_std);
        vec![
            escape(&g.name),
            count(q.count),
            number(q.nearest_neighbor_min, 3),
            number(q.nearest_neighbor_cv, 3),
            number(q.volume_cv, 3),
            sum.map_or("–".into(), |(mean, std)| format!("{} ± {}", number(mean, 4), number(std, 2))),
            number(q.gradient_residual_rms, 3),
            format!("{:.2}", 100.0 * q.volume_error).replace('-', "−"),
            count(q.outside),
            number(q.seconds.unwrap_or(f64::NAN), 3),
        ]
    };
    let threads = report.threads;
    let rows: Vec<Vec<String>> = report.generators.iter().map(row).collect();
    table("Generators", &columns, &rows)
        + &format!(
            "<p class=\"soft\">Neighbour is the distance to the nearest one. Variation is standard deviation over mean; the kernel sum is that of particles with full \
             support (mean ± standard deviation) over that of a cubic lattice; G is the sum of kernel gradients, completed by what the wall cuts off. \
             Times are wall times on {threads} threads, of one run each, and the machine may have had other work.</p>\n"
        )
}

/// What of the blocks had to be left to the lattice.
fn junctions(report: &CompareReport) -> String {
    let notes = report.generators.iter().flat_map(|g| {
        let reasons = g.blocks.iter().flat_map(|b| &b.unblocked_junctions);
        reasons.map(|reason| format!("<p class=\"note\">{}: {}</p>\n", escape(&g.name), prose(reason)))
    });
    notes.collect()
}

/// Particles within half a spacing of the plane, as discs of the size of their volumes.
fn sections(report: &CompareReport, particles: &[ComparedParticles<'_>], across: Plane) -> String {
    let drawings: Vec<Drawing> = particles.iter().map(|p| slab(p, across, report.spacing_m)).collect();
    let names = report.generators.iter().map(|g| g.name.as_str());
    let panels: Vec<(&str, &Drawing)> = names.zip(&drawings).collect();
    let label = "Particles within half a spacing of a plane across the middle of the longest branch";
    format!(
        "<figure class=\"sheet\"><figcaption><b>{label}</b> <small>discs of the volume of the particles; the colour goes from \
         {} (dark) to {} cubed spacings (bright)</small></figcaption>{}</figure>\n",
        number(VOLUMES.0, 2),
        number(VOLUMES.1, 2),
        sheet(&panels, COLUMNS, SECTIONS, label, false)
    )
}

/// The particles within half a spacing of the plane that hang together with those next to its origin.
pub fn slab(particles: &ComparedParticles<'_>, across: Plane, spacing: f64) -> Drawing {
    let near = |x: &DVec3| across.height(*x).abs() < 0.5 * spacing;
    let mut left: Vec<usize> =
        (0..particles.position.len()).filter(|&i| near(&particles.position[i])).collect();
    let from_origin = |i: usize| across.project(particles.position[i]).length();
    left.sort_by(|&a, &b| from_origin(a).total_cmp(&from_origin(b)).then(a.cmp(&b)));
    // Other limbs may cross the plane too.
    let mut taken: Vec<usize> = left.drain(..left.len().min(1)).collect();
    let mut next = 0;
    while next < taken.len() {
        let x = across.project(particles.position[taken[next]]);
        let joined = |i: usize| across.project(particles.position[i]).distance(x) < 2.0 * spacing;
        taken.extend(left.extract_if(.., |i| joined(*i)));
        next += 1;
    }
    let mut drawing = Drawing::new(across);
    for &i in &taken {
        let relative = particles.volume[i] / spacing.powi(3);
        // Discs of 0.9 of the edge of a cube of that volume stay apart.
        let radius = 0.45 * particles.volume[i].cbrt();
        drawing.dot(particles.position[i], radius, (relative - VOLUMES.0) / (VOLUMES.1 - VOLUMES.0));
    }
    drawing
}

/// Pictures of the half of the vessel behind its middle.
fn cuts(report: &CompareReport, particles: &[ComparedParticles<'_>], spacing: f64, path: &Path) -> String {
    let options = PictureOptions {
        quantity: Quantity::Volume,
        style: Style::Cut,
        width: WIDTH,
        spacing: Some(spacing),
    };
    let figures = report.generators.iter().zip(particles).map(|(generator, particles)| {
        let relative = particles.volume.iter().map(|v| v / spacing.powi(3)).collect();
        let frame = FrameData {
            time: 0.0,
            position: particles.position.to_vec(),
            scalars: vec![(schema::VOLUME.to_owned(), relative)],
            vectors: Vec::new(),
            ids: None,
        };
        let title = format!("{}, cut along the middle", generator.name);
        figure(&frame, path, &title, "", &options).unwrap_or_else(|error| vessel::note(&error))
    });
    figures.collect()
}

//! The tables of the page.

use crate::poiseuille;
use glam::DVec3;
use std::f64::consts::FRAC_PI_2;
use std::fmt::Write;
use std::time::Instant;
use vaso_driver::compare::{Candidate, measure};
use vaso_generation::{Ends, Settings, ShellReference, ShellSettings, shell, wall};
use vaso_geometry::shapes::{BifurcationSpec, bent_pipe, bifurcation, pipe};
use vaso_geometry::{LengthUnit, Surface, Vessel, prepare};

/// All generators, by the names of `--compare`.
pub(crate) const GENERATORS: &str =
    "relaxed-lattice:cubic,relaxed-lattice:bcc,multiblock:single,multiblock:nine-block,multiblock:o-grid";

/// Points around a pipe.
const SEGMENTS: usize = 96;

/// A surface in metres, ready for particles.
pub(crate) fn vessel(surface: Surface) -> Vessel {
    prepare(surface, Some(LengthUnit::Metre)).expect("surfaces of our own are sound")
}

/// The generators of a list.
pub(crate) fn candidates(list: &str) -> Vec<Candidate> {
    Candidate::listed(list).unwrap_or_else(|e| panic!("{e}"))
}

/// Arrangements of blocks in straight tubes.
pub(crate) fn sections() -> String {
    let mut text = "| arrangement | D/dp | particles | volume variation | smallest cell | nearest neighbour min | variation |\n\
                    |---|---|---|---|---|---|---|\n"
        .to_owned();
    for across in [10.0, 16.0, 24.0] {
        let tube = vessel(pipe(3e-3, 15e-3, DVec3::Z, SEGMENTS));
        for candidate in candidates("multiblock:single,multiblock:nine-block,multiblock:o-grid") {
            let settings = Settings::new(6e-3 / across);
            let made =
                measure(&tube, &settings, &candidate, 0, &mut |_, _| {}).unwrap_or_else(|e| panic!("{e}"));
            let (q, blocks) = (made.entry.quality, made.entry.blocks.unwrap_or_default());
            let _ = writeln!(
                text,
                "| {} | {across} | {} | {:.3} | {:.3} | {:.3} | {:.3} |",
                blocks.topology,
                q.count,
                q.volume_cv,
                blocks.smallest_cell,
                q.nearest_neighbor_min,
                q.nearest_neighbor_cv
            );
        }
    }
    text.trim_end().to_owned()
}

/// Quality and cost on vessels.
pub(crate) fn vessels() -> String {
    let mut text = "| vessel | generator | particles | neighbour min | variation | volume variation | kernel sum | `h\\|G\\|` | \
                    volume error | outside | by the lattice | time |\n\
                    |---|---|---|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    let shapes = [
        ("pipe", pipe(3e-3, 20e-3, DVec3::Z, SEGMENTS)),
        ("bent pipe", bent_pipe(3e-3, 12e-3, FRAC_PI_2, SEGMENTS)),
        ("bifurcation", bifurcation(&BifurcationSpec::default())),
    ];
    for (name, surface) in shapes {
        let vessel = vessel(surface);
        for candidate in candidates(GENERATORS) {
            let made = measure(&vessel, &Settings::new(0.5e-3), &candidate, 0, &mut |_, _| {});
            let made = made.unwrap_or_else(|e| panic!("{e}"));
            let (q, blocks) = (made.entry.quality, made.entry.blocks.unwrap_or_default());
            let _ = writeln!(
                text,
                "| {name} | {} | {} | {:.3} | {:.3} | {:.3} | {:.4} ± {:.4} | {:.4} | {:+.2} % | {} | {:.1} % | {:.1} s |",
                candidate.name,
                q.count,
                q.nearest_neighbor_min,
                q.nearest_neighbor_cv,
                q.volume_cv,
                q.kernel_sum_mean.unwrap_or(f64::NAN),
                q.kernel_sum_std.unwrap_or(f64::NAN),
                q.gradient_residual_rms,
                100.0 * q.volume_error,
                q.outside,
                100.0 * blocks.lattice_share,
                q.seconds.unwrap_or(f64::NAN)
            );
        }
    }
    text.trim_end().to_owned()
}

/// Walls and a shell of the bifurcation.
pub(crate) fn layers() -> String {
    let mut text =
        "| body | particles | nearest neighbour min | variation | `h\\|G\\|` | held | steps | time |\n\
                    |---|---|---|---|---|---|---|---|\n"
            .to_owned();
    let vessel = vessel(bifurcation(&BifurcationSpec::default()));
    let settings = Settings::new(0.5e-3);
    let held = |clamped: &[bool]| clamped.iter().filter(|&&c| c).count();
    let ends = [
        ("closest-cap", Ends::ClosestCap),
        ("boxes", Ends::Boxes),
        ("collar", Ends::Collar { length: 1.3e-3 }),
    ];
    for (name, ends) in ends {
        let start = Instant::now();
        let made = wall(&vessel, &settings, 1.5e-3, ends, &mut |_, _| {}).unwrap_or_else(|e| panic!("{e}"));
        let q = &made.body.quality;
        let _ = writeln!(
            text,
            "| wall, {name} | {} | {:.3} | {:.3} | {:.4} | {} | {} | {:.1} s |",
            q.count,
            q.nearest_neighbor_min,
            q.nearest_neighbor_cv,
            q.gradient_residual_rms,
            held(&made.clamped),
            q.iterations,
            start.elapsed().as_secs_f64()
        );
    }
    let start = Instant::now();
    let settings = ShellSettings { reference: ShellReference::Lumen, ..ShellSettings::new(0.5e-3, 0.5e-3) };
    let made = shell(&vessel, &settings, &mut |_, _| {}).unwrap_or_else(|e| panic!("{e}"));
    let q = &made.quality;
    let _ = write!(
        text,
        "| shell | {} | {:.3} | {:.3} | {:.4} | {} | {} | {:.1} s |",
        q.count,
        q.nearest_neighbor_min,
        q.nearest_neighbor_cv,
        q.gradient_residual_rms,
        held(&made.clamped),
        q.iterations,
        start.elapsed().as_secs_f64()
    );
    text
}

/// Poiseuille flow on particles of both generators.
pub(crate) fn flows(across: &[f64]) -> String {
    let mut text = "| D/dp | generator | particles | velocity | transverse | flow | density | escaped | acoustic steps | time |\n\
                    |---|---|---|---|---|---|---|---|---|---|\n"
        .to_owned();
    for &across in across {
        for generator in ["relaxed-lattice", "multiblock"] {
            let e = poiseuille::run_with::<f32>(across, &[("particles.generator", generator)]);
            let _ = writeln!(
                text,
                "| {across} | {generator} | {} | {:.2} % | {:.2} % | {:+.2} % | {:.2} % | {} | {} | {:.0} s |",
                e.particles,
                100.0 * e.velocity,
                100.0 * e.transverse,
                100.0 * e.flow,
                100.0 * e.density,
                e.escaped,
                e.steps,
                e.seconds
            );
        }
    }
    text.trim_end().to_owned()
}

//! `docs/speed.md`.

use super::{Ladder, Rung};
use std::fmt::Write;

const HEAD: &str = "\
# How fast it is

Made by `cargo bench -p vaso-benches --bench ladder -- --write`; do not edit. The flows are those of `cases/carotid`, the bifurcation of
average dimensions, from rest, with walls of 0.6 mm, 1.106 MPa and a Poisson ratio of 0.49 where they deform. Times are processor times of one core;
the reference is the pair loops of an acoustic step, momentum and continuity, plainly written in double precision, one pair after the other, and timed in
the same run. Ratios vary by about a tenth between runs, seconds by a third.
";

/// The page of a ladder.
pub fn render(ladder: &Ladder) -> String {
    let mut text = HEAD.to_owned();
    machine(&mut text, ladder);
    rungs(&mut text, ladder);
    stages(&mut text, ladder);
    growth(&mut text, ladder);
    asked(&mut text, ladder);
    text
}

fn machine(text: &mut String, ladder: &Ladder) {
    let m = &ladder.machine;
    let _ = write!(
        text,
        "\n## The machine and the pair loops\n\nInstruction set {}; one core makes {:.0} (mixed) and {:.0} (double) multiply-adds a nanosecond of all \
         lanes together, and streams {:.0} GB/s. On a box of 195 112 particles the reference takes {:.0} ns a particle.\n\n\
         | precision | both loops, ns | pairs a particle | pairs a second | over the reference | multiply-adds reached | asked |\n\
         |---|---|---|---|---|---|---|\n",
        m.isa, m.multiply_adds[0], m.multiply_adds[1], m.triad_gb_s, ladder.reference_ns
    );
    for l in &ladder.loops {
        let (peak, asked) =
            if l.precision == "mixed" { (m.multiply_adds[0], 4.2) } else { (m.multiply_adds[1], 2.3) };
        let reached = l.pairs * MULTIPLY_ADDS / l.ns / peak;
        let _ = writeln!(
            text,
            "| {} | {:.0} | {:.1} | {:.2} G | {:.1}x | {:.0} % | {asked}x |",
            l.precision,
            l.ns,
            l.pairs,
            2.0 * l.pairs / l.ns,
            ladder.reference_ns / l.ns,
            100.0 * reached
        );
    }
    let _ = writeln!(
        text,
        "\nMultiply-adds are counted as {MULTIPLY_ADDS} a pair; gathering neighbours, which takes no less of a core, is not."
    );
}

/// Multiply-adds of a pair in both loops: 26 to its distance, kernel and dissipation in the momentum, 14 in the continuity.
const MULTIPLY_ADDS: f64 = 40.0;

fn rungs(text: &mut String, ladder: &Ladder) {
    text.push_str(
        "\n## Whole flows\n\nA step is an acoustic one with its share of the advective one: all there is to it, per particle of the blood.\n\n\
         | wall | precision | spacing, mm | blood | wall | step, ns | M particle steps/s/core | reference over it | threads | \
         sub-step of the wall, ns | bytes, blood | bytes, wall | a beat of 0.757 s on two cores |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for r in &ladder.rungs {
        let wall = r.wall_ns().map_or("–".to_owned(), |ns| format!("{ns:.0}"));
        let bytes = if r.bytes[1] > 0.0 { format!("{:.0}", r.bytes[1]) } else { "–".to_owned() };
        let _ = writeln!(
            text,
            "| {} | {} | {} | {} | {} | {:.0} | {:.2} | {:.2} | {:.0} % | {wall} | {:.0} | {bytes} | {} |",
            r.wall,
            r.precision,
            r.spacing_mm,
            r.particles[0],
            r.particles[1],
            r.ns,
            r.rate(),
            ladder.reference_ns / r.ns,
            100.0 * r.efficiency,
            r.bytes[0],
            minutes(0.757 * r.seconds_a_second())
        );
    }
}

fn minutes(seconds: f64) -> String {
    if seconds < 90.0 * 60.0 {
        format!("{:.1} min", seconds / 60.0)
    } else {
        format!("{:.1} h", seconds / 3600.0)
    }
}

fn stages(text: &mut String, ladder: &Ladder) {
    text.push_str("\n## Where the time goes\n\nNanoseconds a particle of the blood and acoustic step, on one core.\n\n| stage |");
    let shown: Vec<&Rung> = ladder.rungs.iter().filter(|r| r.precision == "mixed").collect();
    for r in &shown {
        let _ = write!(text, " {} {} |", r.wall, r.spacing_mm);
    }
    let _ = write!(text, "\n|---|{}\n", "---|".repeat(shown.len()));
    let mut names: Vec<&str> = Vec::new();
    for name in shown.iter().flat_map(|r| r.stages.iter().map(|s| s.0.as_str())) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    for name in names {
        let _ = write!(text, "| `{name}` |");
        for r in &shown {
            let ns = r.ns * r.share(name);
            let _ = if ns > 0.0 { write!(text, " {ns:.1} |") } else { write!(text, " – |") };
        }
        text.push('\n');
    }
}

fn growth(text: &mut String, ladder: &Ladder) {
    let rigid: Vec<&Rung> =
        ladder.rungs.iter().filter(|r| r.wall == "rigid" && r.precision == "mixed").collect();
    let (Some(coarse), Some(fine)) = (rigid.first(), rigid.last()) else { return };
    let exponent = |cost: &dyn Fn(&Rung) -> f64| {
        (cost(fine) / cost(coarse)).ln() / (fine.spacing_mm / coarse.spacing_mm).ln()
    };
    let _ = write!(
        text,
        "\n## How it grows\n\nFrom {} to {} mm a second of flow with a rigid wall takes one core as the spacing to the power of {:.2}, at the same time per \
         particle and step {:.2}; the time of a step itself goes as {:.2}.\n",
        coarse.spacing_mm,
        fine.spacing_mm,
        exponent(&|r| r.ns * r.particles[0] as f64 / r.step_s),
        exponent(&|r| r.particles[0] as f64 / r.step_s),
        exponent(&|r| r.ns),
    );
}

fn asked(text: &mut String, ladder: &Ladder) {
    text.push_str("\n## Asked and found\n\n| asked | found |\n|---|---|\n");
    let mut line = |asked: &str, found: Option<(String, bool)>| {
        if let Some((found, holds)) = found {
            let _ = writeln!(
                text,
                "| {asked} | {} |",
                if holds { found } else { format!("**{found}, missed**") }
            );
        }
    };
    let rate = |precision: &str, least: f64| {
        ladder.rung("rigid", precision, 0.3).map(|r| (format!("{:.2}", r.rate()), r.rate() >= least))
    };
    line("rigid, 0.3 mm, mixed: 3.0 M particle steps/s/core", rate("mixed", 3.0));
    line("the same in double precision: 2.0", rate("double", 2.0));
    let substep = ladder.rung("shell", "mixed", 0.4).and_then(Rung::wall_ns);
    let substep = substep.map(|ns| (format!("{ns:.0} ns, with what an acoustic step adds"), ns <= 250.0));
    line("sub-step of a shell, 0.4 mm: 250 ns a particle", substep);
    let bytes = ladder.rung("rigid", "mixed", 0.3).map(|r| r.bytes[0]);
    line("700 bytes a particle of the blood", bytes.map(|b| (format!("{b:.0}"), b <= 700.0)));
    let efficiency = ladder.rung("rigid", "mixed", 0.3).map(|r| r.efficiency);
    line(
        "all threads at 90 % of ideal, 0.3 mm",
        efficiency.map(|e| (format!("{:.0} %", 100.0 * e), e >= 0.9)),
    );
    let beat = |wall: &str, least: f64| {
        ladder.rung(wall, "mixed", 0.4).map(|r| {
            let seconds = 0.757 * r.seconds_a_second();
            (minutes(seconds), seconds <= 60.0 * least)
        })
    };
    line("a beat of 0.757 s at 0.4 mm, rigid: 5 min on two cores", beat("rigid", 5.0));
    line("the same with a shell: 15 min", beat("shell", 15.0));
}

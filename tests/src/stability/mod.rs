//! Hard cases that have to stay stable, or stop with words that help: those of `docs/stability.md`.
//!
//! Each has a coarse run that the tests make. Those that are held by a test elsewhere name it.

mod flows;
pub mod page;
pub mod ride;
mod shapes;
pub mod vessels;

use crate::validation::Outcome;

/// What is hard, and who holds it.
pub struct Hard {
    /// Its number in the list, such as `H1`.
    pub id: &'static str,
    /// What happens.
    pub title: &'static str,
    /// What it usually breaks.
    pub breaks: &'static str,
    /// Who holds it.
    pub held: Held,
}

/// Who holds a hard case.
pub enum Held {
    /// A run of its own with its set-up in words; `None` from it where it wants outside data that are not there.
    Here(&'static str, fn() -> Option<Outcome>),
    /// Tests elsewhere, by file and name, and what they hold.
    Elsewhere(&'static str),
}

/// All hard cases, in order.
pub const CASES: &[Hard] = &[
    Hard {
        id: "H1",
        title: "Backflow at a pressure outlet at a Reynolds number of thousands",
        breaks: "Particles drawn in at the outlet are fast, few, or not there; the pressure runs away.",
        held: Held::Here(
            "Pipe of 20 mm, two diameters long, D/8, water-thin blood; a plug from +1 to -0.3 m/s and back in 0.4 s, one and a half \
             periods, pressure outlet: Reynolds number 6100. A plug moves layer by layer, sixteen of them, and a buffer that blood comes in through holds half \
             a layer less than one that it leaves by: that many particles the number changes by with no blood lost.",
            flows::backflow,
        ),
    },
    Hard {
        id: "H2",
        title: "A wall thinner than the spacing",
        breaks: "Blood leaks through one layer of particles.",
        held: Held::Here(
            "Shell of 0.3 mm around a tube of 6 mm at a spacing of 0.6 mm, E = 1 MPa, a flow of 0.1 m/s that comes in 10 ms.",
            flows::thin_wall,
        ),
    },
    Hard {
        id: "H3",
        title: "Two lumens closer than the support of the kernel",
        breaks: "Blood of one branch drags and pushes that of the other through the wall between.",
        held: Held::Here(
            "Hairpin of 4 mm whose legs are 0.8 mm apart at a spacing of 0.5 mm (support 1.3 mm), against the same with legs 4 mm \
             apart: the pressure that drives the flow through one leg.",
            shapes::hairpin,
        ),
    },
    Hard {
        id: "H4",
        title: "Walls as heavy as blood",
        breaks: "Explicit coupling pumps energy into a light soft wall (added mass).",
        held: Held::Elsewhere(
            "`tests/src/flows/shell_walls.rs` and `moving_wall.rs`: the energy of the wall is bounded by the work put in, density ratios 0.5 \
             to 1.2, solids of a spacing and shells from a twentieth of one to four",
        ),
    },
    Hard {
        id: "H5",
        title: "Sudden stop of the inflow, and suction",
        breaks: "Negative pressure tears voids and clumps particles.",
        held: Held::Here(
            "Pipe of 6.35 mm, D/10: 0.2 m/s stopped within 2 ms before an outlet at -2 kPa. The level of -2 kPa does nothing; the stop \
             pulls at the blood by rho c u.",
            flows::sudden_stop,
        ),
    },
    Hard {
        id: "H6",
        title: "Jet of a stenosis",
        breaks: "The Mach number rises fourfold in the throat; the jet leaves a void behind it.",
        held: Held::Here(
            "Pipe of 6 mm narrowed to a quarter of its area over 12 mm, eight spacings across the throat, Reynolds number 500 in it.",
            shapes::stenosis,
        ),
    },
    Hard {
        id: "H7",
        title: "Sharp flow divider",
        breaks: "Particles enter the wedge of wall particles one layer deep.",
        held: Held::Here(
            "The carotid of the demo at 0.7 mm, 50 ms from rest without a ramp.",
            shapes::divider,
        ),
    },
    Hard {
        id: "H8",
        title: "Surfaces that are open, holed, reversed, doubled, degenerate",
        breaks: "A wrong volume without a word.",
        held: Held::Elsewhere(
            "`crates/geometry/tests/defect_set.rs`, the fuzz targets `stl` and `vtp`, `tests/bad`",
        ),
    },
    Hard {
        id: "H9",
        title: "Coordinates far away, other units",
        breaks: "Single precision loses the vessel.",
        held: Held::Elsewhere("`frames` of docs/validation.md, and `crates/geometry/tests/defect_set.rs`"),
    },
    Hard {
        id: "H10",
        title: "An outlet too small for the spacing",
        breaks: "Its flow is that of two particles, and nobody says so.",
        held: Held::Here(
            "The carotid of the demo with so coarse a spacing that the smaller outlet is three spacings wide: a warning by name; coarser: \
             a refusal.",
            shapes::tiny_outlet,
        ),
    },
    Hard {
        id: "H11",
        title: "Tilted caps and caps that are none",
        breaks: "An opening is missed or made up.",
        held: Held::Elsewhere("`crates/geometry/tests/defect_set.rs`"),
    },
    Hard {
        id: "H12",
        title: "Windkessel with time constants below the step, or without one",
        breaks: "Explicit steps of the outlet oscillate.",
        held: Held::Elsewhere("`windkessel` of docs/validation.md: 1 ms to 50 s and both limits"),
    },
    Hard {
        id: "H13",
        title: "A resistance many times the impedance of the cap",
        breaks: "Pressure and flow answer each other at the acoustic period.",
        held: Held::Elsewhere("`stiff-outlet` of docs/validation.md: five times the impedance"),
    },
    Hard {
        id: "H14",
        title: "Full flow from the first moment on",
        breaks: "A water hammer larger than Joukowsky's.",
        held: Held::Here("Pipe of 6.35 mm, D/10: 0.1 m/s at once, pressure outlet.", flows::abrupt_onset),
    },
    Hard {
        id: "H15",
        title: "A start far from the pressure of the outlet",
        breaks: "A sound wave that goes to and fro for ever, or a jet from one outlet to the other.",
        held: Held::Here(
            "The carotid of the demo at 0.9 mm between Windkessels that start at 80 and at 78 mmHg. The common level is out of the \
             equation of state; one that stays in it leaves no trace (`tests/src/flows/openings.rs`).",
            flows::wrong_start,
        ),
    },
    Hard {
        id: "H16",
        title: "One outlet closed",
        breaks: "Particles pile up before it.",
        held: Held::Here(
            "The carotid of the demo at 0.8 mm with 1e13 Pa s/m^3 at the external branch, 1e8 at the other.",
            flows::closed_outlet,
        ),
    },
    Hard {
        id: "H17",
        title: "Velocities imposed everywhere",
        breaks: "The density drifts without a word.",
        held: Held::Elsewhere("refused by name: `tests/bad/openings-all-prescribed.toml`"),
    },
    Hard {
        id: "H18",
        title: "Many cycles",
        breaks: "Mass and pressure drift.",
        held: Held::Here(
            "Pipe of 6.35 mm, D/6, twenty cycles of 0.4 s into a Windkessel: the last cycle against the tenth.",
            flows::many_cycles,
        ),
    },
    Hard {
        id: "H19",
        title: "Viscous and thin",
        breaks: "The viscous step is missed; or nothing damps the noise.",
        held: Held::Here(
            "Pipe of 6.35 mm, D/8: Reynolds number 0.01 by a viscosity of 10 Pa s, and 5000 by one of 0.1 mPa s.",
            flows::viscosities,
        ),
    },
    Hard {
        id: "H20",
        title: "Shells that turn far",
        breaks: "Directors flip or lose their length.",
        held: Held::Elsewhere(
            "`crates/shell/tests`: roll-up of a strip to a circle, three free spins, Sze's cantilever; a tube that collapses under \
             pressure from outside until it touches itself is not tested",
        ),
    },
    Hard {
        id: "H21",
        title: "Numbers that cannot be",
        breaks: "A run that ends in NaN instead of a word.",
        held: Held::Elsewhere("`tests/bad`, each with its whole message"),
    },
    Hard {
        id: "H22",
        title: "Broken off, gone on, on more threads",
        breaks: "Another result.",
        held: Held::Elsewhere(
            "`crates/driver/tests/resume.rs`, `tests/src/flows/determinism.rs`: the same bits",
        ),
    },
];

/// The hard case of a number.
pub fn hard(id: &str) -> Option<&'static Hard> {
    CASES.iter().find(|hard| hard.id == id)
}

//! The studies of `docs/accuracy.md`.

pub mod page;

use vaso_driver::study::{Goal, Wish};

/// A case that is studied.
pub struct Studied {
    /// Name by which the generator is asked for it; that of its file in `tests/accuracy`.
    pub name: &'static str,
    /// Folder of the case, from the root of the project.
    pub case: &'static str,
    /// What the reader should know.
    pub remark: &'static str,
    /// Settings over those of the case.
    pub set: &'static [(&'static str, &'static str)],
    /// Spacings \[m\]; empty for those of the default ladder.
    pub spacings: &'static [f64],
    /// Ladders; empty for all that the case calls for.
    pub ladders: &'static [&'static str],
    /// What is asked for besides.
    pub goal: Option<Goal>,
}

impl Studied {
    /// Settings as for `--set`.
    pub fn settings(&self) -> Vec<(String, String)> {
        self.set.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect()
    }

    /// What is varied.
    pub fn wish(&self) -> Wish {
        let some = |list: &[&str]| (!list.is_empty()).then(|| list.iter().map(|s| (*s).to_owned()).collect());
        Wish {
            ladders: some(self.ladders),
            spacings: (!self.spacings.is_empty()).then(|| self.spacings.to_vec()),
            vary: Vec::new(),
        }
    }

    /// The command that does the same.
    pub fn command(&self) -> String {
        let mut text = format!("vaso study {}", self.case);
        for (key, value) in self.set {
            text += &format!(" --set '{key}={value}'");
        }
        if !self.ladders.is_empty() {
            text += &format!(" --ladders {}", self.ladders.join(","));
        }
        if !self.spacings.is_empty() {
            let list: Vec<String> =
                self.spacings.iter().map(|s| format!("{} mm", (1e9 * s).round() / 1e6)).collect();
            text += &format!(" --spacings \"{}\"", list.join(","));
        }
        match self.goal {
            Some(Goal::Error(error)) => text += &format!(" --error {}%", 100.0 * error),
            Some(Goal::Budget(budget)) => text += &format!(" --budget \"{budget} s\""),
            None => {}
        }
        text
    }
}

/// The studies, in the order of the page.
pub const CASES: &[Studied] = &[
    Studied {
        name: "pipe",
        case: "cases/pipe",
        remark: "The default study of the pipe, at nine, twelve and sixteen spacings across: errors are those of the mean \
                 velocity at four points of its middle against the formula. The inlet imposes the exact profile. A probe is a mean \
                 over the kernel, which takes off what the profile is curved: that is most of the error here. The particles \
                 themselves are nearer, see `poiseuille` in validation.md.",
        set: &[],
        spacings: &[],
        ladders: &[],
        goal: None,
    },
    Studied {
        name: "pipe-one-percent",
        case: "cases/pipe",
        remark: "The same pipe, asked for an error of one per cent: the spacing is found from the law of the ladder, and run.",
        set: &[],
        spacings: &[],
        ladders: &[],
        goal: Some(Goal::Error(0.01)),
    },
    Studied {
        name: "pipe-two-percent",
        case: "cases/pipe",
        remark: "The same for two per cent.",
        set: &[],
        spacings: &[],
        ladders: &[],
        goal: Some(Goal::Error(0.02)),
    },
    Studied {
        name: "womersley",
        case: "cases/womersley",
        remark: "A flow driven to and fro by the pressures at both ends, at twelve, fifteen and twenty spacings across, against the formula: `flow` is the amplitude \
                 of the outflow in the last of four periods, `velocity` the largest velocities at three points of the middle. What pressures lose at the caps is in both. Two per cent are asked for.",
        set: &[],
        spacings: &[],
        ladders: &[],
        goal: Some(Goal::Error(0.02)),
    },
    Studied {
        name: "elastic-tube",
        case: "cases/elastic-tube",
        remark: "A soft tube that its pressure widens by a ninth, at seven, nine and twelve spacings across: errors are those of the velocity at three places of its middle \
                 against Poiseuille in a tube as wide as a thick one of rubber becomes. Were the tube rigid, the velocity on its axis would be 26 % more. \
                 As in the pipe, the probes take off what the profile is curved, which falls with the spacing; the pressure makes the blood denser by 0.7 %, which falls with \
                 the square of the sound speed alone. Two per cent are asked for.",
        set: &[],
        spacings: &[],
        ladders: &["spacing", "sound-speed", "precision"],
        goal: Some(Goal::Error(0.02)),
    },
    Studied {
        name: "common-carotid",
        case: "cases/common-carotid",
        remark: "An elastic artery over a heartbeat, between a measured inflow and a Windkessel, at four, five and six spacings across. There is no formula: \
                 errors are counted from its own finest runs. How far it is from finite elements is in validation.md.",
        set: &[],
        spacings: &[],
        ladders: &["spacing"],
        goal: None,
    },
    Studied {
        name: "carotid",
        case: "cases/carotid",
        remark: "A bifurcation of the size of a carotid artery, for which there is no formula: errors are counted from what the \
                 three finest spacings converge to, or from the finest where they do not converge. They say nothing of what \
                 the model leaves out.",
        set: &[("output.fields", "[\"velocity\", \"pressure\", \"wss\"]")],
        spacings: &[],
        ladders: &[],
        goal: None,
    },
    Studied {
        name: "carotid-walls",
        case: "cases/carotid",
        remark: "The first 20 ms of the same bifurcation with a wall of 1 mm and 0.66 MPa: a shell, a solid of four layers, and one that is rigid, in \
                 the same blood. Of one spacing, so no error is told; what counts is what the walls cost and how alike the flows are. The largest displacement \
                 is 62 % more in the solid. By the formulas the inner face of a tube of 3.1 mm widens a fifth less as a thin shell than by Lame; the rest, in waves \
                 that a start has set going, was not looked into.",
        set: &[
            ("output.fields", "[\"velocity\", \"wss\"]"),
            ("wall.model", "shell"),
            ("wall.thickness", "1 mm"),
            ("wall.young_modulus", "0.66 MPa"),
            ("wall.poisson_ratio", "0.45"),
            // That of the plan with the shell: a rigid wall alone would have a tenth of it, and sound in place of a flow.
            ("numerics.sound_speed", "57 m/s"),
            ("opening.cca.ramp", "10 ms"),
            ("run.end_time", "20 ms"),
            ("output.table_every", "0.5 ms"),
        ],
        spacings: &[6e-4],
        ladders: &["wall"],
        goal: None,
    },
];

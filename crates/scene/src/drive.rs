//! Openings and what holds there.

use vaso_units::dimension::{FLOW_RATE, PRESSURE, VELOCITY};

use crate::build::Builder;
use crate::opening::{
    Condition, ConditionKind, Coupling, CouplingKind, Drive, Opening, Profile, ProfileKind,
};
use crate::scene::Run;
use crate::section::Section;

impl Builder<'_> {
    pub(crate) fn opening(&mut self, section: &Section, run: Option<&Run>) -> Option<Opening> {
        let kind = section.word("condition")?;
        if matches!(kind, ConditionKind::Velocity | ConditionKind::Flow | ConditionKind::Pressure) {
            self.waveform_options(section);
        }
        let condition = match kind {
            ConditionKind::Velocity => {
                let value = self.drive(section, "value", "waveform", VELOCITY, run);
                Condition::Velocity { profile: self.profile(section, run)?, value: value? }
            }
            ConditionKind::Flow => {
                let value = self.drive(section, "value", "waveform", FLOW_RATE, run);
                Condition::Flow { profile: self.profile(section, run)?, value: value? }
            }
            ConditionKind::Pressure => Condition::Pressure {
                value: if section.has("value") || section.has("waveform") {
                    self.drive(section, "value", "waveform", PRESSURE, run)?
                } else {
                    Drive::Constant(0.0)
                },
            },
            ConditionKind::Resistance => Condition::Resistance {
                resistance: section.number("resistance"),
                distal_pressure: section.number("distal_pressure"),
            },
            ConditionKind::Windkessel => {
                let distal_pressure = section.number("distal_pressure");
                Condition::Windkessel {
                    proximal_resistance: section.number("proximal_resistance"),
                    distal_resistance: section.number("distal_resistance"),
                    compliance: section.number("compliance"),
                    initial_pressure: section.optional_number("initial_pressure").unwrap_or(distal_pressure),
                    periodic_start: section.flag("periodic_start"),
                    distal_pressure,
                }
            }
        };
        let is_model = matches!(kind, ConditionKind::Resistance | ConditionKind::Windkessel);
        Some(Opening {
            name: section.text("name")?.to_owned(),
            near: section.point("near"),
            condition,
            ramp: section.optional_number("ramp"),
            coupling: if is_model { coupling(section)? } else { Coupling::default() },
            backflow_damping: is_model.then(|| section.number("backflow_damping")),
        })
    }

    fn profile(&mut self, section: &Section, run: Option<&Run>) -> Option<Profile> {
        let profile = match section.word("profile")? {
            ProfileKind::Plug => Profile::Plug,
            ProfileKind::Parabolic => Profile::Parabolic,
            ProfileKind::Power => Profile::Power { exponent: section.number("exponent") },
            ProfileKind::FullyDeveloped => Profile::FullyDeveloped,
            ProfileKind::Womersley => Profile::Womersley,
        };
        if profile == Profile::Womersley {
            let advice = "take \"parabolic\" for steady flow";
            if !section.has("waveform") {
                self.report(section, "profile", "needs a `waveform` to pulse with", "", advice);
            } else if run.is_some_and(|run| run.period.is_none()) {
                self.report(
                    section,
                    "profile",
                    "needs `run.period`, after which the waveform repeats",
                    "",
                    advice,
                );
            }
        }
        Some(profile)
    }
}

fn coupling(section: &Section) -> Option<Coupling> {
    Some(match section.word("coupling")? {
        CouplingKind::Impedance => Coupling::Impedance,
        CouplingKind::Window => Coupling::Window { duration: section.number("window") },
    })
}

//! The `case.toml` of a new case, with a comment on all that is not obvious.

use super::inflow::{Inflow, PERIOD};
use super::spacing::Chosen;
use crate::tune::MMHG;
use std::fmt::Write;
use vaso_boundary::Tuned;
use vaso_geometry::{Opening, Vessel};

/// Files beside the case.
pub(super) const WAVEFORM: &str = "inflow.csv";
pub(super) const SCHEMA: &str = "case.schema.json";
/// Beats of a first run: one that starts from rest, and one to look at.
const CYCLES: u32 = 2;
/// Blood pressure of a healthy adult \[mmHg\], and that behind the arterioles.
pub(super) const SYSTOLIC: f64 = 120.0;
pub(super) const DIASTOLIC: f64 = 80.0;
pub(super) const DISTAL: f64 = 5.0;

/// What a case says before its outlets are known.
pub(super) struct Draft<'a> {
    pub(super) vessel: &'a Vessel,
    /// Name of the copied surface.
    pub(super) surface: &'a str,
    /// What is said about its unit.
    pub(super) unit: &'a str,
    /// Names of the openings, the inlet first.
    pub(super) names: &'a [String],
    pub(super) inflow: &'a Inflow,
    /// Parameters of the outlets, in the order of the openings.
    pub(super) outlets: &'a [Tuned],
}

impl Draft<'_> {
    /// The whole file, with a spacing.
    pub(super) fn text(&self, spacing: &Chosen) -> String {
        let mut text = self.head(spacing);
        let [inlet, outlets @ ..] = self.vessel.openings.as_slice() else { return text };
        self.inlet(&mut text, inlet);
        for ((opening, name), tuned) in outlets.iter().zip(&self.names[1..]).zip(self.outlets) {
            self.outlet(&mut text, opening, name, tuned);
        }
        let table_every = 5.0;
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "
[run]
period = \"{period} s\"                # ASSUMED: 67 beats a minute; `{WAVEFORM}` holds one of them
cycles = {CYCLES}                      # the first starts from rest: look at the last; 5 and more with periodicity = 0.01 for numbers

[output]
every = \"{every} ms\"                # interval of the particle series, for ParaView
table_every = \"{table_every} ms\"           # interval of openings.csv: flow and pressure of each opening
fields = [\"velocity\", \"pressure\", \"wss\", \"tawss\", \"osi\"]
",
            period = PERIOD,
            every = 1e3 * PERIOD / 20.0,
        );
        text
    }

    fn head(&self, spacing: &Chosen) -> String {
        let narrow = self.vessel.openings.len() - 1;
        let (widest, narrowest) = (&self.vessel.openings[0], &self.vessel.openings[narrow]);
        format!(
            "#:schema ./{SCHEMA}
# Blood flow in {comment}, made by `vaso new`. It runs as it is; what was ASSUMED is marked, put in what you know.
# `vaso check` on this folder prints the plan with reasons and cost, `vaso run` runs it. `openings.svg` shows the openings.
# Quantities carry their unit, any unit of the dimension. Points are in the unit of the surface. Pressures are gauge.

[case]
title = {title}

[geometry]
surface = {surface}
unit = \"{unit}\"                      # {unit_reason}

[particles]
# {across:.1} particles across the narrowest opening (`{narrow_name}`), {wide:.1} across `{wide_name}`: {reason}.
# Patterns of the flow want 12 across, wall shear stress 20. Half the spacing takes 16 times as long: `vaso check` tells.
spacing = \"{spacing} mm\"

[blood]
density = \"1060 kg/m^3\"
viscosity = \"3.5 mPa s\"            # constant; {{ model = \"carreau-yasuda\" }} for blood that thins under shear

[wall]
model = \"rigid\"                    # \"shell\" or \"solid\" deform, and want a thickness and a young_modulus
",
            comment = one_line(self.surface),
            title = quoted(self.surface.rsplit_once('.').map_or(self.surface, |(stem, _)| stem)),
            surface = quoted(self.surface),
            unit = self.vessel.unit,
            unit_reason = self.unit,
            across = spacing.across,
            narrow_name = self.names[narrow],
            wide = spacing.across * widest.radius / narrowest.radius,
            wide_name = self.names[0],
            reason = spacing.reason,
            spacing = spacing.millimetres,
        )
    }

    fn inlet(&self, text: &mut String, opening: &Opening) {
        let mean_velocity = self.inflow.mean / opening.area;
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "
# {size}. ASSUMED to be the inlet, as it is the largest: exchange the tables where blood enters elsewhere.
[[opening]]
name = \"{name}\"
near = {near}
condition = \"flow\"
profile = \"parabolic\"              # \"womersley\" for a round inlet far from any bend, \"plug\" close behind a valve
waveform = \"{WAVEFORM}\"           # ASSUMED: {mean:.3} ml/s in the mean, {cm:.1} cm/s. {why}
",
            size = size(opening),
            name = self.names[0],
            near = near(self.vessel, opening),
            mean = 1e6 * self.inflow.mean,
            cm = 1e2 * mean_velocity,
            why = self.inflow.reason,
        );
    }

    fn outlet(&self, text: &mut String, opening: &Opening, name: &str, tuned: &Tuned) {
        let Tuned { fraction, model, cycle } = tuned;
        let [systolic, diastolic, mean] = [cycle.systolic, cycle.diastolic, cycle.mean].map(|p| p / MMHG);
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "
# {size}. ASSUMED: takes {share:.1} % of the flow, after the cube of its radius (Murray 1926), at {systolic:.0}/{diastolic:.0} mmHg,
# mean {mean:.0} mmHg. Other pressures and shares: `vaso tune`, which prints tables to put in place of this one.
[[opening]]
name = \"{name}\"
near = {near}
condition = \"windkessel\"
proximal_resistance = \"{rp:.4e} Pa s/m^3\"
distal_resistance = \"{rd:.4e} Pa s/m^3\"
compliance = \"{c:.4e} m^3/Pa\"
distal_pressure = \"{DISTAL} mmHg\"      # behind the arterioles
periodic_start = true              # from the pressure that many beats lead to, instead of an initial_pressure
",
            size = size(opening),
            share = 100.0 * fraction,
            near = near(self.vessel, opening),
            rp = model.proximal_resistance,
            rd = model.distal_resistance,
            c = model.compliance,
        );
    }
}

fn size(opening: &Opening) -> String {
    let n = opening.normal;
    format!(
        "{:.4} mm2, radius {:.3} mm, blood leaving it would go along [{:.2}, {:.2}, {:.2}]",
        1e6 * opening.area,
        1e3 * opening.radius,
        n.x,
        n.y,
        n.z
    )
}

/// The centre of an opening in the unit of the surface, to a hundredth of its radius.
fn near(vessel: &Vessel, opening: &Opening) -> String {
    let metres = vessel.unit.metres();
    let decimals = (2.0 - (opening.radius / metres).log10().floor()).clamp(1.0, 12.0) as usize;
    let center = (opening.center / metres).to_array().map(|x| {
        let text = format!("{x:.decimals$}");
        // No minus before a zero.
        if text.trim_matches(['-', '0', '.']).is_empty() { format!("{:.decimals$}", 0.0) } else { text }
    });
    format!("[{}]", center.join(", "))
}

/// Text as a string of TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// Text that does not end a comment.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files_survive_as_strings_of_toml() {
        assert_eq!(quoted("a \"b\" \\ c.stl"), r#""a \"b\" \\ c.stl""#);
        assert_eq!(quoted("tab\t"), "\"tab\\u0009\"");
        assert_eq!(one_line("a\nb"), "a b");
    }
}

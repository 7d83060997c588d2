//! Openings and what drives them: constants and waveform tables.

use vaso_units::Dimension;
use vaso_units::dimension::{FLOW_RATE, PRESSURE, VELOCITY};

use crate::build::Builder;
use crate::opening::{Condition, ConditionKind, Drive, Opening, Profile};
use crate::scene::Run;
use crate::section::Section;
use crate::table::{self, Table};
use crate::waveform::Waveform;

/// Most of the range of a waveform by which its two ends may differ where they stand for the same instant.
const LARGEST_JUMP: f64 = 0.05;

impl Builder<'_> {
    pub(crate) fn opening(&mut self, section: &Section, run: Option<&Run>) -> Option<Opening> {
        let condition = match section.word("condition")? {
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
        Some(Opening {
            name: section.text("name")?.to_owned(),
            near: section.point("near"),
            condition,
            ramp: section.optional_number("ramp"),
        })
    }

    fn profile(&mut self, section: &Section, run: Option<&Run>) -> Option<Profile> {
        let profile = section.word("profile")?;
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

    /// Reads what exactly one of two keys gives: a constant or the file of a waveform.
    pub(crate) fn drive(
        &mut self,
        section: &Section,
        value: &str,
        file: &str,
        dimension: Dimension,
        run: Option<&Run>,
    ) -> Option<Drive> {
        let allowed = format!("exactly one of `{value}` and `{file}`");
        match (section.has(value), section.has(file)) {
            (true, true) => {
                let message = format!("stands beside `{value}`, and both prescribe the same");
                self.report(section, file, message, allowed, "remove one of them");
                None
            }
            (false, false) => {
                self.report(
                    section,
                    value,
                    "is missing",
                    allowed,
                    format!("write a constant, or a file as `{file}`"),
                );
                None
            }
            (true, false) => section.optional_number(value).map(Drive::Constant),
            (false, true) => self.waveform(section, file, dimension, run?).map(Drive::Waveform),
        }
    }

    fn waveform(
        &mut self,
        section: &Section,
        key: &str,
        dimension: Dimension,
        run: &Run,
    ) -> Option<Waveform> {
        let file = section.path(key)?;
        let mut table = match table::read(&self.source.files, file, &section.key(key), dimension) {
            Ok(table) => table,
            Err(mut problems) => {
                self.problems.append(&mut problems);
                return None;
            }
        };
        match run.period {
            Some(period) => self.repeat(section, key, &mut table, period),
            None => self.cover(section, key, &table, run.end_time),
        }
        Some(Waveform { file: file.clone(), time: table.time, value: table.value, period: run.period })
    }

    /// Makes one period of the table: takes off a last sample that stands for the first of the next period.
    fn repeat(&mut self, section: &Section, key: &str, table: &mut Table, period: f64) {
        let (first, last) = (table.time[0], table.time[table.time.len() - 1]);
        let last_interval = last - table.time[table.time.len() - 2];
        let largest_interval = table.time.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        let duration = last - first;
        // Periods are often rounded more than tables; half an interval keeps a fine open table open.
        let rounding = (1e-3 * period).min(0.5 * last_interval);
        let allowed = format!("one period of {} s", period);
        if duration > period + rounding {
            let message = format!("the table lasts {duration} s, longer than `run.period`");
            self.report(
                section,
                key,
                message,
                allowed,
                format!("cut the table, or set `run.period` to \"{duration} s\""),
            );
        } else if duration < period - rounding {
            let gap = period - duration;
            if gap > 2.0 * largest_interval {
                let message = format!("the table lasts {duration} s and leaves {gap} s of `run.period` open");
                let advice = format!("complete the table, or set `run.period` to \"{duration} s\"");
                self.report(section, key, message, allowed, advice);
            }
        } else {
            let (start, end) = (table.value[0], table.value[table.value.len() - 1]);
            let low = table.value.iter().copied().fold(f64::INFINITY, f64::min);
            let high = table.value.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            if (end - start).abs() > LARGEST_JUMP * (high - low) {
                let message = format!("the table begins at {start} and ends a period later at {end}");
                let allowed = format!("ends that differ by at most {} % of the range", 100.0 * LARGEST_JUMP);
                self.report(section, key, message, allowed, "close the waveform, or drop its last line");
            }
            table.time.pop();
            table.value.pop();
        }
    }

    /// A table that does not repeat has to cover the whole run.
    fn cover(&mut self, section: &Section, key: &str, table: &Table, end_time: f64) {
        let (first, last) = (table.time[0], table.time[table.time.len() - 1]);
        if first > 0.0 || last < end_time * (1.0 - 1e-9) {
            let message = format!("the table covers {first} s to {last} s, the run 0 s to {end_time} s");
            let advice = "give `run.period` if the waveform repeats, or complete the table";
            self.report(section, key, message, "a table that covers the run", advice);
        }
    }
}

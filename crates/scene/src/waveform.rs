//! Values over time: constants and tables, and how they are read.

use std::path::PathBuf;

use vaso_units::{Dimension, parse_unit};

use crate::build::Builder;
use crate::opening::Drive;
use crate::scene::Run;
use crate::section::Section;
use crate::table::{self, Table};
use crate::words::words;

/// A value over time, as read from a file of two columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Waveform {
    /// The file it came from.
    pub file: PathBuf,
    /// Times, strictly increasing \[s\].
    pub time: Vec<f64>,
    /// Values at these times, in the SI unit of what the waveform prescribes.
    pub value: Vec<f64>,
    /// Time after which the waveform repeats \[s\], `run.period`; `None` for one that does not repeat, which then
    /// covers the whole run. A repeated first sample at the end of the period has been taken off, so the last interval
    /// runs from the last sample to the first one of the next period.
    pub period: Option<f64>,
    /// How it goes from one sample to the next.
    pub interpolation: Interpolation,
}

words! {
    /// The interpolations of the file.
    pub(crate) enum InterpolationKind {
        Linear = "linear",
        Monotone = "monotone",
        Fourier = "fourier",
    }
}

/// How a waveform goes from one sample to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// Straight lines.
    #[default]
    Linear,
    /// Cubic pieces with continuous slope that stay between the samples beside them.
    Monotone,
    /// A mean and so many harmonics of the period, which pass near the samples.
    Fourier {
        /// Number of harmonics, at most half the number of samples.
        harmonics: u32,
    },
}

/// Most of the range of a waveform by which its two ends may differ where they stand for the same instant.
const LARGEST_JUMP: f64 = 0.05;

/// The key of a waveform that has a unit and an interpolation beside it.
const WITH_OPTIONS: &str = "waveform";

impl Builder<'_> {
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
        let unit = if key == WITH_OPTIONS { self.waveform_unit(section, dimension)? } else { None };
        let mut table = match table::read(&self.source.files, file, &section.key(key), dimension) {
            Ok(table) => table,
            Err(mut problems) => {
                self.problems.append(&mut problems);
                return None;
            }
        };
        if let Some(scale) = unit {
            match table.value_scale {
                // Units written in two ways differ by rounding.
                Some(named) if (named / scale - 1.0).abs() > 1e-9 => {
                    let message = "the header of the waveform names another unit";
                    self.report(
                        section,
                        "waveform_unit",
                        message,
                        "",
                        "remove this key or correct one of them",
                    );
                }
                Some(_) => {}
                None => table.value.iter_mut().for_each(|value| *value *= scale),
            }
        }
        match run.period {
            Some(period) => self.repeat(section, key, &mut table, period),
            None => self.cover(section, key, &table, run.end_time),
        }
        let interpolation = match key {
            WITH_OPTIONS => self.interpolation(section, run, table.time.len())?,
            _ => Interpolation::Linear,
        };
        let Table { time, value, .. } = table;
        Some(Waveform { file: file.clone(), time, value, period: run.period, interpolation })
    }

    /// Factor to SI units of the values of a table whose header is silent. Nothing within where the key is not given, nothing
    /// at all where it is wrong.
    fn waveform_unit(&mut self, section: &Section, dimension: Dimension) -> Option<Option<f64>> {
        let Some(text) = section.text("waveform_unit") else { return Some(None) };
        let message = match parse_unit(text) {
            Ok((scale, found)) if found == dimension => return Some(Some(scale)),
            Ok((_, found)) => format!("\"{text}\" is {}, not {}", found.name(), dimension.name()),
            Err(error) => error.to_string(),
        };
        let advice = format!("units in use: {}", dimension.units().join(", "));
        self.report(section, "waveform_unit", message, format!("a unit of {}", dimension.name()), advice);
        None
    }

    /// Interpolation of a table of so many `rows`.
    fn interpolation(&mut self, section: &Section, run: &Run, rows: usize) -> Option<Interpolation> {
        match section.word("interpolation")? {
            InterpolationKind::Linear => Some(Interpolation::Linear),
            InterpolationKind::Monotone => Some(Interpolation::Monotone),
            InterpolationKind::Fourier => {
                if run.period.is_none() {
                    let message = "needs `run.period`, after which the waveform repeats";
                    self.report(
                        section,
                        "interpolation",
                        message,
                        "",
                        "give the period or take \"monotone\"",
                    );
                    return None;
                }
                let harmonics: u32 = section.count("harmonics");
                let most = rows / 2;
                if harmonics as usize > most {
                    let message = format!("{rows} samples do not hold so many harmonics");
                    self.report(section, "harmonics", message, format!("at most {most}"), "ask for fewer");
                    return None;
                }
                Some(Interpolation::Fourier { harmonics })
            }
        }
    }

    /// Options of a waveform that is not there.
    pub(crate) fn waveform_options(&mut self, section: &Section) {
        if section.has(WITH_OPTIONS) {
            return;
        }
        for name in
            ["waveform_unit", "interpolation", "harmonics"].into_iter().filter(|name| section.has(name))
        {
            self.report(section, name, "has no meaning without a `waveform`", "", "remove it");
        }
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

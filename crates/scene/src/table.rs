//! Files of two columns, time and value.

use std::path::Path;

use vaso_units::dimension::TIME;
use vaso_units::{Dimension, parse_unit};

use crate::error::Problem;
use crate::files::Files;

/// Faults reported of one file; a file of another format has one in every line.
const MOST_PROBLEMS: usize = 5;

/// Two columns in SI units, times strictly increasing, at least two rows.
pub(crate) struct Table {
    pub(crate) time: Vec<f64>,
    pub(crate) value: Vec<f64>,
    /// Factor to SI units that the header named for the values, already applied.
    pub(crate) value_scale: Option<f64>,
}

/// Reads two columns separated by commas, semicolons, tabs or spaces. A first line that does not begin with a number is
/// a header, in which `[unit]` or `(unit)` behind a column's title, or an ending such as `_ml_s`, names the unit of the column,
/// which else is that of the SI; `#` begins a comment.
///
/// `key` is the key of the case that names the file.
pub(crate) fn read(
    files: &Files,
    file: &Path,
    key: &str,
    dimension: Dimension,
) -> Result<Table, Vec<Problem>> {
    let at = |line: Option<usize>, message: String| Problem {
        line,
        key: key.to_owned(),
        message,
        allowed: "two columns, time in s and value in SI units".into(),
        ..Problem::of_file(file.to_owned())
    };
    let text = files.read(file).map_err(|error| vec![at(None, format!("cannot be read: {error}"))])?;
    let mut table = Table { time: Vec::new(), value: Vec::new(), value_scale: None };
    let mut units = [1.0, 1.0];
    let mut header_possible = true;
    let mut problems = Vec::new();
    for (number, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let line = line.split_once('#').map_or(line, |(before, _)| before).trim();
        if line.is_empty() {
            continue;
        }
        let header = std::mem::replace(&mut header_possible, false) && cells(line)[0].parse::<f64>().is_err();
        let outcome = if header {
            header_units(line, dimension).map(|found| {
                units = found.map(|scale| scale.unwrap_or(1.0));
                table.value_scale = found[1];
            })
        } else {
            row(line, table.time.last().map(|last| last / units[0])).map(|[time, value]| {
                table.time.push(time * units[0]);
                table.value.push(value * units[1]);
            })
        };
        if let Err((message, advice)) = outcome {
            let problem = at(Some(number + 1), message);
            problems.push(Problem { seen: line.chars().take(60).collect(), advice, ..problem });
        }
        if problems.len() == MOST_PROBLEMS {
            break;
        }
    }
    if problems.is_empty() && table.time.len() < 2 {
        problems.push(at(None, format!("has {} rows, too few for a waveform", table.time.len())));
    }
    if problems.is_empty() { Ok(table) } else { Err(problems) }
}

fn cells(line: &str) -> Vec<&str> {
    if line.contains([',', ';']) {
        line.split([',', ';']).map(str::trim).collect()
    } else {
        line.split_whitespace().collect()
    }
}

/// Time and value of a row; the error is what is wrong and what to do.
fn row(line: &str, last_time: Option<f64>) -> Result<[f64; 2], (String, String)> {
    let cells = cells(line);
    let [time, value] = cells[..] else {
        return Err((format!("has {} columns", cells.len()), "keep the columns of time and value".into()));
    };
    let number = |cell: &str| match cell.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err((format!("\"{cell}\" is not finite"), "remove the row or repair the value".to_owned())),
        Err(_) => Err((format!("\"{cell}\" is not a number"), String::new())),
    };
    let (time, value) = (number(time)?, number(value)?);
    match last_time {
        Some(last) if time <= last => Err((
            format!("the time {time} does not come after {last}"),
            "sort the rows by time, each once".into(),
        )),
        _ => Ok([time, value]),
    }
}

/// Endings of titles that name a unit, as in `flow_ml_s` or `Q_ml_per_s`, longer ones before those they end in.
const ENDINGS: &[(&str, &str)] = &[
    ("cm3_s", "cm^3/s"),
    ("m3_s", "m^3/s"),
    ("ml_s", "ml/s"),
    ("ml_min", "ml/min"),
    ("l_min", "L/min"),
    ("cm_s", "cm/s"),
    ("mm_s", "mm/s"),
    ("m_s", "m/s"),
    ("mmhg", "mmHg"),
    ("kpa", "kPa"),
    ("pa", "Pa"),
];

/// The same of times. They are short, and say nothing of a value.
const TIME_ENDINGS: &[(&str, &str)] = &[("min", "min"), ("ms", "ms"), ("s", "s")];

/// The unit a title names, in brackets or by its ending.
fn unit_in<'a>(title: &'a str, endings: &[(&str, &'static str)]) -> Option<&'a str> {
    let bracketed = [('[', ']'), ('(', ')')].iter().find_map(|&(open, close)| {
        let (_, rest) = title.split_once(open)?;
        Some(rest.rsplit_once(close)?.0)
    });
    let title = title.trim().to_ascii_lowercase().replace("_per_", "_");
    let ending = |ending: &str| title.strip_suffix(ending).is_some_and(|rest| rest.ends_with('_'));
    bracketed.or_else(|| endings.iter().find(|(text, _)| ending(text)).map(|&(_, unit)| unit))
}

/// Factors to SI units of the two columns, as far as the header names them.
fn header_units(line: &str, dimension: Dimension) -> Result<[Option<f64>; 2], (String, String)> {
    let titles: Vec<&str> = if line.contains([',', ';', '\t']) {
        line.split([',', ';', '\t']).collect()
    } else if line.contains(['[', '(']) {
        line.split_inclusive([']', ')']).collect()
    } else {
        line.split_whitespace().collect()
    };
    let mut factors = [None, None];
    let columns = [(TIME, TIME_ENDINGS), (dimension, ENDINGS)];
    for ((title, (expected, endings)), factor) in titles.into_iter().zip(columns).zip(&mut factors) {
        let Some(unit) = unit_in(title, endings) else { continue };
        let (scale, found) = parse_unit(unit).map_err(|error| {
            (error.to_string(), "write a unit in the brackets, or no brackets for SI units".to_owned())
        })?;
        if found != expected {
            let message = format!("\"{unit}\" is {}, not {}", found.name(), expected.name());
            return Err((message, format!("units in use: {}", expected.units().join(", "))));
        }
        *factor = Some(scale);
    }
    Ok(factors)
}

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
}

/// Reads two columns separated by commas, semicolons, tabs or spaces. A first line that does not begin with a number is
/// a header, in which `[unit]` or `(unit)` behind a column's title says that the column is not in SI units; `#` begins
/// a comment.
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
    let mut table = Table { time: Vec::new(), value: Vec::new() };
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
            header_units(line, dimension).map(|found| units = found)
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

/// Factors to SI units of the two columns.
fn header_units(line: &str, dimension: Dimension) -> Result<[f64; 2], (String, String)> {
    let titles: Vec<&str> =
        if line.contains([',', ';', '\t']) { line.split([',', ';', '\t']).collect() } else { vec![line] };
    let mut factors = [1.0, 1.0];
    for ((title, expected), factor) in titles.into_iter().zip([TIME, dimension]).zip(&mut factors) {
        let unit = [('[', ']'), ('(', ')')].iter().find_map(|&(open, close)| {
            let (_, rest) = title.split_once(open)?;
            Some(rest.rsplit_once(close)?.0)
        });
        let Some(unit) = unit else { continue };
        let (scale, found) = parse_unit(unit).map_err(|error| {
            (error.to_string(), "write a unit in the brackets, or no brackets for SI units".to_owned())
        })?;
        if found != expected {
            let message = format!("\"{unit}\" is {}, not {}", found.name(), expected.name());
            return Err((message, format!("units in use: {}", expected.units().join(", "))));
        }
        *factor = scale;
    }
    Ok(factors)
}

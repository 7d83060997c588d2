//! Tables of numbers against time: `openings.csv`, `probes.csv`, `study.csv`.
//!
//! A row is one write of one whole line, so a killed process leaves at most a torn last line, which reading
//! passes over. Numbers are written with the digits that give the same bits back; a value that does not
//! exist (NaN) is an empty cell.

use crate::{IoError, atomic};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

/// A table that grows row by row.
#[derive(Debug)]
pub struct Table {
    path: PathBuf,
    file: File,
    columns: usize,
    rows: u64,
}

/// A table read back.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TableData {
    /// Column names.
    pub header: Vec<String>,
    /// Rows in order; NaN where a cell is empty.
    pub rows: Vec<Vec<f64>>,
}

impl TableData {
    /// The values of a column by name.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.header.iter().position(|column| column == name)?;
        Some(self.rows.iter().map(|row| row[index]).collect())
    }
}

impl Table {
    /// Starts a table with this header; an older file of the same name is replaced.
    ///
    /// # Errors
    /// [`IoError::System`] when the disk or the folder refuses.
    pub fn create(path: impl Into<PathBuf>, header: &[String]) -> Result<Self, IoError> {
        let path = path.into();
        atomic::write(&path, &line(header, &path)?)?;
        Self::open_end(path, header.len(), 0)
    }

    /// Goes on with a table: rows whose first column (the time) is later than `time` are dropped. A missing
    /// file makes a new table.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] when the header differs, otherwise as [`read_table`].
    pub fn continue_at(path: impl Into<PathBuf>, header: &[String], time: f64) -> Result<Self, IoError> {
        let path = path.into();
        if !path.exists() {
            return Self::create(path, header);
        }
        let data = read_table(&path)?;
        if data.header != header {
            let what = format!(
                "its header is \"{}\", expected \"{}\"; the case has changed since the run began",
                data.header.join(","),
                header.join(",")
            );
            return Err(IoError::Mismatch { path, what });
        }
        let mut text = line(header, &path)?;
        let mut rows = 0;
        for row in data.rows.iter().take_while(|row| row[0] <= time) {
            text.extend(row_line(row, &path)?);
            rows += 1;
        }
        atomic::write(&path, &text)?;
        Self::open_end(path, header.len(), rows)
    }

    fn open_end(path: PathBuf, columns: usize, rows: u64) -> Result<Self, IoError> {
        let file = OpenOptions::new()
            .append(true)
            .open(&path)
            .map_err(|source| IoError::system(&path, "append to", source))?;
        Ok(Self { path, file, columns, rows })
    }

    /// Number of rows.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// Forces all rows to disk.
    ///
    /// # Errors
    /// [`IoError::System`] when the disk refuses.
    pub fn sync(&self) -> Result<(), IoError> {
        self.file.sync_all().map_err(|source| IoError::system(&self.path, "write", source))
    }

    /// Adds a row; when this returns the operating system has it.
    ///
    /// # Errors
    /// [`IoError::Mismatch`] when the number of values is not that of the columns, [`IoError::System`] when
    /// the disk refuses.
    pub fn append(&mut self, row: &[f64]) -> Result<(), IoError> {
        if row.len() != self.columns {
            let what = format!("the row has {} values for {} columns", row.len(), self.columns);
            return Err(IoError::Mismatch { path: self.path.clone(), what });
        }
        let text = row_line(row, &self.path)?;
        self.file.write_all(&text).map_err(|source| IoError::system(&self.path, "append to", source))?;
        self.rows += 1;
        Ok(())
    }
}

/// Reads a table. A last line without its line end was torn by a kill and is left out.
///
/// # Errors
/// [`IoError::System`] when the file cannot be read, [`IoError::Table`] with the line at fault.
pub fn read_table(path: &Path) -> Result<TableData, IoError> {
    let mut text = std::fs::read(path).map_err(|source| IoError::system(path, "read", source))?;
    text.truncate(text.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1));
    let wrong = |line, what| IoError::Table { path: path.to_owned(), line, what };

    let mut reader = csv::ReaderBuilder::new().has_headers(true).from_reader(text.as_slice());
    let header: Vec<String> =
        reader.headers().map_err(|error| wrong(1, error.to_string()))?.iter().map(str::to_owned).collect();
    if header.is_empty() {
        return Err(wrong(1, "the header is missing".to_owned()));
    }
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record
            .map_err(|error| wrong(error.position().map_or(0, csv::Position::line), error.to_string()))?;
        let number = record.position().map_or(0, csv::Position::line);
        let row = record.iter().map(|cell| match cell {
            "" => Ok(f64::NAN),
            cell => cell.parse().map_err(|_| wrong(number, format!("\"{cell}\" is not a number"))),
        });
        rows.push(row.collect::<Result<_, _>>()?);
    }
    Ok(TableData { header, rows })
}

fn row_line(row: &[f64], path: &Path) -> Result<Vec<u8>, IoError> {
    line(&row.iter().map(|&value| cell(value)).collect::<Vec<_>>(), path)
}

fn line(cells: &[String], path: &Path) -> Result<Vec<u8>, IoError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| IoError::Mismatch { path: path.to_owned(), what: error.to_string() };
    writer.write_record(cells).map_err(failed)?;
    writer.into_inner().map_err(|error| IoError::Mismatch { path: path.to_owned(), what: error.to_string() })
}

/// Shortest digits that give the same bits back, with an exponent where plain digits would be long.
fn cell(value: f64) -> String {
    let size = value.abs();
    if value.is_nan() {
        String::new()
    } else if value == 0.0 || (1e-3..1e9).contains(&size) {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn header() -> Vec<String> {
        ["time_s", "inlet, left.flow_m3_s", "inlet, left.pressure_pa"].map(str::to_owned).to_vec()
    }

    #[test]
    fn rows_come_back_bit_for_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("openings.csv");
        let rows = [
            [0.1 + 0.2, -6.1e-6, 12_345.678_901_234_5],
            [1e-300, f64::MAX, -0.0],
            [f64::INFINITY, f64::from_bits(1), 1.0 / 3.0],
        ];
        let mut table = Table::create(&path, &header()).unwrap();
        rows.iter().for_each(|row| table.append(row).unwrap());
        table.append(&[1.0, f64::NAN, 2.0]).unwrap();

        let data = read_table(&path).unwrap();
        assert_eq!(data.header, header());
        for (read, written) in data.rows.iter().zip(&rows) {
            assert_eq!(read.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), written.map(f64::to_bits));
        }
        assert!(data.rows[3][1].is_nan());
        assert_eq!(data.column("inlet, left.flow_m3_s").unwrap()[0], -6.1e-6);
        assert!(data.column("outlet.flow_m3_s").is_none());
    }

    #[test]
    fn a_torn_last_line_is_left_out_and_written_again_when_the_run_goes_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("openings.csv");
        let mut table = Table::create(&path, &header()).unwrap();
        for step in 0..5 {
            table.append(&[f64::from(step) * 0.1, 1.0, 2.0]).unwrap();
        }
        drop(table);
        let whole = std::fs::read(&path).unwrap();
        std::fs::write(&path, &whole[..whole.len() - 3]).unwrap();
        assert_eq!(read_table(&path).unwrap().rows.len(), 4);

        let mut table = Table::continue_at(&path, &header(), 0.1).unwrap();
        assert_eq!(read_table(&path).unwrap().rows.len(), 2);
        for step in 2..5 {
            table.append(&[f64::from(step) * 0.1, 1.0, 2.0]).unwrap();
        }
        assert_eq!(std::fs::read(&path).unwrap(), whole);
    }

    #[test]
    fn faults_are_named_with_their_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("openings.csv");
        std::fs::write(&path, "time_s,a\n0,1\n0.1,zwei\n").unwrap();
        let error = read_table(&path).unwrap_err().to_string();
        assert!(error.contains("line 3") && error.contains("\"zwei\""), "{error}");
        std::fs::write(&path, "time_s,a\n0,1,2\n").unwrap();
        assert!(read_table(&path).unwrap_err().to_string().contains("line 2"));
        std::fs::write(&path, "").unwrap();
        assert!(matches!(read_table(&path), Err(IoError::Table { line: 1, .. })));

        std::fs::write(&path, "time_s,b\n").unwrap();
        let error = Table::continue_at(&path, &header(), 1.0).unwrap_err().to_string();
        assert!(error.contains("time_s,b"), "{error}");
        let mut table = Table::create(&path, &header()).unwrap();
        assert!(matches!(table.append(&[1.0]), Err(IoError::Mismatch { .. })));
    }
}

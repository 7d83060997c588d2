//! Waveforms of the shipped cases, each a short sum of harmonics.

use std::f64::consts::TAU;
use std::fmt::Write;

/// A waveform file of a case: one period at equal steps.
pub struct CaseWaveform {
    /// Path in the folder `cases`.
    pub file: &'static str,
    /// First lines of the file: what it is, and the titles of its two columns.
    title: &'static str,
    /// Period \[s\].
    period: f64,
    /// Mean, in the unit of the title.
    mean: f64,
    /// Amplitude, in the unit of the title, and phase \[deg\] of each harmonic of `cos(k w t + phase)`.
    harmonics: &'static [(f64, f64)],
}

/// Rows of a period.
const ROWS: usize = 80;

impl CaseWaveform {
    /// Value at the time `t` \[s\], in the unit of the title.
    pub fn at(&self, t: f64) -> f64 {
        let harmonic = |(k, &(amplitude, phase)): (usize, &(f64, f64))| {
            amplitude * ((k + 1) as f64 * TAU * t / self.period + phase.to_radians()).cos()
        };
        self.mean + self.harmonics.iter().enumerate().map(harmonic).sum::<f64>()
    }

    /// Period \[s\].
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Text of the file.
    pub fn text(&self) -> String {
        (0..=ROWS).fold(self.title.to_owned(), |mut text, k| {
            let t = self.period * k as f64 / ROWS as f64;
            // Never "-0.0000".
            let value = self.at(t) + 1e-9;
            writeln!(text, "{t:.5}, {value:.4}").expect("a string can be written to");
            text
        })
    }
}

/// All waveforms the cases ship.
pub fn waveforms() -> Vec<CaseWaveform> {
    vec![
        CaseWaveform {
            file: "aneurysm/inflow.csv",
            title: "# A beat in an abdominal aorta at rest, six harmonics: a systolic peak of 80 ml/s, a short backflow, 17 ml/s in the mean.\n\
                    time [s], flow [ml/s]\n",
            period: 1.0,
            mean: 17.0,
            harmonics: &[
                (20.8, -64.0),
                (21.0, -138.0),
                (13.3, 132.0),
                (5.1, 59.0),
                (2.3, 18.0),
                (1.6, -50.0),
            ],
        },
        CaseWaveform {
            file: "aorta/inflow.csv",
            title: "# A beat in an ascending aorta at rest, six harmonics: a systolic peak of 408 ml/s, 5 l/min in the mean.\n\
                    time [s], flow [ml/s]\n",
            period: 0.8,
            mean: 83.3,
            harmonics: &[
                (133.8, -75.0),
                (99.7, -152.0),
                (57.6, 128.0),
                (23.8, 48.0),
                (6.9, -14.0),
                (3.9, -62.0),
            ],
        },
        CaseWaveform {
            file: "common-carotid/inflow.csv",
            title: "# The inflow of the common carotid benchmark by its first ten harmonics, within 0.02 ml/s rms (Xiao et al. 2014,\n\
                    # Boileau et al. 2015).\ntime [s], flow [ml/s]\n",
            period: 1.1,
            mean: 6.5,
            harmonics: &[
                (3.293, -91.4),
                (1.924, -157.6),
                (1.418, 143.1),
                (0.663, 76.2),
                (0.336, 74.3),
                (0.375, 29.5),
                (0.220, -20.1),
                (0.147, -27.1),
                (0.182, -86.1),
                (0.037, -77.2),
            ],
        },
        CaseWaveform {
            file: "womersley/pressure.csv",
            title: "# 30 Pa cos(w t - 11.5 deg): the periodic flow passes through zero at the start, where the run is at rest.\n\
                    time [s], pressure [Pa]\n",
            period: 0.8,
            mean: 0.0,
            harmonics: &[(30.0, -11.51)],
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mean of equal steps over a period is exact for so few harmonics.
    #[test]
    fn tables_have_the_mean_and_the_period_of_their_harmonics() {
        for wave in waveforms() {
            let rows: Vec<(f64, f64)> = wave
                .text()
                .lines()
                .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()))
                .map(|line| line.split_once(", ").expect("two columns"))
                .map(|(t, value)| (t.parse().expect("a number"), value.parse().expect("a number")))
                .collect();
            assert_eq!(rows.len(), ROWS + 1);
            let mean = rows[1..].iter().map(|row| row.1).sum::<f64>() / ROWS as f64;
            assert!((mean - wave.mean).abs() < 1e-4, "{}: {mean}", wave.file);
            assert!((rows[ROWS].0 - wave.period()).abs() < 1e-9 && (rows[0].1 - rows[ROWS].1).abs() < 1e-9);
        }
    }
}

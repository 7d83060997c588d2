//! Values in time: constants and tables, with a smooth start.

mod fourier;
mod signal;

pub use fourier::Fourier;
pub use signal::{Signal, Source};

/// How a waveform goes from one row to the next.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interpolation {
    /// Straight lines.
    #[default]
    Linear,
    /// Cubic pieces with continuous slope that stay within the rows beside them (Fritsch and Butland 1984).
    Monotone,
    /// A mean and so many harmonics, which pass near the rows.
    Fourier {
        /// Number of harmonics, at most half the number of rows.
        harmonics: usize,
    },
}

/// Table of a quantity over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Waveform {
    time: Vec<f64>,
    value: Vec<f64>,
    period: Option<f64>,
    form: Form,
}

/// What is prepared for the interpolation.
#[derive(Clone, Debug, PartialEq)]
enum Form {
    Linear,
    /// Slope at each row.
    Cubic(Vec<f64>),
    Series(Fourier),
}

/// What lies between two rows.
#[derive(Clone, Copy, Debug)]
struct Segment {
    time: [f64; 2],
    value: [f64; 2],
    slope: [f64; 2],
}

impl Segment {
    fn at(&self, t: f64) -> f64 {
        let h = self.time[1] - self.time[0];
        let s = (t - self.time[0]) / h;
        let [v0, v1] = self.value;
        let secant = v1 - v0;
        // Hermite's cubic as the straight line and what departs from it: nothing for equal slopes.
        let [d0, d1] = self.slope.map(|m| m * h - secant);
        v0 + secant * s + s * (1.0 - s) * ((1.0 - s) * d0 - s * d1)
    }

    fn integral(&self) -> f64 {
        let h = self.time[1] - self.time[0];
        0.5 * h * (self.value[0] + self.value[1]) + h * h / 12.0 * (self.slope[0] - self.slope[1])
    }
}

/// Why a table cannot be a waveform.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WaveformError {
    /// No rows, or columns of different length.
    #[error(
        "a waveform needs at least one row with a time and a value, got {times} times and {values} values"
    )]
    Empty {
        /// Number of times.
        times: usize,
        /// Number of values.
        values: usize,
    },
    /// Times do not rise.
    #[error("times must rise: row {row} has {time} s after {before} s")]
    Unsorted {
        /// First row (from 1) that is not later than the one before.
        row: usize,
        /// Its time \[s\].
        time: f64,
        /// The time before \[s\].
        before: f64,
    },
    /// The period ends before the table does.
    #[error("the table spans {span} s, longer than the period of {period} s")]
    LongerThanPeriod {
        /// Time from first to last row \[s\].
        span: f64,
        /// Period asked for \[s\].
        period: f64,
    },
    /// A series needs a period.
    #[error("a Fourier series needs a period, and the table has none")]
    NoPeriod,
    /// More harmonics than the rows can tell apart.
    #[error("{rows} rows hold at most {most} harmonics, not {harmonics}; ask for fewer")]
    TooManyHarmonics {
        /// Harmonics asked for.
        harmonics: usize,
        /// Rows within a period.
        rows: usize,
        /// Harmonics they hold.
        most: usize,
    },
}

impl Waveform {
    /// Waveform through `time` \[s\] and `value`; with a `period` \[s\] it repeats, else it stays at
    /// its ends. A table that ends before the period is closed by a straight line to its start.
    ///
    /// # Errors
    /// See [`WaveformError`].
    pub fn new(time: Vec<f64>, value: Vec<f64>, period: Option<f64>) -> Result<Self, WaveformError> {
        if time.is_empty() || time.len() != value.len() {
            return Err(WaveformError::Empty { times: time.len(), values: value.len() });
        }
        if let Some(k) = (1..time.len()).find(|&k| time[k] <= time[k - 1] || !time[k].is_finite()) {
            return Err(WaveformError::Unsorted { row: k + 1, time: time[k], before: time[k - 1] });
        }
        let span = time[time.len() - 1] - time[0];
        if let Some(period) = period
            && span > period * (1.0 + 1e-9)
        {
            return Err(WaveformError::LongerThanPeriod { span, period });
        }
        Ok(Self { time, value, period, form: Form::Linear })
    }

    /// The same table, interpolated in another way.
    ///
    /// # Errors
    /// A series needs a period, and twice as many rows as harmonics.
    pub fn interpolated(mut self, by: Interpolation) -> Result<Self, WaveformError> {
        self.form = match by {
            Interpolation::Linear => Form::Linear,
            Interpolation::Monotone => Form::Cubic(self.monotone_slopes()),
            Interpolation::Fourier { harmonics } => {
                let rows = self.rows();
                if harmonics > rows / 2 {
                    return Err(WaveformError::TooManyHarmonics { harmonics, rows, most: rows / 2 });
                }
                let cubic = Form::Cubic(self.monotone_slopes());
                let smooth = Self { form: cubic, ..self.clone() };
                Form::Series(smooth.harmonics(harmonics)?)
            }
        };
        Ok(self)
    }

    /// The same waveform times a factor.
    pub fn scaled(&self, factor: f64) -> Self {
        let scale = |values: &[f64]| values.iter().map(|v| factor * v).collect();
        let form = match &self.form {
            Form::Linear => Form::Linear,
            Form::Cubic(slopes) => Form::Cubic(scale(slopes)),
            Form::Series(series) => Form::Series(Fourier {
                period: series.period,
                mean: factor * series.mean,
                cosine: scale(&series.cosine),
                sine: scale(&series.sine),
            }),
        };
        Self { time: self.time.clone(), value: scale(&self.value), period: self.period, form }
    }

    /// Period \[s\].
    pub fn period(&self) -> Option<f64> {
        self.period
    }

    /// Times of the rows \[s\].
    pub fn times(&self) -> &[f64] {
        &self.time
    }

    /// How far the last row is from the first one where both stand for the same moment of the cycle.
    ///
    /// A table over a whole number of periods should end as it starts; one that does not jumps once a cycle.
    pub fn closing_jump(&self) -> f64 {
        if self.rows() < self.time.len() { self.value[self.value.len() - 1] - self.value[0] } else { 0.0 }
    }

    /// Rows of one period: without the last one where it repeats the first.
    fn rows(&self) -> usize {
        let n = self.time.len();
        let repeated = self
            .period
            .is_some_and(|period| n > 1 && self.time[n - 1] - self.time[0] > period * (1.0 - 1e-9));
        n - usize::from(repeated)
    }

    /// What lies after row `k`; the last row of a period is followed by the first one of the next.
    fn segment(&self, k: usize) -> Segment {
        let next = if k + 1 < self.time.len() { k + 1 } else { 0 };
        let end = if next > 0 { self.time[next] } else { self.time[0] + self.period.unwrap_or(0.0) };
        let time = [self.time[k], end];
        let value = [self.value[k], self.value[next]];
        let secant = (value[1] - value[0]) / (time[1] - time[0]);
        let slope = match &self.form {
            Form::Cubic(slopes) => [slopes[k], slopes[next]],
            Form::Linear | Form::Series(_) => [secant; 2],
        };
        Segment { time, value, slope }
    }

    /// Number of segments: one a row for a period, else one less.
    fn segments(&self) -> usize {
        if self.period.is_some() { self.rows() } else { self.time.len() - 1 }
    }

    /// Slopes that keep the cubic between rows monotone: the harmonic mean of the secants beside a row, weighted by
    /// the lengths (Fritsch and Butland 1984, eq 5), and zero at an extremum.
    fn monotone_slopes(&self) -> Vec<f64> {
        let straight = Self { form: Form::Linear, ..self.clone() };
        let pieces: Vec<(f64, f64)> = (0..self.segments())
            .map(|k| straight.segment(k))
            .map(|s| (s.time[1] - s.time[0], s.slope[0]))
            .collect();
        let Some(&first) = pieces.first() else { return vec![0.0; self.time.len()] };
        let between = |(h0, d0): (f64, f64), (h1, d1): (f64, f64)| {
            let a = (h0 + 2.0 * h1) / (3.0 * (h0 + h1));
            if d0 * d1 > 0.0 { d0 * d1 / (a * d1 + (1.0 - a) * d0) } else { 0.0 }
        };
        let last = pieces[pieces.len() - 1];
        let ends = if self.period.is_some() { [between(last, first); 2] } else { [first.1, last.1] };
        (0..self.time.len())
            .map(|k| match k {
                0 => ends[0],
                k if k < pieces.len() => between(pieces[k - 1], pieces[k]),
                _ => ends[1],
            })
            .collect()
    }

    /// Its mean and the first so many harmonics.
    ///
    /// # Errors
    /// Without a period.
    pub fn harmonics(&self, count: usize) -> Result<Fourier, WaveformError> {
        let period = self.period.ok_or(WaveformError::NoPeriod)?;
        if let Form::Series(series) = &self.form {
            let part = |all: &[f64]| (0..count).map(|k| all.get(k).copied().unwrap_or(0.0)).collect();
            return Ok(Fourier { cosine: part(&series.cosine), sine: part(&series.sine), ..series.clone() });
        }
        let start = self.time[0];
        let rows = self.rows();
        let step = period / rows as f64;
        let even = (0..rows).all(|k| (self.time[k] - start - step * k as f64).abs() < 1e-6 * step);
        // Rows at even distances are the samples themselves, which straight lines between them would only blur.
        if even && count < rows / 2 && matches!(self.form, Form::Cubic(_)) {
            return Ok(Fourier::of_samples(&self.value[..rows], start, period, count));
        }
        let n = SAMPLES.max(8 * count);
        let samples: Vec<f64> = (0..n).map(|j| self.at(start + period * j as f64 / n as f64)).collect();
        Ok(Fourier::of_samples(&samples, start, period, count))
    }

    /// Mean over the period, or without one over the table.
    pub fn mean(&self) -> f64 {
        if let Form::Series(series) = &self.form {
            return series.mean;
        }
        let n = self.segments();
        if n == 0 {
            return self.value[0];
        }
        let (sum, span) = (0..n)
            .map(|k| self.segment(k))
            .fold((0.0, 0.0), |(sum, span), s| (sum + s.integral(), span + s.time[1] - s.time[0]));
        sum / span
    }

    /// Value at `t` \[s\].
    pub fn at(&self, t: f64) -> f64 {
        if let Form::Series(series) = &self.form {
            return series.at(t);
        }
        let n = self.time.len();
        let (first, last) = (self.time[0], self.time[n - 1]);
        let t = match self.period {
            Some(period) => first + (t - first).rem_euclid(period),
            None => t.clamp(first, last),
        };
        let next = self.time.partition_point(|&x| x <= t);
        match next {
            0 => self.value[0],
            k if k < n => self.segment(k - 1).at(t),
            _ if self.segments() == n => self.segment(n - 1).at(t),
            _ => self.value[n - 1],
        }
    }

    /// Largest magnitude it takes.
    pub fn peak(&self) -> f64 {
        let (low, high) = self.range();
        low.abs().max(high.abs())
    }

    /// Smallest and largest value it takes.
    pub fn range(&self) -> (f64, f64) {
        let bounds = |values: &mut dyn Iterator<Item = f64>| {
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)))
        };
        match &self.form {
            Form::Linear | Form::Cubic(_) => bounds(&mut self.value.iter().copied()),
            Form::Series(series) => {
                let step = series.period / SAMPLES as f64;
                bounds(&mut (0..SAMPLES).map(|j| series.at(step * j as f64)))
            }
        }
    }
}

/// Samples of a period for what has no closed form.
const SAMPLES: usize = 2048;

#[cfg(test)]
mod tests;

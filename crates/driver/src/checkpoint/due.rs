//! When the next checkpoint is due.

use std::time::{Duration, Instant};

/// Wall time between checkpoints where the case says nothing: what a kill costs at most.
const EVERY: Duration = Duration::from_secs(600);

/// Follows simulated time, or else the clock. What is computed does not depend on it.
pub struct Due {
    every: Option<f64>,
    next: f64,
    last: Instant,
}

impl Due {
    /// From `time` \[s\] on, at whole multiples of `every` \[s\] of simulated time, or every ten minutes of wall time without it.
    pub fn new(every: Option<f64>, time: f64) -> Self {
        let mut due = Self { every, next: 0.0, last: Instant::now() };
        due.pass(time);
        due
    }

    /// Whether one is due at `time` \[s\]; then the next is due an interval later.
    pub fn is_due(&mut self, time: f64) -> bool {
        let is_due = match self.every {
            Some(_) => time >= self.next,
            None => self.last.elapsed() >= EVERY,
        };
        if is_due {
            self.pass(time);
            self.last = Instant::now();
        }
        is_due
    }

    fn pass(&mut self, time: f64) {
        if let Some(every) = self.every {
            self.next = ((time / every).floor() + 1.0) * every;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Due;

    #[test]
    fn intervals_count_from_zero_and_none_is_made_up_for() {
        let mut due = Due::new(Some(0.1), 0.25);
        let seen: Vec<bool> = [0.26, 0.31, 0.32, 0.75, 0.79, 0.81].map(|t| due.is_due(t)).to_vec();
        assert_eq!(seen, [false, true, false, true, false, true]);
        assert!(!Due::new(None, 0.0).is_due(1e9), "ten minutes have not passed");
    }
}

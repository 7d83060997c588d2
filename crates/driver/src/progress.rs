//! How far a run is: a bar on a terminal, plain lines elsewhere.

use crate::print::duration;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::time::{Duration, Instant};

/// Progress of a command on standard error.
pub struct Progress {
    bar: ProgressBar,
    lines: bool,
    started: Instant,
    last_line: Instant,
    /// Share of the run and particle steps that had been done when the clock started.
    before: (f64, u64),
}

/// Time between plain lines.
const LINE_EVERY: Duration = Duration::from_secs(10);
/// Parts the bar is divided into.
const PARTS: f64 = 10_000.0;

impl Progress {
    /// Progress display, silent if asked.
    pub fn new(quiet: bool) -> Self {
        let terminal = std::io::stderr().is_terminal();
        let target = if terminal && !quiet {
            ProgressDrawTarget::stderr_with_hz(5)
        } else {
            ProgressDrawTarget::hidden()
        };
        let bar = ProgressBar::with_draw_target(Some(PARTS as u64), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:32} {percent:>3} % {msg}") {
            bar.set_style(style);
        }
        Self {
            bar,
            lines: !terminal && !quiet,
            started: Instant::now(),
            last_line: Instant::now(),
            before: (0.0, 0),
        }
    }

    /// Tells a step of the relaxation of a body.
    pub fn relaxation(&mut self, body: &str, step: usize, moved: f64) {
        let text = format!("relaxing {body}: step {step}, mean displacement {moved:.1e} spacings");
        self.bar.set_message(text.clone());
        self.line(&text);
    }

    /// Tells that the particles are there.
    pub fn relaxed(&mut self) {
        self.bar.set_message(String::new());
    }

    /// Starts the clock of the flow, of which a share and so many particle steps may have been done before.
    pub fn start(&mut self, share: f64, particle_substeps: u64) {
        self.started = Instant::now();
        self.before = (share, particle_substeps);
    }

    /// Tells the simulated time reached.
    pub fn flow(&mut self, time: f64, end: f64, particle_substeps: u64) {
        let share = time / end;
        let elapsed = self.started.elapsed().as_secs_f64();
        let (share_before, substeps_before) = self.before;
        let done = share - share_before;
        let left = if done > 0.0 { elapsed * (1.0 - share) / done } else { f64::INFINITY };
        let text = format!(
            "{time:.4} of {end} s · {:.1} M particle steps/s · {} left",
            1e-6 * (particle_substeps - substeps_before) as f64 / elapsed.max(1e-9),
            duration(left)
        );
        self.bar.set_position((share * PARTS) as u64);
        self.bar.set_message(text.clone());
        self.line(&text);
    }

    fn line(&mut self, text: &str) {
        if self.lines && self.last_line.elapsed() >= LINE_EVERY {
            eprintln!("{text}");
            self.last_line = Instant::now();
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

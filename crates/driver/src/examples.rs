//! Examples at the end of each `--help`. A test runs every line that begins with `vaso`, in a folder with `vessel.stl`, the case
//! `my-case` and its results.

pub(crate) const VASO: &str = "\
Examples:
  vaso new first-case --surface vessel.stl     A case that runs as it is
  vaso check first-case                        What will run, why, at what cost
  vaso run my-case --force                     From the case to my-case/out/report.html

Exit codes: 0 done, 1 the run broke down, 2 the input is wrong, 130 interrupted.";

pub(crate) const NEW: &str = "\
Examples:
  vaso new second-case --surface vessel.stl
  vaso new third-case --surface vessel.stl --unit mm --json

What is guessed is said, and marked in the case: the unit by the size, the inlet as the largest opening, the inflow by its area,
Windkessel outlets for 120/80 mmHg, a spacing by what some minutes allow. Nothing is written over.";

pub(crate) const CHECK: &str = "\
Examples:
  vaso check my-case
  vaso check my-case --set particles.spacing=\"0.9 mm\"
  vaso check vessel.stl --unit mm --json";

pub(crate) const PARTICLES: &str = "\
Examples:
  vaso particles my-case --force
  vaso particles vessel.stl --unit mm --spacing \"0.8 mm\" --out fluid
  vaso particles vessel.stl --unit mm --spacing \"0.8 mm\" --bodies wall --wall-thickness \"1.6 mm\" --out wall
  vaso particles vessel.stl --unit mm --spacing \"0.8 mm\" --compare relaxed-lattice,multiblock --out compared";

pub(crate) const RUN: &str = "\
Examples:
  vaso run my-case --force
  vaso run my-case --out coarse --set particles.spacing=\"1 mm\" --threads 1 --quiet
  vaso run my-case --out later --set run.end_time=\"3 ms\" --json";

pub(crate) const RESUME: &str = "\
Examples:
  vaso resume my-case/out
  vaso resume my-case/out --threads 1 --quiet

A run that is finished stays as it is.";

pub(crate) const STUDY: &str = "\
Examples:
  vaso study my-case
  vaso study my-case --out spacings --ladders spacing --spacings \"1.2 mm,0.9 mm\"
  vaso study my-case --out smoothing --ladders spacing --vary \"numerics.smoothing_length=1.2|1.4\"
  vaso study my-case --out finest --budget \"20 s\"

Errors are counted from expect.toml beside the case where there is one, else from what the finest runs converge to. Runs that break
down are findings, too.";

pub(crate) const TUNE: &str = "\
Examples:
  vaso tune pulsing-case --systolic \"120 mmHg\" --diastolic \"80 mmHg\"
  vaso tune pulsing-case --systolic \"16 kPa\" --diastolic \"10 kPa\" --distal \"5 mmHg\" --split area

The tables printed take the place of the outlets in the case. The inflow has to pulse: a waveform with run.period.";

pub(crate) const REPORT: &str = "\
Examples:
  vaso report my-case/out
  vaso report my-case/out --against coarse     Beside another run: what a wall takes off the pulse";

pub(crate) const SCHEMA: &str = "\
Examples:
  vaso schema > case.schema.json

The first line of a case.toml beside it, `#:schema ./case.schema.json`, makes editors complete it; `vaso new` writes both.";

pub(crate) const COMPLETIONS: &str = "\
Examples:
  vaso completions bash > vaso.bash
  vaso completions zsh > _vaso
  vaso completions fish > vaso.fish

They take effect where the shell looks for completions, such as ~/.local/share/bash-completion/completions/vaso.";

pub(crate) const MAN: &str = "\
Examples:
  vaso man man1";

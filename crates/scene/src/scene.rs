//! The validated case: data only, in SI units.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::document::Source;
use crate::error::{Problem, SceneError};
use crate::files::Files;
use crate::material::{Blood, Wall, WallBody};
use crate::opening::Opening;
use crate::words::words;

/// A whole case, checked: what is inconsistent or out of range never becomes a `Scene`.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The `case.toml` it was read from.
    pub file: PathBuf,
    /// The folder relative paths of the case start from.
    pub directory: PathBuf,
    /// `case.title`; the name of the folder where none is given.
    pub title: String,
    /// The vessel surface.
    pub geometry: Geometry,
    /// How particles are made.
    pub particles: Particles,
    /// The fluid; `None` for a wall alone under its own pressure load.
    pub blood: Option<Blood>,
    /// The vessel wall.
    pub wall: Wall,
    /// How it is made of particles.
    pub wall_body: WallBody,
    /// Conditions at the openings in the order of the file. Empty until the openings have been looked at with
    /// `vaso check`; a run with blood needs one for each opening of the surface.
    pub openings: Vec<Opening>,
    /// Points whose values are recorded.
    pub probes: Vec<Probe>,
    /// Choices of the numerical method.
    pub numerics: Numerics,
    /// How long to simulate.
    pub run: Run,
    /// What to write and how often.
    pub output: Output,
    /// Every key that was written, with its place and value as a problem without a message.
    pub(crate) written: BTreeMap<String, Problem>,
}

impl Scene {
    /// Reads and checks a case.
    ///
    /// `path` is a case folder or the path of its `case.toml`. Each override is a dotted key and a value, as given to
    /// `--set key=value`: the value is taken as TOML where it is TOML and as a string otherwise, and an element of
    /// `[[opening]]` or `[[probe]]` is addressed by its name or by its number from 0.
    ///
    /// # Errors
    /// [`SceneError`] with every problem found: in the file, in the overrides and in the waveform tables.
    pub fn load(path: &Path, overrides: &[(String, String)]) -> Result<Self, SceneError> {
        crate::check::load(path, overrides)
    }

    /// Reads and checks the text of a case without touching the file system.
    ///
    /// `files` are the files the case may name, by their path from its folder: the vessel surface, whose content does
    /// not matter here, and the tables of waveforms. Overrides are those of [`load`](Self::load).
    ///
    /// # Errors
    /// As [`load`](Self::load); the case is called `case.toml` in them.
    pub fn parse(
        text: &str,
        overrides: &[(String, String)],
        files: &BTreeMap<PathBuf, String>,
    ) -> Result<Self, SceneError> {
        let files = Files::Given(files.clone());
        crate::check::scene(Source::new("case.toml".into(), text.to_owned(), overrides.to_vec(), files))
    }

    /// A scene of a bare surface, to be filled with particles: its walls are rigid, nothing is said about its openings
    /// and all else comes from the overrides, `particles.spacing` at least.
    ///
    /// # Errors
    /// As for [`Self::load`].
    pub fn of_surface(surface: &Path, overrides: &[(String, String)]) -> Result<Self, SceneError> {
        crate::check::of_surface(surface, overrides)
    }

    /// A problem with a key that shows only after loading, such as an opening the surface does not have; it names the
    /// place like every other problem. For a key that was not written, the place is that of its table.
    pub fn problem(&self, key: &str, message: impl Into<String>) -> Problem {
        let written = self.written.get(key).cloned();
        let place = written.or_else(|| {
            let table = self.written.get(key.rsplit_once('.')?.0)?;
            Some(Problem { seen: String::new(), ..table.clone() })
        });
        let place = place.unwrap_or_else(|| Problem::of_file(self.file.clone()));
        Problem { key: key.to_owned(), message: message.into(), ..place }
    }
}

/// The vessel surface and the unit of its coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// The surface file, an existing path.
    pub surface: PathBuf,
    /// Unit of its coordinates: `"m"`, `"cm"`, `"mm"` or `"um"`; `None` leaves it to be guessed from the size.
    pub unit: Option<String>,
}

/// How the surface is filled with particles.
#[derive(Debug, Clone, PartialEq)]
pub struct Particles {
    /// Distance between neighbouring particles \[m\].
    pub spacing: f64,
    /// Where they are placed first.
    pub generator: Generator,
    /// Sweeps of elliptic smoothing of the sections of blocks.
    pub smoothing_sweeps: usize,
    /// Relaxation steps after placing.
    pub relaxation_steps: u32,
}

/// How particles are placed before they are relaxed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Generator {
    /// A lattice cut by the surface.
    RelaxedLattice(
        /// The lattice it starts from.
        Lattice,
    ),
    /// Blocks of transfinite interpolation along the vessel.
    Multiblock(
        /// How a cross-section is divided.
        Topology,
    ),
}

words! {
    /// The lattice particles start from.
    pub enum Lattice {
        /// Simple cubic.
        Cubic = "cubic",
        /// Body-centred cubic.
        BodyCentred = "bcc",
    }
}

words! {
    /// How a multiblock cross-section is divided.
    pub enum Topology {
        /// One block over the whole section.
        Single = "single",
        /// A core block with eight around it.
        NineBlock = "nine-block",
        /// A core block inside a ring.
        OGrid = "o-grid",
    }
}

/// A point whose values are recorded.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// Its name in `probes.csv`, unique in the case.
    pub name: String,
    /// Where it is, in the unit of the surface.
    pub at: [f64; 3],
}

/// Choices of the numerical method; `None` leaves the choice to the planner.
#[derive(Debug, Clone, PartialEq)]
pub struct Numerics {
    /// Arithmetic of the pair loops.
    pub precision: Precision,
    /// Numerical sound speed \[m/s\]; `None` chooses it from the expected velocity and pressure.
    pub sound_speed: Option<f64>,
    /// Least ratio of the chosen sound speed to the expected largest velocity.
    pub sound_speed_factor: f64,
    /// Share of the summed density mixed in at every advective step, from 0 to 1; `None` chooses it from the
    /// resolution.
    pub density_blend: Option<f64>,
    /// Kernel gradients are corrected where a kernel lacks neighbours or finds them uneven.
    pub gradient_correction: bool,
    /// Particles are moved apart beside their flow, so that they stay evenly spread.
    pub transport_velocity: bool,
    /// The mean density of a vessel at rest follows the mass in it instead of the kernel sum.
    pub hold_mass: bool,
    /// Smoothing length in spacings; the support radius is twice this.
    pub smoothing_length: f64,
    /// Seed of everything random.
    pub seed: u64,
    /// Pressure subtracted in the equation of state \[Pa\], gauge; `None` follows the outlets for rigid walls.
    pub reference_pressure: Option<f64>,
    /// Go on when the velocity comes too near to the numerical sound speed.
    pub allow_mach: bool,
}

words! {
    /// Arithmetic of the pair loops; the state is always double.
    pub enum Precision {
        /// Pair terms in single precision.
        Mixed = "mixed",
        /// Everything in double precision, the reference.
        Double = "double",
    }
}

/// How long to simulate.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Simulated time at the end \[s\]; cycles times period where cycles were asked for.
    pub end_time: f64,
    /// Heart period \[s\], where one was given.
    pub period: Option<f64>,
    /// Number of heart cycles, where cycles were asked for.
    pub cycles: Option<u32>,
    /// End early once the flow of every opening changes by less than this share (from one cycle to the next where
    /// there is a period).
    pub steady: Option<f64>,
    /// End early once two successive cycles differ by no more than this share in flow and pressure of every opening, and by no
    /// more than twice it in the time-averaged wall shear stress. With it `cycles` are the most there will be.
    pub periodicity: Option<f64>,
}

impl Run {
    /// Whether so many whole cycles fit into it.
    pub(crate) fn holds_cycles(&self, count: u32) -> bool {
        // Times that could not be read are NaN and have been reported.
        let end = f64::from(count) * self.period.unwrap_or(f64::NAN) * (1.0 - 1e-9);
        self.end_time.is_nan() || end.is_nan() || self.end_time >= end
    }
}

/// What to write and how often; intervals are in simulated time.
#[derive(Debug, Clone, PartialEq)]
pub struct Output {
    /// Interval of the particle series \[s\].
    pub every: f64,
    /// Interval of `openings.csv` and `probes.csv` \[s\].
    pub table_every: f64,
    /// Fields of the particle series, sorted, none twice.
    pub fields: Vec<Field>,
    /// Interval of checkpoints \[s\]; `None` leaves it to the driver. What is computed does not depend on it.
    pub checkpoint_every: Option<f64>,
    /// Pairs of different openings, proximal and distal by name, whose pressure drop and fractional flow reserve over each
    /// cycle are told.
    pub fractional_flow_reserve: Vec<[String; 2]>,
}

impl Field {
    /// True for fields that exist only at the end of a cycle.
    pub fn is_of_a_cycle(self) -> bool {
        matches!(self, Self::Tawss | Self::Osi | Self::Rrt | Self::Ecap | Self::TransverseWss | Self::PeakWss)
    }
}

words! {
    /// A field of the output series.
    pub enum Field {
        /// Fluid velocity \[m/s\].
        Velocity = "velocity",
        /// Gauge pressure \[Pa\].
        Pressure = "pressure",
        /// Fluid density \[kg/m^3\].
        Density = "density",
        /// Displacement of the wall \[m\].
        Displacement = "displacement",
        /// Von Mises stress of the wall \[Pa\].
        VonMises = "von_mises",
        /// Wall shear stress \[Pa\].
        Wss = "wss",
        /// Time average of the magnitude of the wall shear stress over a cycle \[Pa\].
        Tawss = "tawss",
        /// Oscillatory shear index over a cycle, from 0 to 0.5.
        Osi = "osi",
        /// Relative residence time over a cycle \[1/Pa\].
        Rrt = "rrt",
        /// Endothelial cell activation potential over a cycle \[1/Pa\].
        Ecap = "ecap",
        /// Time average over a cycle of the wall shear stress across its mean direction \[Pa\].
        TransverseWss = "transverse_wss",
        /// Largest magnitude of the wall shear stress in a cycle \[Pa\].
        PeakWss = "peak_wss",
    }
}

//! What a run writes: particle series, table of the openings, probes and the summary.

use crate::case::Case;
use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::flow::Flow;
use crate::ledger::Stage;
use crate::observe::Observers;
use crate::plan::Plan;
use crate::study::identity::identity;
use frames::interpolate;
use glam::DVec3;
use std::path::PathBuf;
use vaso_coupling::MovingWall;
use vaso_fluid::Real;
use vaso_io::{
    EndReason, IoError, OutputDir, SeriesWriter, SurfaceField, SurfaceMesh, SurfaceSeriesWriter, Table,
};
use vaso_particles::{Memory, WallView};

mod account;
mod frames;
mod no_wall;
mod shell;
mod solid;
mod standing;
mod summary;
mod wall;

pub use frames::append_frame;
use wall::WallFile;
pub use wall::{ShearColumns, ShearFields};

pub use standing::Standing;
pub use summary::{numbers, opening_entry, surface_report};

/// Mean of each opening over a time.
#[derive(Clone, Debug, Default)]
struct Means {
    time: f64,
    flow: Vec<f64>,
    pressure: Vec<f64>,
}

impl Means {
    fn new(n: usize) -> Self {
        Self { time: 0.0, flow: vec![0.0; n], pressure: vec![0.0; n] }
    }

    fn add<R: Real, W: MovingWall>(&mut self, flow: &Flow<R, W>, dt: f64) {
        self.time += dt;
        for (k, reading) in flow.readings.iter().enumerate() {
            self.flow[k] += dt * reading.flow;
            self.pressure[k] += dt * reading.pressure;
        }
    }

    fn mean(&self, sum: f64) -> f64 {
        if self.time > 0.0 { sum / self.time } else { 0.0 }
    }

    fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { time, flow, pressure } = self;
        memory.fields(&format!("{name}.time_s"), &mut [time]);
        memory.fixed_numbers(&format!("{name}.flow"), flow);
        memory.fixed_numbers(&format!("{name}.pressure"), pressure);
    }
}

/// A series of particles: a new one, or that at `path` with its frames up to the time `kept` \[s\].
fn open(path: PathBuf, kept: Option<f64>) -> Result<SeriesWriter, IoError> {
    match kept {
        None => Ok(SeriesWriter::create(path)),
        Some(time) => SeriesWriter::continue_at(path, time),
    }
}

/// The same of a surface.
fn open_surface(
    path: PathBuf,
    mesh: SurfaceMesh<'_>,
    fields: &[SurfaceField<'_>],
    kept: Option<f64>,
) -> Result<SurfaceSeriesWriter, IoError> {
    match kept {
        None => SurfaceSeriesWriter::create(path, mesh, fields),
        Some(time) => SurfaceSeriesWriter::continue_at(path, mesh, fields, time),
    }
}

/// The same of a table, which is cut at the time of the checkpoint.
fn open_table(path: PathBuf, header: &[String], kept: Option<f64>) -> Result<Table, IoError> {
    match kept {
        None => Table::create(path, header),
        Some(time) => Table::continue_at(path, header, time),
    }
}

/// Open result files of a run, `F` that of a wall that deforms.
pub struct Results<F> {
    folder: std::path::PathBuf,
    fluid: SeriesWriter,
    wall: Option<WallFile>,
    /// The same in the series of a wall that deforms, where that is of triangles.
    shear: Option<ShearFields>,
    /// Series of a wall that deforms.
    deforming: Option<F>,
    table: Table,
    probes: Option<Table>,
    next_frame: f64,
    next_row: f64,
    interval: Means,
    /// Second half of the run: what the summary calls mean.
    late: Means,
    late_start: Option<(f64, Vec<f64>)>,
    last_time: f64,
    /// What the case says, taken at the start: the file may be edited while a run goes on.
    identity: Vec<[String; 2]>,
    /// What is read off the flow.
    pub observers: Observers,
}

impl<F> Results<F> {
    /// Opens the files in `out`: new ones, or those of a run that goes on from where they stood, and then [`Self::remember`] reads the
    /// rest.
    ///
    /// # Errors
    /// When the folder cannot be written.
    pub fn create<R: Real, W: Deforming<File = F>>(
        out: &OutputDir,
        case: &Case,
        plan: &Plan,
        flow: &Flow<R, W>,
        from: Option<&Standing>,
    ) -> Result<Self, DriverError> {
        let (kept_rows, kept) = (from.map(|s| s.time), from.map(Standing::kept_frames));
        let mut header = vec!["time_s".to_owned()];
        for o in &plan.openings {
            header.push(format!("{}.flow_m3_s", o.name));
            header.push(format!("{}.pressure_pa", o.name));
        }
        let table = open_table(out.file("openings.csv"), &header, kept_rows)?;
        let probes = if case.scene.probes.is_empty() {
            None
        } else {
            let mut header = vec!["time_s".to_owned()];
            for p in &case.scene.probes {
                header.extend(["pressure_pa", "u_m_s", "v_m_s", "w_m_s"].map(|q| format!("{}.{q}", p.name)));
            }
            Some(open_table(out.file("probes.csv"), &header, kept_rows)?)
        };
        let n = plan.openings.len();
        let rest = flow.wall.as_ref().zip(flow.fluid.wall_origin());
        let rest = rest.map(|(wall, position)| WallView { position, ..wall.view() });
        let observers = Observers::new(case, plan, rest.as_ref())?;
        let fields = &case.scene.output.fields;
        let is_shared = flow.wall.is_some() && W::HAS_TRIANGLES;
        let shear = observers.wall.as_ref().filter(|_| is_shared).map(|_| ShearFields::new(fields));
        let own = observers.wall.as_ref().filter(|_| !is_shared);
        let own_file = out.file(if flow.wall.is_some() { "lumen.vtkhdf" } else { "wall.vtkhdf" });
        let wall =
            own.map(|w| WallFile::create(own_file, w, fields, flow.wall.is_some(), kept)).transpose()?;
        let deforming =
            flow.wall.as_ref().map(|w| w.wall.create(out.file("wall.vtkhdf"), case, shear.as_ref(), kept));
        Ok(Self {
            wall,
            deforming: deforming.transpose()?,
            shear,
            folder: out.path().to_owned(),
            fluid: open(out.file("fluid.vtkhdf"), kept)?,
            table,
            probes,
            next_frame: 0.0,
            next_row: case.scene.output.table_every,
            interval: Means::new(n),
            late: Means::new(n),
            late_start: None,
            last_time: 0.0,
            identity: identity(case),
            observers,
        })
    }

    /// Shows all that has been summed so far, and what is due when.
    pub fn remember(&mut self, memory: &mut dyn Memory) {
        let Self {
            folder: _,
            // Where these stand is told by `standing`.
            fluid: _,
            wall,
            shear,
            deforming: _,
            table: _,
            probes: _,
            next_frame,
            next_row,
            interval,
            late,
            late_start,
            last_time,
            // Of the case, which a run that goes on has found unchanged.
            identity: _,
            observers,
        } = self;
        if let Some(shear) = wall.as_mut().map(|wall| &mut wall.shear).or(shear.as_mut()) {
            shear.remember(memory);
        }
        memory.fields("output.next_s", &mut [next_frame, next_row, last_time]);
        interval.remember("output.interval", memory);
        late.remember("output.late", memory);
        let (mut time, mut volumes) = late_start.take().map_or((None, Vec::new()), |(t, v)| (Some(t), v));
        memory.optional("output.late_start_s", &mut time);
        memory.numbers("output.late_start_m3", &mut volumes);
        *late_start = time.map(|time| (time, volumes));
        observers.remember(memory);
    }

    /// Where the files stand at `time` \[s\], before a frame that stands for an interruption.
    pub fn standing(&self, time: f64) -> Standing {
        Standing {
            time,
            frames: self.fluid.len() as u64,
            last_frame: self.fluid.last_time(),
            rows: self.table.rows(),
        }
    }

    /// Forces all rows of the tables to disk; frames are there once they are written.
    ///
    /// # Errors
    /// When the disk refuses.
    pub fn sync(&self) -> Result<(), IoError> {
        self.table.sync()?;
        self.probes.as_ref().map_or(Ok(()), Table::sync)
    }

    /// Time of the last frame of the blood \[s\], if there is one.
    pub(crate) fn last_frame(&self) -> Option<f64> {
        self.fluid.last_time()
    }

    /// The output folder.
    pub fn folder(&self) -> &std::path::Path {
        &self.folder
    }

    /// Takes the state after a step: adds to means, writes rows and frames that are due. Tells why the run may end now, if it may.
    ///
    /// # Errors
    /// When a file cannot be written.
    pub fn after_step<R: Real, W: Deforming<File = F>>(
        &mut self,
        flow: &mut Flow<R, W>,
        case: &Case,
        plan: &Plan,
    ) -> Result<Option<(EndReason, String)>, DriverError> {
        let settled = self.observers.after_step(flow)?;
        let dt = flow.time - self.last_time;
        self.last_time = flow.time;
        self.interval.add(flow, dt);
        if flow.time > 0.5 * plan.end_time {
            self.late_start.get_or_insert_with(|| (flow.time, outflows(flow)));
            self.late.add(flow, dt);
        }
        let start = std::time::Instant::now();
        if flow.time >= self.next_row {
            self.write_row(flow, case)?;
            while self.next_row <= flow.time {
                self.next_row += case.scene.output.table_every;
            }
        }
        // The last frame is written once what is summed over cycles has come to its end.
        let is_last = settled.is_some() || flow.time >= plan.end_time;
        if flow.time >= self.next_frame && !is_last {
            self.write_frame(flow, case)?;
            while self.next_frame <= flow.time {
                self.next_frame += case.scene.output.every;
            }
        }
        flow.ledger.add(Stage::Output, start.elapsed());
        Ok(settled)
    }

    fn write_row<R: Real, W: MovingWall>(
        &mut self,
        flow: &Flow<R, W>,
        case: &Case,
    ) -> Result<(), DriverError> {
        let mut row = vec![flow.time];
        for k in 0..self.interval.flow.len() {
            row.push(self.interval.mean(self.interval.flow[k]));
            row.push(self.interval.mean(self.interval.pressure[k]));
        }
        self.table.append(&row)?;
        self.interval = Means::new(self.interval.flow.len());
        if let Some(probes) = &mut self.probes {
            let mut row = vec![flow.time];
            for probe in &case.scene.probes {
                let at = DVec3::from_array(probe.at) * case.vessel.unit.metres();
                let (pressure, v) = interpolate(flow, at);
                row.extend([pressure, v.x, v.y, v.z]);
            }
            probes.append(&row)?;
        }
        Ok(())
    }

    /// Ends what is summed over cycles, and writes the last frame.
    ///
    /// # Errors
    /// As [`Self::after_step`].
    pub fn finish<R: Real, W: Deforming<File = F>>(
        &mut self,
        flow: &Flow<R, W>,
        case: &Case,
    ) -> Result<(), DriverError> {
        self.observers.finish(flow)?;
        self.write_frame(flow, case)
    }

    /// Writes a frame of the fluid and of the wall, unless this time has one.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_frame<R: Real, W: Deforming<File = F>>(
        &mut self,
        flow: &Flow<R, W>,
        case: &Case,
    ) -> Result<(), DriverError> {
        let pose = self.observers.wall.as_ref().and_then(|wall| wall.pose(flow)).map(|(_, pose)| pose);
        if let (Some(file), Some(wall)) = (&mut self.wall, &self.observers.wall) {
            file.append(flow.time, wall, pose.as_ref())?;
        }
        if self.fluid.last_time() == Some(flow.time) {
            return Ok(());
        }
        if let (Some(file), Some(wall)) = (&mut self.deforming, &flow.wall) {
            let told = self.shear.as_mut().zip(self.observers.wall.as_ref());
            let shear = told.map(|(shear, observed)| shear.take(observed, pose.as_ref()));
            W::append(wall, file, flow.time, &case.scene.output.fields, shear.as_ref())?;
        }
        Ok(append_frame(&mut self.fluid, flow, &case.scene.output.fields)?)
    }
}

fn outflows<R: Real, W: MovingWall>(flow: &Flow<R, W>) -> Vec<f64> {
    flow.openings.ports().iter().map(|p| p.counters.outflow_volume).collect()
}

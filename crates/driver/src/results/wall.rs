//! `wall.vtkhdf`: wall shear stress and its indices on the vessel surface.

use crate::error::DriverError;
use crate::observe::WallObserver;
use crate::results::open_surface;
use glam::DVec3;
use std::path::PathBuf;
use vaso_io::{SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter, schema};
use vaso_metrics::{Definition, SHEAR_DEFINITIONS, STRESS_DEFINITION, ShearCycle};
use vaso_particles::Memory;
use vaso_scene::Field;

/// The series of the wall.
pub(super) struct WallFile {
    series: SurfaceSeriesWriter,
    has_stress: bool,
    /// Which of the indices of a cycle are asked for.
    indices: Vec<usize>,
    /// Number of the last cycle written.
    written: Option<u64>,
}

/// What the normals in the file are.
const NORMAL: Definition =
    Definition { name: schema::NORMAL, unit: "", formula: "unit normal out of the lumen", source: "" };

impl WallFile {
    /// Starts the file with what `fields` asks for, or goes on with the frames up to the time `kept` \[s\].
    ///
    /// # Errors
    /// When it cannot be declared, or what is there is not such a series.
    pub(super) fn create(
        path: PathBuf,
        wall: &WallObserver,
        fields: &[Field],
        kept: Option<f64>,
    ) -> Result<Self, DriverError> {
        let indices: Vec<usize> = fields.iter().filter_map(|f| index(*f)).collect();
        let has_stress = fields.contains(&Field::Wss);
        let vector = |definition| declared(definition, 3);
        let mut declared_fields = vec![vector(&NORMAL)];
        declared_fields.extend(has_stress.then(|| vector(&STRESS_DEFINITION)));
        declared_fields.extend(indices.iter().map(|&k| declared(&SHEAR_DEFINITIONS[k], 1)));
        let mesh = SurfaceMesh { points: &wall.mesh.position, triangles: &wall.mesh.triangles };
        let series = open_surface(path, mesh, &declared_fields, kept)?;
        Ok(Self { series, has_stress, indices, written: None })
    }

    pub(super) fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { series: _, has_stress: _, indices: _, written } = self;
        let mut numbers: Vec<u64> = written.iter().copied().collect();
        memory.integers("output.written_cycle", &mut numbers);
        *written = numbers.first().copied();
    }

    /// Appends a frame, unless this time has one.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(super) fn append(&mut self, time: f64, wall: &WallObserver) -> Result<(), DriverError> {
        if self.series.last_time() == Some(time) {
            return Ok(());
        }
        let mut frame = SurfaceFrame { time, ..SurfaceFrame::default() };
        if self.series.is_empty() {
            frame.vectors.push((NORMAL.name, &wall.mesh.normal));
        }
        let stress: Option<Vec<DVec3>> = wall
            .stress
            .as_ref()
            .filter(|_| self.has_stress)
            .map(|stress| stress.iter().map(|s| s.unwrap_or(DVec3::NAN)).collect());
        frame.vectors.extend(stress.as_deref().map(|s| (STRESS_DEFINITION.name, s)));
        let fresh = wall.cycle.as_ref().filter(|cycle| self.written != Some(cycle.number));
        let values = fresh.map(ShearCycle::fields);
        if let Some(values) = &values {
            let chosen = self.indices.iter().map(|&k| (SHEAR_DEFINITIONS[k].name, values[k].as_slice()));
            frame.scalars.extend(chosen);
        }
        self.series.append(&frame)?;
        self.written = fresh.map(|cycle| cycle.number).or(self.written);
        Ok(())
    }
}

fn declared(definition: &Definition, components: usize) -> SurfaceField<'static> {
    SurfaceField {
        name: definition.name,
        components,
        unit: definition.unit,
        definition: definition.formula,
        citation: definition.source,
    }
}

/// Place of a field among the indices of a cycle.
fn index(field: Field) -> Option<usize> {
    let name = match field {
        Field::Tawss => "TAWSS",
        Field::Osi => "OSI",
        Field::Rrt => "RRT",
        Field::Ecap => "ECAP",
        Field::TransverseWss => "TransverseWSS",
        Field::PeakWss => "PeakWSS",
        _ => return None,
    };
    SHEAR_DEFINITIONS.iter().position(|d| d.name == name)
}

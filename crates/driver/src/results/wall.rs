//! Wall shear stress and its indices on the vessel surface: `wall.vtkhdf`, and `lumen.vtkhdf` where the former has the particles of a solid.

use crate::error::DriverError;
use crate::observe::WallObserver;
use crate::results::open_surface;
use glam::DVec3;
use std::path::PathBuf;
use vaso_io::{SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter, schema};
use vaso_metrics::{Definition, SHEAR_DEFINITIONS, STRESS_DEFINITION, ShearCycle, WallPose};
use vaso_particles::Memory;
use vaso_scene::Field;

/// Which fields of the stress of the blood a series of triangles has.
pub struct ShearFields {
    has_stress: bool,
    /// Which of the indices of a cycle are asked for.
    indices: Vec<usize>,
    /// Number of the last cycle written.
    written: Option<u64>,
}

/// What a frame has of them.
pub struct ShearColumns {
    stress: Option<Vec<DVec3>>,
    indices: Vec<(&'static str, Vec<f64>)>,
}

impl ShearFields {
    pub(super) fn new(fields: &[Field]) -> Self {
        Self {
            has_stress: fields.contains(&Field::Wss),
            indices: fields.iter().filter_map(|f| index(*f)).collect(),
            written: None,
        }
    }

    /// What the file is to say of them.
    pub(super) fn declared(&self) -> impl Iterator<Item = SurfaceField<'static>> {
        let stress = self.has_stress.then(|| declared(&STRESS_DEFINITION, 3));
        stress.into_iter().chain(self.indices.iter().map(|&k| declared(&SHEAR_DEFINITIONS[k], 1)))
    }

    /// The next frame: the stress of the last window, turned as a wall that deforms stands in `pose`, and the indices of a cycle that has
    /// ended since the frame before.
    pub(super) fn take(&mut self, wall: &WallObserver, pose: Option<&WallPose>) -> ShearColumns {
        let stress = wall.stress.as_ref().filter(|_| self.has_stress).map(|stress| {
            let mut told: Vec<DVec3> = stress.iter().map(|s| s.unwrap_or(DVec3::NAN)).collect();
            if let Some(pose) = pose {
                told.iter_mut().zip(&pose.rotation).for_each(|(stress, turn)| *stress = *turn * *stress);
            }
            told
        });
        let fresh = wall.cycle.as_ref().filter(|cycle| self.written != Some(cycle.number));
        self.written = fresh.map(|cycle| cycle.number).or(self.written);
        let indices = fresh.map(ShearCycle::fields).map_or_else(Vec::new, |values| {
            self.indices.iter().map(|&k| (SHEAR_DEFINITIONS[k].name, values[k].clone())).collect()
        });
        ShearColumns { stress, indices }
    }

    pub(super) fn remember(&mut self, memory: &mut dyn Memory) {
        let Self { has_stress: _, indices: _, written } = self;
        let mut numbers: Vec<u64> = written.iter().copied().collect();
        memory.integers("output.written_cycle", &mut numbers);
        *written = numbers.first().copied();
    }
}

impl ShearColumns {
    /// Puts them into a frame.
    pub(super) fn put<'a>(&'a self, frame: &mut SurfaceFrame<'a>) {
        frame.vectors.extend(self.stress.as_deref().map(|s| (STRESS_DEFINITION.name, s)));
        frame.scalars.extend(self.indices.iter().map(|(name, values)| (*name, values.as_slice())));
    }
}

/// A series of the surface for nothing but the stress of the blood.
pub(super) struct WallFile {
    series: SurfaceSeriesWriter,
    pub(super) shear: ShearFields,
    has_displacement: bool,
}

/// What the normals in the file are.
const NORMAL: Definition =
    Definition { name: schema::NORMAL, unit: "", formula: "unit normal out of the lumen", source: "" };
/// The same where the wall deforms.
const REST_NORMAL: Definition = Definition { formula: "unit normal out of the lumen, at rest", ..NORMAL };
/// Displacement of the surface.
const DISPLACEMENT: Definition =
    Definition { name: schema::DISPLACEMENT, unit: "m", formula: "of the face of the lumen", source: "" };

impl WallFile {
    /// Starts the file with what `fields` asks for, or goes on with the frames up to the time `kept` \[s\]. The surface may move.
    ///
    /// # Errors
    /// When it cannot be declared, or what is there is not such a series.
    pub(super) fn create(
        path: PathBuf,
        wall: &WallObserver,
        fields: &[Field],
        moves: bool,
        kept: Option<f64>,
    ) -> Result<Self, DriverError> {
        let shear = ShearFields::new(fields);
        let has_displacement = moves && fields.contains(&Field::Displacement);
        let mut all = vec![declared(if moves { &REST_NORMAL } else { &NORMAL }, 3)];
        all.extend(has_displacement.then(|| declared(&DISPLACEMENT, 3)));
        all.extend(shear.declared());
        let mesh = SurfaceMesh { points: &wall.mesh.position, triangles: &wall.mesh.triangles };
        let series = open_surface(path, mesh, &all, kept)?;
        Ok(Self { series, shear, has_displacement })
    }

    /// Appends a frame, unless this time has one; `pose` is where a wall that deforms stands.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(super) fn append(
        &mut self,
        time: f64,
        wall: &WallObserver,
        pose: Option<&WallPose>,
    ) -> Result<(), DriverError> {
        if self.series.last_time() == Some(time) {
            return Ok(());
        }
        let points = pose.map(|pose| pose.position.as_slice());
        let mut frame = SurfaceFrame { time, points, ..SurfaceFrame::default() };
        if self.series.is_empty() {
            frame.vectors.push((NORMAL.name, &wall.mesh.normal));
        }
        let displacement: Option<Vec<DVec3>> = points
            .filter(|_| self.has_displacement)
            .map(|points| points.iter().zip(&wall.mesh.position).map(|(x, rest)| *x - *rest).collect());
        frame.vectors.extend(displacement.as_deref().map(|u| (DISPLACEMENT.name, u)));
        let columns = self.shear.take(wall, pose);
        columns.put(&mut frame);
        Ok(self.series.append(&frame)?)
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

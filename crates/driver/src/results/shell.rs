//! `wall.vtkhdf` of a shell: the surface of the lumen as triangles, with the fields of the particles near each point.

use crate::case::Case;
use crate::deforming::Deforming;
use crate::error::DriverError;
use crate::plan::Plan;
use crate::results::{ShearColumns, ShearFields, open_surface};
use crate::world::WallParticles;
use glam::DVec3;
use rayon::prelude::*;
use std::path::PathBuf;
use vaso_coupling::{Coupling, ShellWall};
use vaso_fluid::Real;
use vaso_io::{ShellSummary, Summary, SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter, schema};
use vaso_kernels::{CellGrid, Wendland};
use vaso_metrics::WallMesh;
use vaso_scene::Field;
use vaso_shell::{Height, Shell};

/// The series of a shell.
pub struct ShellFile {
    series: SurfaceSeriesWriter,
    mesh: WallMesh,
    /// Particles near each point of the mesh, with weights that add up to one.
    near: Vec<Vec<(u32, f64)>>,
}

/// Fields of one number a point, with their units and definitions.
const SCALARS: [(&str, &str, &str); 9] = [
    (schema::VON_MISES, "Pa", "the larger of both faces"),
    (schema::VON_MISES_INNER, "Pa", "von Mises stress on the face of the lumen"),
    (schema::VON_MISES_OUTER, "Pa", "von Mises stress on the outer face"),
    (schema::STRESS_INNER_MAX, "Pa", "the larger principal stress in the face of the lumen"),
    (schema::STRESS_INNER_MIN, "Pa", "the smaller principal stress in the face of the lumen"),
    (schema::STRESS_OUTER_MAX, "Pa", "the larger principal stress in the outer face"),
    (schema::STRESS_OUTER_MIN, "Pa", "the smaller principal stress in the outer face"),
    (schema::THICKNESS, "m", "that at which no stress acts across the wall"),
    (schema::CURVATURE_MAX, "1/m", "the larger principal curvature, positive on a tube seen from inside"),
];
/// How many of them are stresses, which the case has to ask for.
const STRESSES: usize = 7;
/// The last of them.
const SMALLER_CURVATURE: (&str, &str, &str) =
    (schema::CURVATURE_MIN, "1/m", "the smaller principal curvature");

impl ShellFile {
    fn new<R: Real>(
        path: PathBuf,
        case: &Case,
        shell: &Shell<R>,
        shear: Option<&ShearFields>,
        kept: Option<f64>,
    ) -> Result<Self, DriverError> {
        let fields = &case.scene.output.fields;
        let mesh = WallMesh::new(&case.vessel, shell.numbers().spacing);
        let near = neighbours(&mesh, shell);
        let declared = |(name, unit, definition), components| SurfaceField {
            name,
            components,
            unit,
            definition,
            citation: "",
        };
        let mut all = vec![declared((schema::NORMAL, "", "unit normal out of the lumen, at rest"), 3)];
        let vectors = [
            (Field::Displacement, (schema::DISPLACEMENT, "m", "of the face of the lumen")),
            (Field::Velocity, (schema::VELOCITY, "m/s", "of the mid-surface")),
        ];
        let asked = vectors.into_iter().filter(|(field, _)| fields.contains(field));
        all.extend(asked.map(|(_, field)| declared(field, 3)));
        let first = if fields.contains(&Field::VonMises) { 0 } else { STRESSES };
        all.extend(SCALARS[first..].iter().map(|field| declared(*field, 1)));
        all.push(declared(SMALLER_CURVATURE, 1));
        all.extend(shear.into_iter().flat_map(ShearFields::declared));
        let surface = SurfaceMesh { points: &mesh.position, triangles: &mesh.triangles };
        Ok(Self { series: open_surface(path, surface, &all, kept)?, near, mesh })
    }

    /// Means over the particles near each point.
    fn vectors(&self, of: impl Fn(usize) -> DVec3 + Sync) -> Vec<DVec3> {
        self.near.par_iter().map(|near| near.iter().map(|&(i, w)| w * of(i as usize)).sum()).collect()
    }

    fn append<R: Real>(
        &mut self,
        time: f64,
        shell: &Shell<R>,
        fields: &[Field],
        shear: Option<&ShearColumns>,
    ) -> Result<(), DriverError> {
        if self.series.last_time() == Some(time) {
            return Ok(());
        }
        let state = &shell.state;
        // The director carries the face along.
        let face = |i: usize| {
            let turn = state.director[i] - state.reference_director[i];
            state.displacement[i] - 0.5 * state.thickness[i] * turn
        };
        let displacement = self.vectors(face);
        let points: Vec<DVec3> = self.mesh.position.iter().zip(&displacement).map(|(x, u)| *x + *u).collect();
        let mut frame = SurfaceFrame { time, points: Some(&points), ..SurfaceFrame::default() };
        if self.series.is_empty() {
            frame.vectors.push((schema::NORMAL, &self.mesh.normal));
        }
        let velocity =
            if fields.contains(&Field::Velocity) { self.vectors(|i| state.velocity[i]) } else { vec![] };
        if fields.contains(&Field::Displacement) {
            frame.vectors.push((schema::DISPLACEMENT, &displacement));
        }
        if fields.contains(&Field::Velocity) {
            frame.vectors.push((schema::VELOCITY, &velocity));
        }
        let first = if fields.contains(&Field::VonMises) { 0 } else { STRESSES };
        let told: Vec<[f64; 10]> =
            (0..state.len()).into_par_iter().map(|i| quantities(shell, i, first == 0)).collect();
        let columns: Vec<(&str, Vec<f64>)> = (first..10)
            .map(|k| {
                let name = SCALARS.get(k).map_or(SMALLER_CURVATURE.0, |field| field.0);
                let mean = |near: &Vec<(u32, f64)>| near.iter().map(|&(i, w)| w * told[i as usize][k]).sum();
                (name, self.near.par_iter().map(mean).collect())
            })
            .collect();
        frame.scalars.extend(columns.iter().map(|(name, values)| (*name, values.as_slice())));
        if let Some(shear) = shear {
            shear.put(&mut frame);
        }
        Ok(self.series.append(&frame)?)
    }
}

/// The quantities of [`SCALARS`] and the smaller curvature at a particle; stresses only where they are asked for.
fn quantities<R: Real>(shell: &Shell<R>, i: usize, with_stress: bool) -> [f64; 10] {
    let mut told = [0.0; 10];
    if with_stress {
        let faces = [Height::Inner, Height::Outer];
        [told[1], told[2]] = faces.map(|face| shell.von_mises(i, face));
        told[0] = told[1].max(told[2]);
        let [inner, outer] = faces.map(|face| shell.principal_stresses(i, face));
        [told[3], told[4], told[5], told[6]] = [inner[0], inner[1], outer[0], outer[1]];
    }
    told[7] = shell.thickness(i);
    [told[8], told[9]] = shell.curvatures(i);
    told
}

/// Particles within two smoothing lengths of each point, on its side of the lumen, with their share of a kernel mean. Single particles of
/// thin walls scatter (`docs/theory/shells.md`).
fn neighbours<R: Real>(mesh: &WallMesh, shell: &Shell<R>) -> Vec<Vec<(u32, f64)>> {
    let state = &shell.state;
    let kernel = Wendland::new(shell.numbers().smoothing_length);
    let face: Vec<DVec3> = (0..state.len())
        .map(|i| state.reference_position[i] - 0.5 * state.thickness[i] * state.reference_director[i])
        .collect();
    let low = face.iter().fold(DVec3::INFINITY, |a, b| a.min(*b));
    let high = face.iter().fold(DVec3::NEG_INFINITY, |a, b| a.max(*b));
    let mut grid = CellGrid::new((low, high), kernel.support());
    let mut order = Vec::new();
    grid.sort(&face, &mut order);
    let around = |(x, normal): (&DVec3, &DVec3)| {
        let runs = grid.runs(*x);
        let candidates = runs.as_slice().iter().flat_map(|&(begin, end)| &order[begin..end]);
        let mut near: Vec<(u32, f64)> = candidates
            .filter(|&&i| state.reference_director[i as usize].dot(*normal) > 0.0)
            .map(|&i| (i, kernel.value(face[i as usize].distance(*x))))
            .filter(|(_, weight)| *weight > 0.0)
            .collect();
        let total: f64 = near.iter().map(|(_, weight)| weight).sum();
        near.iter_mut().for_each(|(_, weight)| *weight /= total);
        near
    };
    mesh.position.par_iter().zip(&mesh.normal).map(around).collect()
}

impl<R: Real> Deforming for ShellWall<R> {
    type File = ShellFile;

    const HAS_TRIANGLES: bool = true;

    const EFFECT: &'static str = "wall.shell";

    fn build(case: &Case, plan: &Plan, particles: &WallParticles) -> Result<Option<Self>, DriverError> {
        let (Some(planned), WallParticles::Shell(body)) = (&plan.shell, particles) else { return Ok(None) };
        planned.build(case, plan, body).map(Some)
    }

    fn create(
        &self,
        path: PathBuf,
        case: &Case,
        shear: Option<&ShearFields>,
        kept: Option<f64>,
    ) -> Result<ShellFile, DriverError> {
        ShellFile::new(path, case, &self.shell, shear, kept)
    }

    fn append(
        wall: &Coupling<Self>,
        file: &mut ShellFile,
        time: f64,
        fields: &[Field],
        shear: Option<&ShearColumns>,
    ) -> Result<(), DriverError> {
        file.append(time, &wall.wall.shell, fields, shear)
    }

    fn summarize(wall: &mut Coupling<Self>, _: &Plan, told: &mut Summary) {
        let shell = &wall.wall.shell;
        let energies = shell.energies();
        let largest = shell.state.displacement.iter().map(|u| u.length_squared()).fold(0.0, f64::max);
        told.shell = Some(ShellSummary {
            spacing_m: shell.numbers().spacing,
            ghosts: wall.view().position.len() as u64,
            substeps_per_step: wall.substeps as f64 / wall.steps.max(1) as f64,
            max_displacement_m: largest.sqrt(),
            reaction_n: shell.reaction().to_array(),
            blood_work_j: wall.work,
            load_work_j: energies.load_work,
            kinetic_j: energies.kinetic + energies.rotary,
            membrane_j: energies.membrane,
            bending_j: energies.bending,
            shear_j: energies.shear,
            hourglass_j: energies.hourglass,
            dissipated_j: energies.dissipated,
            balance_j: energies.balance(),
        });
    }

    fn bytes(&mut self) -> usize {
        Self::bytes(self)
    }
}

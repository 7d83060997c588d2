//! From sections to the parts of a scene, with the checks that concern one part alone.

use std::path::Path;

use crate::document::Source;
use crate::error::Problem;
use crate::material::{
    Blood, ElasticWall, Elasticity, Fibers, Material, MaterialModel, Support, Viscosity, ViscosityModel,
    Wall, WallBody, WallModel,
};
use crate::scene::{Generator, Geometry, Numerics, Particles, Probe, Run};
use crate::schema::GeneratorKind;
use crate::section::Section;

/// Builds the parts of a scene. A part is `None` where a word that decides its shape could not be read.
pub(crate) struct Builder<'a> {
    pub(crate) source: &'a Source,
    pub(crate) problems: Vec<Problem>,
}

impl Builder<'_> {
    /// Reports what is wrong with one key of a section.
    pub(crate) fn report(
        &mut self,
        section: &Section,
        name: &str,
        message: impl Into<String>,
        allowed: impl Into<String>,
        advice: impl Into<String>,
    ) {
        let mut problem = self.source.problem(section.spot(name), &section.key(name), message);
        if !section.has(name) {
            problem.seen.clear();
        }
        self.problems.push(Problem { allowed: allowed.into(), advice: advice.into(), ..problem });
    }

    pub(crate) fn title(&self, section: &Section, directory: &Path) -> String {
        let folder = || self.source.files.folder_name(directory);
        section.text("title").map(str::to_owned).or_else(folder).unwrap_or_else(|| "case".into())
    }

    pub(crate) fn geometry(&self, section: &Section) -> Option<Geometry> {
        Some(Geometry {
            surface: section.path("surface")?.clone(),
            unit: section.text("unit").map(str::to_owned),
        })
    }

    pub(crate) fn particles(&self, section: &Section) -> Option<Particles> {
        let generator = match section.word("generator")? {
            GeneratorKind::RelaxedLattice => Generator::RelaxedLattice(section.word("lattice")?),
            GeneratorKind::Multiblock => Generator::Multiblock(section.word("topology")?),
        };
        Some(Particles {
            spacing: section.number("spacing"),
            generator,
            smoothing_sweeps: section.count("smoothing_sweeps"),
            relaxation_steps: section.count("relaxation_steps"),
        })
    }

    pub(crate) fn blood(&self, section: &Section) -> Option<Blood> {
        let viscosity = match section.section("viscosity") {
            None => Viscosity::Newtonian { viscosity: section.number("viscosity") },
            Some(law) => match law.word("model")? {
                ViscosityModel::Newtonian => Viscosity::Newtonian { viscosity: law.number("viscosity") },
                model @ (ViscosityModel::Carreau | ViscosityModel::CarreauYasuda) => {
                    Viscosity::CarreauYasuda {
                        zero_shear_viscosity: law.number("zero_shear_viscosity"),
                        infinite_shear_viscosity: law.number("infinite_shear_viscosity"),
                        relaxation_time: law.number("relaxation_time"),
                        index: law.number("index"),
                        transition: match model {
                            ViscosityModel::Carreau => 2.0,
                            _ => law.number("transition"),
                        },
                    }
                }
                ViscosityModel::Casson => Viscosity::Casson {
                    yield_stress: law.number("yield_stress"),
                    infinite_shear_viscosity: law.number("infinite_shear_viscosity"),
                },
                ViscosityModel::PowerLaw => {
                    Viscosity::PowerLaw { consistency: law.number("consistency"), index: law.number("index") }
                }
            },
        };
        Some(Blood { density: section.number("density"), viscosity })
    }

    pub(crate) fn wall(&mut self, section: &Section, blood: bool, run: Option<&Run>) -> Option<Wall> {
        match section.word("model")? {
            WallModel::Rigid => Some(Wall::Rigid),
            WallModel::RigidShell => Some(Wall::RigidShell),
            WallModel::Solid => self.elastic_wall(section, blood, run).map(Wall::Solid),
            WallModel::Shell => self.elastic_wall(section, blood, run).map(Wall::Shell),
        }
    }

    pub(crate) fn wall_body(&self, section: &Section) -> WallBody {
        WallBody { thickness: section.optional_number("thickness"), open_ends: section.word("open_ends") }
    }

    fn elastic_wall(&mut self, section: &Section, blood: bool, run: Option<&Run>) -> Option<ElasticWall> {
        let pressure = if !blood {
            self.drive(section, "pressure", "pressure_waveform", vaso_units::dimension::PRESSURE, run)
        } else {
            for name in ["pressure", "pressure_waveform"].into_iter().filter(|name| section.has(name)) {
                let advice = "remove it, or remove `[blood]` to load the wall by it";
                self.report(
                    section,
                    name,
                    "the blood loads the wall already",
                    "only without `[blood]`",
                    advice,
                );
            }
            None
        };
        Some(ElasticWall {
            material: self.material(section)?,
            thickness: section.number("thickness"),
            spacing: section.optional_number("spacing"),
            density: section.number("density"),
            ends: section.word("ends")?,
            damping: section.word("damping")?,
            support: section.section("support").map(|support| Support {
                stiffness: support.number("stiffness"),
                damping: support.number("damping"),
            }),
            unloaded_pressure: section.number("unloaded_pressure"),
            external_pressure: section.number("external_pressure"),
            pressure: if blood { None } else { Some(pressure?) },
        })
    }

    fn material(&self, section: &Section) -> Option<Material> {
        let poisson_ratio = section.number("poisson_ratio");
        let elasticity = || Elasticity { young_modulus: section.number("young_modulus"), poisson_ratio };
        Some(match section.word("material")? {
            MaterialModel::NeoHookean => Material::NeoHookean(elasticity()),
            MaterialModel::SaintVenantKirchhoff => Material::SaintVenantKirchhoff(elasticity()),
            MaterialModel::Hypoelastic => Material::Hypoelastic(elasticity()),
            MaterialModel::HolzapfelGasserOgden => Material::HolzapfelGasserOgden(Fibers {
                matrix_modulus: section.number("matrix_modulus"),
                fiber_modulus: section.number("fiber_modulus"),
                fiber_exponent: section.number("fiber_exponent"),
                fiber_dispersion: section.number("fiber_dispersion"),
                fiber_angle: section.number("fiber_angle"),
                poisson_ratio,
            }),
        })
    }

    pub(crate) fn probe(&self, section: &Section) -> Probe {
        Probe { name: section.text("name").unwrap_or_default().to_owned(), at: section.point("at") }
    }

    pub(crate) fn numerics(&self, section: &Section) -> Option<Numerics> {
        Some(Numerics {
            precision: section.word("precision")?,
            sound_speed: section.optional_number("sound_speed"),
            sound_speed_factor: section.number("sound_speed_factor"),
            density_blend: section.optional_number("density_blend"),
            gradient_correction: section.flag("gradient_correction"),
            transport_velocity: section.flag("transport_velocity"),
            hold_mass: section.flag("hold_mass"),
            smoothing_length: section.number("smoothing_length"),
            seed: section.count("seed"),
            reference_pressure: section.optional_number("reference_pressure"),
            allow_mach: section.flag("allow_mach"),
        })
    }

    pub(crate) fn run(&mut self, section: &Section) -> Run {
        let period = section.optional_number("period");
        let cycles = section.has("cycles").then(|| section.count("cycles"));
        let allowed = "either `end_time`, or `cycles` with `period`";
        match (section.has("end_time"), section.has("cycles")) {
            (true, true) => {
                let advice = "remove one; `end_time` may stand beside `period`";
                self.report(section, "cycles", "says the same as `end_time`", allowed, advice);
            }
            (false, false) => {
                self.report(section, "end_time", "is missing", allowed, "say how long to simulate")
            }
            (false, true) if !section.has("period") => {
                self.report(
                    section,
                    "period",
                    "is missing, so the cycles have no length",
                    allowed,
                    "give the heart period",
                );
            }
            _ => {}
        }
        let of_cycles = || cycles.map_or(f64::NAN, f64::from) * period.unwrap_or(f64::NAN);
        let run = Run {
            end_time: section.optional_number("end_time").unwrap_or_else(of_cycles),
            period,
            cycles,
            steady: section.optional_number("steady"),
            periodicity: section.optional_number("periodicity"),
        };
        if section.has("periodicity") && !section.has("period") {
            let message = "needs `period`, the length of the cycles it compares";
            self.report(section, "periodicity", message, "", "give the heart period, or take `steady`");
        } else if run.periodicity.is_some() && !run.holds_cycles(2) {
            let message = "compares two cycles, and the run ends before there are two";
            self.report(section, "periodicity", message, "", "let the run last for more cycles");
        }
        run
    }
}

//! Every key of `case.toml`: the one list that reading, checking and the reference are made from.

use vaso_units::dimension::{
    ANGLE, COMPLIANCE, DENSITY, FLOW_RATE, LENGTH, PRESSURE, RESISTANCE, SUPPORT_DAMPING, SUPPORT_STIFFNESS,
    TIME, VELOCITY, VISCOSITY,
};

use crate::kind::Kind::{
    Choice, Choices, Count, File, Flag, Name, Number, Pairs, Point, Quantity, QuantityOr, QuantityOrTable,
    Table, Tables, Text,
};
use crate::kind::Presence::{Default, Optional, Required};
use crate::kind::{Key, Kind, Presence, Range, When};
use crate::material::{Damping, Ends, MaterialModel, OpenEnds, ViscosityModel, WallModel};
use crate::opening::{ConditionKind, CouplingKind, ProfileKind};
use crate::scene::{Field, Lattice, Precision, Topology};
use crate::waveform::InterpolationKind;
use crate::words::{Word, words};

words! {
    /// The generators of the file.
    pub(crate) enum GeneratorKind {
        RelaxedLattice = "relaxed-lattice",
        Multiblock = "multiblock",
    }
}

const ANY_U64: Kind = Count(0, u64::MAX as i128);

pub(crate) const fn key(path: &'static str, kind: Kind, presence: Presence, meaning: &'static str) -> Key {
    Key { path, kind, presence, when: &[], meaning }
}

pub(crate) const fn only(
    when: &'static [When],
    path: &'static str,
    kind: Kind,
    presence: Presence,
    meaning: &'static str,
) -> Key {
    Key { path, kind, presence, when, meaning }
}

const LATTICE: &[When] = &[When { key: "generator", words: &["relaxed-lattice"] }];
const MULTIBLOCK: &[When] = &[When { key: "generator", words: &["multiblock"] }];

const CARREAU: &[When] = &[When { key: "model", words: &["carreau"] }];
const CARREAU_YASUDA: &[When] = &[When { key: "model", words: &["carreau-yasuda"] }];
const CARREAU_BOTH: &[When] = &[When { key: "model", words: &["carreau", "carreau-yasuda"] }];
const PLATEAU: &[When] = &[When { key: "model", words: &["carreau", "carreau-yasuda", "casson"] }];
const CASSON: &[When] = &[When { key: "model", words: &["casson"] }];
const POWER_LAW: &[When] = &[When { key: "model", words: &["power-law"] }];
const NEWTONIAN: &[When] = &[When { key: "model", words: &["newtonian"] }];

const ELASTIC: When = When { key: "model", words: &["solid", "shell"] };
const ELASTIC_WALL: &[When] = &[ELASTIC];
const RIGID_LAYERS: &[When] = &[When { key: "model", words: &["rigid"] }];
const RIGID_SHELL: &[When] = &[When { key: "model", words: &["rigid-shell"] }];
const LAYERS: &[When] = &[When { key: "model", words: &["rigid", "solid"] }];
const SOLID_WALL: &[When] = &[When { key: "model", words: &["solid"] }];
const SHELL_WALL: &[When] = &[When { key: "model", words: &["shell"] }];
const SHELLS: &[When] = &[When { key: "model", words: &["rigid-shell", "shell"] }];
const ISOTROPIC: &[When] =
    &[ELASTIC, When { key: "material", words: &["neo-hookean", "saint-venant-kirchhoff", "hypoelastic"] }];
const FIBERS: &[When] = &[ELASTIC, When { key: "material", words: &["holzapfel-gasser-ogden"] }];

const VELOCITY_IN: &[When] = &[When { key: "condition", words: &["velocity"] }];
const FLOW_IN: &[When] = &[When { key: "condition", words: &["flow"] }];
const PRESSURE_AT: &[When] = &[When { key: "condition", words: &["pressure"] }];
const IS_INFLOW: When = When { key: "condition", words: &["velocity", "flow"] };
const INFLOW: &[When] = &[IS_INFLOW];
const POWER: &[When] = &[IS_INFLOW, When { key: "profile", words: &["power"] }];
const IS_PRESCRIBED: When = When { key: "condition", words: &["velocity", "flow", "pressure"] };
const PRESCRIBED: &[When] = &[IS_PRESCRIBED];
const FOURIER: &[When] = &[IS_PRESCRIBED, When { key: "interpolation", words: &["fourier"] }];
const RESISTANCE_AT: &[When] = &[When { key: "condition", words: &["resistance"] }];
const WINDKESSEL: &[When] = &[When { key: "condition", words: &["windkessel"] }];
const IS_MODEL: When = When { key: "condition", words: &["resistance", "windkessel"] };
const OUTLET_MODEL: &[When] = &[IS_MODEL];
const WINDOW: &[When] = &[IS_MODEL, When { key: "coupling", words: &["window"] }];

const WAVEFORM_OR_VALUE: Presence = Optional("exactly one of `value` and `waveform` is given");

/// All keys, each table before its keys, in the order of the reference.
#[rustfmt::skip] // one key to a line reads as the table it is
pub(crate) const KEYS: &[Key] = &[
    key("case", Table, Default(""), "What the case is."),
    key("case.title", Text, Optional("name of the folder"), "Title of reports."),
    //
    key("geometry", Table, Required, "The vessel surface."),
    key("geometry.surface", File, Required, "Surface of the lumen, STL or VTP, with open or capped ends."),
    key("geometry.unit", Choice(&["m", "cm", "mm", "um"]), Optional("guessed from the size"), "Unit of its coordinates, and of every point in this file."),
    //
    key("particles", Table, Required, "How the surface is filled with particles."),
    key("particles.spacing", Quantity(LENGTH, Range::POSITIVE), Required, "Distance between neighbours."),
    key("particles.generator", Choice(GeneratorKind::WORDS), Default("relaxed-lattice"), "A lattice cut by the surface, or blocks along the vessel."),
    only(LATTICE, "particles.lattice", Choice(Lattice::WORDS), Default("cubic"), "Lattice to start from."),
    only(MULTIBLOCK, "particles.topology", Choice(Topology::WORDS), Default("o-grid"), "How a cross-section is divided into blocks."),
    only(MULTIBLOCK, "particles.smoothing_sweeps", Count(0, 10_000), Default("0"), "Sweeps of elliptic smoothing of each section; without, blocks are filled from their faces."),
    key("particles.relaxation_steps", Count(0, 100_000), Default("200"), "Relaxation steps after placing."),
    //
    key("blood", Table, Optional("a wall alone under its own `pressure`"), "The fluid. `[blood]` alone takes all defaults."),
    key("blood.density", Quantity(DENSITY, Range::POSITIVE), Default("1060 kg/m^3"), "Density at rest."),
    key("blood.viscosity", QuantityOrTable(VISCOSITY, Range::POSITIVE), Default("3.5 mPa s"), "Dynamic viscosity, or a table that names a law and, if wanted, its constants."),
    key("blood.viscosity.model", Choice(ViscosityModel::WORDS), Required, "The viscosity law."),
    only(NEWTONIAN, "blood.viscosity.viscosity", Quantity(VISCOSITY, Range::POSITIVE), Default("3.5 mPa s"), "Dynamic viscosity."),
    only(CARREAU_BOTH, "blood.viscosity.zero_shear_viscosity", Quantity(VISCOSITY, Range::POSITIVE), Default("56 mPa s"), "Viscosity at rest (Cho, Kensey 1991)."),
    only(PLATEAU, "blood.viscosity.infinite_shear_viscosity", Quantity(VISCOSITY, Range::POSITIVE), Default("3.5 mPa s"), "Viscosity at a large shear rate."),
    only(CARREAU, "blood.viscosity.relaxation_time", Quantity(TIME, Range::POSITIVE), Default("3.313 s"), "Time constant (Cho, Kensey 1991)."),
    only(CARREAU_YASUDA, "blood.viscosity.relaxation_time", Quantity(TIME, Range::POSITIVE), Default("1.902 s"), "Time constant (Cho, Kensey 1991)."),
    only(CARREAU, "blood.viscosity.index", Number(Range::above(0.0, 1.0)), Default("0.3568"), "Power-law index (Cho, Kensey 1991)."),
    only(CARREAU_YASUDA, "blood.viscosity.index", Number(Range::above(0.0, 1.0)), Default("0.22"), "Power-law index (Cho, Kensey 1991)."),
    only(CARREAU_YASUDA, "blood.viscosity.transition", Number(Range::above(0.0, 10.0)), Default("1.25"), "Sharpness of the transition (Cho, Kensey 1991); 2 is the Carreau law."),
    only(CASSON, "blood.viscosity.yield_stress", Quantity(PRESSURE, Range::NON_NEGATIVE), Default("5 mPa"), "Yield stress."),
    only(POWER_LAW, "blood.viscosity.consistency", Quantity(VISCOSITY, Range::POSITIVE), Default("17 mPa s"), "Viscosity at a shear rate of 1/s (Shibeshi, Collins 2005)."),
    only(POWER_LAW, "blood.viscosity.index", Number(Range::above(0.0, 2.0)), Default("0.708"), "Power-law index (Shibeshi, Collins 2005)."),
    //
    key("wall", Table, Default(""), "The vessel wall; rigid where there is no such table."),
    key("wall.model", Choice(WallModel::WORDS), Default("rigid"), "Whether it deforms, and how it is represented."),
    only(ELASTIC_WALL, "wall.material", Choice(MaterialModel::WORDS), Default("neo-hookean"), "Constitutive law."),
    only(ELASTIC_WALL, "wall.thickness", Quantity(LENGTH, Range::POSITIVE), Required, "Thickness, outwards from the surface."),
    only(RIGID_LAYERS, "wall.thickness", Quantity(LENGTH, Range::POSITIVE), Optional("four spacings"), "Thickness of the layers that stand for it."),
    only(RIGID_SHELL, "wall.thickness", Quantity(LENGTH, Range::POSITIVE), Optional("one spacing"), "Thickness written with its particles."),
    only(SOLID_WALL, "wall.spacing", Quantity(LENGTH, Range::POSITIVE), Optional("that of the particles, or as much less as four layers need"), "Distance between the particles of the wall, at most that of the blood."),
    only(SHELL_WALL, "wall.spacing", Quantity(LENGTH, Range::POSITIVE), Optional("that of the particles"), "Distance between the particles of the wall, at most that of the blood."),
    only(LAYERS, "wall.open_ends", Choice(OpenEnds::WORDS), Optional("\"collar\" where it is rigid or meets blood, else \"closest-cap\""), "Where its particles end at the openings."),
    only(SHELLS, "wall.open_ends", Choice(OpenEnds::OF_SHELLS), Optional("\"collar\" where it meets blood, else \"closest-cap\""), "Where its particles end at the openings."),
    only(ELASTIC_WALL, "wall.density", Quantity(DENSITY, Range::POSITIVE), Default("1120 kg/m^3"), "Density at rest."),
    only(ISOTROPIC, "wall.young_modulus", Quantity(PRESSURE, Range::POSITIVE), Required, "Young's modulus."),
    only(ELASTIC_WALL, "wall.poisson_ratio", Number(Range::closed(0.0, 0.495)), Default("0.45"), "Poisson's ratio. The explicit step goes to zero as it goes to 0.5."),
    only(FIBERS, "wall.matrix_modulus", Quantity(PRESSURE, Range::POSITIVE), Required, "Shear modulus of the matrix, c."),
    only(FIBERS, "wall.fiber_modulus", Quantity(PRESSURE, Range::POSITIVE), Required, "Stiffness of the fibres, k1."),
    only(FIBERS, "wall.fiber_exponent", Number(Range::above(0.0, 1000.0)), Required, "Exponent of their stiffening, k2."),
    only(FIBERS, "wall.fiber_dispersion", Number(Range::closed(0.0, 1.0 / 3.0)), Default("0"), "Dispersion of their directions, from 0 (aligned) to 1/3 (isotropic)."),
    only(FIBERS, "wall.fiber_angle", Quantity(ANGLE, Range::closed(0.0, std::f64::consts::FRAC_PI_2)), Required, "Angle between the two families and the circumferential direction."),
    only(ELASTIC_WALL, "wall.ends", Choice(Ends::WORDS), Default("clamped"), "What holds the wall at the openings."),
    only(ELASTIC_WALL, "wall.pressure", Quantity(PRESSURE, Range::ANY), Optional("only without `[blood]`, and then this or `pressure_waveform`"), "Load on the inner face of a scene without blood."),
    only(ELASTIC_WALL, "wall.pressure_waveform", File, Optional("see `pressure`"), "The same over time: a file of two columns, time and pressure."),
    only(ELASTIC_WALL, "wall.unloaded_pressure", Quantity(PRESSURE, Range::ANY), Default("0 Pa"), "Gauge pressure of the blood at which the wall is without load in the shape of the surface."),
    only(ELASTIC_WALL, "wall.external_pressure", Quantity(PRESSURE, Range::ANY), Default("0 Pa"), "Gauge pressure on the outer face."),
    only(ELASTIC_WALL, "wall.damping", Choice(Damping::WORDS), Default("material"), "What takes energy out of its motion."),
    only(ELASTIC_WALL, "wall.support", Table, Optional("nothing around the wall"), "Tissue around the wall."),
    key("wall.support.stiffness", Quantity(SUPPORT_STIFFNESS, Range::NON_NEGATIVE), Default("0 Pa/m"), "Traction per displacement."),
    key("wall.support.damping", Quantity(SUPPORT_DAMPING, Range::NON_NEGATIVE), Default("0 Pa s/m"), "Traction per velocity."),
    //
    key("opening", Tables, Optional("the openings are only listed"), "One table for each opening of the vessel."),
    key("opening.name", Name, Required, "Its name in all outputs."),
    key("opening.near", Point, Required, "A point near it, in the unit of the surface; the nearest opening is meant."),
    key("opening.condition", Choice(ConditionKind::WORDS), Required, "What holds there."),
    only(INFLOW, "opening.profile", Choice(ProfileKind::WORDS), Default("parabolic"), "Shape of the velocity across it."),
    only(POWER, "opening.exponent", Number(Range::above(0.0, 100.0)), Required, "Exponent n of the profile (n + 2)/n (1 - s^n): 2 is the parabola, more is blunter."),
    only(VELOCITY_IN, "opening.value", Quantity(VELOCITY, Range::ANY), WAVEFORM_OR_VALUE, "Mean velocity over the cross-section, positive into the vessel."),
    only(FLOW_IN, "opening.value", Quantity(FLOW_RATE, Range::ANY), WAVEFORM_OR_VALUE, "Flow rate, positive into the vessel."),
    only(PRESSURE_AT, "opening.value", Quantity(PRESSURE, Range::ANY), Optional("0 Pa"), "Gauge pressure."),
    only(PRESCRIBED, "opening.waveform", File, Optional("constant `value`"), "The value over time: a file of two columns, time and value in SI units or those it names."),
    only(PRESCRIBED, "opening.waveform_unit", Text, Optional("that of the SI, or of the header"), "Unit of the values in the waveform, such as \"ml/s\", where its header names none."),
    only(PRESCRIBED, "opening.interpolation", Choice(InterpolationKind::WORDS), Default("linear"), "How the waveform goes between its samples: in straight lines, by cubics that stay between samples, or as a sum of harmonics near them."),
    only(FOURIER, "opening.harmonics", Count(1, 1000), Required, "Number of harmonics, at most half the number of samples."),
    only(PRESCRIBED, "opening.ramp", Quantity(TIME, Range::NON_NEGATIVE), Optional("chosen by the planner"), "Time over which the value rises smoothly from zero."),
    only(RESISTANCE_AT, "opening.resistance", Quantity(RESISTANCE, Range::NON_NEGATIVE), Required, "Pressure per outflow."),
    only(WINDKESSEL, "opening.proximal_resistance", Quantity(RESISTANCE, Range::NON_NEGATIVE), Required, "Resistance before the compliance."),
    only(WINDKESSEL, "opening.distal_resistance", Quantity(RESISTANCE, Range::POSITIVE), Required, "Resistance behind the compliance."),
    only(WINDKESSEL, "opening.compliance", Quantity(COMPLIANCE, Range::POSITIVE), Required, "Volume stored per pressure."),
    only(WINDKESSEL, "opening.periodic_start", Flag, Default("false"), "Start from the pressure that the periodic inflow leads to without a vessel, instead of `initial_pressure`."),
    only(WINDKESSEL, "opening.initial_pressure", Quantity(PRESSURE, Range::ANY), Optional("`distal_pressure`"), "Gauge pressure at the start."),
    only(OUTLET_MODEL, "opening.distal_pressure", Quantity(PRESSURE, Range::ANY), Default("0 Pa"), "Gauge pressure behind the outlet model."),
    only(OUTLET_MODEL, "opening.coupling", Choice(CouplingKind::WORDS), Default("impedance"), "How the model takes up the flow: at every acoustic step, implicitly with the impedance of the cap, or once a window from the mean flow over it, as published."),
    only(WINDOW, "opening.window", Quantity(TIME, Range::POSITIVE), Required, "Length of the window."),
    only(OUTLET_MODEL, "opening.backflow_damping", Number(Range::closed(0.0, 1.0)), Default("0.5"), "How strongly flow that comes in is damped; 0 not at all (Moghadam et al. 2011, there beta)."),
    //
    key("probe", Tables, Optional("no probes"), "One table for each point whose values are recorded in `probes.csv`."),
    key("probe.name", Name, Required, "Its name in `probes.csv`."),
    key("probe.at", Point, Required, "Where it is, in the unit of the surface."),
    //
    key("numerics", Table, Default(""), "Choices of the numerical method."),
    key("numerics.precision", Choice(Precision::WORDS), Default("mixed"), "Arithmetic of the pair loops; the state is always double."),
    key("numerics.sound_speed", QuantityOr("auto", VELOCITY, Range::POSITIVE), Default("auto"), "Numerical sound speed; \"auto\" takes it from the expected velocity and pressure."),
    key("numerics.sound_speed_factor", Number(Range::closed(3.0, 200.0)), Default("10"), "Least ratio of the chosen sound speed to the expected largest velocity."),
    key("numerics.density_blend", Number(Range::closed(0.0, 1.0)), Optional("0.03, with a wall that deforms 0.003"), "Share of the summed density mixed in at every advective step."),
    key("numerics.gradient_correction", Flag, Default("true"), "Kernel gradients are corrected where a kernel lacks neighbours or finds them uneven; without it errors at walls do not fall with the spacing."),
    key("numerics.transport_velocity", Flag, Default("true"), "Particles are moved apart beside their flow, so that they stay evenly spread; without it they line up along streamlines and leave gaps."),
    key("numerics.hold_mass", Flag, Default("false"), "The mean density of a vessel at rest follows the mass in it instead of the kernel sum; for long vessels whose flow is slowed down in every beat."),
    key("numerics.smoothing_length", Number(Range::closed(1.0, 2.0)), Default("1.3"), "Smoothing length in spacings; the support radius is twice this."),
    key("numerics.seed", ANY_U64, Default("0"), "Seed of everything random."),
    key("numerics.reference_pressure", QuantityOr("auto", PRESSURE, Range::ANY), Default("auto"), "Pressure subtracted in the equation of state; \"auto\" follows the outlets for rigid walls."),
    key("numerics.allow_mach", Flag, Default("false"), "Go on when the velocity comes too near to the numerical sound speed."),
    //
    key("run", Table, Required, "How long to simulate: either `end_time`, or `cycles` with `period`."),
    key("run.end_time", Quantity(TIME, Range::POSITIVE), Optional("`cycles` times `period`"), "Simulated time."),
    key("run.cycles", Count(1, 10_000), Optional("`end_time` rules"), "Number of heart cycles."),
    key("run.period", Quantity(TIME, Range::POSITIVE), Optional("nothing repeats"), "Heart period; waveforms repeat after it."),
    key("run.steady", Number(Range::above(0.0, 1.0)), Optional("the run goes on to its end"), "End early once the flow of every opening changes by less than this share."),
    key("run.periodicity", Number(Range::above(0.0, 1.0)), Optional("the run goes on to its end"), "End early once two successive cycles differ by no more than this share of the range of every flow and pressure, and of twice it in the time-averaged wall shear stress."),
    //
    key("output", Table, Default(""), "What to write and how often, in simulated time."),
    key("output.every", Quantity(TIME, Range::POSITIVE), Optional("a hundredth of the run"), "Interval of the particle series."),
    key("output.table_every", Quantity(TIME, Range::POSITIVE), Optional("a tenth of `every`"), "Interval of `openings.csv` and `probes.csv`."),
    key("output.fields", Choices(Field::WORDS), Optional("velocity and pressure with blood, displacement and von_mises with a wall that deforms"), "Fields of the series. `tawss`, `osi`, `rrt`, `ecap`, `transverse_wss` and `peak_wss` are of a cycle and need `run.period`."),
    key("output.checkpoint_every", Quantity(TIME, Range::POSITIVE), Optional("every ten minutes of wall time"), "Interval of checkpoints. One is also written at the start, at the end and on interruption."),
    key("output.fractional_flow_reserve", Pairs, Optional("none"), "Pairs of openings, [\"proximal\", \"distal\"], whose pressure drop and fractional flow reserve over each cycle are told; needs `run.period`."),
];

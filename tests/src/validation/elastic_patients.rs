//! The vessels of persons with a wall that deforms, a shell or a solid: how far it widens, and that nothing breaks.

use std::f64::consts::TAU;

use glam::DVec3;
use vaso_coupling::ShellWall;
use vaso_driver::deforming::Deforming;
use vaso_driver::{Flow, world};
use vaso_solid::Solid;

use super::measure::Flown;
use super::patients::{AORTA_SPEC, CAROTID_SPEC, Spec, prepare};
use super::{Case, Outcome, Tolerance, Unit};
use crate::data;

/// The carotid.
pub const CAROTID: Case = Case {
    name: "carotid-shell",
    title: "Carotid of a person with a shell",
    setup: "As the rigid carotid, its wall a shell of 0.6 mm, 1.106 MPa, Poisson ratio 0.49 and 1060 kg/m^3, unloaded at 10 kPa, clamped: two beats \
            at 0.4 mm.",
    reference: "A thick neo-Hookean tube in plane strain (Rivlin 1949; Lame's, were the strain small), with the mean radius and the mean pressure of a stretch \
                of the common carotid of 18 mm, when the pressure there is highest.",
    remark: "A carotid is no tube: the figure says that the wall carries what it has to.",
    quick: None,
    full: || run::<ShellWall<f32>>(&CAROTID_SPEC, &CAROTID_WALL),
};

/// The carotid with a solid wall.
pub const CAROTID_SOLID: Case = Case {
    name: "carotid-solid",
    title: "Carotid of a person with a solid wall",
    setup: "As the carotid with a shell, but for its wall, a neo-Hookean solid of two layers 0.3 mm apart, Poisson ratio 0.45: one beat at 0.4 mm.",
    reference: "As for the carotid with a shell.",
    remark: "Two layers are too few to bend (`check` says so).",
    quick: None,
    full: || run::<Solid<f32>>(&CAROTID_SPEC, &CAROTID_SOLID_WALL),
};

/// The aorta.
pub const AORTA: Case = Case {
    name: "aorta-shell",
    title: "Aorta of a person with a shell",
    setup: "As the rigid aorta, its wall a shell of 2.5 mm, 0.75 MPa, Poisson ratio 0.49 and 1060 kg/m^3, unloaded at 10 kPa, clamped: one beat \
            at 1.2 mm.",
    reference: "As for the carotid, with a stretch of the descending aorta of 30 mm.",
    remark: "Nothing holds the aorta but its ends: under a third of this inflow it swung by 0.15 mm to a side, which a mean around it does not see. Between the branches \
             of the arch the wall is thinner than asked for, as there is no room.",
    quick: None,
    full: || run::<ShellWall<f32>>(&AORTA_SPEC, &AORTA_WALL),
};

/// A wall, and the stretch of the vessel that is most like a tube.
struct WallSpec {
    /// Keys of its model in `case.toml`.
    model: &'static str,
    thickness: f64,
    young: f64,
    poisson: f64,
    beats: f64,
    /// Corners of a box around the stretch \[m\], whose ends along z cut it.
    stretch: [DVec3; 2],
}

const UNLOADED: f64 = 10e3;

const CAROTID_WALL: WallSpec = WallSpec {
    model: "model = \"shell\"",
    thickness: 0.6e-3,
    young: 1.106e6,
    poisson: 0.49,
    beats: 2.0,
    stretch: [DVec3::new(-4e-3, -1e-3, -24e-3), DVec3::new(10e-3, 12e-3, -6e-3)],
};

const CAROTID_SOLID_WALL: WallSpec =
    WallSpec { model: "model = \"solid\"\nspacing = \"0.3 mm\"", poisson: 0.45, beats: 1.0, ..CAROTID_WALL };

const AORTA_WALL: WallSpec = WallSpec {
    model: "model = \"shell\"",
    thickness: 2.5e-3,
    young: 0.75e6,
    poisson: 0.49,
    beats: 1.0,
    stretch: [DVec3::new(-40e-3, -30e-3, 20e-3), DVec3::new(10e-3, 12e-3, 50e-3)],
};

/// What is read of a wall that deforms.
trait Tissue: Deforming {
    /// Reference positions \[m\].
    fn reference(&self) -> &[DVec3];
    /// Displacements \[m\].
    fn displacement(&self) -> &[DVec3];
    /// Area of the middle of the wall \[m^2\] that particle `i` stands for, by the thickness \[m\].
    fn area(&self, i: usize, thickness: f64) -> f64;
}

impl Tissue for ShellWall<f32> {
    fn reference(&self) -> &[DVec3] {
        &self.shell.state.reference_position
    }
    fn displacement(&self) -> &[DVec3] {
        &self.shell.state.displacement
    }
    fn area(&self, i: usize, _: f64) -> f64 {
        self.shell.state.area[i]
    }
}

impl Tissue for Solid<f32> {
    fn reference(&self) -> &[DVec3] {
        &self.state.reference_position
    }
    fn displacement(&self) -> &[DVec3] {
        &self.state.displacement
    }
    fn area(&self, i: usize, thickness: f64) -> f64 {
        self.state.volume[i] / thickness
    }
}

/// Time between looks at the wall \[s\].
const LOOK: f64 = 1e-3;

fn run<W: Tissue>(spec: &Spec, wall: &WallSpec) -> Option<Outcome> {
    let data = data()?;
    let mut outcome = Outcome::new();
    let text = format!(
        "{}[wall]\n{}\nthickness = \"{} m\"\nyoung_modulus = \"{} Pa\"\npoisson_ratio = {}\n\
         density = \"1060 kg/m^3\"\nunloaded_pressure = \"{UNLOADED} Pa\"\n",
        spec.text(&data, wall.beats),
        wall.model,
        wall.thickness,
        wall.young,
        wall.poisson
    );
    let (setup, plan, bodies) = prepare(&text);
    let mut flow: Flow<f32, W> =
        world::build_flow_in(&setup, &plan, bodies).unwrap_or_else(|e| panic!("{e}"));

    let stretch = Stretch::new(&flow, wall);
    let (mut look, mut told, mut top) = (LOOK, 0.1, (0.0, 0.0));
    while flow.time < plan.end_time {
        flow.step(plan.end_time).unwrap_or_else(|e| panic!("{e}"));
        if flow.time > told {
            told += 0.1;
            println!("{:.2} s in {:.0} s", flow.time, flow.ledger.total());
        }
        if flow.time > look {
            look = flow.time + LOOK;
            let pressure = stretch.pressure(&flow);
            if pressure > top.0 {
                top = (pressure, stretch.widening(&flow));
            }
        }
    }
    outcome.cost(&Flown {
        particles: flow.fluid.state.len(),
        escaped: flow.watch.escaped,
        density: flow.watch.max_density_error,
        seconds: flow.ledger.total(),
    });
    let (pressure, widening) = top;
    let theory = wall.widening(stretch.radius, pressure);
    outcome.figure(
        format!("widening by {:.1} um under {:.0} Pa, of that of a thick tube", 1e6 * widening, pressure),
        widening / theory - 1.0,
        Unit::Part,
        Tolerance::Asked(0.10),
    );
    outcome.figure(
        "largest density deviation",
        flow.watch.max_density_error,
        Unit::Part,
        Tolerance::Held(0.01),
    );
    outcome.figure("particles lost", flow.watch.escaped as f64, Unit::Number, Tolerance::Asked(0.0));
    Some(outcome)
}

impl WallSpec {
    /// Displacement \[m\] of the middle of a thick neo-Hookean tube of that mean radius \[m\] in plane strain, under an inner pressure \[Pa\]: that of
    /// one whose volume stays (Rivlin, Philos. Trans. R. Soc. A 242 (1949) 173), times what linear theory has more for the Poisson ratio.
    ///
    /// Lame's linear tube would widen by 7 % less than this at the strain of an aorta.
    fn widening(&self, radius: f64, pressure: f64) -> f64 {
        let (inner, outer) = (radius - 0.5 * self.thickness, radius + 0.5 * self.thickness);
        let moved = |r: f64, grown: f64| (r * r + grown).sqrt();
        // `grown` is the square of any radius less that of its reference.
        let load = |grown: f64| {
            let [a, b] = [inner, outer].map(|r| moved(r, grown) / r);
            self.young / 3.0 * ((a / b).ln() + 0.5 * (b.powi(-2) - a.powi(-2)))
        };
        let (mut low, mut high) = (0.0, radius * radius);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if load(middle) < pressure { low = middle } else { high = middle }
        }
        let linear =
            |poisson: f64| (1.0 + poisson) * ((1.0 - 2.0 * poisson) * radius + outer * outer / radius);
        (moved(radius, low) - radius) * linear(self.poisson) / linear(0.5)
    }
}

/// Particles of the stretch of a wall.
struct Stretch {
    corners: [DVec3; 2],
    /// Those of the wall, with the direction away from the axis.
    particles: Vec<(usize, DVec3)>,
    /// Mean radius of the middle of the wall \[m\]: its area over the length of the stretch.
    radius: f64,
}

impl Stretch {
    fn new<W: Tissue>(flow: &Flow<f32, W>, wall: &WallSpec) -> Self {
        let (tissue, corners) = (tissue(flow), wall.stretch);
        let place = tissue.reference();
        let inside: Vec<usize> = (0..place.len()).filter(|&i| within(&corners, place[i])).collect();
        let area: f64 = inside.iter().map(|&i| tissue.area(i, wall.thickness)).sum();
        // The axis leans: from the middle of the lower half to that of the upper.
        let [low, high] = corners.map(|c| c.z);
        let middle = 0.5 * (low + high);
        let centre = |is_upper: bool| {
            let half: Vec<DVec3> =
                inside.iter().map(|&i| place[i]).filter(|x| (x.z > middle) == is_upper).collect();
            half.iter().sum::<DVec3>() / half.len() as f64
        };
        let (lower, axis) = (centre(false), (centre(true) - centre(false)).normalize());
        let outwards = |i: usize| (place[i] - lower).reject_from_normalized(axis).normalize();
        Self {
            corners,
            particles: inside.iter().map(|&i| (i, outwards(i))).collect(),
            radius: area / (TAU * (high - low) / axis.z),
        }
    }

    /// Mean displacement away from the axis \[m\].
    fn widening<W: Tissue>(&self, flow: &Flow<f32, W>) -> f64 {
        let displacement = tissue(flow).displacement();
        let sum: f64 = self.particles.iter().map(|&(i, outwards)| displacement[i].dot(outwards)).sum();
        sum / self.particles.len() as f64
    }

    /// Mean pressure of the blood \[Pa\], over that at which the wall is unloaded.
    fn pressure<W: Tissue>(&self, flow: &Flow<f32, W>) -> f64 {
        let state = &flow.fluid.state;
        let inside = (0..state.len()).filter(|&i| within(&self.corners, state.position[i]));
        let (sum, n) = inside.fold((0.0, 0.0), |(sum, n), i| (sum + state.pressure[i], n + 1.0));
        // The equation of state counts from the pressure at which the wall is unloaded.
        sum / n
    }
}

fn tissue<W: Tissue>(flow: &Flow<f32, W>) -> &W {
    &flow.wall.as_ref().expect("the wall deforms").wall
}

fn within([low, high]: &[DVec3; 2], x: DVec3) -> bool {
    x.cmpge(*low).all() && x.cmple(*high).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn under_a_small_pressure_the_tube_is_that_of_lame() {
        let (radius, t) = (10.25e-3, AORTA_WALL.thickness);
        let (a, b) = (radius - 0.5 * t, radius + 0.5 * t);
        let lame = |p: f64| {
            (1.0 + AORTA_WALL.poisson) / AORTA_WALL.young * p * a * a / (b * b - a * a)
                * ((1.0 - 2.0 * AORTA_WALL.poisson) * radius + b * b / radius)
        };
        let ratio = |p: f64| AORTA_WALL.widening(radius, p) / lame(p);
        assert!((ratio(1.0) - 1.0).abs() < 1e-4, "{}", ratio(1.0));
        assert!((1.05..1.10).contains(&ratio(6.6e3)), "{}", ratio(6.6e3));
    }
}

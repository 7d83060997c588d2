//! `expect.toml`: what is known of a flow beforehand, which `vaso study` counts errors from.

use std::collections::BTreeMap;
use std::path::Path;

use vaso_units::dimension::{FLOW_RATE, LENGTH, PRESSURE, VELOCITY};

use crate::build::Builder;
use crate::check::in_order;
use crate::document::Source;
use crate::error::SceneError;
use crate::files::Files;
use crate::kind::Kind::{Choice, Name, Quantity, Tables, Text};
use crate::kind::Presence::{Default, Optional, Required};
use crate::kind::{Key, Presence, Range, When};
use crate::reader::Reader;
use crate::scene::Scene;
use crate::schema::{key, only};
use crate::section::Section;
use crate::words::{Word, words};

/// Name of the file in the folder of a case.
const FILE: &str = "expect.toml";

words! {
    /// What is measured.
    pub enum Measured {
        /// Flow out of the vessel at an opening \[m^3/s\].
        Flow = "flow",
        /// Pressure at an opening, as in `openings.csv` \[Pa\].
        Pressure = "pressure",
        /// Pressure at one opening less that at another \[Pa\].
        PressureDrop = "pressure-drop",
        /// Magnitude of the velocity at a probe \[m/s\].
        Speed = "speed",
        /// Mean over the wall of the wall shear stress, of its mean over the cycle where there is one \[Pa\].
        WallShear = "wall-shear",
        /// Largest displacement of the wall at the end \[m\].
        Displacement = "displacement",
    }
}

words! {
    /// What becomes of a quantity that varies in time.
    pub enum Statistic {
        /// Mean over the last cycle, or over the last quarter of a run without one.
        Mean = "mean",
        /// Smallest value in that time.
        Minimum = "minimum",
        /// Largest value in that time.
        Maximum = "maximum",
        /// Amplitude of its first harmonic.
        Amplitude = "amplitude",
    }
}

/// A value that is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Expectation {
    /// Those of the same name are one error, the root of the mean of their squares.
    pub name: String,
    /// What is measured.
    pub measured: Measured,
    /// Where: openings, or a probe; empty where the whole wall is meant.
    pub places: Vec<String>,
    /// What becomes of it in time.
    pub statistic: Statistic,
    /// The value \[SI\].
    pub value: f64,
    /// What errors are shares of \[SI\]; `None` leaves it to the largest value of that name.
    pub scale: Option<f64>,
    /// Where the value is from.
    pub source: Option<String>,
}

const AT_OPENING: &[When] = &[When { key: "of", words: &["flow", "pressure", "pressure-drop"] }];
const BETWEEN: &[When] = &[When { key: "of", words: &["pressure-drop"] }];
const AT_PROBE: &[When] = &[When { key: "of", words: &["speed"] }];
const IN_TIME: &[When] = &[When { key: "of", words: &["flow", "pressure", "pressure-drop", "speed"] }];
const A_FLOW: &[When] = &[When { key: "of", words: &["flow"] }];
const A_STRESS: &[When] = &[When { key: "of", words: &["pressure", "pressure-drop", "wall-shear"] }];
const A_LENGTH: &[When] = &[When { key: "of", words: &["displacement"] }];

const VALUE: &str = "What it is.";
const SCALE: &str = "What errors are shares of.";
const LARGEST: Presence = Optional("the largest value of that name");

/// All keys of the file.
#[rustfmt::skip] // one key to a line reads as the table it is
pub(crate) const KEYS: &[Key] = &[
    key("expect", Tables, Required, "One table for each value that is known."),
    key("expect.name", Name, Required, "Name of the error; tables that share it are one error, the root of the mean of their squares."),
    key("expect.of", Choice(Measured::WORDS), Required, "What is measured."),
    only(AT_OPENING, "expect.opening", Name, Required, "The opening it is measured at."),
    only(BETWEEN, "expect.to", Name, Required, "The opening whose pressure is taken off."),
    only(AT_PROBE, "expect.probe", Name, Required, "The probe it is measured at."),
    only(IN_TIME, "expect.statistic", Choice(Statistic::WORDS), Default("mean"), "What becomes of it over the last cycle, or over the last quarter of a run without cycles."),
    only(A_FLOW, "expect.value", Quantity(FLOW_RATE, Range::ANY), Required, VALUE),
    only(A_STRESS, "expect.value", Quantity(PRESSURE, Range::ANY), Required, VALUE),
    only(AT_PROBE, "expect.value", Quantity(VELOCITY, Range::ANY), Required, VALUE),
    only(A_LENGTH, "expect.value", Quantity(LENGTH, Range::ANY), Required, VALUE),
    only(A_FLOW, "expect.scale", Quantity(FLOW_RATE, Range::POSITIVE), LARGEST, SCALE),
    only(A_STRESS, "expect.scale", Quantity(PRESSURE, Range::POSITIVE), LARGEST, SCALE),
    only(AT_PROBE, "expect.scale", Quantity(VELOCITY, Range::POSITIVE), LARGEST, SCALE),
    only(A_LENGTH, "expect.scale", Quantity(LENGTH, Range::POSITIVE), LARGEST, SCALE),
    key("expect.source", Text, Optional("nothing is said"), "Where the value is from."),
];

impl Expectation {
    /// Reads `expect.toml` beside the case of a scene; nothing is expected where there is no such file.
    ///
    /// # Errors
    /// When the file is wrong, or names what the scene does not have.
    pub fn load(scene: &Scene) -> Result<Vec<Self>, SceneError> {
        let file = scene.directory.join(FILE);
        match std::fs::read_to_string(&file) {
            Ok(text) => Self::read(Source::new(file, text, Vec::new(), Files::Disk), scene),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(Vec::new()),
            Err(error) => {
                let allowed = "a file in UTF-8, or none".into();
                let message = format!("cannot be read: {error}");
                let problem =
                    crate::error::Problem { allowed, message, ..crate::error::Problem::of_file(file) };
                Err(SceneError { problems: vec![problem] })
            }
        }
    }

    /// Reads the text of such a file.
    ///
    /// # Errors
    /// As [`load`](Self::load).
    pub fn parse(text: &str, scene: &Scene) -> Result<Vec<Self>, SceneError> {
        let source = Source::new(FILE.into(), text.to_owned(), Vec::new(), Files::Given(BTreeMap::new()));
        Self::read(source, scene)
    }

    fn read(source: Source, scene: &Scene) -> Result<Vec<Self>, SceneError> {
        let root = source.parse().map_err(|problems| SceneError { problems })?;
        let directory = source.file.parent().unwrap_or(Path::new("."));
        let mut reader = Reader { source: &source, schema: KEYS, directory, problems: Vec::new() };
        let sections = reader.root(&root);
        let mut builder = Builder { source: &source, problems: reader.problems };
        let all: Option<Vec<Self>> =
            sections.sections("expect").iter().map(|section| builder.expectation(section, scene)).collect();
        match all {
            Some(all) if builder.problems.is_empty() => Ok(all),
            _ => Err(in_order(builder.problems, &source)),
        }
    }
}

impl Builder<'_> {
    fn expectation(&mut self, section: &Section, scene: &Scene) -> Option<Expectation> {
        let openings: Vec<&str> = scene.openings.iter().map(|o| o.name.as_str()).collect();
        let probes: Vec<&str> = scene.probes.iter().map(|p| p.name.as_str()).collect();
        let mut places = Vec::new();
        for (key, known, what) in
            [("opening", &openings, "opening"), ("to", &openings, "opening"), ("probe", &probes, "probe")]
        {
            let Some(name) = section.text(key) else { continue };
            if !known.contains(&name) {
                let allowed = known.iter().map(|n| format!("\"{n}\"")).collect::<Vec<_>>().join(", ");
                let allowed = if allowed.is_empty() { "nothing, the case has none".into() } else { allowed };
                let advice = format!("take the name of one in the case, or add `[[{what}]]` there");
                self.report(section, key, format!("the case has no such {what}"), allowed, advice);
            }
            places.push(name.to_owned());
        }
        let scale = section.optional_number("scale");
        let value = section.number("value");
        if value == 0.0 && scale.is_none() {
            self.report(
                section,
                "value",
                "is zero, of which nothing can be a share",
                "a value other than zero, or one with `scale`",
                "say by `scale` what its errors are to be shares of",
            );
        }
        Some(Expectation {
            name: section.text("name")?.to_owned(),
            measured: section.word("of")?,
            places,
            statistic: section.word("statistic").unwrap_or(Statistic::Mean),
            value,
            scale,
            source: section.text("source").map(str::to_owned),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene() -> Scene {
        let case = "[geometry]\nsurface = \"a.stl\"\n[particles]\nspacing = \"1 mm\"\n[blood]\n[run]\nend_time = \"1 s\"\n\
                    [[opening]]\nname = \"in\"\nnear = [0, 0, 0]\ncondition = \"velocity\"\nvalue = \"1 m/s\"\n\
                    [[opening]]\nname = \"out\"\nnear = [0, 0, 1]\ncondition = \"pressure\"\n\
                    [[probe]]\nname = \"axis\"\nat = [0, 0, 0.5]\n";
        Scene::parse(case, &[], &BTreeMap::from([("a.stl".into(), String::new())])).expect("a case")
    }

    #[test]
    fn values_are_read_with_the_unit_of_what_is_measured() {
        let text = "[[expect]]\nname = \"velocity\"\nof = \"speed\"\nprobe = \"axis\"\nvalue = \"20 cm/s\"\n\
                    [[expect]]\nname = \"drop\"\nof = \"pressure-drop\"\nopening = \"in\"\nto = \"out\"\n\
                    statistic = \"amplitude\"\nvalue = \"1 mmHg\"\nscale = \"2 mmHg\"\nsource = \"a formula\"\n";
        let read = Expectation::parse(text, &scene()).expect("all is well");
        assert_eq!(
            (read[0].measured, read[0].value, read[0].statistic),
            (Measured::Speed, 0.2, Statistic::Mean)
        );
        assert_eq!(read[1].places, ["in", "out"]);
        assert_eq!(read[1].statistic, Statistic::Amplitude);
        assert!((read[1].scale.expect("given") / read[1].value - 2.0).abs() < 1e-12);
    }

    #[test]
    fn what_the_case_does_not_have_is_refused_with_its_place() {
        let text = "[[expect]]\nname = \"q\"\nof = \"flow\"\nopening = \"outt\"\nvalue = \"0 ml/s\"\n\
                    [[expect]]\nname = \"u\"\nof = \"speed\"\nprobe = \"axis\"\nvalue = \"1 Pa\"\n";
        let error = Expectation::parse(text, &scene()).expect_err("three mistakes");
        let told = error.to_string();
        for part in [
            "expect.toml:4",
            "no such opening",
            "\"in\", \"out\"",
            "expect.toml:5",
            "is zero",
            "expect.toml:10",
        ] {
            assert!(told.contains(part), "{part} is not in\n{told}");
        }
    }
}

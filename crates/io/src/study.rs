//! `study.json`: what a study ran, and what it tells of accuracy and time.

use crate::json;
use crate::summary::{ParticleCounts, StepCounts};
use serde::{Deserialize, Serialize};

/// What `vaso study` found.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct StudyReport {
    /// Version of the program.
    pub vaso_version: String,
    /// Title of the case.
    pub case: String,
    /// Tables of the case, and its surface, with digests of what they say at any spacing: as in [`Summary`](crate::Summary).
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub identity: Vec<[String; 2]>,
    /// Worker threads of every run.
    pub threads: u64,
    /// What errors are counted from, in words.
    pub reference: String,
    /// Name of the error that prices, the front and a goal go by; `worst` is the largest of all.
    pub judged_by: String,
    /// All runs, in order.
    pub runs: Vec<StudyRun>,
    /// What the ladder of spacings tells of each error, `worst` last.
    pub errors: Vec<ErrorEntry>,
    /// Names of the runs that no other beats in time and error, by growing time.
    pub front: Vec<String>,
    /// What was asked for by `--error` or `--budget`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<GoalEntry>,
    /// What a reader of the figures has to know.
    pub warnings: Vec<String>,
}

impl StudyReport {
    /// One row a run: `name`, `ladder`, a column for each key that any run sets, `status`, `wall_clock_s` and what it took, then
    /// `value_*` \[SI\] and `error_*` \[-\]. Cells without a value are empty.
    pub fn to_csv(&self) -> String {
        let mut keys: Vec<&str> = Vec::new();
        for [key, _] in self.runs.iter().flat_map(|run| &run.settings) {
            if !keys.contains(&key.as_str()) {
                keys.push(key);
            }
        }
        let complete = self.runs.iter().find(|run| !run.values.is_empty());
        let names = |list: fn(&StudyRun) -> &Vec<NamedValue>| -> Vec<&str> {
            complete.map(|run| list(run).iter().map(|v| v.name.as_str()).collect()).unwrap_or_default()
        };
        let (values, errors) = (names(|run| &run.values), names(|run| &run.errors));
        let mut header: Vec<String> = vec!["name".into(), "ladder".into()];
        header.extend(keys.iter().map(|key| (*key).to_owned()));
        header.extend(NUMBERS.iter().map(|name| (*name).to_owned()));
        header.extend(values.iter().map(|name| format!("value_{name}")));
        header.extend(errors.iter().map(|name| format!("error_{name}")));
        header.push("message".into());
        let mut writer = csv::Writer::from_writer(Vec::new());
        let mut write =
            |row: &[String]| writer.write_record(row).expect("memory can be written to, rows are as long");
        write(&header);
        for run in &self.runs {
            let mut row = vec![run.name.clone(), run.ladder.clone()];
            let setting = |key: &&str| run.settings.iter().find(|s| s[0] == **key).map(|s| s[1].clone());
            row.extend(keys.iter().map(|key| setting(key).unwrap_or_default()));
            row.extend(run.numbers());
            let named = |list: &[NamedValue], name: &str| {
                list.iter().find(|v| v.name == name).map_or_else(String::new, |v| cell(v.value))
            };
            row.extend(values.iter().map(|name| named(&run.values, name)));
            row.extend(errors.iter().map(|name| named(&run.errors, name)));
            row.push(run.message.clone().unwrap_or_default());
            write(&row);
        }
        let bytes = writer.into_inner().expect("memory can be written to");
        String::from_utf8(bytes).expect("cells are text")
    }
}

/// Columns of every run, between those of its settings and those of its values.
const NUMBERS: [&str; 15] = [
    "status",
    "wall_clock_s",
    "predicted_s",
    "particles",
    "fluid",
    "wall",
    "shell",
    "acoustic_steps",
    "memory_bytes",
    "spacing_m",
    "sound_speed_m_s",
    "max_density_error",
    "mass_balance_error",
    "wall_s",
    "wall_shear_correlation",
];

fn cell(value: f64) -> String {
    if value.is_finite() { format!("{value}") } else { String::new() }
}

/// How a run of a study ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum StudyStatus {
    /// It came to its end.
    #[default]
    Completed,
    /// It broke down.
    Failed,
    /// Its settings do not go with the case.
    Refused,
    /// The person stopped it.
    Interrupted,
}

impl std::fmt::Display for StudyStatus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Completed => "completed",
            Self::Failed => "failed",
            Self::Refused => "refused",
            Self::Interrupted => "interrupted",
        })
    }
}

/// One run of a study.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct StudyRun {
    /// Its name, which is that of its folder in `OUT/runs`.
    pub name: String,
    /// What varies in its ladder, such as `spacing`.
    pub ladder: String,
    /// What the case was run with, as for `--set`.
    pub settings: Vec<[String; 2]>,
    /// How it ended.
    pub status: StudyStatus,
    /// Why, where it did not complete.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
    /// Wall time, making of particles and files included \[s\]; the median where it was run several times.
    #[serde(deserialize_with = "json::number")]
    pub wall_clock_s: f64,
    /// What the planner had expected \[s\].
    #[serde(deserialize_with = "json::number")]
    pub predicted_s: f64,
    /// Particles.
    pub particles: ParticleCounts,
    /// Steps.
    pub steps: StepCounts,
    /// Memory of all effects \[bytes\].
    pub memory_bytes: u64,
    /// Spacing \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Sound speed \[m/s\].
    #[serde(deserialize_with = "json::number")]
    pub sound_speed_m_s: f64,
    /// Largest relative deviation of the density \[-\].
    #[serde(deserialize_with = "json::number")]
    pub max_density_error: f64,
    /// Inflow less outflow, of the inflow \[-\].
    #[serde(deserialize_with = "json::number")]
    pub mass_balance_error: f64,
    /// Time in a wall that deforms: its motion, and what lies between it and the blood \[s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_s: Option<f64>,
    /// Correlation of the wall shear stress, point by point, with that of the run of the ladder of spacings at the same spacing \[-\]; absent
    /// where either told none, and for those of that ladder.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_shear_correlation: Option<f64>,
    /// What was measured \[SI\].
    pub values: Vec<NamedValue>,
    /// Errors, as shares \[-\]; `worst` last.
    pub errors: Vec<NamedValue>,
}

impl StudyRun {
    fn numbers(&self) -> [String; NUMBERS.len()] {
        let ParticleCounts { fluid, wall, shell } = self.particles;
        [
            self.status.to_string(),
            cell(self.wall_clock_s),
            cell(self.predicted_s),
            self.particles.total().to_string(),
            fluid.to_string(),
            wall.to_string(),
            shell.to_string(),
            self.steps.acoustic.to_string(),
            self.memory_bytes.to_string(),
            cell(self.spacing_m),
            cell(self.sound_speed_m_s),
            cell(self.max_density_error),
            cell(self.mass_balance_error),
            cell(self.wall_s.unwrap_or(f64::NAN)),
            cell(self.wall_shear_correlation.unwrap_or(f64::NAN)),
        ]
    }

    /// An error by its name; NaN where there is none.
    pub fn error(&self, name: &str) -> f64 {
        self.errors.iter().find(|e| e.name == name).map_or(f64::NAN, |e| e.value)
    }
}

/// A number with its name.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct NamedValue {
    /// The name.
    pub name: String,
    /// The number; `null` where there is none.
    #[serde(deserialize_with = "json::number")]
    pub value: f64,
}

/// What the ladder of spacings tells of an error.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ErrorEntry {
    /// Its name.
    pub name: String,
    /// Order at which it falls with the spacing \[-\]; absent where it does not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub order: Option<f64>,
    /// Exponent of the time in the spacing \[-\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_exponent: Option<f64>,
    /// Factor of time that half the error costs \[-\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub halving: Option<f64>,
    /// Uncertainty of the finest value, as a share of it \[-\] (grid convergence index); absent where the value is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub uncertainty: Option<f64>,
    /// How the values go together, in words.
    pub trend: String,
    /// What errors of 5, 2 and 1 % cost.
    pub prices: Vec<PriceEntry>,
}

/// What an error costs.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PriceEntry {
    /// The error, as a share \[-\].
    #[serde(deserialize_with = "json::number")]
    pub error: f64,
    /// Spacing it takes \[m\].
    #[serde(deserialize_with = "json::number")]
    pub spacing_m: f64,
    /// Wall time it takes \[s\].
    #[serde(deserialize_with = "json::number")]
    pub wall_clock_s: f64,
    /// Whether the spacing lies outside what was run by more than a third.
    pub is_extrapolated: bool,
}

/// What was asked for, and what came of it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GoalEntry {
    /// Error asked for, as a share \[-\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<f64>,
    /// Wall time asked for \[s\].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub budget_s: Option<f64>,
    /// Name of the run that answers it; absent where none does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run: Option<String>,
    /// Whether it was met: the error within half and one and a half of that asked for, the time not above it.
    pub met: bool,
    /// What came of it, in words.
    pub verdict: String,
}

json::file!(StudyReport);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_its_settings_and_errors_by_name_and_quotes_what_has_commas() {
        let named = |name: &str, value| NamedValue { name: name.into(), value };
        let setting = |key: &str, value: &str| [key.to_owned(), value.to_owned()];
        let run = StudyRun {
            name: "a".into(),
            ladder: "spacing".into(),
            settings: vec![setting("particles.spacing", "1 mm")],
            wall_clock_s: 1.5,
            values: vec![named("p", 20.0)],
            errors: vec![named("p", f64::NAN), named("worst", 0.25)],
            ..StudyRun::default()
        };
        let failed = StudyRun {
            name: "b".into(),
            settings: vec![setting("wall.model", "shell")],
            status: StudyStatus::Failed,
            message: Some("broke, early".into()),
            ..StudyRun::default()
        };
        let csv = StudyReport { runs: vec![run, failed], ..StudyReport::default() }.to_csv();
        let mut rows = csv::Reader::from_reader(csv.as_bytes());
        let header = rows.headers().expect("a header").clone();
        let rows: Vec<csv::StringRecord> =
            rows.records().map(|row| row.expect("as long as the header")).collect();
        let at = |row: usize, name: &str| {
            let column =
                header.iter().position(|h| h == name).unwrap_or_else(|| panic!("{name} in {header:?}"));
            rows[row][column].to_owned()
        };
        assert_eq!(at(0, "particles.spacing"), "1 mm");
        assert_eq!(
            (at(0, "error_p"), at(0, "error_worst"), at(0, "value_p")),
            ("".into(), "0.25".into(), "20".into())
        );
        assert_eq!((at(1, "status"), at(1, "wall.model")), ("failed".into(), "shell".into()));
        assert_eq!((at(1, "message"), at(1, "error_worst")), ("broke, early".into(), "".into()));
    }
}

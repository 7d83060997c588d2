//! How far off the results of a run are, where a study of the same case tells.

use crate::html::{Column, escape, prose, table};
use crate::scale::number;
use std::path::Path;
use vaso_io::{ErrorEntry, StudyReport, StudyRun, StudyStatus, Summary};

/// What a study beside the run says of its errors.
pub(crate) enum Accuracy {
    /// No study has been made.
    Unknown,
    /// There is one, but not of this case: why.
    Other(String),
    /// There is one of this case.
    Studied(Box<StudyReport>),
}

/// Way from the folder of a run to the study of its case, where both lie where they do by default.
const STUDY: &str = "../study/study.json";
/// Spacings a law is trusted beyond what was run, as where prices are told.
const TRUST: f64 = 4.0 / 3.0;

impl Accuracy {
    /// Looks for the study of the case whose run is in the folder `out`.
    pub(crate) fn of(out: &Path, summary: &Summary) -> Self {
        let path = out.join(STUDY);
        if !path.exists() {
            return Self::Unknown;
        }
        match StudyReport::read(&path) {
            Err(error) => Self::Other(error.to_string()),
            Ok(study) => match difference(&study.identity, &summary.identity) {
                Some(what) => Self::Other(what),
                None => Self::Studied(Box::new(study)),
            },
        }
    }

    /// The section of the page; empty where there is no study.
    pub(crate) fn section(&self, summary: &Summary) -> String {
        match self {
            Self::Unknown => String::new(),
            Self::Other(why) => {
                let words = format!("A study lies beside this run and tells nothing of it: {why}.");
                format!("<p class=\"note\">{}</p>\n", prose(&words))
            }
            Self::Studied(study) => errors(study, summary.spacing_m),
        }
    }
}

/// Why a study is not of the case of a run; `None` where it is.
fn difference(studied: &[[String; 2]], run: &[[String; 2]]) -> Option<String> {
    if studied.is_empty() || run.is_empty() {
        return Some("one of them does not say what case it is of".to_owned());
    }
    let other: Vec<String> =
        run.iter().filter(|entry| !studied.contains(entry)).map(|[name, _]| format!("`{name}`")).collect();
    (!other.is_empty())
        .then(|| format!("{} of the case said something else when it was made", other.join(", ")))
}

fn errors(study: &StudyReport, spacing: f64) -> String {
    let columns = [
        Column::Words("error of"),
        Column::Numbers("expected here", "%"),
        Column::Numbers("half of it costs", "times the time"),
        Column::Words("how it is known"),
    ];
    let row = |entry: &ErrorEntry| {
        let (error, how) = expected(study, entry, spacing);
        let factor = entry.halving.map_or("–".into(), |x| number(x, 3));
        vec![escape(&entry.name), error.map_or("–".into(), |e| number(100.0 * e, 3)), factor, escape(&how)]
    };
    let rows: Vec<Vec<String>> = study.errors.iter().map(row).collect();
    let caption = format!("Errors expected at a spacing of {} mm", number(1e3 * spacing, 3));
    let words = format!(
        "By <code>study/study.json</code>, which ran this case at several spacings. Errors are counted from {}.",
        prose(&study.reference)
    );
    format!("<p>{words}</p>\n{}", table(&caption, &columns, &rows))
}

/// The error of a run at a spacing \[m\], and how it is known.
fn expected(study: &StudyReport, entry: &ErrorEntry, spacing: f64) -> (Option<f64>, String) {
    let rungs: Vec<&StudyRun> = study
        .runs
        .iter()
        .filter(|run| run.ladder == "spacing" && run.status == StudyStatus::Completed)
        .collect();
    let same = |run: &&&StudyRun| (run.spacing_m / spacing - 1.0).abs() < 1e-6;
    let measured = rungs.iter().find(same).map(|run| run.error(&entry.name)).filter(|e| e.is_finite());
    if measured.is_some() {
        return (measured, "measured at this spacing".into());
    }
    let (Some(order), Some(price)) = (entry.order, entry.prices.first()) else {
        let uncertainty =
            entry.uncertainty.map_or(String::new(), |u| format!("; uncertain by {} %", number(100.0 * u, 3)));
        return (None, format!("{}{uncertainty}", entry.trend));
    };
    let low = rungs.iter().map(|run| run.spacing_m).fold(f64::INFINITY, f64::min);
    let high = rungs.iter().map(|run| run.spacing_m).fold(0.0, f64::max);
    let error = price.error * (spacing / price.spacing_m).powf(order);
    let how = match (low / TRUST..=high * TRUST).contains(&spacing) {
        true => format!("law of order {} between what was run", number(order, 3)),
        false => format!("law of order {}, far outside of what was run", number(order, 3)),
    };
    (Some(error), how)
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_io::{NamedValue, PriceEntry};

    fn identity(wall: &str) -> Vec<[String; 2]> {
        [["blood", "1"], ["wall", wall]].map(|e| e.map(str::to_owned)).to_vec()
    }

    fn study() -> StudyReport {
        let run = |spacing_m: f64| StudyRun {
            ladder: "spacing".into(),
            spacing_m,
            errors: vec![NamedValue { name: "flow".into(), value: 1e4 * spacing_m * spacing_m }],
            ..StudyRun::default()
        };
        let price = PriceEntry { error: 0.01, spacing_m: 1e-3, ..PriceEntry::default() };
        StudyReport {
            identity: identity("rigid"),
            reference: "Poiseuille".into(),
            runs: vec![run(2e-3), run(1e-3)],
            errors: vec![ErrorEntry {
                name: "flow".into(),
                order: Some(2.0),
                halving: Some(4.0),
                prices: vec![price],
                ..ErrorEntry::default()
            }],
            ..StudyReport::default()
        }
    }

    #[test]
    fn errors_follow_from_the_law_or_from_the_run_itself() {
        let study = study();
        let of = |spacing: f64| expected(&study, &study.errors[0], spacing);
        let (error, how) = of(2e-3);
        assert!((error.unwrap() - 0.04).abs() < 1e-12 && how.contains("measured"), "{how}");
        let (error, how) = of(1.5e-3);
        assert!((error.unwrap() - 0.0225).abs() < 1e-12 && how.contains("between"), "{how}");
        assert!(of(0.5e-3).1.contains("outside"));
    }

    #[test]
    fn a_study_of_another_case_tells_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let summary =
            |wall: &str| Summary { identity: identity(wall), spacing_m: 2e-3, ..Summary::default() };
        std::fs::create_dir_all(folder.path().join("study")).unwrap();
        std::fs::create_dir_all(&out).unwrap();
        assert_eq!(Accuracy::of(&out, &summary("rigid")).section(&summary("rigid")), "");
        study().write(&folder.path().join("study/study.json")).unwrap();
        let text = Accuracy::of(&out, &summary("rigid")).section(&summary("rigid"));
        assert!(text.contains("Poiseuille") && text.contains("measured at this spacing"), "{text}");
        let text = Accuracy::of(&out, &summary("shell")).section(&summary("shell"));
        assert!(text.contains("wall") && text.contains("something else"), "{text}");
    }
}

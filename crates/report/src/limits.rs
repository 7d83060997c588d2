//! What a run does not prove, said next to its results.

use crate::accuracy::Accuracy;
use crate::html::prose;
use vaso_io::{EffectEntry, EndReason, PressureDropSummary, Status, Summary};

/// The list of limits, those that always hold and those this run brought on itself.
pub(crate) fn limits(summary: &Summary, accuracy: &Accuracy) -> String {
    let items: Vec<String> =
        limits_of(summary, accuracy).iter().map(|limit| format!("<li>{}</li>", prose(limit))).collect();
    format!("<ul class=\"limits\">{}</ul>\n", items.concat())
}

fn limits_of(summary: &Summary, accuracy: &Accuracy) -> Vec<String> {
    let mut limits = Vec::new();
    if summary.status != Status::Completed {
        limits.push(format!(
            "The run is {} and did not reach its end time: means and extremes cover only what was computed.",
            summary.status
        ));
    }
    let one_spacing = match accuracy {
        Accuracy::Studied(_) => {
            "One spacing is one point: what a finer one would change is known from the study alone, and for the quantities in it."
        }
        Accuracy::Unknown | Accuracy::Other(_) => {
            "One spacing is one point: this page says nothing about what a finer spacing would change. `vaso study` measures that."
        }
    };
    limits.push(one_spacing.to_owned());
    limits.push(format!(
        "Blood is treated as weakly compressible with a sound speed of {} m/s, far below the real one. Pressure waves in \
         the fluid are therefore slow; speeds well below it are what the method is made for.",
        crate::scale::number(summary.sound_speed_m_s, 3)
    ));
    for effect in summary.effects.iter().filter(|effect| effect.called_for && !effect.on) {
        limits.push(format!("`{}` is off although the scene calls for it: {}.", effect.name, effect.reason));
    }
    let deforms = summary
        .effects
        .iter()
        .any(|effect| effect.on && ["wall.shell", "wall.solid"].contains(&effect.name.as_str()));
    if !deforms {
        limits.push(
            "The wall does not move: no pulse wave travels along it, and the vessel stores no blood."
                .to_owned(),
        );
    }
    limits.push(
        "Openings are idealised: the velocity profile and the outlet models are inputs, not findings, and values within a few \
         diameters of an opening reflect them."
            .to_owned(),
    );
    if let Some(limit) = unlike_cycles(summary) {
        limits.push(limit);
    }
    let has_shear = |effect: &EffectEntry| effect.on && effect.name == "metrics.wall_shear";
    if summary.wall.is_some() || summary.effects.iter().any(has_shear) {
        limits.push(
            "Wall shear stress is fitted to the particles within about 2.6 spacings of the wall. Where the boundary layer is \
             not much thicker than that it lags behind the flow and is too weak; `docs/theory/metrics.md` says by how much."
                .to_owned(),
        );
    }
    let has_reserve = |drop: &PressureDropSummary| drop.fractional_flow_reserve.is_some();
    if summary.cycles.iter().flat_map(|cycle| &cycle.pressure_drops).any(has_reserve) {
        limits.push(
            "Fractional flow reserve is a clinical number only where the pressures are physiological and the flow is that of \
             hyperaemia; here it is the ratio of two computed pressures."
                .to_owned(),
        );
    }
    limits.push(
        "Pictures show one instant, and those of indices the last whole cycle, with colours clipped at the outer per cent of \
         the values; the numbers are in the files beside this page."
            .to_owned(),
    );
    limits.push(
        "The geometry is taken as given. Errors of imaging and segmentation are usually larger than \
         those of the flow computation."
            .to_owned(),
    );
    limits.push("This is a research tool. It is not made or approved for medical decisions.".to_owned());
    limits
}

/// Largest change between cycles that still count as alike, in per cent.
const ALIKE: f64 = 1.0;

/// Says that the last cycle was not like the one before, or that there was none to compare it with.
fn unlike_cycles(summary: &Summary) -> Option<String> {
    let last = summary.cycles.last()?;
    if summary.end_reason == Some(EndReason::Periodic) {
        return None;
    }
    let Some(change) = last.periodicity else {
        return Some(
            "There is one whole cycle only, so nothing says whether the next would be like it.".to_owned(),
        );
    };
    let largest = 100.0 * change.flow.max(change.pressure);
    (largest > ALIKE).then(|| {
        format!(
            "The last two cycles differ by up to {} % of the range of a flow or pressure: means and indices have not \
             settled.",
            crate::scale::number(largest, 2)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_io::{CycleSummary, PeriodicitySummary};

    #[test]
    fn cycles_that_are_not_alike_are_said() {
        let cycle = |flow| CycleSummary {
            periodicity: Some(PeriodicitySummary { flow, pressure: 0.002, wall_shear: None }),
            ..Default::default()
        };
        let said = |cycles: Vec<CycleSummary>| unlike_cycles(&Summary { cycles, ..Default::default() });
        assert_eq!(said(Vec::new()), None);
        assert_eq!(said(vec![cycle(0.2), cycle(0.004)]), None);
        let text = said(vec![cycle(0.004), cycle(0.031)]).unwrap();
        assert!(text.contains("3.1 %"), "{text}");
        assert!(said(vec![CycleSummary::default()]).unwrap().contains("one whole cycle"));
    }

    #[test]
    fn what_the_run_left_out_is_said() {
        let shell = EffectEntry {
            name: "wall.shell".into(),
            called_for: true,
            reason: "strain of 6 %".into(),
            ..Default::default()
        };
        let mut summary = Summary { status: Status::Failed, effects: vec![shell], ..Default::default() };
        let text = limits_of(&summary, &Accuracy::Unknown).join("\n");
        assert!(text.contains("failed") && text.contains("`wall.shell` is off"), "{text}");
        assert!(text.contains("wall does not move"), "{text}");

        summary.status = Status::Completed;
        summary.effects[0].on = true;
        let text = limits_of(&summary, &Accuracy::Unknown).join("\n");
        assert!(!text.contains("wall does not move") && !text.contains("is off"), "{text}");
    }
}

//! What a run does not prove, said next to its results.

use crate::html::prose;
use vaso_io::{Status, Summary};

/// The list of limits, those that always hold and those this run brought on itself.
pub(crate) fn limits(summary: &Summary) -> String {
    let items: Vec<String> =
        limits_of(summary).iter().map(|limit| format!("<li>{}</li>", prose(limit))).collect();
    format!("<ul class=\"limits\">{}</ul>\n", items.concat())
}

fn limits_of(summary: &Summary) -> Vec<String> {
    let mut limits = Vec::new();
    if summary.status != Status::Completed {
        limits.push(format!(
            "The run is {} and did not reach its end time: means and extremes cover only what was computed.",
            summary.status
        ));
    }
    limits.push(
        "One spacing is one point: this page says nothing about what a finer spacing would change. \
         `vaso study` measures that."
            .to_owned(),
    );
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
    limits.push(
        "Pictures show one instant, with colours clipped at the outer per cent of the values; \
         the numbers are in the files beside this page."
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

#[cfg(test)]
mod tests {
    use super::*;
    use vaso_io::EffectEntry;

    #[test]
    fn what_the_run_left_out_is_said() {
        let shell = EffectEntry {
            name: "wall.shell".into(),
            called_for: true,
            reason: "strain of 6 %".into(),
            ..Default::default()
        };
        let mut summary = Summary { status: Status::Failed, effects: vec![shell], ..Default::default() };
        let text = limits_of(&summary).join("\n");
        assert!(text.contains("failed") && text.contains("`wall.shell` is off"), "{text}");
        assert!(text.contains("wall does not move"), "{text}");

        summary.status = Status::Completed;
        summary.effects[0].on = true;
        let text = limits_of(&summary).join("\n");
        assert!(!text.contains("wall does not move") && !text.contains("is off"), "{text}");
    }
}

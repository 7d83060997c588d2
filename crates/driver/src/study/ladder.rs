//! What a study varies: one setting at a time, along ladders.

use crate::case::Case;
use crate::error::DriverError;
use crate::plan::Plan;
use vaso_scene::material::Viscosity;
use vaso_scene::{Condition, Field, Generator, Precision, Scene, Wall, Word};

/// Settings of a case, as for `--set`.
pub(crate) type Settings = Vec<(String, String)>;

/// A run that a study makes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variant {
    /// The ladder it is a rung of.
    pub(crate) ladder: String,
    /// Its name, fit for a folder.
    pub(crate) name: String,
    /// Settings laid over those of the person.
    pub(crate) settings: Settings,
}

/// Ladders by name, in the order they are climbed.
const LADDERS: &[&str] =
    &["spacing", "sound-speed", "precision", "operators", "generator", "wall", "viscosity", "coupling"];
/// Name of the first ladder, which orders and prices come from.
pub(crate) const SPACING: &str = "spacing";
/// Spacings of the default ladder over that of the case: each refinement is by 1.3, the least that Celik et al. 2008 advise.
const FACTORS: [f64; 3] = [1.69, 1.3, 1.0];
/// Sound speeds of the ladder over that of the plan.
const SOUND_SPEEDS: [f64; 2] = [0.5, 2.0];
/// Window of an outlet model that takes up the flow once a window, over the period; and without one \[s\], as published.
const WINDOW: (f64, f64) = (0.01, 6e-3);

/// Which ladders are climbed.
#[derive(Clone, Debug, Default)]
pub struct Wish {
    /// Names of ladders, `None` for all that the case calls for.
    pub ladders: Option<Vec<String>>,
    /// Spacings \[m\] in place of those of the default ladder.
    pub spacings: Option<Vec<f64>>,
    /// Keys with values in place of all ladders but that of the spacing.
    pub vary: Vec<(String, Vec<String>)>,
}

impl Wish {
    /// Names of ladders out of a list.
    ///
    /// # Errors
    /// When a name is not that of a ladder.
    pub fn ladders(list: &str) -> Result<Vec<String>, String> {
        list.split(',')
            .map(str::trim)
            .map(|name| match LADDERS.contains(&name) {
                true => Ok(name.to_owned()),
                false => Err(format!("\"{name}\" is no ladder; allowed: {}", LADDERS.join(", "))),
            })
            .collect()
    }

    fn wants(&self, ladder: &str) -> bool {
        match &self.ladders {
            Some(named) => named.iter().any(|name| name == ladder),
            None => self.vary.is_empty() || ladder == SPACING,
        }
    }
}

/// The default ladder around `own` \[m\], which is expected to take `seconds`, made finer or coarser so that all of it is expected to
/// take `allowed` seconds: the time goes with the fourth power.
pub(crate) fn within(own: f64, seconds: f64, allowed: f64) -> Vec<f64> {
    let all: f64 = FACTORS.iter().map(|f| f.powi(-4)).sum();
    let scale = (all * seconds / allowed).powf(0.25);
    FACTORS.map(|f| f * scale * own).to_vec()
}

/// A spacing as a setting.
pub(crate) fn spacing_setting(spacing: f64) -> (String, String) {
    ("particles.spacing".into(), format!("{} m", rounded(spacing)))
}

/// A rung of the ladder of spacings.
pub(crate) fn at_spacing(spacing: f64) -> Variant {
    let spacing = rounded(spacing);
    let name = format!("spacing-{:.4}mm", 1e3 * spacing);
    Variant { ladder: SPACING.into(), name, settings: vec![spacing_setting(spacing)] }
}

/// Five digits: what a name and a table show is what is run.
fn rounded(spacing: f64) -> f64 {
    format!("{spacing:.4e}").parse().unwrap_or(spacing)
}

/// The rungs of all ladders, that of the spacing first, coarse to fine; the others vary one setting each at its middle.
/// `is_known` tells that errors are counted from known values, which models of other physics do not have.
///
/// # Errors
/// When the case cannot be planned at the spacing at which the others are varied.
pub(crate) fn climb(case: &Case, wish: &Wish, is_known: bool) -> Result<Vec<Variant>, DriverError> {
    let own = case.scene.particles.spacing;
    let mut spacings = wish.spacings.clone().unwrap_or_else(|| FACTORS.map(|f| f * own).to_vec());
    spacings.sort_by(|a, b| b.total_cmp(a));
    spacings.dedup();
    let middle = spacings[spacings.len() / 2];
    let mut variants: Vec<Variant> = spacings.into_iter().map(at_spacing).collect();
    let at_middle = with(case, &[spacing_setting(middle)])?;
    let plan = Plan::new(&at_middle)?;
    let mut add = |ladder: &str, what: &str, mut settings: Settings| {
        let name = format!("{ladder}-{}", safe(what));
        settings.insert(0, spacing_setting(middle));
        variants.push(Variant { ladder: ladder.to_owned(), name, settings });
    };
    for ladder in LADDERS.iter().filter(|ladder| wish.wants(ladder)) {
        for (what, settings) in rungs(ladder, &at_middle, &plan, is_known && wish.ladders.is_none()) {
            add(ladder, &what, settings);
        }
    }
    for (key, values) in &wish.vary {
        for value in values {
            add(key, value, vec![(key.clone(), value.clone())]);
        }
    }
    Ok(variants)
}

/// The case with settings laid over its own.
pub(crate) fn with(case: &Case, settings: &[(String, String)]) -> Result<Case, DriverError> {
    let all: Settings = case.overrides.iter().chain(settings).cloned().collect();
    Case::load(&case.scene.file, &all)
}

/// What the rungs of a ladder change; nothing where the scene does not call for it.
fn rungs(ladder: &str, case: &Case, plan: &Plan, same_physics: bool) -> Vec<(String, Settings)> {
    let scene = &case.scene;
    let one = |key: &str, value: &str| vec![(key.to_owned(), value.to_owned())];
    match ladder {
        "sound-speed" => SOUND_SPEEDS
            .iter()
            .map(|f| {
                let speed = format!("{:.4} m/s", f * plan.numbers.sound_speed);
                (format!("{f}c"), one("numerics.sound_speed", &speed))
            })
            .collect(),
        "precision" => {
            let other = match plan.precision {
                Precision::Mixed => Precision::Double,
                Precision::Double => Precision::Mixed,
            };
            vec![(other.word().to_owned(), one("numerics.precision", other.word()))]
        }
        "operators" if scene.numerics.gradient_correction => {
            vec![("plain".to_owned(), one("numerics.gradient_correction", "false"))]
        }
        "operators" => vec![("corrected".to_owned(), one("numerics.gradient_correction", "true"))],
        "generator" => {
            let other = match scene.particles.generator {
                Generator::RelaxedLattice(_) => "multiblock",
                Generator::Multiblock(_) => "relaxed-lattice",
            };
            vec![(other.to_owned(), one("particles.generator", other))]
        }
        "wall" => {
            let others: &[&str] = match &scene.wall {
                Wall::Rigid => &["rigid-shell"],
                Wall::RigidShell => &["rigid"],
                Wall::Shell(_) if same_physics => &["solid"],
                Wall::Solid(_) if same_physics => &["shell"],
                Wall::Shell(_) => &["solid", "rigid"],
                Wall::Solid(_) => &["shell", "rigid"],
            };
            let settings = |model: &str| match model {
                "rigid" if !matches!(scene.wall, Wall::RigidShell) => at_rest(scene),
                _ => one("wall.model", model),
            };
            others.iter().map(|model| ((*model).to_owned(), settings(model))).collect()
        }
        "viscosity" if same_physics => Vec::new(),
        "viscosity" => {
            let other = match scene.blood.as_ref().map(|blood| &blood.viscosity) {
                Some(Viscosity::Newtonian { .. }) => "{ model = \"carreau-yasuda\" }",
                _ => "{ model = \"newtonian\" }",
            };
            let name = other.split('"').nth(1).unwrap_or(other);
            vec![(name.to_owned(), one("blood.viscosity", other))]
        }
        "coupling" => {
            let window = plan.period.map_or(WINDOW.1, |period| WINDOW.0 * period);
            let models = scene.openings.iter().filter(|o| {
                matches!(o.condition, Condition::Resistance { .. } | Condition::Windkessel { .. })
            });
            let settings: Settings = models
                .flat_map(|o| {
                    let key = |name: &str| format!("opening.{}.{name}", o.name);
                    [
                        (key("coupling"), "window".to_owned()),
                        (key("window"), format!("{:.4} ms", 1e3 * window)),
                    ]
                })
                .collect();
            if settings.is_empty() { Vec::new() } else { vec![("window".to_owned(), settings)] }
        }
        _ => Vec::new(),
    }
}

/// Settings that put a wall at rest which deforms. What a case says of its tissue, and the fields that only such a wall has, would be refused.
fn at_rest(scene: &Scene) -> Settings {
    let fields = scene.output.fields.iter().filter(|f| !matches!(f, Field::Displacement | Field::VonMises));
    let fields: Vec<String> = fields.map(|field| format!("\"{}\"", field.word())).collect();
    vec![
        ("wall".into(), "{ model = \"rigid\" }".into()),
        ("output.fields".into(), format!("[{}]", fields.join(", "))),
    ]
}

/// A text as part of the name of a folder.
fn safe(text: &str) -> String {
    let kept = text.chars().map(|c| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '-' });
    kept.collect::<String>().trim_matches('-').to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_fit_for_folders_and_spacings_are_what_they_say() {
        assert_eq!(safe("{ model = \"casson\" }"), "model----casson");
        let rung = at_spacing(3.968_751_234e-4);
        assert_eq!(rung.name, "spacing-0.3969mm");
        assert_eq!(rung.settings, [("particles.spacing".to_owned(), "0.00039688 m".to_owned())]);
    }

    /// Of a wall that deforms all that is said of its tissue would be refused for one at rest.
    #[test]
    fn every_rung_of_the_walls_can_be_planned() {
        let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/common-carotid");
        let case = Case::load(&file, &[]).expect("it is a case");
        let wish = Wish { ladders: Some(vec!["wall".into()]), ..Wish::default() };
        let variants = climb(&case, &wish, false).expect("it can be planned");
        let rungs: Vec<&Variant> = variants.iter().filter(|v| v.ladder == "wall").collect();
        let names: Vec<&str> = rungs.iter().map(|v| v.name.as_str()).collect();
        assert_eq!(names, ["wall-solid", "wall-rigid"]);
        for variant in rungs {
            let changed = with(&case, &variant.settings).unwrap_or_else(|e| panic!("{}: {e}", variant.name));
            Plan::new(&changed).unwrap_or_else(|e| panic!("{}: {e}", variant.name));
        }
    }

    #[test]
    fn ladders_are_named() {
        assert_eq!(Wish::ladders("spacing, wall").expect("both are"), ["spacing", "wall"]);
        assert!(Wish::ladders("spacings").expect_err("no such").contains("sound-speed"));
        let wish = Wish { vary: vec![("a".into(), vec![])], ..Wish::default() };
        assert!(wish.wants(SPACING) && !wish.wants("wall") && Wish::default().wants("wall"));
    }
}

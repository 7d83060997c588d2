//! What of a case its results depend on, to tell whether it is still the same.

use crate::material::Wall;
use crate::opening::{Condition, Drive};
use crate::scene::{Output, Scene};

impl Scene {
    /// Each table of the case with a text of all that the results of a run depend on. Two texts are equal exactly where all values are,
    /// down to the last bit; how and where they were written, the title and the interval of checkpoints do not count. The surface
    /// is not part of it, only the unit of its coordinates.
    pub fn contents(&self) -> Vec<(&'static str, String)> {
        let mut openings = self.openings.clone();
        for opening in &mut openings {
            match &mut opening.condition {
                Condition::Velocity { value, .. }
                | Condition::Flow { value, .. }
                | Condition::Pressure { value } => forget_file(value),
                Condition::Resistance { .. } | Condition::Windkessel { .. } => {}
            }
        }
        let mut wall = self.wall.clone();
        if let Wall::Solid(elastic) | Wall::Shell(elastic) = &mut wall {
            elastic.pressure.iter_mut().for_each(forget_file);
        }
        let output = Output { checkpoint_every: None, ..self.output.clone() };
        // The shortest digits of a number lead back to its bits.
        vec![
            ("geometry.unit", format!("{:?}", self.geometry.unit)),
            ("particles", format!("{:?}", self.particles)),
            ("blood", format!("{:?}", self.blood)),
            ("wall", format!("{wall:?} {:?}", self.wall_body)),
            ("opening", format!("{openings:?}")),
            ("probe", format!("{:?}", self.probes)),
            ("numerics", format!("{:?}", self.numerics)),
            ("run", format!("{:?}", self.run)),
            ("output", format!("{output:?}")),
        ]
    }
}

/// A waveform is what it says, wherever it says it.
fn forget_file(drive: &mut Drive) {
    if let Drive::Waveform(waveform) = drive {
        waveform.file.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    const CASE: &str = "
        [geometry]
        surface = \"pipe.stl\"
        unit = \"mm\"
        [particles]
        spacing = \"0.5 mm\"
        [blood]
        [[opening]]
        name = \"in\"
        near = [0, 0, 0]
        condition = \"velocity\"
        waveform = \"in.csv\"
        [[opening]]
        name = \"out\"
        near = [0, 0, 1]
        condition = \"pressure\"
        [run]
        period = \"1 s\"
        cycles = 2
    ";

    fn contents(text: &str, setting: Option<(&str, &str)>, waveform: &str) -> Vec<(&'static str, String)> {
        let set: Vec<(String, String)> = setting.iter().map(|(k, v)| ((*k).into(), (*v).into())).collect();
        let files = ["pipe.stl", "in.csv", "other.csv"].map(|name| (name.into(), waveform.to_owned()));
        Scene::parse(text, &set, &BTreeMap::from(files)).expect("a sound case").contents()
    }

    #[test]
    fn values_count_and_how_they_were_written_does_not() {
        let wave = "0,0.1\n0.5,0.2\n1,0.1\n";
        let whole = contents(CASE, None, wave);
        let changed = |other: Vec<(&'static str, String)>| -> Vec<&'static str> {
            let pairs = whole.iter().zip(other);
            pairs.filter(|(a, b)| **a != *b).map(|(a, _)| a.0).collect()
        };
        let rewritten = CASE.replace("0.5 mm", "500 um").replace("[blood]", "# blood\n[blood]");
        assert!(changed(contents(&rewritten, None, wave)).is_empty());
        assert!(changed(contents(&CASE.replace("in.csv", "other.csv"), None, wave)).is_empty());
        assert!(changed(contents(CASE, Some(("output.checkpoint_every", "1 ms")), wave)).is_empty());
        assert_eq!(changed(contents(CASE, Some(("particles.spacing", "0.50001 mm")), wave)), ["particles"]);
        assert_eq!(changed(contents(CASE, None, &wave.replace("0.2", "0.20000001"))), ["opening"]);
    }
}

//! The published inflow curves that come with the validation data.

use std::path::Path;

use vaso_scene::{Condition, Drive, Scene};

#[test]
fn published_inflow_curves_are_read_as_one_period() {
    let Some(data) = std::env::var_os("VASO_DATA") else {
        println!("skipped: VASO_DATA is not set");
        return;
    };
    // File, condition, period as tabulated with the data, rows of the file that are left, and the mean over the
    // period given with them.
    let table = [
        ("cca_boileau2015.csv", "flow", "1.1 s", 99, 6.5e-6),
        ("aorta_invitro_matthys2007.csv", "flow", "0.821 s", 200, 5.2e-5),
        ("aorta_upper_thoracic_boileau2015.csv", "flow", "0.955 s", 99, 1.031e-4),
        ("carotid_inlet_velocity_sphinxsys.csv", "velocity", "0.7568 s", 200, 0.3782),
        ("aorta_vmr0024_inlet_velocity_sphinxsys.csv", "velocity", "0.66 s", 200, 0.2051),
    ];
    for (file, condition, period, rows, mean) in table {
        let path = Path::new(&data).join("waveforms").join(file);
        let opening = format!(
            "{{ name = \"inlet\", near = [0, 0, 0], condition = {condition:?}, waveform = {:?} }}",
            path.to_str().unwrap()
        );
        let outlet = "{ name = \"outlet\", near = [0, 0, 1], condition = \"pressure\" }";
        let overrides = [
            ("opening".to_owned(), format!("[{opening}, {outlet}]")),
            ("run".to_owned(), format!("{{ cycles = 1, period = {period:?} }}")),
        ];
        let scene = Scene::load(Path::new("tests/good/smallest.toml"), &overrides).unwrap();
        let (Condition::Flow { value, .. } | Condition::Velocity { value, .. }) =
            &scene.openings[0].condition
        else {
            panic!("{:?}", scene.openings[0].condition)
        };
        let Drive::Waveform(waveform) = value else { panic!("a constant") };
        assert_eq!(waveform.time.len(), rows, "{file}");
        // Trapezoidal rule over the closed period.
        let period = waveform.period.unwrap();
        let area: f64 = (0..rows)
            .map(|i| {
                let next = (i + 1) % rows;
                let width = (waveform.time[next] - waveform.time[i]).rem_euclid(period);
                0.5 * width * (waveform.value[i] + waveform.value[next])
            })
            .sum();
        assert!((area / period / mean - 1.0).abs() < 0.01, "{file}: mean {}", area / period);
    }
}

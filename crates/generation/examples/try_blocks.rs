use std::time::Instant;
use vaso_generation::{Settings, multiblock};
use vaso_geometry::{LengthUnit, prepare, read_surface};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let unit = match args[2].as_str() {
        "mm" => LengthUnit::Millimetre,
        "cm" => LengthUnit::Centimetre,
        _ => LengthUnit::Metre,
    };
    let vessel = prepare(read_surface(args[1].as_ref()).unwrap(), Some(unit)).unwrap();
    let dp: f64 = args[3].parse::<f64>().unwrap() * 1e-3;
    let topology = match args[4].as_str() {
        "single" => multiblock::Topology::Single,
        "nine" => multiblock::Topology::NineBlock,
        _ => multiblock::Topology::OGrid,
    };
    let sweeps = args.get(5).map_or(0, |s| s.parse().unwrap());
    let start = Instant::now();
    let m = multiblock::fluid(
        &vessel,
        &Settings::new(dp),
        &multiblock::Options { topology, smoothing_sweeps: sweeps },
        &mut |_, _| {},
    )
    .unwrap();
    println!("{:.2} s {:?}\n{:#?}", start.elapsed().as_secs_f64(), m.report, m.body.quality);
    let mut v: Vec<f64> = m.body.volume.iter().map(|v| v / dp.powi(3)).collect();
    v.sort_by(f64::total_cmp);
    let n = v.len();
    println!(
        "volume quantiles {:?}",
        [0, n / 100, n / 10, n / 2, 9 * n / 10, 99 * n / 100, n - 1].map(|k| v[k])
    );
    let mut text = String::from("x,y,z,v\n");
    for (x, v) in m.body.position.iter().zip(&m.body.volume) {
        text += &format!("{},{},{},{}\n", x.x, x.y, x.z, v / dp.powi(3));
    }
    std::fs::write("/tmp/blocks.csv", text).unwrap();
}

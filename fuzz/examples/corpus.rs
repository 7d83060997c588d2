//! Writes the part of the corpus that is made from numbers: surfaces in every file format, and heaps of triangles.
//!
//! `cargo run --no-default-features --example corpus` in this folder.

use std::fs;
use std::path::{Path, PathBuf};

use glam::DVec3;
use vaso_geometry::Surface;

#[path = "../../crates/geometry/src/read/samples.rs"]
mod samples;

/// A square duct, the smallest surface with two openings.
fn duct() -> Surface {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let vertices = [0.0, 5.0].iter().flat_map(|&z| corners.map(|[x, y]| DVec3::new(x, y, z))).collect();
    let mut triangles = vec![[0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]];
    triangles.extend((0..4).flat_map(|i| {
        let j = (i + 1) % 4;
        [[i, j, j + 4], [i, j + 4, i + 4]]
    }));
    Surface { vertices, triangles }
}

/// A pipe with rings of `n` vertices at the given heights and radii, open at both ends.
fn rings(n: u32, profile: &[[f64; 2]]) -> Surface {
    let mut surface = Surface::default();
    for &[z, radius] in profile {
        surface.vertices.extend((0..n).map(|i| {
            let (sin, cos) = (f64::from(i) * std::f64::consts::TAU / f64::from(n)).sin_cos();
            DVec3::new(radius * cos, radius * sin, z)
        }));
    }
    for ring in 1..profile.len() as u32 {
        let (below, above) = ((ring - 1) * n, ring * n);
        surface.triangles.extend((0..n).flat_map(|i| {
            let j = (i + 1) % n;
            [[below + i, below + j, above + j], [below + i, above + j, above + i]]
        }));
    }
    surface
}

/// Surfaces with the defects that the repair knows.
fn heaps() -> Vec<(&'static str, Surface)> {
    let pipe = || rings(9, &[[0.0, 2.0], [3.0, 2.0], [6.0, 1.0], [9.0, 2.0]]);
    let changed = |change: &dyn Fn(&mut Surface)| {
        let mut surface = pipe();
        change(&mut surface);
        surface
    };
    vec![
        ("duct", duct()),
        ("open_pipe", pipe()),
        ("turned", changed(&|s| s.triangles.iter_mut().step_by(3).for_each(|t| t.swap(0, 1)))),
        ("holed", changed(&|s| s.triangles.retain(|t| t[0] % 7 != 3))),
        ("doubled", changed(&|s| s.triangles.extend_from_within(5..12))),
        ("membrane", changed(&|s| s.triangles.extend((1..8).map(|i| [9, 9 + i, 10 + i])))),
        ("strip", {
            let mut strip = rings(12, &[[0.0, 3.0], [1.0, 3.0]]);
            strip.triangles[22] = [11, 12, 0];
            strip.triangles[23] = [11, 23, 12];
            strip
        }),
        ("slivers", {
            let mut duct = duct();
            duct.vertices.push(DVec3::new(0.5, 0.0, 0.0));
            duct.triangles.extend([[0, 8, 1], [0, 0, 8]]);
            duct
        }),
        ("torn", {
            // Each triangle with corners of its own, moved a little.
            let (duct, mut torn) = (duct(), Surface::default());
            for corners in &duct.triangles {
                let first = torn.vertices.len() as u32;
                torn.vertices
                    .extend(corners.map(|v| duct.vertices[v as usize] + 1e-6 * f64::from(first % 2)));
                torn.triangles.push([first, first + 1, first + 2]);
            }
            torn
        }),
        ("star", {
            // A loop that crosses itself.
            let mut star = rings(11, &[[0.0, 2.0], [1.0, 1.0]]);
            let turned: Vec<DVec3> = (0..11).map(|i| star.vertices[i * 4 % 11]).collect();
            star.vertices[..11].copy_from_slice(&turned);
            star
        }),
    ]
}

/// The surface as the target `prepare` reads it.
fn heap_bytes(surface: &Surface, unit: u8) -> Vec<u8> {
    let mut bytes = vec![unit, surface.vertices.len() as u8];
    let floats = surface.vertices.iter().flat_map(|v| v.as_vec3().to_array());
    bytes.extend(floats.flat_map(f32::to_le_bytes));
    bytes.extend(surface.triangles.iter().flatten().map(|&v| v as u8));
    bytes
}

fn write(target: &str, name: &str, bytes: &[u8]) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("corpus").join(target);
    fs::create_dir_all(&folder).expect("the folder of the fuzzer can be written");
    fs::write(folder.join(Path::new(name)), bytes).expect("the folder of the fuzzer can be written");
}

fn main() {
    let duct = duct();
    write("stl", "binary.stl", &samples::stl_binary(&duct, b"duct"));
    write("stl", "binary_solid.stl", &samples::stl_binary(&duct, b"solid duct"));
    write("stl", "text.stl", samples::stl_text(&duct).as_bytes());
    write(
        "stl",
        "two_solids.stl",
        format!("\u{feff}{0}{0}", samples::stl_text(&duct).to_uppercase()).as_bytes(),
    );
    for (number, variant) in samples::variants().iter().enumerate().step_by(7) {
        write("vtp", &format!("variant_{number:03}.vtp"), &variant.file(&duct));
    }
    for (number, (name, heap)) in heaps().into_iter().enumerate() {
        write("prepare", name, &heap_bytes(&heap, number as u8 % 5));
    }
}

use glam::DVec3;
use std::time::Instant;
use vaso_geometry::{LengthUnit, Surface, prepare};
fn time(name: &str, s: Surface) {
    let n = s.triangles.len();
    let t = Instant::now();
    let r = prepare(s, Some(LengthUnit::Metre));
    println!(
        "{name:30} {n:7} triangles {:9.1} ms {}",
        t.elapsed().as_secs_f64() * 1e3,
        match r {
            Ok(v) => format!("{} openings {} repairs", v.openings.len(), v.audit.repairs.len()),
            Err(e) => e.to_string().chars().take(80).collect(),
        }
    );
}
struct R(u64);
impl R {
    fn f(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 33) as f64 / (1u64 << 31) as f64
    }
    fn v(&mut self) -> DVec3 {
        DVec3::new(self.f(), self.f(), self.f())
    }
}
fn strip(v: Vec<DVec3>) -> Surface {
    let n = v.len() as u32;
    Surface {
        vertices: v,
        triangles: (0..n - 2)
            .map(|i| if i % 2 == 0 { [i, i + 1, i + 2] } else { [i + 1, i, i + 2] })
            .collect(),
    }
}
fn tet(c: DVec3, r: f64) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    (
        vec![
            c + r * DVec3::ONE,
            c + r * DVec3::new(1., -1., -1.),
            c + r * DVec3::new(-1., 1., -1.),
            c + r * DVec3::new(-1., -1., 1.),
        ],
        vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]],
    )
}
#[test]
fn scratch() {
    for n in [2000usize, 8000] {
        let mut r = R(1);
        time("random strip", strip((0..n).map(|_| r.v()).collect()));
        time(
            "zigzag strip",
            strip(
                (0..n).map(|i| DVec3::new(i as f64, (i % 2) as f64 * (1.0 + r.f()), 0.1 * r.f())).collect(),
            ),
        );
        time(
            "spiral strip",
            strip(
                (0..n)
                    .map(|i| {
                        let a = i as f64 * 0.05;
                        let q = 1.0 + i as f64 * 0.01 + (i % 2) as f64 * 0.2;
                        DVec3::new(q * a.cos(), q * a.sin(), 0.01 * (i as f64))
                    })
                    .collect(),
            ),
        );
        let comb = |n: usize, r: &mut R| {
            strip(
                (0..n)
                    .map(|i| {
                        let a = (i as f64) * std::f64::consts::TAU / n as f64;
                        let q = if i % 2 == 0 { 1.0 } else { 1.0 + 0.0 * r.f() };
                        DVec3::new(q * a.cos(), q * a.sin(), if i % 2 == 0 { 0.0 } else { 1.0 })
                    })
                    .collect(),
            )
        };
        time("cylinder", comb(n, &mut r));
        let mut s = Surface::default();
        for i in 0..n / 4 {
            let (v, t) = tet(r.v() * 0.1, 1.0);
            let b = 4 * i as u32;
            s.vertices.extend(v);
            s.triangles.extend(t.iter().map(|t| t.map(|k| k + b)));
        }
        time("tetrahedra overlapping", s);
        let mut s = Surface::default();
        for i in 0..n / 4 {
            let (v, t) = tet(r.v() * 1000.0, 1.0);
            let b = 4 * i as u32;
            s.vertices.extend(v);
            s.triangles.extend(t.iter().map(|t| t.map(|k| k + b)));
        }
        time("tetrahedra apart", s);
        let mut s = Surface::default();
        for i in 0..n {
            let b = 3 * i as u32;
            let c = r.v();
            s.vertices.extend([c, c + 0.1 * r.v(), c + 0.1 * r.v()]);
            s.triangles.push([b, b + 1, b + 2]);
        }
        time("loose triangles", s);
        // all triangles share one edge / fan about a vertex
        let mut s = Surface { vertices: (0..n + 2).map(|_| r.v()).collect(), triangles: vec![] };
        s.triangles = (0..n as u32).map(|i| [0, 1, i + 2]).collect();
        time("book", s.clone());
        s.triangles = (0..n as u32).map(|i| [0, i + 1, i + 2]).collect();
        time("fan", s.clone());
        s.triangles =
            (0..n).map(|_| [(r.f() * 60.0) as u32, (r.f() * 60.0) as u32, (r.f() * 60.0) as u32]).collect();
        time("heap of 60 vertices", s.clone());
        s.triangles = (0..n)
            .map(|_| [(r.f() * n as f64) as u32, (r.f() * n as f64) as u32, (r.f() * n as f64) as u32])
            .collect();
        time("heap", s.clone());
        // closed sheet of slivers: grid on a nearly degenerate strip
        let m = (n as f64 / 2.0).sqrt() as u32;
        let grid = |f: &mut dyn FnMut(u32, u32) -> DVec3| {
            let mut s = Surface::default();
            for i in 0..=m {
                for j in 0..=m {
                    s.vertices.push(f(i % m, j % m));
                }
            }
            for i in 0..m {
                for j in 0..m {
                    let a = i * (m + 1) + j;
                    s.triangles.extend([[a, a + m + 1, a + 1], [a + 1, a + m + 1, a + m + 2]]);
                }
            }
            s
        };
        time(
            "flat torus slivers",
            grid(&mut |i, j| {
                let (a, b) = (
                    i as f64 / m as f64 * std::f64::consts::TAU,
                    j as f64 / m as f64 * std::f64::consts::TAU,
                );
                DVec3::new((3.0 + b.cos()) * a.cos(), (3.0 + b.cos()) * a.sin(), 1e-9 * b.sin())
            }),
        );
        time(
            "torus of line",
            grid(&mut |i, j| {
                DVec3::new(i as f64, (j % 2) as f64 * 1e-13, if i == 0 && j == 0 { 1.0 } else { 0.0 })
            }),
        );
        time("random torus", grid(&mut |_, _| r.v()));
        // plane with many holes
        let mut s = grid(&mut |i, j| DVec3::new(i as f64, j as f64, 0.3 * (i as f64 * 0.1).sin()));
        let mut k = 0;
        s.triangles.retain(|_| {
            k += 1;
            k % 3 != 0
        });
        time("holes", s);
    }
}

//! One sense for all triangles: neighbours agree, and normals point out of the enclosed volume.

use std::collections::VecDeque;

use glam::DVec3;

use super::{
    edges::{Edges, NONE},
    loops,
};
use crate::surface::{Surface, tetrahedron};

/// What [`orient`] did.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Oriented {
    /// Triangles turned round.
    pub(crate) reversed: usize,
    /// Edges whose two triangles cannot agree, as on a Moebius strip.
    pub(crate) conflicts: usize,
}

/// Turns triangles round until neighbours agree and every connected sheet encloses a positive volume.
///
/// Sheets end at borders and at edges where more than two triangles meet. The volume of an open sheet is
/// taken with each border closed by a fan about its mean point: unlike that of the bare triangles it does
/// not depend on the origin.
pub(crate) fn orient(surface: &mut Surface) -> Oriented {
    let n = surface.triangles.len();
    let edges = Edges::new(&surface.triangles);
    let across = edges.neighbours(n);
    // Whether the triangles on both sides of each manifold edge agree, by triangle and corner.
    let mut agrees = vec![[true; 3]; n];
    for group in edges.groups() {
        if let [a, b] = group {
            let same = a.ascending != b.ascending;
            agrees[a.triangle as usize][a.corner as usize] = same;
            agrees[b.triangle as usize][b.corner as usize] = same;
        }
    }
    let mut turned: Vec<Option<bool>> = vec![None; n];
    let mut conflicts = 0;
    for seed in 0..n {
        if turned[seed].is_some() {
            continue;
        }
        let sheet = flood(seed, &across, &agrees, &mut turned, &mut conflicts);
        let triangles: Vec<[u32; 3]> =
            sheet.iter().map(|&t| oriented(surface.triangles[t], turned[t] == Some(true))).collect();
        if closed_volume(&surface.vertices, &triangles) < 0.0 {
            for t in sheet {
                turned[t] = turned[t].map(|f| !f);
            }
        }
    }
    let mut reversed = 0;
    for (corners, turned) in surface.triangles.iter_mut().zip(turned) {
        let turned = turned == Some(true);
        *corners = oriented(*corners, turned);
        reversed += usize::from(turned);
    }
    // Each conflict was met from both of its triangles.
    Oriented { reversed, conflicts: conflicts / 2 }
}

fn oriented([a, b, c]: [u32; 3], turned: bool) -> [u32; 3] {
    if turned { [a, c, b] } else { [a, b, c] }
}

/// Fixes the sense of all triangles reached from `seed`, which keeps its own; returns them.
fn flood(
    seed: usize,
    across: &[[u32; 3]],
    agrees: &[[bool; 3]],
    turned: &mut [Option<bool>],
    conflicts: &mut usize,
) -> Vec<usize> {
    turned[seed] = Some(false);
    let mut sheet = vec![seed];
    let mut front = VecDeque::from([seed]);
    while let Some(t) = front.pop_front() {
        let own = turned[t] == Some(true);
        for k in (0..3).filter(|&k| across[t][k] != NONE) {
            let other = across[t][k] as usize;
            let wanted = own == agrees[t][k];
            match turned[other] {
                None => {
                    turned[other] = Some(wanted);
                    sheet.push(other);
                    front.push_back(other);
                }
                Some(is) => *conflicts += usize::from(is != wanted),
            }
        }
    }
    sheet
}

/// Volume of a sheet whose borders are closed by fans about their mean points.
fn closed_volume(vertices: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let place = |v: u32| vertices[v as usize];
    let Some(apex) = triangles.first().map(|t| place(t[0])) else { return 0.0 };
    let sheet: f64 = triangles.iter().map(|t| tetrahedron(apex, t.map(place))).sum();
    let mut fans = 0.0;
    for border in loops::chain(&Edges::new(triangles).border()) {
        let mean = border.iter().map(|&v| place(v)).sum::<DVec3>() / border.len() as f64;
        for (i, &a) in border.iter().enumerate() {
            let b = border[(i + 1) % border.len()];
            // Across the border the fan runs the other way.
            fans += tetrahedron(apex, [place(b), place(a), mean]);
        }
    }
    sheet + fans
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    fn pipe() -> Surface {
        shapes::pipe(1.0, 4.0, DVec3::new(0.3, -0.8, 0.5), 16).map(|v| v + DVec3::splat(7.0))
    }

    #[test]
    fn an_inverted_pipe_is_turned_outwards() {
        let mut s = pipe();
        s.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        let n = s.triangles.len();
        assert_eq!(orient(&mut s), Oriented { reversed: n, conflicts: 0 });
        assert!((s.volume() - pipe().volume()).abs() < 1e-12);
    }

    #[test]
    fn an_open_pipe_with_mixed_senses_too() {
        let whole = pipe();
        let axis = DVec3::new(0.3, -0.8, 0.5).normalize();
        let open = Surface {
            triangles: (0..whole.triangles.len())
                .filter(|&t| whole.triangle_normal(t).dot(axis).abs() < 0.5)
                .map(|t| whole.triangles[t])
                .collect(),
            vertices: whole.vertices.clone(),
        };
        let mut mixed = open.clone();
        mixed.triangles.iter_mut().step_by(3).for_each(|t| t.swap(1, 2));
        let reversed = mixed.triangles.len().div_ceil(3);
        assert_eq!(orient(&mut mixed), Oriented { reversed, conflicts: 0 });
        for t in 0..open.triangles.len() {
            assert!(mixed.triangle_normal(t).dot(open.triangle_normal(t)) > 0.99);
        }
    }

    #[test]
    fn a_moebius_strip_has_a_conflict() {
        let n = 12;
        let mut s = Surface::default();
        for i in 0..n {
            let angle = f64::from(i) * std::f64::consts::TAU / f64::from(n);
            let out = DVec3::new(angle.cos(), angle.sin(), 0.0);
            let across = (angle / 2.0).cos() * out + (angle / 2.0).sin() * DVec3::Z;
            s.vertices.extend([3.0 * out - across, 3.0 * out + across]);
        }
        for i in 0..n as u32 {
            let (a, b) = (2 * i, 2 * i + 1);
            let last = i + 1 == n as u32;
            let (c, d) = if last { (1, 0) } else { (a + 2, b + 2) };
            s.triangles.extend([[a, c, b], [c, d, b]]);
        }
        assert_eq!(orient(&mut s).conflicts, 1);
    }
}

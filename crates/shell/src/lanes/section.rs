//! The law of a section over lanes.

use super::columns::*;
use crate::material::{Material, Model, SHEAR_CORRECTION};
use vaso_kernels::{Lanes, PointLaw, Points};

/// The section of a material.
pub(crate) struct Section {
    material: Material,
    layers: usize,
    damping: f64,
    /// Time of the step that led here \[s\], 0 for none.
    dt: f64,
}

impl Section {
    /// Section at the end of a step `dt` \[s\], with a `damping` as [`crate::Numbers`] have it.
    pub(crate) fn new(material: Material, damping: f64, dt: f64) -> Self {
        let layers = if let Model::NeoHookean { points } = material.model() { points } else { 0 };
        Self { material, layers, damping, dt }
    }
}

// Closures below would be compiled without the vector instructions wherever they are not inlined, and long ones are not: hence functions.

type Vector<L> = [L; 3];

#[inline(always)]
fn fixed<L: Lanes<Elem = f64>>(p: &Points<'_, L>, c: usize) -> Vector<L> {
    [p.fixed(c), p.fixed(c + 1), p.fixed(c + 2)]
}

#[inline(always)]
fn own<L: Lanes<Elem = f64>>(p: &Points<'_, L>, c: usize) -> Vector<L> {
    [p.own(c), p.own(c + 1), p.own(c + 2)]
}

#[inline(always)]
fn write<L: Lanes<Elem = f64>>(p: &mut Points<'_, L>, c: usize, v: &Vector<L>) {
    p.put(c, v[0]);
    p.put(c + 1, v[1]);
    p.put(c + 2, v[2]);
}

#[inline(always)]
fn dot<L: Lanes>(a: &Vector<L>, b: &Vector<L>) -> L {
    a[0].fma(b[0], a[1].fma(b[1], a[2] * b[2]))
}

#[inline(always)]
fn plus<L: Lanes>(a: &Vector<L>, b: &Vector<L>) -> Vector<L> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// `a + s b`.
#[inline(always)]
fn along<L: Lanes>(a: &Vector<L>, s: L, b: &Vector<L>) -> Vector<L> {
    [s.fma(b[0], a[0]), s.fma(b[1], a[1]), s.fma(b[2], a[2])]
}

/// `x a + y b`.
#[inline(always)]
fn two<L: Lanes>(x: L, a: &Vector<L>, y: L, b: &Vector<L>) -> Vector<L> {
    [x.fma(a[0], y * b[0]), x.fma(a[1], y * b[1]), x.fma(a[2], y * b[2])]
}

/// `x a + y b + z c`.
#[inline(always)]
fn three<L: Lanes>([x, y, z]: [L; 3], a: &Vector<L>, b: &Vector<L>, c: &Vector<L>) -> Vector<L> {
    along(&two(y, b, z, c), x, a)
}

/// One over what is above zero.
#[inline(always)]
fn inverse<L: Lanes>(x: L) -> L {
    let root = x.rsqrt();
    root * root
}

/// Base vectors in the reference configuration, and how they have changed.
struct Change<L> {
    base: [Vector<L>; 2],
    n: [Vector<L>; 2],
    director: Vector<L>,
    u: [Vector<L>; 2],
    dn: [Vector<L>; 2],
}

/// Present base vectors, and what is found along them.
struct Lane<L> {
    g: [Vector<L>; 2],
    n: [Vector<L>; 2],
    director: Vector<L>,
    t: [Vector<L>; 2],
    m: [Vector<L>; 2],
    q: Vector<L>,
}

impl PointLaw for Section {
    #[inline(always)]
    fn point<L: Lanes<Elem = f64>>(&self, p: &mut Points<'_, L>) {
        let change = Change {
            base: [fixed(p, G), fixed(p, G + 3)],
            n: [fixed(p, N), fixed(p, N + 3)],
            director: fixed(p, DIRECTOR),
            u: [own(p, U), own(p, U + 3)],
            dn: [own(p, DN), own(p, DN + 3)],
        };
        let s = [own(p, HOURGLASS), own(p, HOURGLASS + 3), own(p, HOURGLASS + 6)];
        let dual = [fixed(p, DUAL), fixed(p, DUAL + 3), fixed(p, DUAL + 6)];
        let zero = [L::zero(); 3];
        let mut lane = Lane {
            g: [plus(&change.base[0], &change.u[0]), plus(&change.base[1], &change.u[1])],
            n: [plus(&change.n[0], &change.dn[0]), plus(&change.n[1], &change.dn[1])],
            director: own(p, PRESENT),
            t: [times(&s, &dual[0]), times(&s, &dual[1])],
            m: [zero; 2],
            q: times(&s, &dual[2]),
        };
        let is_linear = self.layers == 0;
        if self.damping > 0.0 || is_linear {
            let e = change.strain(&lane);
            let mut r = if is_linear { self.linear(p.fixed(THICKNESS), &e) } else { [L::zero(); 8] };
            if self.damping > 0.0 && self.dt > 0.0 {
                self.damp(p, &e, &mut r);
            }
            lane.add(&r);
            for k in 0..8 {
                p.put(STRAIN + k, e[k]);
            }
        }
        for layer in 0..self.layers {
            let c = LAYERS + layer * LAYER;
            let inverse = [
                [p.fixed(c + 2), p.fixed(c + 3)],
                [p.fixed(c + 4), p.fixed(c + 5)],
                [p.fixed(c + 6), p.fixed(c + 7)],
            ];
            lane.add_layer(&self.material, p.fixed(c), p.fixed(c + 1), &inverse);
        }
        write(p, T, &lane.t[0]);
        write(p, T + 3, &lane.t[1]);
        write(p, M, &lane.m[0]);
        write(p, M + 3, &lane.m[1]);
        write(p, Q, &lane.q);
    }
}

/// Matrix of the rows `s` times `v`.
#[inline(always)]
fn times<L: Lanes>(s: &[Vector<L>; 3], v: &Vector<L>) -> Vector<L> {
    [dot(&s[0], v), dot(&s[1], v), dot(&s[2], v)]
}

impl<L: Lanes<Elem = f64>> Change<L> {
    /// As `section::strain`.
    #[inline(always)]
    fn strain(&self, lane: &Lane<L>) -> [L; 8] {
        let d = [
            lane.director[0] - self.director[0],
            lane.director[1] - self.director[1],
            lane.director[2] - self.director[2],
        ];
        let twist = L::constant(0.5) * (self.bend(lane, 0, 1) + self.bend(lane, 1, 0));
        [
            self.stretch(0, 0),
            self.stretch(1, 1),
            self.stretch(0, 1),
            self.bend(lane, 0, 0),
            self.bend(lane, 1, 1),
            twist,
            dot(&self.u[0], &lane.director) + dot(&self.base[0], &d),
            dot(&self.u[1], &lane.director) + dot(&self.base[1], &d),
        ]
    }

    #[inline(always)]
    fn stretch(&self, a: usize, b: usize) -> L {
        let (base, u) = (&self.base, &self.u);
        L::constant(0.5) * (dot(&base[a], &u[b]) + dot(&u[a], &base[b]) + dot(&u[a], &u[b]))
    }

    #[inline(always)]
    fn bend(&self, lane: &Lane<L>, a: usize, b: usize) -> L {
        dot(&self.u[a], &self.n[b]) + dot(&lane.g[a], &self.dn[b])
    }
}

impl Section {
    /// As `section::linear`.
    #[inline(always)]
    fn linear<L: Lanes<Elem = f64>>(&self, thickness: L, e: &[L; 8]) -> [L; 8] {
        let (plate, shear) = (self.material.plate(), self.material.shear());
        let nu = L::constant(self.material.poisson());
        let (c, g) = (L::constant(plate) * thickness, L::constant(2.0 * shear) * thickness);
        let lever = L::constant(1.0 / 12.0) * thickness * thickness;
        let (d, h) = (c * lever, g * lever);
        let s = L::constant(SHEAR_CORRECTION * shear) * thickness;
        [
            c * nu.fma(e[1], e[0]),
            c * nu.fma(e[0], e[1]),
            g * e[2],
            d * nu.fma(e[4], e[3]),
            d * nu.fma(e[3], e[4]),
            h * e[5],
            s * e[6],
            s * e[7],
        ]
    }

    /// Adds to the resultants `r` what damping makes of the change of the strain, and writes its power.
    #[inline(always)]
    fn damp<L: Lanes<Elem = f64>>(&self, p: &mut Points<'_, L>, e: &[L; 8], r: &mut [L; 8]) {
        let (per_step, damping) = (L::constant(1.0 / self.dt), L::constant(self.damping));
        let mut power = L::zero();
        for k in 0..8 {
            let rate = (e[k] - p.own(BEFORE + k)) * per_step;
            let viscous = damping * rate * p.fixed(VISCOUS + k / 3);
            r[k] = r[k] + viscous;
            // Shear and twist stand for two entries.
            let entries = if k == 2 || k == 5 { 2.0 } else { 1.0 };
            power = (L::constant(entries) * viscous).fma(rate, power);
        }
        p.put(POWER, power);
    }
}

impl<L: Lanes<Elem = f64>> Lane<L> {
    /// Adds what normal forces, moments and transverse forces, in the order of the strain, do to the base.
    #[inline(always)]
    fn add(&mut self, r: &[L; 8]) {
        let ([g1, g2], [n1, n2], d) = (&self.g, &self.n, &self.director);
        let t1 = plus(&two(r[0], g1, r[2], g2), &three([r[3], r[5], r[6]], n1, n2, d));
        let t2 = plus(&two(r[2], g1, r[1], g2), &three([r[5], r[4], r[7]], n1, n2, d));
        let (m1, m2) = (two(r[3], g1, r[5], g2), two(r[5], g1, r[4], g2));
        let q = two(r[6], g1, r[7], g2);
        self.t = [plus(&self.t[0], &t1), plus(&self.t[1], &t2)];
        self.m = [plus(&self.m[0], &m1), plus(&self.m[1], &m2)];
        self.q = plus(&self.q, &q);
    }

    /// Adds the neo-Hookean stress of a layer at the height `zeta`; `i` are the rows of the inverse of its base.
    #[inline(always)]
    fn add_layer(&mut self, material: &Material, zeta: L, weight: L, i: &[[L; 2]; 3]) {
        let d = self.director;
        let (a, b) = (along(&self.g[0], zeta, &self.n[0]), along(&self.g[1], zeta, &self.n[1]));
        let x = along(&two(i[0][0], &a, i[1][0], &b), i[2][0], &d);
        let y = along(&two(i[0][1], &a, i[1][1], &b), i[2][1], &d);
        // As `material::neo_hookean_stress`.
        let (c11, c22, c12) = (dot(&x, &x), dot(&y, &y), dot(&x, &y));
        let (shear, half_lame) = (L::constant(material.shear()), L::constant(0.5 * material.lame()));
        let j2 = c12.fnma(c12, c11 * c22);
        let across = (shear + half_lame) * inverse(half_lame.fma(j2, shear));
        let b_over_j2 = (half_lame * (j2 * across - L::constant(1.0)) - shear) * inverse(j2);
        let transverse = L::constant(SHEAR_CORRECTION * material.shear());
        let (s11, s22) = (b_over_j2.fma(c22, shear), b_over_j2.fma(c11, shear));
        let s12 = L::zero() - b_over_j2 * c12;
        let (s13, s23) = (transverse * dot(&x, &d), transverse * dot(&y, &d));
        // First Piola-Kirchhoff stress along the layer's base, then along that of the mid-surface.
        let p1 = three([s11, s12, s13], &x, &y, &d);
        let p2 = three([s12, s22, s23], &x, &y, &d);
        let p3 = two(s13, &x, s23, &y);
        let (by1, by2) = (two(i[0][0], &p1, i[0][1], &p2), two(i[1][0], &p1, i[1][1], &p2));
        let by3 = plus(&two(i[2][0], &p1, i[2][1], &p2), &p3);
        let lever = weight * zeta;
        self.t = [along(&self.t[0], weight, &by1), along(&self.t[1], weight, &by2)];
        self.m = [along(&self.m[0], lever, &by1), along(&self.m[1], lever, &by2)];
        self.q = along(&self.q, weight, &by3);
    }
}

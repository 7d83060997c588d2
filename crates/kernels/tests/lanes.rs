//! Vector lanes against the scalar reference, and both against sums written out in full.

use glam::DVec3;
use vaso_kernels::{
    CHUNK, CellGrid, Frame, Gather, Isa, Lanes, Own, Pair, PairLaw, PairStore, Real, Records, Rows,
    SearchSet, Store, Stored, Wendland, sweep, sweep_some,
};

const SPACING: f64 = 1e-3;

/// A law that uses everything a pair offers.
struct Everything;

impl<R: Real> PairLaw<R, 5> for Everything {
    type Constants<L: Lanes<Elem = R>> = L;
    const SECOND: bool = true;
    const STORED: Stored = Stored::Read;

    fn constants<L: Lanes<Elem = R>>(&self) -> L {
        L::constant(0.75)
    }

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>(c: &L, own: &Own<L>, p: &Pair<L>, sums: &mut [L; 5]) {
        let g = p.u * p.u * p.volume;
        sums[0] = g.fma(p.d[0] * p.r_inv, sums[0]);
        sums[1] = g.fma(own.velocity[1] - p.velocity[1], sums[1]);
        sums[2] = g.fma((own.scalar * p.scalar).max(*c).min(L::constant(2.0)), sums[2]);
        sums[3] = g.fma(own.second[5] + p.second[3], sums[3]);
        sums[4] = g.fma(p.stored * p.r, sums[4]);
    }
}

/// Stores the distance of each pair.
struct Distance;

impl<R: Real> PairLaw<R, 0> for Distance {
    type Constants<L: Lanes<Elem = R>> = ();
    const STORED: Stored = Stored::Write;

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _: &Own<L>, _: &Pair<L>, _: &mut [L; 0]) {}

    #[inline(always)]
    fn store<L: Lanes<Elem = R>>((): &(), _: &Own<L>, p: &Pair<L>) -> L {
        p.r
    }
}

struct Cloud {
    position: Vec<DVec3>,
    fields: Vec<[f64; 13]>,
    frame: Frame,
    set: SearchSet,
    grid: CellGrid,
}

/// A jittered lattice, sorted by cell, far from the origin.
fn cloud() -> Cloud {
    let mut state = 3_u64;
    let mut next = move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let n = 11;
    let shift = DVec3::new(0.7, -3.0, 12.0);
    let unsorted: Vec<DVec3> = (0..n * n * n)
        .map(|k| {
            let site = DVec3::new((k % n) as f64, (k / n % n) as f64, (k / n / n) as f64);
            shift + SPACING * (site + 0.3 * DVec3::new(next(), next(), next()))
        })
        .collect();
    let bounds = (shift, shift + DVec3::splat(n as f64 * SPACING));
    let support = Wendland::new(1.3 * SPACING).support();
    let frame = Frame::new(bounds, support);
    let mut grid = CellGrid::new(bounds, support);
    let mut order = Vec::new();
    grid.sort(&unsorted, &mut order);
    let position: Vec<DVec3> = order.iter().map(|&o| unsorted[o as usize]).collect();
    let mut set = SearchSet::default();
    set.fill(&frame, &position);
    let fields = (0..position.len()).map(|_| std::array::from_fn(|_| 2.0 * next() - 1.0)).collect();
    Cloud { position, fields, frame, set, grid }
}

fn rows(cloud: &Cloud, isa: Isa) -> Rows {
    let mut rows = Rows::default();
    rows.build(isa, &cloud.frame, (&cloud.set, &cloud.position), &cloud.set, &cloud.grid, true);
    rows
}

fn sums<R: Real>(cloud: &Cloud, isa: Isa) -> Vec<[f64; 5]> {
    let rows = rows(cloud, isa);
    let n = cloud.position.len();
    let (mut first, mut second) = (Records::<R>::default(), Records::<R>::default());
    first.resize(n);
    second.resize(n);
    first.fill(|i| {
        let (x, fixed, f) = (cloud.frame.in_supports(cloud.position[i]), cloud.set.get(i), &cloud.fields[i]);
        let volume = 1.0 + 0.1 * f[0];
        [
            R::coordinate(fixed[0], x[0]),
            R::coordinate(fixed[1], x[1]),
            R::coordinate(fixed[2], x[2]),
            R::pack(volume),
            R::pack(f[1]),
            R::pack(f[2]),
            R::pack(f[3]),
            R::pack(f[4]),
        ]
    });
    second.fill(|i| std::array::from_fn(|k| R::pack(cloud.fields[i][5 + k])));
    let gather = Gather {
        frame: &cloud.frame,
        own: &first,
        other: &first,
        own_second: Some(&second),
        other_second: Some(&second),
    };
    let mut store = PairStore::default();
    store.resize_for(rows.chunks());
    let mut all = Vec::new();
    for (c, row) in rows.chunks().iter().enumerate() {
        let stored = &mut store.chunks_mut()[c];
        sweep(isa, &Distance, &gather, (row, c * CHUNK), Store::Write(stored), &mut [[]; CHUNK]);
        let mut out = [[0.0; 5]; CHUNK];
        sweep(isa, &Everything, &gather, (row, c * CHUNK), Store::Read(stored), &mut out);
        all.extend_from_slice(&out[..row.len()]);
    }
    all
}

fn reference(cloud: &Cloud) -> Vec<[f64; 5]> {
    let support = cloud.frame.support();
    let n = cloud.position.len();
    (0..n)
        .map(|i| {
            let mut total = [0.0; 5];
            for j in (0..n).filter(|&j| j != i) {
                let d = (cloud.position[i] - cloud.position[j]) / support;
                let r = d.length();
                if r < 1.0 {
                    let (a, b) = (&cloud.fields[i], &cloud.fields[j]);
                    let g = (1.0 - r).powi(2) * (1.0 + 0.1 * b[0]);
                    total[0] += g * d.x / r;
                    total[1] += g * (a[2] - b[2]);
                    total[2] += g * (a[4] * b[4]).clamp(0.75, 2.0);
                    total[3] += g * (a[10] + b[8]);
                    total[4] += g * r * r;
                }
            }
            total
        })
        .collect()
}

fn worst(a: &[[f64; 5]], b: &[[f64; 5]]) -> f64 {
    let scale = b.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    a.iter().flatten().zip(b.iter().flatten()).fold(0.0_f64, |m, (x, y)| m.max((x - y).abs())) / scale
}

#[test]
fn every_instruction_set_gives_the_sums_of_the_definition() {
    let cloud = cloud();
    let exact = reference(&cloud);
    for isa in Isa::available() {
        let double = worst(&sums::<f64>(&cloud, isa), &exact);
        let mixed = worst(&sums::<f32>(&cloud, isa), &exact);
        println!("{}: double {double:.1e}, mixed {mixed:.1e}", isa.name());
        // Positions twelve metres from the origin keep 2e-15 m, which is 6e-13 of a support.
        assert!(double < 1e-11, "{} double: {double:e}", isa.name());
        assert!(mixed < 2e-6, "{} mixed: {mixed:e}", isa.name());
    }
}

#[test]
fn every_instruction_set_finds_the_same_rows() {
    let cloud = cloud();
    let expected = rows(&cloud, Isa::scalar());
    let support = cloud.frame.support();
    for isa in Isa::available() {
        let found = rows(&cloud, isa);
        for i in 0..cloud.position.len() {
            // Pairs within rounding of the support may differ; the kernel is zero there.
            let clear =
                |j: &usize| (cloud.position[i].distance(cloud.position[*j]) / support - 1.0).abs() > 1e-6;
            let a: Vec<usize> = found.row(i).filter(clear).collect();
            let b: Vec<usize> = expected.row(i).filter(clear).collect();
            assert_eq!(a, b, "row {i} of {}", isa.name());
        }
    }
}

#[test]
fn redirected_rows_point_where_they_are_told() {
    let cloud = cloud();
    let (rows, n) = (rows(&cloud, Isa::detect()), cloud.position.len());
    let mut redirected = rows.clone();
    let to: Vec<u32> = (0..n as u32).map(|j| n as u32 + 2 - j).collect();
    redirected.redirect(&to, n + 3);
    assert_eq!((redirected.n_other(), redirected.n_pairs()), (n + 3, rows.n_pairs()));
    for i in (0..n).step_by(7) {
        assert!(redirected.row(i).eq(rows.row(i).map(|j| n + 2 - j)), "row {i}");
    }
}

/// Rows and what is stored beside them are most of the memory of a flow; when a flow changes how many neighbours there are, they grow by what it takes.
#[test]
fn lists_that_grow_have_little_to_spare() {
    let mut cloud = cloud();
    let mut rows = rows(&cloud, Isa::detect());
    let mut store = PairStore::<f32>::default();
    store.resize_for(rows.chunks());
    let before = rows.n_pairs();
    let middle = cloud.position.iter().sum::<DVec3>() / cloud.position.len() as f64;
    cloud.position.iter_mut().for_each(|x| *x = middle + 0.97 * (*x - middle));
    let mut order = Vec::new();
    cloud.grid.sort(&cloud.position, &mut order);
    cloud.position = order.iter().map(|&o| cloud.position[o as usize]).collect();
    cloud.set.fill(&cloud.frame, &cloud.position);
    let (own, other) = ((&cloud.set, &cloud.position[..]), &cloud.set);
    rows.build(Isa::detect(), &cloud.frame, own, other, &cloud.grid, true);
    store.resize_for(rows.chunks());
    assert!(rows.n_pairs() > before);
    let needed = 4 * rows.chunks().iter().map(|c| c.n_entries()).sum::<usize>();
    for (what, bytes) in [("rows", rows.bytes()), ("store", store.bytes())] {
        assert!(bytes < needed + needed / 4, "{what}: {bytes} for {needed}");
    }
}

/// The first sum is of the kernel, each other twice the one before it: exact in binary numbers.
struct Doubles;

impl<R: Real, const K: usize> PairLaw<R, K> for Doubles {
    type Constants<L: Lanes<Elem = R>> = ();

    fn constants<L: Lanes<Elem = R>>(&self) {}

    #[inline(always)]
    fn pair<L: Lanes<Elem = R>>((): &(), _: &Own<L>, p: &Pair<L>, sums: &mut [L; K]) {
        let mut term = p.u;
        for sum in sums {
            *sum = *sum + term;
            term = term + term;
        }
    }
}

fn many_sums<R: Real>() {
    let cloud = cloud();
    let mut records = Records::<R>::default();
    records.resize(cloud.position.len());
    records.fill(|i| {
        let (fixed, x) = (cloud.set.get(i), cloud.frame.in_supports(cloud.position[i]));
        std::array::from_fn(|k| if k < 3 { R::coordinate(fixed[k], x[k]) } else { R::pack(1.0) })
    });
    let gather =
        Gather { frame: &cloud.frame, own: &records, other: &records, own_second: None, other_second: None };
    for isa in Isa::available() {
        for (c, row) in rows(&cloud, isa).chunks().iter().enumerate() {
            let (mut one, mut many) = ([[0.0; 1]; CHUNK], [[-1.0; 11]; CHUNK]);
            sweep(isa, &Doubles, &gather, (row, c * CHUNK), Store::None, &mut one);
            let takes = |k: usize| !k.is_multiple_of(3);
            sweep_some(isa, &Doubles, &gather, (row, c * CHUNK), Store::None, takes, &mut many);
            for k in 0..row.len() {
                let expected: [f64; 11] =
                    std::array::from_fn(|q| if takes(k) { one[k][0] * f64::from(1 << q) } else { -1.0 });
                assert_eq!(many[k], expected, "{} row {k}", isa.name());
            }
        }
    }
}

#[test]
fn sums_found_together_have_the_bits_of_each_and_rows_left_out_keep_theirs() {
    many_sums::<f32>();
    many_sums::<f64>();
}

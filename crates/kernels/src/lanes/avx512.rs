//! 512-bit lanes (AVX-512 F, BW, DQ, VL): sixteen `f32` or eight `f64`.

use super::{FIELDS, Lanes, SearchLanes};
use core::arch::x86_64::*;

/// Sixteen `f32`.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct F32x16(__m512);

/// Eight `f64`.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct F64x8(__m512d);

// SAFETY of every block in this file: values of these types are made only inside a function that
// enables the instructions after `Isa` has found them (see `crate::isa`); pointers are vouched for
// by the callers of the `unsafe` methods.
arithmetic!(F32x16, _mm512_add_ps, _mm512_sub_ps, _mm512_mul_ps);
arithmetic!(F64x8, _mm512_add_pd, _mm512_sub_pd, _mm512_mul_pd);

/// Transposes four 4x4 tiles of `f32` held in the quarters of four registers.
#[inline(always)]
unsafe fn transpose4(a: __m512, b: __m512, c: __m512, d: __m512) -> [F32x16; 4] {
    unsafe {
        let ab_low = _mm512_unpacklo_ps(a, b);
        let ab_high = _mm512_unpackhi_ps(a, b);
        let cd_low = _mm512_unpacklo_ps(c, d);
        let cd_high = _mm512_unpackhi_ps(c, d);
        [
            F32x16(_mm512_shuffle_ps::<0x44>(ab_low, cd_low)),
            F32x16(_mm512_shuffle_ps::<0xEE>(ab_low, cd_low)),
            F32x16(_mm512_shuffle_ps::<0x44>(ab_high, cd_high)),
            F32x16(_mm512_shuffle_ps::<0xEE>(ab_high, cd_high)),
        ]
    }
}

// Helpers are functions, not closures: a closure cannot be forced to be inlined, and outside the
// functions that enable the instructions it is ten times slower.

/// The records at `at[0]` and `at[8]`, side by side.
#[inline(always)]
unsafe fn two_records(base: *const f32, at: *const u32) -> __m512 {
    unsafe {
        let a = _mm256_loadu_ps(base.add(*at as usize));
        let b = _mm256_loadu_ps(base.add(*at.add(8) as usize));
        _mm512_insertf32x8::<1>(_mm512_castps256_ps512(a), b)
    }
}

/// Sorts pairs of equal fields from four registers into one register a field.
#[inline(always)]
unsafe fn gather_fields(a: __m512d, b: __m512d, c: __m512d, d: __m512d) -> [F64x8; 4] {
    unsafe {
        let (ab_even, ab_odd) = (_mm512_shuffle_f64x2::<0x88>(a, b), _mm512_shuffle_f64x2::<0xDD>(a, b));
        let (cd_even, cd_odd) = (_mm512_shuffle_f64x2::<0x88>(c, d), _mm512_shuffle_f64x2::<0xDD>(c, d));
        [
            F64x8(_mm512_shuffle_f64x2::<0x88>(ab_even, cd_even)),
            F64x8(_mm512_shuffle_f64x2::<0x88>(ab_odd, cd_odd)),
            F64x8(_mm512_shuffle_f64x2::<0xDD>(ab_even, cd_even)),
            F64x8(_mm512_shuffle_f64x2::<0xDD>(ab_odd, cd_odd)),
        ]
    }
}

/// Sums the halves of two registers: quarters `a0 + a2`, `a1 + a3`, and the same of `b`.
#[inline(always)]
unsafe fn add_halves(a: __m512, b: __m512) -> __m512 {
    unsafe { _mm512_add_ps(_mm512_shuffle_f32x4::<0x44>(a, b), _mm512_shuffle_f32x4::<0xEE>(a, b)) }
}

/// One quarter a vector, each with four partial sums.
#[inline(always)]
unsafe fn add_quarters(v: [F32x16; 4]) -> __m512 {
    unsafe {
        let (ab, cd) = (add_halves(v[0].0, v[1].0), add_halves(v[2].0, v[3].0));
        _mm512_add_ps(_mm512_shuffle_f32x4::<0x88>(ab, cd), _mm512_shuffle_f32x4::<0xDD>(ab, cd))
    }
}

/// One quarter a vector, each with two partial sums.
#[inline(always)]
unsafe fn add_halves_f64(v: [F64x8; 4]) -> __m512d {
    unsafe {
        let (a, b, c, d) = (v[0].0, v[1].0, v[2].0, v[3].0);
        let ab = _mm512_add_pd(_mm512_shuffle_f64x2::<0x44>(a, b), _mm512_shuffle_f64x2::<0xEE>(a, b));
        let cd = _mm512_add_pd(_mm512_shuffle_f64x2::<0x44>(c, d), _mm512_shuffle_f64x2::<0xEE>(c, d));
        _mm512_add_pd(_mm512_shuffle_f64x2::<0x88>(ab, cd), _mm512_shuffle_f64x2::<0xDD>(ab, cd))
    }
}

/// Separations from sixteen candidates along one axis, in supports.
#[inline(always)]
unsafe fn search_delta(own: i32, p: *const i32, unit: __m512) -> __m512 {
    unsafe {
        let difference = _mm512_sub_epi32(_mm512_set1_epi32(own), _mm512_loadu_si512(p.cast()));
        _mm512_mul_ps(_mm512_cvtepi32_ps(difference), unit)
    }
}

impl Lanes for F32x16 {
    type Elem = f32;
    const N: usize = 16;

    #[inline(always)]
    fn splat(x: f32) -> Self {
        unsafe { Self(_mm512_set1_ps(x)) }
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm512_fmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm512_fnmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        unsafe { Self(_mm512_max_ps(self.0, o.0)) }
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        unsafe { Self(_mm512_min_ps(self.0, o.0)) }
    }
    /// Fourteen-bit estimate and one Newton step.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        let estimate = unsafe { Self(_mm512_rsqrt14_ps(self.0)) };
        let half = self * Self::splat(0.5) * estimate;
        estimate * half.fnma(estimate, Self::splat(1.5))
    }
    #[inline(always)]
    fn sum(self) -> f64 {
        unsafe { f64::from(_mm512_reduce_add_ps(self.0)) }
    }
    /// Adds halves, quarters, then within quarters, as [`Self::sum`] does.
    #[inline(always)]
    fn sums([a, b, c, d, e, f, g, h]: [Self; 8]) -> [f64; 8] {
        let mut out = [0.0; 8];
        unsafe {
            let (abcd, efgh) = (add_quarters([a, b, c, d]), add_quarters([e, f, g, h]));
            let two =
                _mm512_add_ps(_mm512_shuffle_ps::<0x44>(abcd, efgh), _mm512_shuffle_ps::<0xEE>(abcd, efgh));
            let one = _mm512_add_ps(two, _mm512_permute_ps::<0xB1>(two));
            let lane = _mm512_setr_epi32(0, 4, 8, 12, 2, 6, 10, 14, 0, 0, 0, 0, 0, 0, 0, 0);
            let eight = _mm512_castps512_ps256(_mm512_permutexvar_ps(lane, one));
            _mm512_storeu_pd(out.as_mut_ptr(), _mm512_cvtps_pd(eight));
        }
        out
    }
    #[inline(always)]
    fn delta(self, o: Self, unit: Self) -> Self {
        unsafe {
            let difference = _mm512_sub_epi32(_mm512_castps_si512(self.0), _mm512_castps_si512(o.0));
            Self(_mm512_mul_ps(_mm512_cvtepi32_ps(difference), unit.0))
        }
    }
    #[inline(always)]
    unsafe fn load(p: *const f32) -> Self {
        unsafe { Self(_mm512_loadu_ps(p)) }
    }
    #[inline(always)]
    unsafe fn store(self, p: *mut f32) {
        unsafe { _mm512_storeu_ps(p, self.0) }
    }
    /// Two records a register, then 4x4 transposes within quarters.
    #[inline(always)]
    unsafe fn records(base: *const f32, at: *const u32) -> [Self; FIELDS] {
        unsafe {
            let (z0, z1, z2, z3) = (
                two_records(base, at),
                two_records(base, at.add(1)),
                two_records(base, at.add(2)),
                two_records(base, at.add(3)),
            );
            let at = at.add(4);
            let (z4, z5, z6, z7) = (
                two_records(base, at),
                two_records(base, at.add(1)),
                two_records(base, at.add(2)),
                two_records(base, at.add(3)),
            );
            let [f0, f1, f2, f3] = transpose4(
                _mm512_shuffle_f32x4::<0x88>(z0, z1),
                _mm512_shuffle_f32x4::<0x88>(z2, z3),
                _mm512_shuffle_f32x4::<0x88>(z4, z5),
                _mm512_shuffle_f32x4::<0x88>(z6, z7),
            );
            let [f4, f5, f6, f7] = transpose4(
                _mm512_shuffle_f32x4::<0xDD>(z0, z1),
                _mm512_shuffle_f32x4::<0xDD>(z2, z3),
                _mm512_shuffle_f32x4::<0xDD>(z4, z5),
                _mm512_shuffle_f32x4::<0xDD>(z6, z7),
            );
            [f0, f1, f2, f3, f4, f5, f6, f7]
        }
    }
    #[inline(always)]
    fn prefetch(p: *const u32) {
        unsafe { _mm_prefetch::<_MM_HINT_T0>(p.cast()) }
    }
}

impl Lanes for F64x8 {
    type Elem = f64;
    const N: usize = 8;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        unsafe { Self(_mm512_set1_pd(x)) }
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm512_fmadd_pd(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm512_fnmadd_pd(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        unsafe { Self(_mm512_max_pd(self.0, o.0)) }
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        unsafe { Self(_mm512_min_pd(self.0, o.0)) }
    }
    /// Fourteen-bit estimate and two Newton steps.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        let half = self * Self::splat(0.5);
        let y = unsafe { Self(_mm512_rsqrt14_pd(self.0)) };
        let y = y * (half * y).fnma(y, Self::splat(1.5));
        y * (half * y).fnma(y, Self::splat(1.5))
    }
    #[inline(always)]
    fn sum(self) -> f64 {
        unsafe { _mm512_reduce_add_pd(self.0) }
    }
    /// Adds halves, then quarters, then within quarters, as [`Self::sum`] does.
    #[inline(always)]
    fn sums([a, b, c, d, e, f, g, h]: [Self; 8]) -> [f64; 8] {
        let mut out = [0.0; 8];
        unsafe {
            let (abcd, efgh) = (add_halves_f64([a, b, c, d]), add_halves_f64([e, f, g, h]));
            let one = _mm512_add_pd(_mm512_unpacklo_pd(abcd, efgh), _mm512_unpackhi_pd(abcd, efgh));
            let lane = _mm512_setr_epi64(0, 2, 4, 6, 1, 3, 5, 7);
            _mm512_storeu_pd(out.as_mut_ptr(), _mm512_permutexvar_pd(lane, one));
        }
        out
    }
    #[inline(always)]
    fn delta(self, o: Self, _unit: Self) -> Self {
        self - o
    }
    #[inline(always)]
    unsafe fn load(p: *const f64) -> Self {
        unsafe { Self(_mm512_loadu_pd(p)) }
    }
    #[inline(always)]
    unsafe fn store(self, p: *mut f64) {
        unsafe { _mm512_storeu_pd(p, self.0) }
    }
    /// One record a register, then an 8x8 transpose.
    #[inline(always)]
    unsafe fn records(base: *const f64, at: *const u32) -> [Self; FIELDS] {
        unsafe {
            let z0 = _mm512_loadu_pd(base.add(*at as usize));
            let z1 = _mm512_loadu_pd(base.add(*at.add(1) as usize));
            let z2 = _mm512_loadu_pd(base.add(*at.add(2) as usize));
            let z3 = _mm512_loadu_pd(base.add(*at.add(3) as usize));
            let z4 = _mm512_loadu_pd(base.add(*at.add(4) as usize));
            let z5 = _mm512_loadu_pd(base.add(*at.add(5) as usize));
            let z6 = _mm512_loadu_pd(base.add(*at.add(6) as usize));
            let z7 = _mm512_loadu_pd(base.add(*at.add(7) as usize));
            let even = gather_fields(
                _mm512_unpacklo_pd(z0, z1),
                _mm512_unpacklo_pd(z2, z3),
                _mm512_unpacklo_pd(z4, z5),
                _mm512_unpacklo_pd(z6, z7),
            );
            let odd = gather_fields(
                _mm512_unpackhi_pd(z0, z1),
                _mm512_unpackhi_pd(z2, z3),
                _mm512_unpackhi_pd(z4, z5),
                _mm512_unpackhi_pd(z6, z7),
            );
            [even[0], odd[0], even[1], odd[1], even[2], odd[2], even[3], odd[3]]
        }
    }
    #[inline(always)]
    fn prefetch(p: *const u32) {
        unsafe { _mm_prefetch::<_MM_HINT_T0>(p.cast()) }
    }
}

/// Search over sixteen candidates.
#[derive(Clone, Copy)]
pub(crate) struct Search;

impl SearchLanes for Search {
    const N: usize = 16;

    #[inline(always)]
    unsafe fn within(own: [i32; 3], x: *const i32, y: *const i32, z: *const i32, unit: f32) -> u32 {
        unsafe {
            let unit = _mm512_set1_ps(unit);
            let (dx, dy, dz) =
                (search_delta(own[0], x, unit), search_delta(own[1], y, unit), search_delta(own[2], z, unit));
            let r2 = _mm512_fmadd_ps(dx, dx, _mm512_fmadd_ps(dy, dy, _mm512_mul_ps(dz, dz)));
            u32::from(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(r2, _mm512_set1_ps(1.0)))
        }
    }
    #[inline(always)]
    unsafe fn compress(mask: u32, first: u32, out: *mut u32) -> usize {
        unsafe {
            let lane = _mm512_setr_epi32(0, 8, 16, 24, 32, 40, 48, 56, 64, 72, 80, 88, 96, 104, 112, 120);
            let at = _mm512_add_epi32(_mm512_set1_epi32((first * FIELDS as u32) as i32), lane);
            // Compressing in a register and storing it whole is faster than a compressing store.
            _mm512_storeu_si512(out.cast(), _mm512_maskz_compress_epi32(mask as u16, at));
        }
        mask.count_ones() as usize
    }
}

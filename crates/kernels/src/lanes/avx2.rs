//! 256-bit lanes (AVX2 and FMA): eight `f32` or four `f64`.

use super::{FIELDS, Lanes, SearchLanes};
use core::arch::x86_64::*;

/// Eight `f32`.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct F32x8(__m256);

/// Four `f64`.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub struct F64x4(__m256d);

// SAFETY of every block in this file: values of these types are made only inside a function that
// enables the instructions after `Isa` has found them (see `crate::isa`); pointers are vouched for
// by the callers of the `unsafe` methods.
arithmetic!(F32x8, _mm256_add_ps, _mm256_sub_ps, _mm256_mul_ps);
arithmetic!(F64x4, _mm256_add_pd, _mm256_sub_pd, _mm256_mul_pd);

// Helpers are functions, not closures: a closure cannot be forced to be inlined, and outside the
// functions that enable the instructions it is ten times slower.

/// The first four fields of the records at `at[0]` and `at[4]`, side by side.
#[inline(always)]
unsafe fn two_halves(base: *const f32, at: *const u32) -> __m256 {
    unsafe {
        let a = _mm_loadu_ps(base.add(*at as usize));
        let b = _mm_loadu_ps(base.add(*at.add(4) as usize));
        _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(a), b)
    }
}

/// Four fields of eight records, transposed within halves.
#[inline(always)]
unsafe fn four_fields(base: *const f32, at: *const u32) -> [F32x8; 4] {
    unsafe {
        let (a, b) = (two_halves(base, at), two_halves(base, at.add(1)));
        let (c, d) = (two_halves(base, at.add(2)), two_halves(base, at.add(3)));
        let (ab_low, ab_high) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
        let (cd_low, cd_high) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
        [
            F32x8(_mm256_shuffle_ps::<0x44>(ab_low, cd_low)),
            F32x8(_mm256_shuffle_ps::<0xEE>(ab_low, cd_low)),
            F32x8(_mm256_shuffle_ps::<0x44>(ab_high, cd_high)),
            F32x8(_mm256_shuffle_ps::<0xEE>(ab_high, cd_high)),
        ]
    }
}

/// Two fields of four records.
#[inline(always)]
unsafe fn two_fields(base: *const f64, at: *const u32) -> (F64x4, F64x4) {
    unsafe {
        let (a0, a2) = (_mm_loadu_pd(base.add(*at as usize)), _mm_loadu_pd(base.add(*at.add(2) as usize)));
        let (a1, a3) =
            (_mm_loadu_pd(base.add(*at.add(1) as usize)), _mm_loadu_pd(base.add(*at.add(3) as usize)));
        let a = _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(a0), a2);
        let b = _mm256_insertf128_pd::<1>(_mm256_castpd128_pd256(a1), a3);
        (F64x4(_mm256_unpacklo_pd(a, b)), F64x4(_mm256_unpackhi_pd(a, b)))
    }
}

/// Separations from eight candidates along one axis, in supports.
#[inline(always)]
unsafe fn search_delta(own: i32, p: *const i32, unit: __m256) -> __m256 {
    unsafe {
        let difference = _mm256_sub_epi32(_mm256_set1_epi32(own), _mm256_loadu_si256(p.cast()));
        _mm256_mul_ps(_mm256_cvtepi32_ps(difference), unit)
    }
}

/// Bit mask of eight candidates closer than one support.
#[inline(always)]
unsafe fn within_eight(own: [i32; 3], x: *const i32, y: *const i32, z: *const i32, unit: __m256) -> u32 {
    unsafe {
        let (dx, dy) = (search_delta(own[0], x, unit), search_delta(own[1], y, unit));
        let dz = search_delta(own[2], z, unit);
        let r2 = _mm256_fmadd_ps(dx, dx, _mm256_fmadd_ps(dy, dy, _mm256_mul_ps(dz, dz)));
        _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(r2, _mm256_set1_ps(1.0))) as u32
    }
}

impl Lanes for F32x8 {
    type Elem = f32;
    const N: usize = 8;

    #[inline(always)]
    fn splat(x: f32) -> Self {
        unsafe { Self(_mm256_set1_ps(x)) }
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm256_fmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm256_fnmadd_ps(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        unsafe { Self(_mm256_max_ps(self.0, o.0)) }
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        unsafe { Self(_mm256_min_ps(self.0, o.0)) }
    }
    /// Twelve-bit estimate and one Newton step.
    #[inline(always)]
    fn rsqrt(self) -> Self {
        let estimate = unsafe { Self(_mm256_rsqrt_ps(self.0)) };
        let half = self * Self::splat(0.5) * estimate;
        estimate * half.fnma(estimate, Self::splat(1.5))
    }
    #[inline(always)]
    fn sum(self) -> f64 {
        unsafe {
            let four = _mm_add_ps(_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0));
            let two = _mm_add_ps(four, _mm_movehl_ps(four, four));
            f64::from(_mm_cvtss_f32(_mm_add_ss(two, _mm_shuffle_ps::<1>(two, two))))
        }
    }
    #[inline(always)]
    fn delta(self, o: Self, unit: Self) -> Self {
        unsafe {
            let difference = _mm256_sub_epi32(_mm256_castps_si256(self.0), _mm256_castps_si256(o.0));
            Self(_mm256_mul_ps(_mm256_cvtepi32_ps(difference), unit.0))
        }
    }
    #[inline(always)]
    unsafe fn load(p: *const f32) -> Self {
        unsafe { Self(_mm256_loadu_ps(p)) }
    }
    #[inline(always)]
    unsafe fn store(self, p: *mut f32) {
        unsafe { _mm256_storeu_ps(p, self.0) }
    }
    /// Halves of two records a register, then 4x4 transposes within halves.
    #[inline(always)]
    unsafe fn records(base: *const f32, at: *const u32) -> [Self; FIELDS] {
        unsafe {
            let ([f0, f1, f2, f3], [f4, f5, f6, f7]) = (four_fields(base, at), four_fields(base.add(4), at));
            [f0, f1, f2, f3, f4, f5, f6, f7]
        }
    }
    #[inline(always)]
    fn prefetch(p: *const u32) {
        unsafe { _mm_prefetch::<_MM_HINT_T0>(p.cast()) }
    }
}

impl Lanes for F64x4 {
    type Elem = f64;
    const N: usize = 4;

    #[inline(always)]
    fn splat(x: f64) -> Self {
        unsafe { Self(_mm256_set1_pd(x)) }
    }
    #[inline(always)]
    fn fma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm256_fmadd_pd(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn fnma(self, b: Self, c: Self) -> Self {
        unsafe { Self(_mm256_fnmadd_pd(self.0, b.0, c.0)) }
    }
    #[inline(always)]
    fn max(self, o: Self) -> Self {
        unsafe { Self(_mm256_max_pd(self.0, o.0)) }
    }
    #[inline(always)]
    fn min(self, o: Self) -> Self {
        unsafe { Self(_mm256_min_pd(self.0, o.0)) }
    }
    #[inline(always)]
    fn rsqrt(self) -> Self {
        unsafe { Self(_mm256_div_pd(_mm256_set1_pd(1.0), _mm256_sqrt_pd(self.0))) }
    }
    #[inline(always)]
    fn sum(self) -> f64 {
        unsafe {
            let two = _mm_add_pd(_mm256_castpd256_pd128(self.0), _mm256_extractf128_pd::<1>(self.0));
            _mm_cvtsd_f64(_mm_add_sd(two, _mm_unpackhi_pd(two, two)))
        }
    }
    #[inline(always)]
    fn delta(self, o: Self, _unit: Self) -> Self {
        self - o
    }
    #[inline(always)]
    unsafe fn load(p: *const f64) -> Self {
        unsafe { Self(_mm256_loadu_pd(p)) }
    }
    #[inline(always)]
    unsafe fn store(self, p: *mut f64) {
        unsafe { _mm256_storeu_pd(p, self.0) }
    }
    /// Quarters of two records a register, then 2x2 transposes.
    #[inline(always)]
    unsafe fn records(base: *const f64, at: *const u32) -> [Self; FIELDS] {
        unsafe {
            let ((f0, f1), (f2, f3), (f4, f5), (f6, f7)) = (
                two_fields(base, at),
                two_fields(base.add(2), at),
                two_fields(base.add(4), at),
                two_fields(base.add(6), at),
            );
            [f0, f1, f2, f3, f4, f5, f6, f7]
        }
    }
    #[inline(always)]
    fn prefetch(p: *const u32) {
        unsafe { _mm_prefetch::<_MM_HINT_T0>(p.cast()) }
    }
}

/// Search over sixteen candidates as two registers.
#[derive(Clone, Copy)]
pub(crate) struct Search;

impl SearchLanes for Search {
    const N: usize = 16;

    #[inline(always)]
    unsafe fn within(own: [i32; 3], x: *const i32, y: *const i32, z: *const i32, unit: f32) -> u32 {
        unsafe {
            let unit = _mm256_set1_ps(unit);
            within_eight(own, x, y, z, unit) | within_eight(own, x.add(8), y.add(8), z.add(8), unit) << 8
        }
    }
}

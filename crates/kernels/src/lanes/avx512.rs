//! 512-bit lanes (AVX-512 F, BW, DQ, VL): sixteen `f32` or eight `f64`.

use super::{FIELDS, Lanes, SearchLanes};
use core::arch::x86_64::*;
use std::ops::{Add, Mul, Sub};

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
macro_rules! arithmetic {
    ($name:ident, $add:ident, $sub:ident, $mul:ident) => {
        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, o: Self) -> Self {
                unsafe { Self($add(self.0, o.0)) }
            }
        }
        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                unsafe { Self($sub(self.0, o.0)) }
            }
        }
        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, o: Self) -> Self {
                unsafe { Self($mul(self.0, o.0)) }
            }
        }
    };
}
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
            let pair = |k: usize| {
                let a = _mm256_loadu_ps(base.add(*at.add(k) as usize));
                let b = _mm256_loadu_ps(base.add(*at.add(k + 8) as usize));
                _mm512_insertf32x8::<1>(_mm512_castps256_ps512(a), b)
            };
            let (z0, z1, z2, z3) = (pair(0), pair(1), pair(2), pair(3));
            let (z4, z5, z6, z7) = (pair(4), pair(5), pair(6), pair(7));
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
            let record = |k: usize| _mm512_loadu_pd(base.add(*at.add(k) as usize));
            let z: [__m512d; 8] =
                [record(0), record(1), record(2), record(3), record(4), record(5), record(6), record(7)];
            let gather = |a: __m512d, b: __m512d, c: __m512d, d: __m512d| {
                let (ab_even, ab_odd) = (_mm512_shuffle_f64x2::<0x88>(a, b), _mm512_shuffle_f64x2::<0xDD>(a, b));
                let (cd_even, cd_odd) = (_mm512_shuffle_f64x2::<0x88>(c, d), _mm512_shuffle_f64x2::<0xDD>(c, d));
                [
                    Self(_mm512_shuffle_f64x2::<0x88>(ab_even, cd_even)),
                    Self(_mm512_shuffle_f64x2::<0x88>(ab_odd, cd_odd)),
                    Self(_mm512_shuffle_f64x2::<0xDD>(ab_even, cd_even)),
                    Self(_mm512_shuffle_f64x2::<0xDD>(ab_odd, cd_odd)),
                ]
            };
            let even = gather(
                _mm512_unpacklo_pd(z[0], z[1]),
                _mm512_unpacklo_pd(z[2], z[3]),
                _mm512_unpacklo_pd(z[4], z[5]),
                _mm512_unpacklo_pd(z[6], z[7]),
            );
            let odd = gather(
                _mm512_unpackhi_pd(z[0], z[1]),
                _mm512_unpackhi_pd(z[2], z[3]),
                _mm512_unpackhi_pd(z[4], z[5]),
                _mm512_unpackhi_pd(z[6], z[7]),
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
            let delta = |own: i32, p: *const i32| {
                let difference = _mm512_sub_epi32(_mm512_set1_epi32(own), _mm512_loadu_si512(p.cast()));
                _mm512_mul_ps(_mm512_cvtepi32_ps(difference), unit)
            };
            let (dx, dy, dz) = (delta(own[0], x), delta(own[1], y), delta(own[2], z));
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

//! Vector lanes: one small trait, one implementation per instruction set and precision.
//!
//! Physics is written once over [`Lanes`]; which implementation runs is chosen at run time by
//! [`crate::Isa`]. The one-lane implementations are the reference the others are tested against.

/// Sum, difference and product of a vector type by three instructions.
///
/// Its `unsafe` is sound for the reason given in the files that use it: values of these types exist
/// only where the instructions do.
#[cfg(target_arch = "x86_64")]
macro_rules! arithmetic {
    ($name:ident, $add:ident, $sub:ident, $mul:ident) => {
        impl std::ops::Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, o: Self) -> Self {
                unsafe { Self($add(self.0, o.0)) }
            }
        }
        impl std::ops::Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                unsafe { Self($sub(self.0, o.0)) }
            }
        }
        impl std::ops::Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, o: Self) -> Self {
                unsafe { Self($mul(self.0, o.0)) }
            }
        }
    };
}
#[cfg(target_arch = "x86_64")]
pub(crate) mod avx2;
#[cfg(target_arch = "x86_64")]
pub(crate) mod avx512;
pub(crate) mod scalar;

use std::ops::{Add, Mul, Sub};

/// Fields of a packed particle record: x y z volume | u v w scalar.
pub const FIELDS: usize = 8;

/// Floating-point type of the pair loops: `f32` (mixed precision) or `f64` (double).
pub trait Real: Copy + Send + Sync + Default + 'static {
    /// Lanes of 512-bit registers.
    #[cfg(target_arch = "x86_64")]
    type Wide: Lanes<Elem = Self>;
    /// Lanes of 256-bit registers.
    #[cfg(target_arch = "x86_64")]
    type Medium: Lanes<Elem = Self>;
    /// One lane, the reference.
    type Single: Lanes<Elem = Self>;

    /// Name of the precision as it is written in case files: "mixed" or "double".
    const PRECISION: &'static str;

    /// Nearest value of this type; magnitudes below 1e-30 become zero, since subnormals are slow.
    fn pack(x: f64) -> Self;
    /// The value as `f64`.
    fn widen(self) -> f64;
    /// Encodes a coordinate for [`Lanes::delta`]: fixed-point bits for `f32`, the coordinate in supports for `f64`.
    fn coordinate(fixed: i32, in_supports: f64) -> Self;
}

impl Real for f32 {
    #[cfg(target_arch = "x86_64")]
    type Wide = avx512::F32x16;
    #[cfg(target_arch = "x86_64")]
    type Medium = avx2::F32x8;
    type Single = scalar::F32x1;
    const PRECISION: &'static str = "mixed";

    #[inline(always)]
    fn pack(x: f64) -> Self {
        if x.abs() < 1e-30 { 0.0 } else { x as f32 }
    }
    #[inline(always)]
    fn widen(self) -> f64 {
        f64::from(self)
    }
    #[inline(always)]
    fn coordinate(fixed: i32, _in_supports: f64) -> Self {
        Self::from_bits(fixed as u32)
    }
}

impl Real for f64 {
    #[cfg(target_arch = "x86_64")]
    type Wide = avx512::F64x8;
    #[cfg(target_arch = "x86_64")]
    type Medium = avx2::F64x4;
    type Single = scalar::F64x1;
    const PRECISION: &'static str = "double";

    #[inline(always)]
    fn pack(x: f64) -> Self {
        if x.abs() < 1e-30 { 0.0 } else { x }
    }
    #[inline(always)]
    fn widen(self) -> f64 {
        self
    }
    #[inline(always)]
    fn coordinate(_fixed: i32, in_supports: f64) -> Self {
        in_supports
    }
}

/// A vector of `N` numbers of one type.
///
/// Values of these types exist only inside `crate::isa::dispatch`, which has checked that the
/// processor has the instructions; that is what makes the arithmetic below safe to call.
pub trait Lanes: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// Element type.
    type Elem: Real;
    /// Number of lanes; divides 16.
    const N: usize;

    /// All lanes equal to `x`.
    fn splat(x: Self::Elem) -> Self;
    /// `self * b + c`.
    fn fma(self, b: Self, c: Self) -> Self;
    /// `c - self * b`.
    fn fnma(self, b: Self, c: Self) -> Self;
    /// Lane-wise maximum.
    fn max(self, o: Self) -> Self;
    /// Lane-wise minimum.
    fn min(self, o: Self) -> Self;
    /// `1 / sqrt(self)` to working precision for arguments above 1e-30.
    fn rsqrt(self) -> Self;
    /// Sum of the lanes, in a fixed order.
    fn sum(self) -> f64;
    /// [`Self::sum`] of eight vectors at once, to the same bits: together they need a third of the shuffles.
    #[inline(always)]
    fn sums(eight: [Self; 8]) -> [f64; 8] {
        [
            eight[0].sum(),
            eight[1].sum(),
            eight[2].sum(),
            eight[3].sum(),
            eight[4].sum(),
            eight[5].sum(),
            eight[6].sum(),
            eight[7].sum(),
        ]
    }
    /// Difference of two coordinates made by [`Real::coordinate`], in supports; `unit` is the
    /// fixed-point unit in supports.
    fn delta(self, o: Self, unit: Self) -> Self;

    /// Loads `N` numbers.
    ///
    /// # Safety
    /// `p` must be valid for reading `N` elements.
    unsafe fn load(p: *const Self::Elem) -> Self;
    /// Stores `N` numbers.
    ///
    /// # Safety
    /// `p` must be valid for writing `N` elements.
    unsafe fn store(self, p: *mut Self::Elem);
    /// Loads `N` records of eight fields at the element offsets `at[0..N]` and transposes them to
    /// one vector per field. The lane order is fixed but need not be that of `at`.
    ///
    /// # Safety
    /// `at` must be valid for `N` reads, and `base + at[k]` for reading eight elements each.
    unsafe fn records(base: *const Self::Elem, at: *const u32) -> [Self; FIELDS];

    /// The constant `x` in all lanes.
    #[inline(always)]
    fn constant(x: f64) -> Self {
        Self::splat(Self::Elem::pack(x))
    }
    /// Zero in all lanes.
    #[inline(always)]
    fn zero() -> Self {
        Self::splat(Self::Elem::default())
    }
    /// Asks for the cache line at `p`; any address will do.
    #[inline(always)]
    fn prefetch(p: *const u32) {
        let _ = p;
    }
}

/// Sums of the lanes, eight at a time; one or two are less work each by itself.
#[inline(always)]
pub(crate) fn add_lanes<L: Lanes, const K: usize>(total: &[L; K], sums: &mut [f64; K]) {
    // Not `total.map`: it is not inlined for long arrays, and leaves the vector instructions behind.
    let mut at = 0;
    while at < K {
        let n = (K - at).min(8);
        if n < 3 {
            for k in at..at + n {
                sums[k] = total[k].sum();
            }
        } else {
            let mut eight = [L::zero(); 8];
            eight[..n].copy_from_slice(&total[at..at + n]);
            sums[at..at + n].copy_from_slice(&L::sums(eight)[..n]);
        }
        at += n;
    }
}

/// Search half of the lanes: which of a run of candidates lie within one support.
///
/// Always single precision on fixed-point coordinates, so that both precisions see the same rows.
pub(crate) trait SearchLanes: Copy {
    /// Candidates handled at once.
    const N: usize;
    /// Bit mask of candidates `x[0..N]`, ... closer than one support to `own`.
    ///
    /// # Safety
    /// The three pointers must be valid for reading `N` elements.
    unsafe fn within(own: [i32; 3], x: *const i32, y: *const i32, z: *const i32, unit: f32) -> u32;
    /// Writes `8 * (first + k)` for every bit `k` of `mask` to `out`, in order, and returns how many.
    ///
    /// # Safety
    /// `out` must be valid for writing 16 elements, whatever the mask.
    #[inline(always)]
    unsafe fn compress(mask: u32, first: u32, out: *mut u32) -> usize {
        let mut rest = mask;
        let mut n = 0;
        while rest != 0 {
            // SAFETY: at most 16 bits are set, and the caller vouches for 16 elements.
            unsafe { *out.add(n) = FIELDS as u32 * (first + rest.trailing_zeros()) };
            rest &= rest - 1;
            n += 1;
        }
        n
    }
}

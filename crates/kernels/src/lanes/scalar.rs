//! One lane: the reference, and what runs where no vector instructions are known.

use super::{FIELDS, Lanes, SearchLanes};
use std::ops::{Add, Mul, Sub};

macro_rules! single {
    ($name:ident, $elem:ty, $delta:expr) => {
        #[doc = concat!("One `", stringify!($elem), "`.")]
        #[derive(Clone, Copy)]
        pub struct $name($elem);

        impl Add for $name {
            type Output = Self;
            #[inline(always)]
            fn add(self, o: Self) -> Self {
                Self(self.0 + o.0)
            }
        }
        impl Sub for $name {
            type Output = Self;
            #[inline(always)]
            fn sub(self, o: Self) -> Self {
                Self(self.0 - o.0)
            }
        }
        impl Mul for $name {
            type Output = Self;
            #[inline(always)]
            fn mul(self, o: Self) -> Self {
                Self(self.0 * o.0)
            }
        }

        impl Lanes for $name {
            type Elem = $elem;
            const N: usize = 1;

            #[inline(always)]
            fn splat(x: $elem) -> Self {
                Self(x)
            }
            // Without the FMA instruction `mul_add` is a library call, so the reference rounds twice.
            #[inline(always)]
            fn fma(self, b: Self, c: Self) -> Self {
                Self(self.0 * b.0 + c.0)
            }
            #[inline(always)]
            fn fnma(self, b: Self, c: Self) -> Self {
                Self(c.0 - self.0 * b.0)
            }
            #[inline(always)]
            fn max(self, o: Self) -> Self {
                Self(if self.0 > o.0 { self.0 } else { o.0 })
            }
            #[inline(always)]
            fn min(self, o: Self) -> Self {
                Self(if self.0 < o.0 { self.0 } else { o.0 })
            }
            #[inline(always)]
            fn rsqrt(self) -> Self {
                Self(1.0 / self.0.sqrt())
            }
            #[inline(always)]
            fn sum(self) -> f64 {
                f64::from(self.0)
            }
            #[inline(always)]
            fn delta(self, o: Self, unit: Self) -> Self {
                let f: fn($elem, $elem, $elem) -> $elem = $delta;
                Self(f(self.0, o.0, unit.0))
            }
            #[inline(always)]
            unsafe fn load(p: *const $elem) -> Self {
                // SAFETY: the caller vouches for the pointer.
                Self(unsafe { *p })
            }
            #[inline(always)]
            unsafe fn store(self, p: *mut $elem) {
                // SAFETY: the caller vouches for the pointer.
                unsafe { *p = self.0 }
            }
            #[inline(always)]
            unsafe fn records(base: *const $elem, at: *const u32) -> [Self; FIELDS] {
                // SAFETY: the caller vouches for the offset and the eight fields behind it.
                std::array::from_fn(|k| Self(unsafe { *base.add(*at as usize + k) }))
            }
        }
    };
}

single!(F32x1, f32, |a, b, unit| (a.to_bits() as i32).wrapping_sub(b.to_bits() as i32) as f32 * unit);
single!(F64x1, f64, |a, b, _| a - b);

/// Scalar search, 16 candidates a call.
#[derive(Clone, Copy)]
pub(crate) struct Search;

impl SearchLanes for Search {
    const N: usize = 16;

    #[inline(always)]
    unsafe fn within(own: [i32; 3], x: *const i32, y: *const i32, z: *const i32, unit: f32) -> u32 {
        let mut mask = 0;
        for k in 0..Self::N {
            // SAFETY: the caller vouches for `N` elements behind each pointer.
            let other = unsafe { [*x.add(k), *y.add(k), *z.add(k)] };
            let d: [f32; 3] = std::array::from_fn(|c| own[c].wrapping_sub(other[c]) as f32 * unit);
            mask |= u32::from(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < 1.0) << k;
        }
        mask
    }
}

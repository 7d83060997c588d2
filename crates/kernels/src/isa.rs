//! Choice of the instruction set at run time.

use crate::lanes::{Lanes, Real};

/// Instruction sets the pair loops know, best first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Level {
    #[cfg(target_arch = "x86_64")]
    Avx512,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    Scalar,
}

/// An instruction set this processor is known to have.
///
/// It can only be made by asking the processor, so holding one is the proof that its instructions may be used.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Isa(Level);

impl Isa {
    /// The best instruction set of this processor.
    pub fn detect() -> Self {
        Self::available()[0]
    }

    /// One lane at a time: the reference.
    pub fn scalar() -> Self {
        Self(Level::Scalar)
    }

    /// All instruction sets of this processor, best first; the last is the scalar reference.
    pub fn available() -> Vec<Self> {
        let mut found = Vec::new();
        #[cfg(target_arch = "x86_64")]
        {
            // Bit counting is for the search; every processor with AVX2 has it.
            let bits = is_x86_feature_detected!("bmi1") && is_x86_feature_detected!("popcnt");
            let avx2 = bits && is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma");
            let avx512 = is_x86_feature_detected!("avx512f")
                && is_x86_feature_detected!("avx512bw")
                && is_x86_feature_detected!("avx512dq")
                && is_x86_feature_detected!("avx512vl");
            if avx2 && avx512 {
                found.push(Self(Level::Avx512));
            }
            if avx2 {
                found.push(Self(Level::Avx2));
            }
        }
        found.push(Self::scalar());
        found
    }

    /// "avx512", "avx2" or "scalar".
    pub fn name(self) -> &'static str {
        match self.0 {
            #[cfg(target_arch = "x86_64")]
            Level::Avx512 => "avx512",
            #[cfg(target_arch = "x86_64")]
            Level::Avx2 => "avx2",
            Level::Scalar => "scalar",
        }
    }
}

/// Runs `work` on one number after the other, compiled for `isa`: by that it is faster, with the same results for all.
///
/// The closure must be marked `#[inline(always)]`, where it is handed over: else it is compiled without those instructions.
pub fn run_on(isa: Isa, work: impl FnOnce()) {
    struct Plain<F>(F);
    impl<F: FnOnce()> LaneWork<f64> for Plain<F> {
        #[inline(always)]
        fn run<L: Lanes<Elem = f64>, S: crate::lanes::SearchLanes>(self) {
            (self.0)();
        }
    }
    dispatch::<f64, _>(isa, Plain(work));
}

/// Work written once over lanes. `run` must be `#[inline(always)]`, else it is compiled without
/// the instructions that [`dispatch`] enables.
pub(crate) trait LaneWork<R: Real> {
    /// Lane type of the search goes with that of the arithmetic.
    fn run<L: Lanes<Elem = R>, S: crate::lanes::SearchLanes>(self);
}

/// Runs `work` with the lanes of `isa`.
pub(crate) fn dispatch<R: Real, W: LaneWork<R>>(isa: Isa, work: W) {
    match isa.0 {
        // SAFETY: an `Isa` exists only for what `Isa::available` found on this processor.
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => unsafe { run_avx512::<R, W>(work) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => unsafe { run_avx2::<R, W>(work) },
        Level::Scalar => work.run::<R::Single, crate::lanes::scalar::Search>(),
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl,avx2,fma,bmi1,popcnt")]
unsafe fn run_avx512<R: Real, W: LaneWork<R>>(work: W) {
    work.run::<R::Wide, crate::lanes::avx512::Search>();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,popcnt")]
unsafe fn run_avx2<R: Real, W: LaneWork<R>>(work: W) {
    work.run::<R::Medium, crate::lanes::avx2::Search>();
}

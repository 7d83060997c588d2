//! A profile made ready for the cap it is imposed at.

use super::section::Section;
use super::womersley::Harmonic;
use super::{Profile, radial_fraction};
use crate::waveform::{Fourier, Signal, Source};
use num_complex::Complex64;
use std::f64::consts::TAU;
use vaso_fluid::Numbers;
use vaso_geometry::Opening;
use vaso_particles::Memory;

/// A profile over a cap: a steady shape, and for pulsatile flow one complex shape a harmonic.
#[derive(Clone, Debug)]
pub struct Inlet {
    shape: Shape,
    waves: Vec<Harmonic>,
    series: Option<Fourier>,
    /// Factors that make the flow of the particles the asked one, steady part and harmonics.
    factor: f64,
    wave_factors: Vec<Complex64>,
    /// Whether the factors have been found once.
    is_scaled: bool,
}

#[derive(Clone, Debug)]
enum Shape {
    Plug,
    Power { exponent: f64, polygon: Vec<[f64; 2]> },
    Section(Section),
}

/// Most harmonics of a Womersley profile; what a waveform has beyond rides on the last.
const HARMONICS: usize = 16;
/// Part of the waveform's peak below which a harmonic is no longer worth its own shape.
const FAINT: f64 = 1e-3;
/// Bounds of the factors that make the injected flow the asked one.
const FLOW_FACTOR: (f64, f64) = (0.8, 1.25);
/// Share of the way to the factors of the moment that is gone in an advective step: what chance has in the buffer changes from step to step by
/// some per cent, and a velocity that followed it at once would be heard as sound. A buffer is passed in about ten steps.
const FOLLOWED: f64 = 0.1;

/// How much of each shape flows at a moment \[m/s\].
#[derive(Clone, Debug, Default)]
pub(crate) struct Amplitudes {
    pub(crate) steady: f64,
    pub(crate) waves: Vec<Complex64>,
}

impl Inlet {
    /// The `profile` of a section mean `mean` \[m/s\] over the cap `opening`.
    pub fn new(profile: Profile, mean: &Signal, opening: &Opening, numbers: &Numbers) -> Self {
        let polygon = &opening.polygon;
        let shape = match profile {
            Profile::Plug => Shape::Plug,
            Profile::Parabolic => Shape::Power { exponent: 2.0, polygon: polygon.clone() },
            Profile::Power { exponent } => Shape::Power { exponent, polygon: polygon.clone() },
            Profile::FullyDeveloped | Profile::Womersley => Shape::Section(Section::new(polygon)),
        };
        let series = match (&mean.source, profile) {
            // Without a period there are no harmonics, and the flow is taken for steady at each moment.
            (Source::Waveform(wave), Profile::Womersley) => wave.harmonics(HARMONICS).ok(),
            _ => None,
        };
        let amplitude = |s: &Fourier, k: usize| s.cosine[k].hypot(s.sine[k]);
        let count = series.as_ref().map_or(0, |s| {
            let heard = |k: &usize| amplitude(s, *k) > FAINT * mean.peak();
            (0..s.cosine.len()).rev().find(heard).map_or(0, |k| k + 1)
        });
        let series = series.map(|mut s| {
            s.cosine.truncate(count);
            s.sine.truncate(count);
            s
        });
        let viscous = numbers.viscosity / numbers.rest_density;
        let waves = series.iter().flat_map(|s| (1..=count).map(|k| s.frequency(k)));
        let waves: Vec<Harmonic> =
            waves.map(|w| Harmonic::new(opening.radius * (w / viscous).sqrt())).collect();
        let wave_factors = vec![Complex64::ONE; waves.len()];
        Self { shape, waves, series, factor: 1.0, wave_factors, is_scaled: false }
    }

    /// Steady velocity over its mean at the in-plane point `at` \[m\] about the centre of the cap.
    pub fn steady(&self, at: [f64; 2]) -> f64 {
        match &self.shape {
            Shape::Plug => 1.0,
            Shape::Power { exponent, polygon } => {
                let s = radial_fraction(at, polygon);
                (1.0 + 2.0 / exponent) * (1.0 - s.powf(*exponent)).max(0.0)
            }
            Shape::Section(section) => section.at(at),
        }
    }

    /// Velocity at the in-plane point `at` \[m\] and the time `t` \[s\], if `mean` is what the profile was made for \[m/s\].
    pub fn velocity(&self, at: [f64; 2], mean: &Signal, t: f64) -> f64 {
        let mut amplitudes = Amplitudes::default();
        self.set_amplitudes(mean, t, &mut amplitudes);
        let waves: Complex64 = self.waves(at).zip(&amplitudes.waves).map(|(w, a)| w * a).sum();
        amplitudes.steady * self.steady(at) + waves.re
    }

    /// Number of harmonics.
    pub(crate) fn n_waves(&self) -> usize {
        self.waves.len()
    }

    /// Shapes of the harmonics at a point.
    pub(crate) fn waves(&self, at: [f64; 2]) -> impl Iterator<Item = Complex64> {
        let radius = match &self.shape {
            Shape::Section(section) if !self.waves.is_empty() => section.radius(at),
            _ => 0.0,
        };
        self.waves.iter().map(move |wave| wave.at(radius))
    }

    /// Brings the flow that the particles carry to the asked one, from what they carry of each shape and what they ought to
    /// \[m^3\]: at once the first time, later within the time in which the buffer is passed. `part` is that of a full advective step which the
    /// last one was.
    pub(crate) fn scale(&mut self, steady: f64, waves: &[Complex64], asked: f64, part: f64) {
        let (low, high) = FLOW_FACTOR;
        let share = if self.is_scaled { part * FOLLOWED } else { 1.0 };
        self.is_scaled = true;
        let factor = if steady > 0.0 { (asked / steady).clamp(low, high) } else { 1.0 };
        self.factor += share * (factor - self.factor);
        for (factor, carried) in self.wave_factors.iter_mut().zip(waves) {
            let wanted = asked / carried;
            let size = wanted.norm();
            let wanted =
                if size.is_finite() { wanted * (size.clamp(low, high) / size) } else { Complex64::ONE };
            *factor += share * (wanted - *factor);
        }
    }

    /// Shows the factors, which the next step goes on from.
    pub(crate) fn remember(&mut self, name: &str, memory: &mut dyn Memory) {
        let Self { shape: _, waves: _, series: _, factor, wave_factors, is_scaled } = self;
        let mut scaled = u64::from(*is_scaled);
        memory.counts(&format!("{name}.is_scaled"), &mut [&mut scaled]);
        *is_scaled = scaled != 0;
        memory.fields(&format!("{name}.factor"), &mut [factor]);
        let mut parts: Vec<&mut f64> = wave_factors.iter_mut().flat_map(|w| [&mut w.re, &mut w.im]).collect();
        memory.fields(&format!("{name}.wave_factors"), &mut parts);
    }

    /// Notes how much of each shape flows at `t` \[s\], the factors included.
    pub(crate) fn set_amplitudes(&self, mean: &Signal, t: f64, amplitudes: &mut Amplitudes) {
        let waves = &mut amplitudes.waves;
        waves.clear();
        let Some(series) = &self.series else {
            amplitudes.steady = mean.at(t) * self.factor;
            return;
        };
        let risen = mean.risen(t);
        let mut steady = risen * series.mean;
        let turns = (t / series.period).rem_euclid(1.0);
        waves.extend((0..self.waves.len()).map(|k| {
            let phase = TAU * turns * (k + 1) as f64;
            risen * Complex64::new(series.cosine[k], -series.sine[k]) * Complex64::from_polar(1.0, phase)
        }));
        let rest = mean.at(t) - risen * series.at(t);
        match waves.last_mut() {
            Some(last) => *last += rest,
            None => steady += rest,
        }
        for (wave, factor) in waves.iter_mut().zip(&self.wave_factors) {
            *wave *= factor;
        }
        amplitudes.steady = steady * self.factor;
    }
}

#[cfg(test)]
mod tests;

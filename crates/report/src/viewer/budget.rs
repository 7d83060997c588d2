//! What goes into the page where not all of a run can: fewer frames, fewer particles, always evenly.

/// Frames kept at most, however little they take: a slider of more is not told apart.
const MOST_FRAMES: usize = 120;

/// The largest set of frames, spread evenly over time, that costs no more than `room` bytes by `cost`; empty where not even the last
/// fits, or without frames. The first and the last are always among them where there is room for two.
pub(super) fn frames(times: &[f64], room: usize, cost: impl Fn(&[usize]) -> usize) -> Vec<usize> {
    let most = times.len().min(MOST_FRAMES);
    (1..=most)
        .rev()
        .map(|wanted| spread(times, wanted))
        .find(|chosen| cost(chosen) <= room)
        .unwrap_or_default()
}

/// Indices of about `wanted` frames that lie evenly over time, each once; one alone is the last.
fn spread(times: &[f64], wanted: usize) -> Vec<usize> {
    let Some(last) = times.len().checked_sub(1) else { return Vec::new() };
    if wanted >= times.len() {
        return (0..times.len()).collect();
    }
    if wanted <= 1 {
        return vec![last];
    }
    let mut chosen: Vec<usize> = (0..wanted)
        .map(|k| {
            let part = k as f64 / (wanted - 1) as f64;
            nearest(times, times[0] + part * (times[last] - times[0]))
        })
        .collect();
    chosen.dedup();
    chosen
}

/// Index of the time nearest to `time` of an ascending list that is not empty.
pub(super) fn nearest(times: &[f64], time: f64) -> usize {
    let after = times.partition_point(|&t| t < time).min(times.len() - 1);
    let before = after.saturating_sub(1);
    if time - times[before] <= times[after] - time { before } else { after }
}

/// Indices of at most `most` of `count` particles. Those with identities are chosen by them, so that the same are seen in each
/// frame; `largest` is the number of particles in the frame that has the most.
pub(super) fn particles(ids: Option<&[u64]>, count: usize, largest: usize, most: usize) -> Vec<usize> {
    if largest <= most {
        return (0..count).collect();
    }
    let Some(ids) = ids else {
        let step = largest.div_ceil(most.max(1));
        return (0..count).step_by(step).take(most).collect();
    };
    // A little less than there is room for, as the number that falls to a frame scatters.
    let share = 0.98 * most as f64 / largest as f64;
    let limit = (share * u64::MAX as f64) as u64;
    (0..count).filter(|&i| ids.get(i).is_some_and(|&id| mixed(id) < limit)).take(most).collect()
}

/// The finalizer of SplitMix64 (Steele, Lea, Flood 2014): neighbours in number become strangers.
fn mixed(id: u64) -> u64 {
    let mut x = id.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_even_over_time_and_hold_the_budget() {
        let times: Vec<f64> = (0..100).map(|k| 0.01 * f64::from(k)).collect();
        let each = |chosen: &[usize]| 10 * chosen.len();
        assert_eq!(frames(&times, 1000, each).len(), 100);
        let some = frames(&times, 105, each);
        assert_eq!((some.len(), some[0], some[9]), (10, 0, 99));
        assert!(some.windows(2).all(|pair| pair[1] - pair[0] == 11), "{some:?}");
        assert_eq!(frames(&times, 10, each), [99]);
        assert!(frames(&times, 9, each).is_empty() && frames(&[], 9, each).is_empty());
        // Crowded times: what lies together is thinned first, and none is taken twice.
        let crowded: Vec<f64> = (0..50).map(|k| 1e-3 * f64::from(k)).chain([1.0, 2.0, 3.0]).collect();
        assert_eq!(frames(&crowded, 40, each), [0, 50, 51, 52]);
        let many: Vec<f64> = (0..1000).map(f64::from).collect();
        assert_eq!(frames(&many, usize::MAX, each).len(), MOST_FRAMES);
    }

    #[test]
    fn the_nearest_time_is_found() {
        let times = [0.0, 1.0, 3.0];
        for (time, index) in [(-1.0, 0), (0.4, 0), (0.6, 1), (1.9, 1), (2.1, 2), (9.0, 2)] {
            assert_eq!(nearest(&times, time), index, "{time}");
        }
    }

    #[test]
    fn the_same_particles_are_chosen_in_each_frame() {
        let first: Vec<u64> = (0..10_000).collect();
        let later: Vec<u64> = (500..10_500).rev().collect();
        let of = |ids: &[u64]| -> Vec<u64> {
            particles(Some(ids), ids.len(), 10_000, 1000).into_iter().map(|i| ids[i]).collect()
        };
        let (a, b) = (of(&first), of(&later));
        assert!(
            (900..=1000).contains(&a.len()) && (900..=1000).contains(&b.len()),
            "{} {}",
            a.len(),
            b.len()
        );
        let common = a.iter().filter(|&&id| id >= 500).count();
        assert_eq!(common, a.iter().filter(|id| b.contains(id)).count());
        // Without identities each so many; and all where all fit.
        let none = particles(None, 10_000, 10_000, 300);
        assert!(none.len() <= 300 && none.len() > 250 && none[1] == 34, "{}", none.len());
        assert_eq!(particles(None, 5, 10, 10), [0, 1, 2, 3, 4]);
        assert!(particles(Some(&first), 10_000, 10_000, 0).is_empty());
    }
}

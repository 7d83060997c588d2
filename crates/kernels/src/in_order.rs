//! Sums over particles whose bits depend on no thread.

use rayon::iter::plumbing::{Producer, ProducerCallback};
use rayon::prelude::*;
use std::ops::Add;

/// Combines the items of `items` two by two in a tree whose shape depends on their number alone: the same bits for any number of threads.
/// Nothing is allocated, unlike by sums that are collected first. `None` of no items.
///
/// They are shared among some hundred tasks at most.
pub fn reduce_in_order<I: IndexedParallelIterator>(
    items: I,
    combine: impl Fn(I::Item, I::Item) -> I::Item + Sync,
) -> Option<I::Item> {
    let n = items.len();
    items.with_producer(Tree { n, leaf: n.div_ceil(LEAVES), combine: &combine })
}

/// Tasks that many items are shared among, about: enough for some dozens of threads, and so few that handing them over costs nothing.
const LEAVES: usize = 128;

/// [`reduce_in_order`] by addition; zero of no items.
pub fn sum_in_order<I: IndexedParallelIterator>(items: I) -> I::Item
where
    I::Item: Add<Output = I::Item> + Default,
{
    reduce_in_order(items, Add::add).unwrap_or_default()
}

struct Tree<'a, F> {
    n: usize,
    leaf: usize,
    combine: &'a F,
}

impl<T: Send, F: Fn(T, T) -> T + Sync> ProducerCallback<T> for Tree<'_, F> {
    type Output = Option<T>;

    fn callback<P: Producer<Item = T>>(self, producer: P) -> Option<T> {
        fold(producer, self.n, self.leaf, self.combine)
    }
}

fn fold<P: Producer<Item: Send>>(
    producer: P,
    n: usize,
    leaf: usize,
    combine: &(impl Fn(P::Item, P::Item) -> P::Item + Sync),
) -> Option<P::Item> {
    if n <= leaf {
        return producer.into_iter().reduce(combine);
    }
    let (first, second) = producer.split_at(n / 2);
    let (a, b) = rayon::join(|| fold(first, n / 2, leaf, combine), || fold(second, n - n / 2, leaf, combine));
    match (a, b) {
        (Some(a), Some(b)) => Some(combine(a, b)),
        (a, b) => a.or(b),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_threads<T: Send>(n: usize, work: impl FnOnce() -> T + Send) -> T {
        rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("threads can be had").install(work)
    }

    #[test]
    fn a_sum_has_the_same_bits_for_any_number_of_threads() {
        let terms: Vec<f64> = (0..1001).map(|k| (f64::from(k) * 0.7).sin() * 1e3_f64.powi(k % 5)).collect();
        let sum = |threads| with_threads(threads, || sum_in_order(terms.par_iter().copied()));
        let exact: f64 = terms.iter().sum();
        assert!((sum(1) - exact).abs() < 1e-12 * terms.iter().map(|t| t.abs()).sum::<f64>());
        for threads in 2..5 {
            assert_eq!(sum(threads).to_bits(), sum(1).to_bits());
        }
    }

    #[test]
    fn order_is_kept_and_nothing_gives_nothing() {
        let all = reduce_in_order((0..37).into_par_iter().map(|k| vec![k]), |mut a, b| {
            a.extend(b);
            a
        });
        assert_eq!(all, Some((0..37).collect()));
        assert_eq!(sum_in_order(Vec::<f64>::new().into_par_iter()), 0.0);
        let first = |a: Result<i32, i32>, b: Result<i32, i32>| Ok(a? + b?);
        let failing = (0..20).into_par_iter().map(|k| if k % 7 == 6 { Err(k) } else { Ok(k) });
        assert_eq!(reduce_in_order(failing, first), Some(Err(6)), "the first that fails is told");
    }
}

//! Border edges chained to closed loops.

use std::collections::BTreeMap;

/// Chains directed edges to closed loops of vertices, each without a repeated vertex.
///
/// Where a loop would run through a vertex twice it is cut there into two, so two holes that touch give
/// two loops. Edges that lead nowhere, as a non-manifold surface may have, are left out.
pub(crate) fn chain(edges: &[[u32; 2]]) -> Vec<Vec<u32>> {
    let mut outgoing: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &[from, to] in edges {
        outgoing.entry(from).or_default().push(to);
    }
    // Popped from the end: the smallest successor comes first.
    outgoing.values_mut().for_each(|to| to.sort_unstable_by(|a, b| b.cmp(a)));
    let starts: Vec<u32> = outgoing.keys().copied().collect();
    let mut loops = Vec::new();
    for start in starts {
        while let Some(first) = outgoing.get_mut(&start).and_then(Vec::pop) {
            walk(start, first, &mut outgoing, &mut loops);
        }
    }
    loops
}

/// Follows edges from `start`, moving every closed part of the path to `loops`, until none goes on.
fn walk(start: u32, first: u32, outgoing: &mut BTreeMap<u32, Vec<u32>>, loops: &mut Vec<Vec<u32>>) {
    let mut path = vec![start];
    let mut place = BTreeMap::from([(start, 0)]);
    let mut next = first;
    loop {
        if let Some(&at) = place.get(&next) {
            let closed = path.split_off(at);
            closed.iter().for_each(|v| {
                place.remove(v);
            });
            if closed.len() >= 3 {
                loops.push(closed);
            }
        }
        place.insert(next, path.len());
        path.push(next);
        match outgoing.get_mut(&next).and_then(Vec::pop) {
            Some(to) => next = to,
            None => return,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_separate_loops() {
        let edges = [[5, 6], [0, 1], [6, 7], [1, 2], [2, 0], [7, 5]];
        assert_eq!(chain(&edges), vec![vec![0, 1, 2], vec![5, 6, 7]]);
    }

    #[test]
    fn loops_that_touch_are_cut_apart() {
        let edges = [[0, 1], [1, 2], [2, 0], [2, 3], [3, 4], [4, 2]];
        let mut lengths: Vec<usize> = chain(&edges).iter().map(Vec::len).collect();
        lengths.sort_unstable();
        assert_eq!(lengths, vec![3, 3]);
    }

    #[test]
    fn an_open_chain_is_no_loop() {
        assert!(chain(&[[0, 1], [1, 2]]).is_empty());
    }
}

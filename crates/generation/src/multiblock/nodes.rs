//! Particles at the nodes of cells.

use super::fill::Filling;
use glam::DVec3;
use std::collections::BTreeMap;

/// Nodes nearer than this are one, in spacings.
const NEAR: f64 = 0.3;

/// Nodes of all sound cells with an eighth of the volume of each cell around them \[m^3\]; nodes that come
/// together, of neighbouring blocks or limbs, are one particle at the mean of their places.
pub(super) fn merged(fillings: &[Filling], spacing: f64) -> (Vec<DVec3>, Vec<f64>) {
    let reach = NEAR * spacing;
    let mut merge = Merge {
        reach,
        buckets: BTreeMap::new(),
        first: Vec::new(),
        sum: Vec::new(),
        count: Vec::new(),
        volume: Vec::new(),
    };
    for stretch in fillings.iter().flat_map(|f| &f.stretches) {
        for (k, layer) in stretch.layers.iter().enumerate().filter(|(_, layer)| layer.is_sound) {
            // Cells of a layer come block by block, rows within.
            let mut cell = layer.cells.iter();
            for block in &stretch.blocks {
                let [ni, nj, _] = block.cells();
                for (j, i) in (0..nj).flat_map(|j| (0..ni).map(move |i| (j, i))) {
                    let Some(cell) = cell.next() else { continue };
                    for c in 0..8 {
                        merge.add(
                            block.at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1)),
                            cell.volume / 8.0,
                        );
                    }
                }
            }
        }
    }
    let position = merge.sum.iter().zip(&merge.count).map(|(sum, count)| *sum / f64::from(*count)).collect();
    (position, merge.volume)
}

/// Nodes merged so far, in buckets as wide as they reach.
struct Merge {
    reach: f64,
    buckets: BTreeMap<[i64; 3], Vec<usize>>,
    first: Vec<DVec3>,
    sum: Vec<DVec3>,
    count: Vec<u32>,
    volume: Vec<f64>,
}

impl Merge {
    fn add(&mut self, x: DVec3, volume: f64) {
        let bucket = (x / self.reach).floor().to_array().map(|c| c as i64);
        let around =
            (0..27).map(|k| [bucket[0] + k % 3 - 1, bucket[1] + k / 3 % 3 - 1, bucket[2] + k / 9 - 1]);
        let near = around.filter_map(|b| self.buckets.get(&b)).flatten().copied();
        let nearest = near
            .min_by(|a, b| self.first[*a].distance_squared(x).total_cmp(&self.first[*b].distance_squared(x)));
        match nearest.filter(|k| self.first[*k].distance(x) < self.reach) {
            Some(k) => {
                self.sum[k] += x;
                self.count[k] += 1;
                self.volume[k] += volume;
            }
            None => {
                self.buckets.entry(bucket).or_default().push(self.first.len());
                self.first.push(x);
                self.sum.push(x);
                self.count.push(1);
                self.volume.push(volume);
            }
        }
    }
}

//! `docs/generators.md` and its pictures: what the generators of particles make, how good and how dear it is.

mod pictures;
mod tables;

use crate::root;
use std::fs;
use std::io::Error;

/// Makes the pictures and the page, with flows in pipes of as many particles across as `across` says.
///
/// # Errors
/// When a file cannot be written.
pub fn write(across: &[f64]) -> Result<(), Error> {
    let docs = root().join("docs");
    for (name, svg) in pictures::all() {
        fs::write(docs.join("images").join(format!("generators-{name}.svg")), svg)?;
    }
    let page = PAGE
        .replace("{sections}", &tables::sections())
        .replace("{vessels}", &tables::vessels())
        .replace("{layers}", &tables::layers())
        .replace("{flows}", &tables::flows(across))
        .replace("{threads}", &rayon::current_num_threads().to_string());
    fs::write(docs.join("generators.md"), page)
}

const PAGE: &str = "\
# Generators

Made by `cargo run --release -p vaso-tests --example generators`; do not edit. All figures and pictures are of surfaces that
the project makes itself (`shapes` of `crates/geometry`). Times are wall times of one run each on {threads} threads of a machine
that was busy with other work: they tell orders of magnitude, not speeds. `dp` is the spacing.

**relaxed-lattice** takes the sites of a cubic (or body-centred) lattice that lie deepest inside the vessel and relaxes them
until the sum of kernel gradients is even, walls included. It knows nothing of the vessel's shape and works on any. All
particles have the same volume.

**multiblock** cuts each branch across its centreline into sections, the sections into blocks and the blocks into cells by
transfinite interpolation (Gordon and Hall 1973); each cell is a particle with the volume of the cell. Three arrangements
of blocks are known. A junction whose sections cannot be folded into each other is left to the lattice, which is relaxed
among the blocks, and reported.

`vaso particles CASE --compare multiblock,relaxed-lattice` makes this comparison for a vessel of yours.

## Blocks in a section

The first section of a straight tube of 16 spacings across. Thick lines are the edges of blocks, thin lines those of cells.

![Cells of the three arrangements in a round section](images/generators-sections.svg)

Straight tube, two and a half diameters long. Variation is standard deviation over mean; the smallest cell is relative to
the mean, the nearest neighbour in spacings.

{sections}

The corners of a single block, and of the nine, lie on the round wall, where two edges of a cell become one line; so the
cells there are small. The four side blocks of the o-grid have no such corner.

## Blocks along a vessel

A carotid bifurcation of average dimensions at 0.5 mm, o-grid. Every third section, and the edges of the blocks; what is
farther from the eye is paler.

![Sections and blocks of a bifurcation](images/generators-blocks.svg)

## Particles

The same bifurcation. Particles within half a spacing of its plane of symmetry, as discs of the volume of the particle;
the colour goes from half a cubed spacing (dark) to one and a half (bright).

![Particles in the plane of symmetry of a bifurcation](images/generators-along.svg)

Across the middle of its longest branch:

![Particles across a branch by each generator](images/generators-across.svg)

## Quality and cost

Pipe of 6 mm across and 20 mm long, the same bent by 90 degrees on a radius of 12 mm, and the bifurcation, all at 0.5 mm. The
kernel sum is that of particles with full support over that of a cubic lattice, mean and standard deviation; `h|G|` is the
root mean square of the kernel gradient sum over all particles, completed by what the wall cuts off. The volume error of a
relaxed lattice is the rounding of its number: the particles share the exact volume.

{vessels}

## Walls and shells

The bifurcation at 0.5 mm: a wall of 1.5 mm by each end, and a shell on the lumen. How they are made is in
[theory/walls.md](theory/walls.md).

{layers}

## What a flow makes of it

The pipe of `cases/pipe` at Reynolds number 100, as in [validation.md](validation.md#poiseuille): 1.2 s from rest, mean of the last
quarter, mixed precision. The velocity error is the root mean square over the middle fifth, of the peak velocity. The time is
that of the flow alone.

{flows}

Two flow-throughs after the start little is left of the pattern the particles began in: the spacing decides much more
about the error than the generator.
";

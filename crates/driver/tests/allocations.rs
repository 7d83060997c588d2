//! A step works in memory that is there: none of its stages allocates, whatever the effects of the scene, but for hypoelastic solids,
//! which find their neighbours anew in each sub-step.

use dhat::{HeapStats, Profiler};
use std::path::Path;
use vaso_driver::kind::{AnyFlow, any_flow};
use vaso_driver::{Case, Plan, world::Bodies};

#[global_allocator]
static ALLOCATOR: dhat::Alloc = dhat::Alloc;

/// Advective steps that are counted.
const COUNTED: usize = 12;
/// Steps before them, in which nearly all lists come to their size. The order of particles changes, and where a chunk of them has more
/// neighbours than ever before its list has to grow; after some hundred steps it does not any more.
const SETTLED: usize = 300;
/// Steps before them, in which every stage has made what it needs: what it allocates for itself it would allocate in all that are counted,
/// lists grow in some.
const MADE: usize = 12;

const TISSUE: [(&str, &str); 4] = [
    ("wall.thickness", "0.6 mm"),
    ("wall.density", "1060 kg/m^3"),
    ("wall.young_modulus", "1.106 MPa"),
    ("wall.poisson_ratio", "0.45"),
];

/// The carotid of the demo, coarse, with settings.
fn flow(set: &[(&str, &str)]) -> Box<dyn AnyFlow> {
    let owned = |(key, value): &(&str, &str)| ((*key).to_owned(), (*value).to_owned());
    let set: Vec<_> = [("particles.spacing", "0.8 mm")].iter().chain(set).map(owned).collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/carotid");
    let mut case = Case::load(&folder, &set).unwrap_or_else(|e| panic!("{e}"));
    case.cache = Some(Path::new(env!("CARGO_TARGET_TMPDIR")).join("allocations"));
    let plan = Plan::new(&case).unwrap_or_else(|e| panic!("{e}"));
    let bodies = Bodies::make(&case, |_, _, _| {}).unwrap_or_else(|e| panic!("{e}"));
    any_flow(&case, &plan, bodies).unwrap_or_else(|e| panic!("{e}"))
}

fn go(flow: &mut dyn AnyFlow) {
    flow.step(f64::INFINITY).unwrap_or_else(|e| panic!("{e}"));
}

/// Counts what the steps of a scene allocate. Where that is too much, the places are left in `target/tmp/dhat-heap.json`.
fn allocates_nothing(what: &str, set: &[(&str, &str)], before: usize) {
    let mut flow = flow(set);
    (0..before).for_each(|_| go(&mut *flow));
    let places = Path::new(env!("CARGO_TARGET_TMPDIR")).join("dhat-heap.json");
    let profiler = Profiler::builder().testing().file_name(places).build();
    let mut growing = 0;
    for _ in 0..COUNTED {
        let before = HeapStats::get().total_blocks;
        go(&mut *flow);
        growing += usize::from(HeapStats::get().total_blocks > before);
    }
    println!("{what}: {growing} of {COUNTED} steps allocate");
    let most = if before == SETTLED { COUNTED / 6 } else { 3 * COUNTED / 4 };
    dhat::assert!(growing <= most, "{what}: {growing} of {COUNTED} steps allocate");
    drop(profiler);
}

/// All in one test: the allocator counts for all threads.
#[test]
fn steps_allocate_nothing() {
    let wall =
        |model, more: &[(&'static str, &'static str)]| [&[("wall.model", model)], &TISSUE[..], more].concat();
    let tissue = [("wall.support.stiffness", "1e6 Pa/m"), ("wall.support.damping", "1e4 Pa s/m")];
    let scenes = [
        ("mass held", vec![("numerics.hold_mass", "true")]),
        ("shear thinning", vec![("blood.viscosity", "{ model = \"carreau-yasuda\" }")]),
        ("double precision", vec![("numerics.precision", "double")]),
        ("rigid shell", vec![("wall.model", "rigid-shell")]),
        ("shell in tissue", wall("shell", &tissue)),
        ("linear shell", wall("shell", &[("wall.material", "saint-venant-kirchhoff")])),
        ("solid", wall("solid", &[("wall.spacing", "0.3 mm"), tissue[0], tissue[1]])),
    ];
    // From outside the threads every call would be handed over, and now and then get a block for that.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build().expect("threads can be had");
    pool.install(|| {
        allocates_nothing("rigid", &[], SETTLED);
        for (what, set) in &scenes {
            allocates_nothing(what, set, MADE);
        }
    });
}

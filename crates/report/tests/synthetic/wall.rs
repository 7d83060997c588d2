//! The wall of the made-up run: a tube about each limb, sheared by its flow, least at the inner side of the bend.

use super::{FRAMES, Limb, PERIOD, limbs, pulse};
use glam::DVec3;
use std::f64::consts::TAU;
use std::path::Path;
use vaso_io::{
    Distribution, IoError, SurfaceField, SurfaceFrame, SurfaceMesh, SurfaceSeriesWriter, WallSummary,
};

/// Points around a tube.
const AROUND: usize = 48;
/// Rings between two points of a centreline.
const RINGS: usize = 4;

/// Points with normals, directions of the flow and its shear at rest of the pulse [Pa]; triangles.
#[derive(Default)]
struct Tubes {
    point: Vec<DVec3>,
    normal: Vec<DVec3>,
    shear: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
}

impl Tubes {
    fn add(&mut self, limb: &Limb) {
        let line: Vec<DVec3> = limb
            .line
            .windows(2)
            .flat_map(|pair| (0..RINGS).map(move |k| pair[0].lerp(pair[1], k as f64 / RINGS as f64)))
            .collect();
        let first = self.point.len() as u32;
        for (k, center) in line.iter().enumerate() {
            let along = (line[(k + 1).min(line.len() - 1)] - line[k.saturating_sub(1)]).normalize();
            let across = along.cross(DVec3::Y).normalize();
            for j in 0..AROUND {
                let (sin, cos) = (TAU * j as f64 / AROUND as f64).sin_cos();
                let normal = across * cos + across.cross(along) * sin;
                self.point.push(*center + limb.radius * normal);
                self.normal.push(normal);
                // The drag of a parabola, and twice as much outside a bend as inside.
                let parabola = 3.5e-3 * 4.0 * limb.speed / limb.radius;
                self.shear.push(along * parabola * (1.0 + 0.35 * normal.dot(across)));
            }
        }
        for (k, j) in (0..line.len() as u32 - 1).flat_map(|k| (0..AROUND as u32).map(move |j| (k, j))) {
            let at = |k: u32, j: u32| first + k * AROUND as u32 + j % AROUND as u32;
            self.triangles.push([at(k, j), at(k + 1, j), at(k, j + 1)]);
            self.triangles.push([at(k + 1, j), at(k + 1, j + 1), at(k, j + 1)]);
        }
    }
}

const FIELDS: [SurfaceField<'static>; 3] = [
    SurfaceField {
        name: "WSS",
        components: 3,
        unit: "Pa",
        definition: "mu (I - n n) (grad v + grad v^T) m, m = -n into the lumen: the drag on the wall",
        citation: "moving least squares: Lancaster, Salkauskas 1981",
    },
    SurfaceField {
        name: "TAWSS",
        components: 1,
        unit: "Pa",
        definition: "1/T int |tau| dt",
        citation: "Ku, Giddens, Zarins, Glagov 1985",
    },
    SurfaceField {
        name: "OSI",
        components: 1,
        unit: "",
        definition: "1/2 (1 - |int tau dt| / int |tau| dt)",
        citation: "He, Ku 1996",
    },
];

/// Writes `wall.vtkhdf` and returns what the summary says of it.
pub(super) fn write(out: &Path) -> Result<WallSummary, IoError> {
    let mut tubes = Tubes::default();
    limbs().iter().for_each(|limb| tubes.add(limb));
    let mesh = SurfaceMesh { points: &tubes.point, triangles: &tubes.triangles };
    let tawss: Vec<f64> = tubes.shear.iter().map(|s| s.length()).collect();
    // Where the drag is weakest it turns most; a patch had no value.
    let osi: Vec<f64> = (tawss.iter().zip(&tubes.point))
        .map(|(t, x)| {
            if x.distance(DVec3::new(-0.0107, -0.0044, 0.0115)) < 2.5e-3 {
                f64::NAN
            } else {
                0.3 * (-t / 0.5).exp()
            }
        })
        .collect();
    let mut series = SurfaceSeriesWriter::create(out.join("wall.vtkhdf"), mesh, &FIELDS)?;
    let mut last = Vec::new();
    for step in 0..FRAMES {
        let time = PERIOD * step as f64 / (FRAMES - 1) as f64;
        let shear: Vec<DVec3> = tubes.shear.iter().map(|&s| s * pulse(time - 0.55)).collect();
        let ends = step + 1 == FRAMES;
        series.append(&SurfaceFrame {
            time,
            points: None,
            scalars: if ends { vec![("TAWSS", &tawss), ("OSI", &osi)] } else { Vec::new() },
            vectors: vec![("WSS", &shear)],
        })?;
        last = shear.iter().map(|s| s.length()).collect();
    }
    let area = vec![1e-8; tubes.point.len()];
    Ok(WallSummary {
        points: tubes.point.len() as u64,
        triangles: tubes.triangles.len() as u64,
        area_m2: 1e-3,
        counted_area_m2: 9e-4,
        wss_pa: Distribution::by_area(&last, &area),
        cycle: Some(1),
        low_tawss_area_fraction: Distribution::fraction_below(vaso_io::LOW_TAWSS, &tawss, &area),
        tawss_pa: Distribution::by_area(&tawss, &area),
        osi: Distribution::by_area(&osi, &area),
        ..WallSummary::default()
    })
}

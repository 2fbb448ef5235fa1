//! Triangles about one point.

use glam::Vec3;

use crate::cpu::traverse::closest_hit;
use crate::layout::ray::MAX_STEPS;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::clouds::cloud;
use crate::stress::scenes::rays::random_rays;
use crate::stress::scenes::solids::concentric;
use crate::stress::tools::forest::{built, judged, rig_for};
use crate::stress::tools::tracer::{Tracer, device_fma};
use crate::stress::tools::trees::records;

pub static ROW: Row = Row {
    name: "equal-centroids",
    holds: "a million equal centroids make a tree of n - 1 nodes no deeper than 63 + log2 n, whose walk ends with the right hit",
    quantity: "depth of the tree, of what it may be",
    most: 1.0,
    unit: "triangles",
    sizes: [100_000, 1_048_576, 1_048_576],
    measure,
};

/// Triangles that are walked where loops end at 65,535 rounds.
const FEW: usize = 1 << 13;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let n = size as u32;
    let mut rig = rig_for(lab, n)?;
    let mut all = Measured::new(0.0, 0);
    let tied = cloud(n, 0.0, |_, _| Vec3::ONE);
    let walked = records(&concentric(if lab.is_software() { FEW.min(n as usize) } else { n as usize }));
    for (what, triangles) in [("one point", &tied), ("about one centroid", &walked)] {
        let tree = built(&mut rig, triangles)?;
        let most = 63.0 + (triangles.len() as f64).log2();
        let depth = judged(&tree, what)?.depth;
        let note = format!("{what}: {depth} deep");
        all = all.worst(Measured::new(f64::from(depth) / most, triangles.len() as u64).noted(note));
        lab.tell(1, 3);
    }
    let tree = built(&mut rig, &walked)?;
    let mut tracer = Tracer::new(lab);
    tracer.load(&tree)?;
    let fma = device_fma(lab.gpu());
    let rays = random_rays(300, 2.0, 31);
    let hits = tracer.extend(&rays)?;
    for (ray, hit) in rays.iter().zip(&hits) {
        let right = closest_hit(fma, ray, &tree);
        // Another processor: a t within 4 ulp.
        if (i64::from(hit.t.to_bits()) - i64::from(right.t.to_bits())).abs() > 4 || hit.steps >= MAX_STEPS {
            return Err(StressError::Broken(format!("{ray:?} hits {hit:?}, by the twin {right:?}")));
        }
    }
    Ok(all)
}

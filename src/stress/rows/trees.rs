//! Trees of every kind of scene, and of as many triangles as there is room for.

use crate::cpu::tree;
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, Scale, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::clouds::{cloud, clustered, point, scenes};
use crate::stress::tools::forest::{built, judged, others, rig_for};

pub static ROW: Row = Row {
    name: "trees",
    holds: "slivers, clusters, lines, points, 0 to 3 triangles, ten million: every leaf once, boxes enclose, as the twin has it",
    quantity: "leaves and nodes that differ from the twin's",
    most: 0.0,
    unit: "triangles",
    sizes: [150_000, 1_000_000, 20_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let large = (size / 2) as u32;
    let mut rig = rig_for(lab, large)?;
    let mut all = Measured::new(0.0, 0);
    let sizes = if lab.scale() == Scale::Test { [0, 1, 2, 3, 513] } else { [0, 1, 2, 3, 4_097] };
    for n in sizes {
        for (what, triangles) in scenes(n) {
            let found = built(&mut rig, &triangles)?;
            let what = format!("{n} triangles, {what}");
            judged(&found, &what)?;
            let differ = others(&found, &tree::build(&triangles));
            all = all.plus(Measured::new(differ as f64, triangles.len() as u64).noted(what));
        }
    }
    let mut deepest = 0;
    for (k, triangles) in [cloud(large, 0.001, |_, random| point(random)), clustered(large)].iter().enumerate() {
        lab.tell(2 * k as u64 + 1, 5);
        let found = built(&mut rig, triangles)?;
        let what = format!("{large} triangles");
        deepest = deepest.max(judged(&found, &what)?.depth);
        let differ = others(&found, &tree::build(triangles));
        all = all.plus(Measured::new(differ as f64, triangles.len() as u64).noted(what));
        lab.tell(2 * k as u64 + 2, 5);
    }
    Ok(if all.value == 0.0 { all.noted(format!("{large} at once, at most {deepest} deep")) } else { all })
}

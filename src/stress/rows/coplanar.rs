//! Triangles upon each other.

use crate::cpu::intersect::Fma;
use crate::cpu::traverse::closest_hit_brute;
use crate::cpu::tree::Tree;
use crate::layout::ray::{Hit, Ray};
use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::rays::{hard_rays, random_rays};
use crate::stress::scenes::solids::coplanar;
use crate::stress::tools::tracer::{Tracer, device_fma, others};
use crate::stress::tools::trees::{Cut, build};

pub static ROW: Row = Row {
    name: "coplanar",
    holds: "of triangles in one plane the one of least (t, index) is hit, whatever the tree",
    quantity: "hits that differ",
    most: 0.0,
    unit: "rays",
    sizes: [40_000, 800_000, 20_000_000],
    measure,
};

/// Rays that are traced by the twin as well.
const BY_TWIN: usize = 4_000;

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let cuts = [Cut::Median, Cut::Random(1), Cut::Random(2), Cut::Chain];
    let mut tracer = Tracer::new(lab);
    let fma = device_fma(lab.gpu());
    let triangles = coplanar(6);
    let mut all = Measured::new(0.0, 0);
    let (mut done, mut seed) = (0, 60);
    while done < size {
        let count = ((size - done) as usize / cuts.len()).clamp(1, 1 << 20);
        let mut rays = random_rays(count / 2, 1.5, seed);
        rays.extend(hard_rays(&triangles, count / 2));
        let mut right: Option<Vec<Hit>> = None;
        for cut in cuts {
            let tree = build(&triangles, cut);
            tracer.load(&tree)?;
            let hits = tracer.extend(&rays)?;
            if right.is_none() {
                let twin = twin_differs(fma, &rays[..BY_TWIN.min(rays.len())], &hits, &tree);
                all = all.plus(Measured::new(twin as f64, 0).noted("the twin"));
                right = Some(tracer.brute(&rays)?);
            }
            let differ = others(&hits, right.as_deref().unwrap_or_default());
            all = all.plus(Measured::new(differ as f64, rays.len() as u64).noted(format!("{cut:?}")));
        }
        (done, seed) = (done + (count * cuts.len()) as u64, seed + 1);
        lab.tell(done, size);
    }
    Ok(all)
}

/// Where the twin tests all triangles and hits another one at a t that is no farther.
fn twin_differs(fma: Fma, rays: &[Ray], hits: &[Hit], tree: &Tree) -> usize {
    let other = |(ray, hit): &(&Ray, &Hit)| {
        let right = closest_hit_brute(fma, ray, tree);
        right.t.to_bits() == hit.t.to_bits() && right.triangle != hit.triangle
    };
    rays.iter().zip(hits).filter(other).count()
}

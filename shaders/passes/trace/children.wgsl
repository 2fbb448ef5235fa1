// The boxes of a node's two children.

import package::gen::{FAR_GROWTH, Node};
import package::lib::intersect::{Query};

// Where the ray enters and leaves the boxes of a node's two children.
struct ChildIntervals {
    near_left: f32,
    far_left: f32,
    near_right: f32,
    far_right: f32,
}

// slab_interval() of both children.
fn child_intervals(query: Query, node: Node) -> ChildIntervals {
    let x = fma(node.x, vec4(query.inverse.x), vec4(query.low.x, query.high.x, query.low.x, query.high.x));
    let y = fma(node.y, vec4(query.inverse.y), vec4(query.low.y, query.high.y, query.low.y, query.high.y));
    let z = fma(node.z, vec4(query.inverse.z), vec4(query.low.z, query.high.z, query.low.z, query.high.z));
    return ChildIntervals(
        max(max(min(x.x, x.y), min(y.x, y.y)), min(z.x, z.y)),
        min(min(max(x.x, x.y), max(y.x, y.y)), max(z.x, z.y)) * FAR_GROWTH,
        max(max(min(x.z, x.w), min(y.z, y.w)), min(z.z, z.w)),
        min(min(max(x.z, x.w), max(y.z, y.w)), max(z.z, z.w)) * FAR_GROWTH,
    );
}

fn interval_passes(near: f32, far: f32, t_min: f32, t: f32) -> bool {
    return near <= min(far, t) && far >= t_min;
}

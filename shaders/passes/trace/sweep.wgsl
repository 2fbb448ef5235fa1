// Every triangle against one ray: for scenes so small that a tree costs more than it saves. The hit is the tree's, to the bit.

import package::gen::{Hit, Ray, NO_HIT};
import package::lib::intersect::{prepare_query};
import package::passes::trace::leaf::{test_leaf};

// The hit of least (t, triangle), or, where `any`, some hit. Triangle `except` is passed through. `extent` is the greatest
// coordinate of the scene's box, `count` the number of its triangles.
fn sweep(ray: Ray, count: u32, extent: f32, any: bool, except: u32) -> Hit {
    var hit = Hit(ray.t_max, NO_HIT, 0u, 0.0, 0.0, 0u);
    if all(ray.direction == vec3(0.0)) {
        return hit;
    }
    let query = prepare_query(ray, extent);
    for (var leaf = 0u; leaf < count; leaf++) {
        test_leaf(query, leaf, except, &hit);
        if any && hit.triangle != NO_HIT {
            break;
        }
    }
    return hit;
}

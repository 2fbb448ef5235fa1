// A material's numbers where its maps say what they are multiplied by.

import package::gen::{MAPS_PRESERVE, MaterialMaps, MaterialRecord, SMOOTHEST_ALPHA};
import package::lib::bsdf::mixture::{share_of_specular};
import package::lib::math::{largest_of};
import package::lib::texture::{TexturePoint};
import package::passes::trace::textures::{look_up_colour, look_up_number};

// The material at a point. `u` draws the texels: of both colours, of the lobe and of the metalness.
fn textured(material: MaterialRecord, maps: MaterialMaps, point: TexturePoint, u: vec4<f32>) -> MaterialRecord {
    var m = material;
    if (maps.diffuse != 0u) {
        m.kd *= look_up_colour(maps.diffuse, point, u.x);
    }
    if (maps.specular != 0u) {
        m.ks *= look_up_colour(maps.specular, point, u.y);
    }
    if (maps.lobe != 0u) {
        let part = look_up_number(maps.lobe, point, u.z);
        m.ns = min(m.ns * part, 1e5);
        m.alpha = clamp(m.alpha * part * part, SMOOTHEST_ALPHA, 1.0);
    }
    var metalness = maps.metalness;
    if (maps.metallic != 0u) {
        metalness = min(metalness * look_up_number(maps.metallic, point, u.w), 1.0);
    }
    m.ks += metalness * m.kd;
    m.kd *= 1.0 - metalness;
    if ((maps.flags & MAPS_PRESERVE) != 0u) {
        let scale = max(largest_of(m.kd + m.ks), 1.0);
        m.kd /= scale;
        m.ks /= scale;
    }
    m.specular_probability = share_of_specular(m.kd, m.ks);
    return m;
}

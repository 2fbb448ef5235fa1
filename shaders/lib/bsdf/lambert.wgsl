// Lambert reflection: f = kd / pi.

import package::lib::math::{INV_PI};

// f * cos of the incident direction.
fn lambert_value(kd: vec3<f32>, cos_theta: f32) -> vec3<f32> {
    return kd * (INV_PI * cos_theta);
}

fn lambert_pdf(cos_theta: f32) -> f32 {
    return INV_PI * cos_theta;
}

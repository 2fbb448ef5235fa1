//! The weak white furnace, which the quadrature is held to that judges the albedos of lobes.

use lucerna::cpu::bsdf::ggx::lambda;
use lucerna::stress::tools::quadrature::over_facets;

const ALPHAS: [f64; 5] = [1e-3, 0.02, 0.2, 0.6, 1.0];
const ANGLES: [f64; 5] = [0.0, 30.0, 60.0, 80.0, 89.0];

#[test]
fn ggx_facets_that_are_seen_fill_the_view() {
    // The weak white furnace (Heitz 2014): masked but not shadowed, nothing is lost.
    for alpha in ALPHAS {
        for degrees in ANGLES {
            let cos_view = degrees.to_radians().cos();
            let all = over_facets(alpha, cos_view, |_| 1.0 / (1.0 + lambda(alpha, cos_view)));
            assert!((all - 1.0).abs() < 1e-4, "alpha {alpha}, {degrees} degrees: {all}");
        }
    }
}

//! Edits of shaders, wrong ones and right ones, of what the Cornell box runs.

use std::path::Path;

use tempfile::TempDir;

/// A text that is replaced wherever it stands in a module: in so many places.
pub struct Change<'a> {
    pub module: &'a str,
    pub text: &'a str,
    pub replacement: &'a str,
    pub places: usize,
}

pub struct Edit {
    pub name: &'static str,
    /// So wrong that the first films show it.
    pub gross: bool,
    pub changes: &'static [Change<'static>],
}

/// Copies the shaders, and edits the copies.
pub fn edited_all(changes: &[Change]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    crate::reload::copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders"), folder.path());
    for Change { module, text, replacement, places } in changes {
        let path = folder.path().join(module).with_extension("wgsl");
        let before = std::fs::read_to_string(&path).unwrap();
        assert_eq!(before.matches(text).count(), *places, "`{text}` in {module}");
        std::fs::write(path, before.replace(text, replacement)).unwrap();
    }
    folder
}

const fn change(module: &'static str, text: &'static str, replacement: &'static str) -> Change<'static> {
    Change { module, text, replacement, places: 1 }
}

const fn change_all(
    module: &'static str,
    text: &'static str,
    replacement: &'static str,
    places: usize,
) -> Change<'static> {
    Change { module, text, replacement, places }
}

const fn edit(name: &'static str, changes: &'static [Change<'static>]) -> Edit {
    Edit { name, gross: false, changes }
}

const fn gross(name: &'static str, changes: &'static [Change<'static>]) -> Edit {
    Edit { name, gross: true, changes }
}

const PATH: &str = "passes/trace/path";
const SHADOW: &str = "passes/trace/shadow";
const SURFACE: &str = "passes/trace/surface";
const CONNECT: &str = "passes/trace/connect";
const LAMBERT: &str = "lib/bsdf/lambert";
const PHONG: &str = "lib/bsdf/phong";
const MIXTURE: &str = "lib/bsdf/mixture";
const LIGHT: &str = "lib/light";
const SAMPLING: &str = "lib/sampling";
const FOUND: &str = "light *= power_heuristic((*state).pdf, light_pdf(params, material, mean, area_normal, (*state).direction, distance));";
const SAMPLED: &str = "var weight = power_heuristic(drawn.pdf, at.pdf);";
const SURVIVAL: &str = "largest_of(most) * (*state).eta_scale";

pub const WRONG: &[Edit] = &[
    gross("half of diffuse reflection", &[change(LAMBERT, "(INV_PI * cos_theta)", "(0.5 * INV_PI * cos_theta)")]),
    edit("1 % less diffuse reflection", &[change(LAMBERT, "(INV_PI * cos_theta)", "(0.99 * INV_PI * cos_theta)")]),
    edit("half of the light that is sampled", &[change(SHADOW, "drawn.radiance *", "0.5 * drawn.radiance *")]),
    edit("1 % more of it", &[change(SHADOW, "drawn.radiance *", "1.01 * drawn.radiance *")]),
    edit("no weight of light that is sampled", &[change(SHADOW, SAMPLED, "var weight = 1.0;")]),
    edit("no weight of light that is found", &[change(PATH, FOUND, "light *= 1.0;")]),
    edit("weights that do not add up to 1", &[change(LIGHT, "1.0 + ratio * ratio", "1.0 + 0.5 * ratio * ratio")]),
    edit("a diffuse pdf of even directions", &[change(LAMBERT, "return INV_PI * cos_theta", "return 0.5 * INV_PI")]),
    edit("a diffuse pdf 1 % too low", &[change(LAMBERT, "return INV_PI *", "return 0.99 * INV_PI *")]),
    gross("the wrong side", &[change(SURFACE, "select(unit, -unit, back_face)", "select(-unit, unit, back_face)")]),
    edit("roulette without its due", &[change(PATH, "(*state).throughput /= survival;", "")]),
    edit("1 % more after each bounce", &[change_all(PATH, "/= survival", "/= 0.99 * survival", 2)]),
    edit("paths of three segments", &[change(PATH, "1u < params.max_depth", "1u < min(3u, params.max_depth)")]),
    edit("the light's cosine forgotten", &[change(CONNECT, "(t * t / cos_light)", "(t * t)")]),
    edit("1 % of the distance", &[change(CONNECT, "(t * t / cos_light)", "(1.01 * t * t / cos_light)")]),
    edit(
        "even directions with the cosine's pdf",
        &[change(SAMPLING, "Angle(sqrt(1.0 - u), sqrt(u))", "Angle(1.0 - u, sqrt(u * (2.0 - u)))")],
    ),
    edit("half of glossy reflection", &[change(PHONG, "(0.5 * INV_PI * (n + 2.0)", "(0.25 * INV_PI * (n + 2.0)")]),
    edit("a glossy pdf a fifth too low", &[change(PHONG, "0.5 * INV_PI * (n + 1.0)", "0.4 * INV_PI * (n + 1.0)")]),
    gross("red and green change places", &[change(LAMBERT, "kd * (INV_PI", "kd.yxz * (INV_PI")]),
    gross(
        "the picture mirrored",
        &[change(
            "lib/camera",
            "2.0 * at.x / f32(camera.film_width) - 1.0",
            "1.0 - 2.0 * at.x / f32(camera.film_width)",
        )],
    ),
];

pub const RIGHT: &[Edit] = &[
    edit(
        "even directions with their pdf",
        &[
            change(SAMPLING, "Angle(sqrt(1.0 - u), sqrt(u))", "Angle(1.0 - u, sqrt(u * (2.0 - u)))"),
            change(LAMBERT, "return INV_PI * cos_theta", "return 0.5 * INV_PI"),
        ],
    ),
    edit("the balance heuristic", &[change(LIGHT, "1.0 + ratio * ratio", "1.0 + ratio")]),
    edit(
        "weights by the third power",
        &[change(LIGHT, "1e18", "1e12"), change(LIGHT, "1.0 + ratio * ratio", "1.0 + ratio * ratio * ratio")],
    ),
    edit("independent random numbers", &[change_all("lib/rng", "sobol)", "never)", 5)]),
    edit("later roulette", &[change(PATH, ">= ROULETTE_BOUNCE", ">= ROULETTE_BOUNCE + 8u")]),
    edit("earlier roulette", &[change(PATH, ".bounce >= ROULETTE_BOUNCE", ".bounce + 2u >= ROULETTE_BOUNCE")]),
    edit("milder roulette", &[change(PATH, SURVIVAL, "0.5 + 0.5 * largest_of(most) * (*state).eta_scale")]),
    edit("harsher roulette", &[change(PATH, SURVIVAL, "0.5 * largest_of(most) * (*state).eta_scale")]),
    edit(
        "light is found and never sampled",
        &[change(PATH, FOUND, "light *= 1.0;"), change(SHADOW, SAMPLED, "var weight = 0.0;")],
    ),
    edit(
        "half of the looks at lights, twice",
        &[
            change(
                PATH,
                "connect(params, *state, surface, point,",
                "connect(params, *state, surface, vec2<f32>(fract(2.0 * point.x), point.y),",
            ),
            change(
                PATH,
                "point.y), choices.texel);",
                "point.y), choices.texel);
            shaded.connection.light *= select(0.0, 2.0, point.x < 0.5);",
            ),
        ],
    ),
    edit("a light's points by the numbers swapped", &[change(CONNECT, "light_weights(u);", "light_weights(u.yx);")]),
    edit("directions by the numbers swapped", &[change(MIXTURE, "cosine_angle(u.x), u.y", "cosine_angle(u.y), u.x")]),
    edit(
        "directions from the horizon up",
        &[change(SAMPLING, "Angle(sqrt(1.0 - u), sqrt(u))", "Angle(sqrt(u), sqrt(1.0 - u))")],
    ),
    edit(
        "the lobe by the other end",
        &[change(
            MIXTURE,
            "pick < m.specular_probability && is_phong",
            "pick >= 1.0 - m.specular_probability && is_phong",
        )],
    ),
    edit(
        "half as many glossy directions",
        &[
            change(
                MIXTURE,
                "pick < m.specular_probability && is_phong",
                "pick < 0.5 * m.specular_probability && is_phong",
            ),
            change(MIXTURE, "pdf *= 1.0 - m.specular_probability", "pdf *= 1.0 - 0.5 * m.specular_probability"),
            change(MIXTURE, "m.specular_probability * lobe.pdf", "0.5 * m.specular_probability * lobe.pdf"),
        ],
    ),
    edit("other random numbers", &[change("lib/rng_sobol", "0x536f626fu", "0x536f6270u")]),
    edit(
        "a frame of the other hand",
        &[change(SAMPLING, "frame.t * round.y + frame.b * round.x", "frame.b * round.y + frame.t * round.x")],
    ),
    edit("the same, written otherwise", &[change(LAMBERT, "kd * (INV_PI * cos_theta)", "(kd * INV_PI) * cos_theta")]),
    edit(
        "lights as often as each other",
        &[
            change(
                CONNECT,
                "// The density with which draw_light() draws",
                "@if(lights)
fn uniform_area_pdf(params: TraceParams, area_normal: vec3<f32>) -> f32 {
    return params.light_share / (f32(params.lights) * 0.5 * length(area_normal));
}

// The density with which draw_light() draws",
            ),
            change(
                CONNECT,
                "light_area_pdf(mean, sides, params.light_density)",
                "uniform_area_pdf(params, area_normal)",
            ),
            change(
                CONNECT,
                "light_area_pdf(luminance(light.emission), select(2u, 1u, one_sided), params.light_density)",
                "uniform_area_pdf(params, area_normal)",
            ),
        ],
    ),
    edit(
        "the film's points by the numbers swapped",
        &[change(PATH, "sample_2d(state.key, SLOT_FILM)", "sample_2d(state.key, SLOT_FILM).yx")],
    ),
];

//! Mistakes put into the shaders, or into what the engine sees, to show that the rows see them: a row that can't fail says nothing.

use super::lab::Lab;
use super::measured::StressError;
use super::outcome::{Outcome, Verdict, judge};
use super::row::Row;
use super::rows;
use super::tools::edits::Kind;
use super::tools::plant::plant;
use crate::shader::Library;

/// A text in a module, and what stands in its place.
type Edit = (&'static str, &'static str, &'static str);

/// A mistake.
#[derive(Debug)]
pub struct Fault {
    pub name: &'static str,
    /// What is wrong.
    pub wrong: &'static str,
    edits: &'static [Edit],
    /// Edits of a scene that the engine does not see.
    pub unseen: Option<Kind>,
    /// The rows that are to see it.
    pub seen_by: &'static [&'static str],
}

/// All mistakes, by the row that each is for.
pub const FAULTS: &[Fault] = &[
    Fault {
        name: "edge-order",
        wrong: "an edge is computed from its first end, in the order in which each triangle has its ends",
        edits: &[
            ("lib/intersect", "let swapped = p.x > q.x || (p.x == q.x && p.y > q.y);", "let swapped = false;"),
            (
                "lib/intersect",
                "let e = difference_of_products(first.x, second.y, first.y, second.x);",
                "let e = first.x * (second.y - first.y) - first.y * (second.x - first.x);",
            ),
        ],
        unseen: None,
        seen_by: &["edges", "slivers"],
    },
    Fault {
        name: "bare-slabs",
        wrong: "boxes are as large as what they hold, without room for rounding",
        edits: &[
            ("lib/intersect", "-(fma(vec3(SLAB_GROWTH), reach, ray.origin) * inverse)", "-(ray.origin * inverse)"),
            ("lib/intersect", "-(fma(vec3(-SLAB_GROWTH), reach, ray.origin) * inverse)", "-(ray.origin * inverse)"),
            ("lib/intersect", "min(min(far.x, far.y), far.z) * FAR_GROWTH", "min(min(far.x, far.y), far.z)"),
            (
                "lib/intersect",
                "let growth = vec3(SLAB_GROWTH * largest_of(max(-low, high)));",
                "let growth = vec3(0.0);",
            ),
        ],
        unseen: None,
        seen_by: &["edges", "slivers"],
    },
    Fault {
        name: "no-inset",
        wrong: "a ray leaves from the very edge where it arrived",
        edits: &[("lib/intersect", "let margin = INSET * largest_of(error);", "let margin = 0.0 * largest_of(error);")],
        unseen: None,
        seen_by: &["room-edges"],
    },
    Fault {
        name: "short-stack",
        wrong: "an entry that the stack has no room for is lost",
        edits: &[(
            "passes/trace/traverse_divergent",
            "visit.next = climb(query, last, &hit);",
            "visit.next = NO_ROOT;",
        )],
        unseen: None,
        seen_by: &["stack"],
    },
    Fault {
        name: "last-of-ties",
        wrong: "of triangles at one distance the one that is tested last is hit",
        edits: &[(
            "passes/trace/leaf",
            "(found.t == (*hit).t && triangle.index < (*hit).triangle)",
            "found.t == (*hit).t",
        )],
        unseen: None,
        seen_by: &["coplanar", "hard-rays"],
    },
    Fault {
        name: "pdf-by-2-percent",
        wrong: "the density of a point on a light is 2 % too large",
        edits: &[("passes/trace/connect", "return area_pdf * (t * t", "return 1.02 * area_pdf * (t * t")],
        unseen: None,
        seen_by: &["twin", "tiny-lights"],
    },
    Fault {
        name: "lobe-by-1-percent",
        wrong: "the density of the Phong lobe is 1 % too large",
        edits: &[("lib/bsdf/phong", "0.5 * INV_PI * (n + 1.0)", "0.505 * INV_PI * (n + 1.0)")],
        unseen: None,
        seen_by: &["twin", "albedo"],
    },
    Fault {
        name: "nan-material",
        wrong: "a surface weighs its light with NaN",
        edits: &[("lib/bsdf/mixture", "m.kd, at.pdf > 0.0", "vec3<f32>(bitcast<f32>(0x7fc00000u + m.flags)), true")],
        unseen: None,
        seen_by: &["furnace"],
    },
    Fault {
        name: "shadow-ends-early",
        wrong: "a shadow ray ends 2^-16 of its way before the light",
        edits: &[
            ("passes/trace/shadow", "offset / far, far * drawn.end)", "offset / far, far * (1.0 - 0x1p-16))"),
            (
                "passes/trace/shadow",
                "hit.triangle == connection.triangle || (hit.triangle == NO_HIT && connection.ends_before)",
                "hit.triangle == NO_HIT",
            ),
        ],
        unseen: None,
        seen_by: &["covers", "coincident-lamps"],
    },
    Fault {
        name: "one-hash-of-holes",
        wrong: "a ray that meets a hole meets one in every layer",
        edits: &[("passes/trace/cutout", "vec4<u32>(chance, triangle.index,", "vec4<u32>(chance, 0u,")],
        unseen: None,
        seen_by: &["cut-outs"],
    },
    Fault {
        name: "shadow-of-holes",
        wrong: "for shadow rays a surface is there where more than half of it is",
        edits: &[(
            "passes/trace/path",
            "chance = pcg_words((*state).key, CUTOUT_DIMENSIONS + (*state).rays).x | 1u;",
            "chance = select(NO_CHANCE, pcg_words((*state).key, CUTOUT_DIMENSIONS + (*state).rays).x | 1u, ray.t_max == T_FAR);",
        )],
        unseen: None,
        seen_by: &["cut-outs"],
    },
    Fault {
        name: "large-halves",
        wrong: "numbers of 16 bits in pictures are scaled twice",
        edits: &[("lib/texture", "* 0x1p112;", "* 0x1p112 * 0x1p112;")],
        unseen: None,
        seen_by: &["bad-pictures"],
    },
    Fault {
        name: "second-leaf",
        wrong: "on a processor, of two leaves that a ray may hit the farther one is not tested",
        edits: &[(
            "passes/trace/traverse_masked",
            "traversal.first_leaf = traversal.second_leaf;",
            "traversal.first_leaf = NO_ROOT;",
        )],
        unseen: None,
        seen_by: &["layouts", "two-adapters"],
    },
    Fault {
        name: "half-a-texel",
        wrong: "texels are looked up half a texel beside their place",
        edits: &[(
            "lib/texture",
            "point_in_picture(t, point) * vec2<f32>(size) - 0.5;",
            "point_in_picture(t, point) * vec2<f32>(size);",
        )],
        unseen: None,
        seen_by: &["texels"],
    },
    Fault {
        name: "unseen-in-reuse",
        wrong: "the weights of reused paths count pixels that don't see the point",
        edits: &[
            ("passes/trace/gather", "density = select(0.0, link.pdf,", "density = select(-link.pdf, link.pdf,"),
            (
                "passes/trace/gather",
                "total += densities[local * TILE_PIXELS + m];",
                "total += abs(densities[local * TILE_PIXELS + m]);",
            ),
        ],
        unseen: None,
        seen_by: &["reuse-twin"],
    },
    Fault {
        name: "reuse-by-2-percent",
        wrong: "the density of one pixel of a tile is 2 % too large",
        edits: &[(
            "passes/trace/gather",
            "density = select(0.0, link.pdf,",
            "density = select(0.0, link.pdf * select(1.0, 1.02, slot == 5u),",
        )],
        unseen: None,
        seen_by: &["reuse-twin"],
    },
    Fault {
        name: "own-variance",
        wrong: "each half of an adaptive film gets samples by its own variance",
        edits: &[("passes/film/tally", "let half = run.half;", "let half = 1u - run.half;")],
        unseen: None,
        seen_by: &["adaptive"],
    },
    Fault {
        name: "dark-when-full",
        wrong: "a film whose sums are full takes what still fits, dark samples alone",
        edits: &[("passes/film/accumulate", "if (is_full(half)) {\n        return;", "if (false) {\n        return;")],
        unseen: None,
        seen_by: &["film-sums"],
    },
    Fault {
        name: "unseen-edits",
        wrong: "a mesh is moved, and nothing is made anew of it",
        edits: &[],
        unseen: Some(Kind::Transform),
        seen_by: &["random-edits"],
    },
];

impl Fault {
    /// A library with this mistake in it.
    pub fn planted(&self, library: Library) -> Result<Library, StressError> {
        self.edits.iter().try_fold(library, |library, (module, right, wrong)| plant(library, module, right, wrong))
    }

    /// What the rows that are to see it say of it. `open` gives what to measure with such shaders on.
    pub fn looked_for(&self, library: Library, open: impl Fn(Library) -> Lab) -> Result<Vec<Outcome>, StressError> {
        let library = self.planted(library)?;
        let rows: Vec<&Row> = self.seen_by.iter().filter_map(|name| rows::named(name)).collect();
        Ok(rows.into_iter().map(|row| judge(row, &open(library.clone()).with_unseen(self.unseen))).collect())
    }
}

/// Whether a row saw what was planted.
pub fn caught(outcome: &Outcome) -> bool {
    matches!(outcome.verdict(), Verdict::Fails(_))
}

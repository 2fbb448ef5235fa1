//! What the colours of a view mean: pure. Every colour is by the pass's own functions, so that a legend is true by construction.

pub mod draw;

use crate::cpu::probe::{self, Histogram, NO_NUMBER, NOTHING};
use crate::cpu::view::{depth_code, heat, material_colour, normal_colour};
use crate::image::srgb::srgb_byte;
use crate::layout::view::{VIEW_MOST_LEVELS, VIEW_MOST_STEPS, ViewMode};

/// Cells of a bar whose colours have no steps of their own.
const CELLS: u32 = 128;

/// A bar of colours, with numbers along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// From the left to the right, all of one width.
    pub colours: Vec<[u8; 3]>,
    /// Numbers, and where they are: 0 at the left end, 1 at the right.
    pub marks: Vec<(f32, String)>,
}

/// What there is to say of a view.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Legend {
    /// One line.
    pub title: &'static str,
    pub bar: Option<Bar>,
    /// Colours that stand for one thing each.
    pub swatches: Vec<([u8; 3], String)>,
}

/// The legend of a view; none where the picture is the film, or what shaders show of themselves (`probe` has one of its own). `reach` is the distance that depth shows as
/// half, in units of the scene; `materials` are their names, in the order of their numbers.
pub fn legend(view: ViewMode, reach: f32, materials: &[String]) -> Option<Legend> {
    let plain = |title| Legend { title, ..Legend::default() };
    let with_bar = |title, bar| Legend { bar: Some(bar), ..plain(title) };
    Some(match view {
        ViewMode::Beauty | ViewMode::Debug | ViewMode::Probe => return None,
        ViewMode::Albedo => with_bar("the part of light that is given back", albedo()),
        ViewMode::Normal => Legend { swatches: normals(), ..plain("where the surface faces, towards the camera") },
        ViewMode::Depth => with_bar("distance from the camera, units of the scene", depth(reach)),
        ViewMode::Material => Legend { swatches: named(materials), ..plain("a colour for each material") },
        ViewMode::Cost => with_bar("steps of the walk through the tree", heat_bar(VIEW_MOST_STEPS, 16)),
        ViewMode::Level => with_bar("mip level: 0 is the whole picture", heat_bar(VIEW_MOST_LEVELS, 3)),
        ViewMode::Uv => Legend { swatches: coordinates(), ..plain("texture coordinates, from 0 to 1 and again") },
        ViewMode::Texel => plain("the first map of each material; black: it has none"),
    })
}

/// The legend of view "probe", of numbers as they were last read.
pub fn of_probe(known: &Histogram, logarithmic: bool) -> Legend {
    let number = |place: f32| (place, short(probe::number_at(place.into(), known.ends, logarithmic)));
    let bar = known
        .all
        .map(|_| Bar { colours: cells(CELLS, probe::colour), marks: [0.0, 0.25, 0.5, 0.75, 1.0].map(number).into() });
    let swatches = vec![(NOTHING, "not shown".to_owned()), (NO_NUMBER, "no number".to_owned())];
    Legend { title: "a number of each pixel's first sample", bar, swatches }
}

/// `count` colours of a place from 0 to 1.
fn cells(count: u32, colour: impl Fn(f64) -> [u8; 3]) -> Vec<[u8; 3]> {
    (0..count).map(|cell| colour(f64::from(cell) / f64::from(count - 1))).collect()
}

fn albedo() -> Bar {
    let marks = [0.0, 0.25, 0.5, 0.75, 1.0].map(|part: f32| (part, format!("{part}")));
    Bar { colours: cells(CELLS, |part| [srgb_byte(part); 3]), marks: marks.into() }
}

/// White at the camera; the place along the bar is as much as the colour is darker.
fn depth(reach: f32) -> Bar {
    let distance = |place: f64| f64::from(reach) * place / (1.0 - place).max(f64::MIN_POSITIVE);
    let colour = |place: f64| [depth_code(reach, distance(place) as f32); 3];
    let number = |place: f32| match place {
        1.0 => "far".to_owned(),
        place => short(distance(place.into())),
    };
    let marks = [0.0, 0.25, 0.5, 0.75, 1.0].map(|place| (place, number(place)));
    Bar { colours: cells(CELLS, colour), marks: marks.into() }
}

/// A count from 0 to what is white, with a number every so many.
fn heat_bar(most: u32, every: u32) -> Bar {
    let number = |count: u32| if count == most { format!("{count}+") } else { count.to_string() };
    let marks = (0..=most).step_by(every as usize).map(|count| (count as f32 / most as f32, number(count)));
    let fine = CELLS.max(most + 1);
    Bar { colours: cells(fine, |part| heat((part * f64::from(64 * most)) as u32, 64 * most)), marks: marks.collect() }
}

fn normals() -> Vec<([u8; 3], String)> {
    let ways = [("+x", [1.0, 0.0, 0.0]), ("+y", [0.0, 1.0, 0.0]), ("+z", [0.0, 0.0, 1.0])];
    let opposite = [("-x", [-1.0, 0.0, 0.0]), ("-y", [0.0, -1.0, 0.0]), ("-z", [0.0, 0.0, -1.0])];
    ways.into_iter().chain(opposite).map(|(name, way)| (normal_colour(way.into()), name.to_owned())).collect()
}

fn coordinates() -> Vec<([u8; 3], String)> {
    let corners = [("u 0, v 0", [0, 0, 0]), ("u 1", [255, 0, 0]), ("v 1", [0, 255, 0]), ("u 1, v 1", [255, 255, 0])];
    corners.map(|(name, colour)| (colour, name.to_owned())).into()
}

fn named(materials: &[String]) -> Vec<([u8; 3], String)> {
    (0..).zip(materials).map(|(index, name)| (material_colour(index), name.clone())).collect()
}

/// Three digits of a number.
pub fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let digits = (2 - value.abs().log10().floor() as i32).max(0) as usize;
    if digits > 6 || value.abs() >= 1e6 { format!("{value:.1e}") } else { format!("{value:.digits$}") }
}

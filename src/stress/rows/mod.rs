//! The rows, a file each.

mod adaptive;
mod albedo;
mod bad_inputs;
mod bad_pictures;
mod bad_samples;
mod claimed_error;
mod closed_rooms;
mod coarse_balls;
mod coincident_lamps;
mod coplanar;
mod covers;
mod cut_outs;
mod edges;
mod equal_centroids;
mod equal_codes;
mod estimators;
mod far_thing;
mod film_sums;
mod furnace;
mod glass_of_one;
mod hard_rays;
mod independence;
mod instances;
mod layouts;
mod moved;
mod moved_pictures;
mod oracle;
mod random_edits;
mod relief;
mod reuse;
mod reuse_twin;
mod room_edges;
mod scaled;
mod scaled_pictures;
mod slivers;
mod stack;
mod texel_weights;
mod texels;
mod tiny_lights;
mod trees;
mod twin;
pub mod two_adapters;
mod veils;

use super::row::Row;

/// All rows, in the order in which they are measured: hits, trees, light, textures, estimators, numbers.
pub static ALL: &[&Row] = &[
    &edges::ROW,
    &slivers::ROW,
    &closed_rooms::ROW,
    &room_edges::ROW,
    &moved::ROW,
    &scaled::ROW,
    &hard_rays::ROW,
    &coplanar::ROW,
    &stack::ROW,
    &layouts::ROW,
    &two_adapters::ROW,
    &trees::ROW,
    &equal_centroids::ROW,
    &equal_codes::ROW,
    &instances::ROW,
    &far_thing::ROW,
    &moved_pictures::ROW,
    &scaled_pictures::ROW,
    &furnace::ROW,
    &albedo::ROW,
    &coarse_balls::ROW,
    &glass_of_one::ROW,
    &tiny_lights::ROW,
    &covers::ROW,
    &coincident_lamps::ROW,
    &veils::ROW,
    &cut_outs::ROW,
    &texels::ROW,
    &texel_weights::ROW,
    &relief::ROW,
    &twin::ROW,
    &oracle::ROW,
    &estimators::ROW,
    &reuse_twin::ROW,
    &reuse::ROW,
    &claimed_error::ROW,
    &adaptive::ROW,
    &random_edits::ROW,
    &independence::ROW,
    &film_sums::ROW,
    &bad_samples::ROW,
    &bad_inputs::ROW,
    &bad_pictures::ROW,
];

/// The row of a name.
pub fn named(name: &str) -> Option<&'static Row> {
    ALL.iter().copied().find(|row| row.name == name)
}

//! What of film, tree and picture has to be made anew for what was extracted.

use bevy_ecs::prelude::*;

use super::step::Step;
use super::surfaces::Surfaces;
use crate::components::Film;
use crate::gpu::GpuTable;
use crate::layout::light::LightRecord;
use crate::layout::texture::{Tangents, TextureRecord};
use crate::layout::trace::Shading;
use crate::layout::tree::Triangle;
use crate::systems::resources::{Displayed, FilmProgress, MeanEmission, Shot, Sky, Tree};
use crate::systems::run::counted;

pub fn add_systems(schedule: &mut Schedule) {
    let triangles = resource_changed::<GpuTable<Triangle>>;
    schedule.add_systems(
        (
            discard_tree.pipe(counted("discard_tree")).run_if(triangles),
            restart_film.pipe(counted("restart_film")).run_if(light_changed),
            outdate_picture.pipe(counted("outdate_picture")).run_if(resource_changed::<Displayed>),
        )
            .in_set(Step::Film),
    );
}

/// What the kernel reads.
#[derive(bevy_ecs::system::SystemParam)]
struct Seen<'w> {
    surfaces: Surfaces<'w>,
    shading: Res<'w, GpuTable<Shading>>,
    lights: Res<'w, GpuTable<LightRecord>>,
    means: Res<'w, GpuTable<MeanEmission>>,
    textures: Res<'w, GpuTable<TextureRecord>>,
    tangents: Res<'w, GpuTable<Tangents>>,
    sky: Res<'w, Sky>,
    shot: Res<'w, Shot>,
}

/// Any of it is another one.
fn light_changed(seen: Seen) -> bool {
    seen.surfaces.are_others()
        || seen.shading.is_changed()
        || seen.lights.is_changed()
        || seen.means.is_changed()
        || seen.textures.is_changed()
        || seen.tangents.is_changed()
        || seen.sky.is_changed()
        || seen.shot.is_changed()
}

/// Triangles changed: Morton codes to tree. Another tree has the same hits, but may have other steps to them.
fn discard_tree(mut tree: ResMut<Tree>, mut progress: Single<&mut FilmProgress, With<Film>>) {
    tree.built = false;
    progress.outdate_views();
}

/// Light changed: the film starts anew.
fn restart_film(mut progress: Single<&mut FilmProgress, With<Film>>) {
    progress.restart();
}

/// The picture is shown otherwise.
fn outdate_picture(mut progress: Single<&mut FilmProgress, With<Film>>) {
    progress.outdate_beauty();
}

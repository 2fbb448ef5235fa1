//! What of film, tree and picture has to be made anew for what was extracted.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::components::Film;
use crate::gpu::GpuTable;
use crate::layout::light::LightRecord;
use crate::layout::trace::{MaterialRecord, Shading};
use crate::layout::tree::Triangle;
use crate::systems::resources::{Exposure, FilmProgress, Shot, Sky, Tree};
use crate::systems::run::counted;

pub fn add_systems(schedule: &mut Schedule) {
    let triangles = resource_changed::<GpuTable<Triangle>>;
    schedule.add_systems(
        (
            discard_tree.pipe(counted("discard_tree")).run_if(triangles),
            restart_film.pipe(counted("restart_film")).run_if(light_changed),
            outdate_picture.pipe(counted("outdate_picture")).run_if(resource_changed::<Exposure>),
        )
            .in_set(Step::Film),
    );
}

/// Anything that the kernel reads is another one.
fn light_changed(
    triangles: Res<GpuTable<Triangle>>,
    shading: Res<GpuTable<Shading>>,
    records: Res<GpuTable<MaterialRecord>>,
    lights: Res<GpuTable<LightRecord>>,
    sky: Res<Sky>,
    shot: Res<Shot>,
) -> bool {
    triangles.is_changed()
        || shading.is_changed()
        || records.is_changed()
        || lights.is_changed()
        || sky.is_changed()
        || shot.is_changed()
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

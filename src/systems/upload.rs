//! Tables to buffers, and room for a film that begins.

use bevy_ecs::prelude::*;
use glam::UVec2;

use super::error::EngineError;
use super::phase::Phase;
use super::resources::{
    Device, FilmProgress, MeanEmission, Robust, Shot, SkyCell, Spent, Texel, Tiles, film_has_not_begun,
};
use super::run::counted;
use crate::components::Film;
use crate::cpu::allocation::Grid;
use crate::gpu::{GpuTable, TableRow};
use crate::layout::cdf::CdfEntry;
use crate::layout::light::LightRecord;
use crate::layout::texture::{CornerUvs, MaterialMaps, Tangents, TextureRecord};
use crate::layout::trace::{MaterialRecord, Shading};
use crate::layout::tree::Triangle;
use crate::passes::{adaptive, blocks, film};

/// Every array of the scene.
const TABLES: [Table; 12] = [
    Table::of::<Triangle>(),
    Table::of::<Shading>(),
    Table::of::<MaterialRecord>(),
    Table::of::<LightRecord>(),
    Table::of::<SkyCell>(),
    Table::of::<CdfEntry>(),
    Table::of::<TextureRecord>(),
    Table::of::<Texel>(),
    Table::of::<MaterialMaps>(),
    Table::of::<CornerUvs>(),
    Table::of::<Tangents>(),
    Table::of::<MeanEmission>(),
];

/// What is done with a table whatever its rows are.
struct Table {
    insert: fn(&mut World),
    add_system: fn(&mut Schedule),
    send_all: fn(&mut World),
    /// Its buffer, and the bytes of its rows.
    bytes: fn(&World) -> (&'static str, u64),
}

impl Table {
    const fn of<T: TableRow>() -> Self {
        Table {
            insert: |world| {
                world.init_resource::<GpuTable<T>>();
            },
            add_system: |schedule| {
                let system = upload_table::<T>.pipe(counted(T::BUFFER));
                schedule.add_systems(system.run_if(is_stale::<T>).in_set(Phase::Upload));
            },
            send_all: |world| world.resource_mut::<GpuTable<T>>().send_all(),
            bytes: |world| (T::BUFFER, size_of_val(world.resource::<GpuTable<T>>().rows()) as u64),
        }
    }
}

/// Adds all tables, empty.
pub fn insert_tables(world: &mut World) {
    TABLES.iter().for_each(|table| (table.insert)(world));
}

/// The buffers of all tables, and the bytes of their rows.
pub fn table_bytes(world: &World) -> impl Iterator<Item = (&'static str, u64)> {
    TABLES.iter().map(|table| (table.bytes)(world))
}

/// Has all tables sent again.
pub fn send_tables_again(world: &mut World) {
    TABLES.iter().for_each(|table| (table.send_all)(world));
}

pub fn add_systems(schedule: &mut Schedule) {
    TABLES.iter().for_each(|table| (table.add_system)(schedule));
    let begin = begin_film.pipe(counted("begin_film"));
    schedule.add_systems(begin.run_if(film_has_not_begun).in_set(Phase::Upload));
}

fn is_stale<T: TableRow>(table: Res<GpuTable<T>>) -> bool {
    table.is_stale()
}

/// Sends what the device lacks of a table. Its contents stay what they were: it does not count as changed.
fn upload_table<T: TableRow>(mut device: ResMut<Device>, mut table: ResMut<GpuTable<T>>) -> Result<(), EngineError> {
    Ok(table.bypass_change_detection().upload(&mut device.0)?)
}

/// Makes room for a film that starts anew, and sets the features its pipelines are compiled for.
fn begin_film(
    mut device: ResMut<Device>,
    mut progress: Single<&mut FilmProgress, With<Film>>,
    shot: Res<Shot>,
    robust: Res<Robust>,
    mut spent: ResMut<Spent>,
    mut tiles: ResMut<Tiles>,
) -> Result<(), EngineError> {
    let size = shot.size();
    let pixels = u64::from(size.x) * u64::from(size.y);
    let blocks = if robust.0 && !shot.is_adaptive() { blocks::buffers(pixels) } else { Vec::new() };
    for (name, bytes) in film::buffers(pixels).into_iter().chain(blocks) {
        device.0.reserve(name, bytes)?;
    }
    *tiles = Tiles::default();
    if shot.is_adaptive() {
        for (name, bytes) in adaptive::buffers(pixels) {
            device.0.reserve(name, bytes)?;
        }
        *tiles = Tiles::of(Grid::of(UVec2::new(shot.params.window_x, shot.params.window_y), size));
    }
    let of_device = device.0.gpu().shader_features().iter().copied();
    let features: Vec<&str> = shot.features.iter().map(String::as_str).chain(of_device).collect();
    device.0.set_features(&features);
    progress.begun = true;
    spent.film = 0.0;
    Ok(())
}

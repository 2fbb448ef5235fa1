//! The picture of the environment to pixels and the tables by which directions are drawn from it.

use bevy_ecs::prelude::*;
use glam::Vec3;

use super::step::Step;
use crate::components::{Daylight, Environment, EnvironmentItem, EnvironmentMap, Name, rendered_environment};
use crate::gpu::GpuTable;
use crate::layout::cdf::CdfEntry;
use crate::layout::sky::SkyTable;
use crate::prepare::daylight;
use crate::prepare::sky_size::{halve_sky, halvings_of_sky};
use crate::systems::resources::{Device, Everything, Sky, SkyCell, SkySource};
use crate::systems::run::counted;

type Touched = (With<Environment>, Or<(Changed<Environment>, Changed<Name>)>);

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_sky.pipe(counted("extract_sky"));
    schedule.add_systems(system.run_if(environment_changed).in_set(Step::Sky));
}

/// An environment came, went, changed or was renamed.
pub fn environment_changed(
    everything: Res<Everything>,
    touched: Query<(), Touched>,
    mut gone: RemovedComponents<Environment>,
    mut unnamed: RemovedComponents<Name>,
) -> bool {
    let removed = gone.read().count() + unnamed.read().count() > 0;
    everything.0 || removed || !touched.is_empty()
}

/// Packs the environment's picture where it is another one, or of another strength or tint. How it is turned, no table says.
fn extract_sky(
    environments: Query<EnvironmentItem>,
    mut sky: ResMut<Sky>,
    mut cells: ResMut<GpuTable<SkyCell>>,
    mut cdf: ResMut<GpuTable<CdfEntry>>,
    device: Res<Device>,
) {
    let source = match rendered_environment(environments) {
        Some(Environment::Map { image, strength, tint, .. }) => SkySource::Map(image.clone(), *strength * *tint),
        Some(Environment::Daylight(day)) => SkySource::Daylight(Daylight { azimuth: 0.0, ..*day }),
        Some(Environment::Constant(_)) | None => {
            if sky.source.is_some() {
                *sky = Sky::default();
                cells.set(Vec::new());
                cdf.set(Vec::new());
            }
            return;
        }
    };
    if sky.source.as_ref().is_some_and(|held| held.same(&source)) {
        return;
    }
    let (table, halvings) = match &source {
        SkySource::Map(image, factor) => fitting(image, *factor, device.0.gpu().most_bytes()),
        SkySource::Daylight(day) => (SkyTable::new(daylight::SIZE, &daylight::sky_pixels(day), Vec3::ONE), 0),
    };
    cells.set(table.cells.into_iter().map(SkyCell).collect());
    cdf.set(table.cdf);
    *sky = Sky { source: Some(source), size: table.size, halvings, power: table.power, brightest: table.brightest };
}

/// The tables of a picture that are to take at most so many bytes each, and how often it was halved for that.
fn fitting(image: &EnvironmentMap, factor: Vec3, room: u64) -> (SkyTable, u32) {
    match halvings_of_sky(image.size, room) {
        0 => (SkyTable::new(image.size, &image.pixels, factor), 0),
        halvings => {
            let (size, pixels) = halve_sky(image.size, &image.pixels, halvings);
            (SkyTable::new(size, &pixels, factor), halvings)
        }
    }
}

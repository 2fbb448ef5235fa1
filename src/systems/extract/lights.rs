//! Emitting triangles to the table that light sampling draws from.

use bevy_ecs::prelude::*;

use super::step::Step;
use crate::components::Integrator;
use crate::gpu::GpuTable;
use crate::layout::light::{LightRecord, LightTable};
use crate::layout::trace::MaterialRecord;
use crate::layout::tree::Triangle;
use crate::systems::resources::{Everything, LightDensity, Policy};
use crate::systems::run::counted;

pub fn add_systems(schedule: &mut Schedule) {
    let system = extract_lights.pipe(counted("extract_lights"));
    schedule.add_systems(system.run_if(lights_changed).in_set(Step::Lights));
}

/// Triangles, records or the integrator changed.
fn lights_changed(
    everything: Res<Everything>,
    triangles: Res<GpuTable<Triangle>>,
    records: Res<GpuTable<MaterialRecord>>,
    policy: Res<Policy>,
) -> bool {
    everything.0 || triangles.is_changed() || records.is_changed() || policy.is_changed()
}

/// Makes the table anew. A scene whose integrator samples no lights has none.
fn extract_lights(
    triangles: Res<GpuTable<Triangle>>,
    records: Res<GpuTable<MaterialRecord>>,
    policy: Res<Policy>,
    mut lights: ResMut<GpuTable<LightRecord>>,
    mut density: ResMut<LightDensity>,
) {
    let emits: Vec<bool> = records.rows().iter().map(|record| record.emission.max_element() > 0.0).collect();
    let table = match policy.integrator == Integrator::Path && emits.contains(&true) {
        true => {
            let shines = |triangle: &&Triangle| emits.get(triangle.material as usize).is_some_and(|emits| *emits);
            LightTable::new(triangles.rows().iter().filter(shines).copied(), records.rows())
        }
        false => LightTable::default(),
    };
    if !lights.holds(&table.lights) {
        lights.set(table.lights);
    }
    density.set_if_neq(LightDensity(table.density));
}

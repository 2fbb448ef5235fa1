//! What the oracle says of the vertices of paths, beside the kernel.

use glam::{DVec3, UVec2};
use lucerna::cpu::turn::RayKind;
use lucerna::oracle::Oracle;
use lucerna::shader::Library;

use super::{open, scene_with};

#[test]
fn the_oracle_meets_the_same_vertices_and_values() {
    for name in ["cornell-data", "cornell-box", "glass"] {
        let mut engine = open(Library::shipped(), &scene_with(name, &[]));
        let samples: Vec<_> = (0..24).map(|i| (UVec2::new(i, (5 * i) % 18), i)).collect();
        let replays = engine.replay_all(&samples).unwrap();
        let oracle = engine.edit(Oracle::new).unwrap();
        let (mut met, mut values) = (0, 0);
        for (replay, turn) in replays.iter().flat_map(|replay| replay.gpu.iter().map(move |turn| (replay, turn))) {
            let (RayKind::Segment, Some(hit)) = (turn.kind, turn.met) else { continue };
            let drawn = turn.drawn.filter(|drawn| drawn.pdf > 0.0);
            let asked = [
                turn.light.map(|light| (light.direction, light.value)),
                drawn.map(|d| (d.direction, d.weight * d.pdf)),
            ];
            let asked: Vec<(DVec3, DVec3)> = asked.into_iter().flatten().collect();
            let from: Vec<DVec3> = asked.iter().map(|(direction, _)| *direction).collect();
            let vertex = oracle.vertex(replay.origin + turn.origin, turn.direction, hit.triangle, &from).unwrap();
            met += 1;
            if vertex.triangle != hit.triangle {
                continue;
            }
            assert!((vertex.t - hit.t).abs() <= 1e-5 * (1.0 + hit.t), "{name}: {vertex:?} {turn:?}");
            assert!((vertex.emitted - turn.emitted).abs().max_element() <= 1e-5 * vertex.emitted.max_element());
            for ((value, _), (_, ours)) in vertex.values.unwrap().into_iter().zip(asked) {
                // Normals of meshes are rounded to 16 bits on the device, and lobes are steep.
                let bound = 5e-3 * value.max_element().max(ours.max_element()) + 1e-6;
                assert!((value - ours).abs().max_element() <= bound, "{name}: {value} {ours} {turn:?}");
                values += 1;
            }
        }
        assert!(met > 30 && values > 20, "{name}: {met} vertices, {values} values");
    }
}

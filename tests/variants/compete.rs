//! `--race`: samplers and integrators on a small scene.

use lucerna::app::variants::record::State;

use super::{answer, folder, member, run};

/// One sampler is far worse where light is smooth.
const FAMILY: &str = r#"(
    extends: "a.ron",
    sweep: {"render.sampler": [Sobol, Pcg]},
    members: {"bsdf": {"render.sampler": "pcg", "render.integrator": "bsdf"}},
)
"#;

#[test]
fn members_that_are_certain_to_lose_end_early() {
    let folder = folder(&FAMILY.replace("\"pcg\"", "Pcg").replace("\"bsdf\"}", "Bsdf}"));
    let run = run(folder.path(), &["--race", "--spp", "16", "--rounds", "200", "--out", "out", "--quiet"]);
    let said = String::from_utf8(run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(0), "{said}{}", String::from_utf8_lossy(&run.stderr));
    assert!(said.contains("race of 3 members") && said.contains("of the time saved"), "{said}");
    assert!(said.contains("with a confidence of 99.9"), "{said}");
    let written = std::fs::read(folder.path().join("out/fam/answer.json")).unwrap();
    let raced: lucerna::app::variants::record::Answer = serde_json::from_slice(&written).unwrap();
    let State::Lost { seconds, confidence } = member(&raced, "Pcg").state else { panic!("{said}") };
    assert!(seconds > 0.0 && confidence >= 0.999);
    assert!(member(&raced, "Sobol").state == State::Done && member(&raced, "Sobol").snapshots[0].relmse > 0.0);

    // What was raced is not taken for what is rendered without a race.
    let rendered = answer(folder.path(), &["--out", "out"], 0);
    assert!(rendered.records.iter().all(|record| record.snapshots[0].spp == 4));
    let alone = super::run(folder.path(), &["--race", "--only", "Pcg"]);
    assert_eq!(alone.status.code(), Some(2));
}

//! `--race`: samplers and integrators on a small scene.

use lucerna::app::variants::record::State;

use super::{answer, folder, member, run};

/// One sampler is far worse where light is smooth.
const FAMILY: &str = r#"(
    extends: "a.ron",
    sweep: {"render.sampler": [Sobol, Pcg]},
    members: {"bsdf": {"render.sampler": Pcg, "render.integrator": Bsdf}},
)
"#;

#[test]
fn members_that_are_certain_to_lose_end_early() {
    let folder = folder(FAMILY);
    let run = run(folder.path(), &["--race", "--spp", "16", "--rounds", "200", "--out", "out", "--quiet"]);
    let said = String::from_utf8(run.stdout).unwrap();
    assert_eq!(run.status.code(), Some(0), "{said}{}", String::from_utf8_lossy(&run.stderr));
    assert!(said.contains("race of 3 members") && said.contains("of the time saved"), "{said}");
    assert!(said.contains("with a confidence of 99.9"), "{said}");
    let written = std::fs::read(folder.path().join("out/fam/race/answer.json")).unwrap();
    let raced: lucerna::app::variants::record::Answer = serde_json::from_slice(&written).unwrap();
    let State::Lost { seconds, confidence } = member(&raced, "Pcg").state else { panic!("{said}") };
    assert!(seconds > 0.0 && confidence >= 0.999);
    assert!(member(&raced, "Sobol").state == State::Done && member(&raced, "Sobol").snapshots[0].relmse > 0.0);

    // What was raced is not taken for what is rendered without a race, and takes nothing of that away.
    let rendered = answer(folder.path(), &["--out", "out"], 0);
    assert!(rendered.records.iter().all(|record| record.snapshots[0].spp == 4));
    super::run(folder.path(), &["--race", "--spp", "1", "--rounds", "4", "--out", "out", "--quiet"]);
    let again = super::run(folder.path(), &["--out", "out", "--quiet"]);
    assert!(String::from_utf8_lossy(&again.stdout).contains("nothing had to be rendered"));
    let alone = super::run(folder.path(), &["--race", "--only", "Pcg"]);
    assert_eq!(alone.status.code(), Some(2));
}

/// A member that is fast since it leaves light out is no winner: it is told as wrong, and ends nobody.
#[test]
fn a_member_of_another_mean_is_wrong_and_not_fast() {
    let family = r#"(extends: "a.ron", overrides: {"film.size": (32, 24)},
        members: {"right": {}, "brighter": {"shaders": "bright"}, "slow": {"render.sampler": Pcg}})"#;
    let folder = folder(family);
    let path = std::fs::read_to_string("shaders/passes/trace/path.wgsl").unwrap();
    let brighter = path.replace("(*state).radiance += light;", "(*state).radiance += 1.5 * light;");
    assert_ne!(path, brighter);
    std::fs::create_dir_all(folder.path().join("bright/passes/trace")).unwrap();
    std::fs::write(folder.path().join("bright/passes/trace/path.wgsl"), brighter).unwrap();
    let raced = super::run(folder.path(), &["--race", "--spp", "16", "--rounds", "64", "--out", "out", "--quiet"]);
    let said = String::from_utf8_lossy(&raced.stdout).into_owned();
    assert_eq!(raced.status.code(), Some(1), "{said}");
    assert!(said.contains("brighter: wrong, not slow: its mean differs from that of right"), "{said}");
    let written = std::fs::read(folder.path().join("out/fam/race/answer.json")).unwrap();
    let answer: lucerna::app::variants::record::Answer = serde_json::from_slice(&written).unwrap();
    let state = |name: &str| member(&answer, name).state.clone();
    assert!(matches!(state("brighter"), State::Failed { message, .. } if message.contains("mean differs")));
    assert_eq!(state("right"), State::Done);
}

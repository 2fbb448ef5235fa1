//! The lint of surfaces: silent on the shipped ones, however sharp and grazing, and loud on planted mistakes.

use std::collections::BTreeSet;
use std::time::Instant;

use glam::Vec3;
use lucerna::components::{Energy, Lobe, Material, Passage};
use lucerna::cpu::lint::Flaw;
use lucerna::gpu::Values;
use lucerna::layout::trace::MaterialRecord;
use lucerna::prepare::material;
use lucerna::shader::Library;
use lucerna::watch::lint::{Finding, Surfaces, VIEWS, kinds, run};

use crate::support;

type Named = (String, MaterialRecord);

fn pack(name: &str, values: Material) -> Named {
    (name.to_owned(), material::pack(&values, Energy::Preserve))
}

fn grey(kd: f32, ks: f32) -> Material {
    Material { diffuse: Vec3::splat(kd), specular: Vec3::new(ks, 0.5 * ks, ks), ..Material::BLACK }
}

/// Every kind of lobe, alone and beside others.
fn surfaces() -> Vec<Named> {
    let mut all = vec![
        pack("white", grey(1.0, 0.0)),
        pack("black", grey(0.0, 0.0)),
        pack("mirror", Material { lobe: Lobe::Mirror, ..grey(0.0, 1.0) }),
        pack("half mirror", Material { lobe: Lobe::Mirror, ..grey(0.5, 0.5) }),
        pack("glass", Material { passage: Passage::Glass(1.5), ..grey(0.0, 0.0) }),
        pack("pane", Material { passage: Passage::Pane(1.5), ..grey(0.0, 0.0) }),
        pack("thin", Material { passage: Passage::SeeThrough(0.3), ..grey(0.8, 0.0) }),
        pack(
            "hardly there",
            Material { passage: Passage::SeeThrough(0.01), lobe: Lobe::Phong(50.0), ..grey(0.5, 0.4) },
        ),
    ];
    for (kd, ks) in [(0.0, 1.0), (0.5, 0.4), (0.9, 0.02)] {
        for coat_roughness in [0.0, 0.1, 0.5] {
            let name = format!("coat of {coat_roughness} {ks}");
            all.push(pack(&name, Material { coat: 0.9, coat_roughness, lobe: Lobe::Ggx(0.5), ..grey(kd, ks) }));
        }
        for ns in [1.0, 10.0, 100.0, 1e3, 1e4, 1e5] {
            all.push(pack(&format!("Phong {ns} {ks}"), Material { lobe: Lobe::Phong(ns), ..grey(kd, ks) }));
        }
        for alpha in [1e-3f32, 0.01, 0.1, 0.3, 1.0] {
            all.push(pack(&format!("GGX {alpha} {ks}"), Material { lobe: Lobe::Ggx(alpha.sqrt()), ..grey(kd, ks) }));
        }
    }
    all
}

/// Lints each surface by itself, so that none hides another of its kind; features are those of all.
fn lint(library: &Library, surfaces: &[Named], views: &[f64], seed: u32) -> Vec<Finding> {
    surfaces
        .chunks(1)
        .flat_map(|one| {
            run(&support::gpu(), library.clone(), lent(one), views, (seed, &Values::new()), || true).unwrap().unwrap()
        })
        .collect()
}

/// Surfaces of a scene whose paths are reused, so that all there is to lint is.
fn lent(materials: &[Named]) -> Surfaces<'_> {
    Surfaces { materials, reused: true }
}

#[test]
fn shipped_surfaces_never_warn() {
    let views = [0.0, 1.0, 10.0, 30.0, 50.0, 65.0, 80.0, 85.0, 89.0];
    for seed in 0..4 {
        let found = lint(&Library::shipped(), &surfaces(), &views, seed);
        let texts: Vec<String> = found.iter().map(Finding::to_string).collect();
        assert!(found.is_empty(), "seed {seed}: {texts:#?}");
    }
}

/// The shipped library with a mistake.
fn planted(module: &str, from: &str, to: &str) -> Library {
    let library = Library::shipped();
    let text = library.text(module).unwrap().to_owned();
    assert!(text.contains(from), "{module} has no `{from}`");
    library.with(module, &text.replacen(from, to, 1))
}

fn flaws(library: &Library, surfaces: &[Named]) -> Vec<Flaw> {
    lint(library, surfaces, &VIEWS, 7).into_iter().map(|finding| finding.flaw).collect()
}

#[test]
fn planted_mistakes_are_found() {
    let lambert = [pack("floor", grey(0.95, 0.0))];
    let shiny = [pack("pot", Material { lobe: Lobe::Phong(200.0), ..grey(0.5, 0.45) })];
    let rough = [pack("metal", Material { lobe: Lobe::Ggx(0.3), ..grey(0.0, 0.9) })];

    let uniform =
        planted("lib/sampling", "return Angle(sqrt(1.0 - u), sqrt(u));", "return Angle(1.0 - u, sqrt(u * (2.0 - u)));");
    for surfaces in [&lambert, &shiny] {
        let found = flaws(&uniform, surfaces);
        assert!(matches!(found[..], [Flaw::Misdrawn { deviations, .. }] if deviations > 10.0), "{found:?}");
    }

    let halved = planted("lib/bsdf/lambert", "return INV_PI * cos_theta;", "return 0.5 * INV_PI * cos_theta;");
    let found = flaws(&halved, &lambert);
    let is_half = |flaw: &Flaw| matches!(flaw, Flaw::Integral { total } if (total - 0.5).abs() < 0.01);
    assert!(found.iter().any(is_half), "{found:?}");

    let brighter = planted(
        "lib/bsdf/mixture",
        "return BsdfSample(wi, at.pdf, weight);",
        "return BsdfSample(wi, at.pdf, weight * 1.1);",
    );
    let found = flaws(&brighter, &lambert);
    assert!(found.iter().any(|flaw| matches!(flaw, Flaw::OtherWeight { .. })), "{found:?}");
    let is_gain = |flaw: &Flaw| matches!(flaw, Flaw::Gain { mean, .. } if (mean - 1.045).abs() < 1e-3);
    assert!(found.iter().any(is_gain), "{found:?}");

    let other = planted(
        "lib/bsdf/mixture",
        "return BsdfSample(wi, at.pdf, weight);",
        "return BsdfSample(wi, 1.5 * at.pdf, weight);",
    );
    let found = flaws(&other, &shiny);
    assert!(matches!(found[..], [Flaw::OtherPdf { .. }]), "{found:?}");

    let nan = planted("lib/bsdf/ggx", "sqrt(cos_theta * cos_theta + slope)", "sqrt(cos_theta * cos_theta - 2.0)");
    let found = flaws(&nan, &rough);
    assert!(matches!(found[..], [Flaw::Broken { draws }] if draws > 1000), "{found:?}");

    // Half the exponent of the pdf, in a lobe beside a diffuse one. (0.8 of it is too little to be told from noise.)
    let wider = planted("lib/sampling", "/ (n + 1.0))", "/ (0.5 * n + 1.0))");
    let found = flaws(&wider, &shiny);
    assert!(matches!(found[..], [Flaw::Misdrawn { .. }]), "{found:?}");
}

#[test]
fn what_is_lent_and_depends_on_the_view_is_found_where_paths_are_reused() {
    let lambert = [pack("floor", grey(0.95, 0.0))];
    let shiny = [pack("pot", Material { lobe: Lobe::Phong(200.0), ..grey(0.5, 0.45) })];
    let edited = planted(
        "lib/bsdf/mixture",
        "var value = lambert_value(m.kd, cos_theta);",
        "var value = lambert_value(m.kd, cos_theta) * (0.5 + 0.5 * dot(frame.wo, frame.shading));",
    );
    let changes = |flaw: &Flaw| matches!(flaw, Flaw::Viewed { change } if (change - 0.179).abs() < 0.001);
    for surfaces in [&lambert, &shiny] {
        let found = flaws(&edited, surfaces);
        assert!(found.iter().any(changes), "{found:?}");
        let alone = Surfaces { materials: surfaces, reused: false };
        let found = run(&support::gpu(), edited.clone(), alone, &VIEWS, (7, &Values::new()), || true);
        assert!(found.unwrap().unwrap().iter().all(|finding| !matches!(finding.flaw, Flaw::Viewed { .. })));
    }
}

#[test]
fn a_warning_names_what_and_where() {
    let halved = planted("lib/bsdf/lambert", "return INV_PI * cos_theta;", "return 0.5 * INV_PI * cos_theta;");
    let found = run(
        &support::gpu(),
        halved,
        lent(&[pack("model:floor", grey(0.5, 0.0))]),
        &[30.0],
        (1, &Values::new()),
        || true,
    );
    let texts: Vec<String> = found.unwrap().unwrap().iter().map(Finding::to_string).collect();
    let text = texts.iter().find(|text| text.contains("evaluate's pdf")).unwrap();
    assert!(text.contains("come to 0.5") || text.contains("come to 0.49"), "{text}");
    assert!(text.ends_with("for material `model:floor` seen at 30 degrees"), "{text}");
}

#[test]
fn one_of_each_kind_is_looked_at() {
    let all = surfaces();
    let chosen: BTreeSet<&str> = kinds(&all).into_iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(chosen.len(), 8);
    let two = [pack("dark", grey(0.2, 0.0)), pack("bright", grey(0.9, 0.0))];
    assert_eq!(kinds(&two).len(), 1);
    assert_eq!(kinds(&two)[0].0, "bright");
}

/// What nobody wants to know any more is left. How long both take is shown with --nocapture.
#[test]
fn an_unwanted_lint_ends() {
    let surfaces = [pack("floor", grey(0.5, 0.0))];
    let begin = Instant::now();
    assert_eq!(
        run(&support::gpu(), Library::shipped(), lent(&surfaces), &VIEWS, (1, &Values::new()), || false).unwrap(),
        None
    );
    println!("a lint that ends early: {:?}", begin.elapsed());
    let begin = Instant::now();
    run(&support::gpu(), Library::shipped(), lent(&self::surfaces()), &VIEWS, (1, &Values::new()), || true).unwrap();
    println!("a lint of eight kinds: {:?}", begin.elapsed());
}

/// An edit that keeps its promises is not warned of: directions uniform over the hemisphere, with their own pdf.
#[test]
fn another_sampler_with_its_own_pdf_is_right() {
    let sampling =
        planted("lib/sampling", "return Angle(sqrt(1.0 - u), sqrt(u));", "return Angle(1.0 - u, sqrt(u * (2.0 - u)));");
    let lambert = Library::shipped().text("lib/bsdf/lambert").unwrap().to_owned();
    let both =
        sampling.with("lib/bsdf/lambert", &lambert.replace("return INV_PI * cos_theta;", "return 0.5 * INV_PI;"));
    let shiny = [pack("pot", Material { lobe: Lobe::Phong(200.0), ..grey(0.5, 0.45) })];
    assert_eq!(flaws(&both, &shiny), []);
}

//! Declarations of parameters: what they come to, and what is wrong with others, at its place.

use lucerna::shader::{ErrorKind, Library, Parameter, ParameterKind};

use crate::shader::{features, library};

/// All parameters of some modules beside the shipped ones, which have none.
fn parameters(modules: &[(&str, &str)]) -> Vec<Parameter> {
    library(modules).parameters().unwrap()
}

#[test]
fn the_shipped_shaders_declare_none() {
    assert!(Library::embedded().parameters().unwrap().is_empty());
}

#[test]
fn a_declaration_says_kind_default_and_range() {
    let text = "@range(0.0, 16.0) override A: f32 = 8.0;\n\
                override B: f32 = -1.5e-3f;\n\
                @if(some) @range(1, 64) override C: u32 = 4u;\n\
                @range(-2, 2)\n  override /* of two */ D\n: i32 = -1;\n\
                override E: bool = true;\n";
    let found = parameters(&[("t/p", text)]);
    let all: Vec<_> = found.iter().map(|p| (p.name.as_str(), p.kind, p.default, p.range, p.place.line)).collect();
    assert_eq!(
        all,
        [
            ("A", ParameterKind::Number, 8.0, Some([0.0, 16.0]), 1),
            ("B", ParameterKind::Number, -1.5e-3, None, 2),
            ("C", ParameterKind::Whole, 4.0, Some([1.0, 64.0]), 3),
            ("D", ParameterKind::Signed, -1.0, Some([-2.0, 2.0]), 5),
            ("E", ParameterKind::Switch, 1.0, None, 7),
        ]
    );
    assert_eq!(found[0].to_string(), "@range(0, 16) override A: f32 = 8;");
    assert_eq!(found[4].to_string(), "override E: bool = true;");
}

#[test]
fn a_value_fits_its_kind_and_its_range() {
    let text = "@range(0.0, 16.0) override A: f32 = 8.0;\n@range(1, 64) override C: u32 = 4;\noverride D: i32 = -1;\n\
                override E: bool = true;\noverride F: f32 = 0.0;\n";
    let found = parameters(&[("t/p", text)]);
    let fits = |index: usize, values: &[f64]| values.iter().map(|v| found[index].fits(*v)).collect::<Vec<_>>();
    assert_eq!(fits(0, &[0.0, 16.0, 16.001, -0.001, f64::NAN]), [true, true, false, false, false]);
    assert_eq!(fits(1, &[1.0, 64.0, 65.0, 0.0, 1.5]), [true, true, false, false, false]);
    assert_eq!(fits(2, &[-2147483648.0, 2147483647.0, 2147483648.0, 0.5]), [true, true, false, false]);
    assert_eq!(fits(3, &[0.0, 1.0, 2.0]), [true, true, false]);
    assert_eq!(fits(4, &[-1e38, 1e39, f64::INFINITY]), [true, false, false]);
    assert_eq!([found[0].value(Some(3.0)), found[0].value(Some(17.0)), found[0].value(None)], [3.0, 8.0, 8.0]);
    assert_eq!([found[0].word(0.5), found[2].word(-1.0), found[3].word(1.0)], [0x3f00_0000, u32::MAX, 1]);
}

#[test]
fn wrong_declarations_are_told_where_they_stand() {
    for (text, place, message) in [
        ("@range(0.0) override A: f32 = 1.0;", (1, 11), "`@range` wants two numbers"),
        ("@range(0.0, x) override A: f32 = 1.0;", (1, 13), "`@range` wants two numbers"),
        ("@range override A: f32 = 1.0;", (1, 2), "`@range` wants two numbers in parentheses"),
        ("@range(16.0, 0.0) override A: f32 = 1.0;", (1, 8), "the least first, and more behind it: found 16.0 and 0.0"),
        ("@range(1.0, 1.0) override A: f32 = 1.0;", (1, 8), "the least first"),
        ("@range(0.0, 1.0)\noverride A: vec3<f32> = 1.0;", (2, 11), "f32, u32, i32 or bool"),
        ("@range(0.0, 1.0) const A: f32 = 1.0;", (1, 18), "`@range` stands before an `override`"),
        ("@range(0.0, 1.0) @id(3) override A: f32 = 1.0;", (1, 18), "`@range` stands before an `override`"),
        ("@id(3) override A: f32 = 1.0;", (1, 8), "no attribute but `@range`"),
        ("@range(0, 1) override A: bool = true;", (1, 23), "`A` is true or false"),
        ("@range(0.5, 4) override A: u32 = 1;", (1, 8), "a bound of `A` is `0.5`: it wants a whole number, at least 0"),
        ("override A = 1.0;", (1, 12), "`A` wants a type and a default"),
        ("override A: f32;", (1, 11), "`A` wants a type and a default"),
        ("override A: f32 = 2.0 * 3.0;", (1, 19), "the default of `A` is `2.0 * 3.0`: it wants a number"),
        ("@range(0.0, 16.0) override A: f32 = 20.0;", (1, 37), "is `20.0`: it wants a number from 0 to 16"),
        ("override A: u32 = -1;", (1, 19), "is `-1`: it wants a whole number, at least 0"),
        ("override A: i32 = 1u;", (1, 19), "is `1u`: it wants a whole number"),
        ("override A: bool = 1;", (1, 20), "is `1`: it wants true or false"),
        ("override A: f32 = 1e999;", (1, 19), "is `1e999`: it wants a number"),
        ("override A: f32 = inf;", (1, 19), "is `inf`: it wants a number"),
        ("override A: f32 = ;", (1, 19), "it wants a number"),
        ("override : f32 = 1.0;", (1, 10), "wants a name"),
        ("override while: f32 = 1.0;", (1, 10), "`while` is a word of WGSL"),
        ("override f32: f32 = 1.0;", (1, 10), "`f32` is a word of WGSL"),
        ("override clamp: f32 = 1.0;", (1, 10), "`clamp` is a word of WGSL"),
        ("override _: f32 = 1.0;", (1, 10), "`_` is a word of WGSL"),
        ("override __x: f32 = 1.0;", (1, 10), "`__x` is a word of WGSL"),
    ] {
        let modules = library(&[("t/p", text)]);
        // Whoever links it is told, and whoever asks what there is; which attributes are conditions, only a link knows.
        let asked = modules.parameters().map(|found| found.len());
        assert!(asked.is_err() || text.starts_with("@id"), "{text}");
        for error in [modules.link("t/p", &features(&[])).err(), asked.err()].into_iter().flatten() {
            assert_eq!((error.kind, error.line_column()), (ErrorKind::Parameter, Some(place)), "{text}: {error}");
            assert!(error.message.contains(message) && error.help.is_some(), "{text}: {error}");
        }
    }
}

#[test]
fn a_name_is_that_of_one_module() {
    let modules = [("t/a", "override SIZE: f32 = 1.0;\n"), ("t/b", "fn f() {}\noverride SIZE: u32 = 1;\n")];
    let error = library(&modules).parameters().unwrap_err();
    assert_eq!((error.kind, error.line_column()), (ErrorKind::Duplicate, Some((2, 10))));
    assert_eq!(error.file(), Some("shaders/t/b.wgsl"));
    assert!(error.message.contains("first at shaders/t/a.wgsl:1:10"), "{error}");
}

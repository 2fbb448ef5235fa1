//! A person whose shaders have a number of their own, and who sets it while the window is open.

use super::person::Person;
use super::xvfb::Screenshot;

const F2: u32 = 0xffbf;
const PATH: &str = "shaders/passes/trace/path.wgsl";

/// The part of the window that the panel leaves.
fn picture(look: &Screenshot) -> Vec<[u8; 3]> {
    look.pixels.chunks(look.width as usize).flat_map(|row| &row[..480]).copied().collect()
}

fn brightness(look: &Screenshot) -> f64 {
    let pixels = picture(look);
    pixels.iter().flatten().map(|code| f64::from(*code)).sum::<f64>() / (3 * pixels.len()) as f64
}

#[test]
fn a_number_of_ones_own_is_taken_up_and_followed() {
    let mut person = Person::with_files();
    let replace = |file: &str, from: &str, to: &str| {
        let file = person.folder.path().join(file);
        let text = std::fs::read_to_string(&file).unwrap();
        assert!(text.contains(from), "{} has no `{from}`", file.display());
        std::fs::write(file, text.replacen(from, to, 1)).unwrap();
    };
    person.finish();
    person.display.resize(person.window, 800, 600);
    person.display.key(F2);
    // The panel is a dark grey, at the right edge for sure.
    let panel = |look: &Screenshot| look.pixels.chunks(800).all(|row| row[799].iter().all(|code| *code < 70));
    person.see("the picture beside the panel", |look| look.width == 800 && panel(look) && brightness(look) > 40.0);
    // What it comes to, whatever it is when it is first seen.
    let plain = person.rendered_scene("scene.ron", "500x600");

    let path = std::fs::read_to_string(person.folder.path().join(PATH)).unwrap();
    let declared = "@range(0.0, 16.0) override TIMES: f32 = 1.0;\nconst LARGEST_F32";
    let path = path.replacen("const LARGEST_F32", declared, 1);
    let path = path.replace("(*state).radiance += light;", "(*state).radiance += TIMES * light;");
    std::fs::write(person.folder.path().join(PATH), path).unwrap();
    let stderr = || std::fs::read_to_string(person.folder.path().join("stderr")).unwrap();
    person.see("the same picture by the new code", |look| {
        stderr().contains("path.wgsl taken up") && (brightness(look) - brightness(&plain)).abs() < 4.0
    });

    // A scene that is saved with a value has it; one with a value that is out of range is told, and changes nothing.
    replace("scene.ron", "cameras:", "shader: { \"TIMES\": 0.0 },\n    cameras:");
    person.see("the black picture", |look| brightness(look) < 4.0);
    replace("scene.ron", "\"TIMES\": 0.0", "\"TIMES\": 17.0");
    person.see("the message", |_| stderr().contains("shader.TIMES: expected a number from 0 to 16, found `17`"));
    replace("scene.ron", "\"TIMES\": 17.0", "\"TIMES\": 1.0");
    person.see("the picture as it was", |look| (brightness(look) - brightness(&plain)).abs() < 4.0);
    let stderr = person.quit();
    assert_eq!(stderr.matches("error").count(), 1, "{stderr}");
}

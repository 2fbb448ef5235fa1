//! The section of edits, drawn without a window and used by a pointer.

use egui::epaint::ClippedShape;
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Vec2};
use lucerna::app::edits::{Edit, Kind, Lint, State, Verdict};
use lucerna::app::window::edits::record::Record;
use lucerna::app::window::panel::edits::{EditsAction, EditsShown, show};
use lucerna::shader::Library;

fn edit(kind: Kind, file: &str, verdict: Verdict) -> Edit {
    let files = if file.is_empty() { Vec::new() } else { vec![file.to_owned()] };
    Edit { kind, scene: "box".to_owned(), files, saved: 0, pixels: None, lint: Lint::NotLinted, verdict }
}

fn shaders(text: &str) -> Library {
    Library::embedded().with("lib/own", &format!("// {text}\n"))
}

struct Section {
    context: Context,
    record: Record,
    automatic: bool,
    shapes: Vec<ClippedShape>,
    action: Option<EditsAction>,
}

impl Section {
    fn new() -> Self {
        let opened = edit(Kind::Opened, "", Verdict::new(State::None, ""));
        let context = Context::default();
        context.all_styles_mut(|style| style.animation_time = 0.0);
        Self {
            context,
            record: Record::new(opened, shaders("first")),
            automatic: true,
            shapes: Vec::new(),
            action: None,
        }
    }

    fn draw(&mut self, events: Vec<Event>) {
        let screen_rect = Some(Rect::from_min_size(Pos2::ZERO, Vec2::new(300.0, 700.0)));
        for events in [events, Vec::new()] {
            let input = RawInput { screen_rect, events, ..RawInput::default() };
            let shown = EditsShown { record: &self.record, automatic: self.automatic, rests: true };
            let mut action = None;
            self.shapes = self.context.run_ui(input, |ui| action = show(ui, &shown).or(action)).shapes;
            self.action = action.or(self.action.take());
        }
    }

    fn texts(&self) -> Vec<(String, Rect)> {
        let of = |shape: &ClippedShape| match &shape.shape {
            Shape::Text(drawn) => Some((drawn.galley.text().to_owned(), drawn.visual_bounding_rect())),
            _ => None,
        };
        self.shapes.iter().filter_map(of).collect()
    }

    fn place(&self, text: &str) -> Rect {
        let found = self.texts().into_iter().find(|(drawn, _)| drawn.contains(text));
        found.unwrap_or_else(|| panic!("{text} is not in {:?}", self.texts())).1
    }

    /// Clicks on a text. What was wanted by it.
    fn click(&mut self, text: &str) -> Option<EditsAction> {
        let pos = self.place(text).center();
        self.draw(vec![Event::PointerMoved(pos)]);
        for pressed in [true, false] {
            let button = PointerButton::Primary;
            self.draw(vec![Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]);
        }
        self.action.take()
    }
}

#[test]
fn rows_are_of_one_height_and_a_click_goes_back() {
    let mut section = Section::new();
    section.draw(Vec::new());
    section.place("nothing was saved yet");
    let waiting = || Verdict::new(State::Waiting, "to be judged");
    let a = section.record.take(edit(Kind::Shaders, "lib/a.wgsl", waiting()), &shaders("a"), true);
    section.record.judge(a, Verdict::new(State::Agree, "agrees within 0.5 %, 1.80x more efficient"));
    section.record.take(
        edit(Kind::Scene, "box.ron", Verdict::new(State::None, "scene: not judged")),
        &shaders("a"),
        false,
    );
    section.record.fail(
        edit(Kind::Shaders, "lib/b.wgsl", Verdict::new(State::Failed, "failed: lib/b.wgsl:1:1: no")),
        &shaders("a"),
    );
    let c = section.record.take(edit(Kind::Shaders, "lib/c.wgsl", waiting()), &shaders("c"), true);
    section.record.judge(c, Verdict::new(State::Judging, "judging: 24 films; no difference above 1.2 % yet"));
    section.draw(Vec::new());
    section.place("judging rests: 24 films; no difference above 1.2 % yet");
    let tops: Vec<f32> = ["c.wgsl", "b.wgsl, ", "box.ron"].map(|text| section.place(text).top()).to_vec();
    let steps: Vec<f32> = tops.windows(2).map(|pair| (pair[1] - pair[0]).round()).collect();
    assert!(steps.iter().all(|step| *step == steps[0] && *step > 30.0), "{tops:?}");

    assert_eq!(section.click("failed: lib/b.wgsl"), None, "there is nothing to go back to");
    assert_eq!(section.click("scene: not judged"), None);
    assert_eq!(section.click("judging rests"), None, "it runs");

    // Three rows are seen at once: the older ones of fewer.
    let mut section = Section::new();
    let a = section.record.take(edit(Kind::Shaders, "lib/a.wgsl", waiting()), &shaders("a"), true);
    section.record.judge(a, Verdict::new(State::Agree, "agrees within 0.5 %, 1.80x more efficient"));
    section.record.take(edit(Kind::Shaders, "lib/c.wgsl", waiting()), &shaders("c"), true);
    section.draw(Vec::new());
    assert_eq!(section.click("agrees within"), Some(EditsAction::GoBack(a)));
    assert_eq!(section.click("as the window opened"), Some(EditsAction::GoBack(0)));
    assert_eq!(section.click("judge edits while idle"), Some(EditsAction::Judge(false)));
}

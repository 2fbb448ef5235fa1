//! One frame of a session: takes up what changed, traces for a while, draws.

use std::time::{Duration, Instant};

use super::cameras;
use super::screen::physical_size;
use super::session::Session;
use super::tracing::Rest;
use crate::app::shared::failure::rendered;
use crate::engine::EngineError;

/// Sizes of the scene a second, at full speed.
const FLIGHT_SPEED: f64 = 0.3;

impl Session {
    /// One frame: takes up what changed, traces for a while, draws.
    pub fn frame(&mut self) -> Result<(), EngineError> {
        let now = Instant::now();
        if physical_size(&self.window).min_element() == 0 {
            return Ok(());
        }
        let elapsed = self.activity.begin_frame(now);
        if self.activity.starts() {
            // The first step compiles for a while: a window that says so comes before it.
            self.overlay.notice = Some("compiling shaders".to_owned());
            self.draw()?;
            self.overlay.notice = None;
            return Ok(());
        }
        self.fly(elapsed, now);
        self.follow_view(now);
        self.fit_film();
        self.show_judgement();
        self.attend_judging(now);
        let before = self.traced();
        let saves = self.engine.has_saves();
        if saves {
            self.touch(now);
            self.step_aside();
            self.keep_seen();
        }
        // What is saved between here and the step is left to the next frame, which first keeps what is seen.
        self.engine.hold_saves(!saves);
        // Judging has the device to itself.
        if self.activity.working && !self.judgement.has_device() {
            self.step()?;
        }
        self.follow_errors()?;
        self.outdate_paths();
        self.trace_paths()?;
        if self.saving && self.tracing.is_whole() {
            self.saving = false;
            self.save()?;
        }
        let pixel = self.looked_at();
        let read = self.panel.read(&mut self.engine, pixel, self.tracing.began, now);
        if !matches!(read, Ok(false)) {
            self.survive("looking at the film", read)?;
        }
        self.make_thumb(now);
        self.draw()?;
        let traced = Duration::from_secs_f64((self.traced() - before).max(0.0));
        self.tracing.learn_drawing(now.elapsed().saturating_sub(traced));
        Ok(())
    }

    /// Seconds of tracing so far. The time of compiling is not in it.
    fn traced(&mut self) -> f64 {
        self.engine.spent().trace
    }

    /// Flies on, or comes to rest.
    fn fly(&mut self, elapsed: Duration, now: Instant) {
        let wanted = self.controls.flight();
        if self.viewpoint.flies(wanted) {
            let speed = FLIGHT_SPEED * self.scene_size();
            self.viewpoint.fly(wanted, elapsed, speed);
            self.touch(now);
            self.step_aside();
            self.tracing.pace.moved(now);
        }
    }

    /// Moves the engine's camera after the view.
    fn follow_view(&mut self, now: Instant) {
        if !self.viewpoint.moved {
            return;
        }
        let view = self.viewpoint.camera;
        if self.engine.edit(|world| cameras::set_view(world, view)) {
            self.film_restarts(now);
        }
        self.viewpoint.moved = false;
    }

    /// Runs the schedule once.
    fn step(&mut self) -> Result<(), EngineError> {
        let begin = Instant::now();
        let stepped = self.engine.step(self.tracing.budget(self.gpu.is_software(), begin));
        self.follow_saves();
        let Some(progress) = self.survive("tracing", stepped)? else {
            // Until something changes, it would fail again.
            self.activity.working = false;
            return Ok(());
        };
        self.follow_textures();
        self.tracing.learn(progress, begin);
        if !progress.finished {
            // A film that starts anew does not rest.
            self.tracing.rest = None;
        }
        self.activity.working = !progress.finished;
        self.look_at_error()
    }

    /// Lets a film that goes on for as long as it is let rest, once more samples would not be seen.
    fn look_at_error(&mut self) -> Result<(), EngineError> {
        if !self.engine.is_endless() || !self.tracing.wants_look() {
            return Ok(());
        }
        let error = self.engine.picture_error();
        if let Some(error) = self.survive("looking at the film", error)?
            && self.tracing.learn_error(error)
        {
            self.rest(Some(Rest::Fine));
        }
        Ok(())
    }

    /// Lets the film rest, or go on.
    pub(super) fn rest(&mut self, rest: Option<Rest>) {
        self.tracing.rest = rest;
        self.engine.rest(rest.is_some());
        self.activity.working = true;
        self.titled = None;
    }

    /// The picture may be shown otherwise from now on: what was fine enough may no longer be.
    pub(super) fn wake_film(&mut self) {
        self.tracing.look_anew();
        if self.tracing.rest == Some(Rest::Fine) {
            self.rest(None);
        }
        self.activity.working = true;
    }

    /// Goes on after an error, unless the device is lost: what failed stands over the picture until the same succeeds.
    pub(super) fn survive<T>(
        &mut self,
        what: &'static str,
        result: Result<T, EngineError>,
    ) -> Result<Option<T>, EngineError> {
        let done = self.failures.survive(what, result)?;
        self.list_problems();
        Ok(done)
    }

    /// Gathers all that is to stand over the picture.
    fn list_problems(&mut self) {
        let standing = self.engine.problems();
        let texts = standing.iter().map(|problem| rendered(&*problem.diagnostic, false));
        self.overlay.problems = self.failures.texts().cloned().chain(texts).collect();
    }
}

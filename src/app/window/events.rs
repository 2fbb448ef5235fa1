//! The session's events: first the user interface has them, then the controls; and when the next frame is due.

use std::time::Instant;

use winit::event::WindowEvent;

use super::controls::Intent;
use super::pace;
use super::screen::physical_size;
use super::session::Session;
use crate::engine::EngineError;
use crate::layout::view::ViewMode;

impl Session {
    /// Takes an event of the window: first the user interface, then the controls.
    pub fn event(&mut self, event: &WindowEvent) -> Result<(), EngineError> {
        match event {
            WindowEvent::CursorMoved { .. }
            | WindowEvent::MouseInput { .. }
            | WindowEvent::MouseWheel { .. }
            | WindowEvent::KeyboardInput { .. }
            | WindowEvent::Touch(_) => self.touch(Instant::now()),
            WindowEvent::Resized(_) => {
                self.screen.resize()?;
                let now = Instant::now();
                self.tracing.pace.moved(now);
                self.activity.redraw = true;
            }
            WindowEvent::Occluded(hidden) => {
                self.activity.hidden = *hidden;
                self.activity.redraw = true;
            }
            _ => {}
        }
        let response = self.screen.event(event);
        let visible = self.shows_ui();
        if visible {
            self.activity.redraw |= response.repaint;
        } else {
            self.screen.forget_events();
        }
        let height = f64::from(physical_size(&self.window).y);
        // The user interface knows the pointer from its last run: what is on the panel since then is the panel's too.
        if visible && (response.consumed || self.is_for_panel(event)) {
            self.controls.let_go(event);
            if self.controls.wants_save(event) {
                self.act(Intent::SaveEdits)?;
            }
        } else if let Some(intent) = self.controls.event(event, height, self.window.scale_factor()) {
            self.act(intent)?;
        }
        Ok(())
    }

    fn shows_ui(&self) -> bool {
        let legend = self.engine.view() != ViewMode::Beauty;
        self.panel.open
            || legend
            || self.selected.is_some()
            || self.paths.is_shown()
            || !self.overlay.is_empty()
            || self.judgement.is_shown()
    }

    /// When the next frame is due; none while nothing changes.
    pub fn next_frame(&mut self, now: Instant) -> Option<Instant> {
        self.activity.redraw |= self.overlay.expire(now);
        self.activity.expire(now);
        if self.activity.hidden || physical_size(&self.window).min_element() == 0 {
            return None;
        }
        // Judging has the device to itself, and wakes the window when it has found something.
        let works = self.activity.working && !self.judgement.has_device();
        let moves = self.viewpoint.moved || self.viewpoint.flies(self.controls.flight());
        if works || self.activity.redraw || moves {
            return Some(self.activity.last_frame + pace::FRAME);
        }
        let pixel = self.looked_at();
        let reading = self.panel.next_reading(&mut self.engine, pixel, self.tracing.began);
        let judging = self.judging_due();
        [self.overlay.expires_at(), self.activity.ui_again, reading, judging].into_iter().flatten().min()
    }
}

//! Finding out where the film's error comes from, a moment in each frame.

use std::time::{Duration, Instant};

use super::panel::errors::{ErrorsAction, Over};
use super::session::Session;
use crate::app::shared::sources::{hint, lines};
use crate::engine::{EngineError, Surveyed};

/// Paths that are traced between two looks at the clock: on a processor, and on a graphics card.
const MOST_PATHS: [u64; 2] = [1 << 13, 1 << 16];

/// Time for it in a frame.
const STEP: Duration = Duration::from_millis(12);

impl Session {
    /// Goes on with what was asked for, for a moment.
    pub(super) fn follow_errors(&mut self) -> Result<(), EngineError> {
        if self.errors.began.is_some_and(|began| began != self.tracing.began) {
            self.errors.forget();
            self.draw_again();
        }
        if !self.judgement.has_device() {
            let went_on = self.go_on_surveying();
            self.survive("looking at the error", went_on)?;
            let read = self.read_robust();
            self.survive("looking at the robust means", read)?;
        }
        Ok(())
    }

    fn go_on_surveying(&mut self) -> Result<(), EngineError> {
        let Some(mut survey) = self.errors.survey.take() else { return Ok(()) };
        let begin = Instant::now();
        let mut state = Surveyed::More;
        while state == Surveyed::More && begin.elapsed() < STEP {
            state = self.engine.survey(&mut survey)?;
        }
        self.draw_again();
        self.activity.working = true;
        match state {
            Surveyed::More => self.errors.survey = Some(survey),
            Surveyed::Stale => self.errors.forget(),
            Surveyed::Done => {
                let found = self.engine.sources(&survey);
                let render = self.engine.settings().map(|(_, render)| render).unwrap_or_default();
                self.errors.lines = lines(&found);
                self.errors.lines.extend(hint(&found, &render).map(|hint| format!("what helps: {hint}")));
                (self.errors.map, self.errors.drawn) = (Some(survey.map()), None);
            }
        }
        Ok(())
    }

    /// Reads the robust means where they are shown, whenever the film's samples have doubled.
    fn read_robust(&mut self) -> Result<(), EngineError> {
        let spp = self.tracing.progress.map_or(0, |progress| progress.spp);
        if self.errors.over != Over::Robust || spp < 2 * self.errors.robust_of.max(1) {
            return Ok(());
        }
        if let Some(robust) = self.engine.robust_film()? {
            self.errors.began = Some(self.tracing.began);
            self.errors.robust = Some((self.engine.window_size(), self.engine.as_shown(&robust.rgb)));
            (self.errors.robust_of, self.errors.drawn) = (spp, None);
            self.draw_again();
        }
        Ok(())
    }

    /// Does what was wanted in the panel.
    pub(super) fn follow_errors_action(&mut self, action: ErrorsAction) -> Result<(), EngineError> {
        match action {
            ErrorsAction::Begin => {
                let begun = self.engine.begin_survey(MOST_PATHS[usize::from(!self.gpu.is_software())]);
                if let Some(survey) = self.survive("looking at the error", begun)?.flatten() {
                    self.errors.forget();
                    (self.errors.survey, self.errors.began) = (Some(survey), Some(self.tracing.began));
                }
            }
            ErrorsAction::Over(over) => {
                (self.errors.over, self.errors.drawn) = (over, None);
                // Its blocks are summed from the film's first sample on.
                self.engine.set_robust(over == Over::Robust);
            }
        }
        self.resume();
        self.draw_again();
        Ok(())
    }
}

//! What an engine has made, read back: the film, and what is shown of it.

use super::film::{self, FilmImage, FilmPart};
use super::{Engine, EngineError, FilmError, RobustFilm};
use crate::cpu::display::shown;
use crate::passes::film::Look;
use crate::systems::resources::Displayed;

impl Engine {
    /// Reads the film back, with its picture.
    pub fn film(&mut self) -> Result<FilmImage, EngineError> {
        film::read_film(&mut self.world)
    }

    /// Reads back what pictures and reports need of the film.
    pub fn film_part(&mut self) -> Result<FilmPart, EngineError> {
        film::read_part(&mut self.world)
    }

    /// The film's estimated relMSE, of which nothing else is read; 0 where no pixel has two samples.
    pub fn film_error(&self) -> Result<FilmError, EngineError> {
        film::read_error(&self.world)
    }

    /// The film's robust means beside its plain ones; none unless its samples are summed in blocks, or before there are any.
    pub fn robust_film(&self) -> Result<Option<RobustFilm>, EngineError> {
        film::read_robust(&self.world)
    }

    /// Reads back what is shown of the film's window, sRGB, row by row from the top; none before anything is.
    pub fn picture(&self) -> Result<Option<Vec<[u8; 4]>>, EngineError> {
        film::read_picture(&self.world)
    }

    /// Linear light as the picture of the film shows it now.
    pub fn as_shown(&self, linear: &[[f32; 3]]) -> Vec<[u8; 4]> {
        let Look { exposure, tone } = self.world.resource::<Displayed>().0;
        linear.iter().map(|rgb| shown(*rgb, exposure, tone)).collect()
    }

    /// Reads the mean radiance of the film's window back, row by row from the top: sooner done than the whole film.
    pub fn radiance(&mut self) -> Result<Vec<[f32; 3]>, EngineError> {
        film::read_radiance(&self.world)
    }
}

//! Random edits, for as long as there is time: the law of edits, and that nothing stays behind of what is taken back.

use std::sync::Arc;
use std::time::{Duration, Instant};

use glam::{DAffine3, UVec2};

use crate::components::{Reading, Render, Texture};
use crate::engine::Engine;
use crate::gpu::Code;
use crate::layout::film::FilmPixel;
use crate::process::resident;
use crate::scene::{MapUse, SceneDescription, TextureMap, texture_name};
use crate::shader::Library;
use crate::stress::lab::{Lab, finish};
use crate::stress::measured::{Measured, Scale, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::described::{Inside, room};
use crate::stress::tools::edits::{Dice, edit, picture};
use crate::stress::tools::plant::plant;

pub static ROW: Row = Row {
    name: "random-edits",
    holds: "after random edits a film is a fresh engine's, to the bit; made again and again they leave no memory taken",
    quantity: "films that differ or are bad, and memory that grew",
    most: 0.0,
    unit: "edits",
    sizes: [24, 48, 1_000],
    measure,
};

/// Edits of a round, and after how many of them a film is compared.
const EDITS: u32 = 12;
const CHECK: u32 = 3;

/// How often a round's edits are made at most, until no buffer has grown.
const PASSES: u32 = 4;

/// Bytes by which the process may have grown while edits were made again, over all seeds: allocators keep some of what was freed, and a driver the code
/// that a device ran.
const MOST_GROWTH: i64 = 64 << 20;

/// A room with a texture, in small.
fn first_scene() -> SceneDescription {
    let mut scene = room(UVec2::new(20, 16), Inside::Rough, DAffine3::IDENTITY);
    scene.render = Render { spp: 2, max_depth: 4, ..scene.render };
    let map = TextureMap::new("checks");
    let image = Arc::new(picture(UVec2::splat(8), &mut Dice::new(0)));
    scene.textures.insert(texture_name(&map, MapUse::Colour), Texture::new(image, Reading::Colour));
    scene.materials.get_mut("wall 0").expect("invariant: the room has a wall 0").maps.kd = Some(map);
    scene
}

/// Libraries that are edits of each other: as it is, with a comment, and with dimmer lights.
fn libraries(shipped: &Library) -> Result<Vec<Library>, StressError> {
    let (module, right) = ("lib/light", "return select(material.emission,");
    let dimmer = plant(shipped.clone(), module, right, "return select(0.5 * material.emission,")?;
    let commented = plant(shipped.clone(), module, right, "// Nothing.\n    return select(material.emission,")?;
    Ok(vec![shipped.clone(), commented, dimmer])
}

/// An engine that is edited, and what was done to it.
struct Edited<'a> {
    lab: &'a Lab,
    engine: Engine,
    first: &'a SceneDescription,
    libraries: &'a [Library],
    /// Which of them runs, and the code of those that ran before.
    library: usize,
    kept: Vec<Option<Code>>,
    log: Vec<String>,
}

impl<'a> Edited<'a> {
    fn open(lab: &'a Lab, first: &'a SceneDescription, libraries: &'a [Library]) -> Result<Self, StressError> {
        let kept = libraries.iter().map(|_| None).collect();
        Ok(Self { lab, engine: lab.engine(first)?, first, libraries, library: 0, kept, log: Vec::new() })
    }

    /// Runs another library's code.
    fn run(&mut self, library: usize) -> Result<(), StressError> {
        if library != self.library {
            let code = match self.kept[library].take() {
                Some(code) => code,
                None => self.engine.remake(self.libraries[library].clone())?,
            };
            self.kept[self.library] = Some(self.engine.run(code));
            self.library = library;
        }
        Ok(())
    }

    /// One edit: of the scene, or one in twelve of a shader's text. Half of them meet a film that is under way or finished, half come one upon another.
    fn edit(&mut self, dice: &mut Dice) -> Result<(), StressError> {
        if dice.roll(12) == 0 {
            let library = dice.roll(self.libraries.len() as u64) as usize;
            self.run(library)?;
            self.log.push(format!("Shader: {}", ["as it is", "a comment", "dimmer lights"][library]));
        } else {
            let (first, unseen) = (self.first, self.lab.unseen());
            self.log.push(self.engine.edit(|world| edit(world, dice, first, unseen)));
        }
        if dice.roll(2) == 0 {
            self.engine.step(Duration::from_millis(1))?;
        }
        Ok(())
    }

    /// The film with all its samples, none of them bad.
    fn film(&mut self) -> Result<Vec<FilmPixel>, StressError> {
        Ok(finish(&mut self.engine)?.pixels)
    }

    /// The film of the scene as it is now, opened fresh.
    fn fresh(&self) -> Result<Vec<FilmPixel>, StressError> {
        let library = self.libraries[self.library].clone();
        let scene = self.engine.describe(&self.first.name);
        Ok(finish(&mut Engine::open(self.lab.gpu().clone(), library, &scene)?)?.pixels)
    }

    /// All edits of a seed. `films` are those of its check points: compared with a fresh engine's and kept the first time, and found again later.
    fn make_edits(&mut self, seed: u64, films: &mut Vec<Vec<FilmPixel>>) -> Result<(), StressError> {
        let (mut dice, again) = (Dice::new(seed), !films.is_empty());
        self.log.clear();
        for number in 1..=EDITS {
            self.edit(&mut dice)?;
            if number % CHECK != 0 {
                continue;
            }
            let film = self.film()?;
            if again {
                check_same(&film, &films[(number / CHECK - 1) as usize], "from the first time")?;
            } else {
                check_same(&film, &self.fresh()?, "from a fresh engine's")?;
                films.push(film);
            }
        }
        Ok(())
    }

    /// Back to the first scene and its code, whose film is to be this one. Returns how many bytes the device then holds.
    fn return_to_first(&mut self, before: &[FilmPixel]) -> Result<u64, StressError> {
        self.run(0)?;
        self.engine.apply(self.first);
        check_same(&self.film()?, before, "once the first scene is back")?;
        Ok(self.engine.report()?.memory.held.now)
    }

    /// All edits of a seed, until the device holds no more memory than the time before.
    fn repeat_edits(&mut self, seed: u64) -> Result<Made, StressError> {
        let (before, mut films, mut held) = (self.film()?, Vec::new(), Vec::new());
        let mut process = None;
        for pass in 1..=PASSES {
            self.make_edits(seed, &mut films)?;
            let bytes = self.return_to_first(&before)?;
            if held.last() == Some(&bytes) {
                let grown = resident().zip(process).map(|(now, then)| now.cast_signed() - then);
                return Ok(Made { passes: pass, grown });
            }
            held.push(bytes);
            // By now all is compiled that these edits need.
            process = process.or_else(|| resident().map(u64::cast_signed));
        }
        Err(StressError::Broken(format!("the device holds {held:?} bytes, time after time, in the first scene")))
    }
}

/// How often the edits of a seed were made, and by how many bytes the process grew from the end of the first time on; none where the system does not
/// tell.
struct Made {
    passes: u32,
    grown: Option<i64>,
}

/// Fails where two films differ.
fn check_same(film: &[FilmPixel], right: &[FilmPixel], how: &str) -> Result<(), StressError> {
    let differ = film.iter().zip(right).filter(|(a, b)| a != b).count() + film.len().abs_diff(right.len());
    match differ {
        0 => Ok(()),
        _ => Err(StressError::Broken(format!("{differ} of {} pixels differ {how}", film.len()))),
    }
}

/// What came of a seed, or what is wrong and what led to it.
fn try_seed(
    lab: &Lab,
    seed: u64,
    first: &SceneDescription,
    libraries: &[Library],
) -> Result<Result<Made, String>, StressError> {
    let mut edited = Edited::open(lab, first, libraries)?;
    match edited.repeat_edits(seed) {
        Ok(made) => Ok(Ok(made)),
        Err(error) if error.is_of_machine() => Err(error),
        Err(error) => {
            let log = &edited.log;
            Ok(Err(format!("--seed {seed}: {error}, after {} edits: {}", log.len(), log.join("; "))))
        }
    }
}

/// For how long edits are made where nobody says; one seed's at least.
fn seconds_of(scale: Scale) -> f64 {
    match scale {
        Scale::Test => 0.0,
        Scale::Quick => 20.0,
        Scale::Full => 600.0,
    }
}

fn measure(lab: &Lab, _: u64) -> Result<Measured, StressError> {
    let seconds = lab.seconds().unwrap_or_else(|| seconds_of(lab.scale()));
    let (first, libraries) = (first_scene(), libraries(lab.library())?);
    let begin = Instant::now();
    let (mut edits, mut seeds, mut grown) = (0, 0, Some(0));
    let mut first_seed = None;
    loop {
        match try_seed(lab, lab.seed().wrapping_add(seeds), &first, &libraries)? {
            Ok(made) => {
                edits += u64::from(made.passes * EDITS);
                grown = grown.zip(made.grown).map(|(before, more)| before + more);
            }
            Err(fault) => return Ok(Measured::new(1.0, edits).noted(fault)),
        }
        seeds += 1;
        first_seed = first_seed.or_else(resident);
        let spent = begin.elapsed().as_secs_f64();
        lab.tell((1e3 * spent.min(seconds)) as u64, (1e3 * seconds) as u64);
        if spent >= seconds {
            break;
        }
    }
    let told = grown.map_or(String::new(), |bytes| {
        format!(", made again they took {:.1} MiB of the process", bytes as f64 / f64::from(1 << 20))
    });
    let since = first_seed.filter(|_| seeds > 1).zip(resident()).map_or(String::new(), |(then, now)| {
        let more = (now.cast_signed() - then.cast_signed()) as f64 / f64::from(1 << 20);
        format!(", and all after the first {more:.1} MiB")
    });
    let note = format!("{} films of {seeds} seeds from --seed {}{told}{since}", edits / u64::from(CHECK), lab.seed());
    let value = f64::from(u8::from(grown.is_some_and(|bytes| bytes > MOST_GROWTH)));
    Ok(Measured::new(value, edits).noted(note))
}

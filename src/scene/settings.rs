//! The one table of settings of film and render: what scene files, the command line, reports and the window's panel call
//! them, and their ranges. Defaults are those of [`Film`] and [`Render`].
//!
//! A new setting is a row here and a field of its component.

use glam::UVec2;

use crate::components::{
    Adaptive, Crop, DiffuseMap, Energy, Film, Integrator, Render, Reuse, Sampler, TextureFilter, Tone,
};

/// Everything that the table is about.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    pub film: Film,
    pub render: Render,
}

/// One setting.
#[derive(Debug)]
pub struct Setting {
    /// Its field in a scene file, and its name in reports.
    pub field: &'static str,
    pub group: Group,
    pub value: Value,
    pub flag: Option<Flag>,
    pub panel: Option<Panel>,
}

/// The part of a scene file that a setting is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    Film,
    Render,
}

/// A flag of the command line.
#[derive(Clone, Copy, Debug)]
pub struct Flag {
    pub name: &'static str,
    /// What stands for its value in help texts.
    pub value: &'static str,
    pub help: &'static str,
}

/// A line of the window's panel.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// Counted from the top.
    pub line: u8,
    pub label: &'static str,
}

/// Where the settings have a value: to read it, and to write it.
pub type Place<T> = fn(&mut Settings) -> &mut T;

/// What values a setting has, and their place.
#[derive(Debug)]
pub enum Value {
    /// A whole number.
    Whole {
        least: u32,
        most: u32,
        at: Place<u32>,
    },
    /// Stops, either way; a slider reaches so many.
    Stops {
        most: f32,
        slider: f32,
        at: Place<f32>,
    },
    Switch(Place<bool>),
    Choice(Place<dyn Choice>),
    /// Pixels, each side from 1 to [`Film::MAX_SIDE`].
    Size(Place<UVec2>),
    /// A part of the size.
    Crop(Place<Option<Crop>>),
}

/// All settings, in the order of help texts.
pub static SETTINGS: &[Setting] = &[
    Setting {
        field: "spp",
        group: Group::Render,
        value: Value::Whole { least: 1, most: u32::MAX, at: |s| &mut s.render.spp },
        flag: Some(Flag { name: "spp", value: "N", help: "Samples a pixel" }),
        panel: Some(Panel { line: 2, label: "samples" }),
    },
    Setting {
        field: "size",
        group: Group::Film,
        value: Value::Size(|s| &mut s.film.size),
        flag: Some(Flag {
            name: "size",
            value: "WxH",
            help: "Size of the whole picture in pixels, each side 1 to 16384",
        }),
        panel: None,
    },
    Setting {
        field: "crop",
        group: Group::Film,
        value: Value::Crop(|s| &mut s.film.crop),
        flag: Some(Flag {
            name: "crop",
            value: "X0,X1,Y0,Y1",
            help: "Render this part only: pixels from X0 up to but not X1, from Y0 up to but not Y1, from the top left",
        }),
        panel: None,
    },
    Setting {
        field: "seed",
        group: Group::Render,
        value: Value::Whole { least: 0, most: u32::MAX, at: |s| &mut s.render.seed },
        flag: Some(Flag { name: "seed", value: "N", help: "Seed of all random numbers" }),
        panel: Some(Panel { line: 10, label: "seed" }),
    },
    Setting {
        field: "integrator",
        group: Group::Render,
        value: Value::Choice(|s| &mut s.render.integrator),
        flag: Some(Flag { name: "integrator", value: "INTEGRATOR", help: "How light is estimated" }),
        panel: Some(Panel { line: 3, label: "integrator" }),
    },
    Setting {
        field: "sampler",
        group: Group::Render,
        value: Value::Choice(|s| &mut s.render.sampler),
        flag: Some(Flag { name: "sampler", value: "SAMPLER", help: "Where the random numbers of a sample come from" }),
        panel: Some(Panel { line: 4, label: "sampler" }),
    },
    Setting {
        field: "max_depth",
        group: Group::Render,
        value: Value::Whole { least: 1, most: Render::MAX_DEPTH, at: |s| &mut s.render.max_depth },
        flag: Some(Flag {
            name: "max-depth",
            value: "N",
            help: "Segments of the longest path: 1 sees emitters only, up to 1024",
        }),
        panel: Some(Panel { line: 5, label: "longest path" }),
    },
    Setting {
        field: "roulette",
        group: Group::Render,
        value: Value::Switch(|s| &mut s.render.roulette),
        flag: Some(Flag {
            name: "roulette",
            value: "ROULETTE",
            help: "End paths of little throughput early (unbiased)",
        }),
        panel: Some(Panel { line: 6, label: "roulette" }),
    },
    Setting {
        field: "reuse",
        group: Group::Render,
        value: Value::Choice(|s| &mut s.render.reuse),
        flag: Some(Flag {
            name: "reuse",
            value: "REUSE",
            help: "Whether pixels use each other's paths (integrator path)",
        }),
        panel: Some(Panel { line: 7, label: "reuse of paths" }),
    },
    Setting {
        field: "adaptive",
        group: Group::Render,
        value: Value::Choice(|s| &mut s.render.adaptive),
        flag: Some(Flag {
            name: "adaptive",
            value: "ADAPTIVE",
            help: "Whether noisy parts of the picture get more samples, and quiet ones fewer",
        }),
        panel: Some(Panel { line: 8, label: "adaptive" }),
    },
    Setting {
        field: "energy",
        group: Group::Render,
        value: Value::Choice(|s| &mut s.render.energy),
        flag: None,
        panel: Some(Panel { line: 9, label: "energy" }),
    },
    Setting {
        field: "texture_filter",
        group: Group::Render,
        value: Value::Choice(|s| &mut s.render.texture_filter),
        flag: Some(Flag { name: "texture-filter", value: "FILTER", help: "How much of a texture a lookup takes in" }),
        panel: Some(Panel { line: 11, label: "texture filter" }),
    },
    Setting {
        field: "texture",
        group: Group::Render,
        value: Value::Choice(|s| &mut s.render.diffuse_map),
        flag: None,
        panel: Some(Panel { line: 12, label: "map_Kd" }),
    },
    Setting {
        field: "texture_size",
        group: Group::Render,
        value: Value::Whole { least: 1, most: Render::MAX_TEXTURE, at: |s| &mut s.render.texture_size },
        flag: Some(Flag {
            name: "texture-size",
            value: "N",
            help: "Texels a side of a texture: larger ones are halved until they fit",
        }),
        panel: None,
    },
    Setting {
        field: "exposure",
        group: Group::Film,
        value: Value::Stops { most: MOST_STOPS, slider: 8.0, at: |s| &mut s.film.exposure },
        flag: Some(Flag { name: "exposure", value: "STOPS", help: "Brighten by so many stops, -64 to 64" }),
        panel: Some(Panel { line: 0, label: "exposure" }),
    },
    Setting {
        field: "tone",
        group: Group::Film,
        value: Value::Choice(|s| &mut s.film.tone),
        flag: Some(Flag { name: "tone", value: "CURVE", help: "How what is brighter than white is shown" }),
        panel: Some(Panel { line: 1, label: "tone" }),
    },
];

/// The greatest exposure, and the least.
pub const MOST_STOPS: f32 = 64.0;

/// One value of a setting that is one of a few.
#[derive(Clone, Copy, Debug)]
pub struct Word<T> {
    pub value: T,
    /// In scene files.
    pub variant: &'static str,
    /// In flags and in the panel.
    pub name: &'static str,
    pub help: &'static str,
}

/// Values that have names.
pub trait Named: Copy + PartialEq + 'static {
    /// All of them.
    const WORDS: &'static [Word<Self>];

    /// What flags and the panel call it.
    fn name(self) -> &'static str {
        Self::WORDS.iter().find(|word| word.value == self).map_or("", |word| word.name)
    }

    /// What scene files call it.
    fn variant(self) -> &'static str {
        Self::WORDS.iter().find(|word| word.value == self).map_or("", |word| word.variant)
    }

    /// The value of a name.
    fn named(name: &str) -> Option<Self> {
        Self::WORDS.iter().find(|word| word.name == name).map(|word| word.value)
    }
}

impl Named for Integrator {
    const WORDS: &'static [Word<Self>] = &[
        Word {
            value: Self::Path,
            variant: "Path",
            name: "path",
            help: "Lights are asked directly too, and both ways are weighted together",
        },
        Word {
            value: Self::Bsdf,
            variant: "Bsdf",
            name: "bsdf",
            help: "Directions from the BSDF alone; light is found by hitting it, where it can be hit",
        },
    ];
}

impl Named for Tone {
    const WORDS: &'static [Word<Self>] = &[
        Word { value: Self::None, variant: "None", name: "none", help: "White, channel by channel" },
        Word {
            value: Self::Agx,
            variant: "Agx",
            name: "agx",
            help: "AgX: 16.5 stops, in which bright colours fade to white as on film",
        },
        Word {
            value: Self::Neutral,
            variant: "Neutral",
            name: "neutral",
            help: "Khronos PBR Neutral: colours keep what they are up to 0.8, and only what is brighter is compressed",
        },
    ];
}

impl Named for Sampler {
    const WORDS: &'static [Word<Self>] = &[
        Word {
            value: Self::Sobol,
            variant: "Sobol",
            name: "sobol",
            help: "Evenly spread points: a scrambled (0, 4)-sequence",
        },
        Word { value: Self::Pcg, variant: "Pcg", name: "pcg", help: "Independent numbers" },
    ];
}

impl Named for Reuse {
    const WORDS: &'static [Word<Self>] = &[
        Word { value: Self::Off, variant: "Off", name: "off", help: "Each pixel has paths of its own" },
        Word {
            value: Self::Tiles,
            variant: "Tiles",
            name: "tiles",
            help: "16 pixels gather what each other's paths find behind their first bounce",
        },
    ];
}

impl Named for Adaptive {
    const WORDS: &'static [Word<Self>] = &[
        Word { value: Self::Off, variant: "Off", name: "off", help: "Every pixel gets as many samples" },
        Word {
            value: Self::On,
            variant: "On",
            name: "on",
            help: "Tiles of 8x8 pixels get samples by their noise: as many on average",
        },
    ];
}

impl Named for Energy {
    const WORDS: &'static [Word<Self>] = &[
        Word {
            value: Self::Preserve,
            variant: "Preserve",
            name: "preserve",
            help: "Kd and Ks are divided by max(1, the largest channel of Kd + Ks)",
        },
        Word {
            value: Self::AsWritten,
            variant: "AsWritten",
            name: "as written",
            help: "Kd and Ks as the file has them",
        },
    ];
}

impl Named for TextureFilter {
    const WORDS: &'static [Word<Self>] = &[
        Word {
            value: Self::Footprint,
            variant: "Footprint",
            name: "footprint",
            help: "What the path's cone covers of it",
        },
        Word { value: Self::Exact, variant: "Exact", name: "exact", help: "A point: noisier, and without any blur" },
    ];
}

impl Named for DiffuseMap {
    const WORDS: &'static [Word<Self>] = &[
        Word { value: Self::Multiply, variant: "Multiply", name: "multiply", help: "map_Kd multiplies Kd" },
        Word { value: Self::Replace, variant: "Replace", name: "replace", help: "map_Kd takes the place of Kd" },
    ];
}

/// A value that is one of a few, whatever its type: what readers, flags and the panel need of it.
pub trait Choice {
    /// All of them: in scene files, by name, and in words.
    fn words(&self) -> Vec<Word<usize>>;
    /// Which of them it is.
    fn index(&self) -> usize;
    fn choose(&mut self, index: usize);
}

impl<T: Named> Choice for T {
    fn words(&self) -> Vec<Word<usize>> {
        let plain = |(value, word): (usize, &Word<T>)| {
            let Word { variant, name, help, .. } = *word;
            Word { value, variant, name, help }
        };
        T::WORDS.iter().enumerate().map(plain).collect()
    }

    fn index(&self) -> usize {
        T::WORDS.iter().position(|word| word.value == *self).unwrap_or(0)
    }

    fn choose(&mut self, index: usize) {
        *self = T::WORDS[index].value;
    }
}

impl Setting {
    /// The setting of a field.
    pub fn of_field(field: &str) -> Option<&'static Self> {
        SETTINGS.iter().find(|setting| setting.field == field)
    }

    /// Writes the value of some settings over that of others.
    pub fn copy(&self, from: &Settings, to: &mut Settings) {
        fn copy<T: Copy>(at: Place<T>, from: &mut Settings, to: &mut Settings) {
            *at(to) = *at(from);
        }
        let from = &mut { *from };
        match self.value {
            Value::Whole { at, .. } => copy(at, from, to),
            Value::Stops { at, .. } => copy(at, from, to),
            Value::Switch(at) => copy(at, from, to),
            Value::Choice(at) => at(to).choose(at(from).index()),
            Value::Size(at) => copy(at, from, to),
            Value::Crop(at) => copy(at, from, to),
        }
    }

    /// Whether some settings have the same value as others.
    pub fn is_same(&self, one: &Settings, other: &Settings) -> bool {
        let mut copied = *one;
        self.copy(other, &mut copied);
        copied == *one
    }

    /// The value as its flag has it; as a scene file has it, where it has no flag.
    pub fn text(&self, settings: &Settings) -> String {
        let settings = &mut { *settings };
        match self.value {
            Value::Whole { at, .. } => at(settings).to_string(),
            Value::Stops { at, .. } => at(settings).to_string(),
            Value::Switch(at) => if *at(settings) { "on" } else { "off" }.to_owned(),
            Value::Choice(at) => {
                let choice = at(settings);
                let word = choice.words()[choice.index()];
                if self.flag.is_some() { word.name } else { word.variant }.to_owned()
            }
            Value::Size(at) => {
                let size = *at(settings);
                format!("{}x{}", size.x, size.y)
            }
            Value::Crop(at) => at(settings)
                .map_or(String::new(), |Crop { min, max }| format!("{},{},{},{}", min.x, max.x, min.y, max.y)),
        }
    }
}

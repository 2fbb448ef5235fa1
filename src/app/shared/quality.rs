//! How good a picture is to be where nobody says how many samples it gets: an error that it is traced down to, and a time that is enough.

use clap::ValueEnum;

/// A picture's quality: a relMSE that it is at most to have, with 95 % confidence, and a limit of time for slow devices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Quality {
    /// To look at the light: relMSE 2e-2, or what 15 s give
    Draft,
    /// To show: relMSE 1e-3, or what 75 s give
    #[default]
    Good,
    /// To keep: relMSE 1e-4, or what 20 minutes give
    Fine,
}

impl Quality {
    /// The relMSE at which a picture is finished.
    pub fn error(self) -> f64 {
        match self {
            Self::Draft => 2e-2,
            Self::Good => 1e-3,
            Self::Fine => 1e-4,
        }
    }

    /// Seconds from the start of the process after which a picture is finished whatever its error.
    pub fn seconds(self) -> f64 {
        match self {
            Self::Draft => 15.0,
            Self::Good => 75.0,
            Self::Fine => 1200.0,
        }
    }

    /// What flags and reports call it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Draft => "draft",
            Self::Good => "good",
            Self::Fine => "fine",
        }
    }
}

//! The function on the CPU that does what a pass does.

/// What a pass's results are held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Twin {
    /// A function of `cpu`, by its path in there: `sort::agree`.
    Is(&'static str),
    /// There is none, for this reason.
    None(&'static str),
}

/// The [`Twin`] of a path in `cpu`, which must be a function.
macro_rules! twin {
    ($($part:ident)::+) => {{
        let _ = crate::cpu::$($part)::+;
        $crate::passes::Twin::Is(stringify!($($part)::+))
    }};
}
pub(super) use twin;

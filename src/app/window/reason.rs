//! Errors of the window library, in words for a user.

/// What a user needs to know of an error of the window library, which names places in its own source.
pub fn reason(error: &impl std::fmt::Display) -> String {
    let text = error.to_string();
    match text.strip_prefix("os error at ").and_then(|rest| rest.split_once(": ")) {
        Some((_, reason)) => reason.to_owned(),
        None => text,
    }
}

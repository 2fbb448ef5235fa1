//! What `lucerna check` holds scenes and families to beside their files: that there are the shaders that they name, with the parameters that
//! they set.

use crate::app::shared::parameters;
use crate::app::variants::code::Codes;
use crate::scene::{Asked, Diagnostic, Severity};

/// What is wrong with that, each once.
pub fn refused(asked: &[Asked]) -> Vec<Diagnostic> {
    let mut codes = Codes::new(None);
    let mut found: Vec<Diagnostic> = Vec::new();
    for asked in asked {
        let wrong = match codes.number_of(&asked.shaders) {
            Ok(number) => parameters::wrong(&asked.values, &asked.places, codes.library(number), &asked.place),
            Err(message) => vec![Diagnostic { severity: Severity::Error, message, ..asked.place.clone() }],
        };
        for error in wrong {
            if !found.contains(&error) {
                found.push(error);
            }
        }
    }
    found
}

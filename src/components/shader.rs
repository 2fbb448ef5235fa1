//! What shaders leave to a scene.

use std::collections::BTreeMap;

use bevy_ecs::prelude::*;

/// Values of the parameters that shaders declare (`override NAME: f32 = ..;`), by name. What is not in here has its default; a name
/// that no shader has, and a value that does not fit, count for nothing.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct ShaderValues(pub BTreeMap<String, ShaderValue>);

/// A value as it is written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ShaderValue {
    /// Finite.
    Number(f64),
    Switch(bool),
}

impl ShaderValue {
    /// As a number: a switch is 0 or 1.
    pub fn number(self) -> f64 {
        match self {
            Self::Number(number) => number,
            Self::Switch(on) => f64::from(u8::from(on)),
        }
    }
}

impl std::fmt::Display for ShaderValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => number.fmt(f),
            Self::Switch(on) => on.fmt(f),
        }
    }
}

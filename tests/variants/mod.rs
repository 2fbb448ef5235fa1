//! Families of scenes: their files, the command that renders them, and its answers.

mod race;

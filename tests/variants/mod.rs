//! Families of scenes: files, members, answers.

#[cfg(unix)]
mod browser;
mod hand;
#[cfg(unix)]
mod page;
mod sheet;
mod table;

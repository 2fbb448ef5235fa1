//! What is said of pictures and of measurements: how far two pictures are apart and where, whether their means differ, and which estimator
//! needs less time. Knows neither scenes nor where its numbers come from.

pub mod agreement;
mod alike;
pub mod blocks;
pub mod chi_square;
pub mod efficiency;
pub mod equal_means;
pub mod looks;
pub mod metrics;
pub mod race;
pub mod sign_flips;
pub mod summary;

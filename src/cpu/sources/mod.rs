//! Where a film's error comes from: what each way that light comes has of it.
//!
//! A pixel's radiance X is the sum of what comes by each way, c_k, so Var(X) is the sum over ways of Cov(c_k, X). Two independent estimates of the
//! same pixel, as the two halves of a film are, give (c_k - c_k') (X - X') / 2, which is that covariance in the mean. It may be negative: a way
//! that brings more where the others bring less takes from the error.

mod brought;
mod class;
mod share;
mod tally;

pub use brought::brought;
pub use class::{Class, Emitters, Light, Way};
pub use share::{Share, shares};
pub use tally::{Batch, GROUPS, Means, PixelShare, Tally};

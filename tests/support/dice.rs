//! Random numbers for simulated measurements.

/// A splitmix64 stream; the number is its seed.
pub struct Dice(pub u64);

impl Dice {
    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Of mean 0 and variance 1, by Box and Muller (1958).
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.unit()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.unit()).cos()
    }

    /// Of mean 1: a few values far above it, and most below.
    pub fn log_normal(&mut self, sigma: f64) -> f64 {
        (sigma * self.normal() - 0.5 * sigma * sigma).exp()
    }

    /// Of mean 1: now and then `height` more than else.
    pub fn firefly(&mut self, probability: f64, height: f64) -> f64 {
        1.0 + height * (f64::from(u8::from(self.unit() < probability)) - probability)
    }
}

//! Random numbers: xoshiro256++ (Blackman and Vigna: Scrambled Linear Pseudorandom Number Generators, 2021).

/// An independent stream for every key.
pub struct Random([u64; 4]);

impl Random {
    /// The key's words are mixed one after another by the finaliser of SplitMix (Steele, Lea, Flood 2014).
    pub fn new(key: [u64; 3]) -> Self {
        let mut word = key.into_iter().fold(0, |hash: u64, part| mix(hash ^ part));
        Self(std::array::from_fn(|_| {
            word = mix(word);
            word
        }))
    }

    /// The next number in [0, 1), a multiple of 2^-53.
    pub fn unit(&mut self) -> f64 {
        let s = &mut self.0;
        let word = s[0].wrapping_add(s[3]).rotate_left(23).wrapping_add(s[0]);
        let shifted = s[1] << 17;
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= shifted;
        s[3] = s[3].rotate_left(45);
        (word >> 11) as f64 * (-53f64).exp2()
    }
}

fn mix(word: u64) -> u64 {
    let z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

//! A race of several estimators: who is certain to be less efficient than another leaves it. Of losses, 1 / efficiency, round by round.
//!
//! **Who leaves.** Of every two, one bets in each round that the other's loss is the larger. The stake is a part of all that the bet is
//! worth, and depends on how far the two losses are apart and on the rounds before. If the two are equally good, they may be exchanged:
//! whatever the distance is, either sign is as likely. So the worth is a martingale that begins at 1, and ever reaches w with a
//! probability of at most 1 / w (Ville 1939). Who is bet against for more than (members - 1) / alpha leaves: the best one does with
//! a probability of at most alpha, however often one looks, and whatever the distribution, for a distance that towers above all others
//! has one sign. The same symmetry is what [`sign_flips`](super::sign_flips) rests on; e^x / cosh x, by which its bound is made, is
//! 1 + tanh x, and that is the bet.
//!
//! **What it can't know.** Light that a member finds seldom, and has not found yet, makes it look better than it is (`tests/variants/race.rs`).
//!
//! **The stakes.** The best part of the worth to stake depends on how much better one is. So several are played at once, each with an
//! equal share.

use super::efficiency::{Ratio, Trial};

/// Stakes of a distance as large as the mean one, before the hyperbolic tangent: from cautious to bold.
const STAKES: [f64; 4] = [0.25, 0.5, 1.0, 2.0];

/// Beyond that the hyperbolic tangent is 1.
const MOST: f64 = 20.0;

/// Rounds before anyone may leave: of fewer, no interval of the ratio can be told.
const LEAST_ROUNDS: u32 = 4;

/// What a member took in a round.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lap {
    /// Squared relative error of one film, the mean over the picture's blocks.
    pub error: f64,
    /// Of tracing it.
    pub seconds: f64,
}

impl Lap {
    /// 1 / efficiency.
    pub fn loss(&self) -> f64 {
        self.error * self.seconds
    }
}

/// Who left, and why.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lost {
    pub member: usize,
    /// Who is more efficient.
    pub by: usize,
    /// Rounds that both were in.
    pub rounds: u32,
    /// One less the probability that the best of all were to leave like this.
    pub confidence: f64,
    /// Efficiency of the better one by that of the one that left.
    pub ratio: Option<Ratio>,
}

/// The bets of one member that another is worse.
#[derive(Clone, Debug, Default)]
struct Bet {
    /// Logarithms of what each stake is worth.
    worth: [f64; STAKES.len()],
    rounds: u32,
    /// Of all distances.
    sum: f64,
}

impl Bet {
    /// `distance` is positive where the bet is won.
    fn play(&mut self, distance: f64) {
        if !distance.is_finite() {
            return;
        }
        self.rounds += 1;
        self.sum += distance.abs();
        let mean = self.sum / f64::from(self.rounds);
        if mean > 0.0 {
            for (worth, stake) in self.worth.iter_mut().zip(STAKES) {
                // ln (1 + tanh x) = ln 2 - ln (1 + e^-2x), which is a number whatever x is.
                let x = (stake * distance / mean).clamp(-MOST, MOST);
                *worth += std::f64::consts::LN_2 - (-2.0 * x).exp().ln_1p();
            }
        }
    }

    /// Of all stakes together.
    fn worth(&self) -> f64 {
        self.worth.iter().map(|log| log.exp()).sum::<f64>() / STAKES.len() as f64
    }
}

/// A race.
#[derive(Clone, Debug)]
pub struct Race {
    alpha: f64,
    /// By member: round by round, while it is in the race.
    laps: Vec<Vec<Lap>>,
    alive: Vec<bool>,
    /// `bets[a][b]`: that b is worse than a.
    bets: Vec<Vec<Bet>>,
}

impl Race {
    /// Of so many members; `alpha` is the probability that the best of them ever leaves.
    pub fn new(members: usize, alpha: f64) -> Self {
        Self {
            alpha,
            laps: vec![Vec::new(); members],
            alive: vec![true; members],
            bets: vec![vec![Bet::default(); members]; members],
        }
    }

    /// Who is still in the race.
    pub fn alive(&self) -> impl Iterator<Item = usize> {
        (0..self.alive.len()).filter(|member| self.alive[*member])
    }

    /// A member goes for another reason: it broke.
    pub fn remove(&mut self, member: usize) {
        self.alive[member] = false;
    }

    /// A round: what each member took that is still in the race. Returns who leaves after it.
    pub fn add(&mut self, laps: &[Option<Lap>]) -> Vec<Lost> {
        let ran = |member: usize| laps.get(member).copied().flatten().filter(|_| self.alive[member]);
        let ran: Vec<Option<Lap>> = (0..self.laps.len()).map(ran).collect();
        for (a, one) in ran.iter().enumerate() {
            let Some(one) = one else { continue };
            self.laps[a].push(*one);
            for (b, other) in ran.iter().enumerate().filter(|(b, _)| *b != a) {
                if let Some(other) = other {
                    self.bets[a][b].play(other.loss() - one.loss());
                }
            }
        }
        let lost: Vec<Lost> = self.alive().filter_map(|member| self.lost(member)).collect();
        lost.iter().for_each(|lost| self.alive[lost.member] = false);
        lost
    }

    /// Rounds that a member was in.
    pub fn rounds(&self, member: usize) -> u32 {
        self.laps[member].len() as u32
    }

    /// Mean lap of a member; `None` before the first.
    pub fn average(&self, member: usize) -> Option<Lap> {
        let laps = &self.laps[member];
        let mean = |of: fn(&Lap) -> f64| laps.iter().map(of).sum::<f64>() / laps.len() as f64;
        (!laps.is_empty()).then(|| Lap { error: mean(|lap| lap.error), seconds: mean(|lap| lap.seconds) })
    }

    /// Of those still in the race, the one that is most efficient by what is known so far.
    pub fn leader(&self) -> Option<usize> {
        let loss = |member: &usize| self.average(*member).map_or(f64::INFINITY, |lap| lap.error * lap.seconds);
        self.alive().min_by(|a, b| loss(a).total_cmp(&loss(b)))
    }

    /// Efficiency of a member by that of another, of the rounds that both were in.
    pub fn ratio(&self, member: usize, to: usize) -> Option<Ratio> {
        let trial =
            |(old, new): (&Lap, &Lap)| Trial { relmse: [old.error, new.error], seconds: [old.seconds, new.seconds] };
        Ratio::of(&self.laps[to].iter().zip(&self.laps[member]).map(trial).collect::<Vec<_>>())
    }

    /// Whether a member is certain to be worse than one that is in the race, or was until now.
    fn lost(&self, member: usize) -> Option<Lost> {
        let others = (self.laps.len() - 1) as f64;
        let worth = |by: &usize| self.bets[*by][member].worth();
        let by = self.alive().filter(|by| *by != member).max_by(|a, b| worth(a).total_cmp(&worth(b)))?;
        let (bet, worth) = (&self.bets[by][member], worth(&by));
        (bet.rounds >= LEAST_ROUNDS && worth >= others / self.alpha).then(|| Lost {
            member,
            by,
            rounds: bet.rounds,
            confidence: 1.0 - others / worth,
            ratio: self.ratio(by, member),
        })
    }
}

/// By what squared errors of pixels are to be multiplied so that every block of the picture counts alike: by the pixels' own weights,
/// and by 1 / the mean error of its block in some other films. A block has at least a hundredth of the picture's mean error.
pub fn even_weights(weights: &[[f32; 3]], errors: &[f64], block_of: impl Fn(usize) -> usize) -> Vec<[f32; 3]> {
    let least = 0.01 * errors.iter().sum::<f64>() / errors.len().max(1) as f64;
    let scale = |block: usize| match errors[block].max(least) {
        error if error > 0.0 => (1.0 / error) as f32,
        _ => 1.0,
    };
    weights.iter().enumerate().map(|(pixel, weight)| weight.map(|channel| channel * scale(block_of(pixel)))).collect()
}

//! Levels of a picture, each half the size of the one before.

use glam::UVec2;

/// A level of values of `C` channels, row by row from the top.
pub struct Level<const C: usize> {
    pub size: UVec2,
    pub values: Vec<[f32; C]>,
}

/// The size of the next level.
pub fn half(size: UVec2) -> UVec2 {
    (size / 2).max(UVec2::ONE)
}

impl<const C: usize> Level<C> {
    /// The next level of a picture of such a size: every texel is the mean over its part of the picture, also where that cuts texels, so that
    /// all levels have the picture's mean.
    pub fn halved(size: UVec2, fetch: &(impl Fn(u32, u32) -> [f32; C] + Sync)) -> Self {
        let to = half(size);
        let (columns, rows) = (shares(size.x, to.x), shares(size.y, to.y));
        let row = |y: u32| {
            let taps = &rows[y as usize];
            columns.iter().map(move |across| {
                let mut sum = [0.0; C];
                for (down, weight) in taps.iter() {
                    for (x, share) in across.iter() {
                        let value = fetch(x, down);
                        (0..C).for_each(|c| sum[c] += weight * share * value[c]);
                    }
                }
                sum
            })
        };
        Self { size: to, values: in_rows(to.y, row) }
    }

    /// The level itself, read from what it is made of.
    pub fn of(size: UVec2, fetch: &(impl Fn(u32, u32) -> [f32; C] + Sync)) -> Self {
        Self { size, values: in_rows(size.y, |y| (0..size.x).map(move |x| fetch(x, y))) }
    }

    pub fn at(&self, x: u32, y: u32) -> [f32; C] {
        self.values[y as usize * self.size.x as usize + x as usize]
    }

    /// The next level.
    pub fn next(&self) -> Self {
        Self::halved(self.size, &|x, y| self.at(x, y))
    }
}

/// What one texel of the next level takes of at most three of this one, along an axis: their first, and the part of each.
struct Shares {
    first: u32,
    parts: [f32; 3],
    count: u32,
}

impl Shares {
    fn iter(&self) -> impl Iterator<Item = (u32, f32)> {
        (0..self.count).map(|i| (self.first + i, self.parts[i as usize]))
    }
}

fn shares(from: u32, to: u32) -> Vec<Shares> {
    let of = |index: u32| {
        // In units of 1 / to: exact.
        let (begin, end) = (u64::from(index) * u64::from(from), u64::from(index + 1) * u64::from(from));
        let first = begin / u64::from(to);
        let last = (end - 1) / u64::from(to);
        let mut shares = Shares { first: first as u32, parts: [0.0; 3], count: (last - first + 1) as u32 };
        for texel in first..=last {
            let (low, high) = ((texel * u64::from(to)).max(begin), ((texel + 1) * u64::from(to)).min(end));
            shares.parts[(texel - first) as usize] = (high - low) as f32 / from as f32;
        }
        shares
    };
    (0..to).map(of).collect()
}

/// Rows of values, worked out by all processors.
fn in_rows<T: Send, R: Iterator<Item = T>>(height: u32, row: impl Fn(u32) -> R + Sync) -> Vec<T> {
    /// Rows of a small picture are not worth a thread.
    const LEAST: u32 = 64;
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get() as u32).min(height.div_ceil(LEAST)).max(1);
    let per_thread = height.div_ceil(threads);
    std::thread::scope(|scope| {
        let row = &row;
        let work = |i: u32| {
            scope.spawn(move || (i * per_thread..((i + 1) * per_thread).min(height)).flat_map(row).collect::<Vec<T>>())
        };
        let workers: Vec<_> = (0..threads).map(work).collect();
        let join = |worker: std::thread::ScopedJoinHandle<'_, Vec<T>>| {
            worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        workers.into_iter().map(join).reduce(|mut all, more| {
            all.extend(more);
            all
        })
    })
    .unwrap_or_default()
}

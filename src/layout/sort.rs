//! What the passes of the radix sort share.
//!
//! A sort of `n` pairs works in tiles of [`SORT_TILE`]; tile `t` holds the pairs from `t * SORT_TILE` on, the last may be
//! partial. Keys are 64 bits, as `vec2<u32>` (low word, high word) in WGSL and as u64 in little-endian memory.

gpu_consts! {
    /// Digits of a key.
    pub const SORT_DIGITS: u32 = 8;
    /// Bits of a digit.
    pub const SORT_BITS: u32 = 8;
    /// Values of a digit. As many as a workgroup has threads: thread `t` looks after bin `t`.
    pub const SORT_BINS: u32 = 256;
    /// Threads of every workgroup.
    pub const SORT_THREADS: u32 = 256;
    /// Pairs that each thread holds.
    pub const SORT_ITEMS: u32 = 16;
    /// Pairs of a tile.
    pub const SORT_TILE: u32 = SORT_THREADS * SORT_ITEMS;
    /// Threads that rank their keys by one mask. A mask and a count share a word, so 16.
    pub const SORT_LANES: u32 = 16;
    /// Counters that each thread of the scan holds.
    pub const SORT_SCAN_ITEMS: u32 = 8;
    /// Up to so many tiles, that many threads scan a bin's counters, else a workgroup. A divisor of `SORT_THREADS`.
    pub const SORT_FEW_TILES: u32 = 32;
    /// Most workgroups in one dimension that every device takes.
    pub const SORT_MOST_GROUPS: u32 = 65535;

    /// `SortPlan::result` of a result in `keys` and `payload`.
    pub const SORT_IN_FRONT: u32 = 0;
    /// `SortPlan::result` of a result in `keys_back` and `payload_back`.
    pub const SORT_IN_BACK: u32 = 1;
}

const _: () = {
    assert!(SORT_BINS == SORT_THREADS && SORT_BINS == 1 << SORT_BITS);
    // The masks and counts of the ranking lie in the words through which the tile is then reordered.
    assert!(SORT_THREADS / SORT_LANES * SORT_BINS == SORT_TILE);
    // The count beside a mask never reaches into it.
    assert!(SORT_LANES * SORT_ITEMS < 1 << 16);
};

gpu_struct! {
    /// Parameters of one dispatch of the sort.
    pub struct SortParams {
        /// Pairs.
        pub count: u32,
        /// Tiles that hold them.
        pub tiles: u32,
        /// Digit, 0 the least significant.
        pub digit: u32,
    }
}

gpu_struct! {
    /// How one digit is sorted.
    pub struct SortDigit {
        /// Workgroups of count and scatter along x: with the next two, the words of an indirect dispatch. 0 if skipped.
        pub tiles_x: u32,
        /// Along y: tiles are numbered `x + y * tiles_x`, and the last row may go beyond the last tile.
        pub tiles_y: u32,
        /// Along z, 1.
        pub tiles_z: u32,
        /// Which buffers are read, as `SortPlan::result`; the others are written.
        pub source: u32,
        /// Workgroups of scan along x, see [`scan_groups`]. 0 if skipped.
        pub bins_x: u32,
        /// Along y, 1.
        pub bins_y: u32,
        /// Along z, 1.
        pub bins_z: u32,
        /// 1 if all keys agree in this digit, so that nothing runs.
        pub skipped: u32,
    }
}

gpu_struct! {
    /// What the GPU decided about a sort.
    pub struct SortPlan {
        /// Which buffers hold the result: `SORT_IN_FRONT` or `SORT_IN_BACK`.
        pub result: u32,
        /// Digits that are not skipped.
        pub digits_run: u32,
        /// The digits, least significant first.
        pub digits: [SortDigit; 8],
    }
}

/// Tiles of a sort of `count` pairs.
pub const fn tiles(count: u32) -> u32 {
    count.div_ceil(SORT_TILE)
}

/// Workgroups that scan the counters of so many tiles.
pub const fn scan_groups(tiles: u32) -> u32 {
    if tiles <= SORT_FEW_TILES { SORT_BINS * SORT_FEW_TILES / SORT_THREADS } else { SORT_BINS }
}

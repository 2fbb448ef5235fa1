//! The radix sort against its twin, and against the standard library's stable sort.

use lucerna::cpu;
use lucerna::gpu::Runtime;
use lucerna::layout::sort::{
    SORT_DIGITS, SORT_FEW_TILES, SORT_IN_BACK, SORT_IN_FRONT, SORT_LANES, SORT_TILE, SortDigit, SortPlan, scan_groups,
    tiles,
};
use lucerna::passes::{Recording, sort};
use lucerna::shader::{BALLOTS, Library};

use crate::support;

/// What lies in buffers before a sort, so that a result left from before shows.
const POISON: u32 = 0xdead_beef;

/// The kernels that run everywhere, and beside them those that the device has features for.
fn rigs() -> Vec<Runtime> {
    let mut of_device = support::rig();
    let features = support::gpu().shader_features();
    of_device.set_features(features);
    let plain = support::rig();
    if features.contains(&BALLOTS) { vec![plain, of_device] } else { vec![plain] }
}

struct Sorted {
    keys: Vec<u64>,
    payload: Vec<u32>,
    plan: SortPlan,
}

/// Puts pairs into a rig's buffers, poison into the others.
fn load(rig: &mut Runtime, keys: &[u64], payload: &[u32]) {
    let n = keys.len();
    for (name, bytes) in sort::buffers(n as u32) {
        rig.upload(name, &vec![POISON; bytes as usize / 4]).unwrap();
    }
    rig.upload("keys", keys).unwrap();
    rig.upload("payload", payload).unwrap();
}

fn result(rig: &Runtime, n: usize) -> Sorted {
    let plan: SortPlan = rig.read_some("sort_plan", 1).unwrap()[0];
    let (keys, payload) = match plan.result {
        SORT_IN_FRONT => ("keys", "payload"),
        SORT_IN_BACK => ("keys_back", "payload_back"),
        other => panic!("the plan names buffer {other}"),
    };
    Sorted { keys: rig.read_some(keys, n).unwrap(), payload: rig.read_some(payload, n).unwrap(), plan }
}

fn sort_on_gpu(rig: &mut Runtime, keys: &[u64], payload: &[u32]) -> Sorted {
    load(rig, keys, payload);
    let mut recording = Recording::default();
    sort::record(&mut recording, keys.len() as u32);
    rig.play(&recording).unwrap();
    result(rig, keys.len())
}

/// Sorts keys with their indices as payload, and compares plan and pairs with the judge. Returns the plan.
fn check(rig: &mut Runtime, keys: &[u64], what: &str) -> SortPlan {
    let payload: Vec<u32> = (0..keys.len() as u32).collect();
    let sorted = sort_on_gpu(rig, keys, &payload);
    assert_eq!(sorted.plan, cpu::sort::plan(keys), "{what}: plan of {} keys", keys.len());
    let (expected_keys, expected_payload) = cpu::sort::stable(keys, &payload);
    let wrong =
        (0..keys.len()).find(|&i| (sorted.keys[i], sorted.payload[i]) != (expected_keys[i], expected_payload[i]));
    if let Some(i) = wrong {
        panic!(
            "{what}: of {} pairs, number {i} is ({:#x}, {}) and should be ({:#x}, {})",
            keys.len(),
            sorted.keys[i],
            sorted.payload[i],
            expected_keys[i],
            expected_payload[i]
        );
    }
    sorted.plan
}

fn random_keys(n: u32) -> Vec<u64> {
    (0..n).map(cpu::sort::random_key).collect()
}

/// Random keys that differ in the bits of `mask` only.
fn some_digits(n: u32, mask: u64) -> Vec<u64> {
    (0..n).map(|i| cpu::sort::random_key(i) & mask).collect()
}

/// Sizes around the tile, and powers of two up to `2^most`, each with its neighbours.
fn sizes(most: u32) -> Vec<u32> {
    let mut sizes = vec![0, 1, 2, 3, 2 * SORT_TILE - 1, 2 * SORT_TILE, 2 * SORT_TILE + 1];
    for power in 2..=most {
        sizes.extend([(1 << power) - 1, 1 << power, (1 << power) + 1]);
    }
    sizes.extend([SORT_TILE - 1, SORT_TILE, SORT_TILE + 1]);
    sizes
}

#[test]
fn twin_agrees_with_the_standard_library() {
    for n in [0, 1, 2, 255, SORT_TILE - 1, SORT_TILE, SORT_TILE + 1, 3 * SORT_TILE + 17] {
        for keys in [random_keys(n), (0..n).map(|i| u64::from(i % 3) << 40).collect()] {
            let payload: Vec<u32> = (0..n).map(|i| i ^ 5).collect();
            assert_eq!(cpu::sort::sort(&keys, &payload), cpu::sort::stable(&keys, &payload), "{n} keys");
        }
    }
}

#[test]
fn random_keys_of_every_size() {
    for mut rig in rigs() {
        for n in sizes(16) {
            check(&mut rig, &random_keys(n), "random");
        }
    }
}

#[test]
fn random_keys_around_a_million() {
    for mut rig in rigs() {
        let plan = check(&mut rig, &random_keys(1 << 20), "random");
        assert_eq!(plan.digits_run, SORT_DIGITS);
        for n in [(1 << 20) - 1, (1 << 20) + 1] {
            check(&mut rig, &some_digits(n, 0x0000_ff00_00ff_0000), "two digits");
        }
    }
}

#[test]
fn random_keys_of_scan_chunks() {
    // The scan takes 2,048 tiles at a time, 8 M pairs: one digit is enough to see the carry between chunks, and a
    // partial chunk behind a full one.
    for mut rig in rigs() {
        let n = SORT_TILE * 2049 + 5;
        check(&mut rig, &some_digits(n, 0xff00), "one digit");
    }
}

#[test]
fn orders_that_are_special() {
    for mut rig in rigs() {
        for n in [2, SORT_TILE - 1, SORT_TILE + 1, 20_000] {
            let ascending: Vec<u64> = (0..n).map(|i| u64::from(i) * 0x0001_0003_0000_7001).collect();
            let descending: Vec<u64> = ascending.iter().rev().copied().collect();
            check(&mut rig, &ascending, "already sorted");
            check(&mut rig, &descending, "reversed");
            for key in [0, u64::MAX, 0x7edc_ba98_7654_3210] {
                let plan = check(&mut rig, &vec![key; n as usize], "all equal");
                assert_eq!((plan.digits_run, plan.result), (0, SORT_IN_FRONT));
            }
            // All keys agree but one, at either end.
            let mut odd = vec![0x0101_0101_0101_0101; n as usize];
            odd[0] = u64::MAX;
            check(&mut rig, &odd, "first is greatest");
            odd[0] = 0x0101_0101_0101_0101;
            odd[n as usize - 1] = 0;
            check(&mut rig, &odd, "last is least");
        }
    }
}

#[test]
fn digits_that_follow_the_layout_of_threads() {
    // Ranking works on rows of SORT_LANES keys, 32 of the hardware's, tiles of SORT_TILE: digits that are constant in
    // one of these, alternate in it, or change at its edges.
    for mut rig in rigs() {
        let n = 2 * SORT_TILE + SORT_TILE / 2 + 3;
        let spread = |digit: u32| u64::from(digit & 255) * 0x0101_0101_0101_0101;
        for run in [1, 2, SORT_LANES - 1, SORT_LANES, SORT_LANES + 1, 32, 256, SORT_TILE] {
            let constant: Vec<u64> = (0..n).map(|i| spread(i / run)).collect();
            check(&mut rig, &constant, "constant runs");
            let falling: Vec<u64> = (0..n).map(|i| spread(255 - i / run)).collect();
            check(&mut rig, &falling, "falling runs");
            let alternating: Vec<u64> = (0..n).map(|i| spread(if i / run % 2 == 0 { 0 } else { 255 })).collect();
            check(&mut rig, &alternating, "alternating runs");
            let within: Vec<u64> = (0..n).map(|i| spread(i % run)).collect();
            check(&mut rig, &within, "repeated runs");
        }
    }
}

#[test]
fn payload_is_carried_whatever_it_is() {
    for mut rig in rigs() {
        let keys: Vec<u64> = (0..9000_u64).map(|i| (i * 7919) % 13).collect();
        let payload: Vec<u32> = (0..9000_u32).map(|i| !i.rotate_left(9)).collect();
        let sorted = sort_on_gpu(&mut rig, &keys, &payload);
        assert_eq!((sorted.keys, sorted.payload), cpu::sort::stable(&keys, &payload));
    }
}

#[test]
fn a_digit_in_which_all_agree_runs_no_workgroup() {
    let mut rig = support::rig();
    rig.set_features(&["sort_census"]);
    let n = SORT_TILE + 100;
    // Every set of digits that differ would be 256 sorts; each alone, each missing, none, all, and some of both parities.
    let mut sets: Vec<u32> = (0..SORT_DIGITS).flat_map(|d| [1 << d, 0xff ^ (1 << d)]).collect();
    sets.extend([0, 0xff, 0b0101_0101, 0b1000_0001, 0b0011_1000]);
    for set in sets {
        let mask = (0..SORT_DIGITS).filter(|d| set >> d & 1 == 1).fold(0, |mask, d| mask | 0xff_u64 << (8 * d));
        let keys: Vec<u64> = random_keys(n).iter().map(|key| key << 1 & mask | 0x5a5a_5a5a_5a5a_5a5a & !mask).collect();
        rig.upload("sort_census", &vec![0_u32; 3 * SORT_DIGITS as usize]).unwrap();
        let plan = check(&mut rig, &keys, "some digits agree");
        assert_eq!(plan.digits_run, set.count_ones());
        let census: Vec<[u32; 3]> = rig.read("sort_census").unwrap();
        let totals: Vec<[u32; 256]> = rig.read("sort_totals").unwrap();
        for digit in 0..SORT_DIGITS as usize {
            let SortDigit { tiles_x, tiles_y, tiles_z, bins_x, bins_y, bins_z, .. } = plan.digits[digit];
            let words = [tiles_x, tiles_y, tiles_z, bins_x, bins_y, bins_z];
            if set >> digit & 1 == 1 {
                assert_eq!(
                    census[digit],
                    [tiles(n), scan_groups(tiles(n)), tiles(n)],
                    "digits {set:#b}: workgroups of {digit}"
                );
                assert_eq!(words, [tiles(n), 1, 1, scan_groups(tiles(n)), 1, 1]);
            } else {
                assert_eq!(census[digit], [0; 3], "digits {set:#b}: {digit} ran");
                assert_eq!(words, [0; 6]);
                assert_eq!(totals[digit], [POISON; 256]);
            }
        }
    }
}

/// Plays a sort pass by pass, and compares what each wrote, so that a wrong stage can be told from a right one.
fn check_stages(keys: &[u64]) {
    for mut rig in rigs() {
        let n = keys.len() as u32;
        let payload: Vec<u32> = (0..n).collect();
        let plan = cpu::sort::plan(keys);
        let mut whole = Recording::default();
        sort::record(&mut whole, n);
        let (mut twin_keys, mut twin_payload) = (keys.to_vec(), payload.clone());
        load(&mut rig, keys, &payload);
        for call in whole.calls() {
            let mut one = Recording::default();
            let params: [u32; 3] = bytemuck::pod_read_unaligned(&call.params);
            one.run(call.pass, call.size).params(&params);
            rig.play(&one).unwrap();
            let digit = params[2];
            let SortDigit { source, skipped, .. } = plan.digits[digit as usize];
            if skipped == 1 {
                continue;
            }
            let mut counts = cpu::sort::count(&twin_keys, digit);
            if call.pass.name == sort::SORT_COUNT.name {
                assert_eq!(rig.read::<u32>("sort_counts").unwrap(), counts, "count of digit {digit}");
                continue;
            }
            let totals = cpu::sort::scan(&mut counts);
            if [sort::SORT_SCAN.name, sort::SORT_SCAN_FEW.name].contains(&call.pass.name) {
                assert_eq!(rig.read::<u32>("sort_counts").unwrap(), counts, "scan of digit {digit}");
                let all: Vec<u32> = rig.read("sort_totals").unwrap();
                assert_eq!(all[256 * digit as usize..][..256], totals, "totals of digit {digit}");
            } else if call.pass.name == sort::SORT_SCATTER.name {
                (twin_keys, twin_payload) = cpu::sort::scatter(&twin_keys, &twin_payload, digit, &counts, &totals);
                let to = if source == SORT_IN_FRONT { ["keys_back", "payload_back"] } else { ["keys", "payload"] };
                assert_eq!(rig.read::<u64>(to[0]).unwrap(), twin_keys, "scatter of digit {digit}");
                assert_eq!(rig.read::<u32>(to[1]).unwrap(), twin_payload, "scatter of digit {digit}");
            }
        }
        assert_eq!((twin_keys, twin_payload), cpu::sort::stable(keys, &payload));
    }
}

#[test]
fn stages_agree_with_their_twins() {
    check_stages(&random_keys(3 * SORT_TILE + 77));
}

#[test]
fn stages_of_many_tiles_agree_with_their_twins() {
    // Just more tiles than the small scan takes.
    check_stages(&some_digits(SORT_FEW_TILES * SORT_TILE + 1, 0x00ff_0000_0000_00ff));
}

#[test]
fn repeated_sorts_give_the_same() {
    // 8 M pairs 100 times on a real GPU; on a CPU's driver enough to see a race between its two threads.
    let (n, repeats) = if support::stress() { (1 << 23, 100) } else { (1 << 16, 10) };
    for mut rig in rigs() {
        for (name, bytes) in sort::buffers(n) {
            rig.reserve(name, bytes).unwrap();
        }
        let mut recording = Recording::default();
        sort::record_fill(&mut recording, n);
        sort::record(&mut recording, n);
        let payload: Vec<u32> = (0..n).collect();
        let expected = cpu::sort::stable(&random_keys(n), &payload);
        for repeat in 0..repeats {
            rig.play(&recording).unwrap();
            let sorted = result(&rig, n as usize);
            assert!((sorted.keys, sorted.payload) == expected, "sort {repeat} of {repeats} differs");
        }
    }
}

#[test]
fn large_sizes() {
    if !support::stress() {
        return;
    }
    for mut rig in rigs() {
        for n in sizes(23).into_iter().filter(|n| *n > 1 << 16) {
            check(&mut rig, &random_keys(n), "random");
        }
    }
}

#[test]
fn tiles_in_two_dimensions() {
    // More than 65,535 tiles would take 2 GiB of keys, so plan as if a dimension took 3 workgroups at most. The last row
    // then goes beyond the last tile.
    let plan = include_str!("../shaders/passes/sort/plan.wgsl");
    let plan = plan.replace(" SORT_MOST_GROUPS,", "").replace("SORT_MOST_GROUPS", "3u");
    let mut rig = Runtime::new(support::gpu(), Library::shipped().with("passes/sort/plan", &plan));
    for tiles in [3, 4, 5, 40] {
        let keys = some_digits(tiles * SORT_TILE - 9, 0xff00_0000_00ff);
        let payload: Vec<u32> = (0..keys.len() as u32).collect();
        let sorted = sort_on_gpu(&mut rig, &keys, &payload);
        let SortDigit { tiles_x, tiles_y, .. } = sorted.plan.digits[0];
        assert_eq!([tiles_x, tiles_y], [3, tiles.div_ceil(3)]);
        assert!((sorted.keys, sorted.payload) == cpu::sort::stable(&keys, &payload), "{tiles} tiles");
    }
}

#[test]
fn an_unstable_sort_is_seen() {
    // Rank a row's equal digits from its last lane to its first: keys come out in order, their payload does not.
    let right = include_str!("../shaders/passes/sort/scatter.wgsl");
    let planted = right.replace("let below = bit - 0x10000u;", "let below = 0xffff0000u - bit - (bit - 0x10000u);");
    assert_ne!(right, planted);
    let mut rig = Runtime::new(support::gpu(), Library::shipped().with("passes/sort/scatter", &planted));
    let keys: Vec<u64> = random_keys(5000).iter().map(|key| key & 0xff).collect();
    let payload: Vec<u32> = (0..5000).collect();
    let sorted = sort_on_gpu(&mut rig, &keys, &payload);
    let (expected_keys, expected_payload) = cpu::sort::stable(&keys, &payload);
    assert_eq!(sorted.keys, expected_keys);
    assert_ne!(sorted.payload, expected_payload);
}

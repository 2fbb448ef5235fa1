//! Long runs of equal codes.

use crate::stress::lab::Lab;
use crate::stress::measured::{Measured, StressError};
use crate::stress::row::Row;
use crate::stress::scenes::clouds::{cloud, point};
use crate::stress::tools::forest::{built_by_codes, judged, others, rig_for};

pub static ROW: Row = Row {
    name: "equal-codes",
    holds: "runs of equal codes are split by index, and codes that differ in one bit by that, at each of 64 bits",
    quantity: "leaves and nodes that differ from the twin's",
    most: 0.0,
    unit: "codes",
    sizes: [20_000, 20_000, 4_000_000],
    measure,
};

fn measure(lab: &Lab, size: u64) -> Result<Measured, StressError> {
    let n = (size / 68).max(257) as u32;
    let mut rig = rig_for(lab, n)?;
    let triangles = cloud(n, 0.1, |_, random| point(random));
    let mut cases: Vec<(String, Vec<u64>)> = Vec::new();
    for bit in 0..64u64 {
        // Three runs of equal codes, in turn: two differ in this bit, the third in the lowest too.
        let codes = (0..n as usize).map(|i| [0, 1 << bit, 1 << bit | 1][i % 3]).collect();
        cases.push((format!("bit {bit}"), codes));
    }
    for bit in [0, 31, 32, 63u64] {
        // Two runs, already sorted, that split at any place.
        let at = u64::from(n) * (bit + 1) / 65;
        cases.push((format!("bit {bit}, in order"), (0..u64::from(n)).map(|i| u64::from(i > at) << bit).collect()));
    }
    let mut deepest: Vec<u64> = (0..63).map(|bit| 1 << bit).collect();
    deepest.extend(vec![0; n as usize - 63]);
    cases.push(("one bit each".to_owned(), deepest.clone()));
    deepest.reverse();
    cases.push(("one bit each, reversed".to_owned(), deepest));
    let mut all = Measured::new(0.0, 0);
    for (k, (what, codes)) in cases.iter().enumerate() {
        let [found, right] = built_by_codes(&mut rig, &triangles, codes)?;
        judged(&found, what)?;
        all = all.plus(Measured::new(others(&found, &right) as f64, u64::from(n)).noted(what.clone()));
        lab.tell(k as u64 + 1, cases.len() as u64);
    }
    Ok(all)
}

//! Sums and shares of numbers whose answer is known.

use glam::{UVec2, Vec3};
use lucerna::cpu::sources::{Batch, Class, Emitters, GROUPS, Light, Means, Tally, Way, shares};
use lucerna::layout::sources::{Contribution, LIGHT_POINT, LIGHT_SKY, WAY_FOUND, WAY_SAMPLED};
use lucerna::layout::trace::{NO_MATERIAL, RadianceSample, SAMPLE_BAD, TraceParams};

use crate::support::dice::Dice;

fn one(value: f32, light: u32, way: u32) -> Contribution {
    let rgb = Vec3::new(value, 0.0, 0.0);
    Contribution { rgb, light, way, bounce: 1, surface: 0, through: NO_MATERIAL }
}

/// Tallies paths of a window of pixels, layer by layer, each with what it brings; red alone. All pixels have a mean of 1.
fn tallied(size: UVec2, lists: &[Vec<Contribution>], bad: &[usize]) -> Tally {
    let paths = lists.len();
    let pixels = (size.x * size.y) as usize;
    let params = TraceParams {
        window_width: size.x,
        window_height: size.y,
        layers: (paths / pixels) as u32,
        ..TraceParams::default()
    };
    let longest = lists.iter().map(Vec::len).max().unwrap();
    let mut brought = vec![Contribution::default(); paths * longest];
    let mut samples = vec![RadianceSample::default(); paths];
    for (place, list) in lists.iter().enumerate() {
        list.iter().enumerate().for_each(|(slot, one)| brought[slot * paths + place] = *one);
        samples[place].rgb = list.iter().map(|one| one.rgb).sum();
    }
    bad.iter().for_each(|place| samples[*place].info = SAMPLE_BAD);
    let counts: Vec<u32> = lists.iter().map(|list| list.len() as u32).collect();
    let batch = Batch { params: &params, samples: &samples, counts: &counts, brought: &brought, reuses: false };
    let means = vec![[1.0; 3]; pixels];
    let mut tally = Tally::default();
    tally.add(&batch, Means { min: UVec2::ZERO, size, means: &means }, &Emitters::new(vec![0, 2, 2, 5]));
    tally
}

#[test]
fn one_pixel_is_as_by_hand() {
    // Halves: 4 of one mesh and 1 of the sky, against 2 and 2: differences 2 and -1, in all 1.
    let lists = vec![
        vec![one(4.0, 3, WAY_SAMPLED), one(1.0, LIGHT_SKY, WAY_FOUND)],
        vec![one(2.0, 4, WAY_SAMPLED), one(2.0, LIGHT_SKY, WAY_FOUND)],
    ];
    let tally = tallied(UVec2::ONE, &lists, &[]);
    let weight = 0.25 / 1.01;
    assert!((tally.relmse() - weight / 3.0).abs() < 1e-12);
    let parts = shares(&tally, |class| class.light);
    // The last of the meshes that begin at triangle 2; the sky takes from the error.
    assert_eq!(parts[0].0, Light::Mesh(2));
    assert!((parts[0].1.share - 2.0).abs() < 1e-12 && (parts[1].1.share + 1.0).abs() < 1e-12, "{parts:?}");
    assert!(parts[0].1.deviation.is_infinite(), "one group of pixels says nothing of how sure it is");
}

#[test]
fn bad_samples_are_left_out_and_pixels_without_a_half_too() {
    let steady = vec![one(1.0, 0, WAY_SAMPLED)];
    let odd = vec![one(3.0, 0, WAY_SAMPLED)];
    let wild = vec![one(1e6, 0, WAY_SAMPLED)];
    let lists = vec![steady.clone(), odd.clone(), wild, odd];
    let all = tallied(UVec2::ONE, &lists, &[]);
    let kept = tallied(UVec2::ONE, &lists, &[2]);
    // One sample of 1 against two of 3: 1 * 2 / 9 of 4.
    assert!(all.relmse() > 1e9 && (kept.relmse() - 4.0 * 2.0 / 9.0 / 1.01 / 3.0).abs() < 1e-12, "{}", kept.relmse());
    assert_eq!(tallied(UVec2::ONE, &lists[..2], &[1]).pixels, 0);
    assert!(shares(&Tally::default(), |class: &Class| *class).is_empty());
}

#[test]
fn classes_are_read_from_what_the_kernel_leaves() {
    let emitters = Emitters::new(vec![0]);
    let class = Class::of(&one(1.0, LIGHT_POINT + 7, WAY_FOUND), &emitters);
    assert_eq!(class, Class { bounce: 1, way: Way::Found, surface: Some(0), through: None, light: Light::Point(7) });
}

/// Two independent sources whose variances are 9 to 1, by chance: the shares are that, within what they say of themselves.
#[test]
fn shares_are_as_sure_as_they_say() {
    let size = UVec2::splat(32);
    let (mut far, runs) = (0, 40);
    for run in 0..runs {
        let mut dice = Dice(100 + run);
        let mut coin = |value: f32| if dice.unit() < 0.5 { value } else { 0.0 };
        let lists: Vec<_> = (0..4 * size.x * size.y)
            .map(|_| vec![one(coin(3.0), 0, WAY_SAMPLED), one(coin(1.0), LIGHT_SKY, WAY_FOUND)])
            .collect();
        let tally = tallied(size, &lists, &[]);
        assert_eq!(tally.classes.len(), 2);
        assert!(tally.classes.values().all(|sums| sums.len() == GROUPS && sums.iter().all(|sum| *sum != 0.0)));
        let (_, share) = shares(&tally, |class| class.light)[0];
        assert!(share.deviation < 0.03 && (share.share - 0.9).abs() < 0.1, "{share:?}");
        far += u32::from((share.share - 0.9).abs() > 2.0 * share.deviation);
    }
    // One in twenty is farther by chance, a few more with sixteen groups; of forty, more than eight would be one in a thousand.
    assert!(far <= 8, "{far} of {runs} are farther than two deviations");
}

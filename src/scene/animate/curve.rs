//! Numbers between keys. Places ascend, there is a value for each and one at least; before the first and after the last the value stays.

/// On the straight line between the keys around `x`.
pub fn linear(places: &[f64], values: &[f64], x: f64) -> f64 {
    match span(places, x) {
        Err(end) => values[end],
        Ok(k) => values[k] + (values[k + 1] - values[k]) * (x - places[k]) / (places[k + 1] - places[k]),
    }
}

/// On the monotone cubic of Fritsch and Carlson (1980): smooth through the keys, and between two of them never beyond both.
pub fn smooth(places: &[f64], values: &[f64], x: f64) -> f64 {
    let k = match span(places, x) {
        Err(end) => return values[end],
        Ok(k) => k,
    };
    let tangents = tangents(places, values);
    let width = places[k + 1] - places[k];
    let t = (x - places[k]) / width;
    // Hermite's basis.
    let rest = 1.0 - t;
    rest * rest * ((1.0 + 2.0 * t) * values[k] + t * width * tangents[k])
        + t * t * ((3.0 - 2.0 * t) * values[k + 1] - rest * width * tangents[k + 1])
}

/// The slope at each key: the mean of those of the lines beside it, 0 where these differ in sign, and so flat that the cubic stays monotone.
fn tangents(places: &[f64], values: &[f64]) -> Vec<f64> {
    let slope = |k: usize| (values[k + 1] - values[k]) / (places[k + 1] - places[k]);
    let slopes: Vec<f64> = (0..places.len() - 1).map(slope).collect();
    let inner = slopes.windows(2).map(|pair| if pair[0] * pair[1] > 0.0 { (pair[0] + pair[1]) / 2.0 } else { 0.0 });
    let mut tangents: Vec<f64> =
        slopes.first().copied().into_iter().chain(inner).chain(slopes.last().copied()).collect();
    for (k, slope) in slopes.iter().enumerate() {
        if *slope == 0.0 {
            (tangents[k], tangents[k + 1]) = (0.0, 0.0);
            continue;
        }
        // Within a circle of radius 3 they are monotone.
        let length = (tangents[k] / slope).hypot(tangents[k + 1] / slope);
        if length > 3.0 {
            tangents[k] *= 3.0 / length;
            tangents[k + 1] *= 3.0 / length;
        }
    }
    tangents
}

/// The key before `x` that has one behind it; else the key whose value stays.
fn span(places: &[f64], x: f64) -> Result<usize, usize> {
    match places.partition_point(|place| *place <= x) {
        0 => Err(0),
        next if next == places.len() => Err(next - 1),
        next => Ok(next - 1),
    }
}

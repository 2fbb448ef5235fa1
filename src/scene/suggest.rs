//! "Did you mean": the known name nearest to a wrong one.

/// `did you mean `kd`?`, where a known name is near enough.
pub fn did_you_mean<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    nearest(wrong, known).map(|name| format!("did you mean `{name}`?"))
}

/// What to say about a wrong name: the nearest known one, else all of them.
pub fn known_names<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str> + Clone) -> String {
    did_you_mean(wrong, known.clone()).unwrap_or_else(|| {
        let all: Vec<&str> = known.into_iter().take(40).collect();
        if all.is_empty() { "there are none".into() } else { format!("known here: {}", all.join(", ")) }
    })
}

/// The known name with the fewest single-character edits, if they are at most a third of the wrong one's length.
fn nearest<'a>(wrong: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wrong: Vec<char> = wrong.chars().take(64).flat_map(char::to_lowercase).collect();
    let limit = (wrong.len() / 3).max(1);
    known
        .into_iter()
        .map(|name| (distance(&wrong, &name.chars().take(64).flat_map(char::to_lowercase).collect::<Vec<_>>()), name))
        .filter(|(distance, name)| *distance <= limit && *distance < wrong.len().max(name.chars().count()))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, name)| name)
}

/// Edit distance in which a swap of neighbours counts once (optimal string alignment).
fn distance(a: &[char], b: &[char]) -> usize {
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let change = usize::from(a[i - 1] != b[j - 1]);
                let mut best = (rows[i - 1][j] + 1).min(rows[i][j - 1] + 1).min(rows[i - 1][j - 1] + change);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(rows[i - 2][j - 2] + 1);
                }
                best
            };
        }
    }
    rows[a.len()][b.len()]
}

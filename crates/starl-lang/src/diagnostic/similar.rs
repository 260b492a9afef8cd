//! Finding the name that was probably meant.

use alloc::vec::Vec;

/// The candidate most similar to `word`, if one is similar enough to be intended: at most a third of its characters
/// differ, counting a swap of neighbours once. The first of equally good ones.
///
/// The distance is the restricted Damerau-Levenshtein distance (Damerau, 1964), with a change between
/// upper and lower case free.
pub fn closest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word: Vec<char> = word.chars().take(64).collect();
    let near = candidates
        .into_iter()
        .map(|candidate| (distance(&word, candidate), candidate));
    let (best, candidate) = near.min_by_key(|(distance, _)| *distance)?;
    let length = word.len().max(candidate.chars().count());
    (best * 3 <= length).then_some(candidate)
}

fn distance(word: &[char], candidate: &str) -> usize {
    let candidate: Vec<char> = candidate.chars().take(64).collect();
    let mut rows: [Vec<usize>; 3] = [
        Vec::new(),
        Vec::new(),
        (0..=candidate.len()).collect::<Vec<_>>(),
    ];
    for (i, a) in word.iter().enumerate() {
        rows.rotate_left(1);
        let [before, above, row] = &mut rows;
        row.clear();
        row.push(i + 1);
        for (j, b) in candidate.iter().enumerate() {
            let same = a.eq_ignore_ascii_case(b);
            let mut cost = (above[j] + usize::from(!same))
                .min(above[j + 1] + 1)
                .min(row[j] + 1);
            if i > 0 && j > 0 && *a == candidate[j - 1] && word[i - 1] == *b {
                cost = cost.min(before[j - 1] + 1);
            }
            row.push(cost);
        }
    }
    rows[2][candidate.len()]
}

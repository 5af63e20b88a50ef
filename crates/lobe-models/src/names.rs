//! The nearest names to one that is not there.

/// The `count` candidates nearest to `word`, the nearest first; of equals, the first.
///
/// By the number of letters that have to be put in, taken out, changed or swapped with their neighbour (Damerau 1964),
/// where a word that holds the other counts as near.
#[must_use]
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>, count: usize) -> Vec<&'a str> {
    let mut ranked: Vec<(usize, &str)> = candidates
        .into_iter()
        .map(|candidate| {
            let holds = word.len() > 2 && (candidate.contains(word) || word.contains(candidate));
            (if holds { 1 } else { distance(word, candidate) }, candidate)
        })
        .collect();
    ranked.sort_by_key(|(distance, _)| *distance);
    ranked.into_iter().take(count).map(|(_, candidate)| candidate).collect()
}

fn distance(a: &str, b: &str) -> usize {
    // No name is longer; a text that is, is no slip of the fingers.
    const LONGEST: usize = 64;
    let a: Vec<char> = a.chars().take(LONGEST).collect();
    let b: Vec<char> = b.chars().take(LONGEST).collect();
    let mut rows = [vec![0; b.len() + 1], (0..=b.len()).collect::<Vec<_>>(), vec![0; b.len() + 1]];
    for (i, x) in a.iter().enumerate() {
        let [before, last, row] = &mut rows;
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let mut least = (last[j] + usize::from(x != y)).min(last[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && *x == b[j - 1] && a[i - 1] == *y {
                least = least.min(before[j - 1] + 1);
            }
            row[j + 1] = least;
        }
        rows.rotate_left(1);
    }
    rows[1][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances() {
        for (a, b, expected) in
            [("", "abc", 3), ("abc", "abc", 0), ("phnog", "phong", 1), ("ward", "wards", 1), ("kitten", "sitting", 3)]
        {
            assert_eq!((distance(a, b), distance(b, a)), (expected, expected), "{a} {b}");
        }
    }

    #[test]
    fn slips_find_their_name() {
        let names = ["lambert", "phong", "blinn-phong", "ward", "ward-duer"];
        assert_eq!(nearest("lamert", names, 1), ["lambert"]);
        assert_eq!(nearest("duer", names, 1), ["ward-duer"]);
        assert_eq!(nearest("blin-phong", names, 2), ["phong", "blinn-phong"]);
    }
}

//! The nearest name to a misspelt one: least edit distance (Levenshtein 1966), where it is small enough to be meant.

/// The name among `names` that `wanted` is most likely a misspelling of.
#[must_use]
pub fn nearest<'n>(wanted: &str, names: impl Iterator<Item = &'n str>) -> Option<&'n str> {
    let upper = wanted.to_uppercase();
    let limit = upper.chars().count() / 3 + 1;
    names
        .map(|name| (distance(&upper, &name.to_uppercase()), name))
        .filter(|(distance, _)| *distance <= limit)
        .min()
        .map(|(_, name)| name)
}

fn distance(left: &str, right: &str) -> usize {
    let right: Vec<char> = right.chars().collect();
    let mut row: Vec<usize> = (0..=right.len()).collect();
    for (i, a) in left.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, b) in right.iter().enumerate() {
            let replaced = diagonal + usize::from(a != *b);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(row[j + 1] + 1);
        }
    }
    row[right.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn a_slip_of_the_finger_finds_its_name() {
        let names = ["Extended", "Retracted", "Alarm"];
        assert_eq!(nearest("Alram", names.into_iter()), Some("Alarm"));
        assert_eq!(nearest("EXTENDED", names.into_iter()), Some("Extended"));
        assert_eq!(nearest("Temperature", names.into_iter()), None);
    }
}

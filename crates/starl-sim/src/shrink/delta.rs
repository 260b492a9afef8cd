//! Delta debugging: the smallest part of a list that does.

/// A part of the list for which `does` holds, from which no single element can be left out; it is taken to
/// hold for the whole list. This is the algorithm ddmin of Zeller and Hildebrandt (2002), but that nothing at
/// all is tried first, as faults are often not needed, and that only complements are tried: a part alone
/// that does is found by leaving out the others.
pub(super) fn minimise<T: Clone>(list: &[T], does: &mut dyn FnMut(&[T]) -> bool) -> Vec<T> {
    let mut kept = list.to_vec();
    if kept.is_empty() || does(&[]) {
        return Vec::new();
    }
    let mut parts = 2;
    while kept.len() > 1 {
        let size = kept.len().div_ceil(parts);
        let mut start = 0;
        let mut any = false;
        while start < kept.len() {
            let end = (start + size).min(kept.len());
            let rest = [&kept[..start], &kept[end..]].concat();
            if !rest.is_empty() && does(&rest) {
                // The rest moves to the place of the removed part.
                kept = rest;
                any = true;
            } else {
                start = end;
            }
        }
        match (any, size) {
            (true, _) => parts = 2,
            (false, 1) => break,
            (false, _) => parts = (parts * 2).min(kept.len()),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::minimise;

    #[test]
    fn necessary_items_remain() {
        let list: Vec<u32> = (0..100).collect();
        for needed in [vec![], vec![0], vec![99], vec![3, 50], vec![10, 11, 12, 90]] {
            let mut tries = 0;
            let kept = minimise(&list, &mut |part| {
                tries += 1;
                needed.iter().all(|number| part.contains(number))
            });
            assert_eq!(kept, needed);
            assert!(tries < 300, "{tries} tries");
        }
    }

    #[test]
    fn the_result_is_minimal() {
        // Any three of them do.
        let list: Vec<u32> = (0..20).collect();
        let kept = minimise(&list, &mut |part| part.len() >= 3);
        assert_eq!(kept.len(), 3);
    }
}

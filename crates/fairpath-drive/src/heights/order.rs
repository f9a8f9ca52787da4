//! Points in the order of who passes over whom: pairs come in, the level of each point goes out, or the pairs that make a ring.

use crate::groups::Groups;

/// For each point how many are below it one above the other: 0 for those that pass over nobody. An error gives pairs that make a ring, in its order.
pub(super) fn levels(count: usize, over: &[(usize, usize)]) -> Result<Vec<f64>, Vec<usize>> {
    // Pairs by their upper point; its level is known once those of all its lower ones are.
    let mut waits_for = vec![0_usize; count];
    let mut above: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (i, &(upper, lower)) in over.iter().enumerate() {
        waits_for[upper] += 1;
        above[lower].push(i);
    }
    let mut level = vec![0.0_f64; count];
    let mut ready: Vec<usize> = (0..count).filter(|&point| waits_for[point] == 0).collect();
    let mut done = 0;
    while let Some(lower) = ready.pop() {
        done += 1;
        for &i in &above[lower] {
            let upper = over[i].0;
            level[upper] = level[upper].max(level[lower] + 1.0);
            waits_for[upper] -= 1;
            if waits_for[upper] == 0 {
                ready.push(upper);
            }
        }
    }
    if done == count { Ok(level) } else { Err(ring(over, &waits_for)) }
}

/// The pairs of a ring among points that wait for each other: down from one to a lower that waits too, until a point comes again.
fn ring(over: &[(usize, usize)], waits_for: &[usize]) -> Vec<usize> {
    let down = |upper: usize| (0..over.len()).find(|&i| over[i].0 == upper && waits_for[over[i].1] > 0);
    let Some(mut at) = (0..waits_for.len()).find(|&point| waits_for[point] > 0) else { return Vec::new() };
    let mut seen = vec![None; waits_for.len()];
    let mut path = Vec::new();
    loop {
        if let Some(from) = seen[at] {
            return path.split_off(from);
        }
        seen[at] = Some(path.len());
        let Some(pair) = down(at) else { return path };
        path.push(pair);
        at = over[pair].1;
    }
}

/// The place of each point, where pairs of them are one place, and how many places there are; in the order of their first points.
pub(super) fn places(points: usize, level: &[(usize, usize)]) -> (Vec<usize>, usize) {
    let mut groups = Groups::new(points);
    // The earlier point stands for both.
    level.iter().for_each(|&(a, b)| groups.unite(a, b));
    let mut place = vec![0; points];
    let mut count = 0;
    for i in 0..points {
        let first = groups.first_of(i);
        if first == i {
            place[i] = count;
            count += 1;
        } else {
            place[i] = place[first];
        }
    }
    (place, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tower_has_its_levels_and_a_ring_is_named() {
        assert_eq!(levels(4, &[(2, 1), (1, 0), (2, 0)]), Ok(vec![0.0, 1.0, 2.0, 0.0]));
        assert_eq!(levels(0, &[]), Ok(vec![]));
        assert_eq!(levels(1, &[(0, 0)]), Err(vec![0]));
        let ring = levels(5, &[(4, 0), (0, 1), (1, 2), (2, 0), (3, 1)]).unwrap_err();
        let mut sorted = ring.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, [1, 2, 3], "{ring:?}");
    }
}

//! Things that are united two by two, in groups (disjoint sets; Tarjan, *Efficiency of a good but not linear set union algorithm*, 1975).

use std::collections::BTreeMap;

/// Numbers from 0 on, in groups.
pub(crate) struct Groups {
    /// Another one of its group that is less, or itself.
    parent: Vec<usize>,
}

impl Groups {
    /// So many groups of one.
    pub(crate) fn new(count: usize) -> Self {
        Self { parent: (0..count).collect() }
    }

    /// The least of a group stands for it.
    pub(crate) fn first_of(&mut self, mut i: usize) -> usize {
        while self.parent[i] != i {
            self.parent[i] = self.parent[self.parent[i]];
            i = self.parent[i];
        }
        i
    }

    pub(crate) fn unite(&mut self, a: usize, b: usize) {
        let (a, b) = (self.first_of(a), self.first_of(b));
        self.parent[a.max(b)] = a.min(b);
    }

    /// All groups by their least, each in order.
    pub(crate) fn all(mut self) -> Vec<Vec<usize>> {
        let mut members: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for i in 0..self.parent.len() {
            members.entry(self.first_of(i)).or_default().push(i);
        }
        members.into_values().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_hangs_together_is_one_group_by_its_least() {
        let mut groups = Groups::new(7);
        for (a, b) in [(5, 1), (2, 6), (1, 3), (6, 2)] {
            groups.unite(a, b);
        }
        assert_eq!((groups.first_of(3), groups.first_of(6)), (1, 2));
        assert_eq!(groups.all(), [vec![0], vec![1, 3, 5], vec![2, 6], vec![4]]);
        assert!(Groups::new(0).all().is_empty());
    }
}

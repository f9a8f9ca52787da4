//! Lists of one kind behind each other; of terms they are sums.

/// Lists whose items stand behind each other.
#[derive(Clone, Debug)]
pub(crate) struct Lists<T> {
    ends: Vec<usize>,
    items: Vec<T>,
}

impl<T> Default for Lists<T> {
    fn default() -> Self {
        Self { ends: Vec::new(), items: Vec::new() }
    }
}

impl<T, L: IntoIterator<Item = T>> FromIterator<L> for Lists<T> {
    fn from_iter<I: IntoIterator<Item = L>>(all: I) -> Self {
        let mut lists = Self::default();
        all.into_iter().for_each(|list| {
            lists.push(list);
        });
        lists
    }
}

impl<T: Copy + Default> Lists<T> {
    /// So many lists of items, which are told with the number of their list; in each they stand as they came.
    pub(crate) fn gathered(count: usize, items: &[(usize, T)]) -> Self {
        let mut ends = vec![0; count];
        items.iter().for_each(|&(list, _)| ends[list] += 1);
        let mut next = 0;
        // First where each begins; each item moves that on, to where the list ends.
        for end in &mut ends {
            next += std::mem::replace(end, next);
        }
        let mut sorted = vec![T::default(); items.len()];
        for &(list, item) in items {
            sorted[ends[list]] = item;
            ends[list] += 1;
        }
        Self { ends, items: sorted }
    }
}

impl<T> Lists<T> {
    /// Puts a list behind the others; its number.
    pub(crate) fn push(&mut self, list: impl IntoIterator<Item = T>) -> usize {
        self.items.extend(list);
        self.ends.push(self.items.len());
        self.ends.len() - 1
    }

    /// How many lists there are.
    pub(crate) fn count(&self) -> usize {
        self.ends.len()
    }

    /// The items of all lists.
    pub(crate) fn items(&self) -> &[T] {
        &self.items
    }

    /// Where the items of a list stand among all.
    pub(crate) fn range(&self, list: usize) -> std::ops::Range<usize> {
        list.checked_sub(1).map_or(0, |before| self.ends[before])..self.ends[list]
    }

    /// The items of a list.
    pub(crate) fn of(&self, list: usize) -> &[T] {
        &self.items[self.range(list)]
    }

    /// All lists, one after the other.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[T]> {
        let mut begin = 0;
        self.ends.iter().map(move |&end| &self.items[std::mem::replace(&mut begin, end)..end])
    }
}

/// Sums of unknowns with factors; an unknown may come more than once.
impl Lists<(usize, f64)> {
    /// Each sum for these unknowns.
    pub(crate) fn times(&self, x: &[f64]) -> Vec<f64> {
        // Most have two or three terms, for which no loop is quicker.
        let sum = |terms: &[(usize, f64)]| match *terms {
            [(i, a), (j, b)] => a * x[i] + b * x[j],
            [(i, a), (j, b), (k, c)] => a * x[i] + b * x[j] + c * x[k],
            _ => terms.iter().fold(0.0, |sum, &(i, a)| sum + a * x[i]),
        };
        self.iter().map(sum).collect()
    }

    /// For each of so many unknowns the sums in which it is, with its factors.
    pub(crate) fn transposed(&self, unknowns: usize) -> Self {
        let terms = self.iter().enumerate();
        let terms = terms.flat_map(|(sum, terms)| terms.iter().map(move |&(i, factor)| (i, (sum, factor))));
        Self::gathered(unknowns, &terms.collect::<Vec<_>>())
    }

    /// Adds each sum's factors, times its number, to the unknowns.
    pub(crate) fn add_transposed(&self, numbers: &[f64], x: &mut [f64]) {
        for (terms, number) in self.iter().zip(numbers) {
            terms.iter().for_each(|&(i, factor)| x[i] += factor * number);
        }
    }
}

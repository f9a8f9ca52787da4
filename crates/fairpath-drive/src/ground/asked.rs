//! What all paths ask of some tiles: the corridors of all come in, for each of the tiles what is asked of it goes out.

use super::raster::{Hit, Hits};
use super::tiles::TileIndex;
use std::collections::{BTreeMap, BTreeSet};

/// What paths ask of some tiles. To look for each tile in each corridor would take time in proportion to the number of paths times that of tiles.
pub(crate) struct Asked<'a>(BTreeMap<TileIndex, Vec<&'a [Hit]>>);

impl<'a> Asked<'a> {
    /// What is asked of these tiles, of each in the order of the corridors.
    pub(crate) fn of(tiles: &BTreeSet<TileIndex>, corridors: &[&'a Hits]) -> Self {
        let mut all: BTreeMap<TileIndex, Vec<&[Hit]>> = BTreeMap::new();
        let (Some(first), Some(last)) = (tiles.first(), tiles.last()) else { return Self(all) };
        for hits in corridors {
            let mut wanted = tiles.range(*hits.keys().next().unwrap_or(last)..).peekable();
            for (tile, hits) in hits.range(*first..=*last) {
                while wanted.next_if(|wanted| **wanted < *tile).is_some() {}
                if wanted.peek() == Some(&tile) {
                    all.entry(*tile).or_default().push(hits);
                }
            }
        }
        Self(all)
    }

    /// What is asked of a tile.
    pub(crate) fn on(&self, tile: TileIndex) -> &[&'a [Hit]] {
        self.0.get(&tile).map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::sync::Arc;

    fn tiles() -> impl Strategy<Value = BTreeSet<TileIndex>> {
        prop::collection::btree_set([0..6_u32, 0..6_u32], 0..20)
    }

    proptest! {
        #[test]
        fn nothing_is_missed_that_is_asked_of_a_tile(wanted in tiles(), paths in prop::collection::vec(tiles(), 0..5)) {
            let hit = |sample| Hit { sample, natural_m: 0.0, beyond_m: 0.0, low_m: 0.0, high_m: 0.0 };
            let corridors: Vec<Hits> = paths
                .iter()
                .enumerate()
                .map(|(path, tiles)| tiles.iter().map(|tile| (*tile, Arc::new(vec![hit(path as u16)]))).collect())
                .collect();
            let asked = Asked::of(&wanted, &corridors.iter().collect::<Vec<_>>());
            for tile in wanted {
                let own: Vec<&[Hit]> = corridors.iter().filter_map(|hits| Some(hits.get(&tile)?.as_slice())).collect();
                prop_assert_eq!(asked.on(tile), own);
            }
        }
    }
}

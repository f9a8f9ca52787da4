//! Which roads hang together: crossings come in, groups of roads go out.

use super::network::EngineeredNetwork;
use crate::groups::Groups;

/// The groups of roads that crossings tie together, each ascending, by their first roads.
pub(super) fn components(network: &EngineeredNetwork) -> Vec<Vec<usize>> {
    let mut groups = Groups::new(network.roads.len());
    network.over.iter().for_each(|over| groups.unite(over.upper.road, over.lower.road));
    network.meet.iter().for_each(|meet| groups.unite(meet.a.road, meet.b.road));
    groups.all()
}

//! Which roads hang together: crossings come in, groups of roads go out.

use super::network::EngineeredNetwork;

/// The groups of roads that crossings tie together, each ascending, by their first roads.
pub(super) fn components(network: &EngineeredNetwork) -> Vec<Vec<usize>> {
    let mut root: Vec<usize> = (0..network.roads.len()).collect();
    let over = network.over.iter().map(|over| (over.upper.road, over.lower.road));
    let meet = network.meet.iter().map(|meet| (meet.a.road, meet.b.road));
    for (a, b) in over.chain(meet) {
        let (a, b) = (find(&mut root, a), find(&mut root, b));
        // The smaller one becomes the root, so that the groups do not depend on the order of crossings.
        root[a.max(b)] = a.min(b);
    }
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(); root.len()];
    for road in 0..root.len() {
        let first = find(&mut root, road);
        groups[first].push(road);
    }
    groups.retain(|group| !group.is_empty());
    groups
}

fn find(root: &mut [usize], mut road: usize) -> usize {
    while root[road] != road {
        root[road] = root[root[road]];
        road = root[road];
    }
    road
}

//! Trees as pieces of few triangles: a broad one, a slender one and a fir.

use super::shape::frustum;
use super::{Finish, Instances, Part, Placement, Scene, part};
use crate::document::Results;

/// Sides of a crown.
const SIDES: usize = 7;

pub(super) fn add(scene: &mut Scene, results: &Results) {
    let mut at: [Vec<Placement>; 3] = Default::default();
    for tree in results.trees.values().flat_map(|trees| trees.iter()) {
        at[usize::from(tree.kind).min(2)].push(Placement {
            position: [tree.place.x, tree.place.y, results.ground.height(tree.place)],
            heading_rad: tree.turn_rad,
            pitch_rad: 0.0,
            scale: tree.size,
        });
    }
    let kinds: [(&str, Vec<Part>); 3] = [
        (
            "tree: broad",
            vec![
                part("trunk", Finish::Bark, |m| frustum(m, 5, [-0.5, 0.25], [3.0, 0.15])),
                part("crown", Finish::Leaves, |m| {
                    frustum(m, SIDES, [2.0, 1.2], [4.0, 2.6]);
                    frustum(m, SIDES, [4.0, 2.6], [6.5, 2.2]);
                    frustum(m, SIDES, [6.5, 2.2], [8.5, 0.0]);
                }),
            ],
        ),
        (
            "tree: slender",
            vec![
                part("trunk", Finish::Bark, |m| frustum(m, 5, [-0.5, 0.18], [2.5, 0.12])),
                part("crown", Finish::Leaves, |m| {
                    frustum(m, SIDES, [1.5, 0.5], [3.5, 1.3]);
                    frustum(m, SIDES, [3.5, 1.3], [9.0, 0.0]);
                }),
            ],
        ),
        (
            "tree: fir",
            vec![
                part("trunk", Finish::Bark, |m| frustum(m, 5, [-0.5, 0.22], [2.0, 0.18])),
                part("needles", Finish::Needles, |m| {
                    frustum(m, SIDES, [1.2, 2.0], [4.5, 0.5]);
                    frustum(m, SIDES, [3.6, 1.6], [7.0, 0.3]);
                    frustum(m, SIDES, [6.0, 1.1], [10.0, 0.0]);
                }),
            ],
        ),
    ];
    for ((name, parts), at) in kinds.into_iter().zip(at) {
        scene.instances.push(Instances { name: name.to_owned(), parts, at });
    }
}

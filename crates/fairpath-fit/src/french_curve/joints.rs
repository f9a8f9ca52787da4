//! How laid pieces meet each other: at a corner of the stroke, as one straight line, or in a blend.

use super::guide::Guide;
use super::laid::Laid;
use super::pose::Joint;
use fairpath_curve::trig;

/// How each piece meets the next, the last the first if `closed`; `corner_after` tells after which pieces the stroke has a corner.
pub(crate) fn joints(pieces: &[Laid], corner_after: &[bool], closed: bool, guides: &[Guide]) -> Vec<Joint> {
    let n = pieces.len();
    let count = if closed { n } else { n - 1 };
    let mut joints: Vec<Joint> = (0..count)
        .map(|i| {
            if corner_after[i] {
                Joint::Corner
            } else if n > 1 && goes_straight_on(&pieces[i], &pieces[(i + 1) % n], guides) {
                Joint::Straight
            } else {
                Joint::Smooth
            }
        })
        .collect();
    only_whole_lines(&mut joints, pieces, guides);
    joints
}

/// A line is turned a little when it is made one with another: so both its ends must be free to be corners. Where one is not, the pieces are blended
/// instead.
pub(crate) fn only_whole_lines(joints: &mut [Joint], pieces: &[Laid], guides: &[Guide]) {
    let (n, count) = (pieces.len(), joints.len());
    let closed = count == n;
    loop {
        let held = |outer: Outer, joint: Option<usize>| match outer {
            Outer::Corner => false,
            Outer::Bend => true,
            Outer::EndOfPiece => joint.is_some_and(|i| joints[i] == Joint::Smooth),
        };
        let bad = (0..count).find(|&i| {
            let (a, b) = (&pieces[i], &pieces[(i + 1) % n]);
            let before = if i > 0 { Some(i - 1) } else { closed.then(|| count - 1) };
            let after = if i + 1 < count { Some(i + 1) } else { closed.then_some(0) };
            joints[i] == Joint::Straight && (held(leg_begin(a, guides), before) || held(leg_end(b, guides), after))
        });
        match bad {
            Some(i) => joints[i] = Joint::Smooth,
            None => return,
        }
    }
}

/// What is at the outer end of the leg with which a piece meets another.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Outer {
    /// A corner of the template.
    Corner,
    /// The leg goes over into a bend.
    Bend,
    /// The whole piece is straight.
    EndOfPiece,
}

fn leg_begin(a: &Laid, guides: &[Guide]) -> Outer {
    let path = &guides[a.guide].path;
    match path.leg(a.to - NEAR) {
        None => Outer::Bend,
        Some([begin, _]) if begin <= a.from + NEAR => Outer::EndOfPiece,
        Some([begin, _]) if path.has_corner(begin) => Outer::Corner,
        Some(_) => Outer::Bend,
    }
}

fn leg_end(b: &Laid, guides: &[Guide]) -> Outer {
    let path = &guides[b.guide].path;
    match path.leg(b.from + NEAR) {
        None => Outer::Bend,
        Some([_, end]) if end >= b.to - NEAR => Outer::EndOfPiece,
        Some([_, end]) if path.has_corner(end) => Outer::Corner,
        Some(_) => Outer::Bend,
    }
}

/// Whether two pieces are straight where they meet, and in about one line.
pub(crate) fn goes_straight_on(a: &Laid, b: &Laid, guides: &[Guide]) -> bool {
    let (pa, pb) = (&guides[a.guide].path, &guides[b.guide].path);
    let straight = pa.leg(a.to - NEAR).is_some() && pb.leg(b.from + NEAR).is_some();
    let turn = trig::wrap_angle(b.pose(pb, b.from + NEAR).heading - a.pose(pa, a.to - NEAR).heading);
    straight && turn.abs() < LARGEST_TURN
}

/// Way from the end of a piece that is still its inside, px.
const NEAR: f64 = 1e-3;

/// Straight pieces that meet at less than this are meant as one line, radians.
const LARGEST_TURN: f64 = 0.3;

//! What an edit leaves to be fitted: another place on the slider, and back, keeps the edit.

use crate::common::{apart, beside, corpus, eight, ring, session_of, settle, shapes, spline, wave};
use fairpath_curve::{Point, Spline};
use fairpath_fit::{CurveEnd, Extension};
use fairpath_sketch::{CurveId, Neatening, Session};

/// How far a curve is from what its own stroke gives when it is fitted again.
fn refitted_apart(session: &Session, id: CurveId) -> f64 {
    let curve = session.drawing().curve(id).unwrap();
    let settings = Neatening { fairness: 0.5, ..curve.neatening.clone() }.settings().unwrap();
    match settings.fit(&curve.stroke, None, &mut ()) {
        Ok((fit, _)) => apart(&fit.spline, &curve.spline),
        Err(error) => panic!("{}: {error}", curve.name),
    }
}

/// A deed by hand with its name.
type NamedEdit = (&'static str, fn(&mut Session, CurveId));

/// Every edit by name, made in the middle of a curve.
fn edits() -> Vec<NamedEdit> {
    vec![
        ("cut", |session, id| session.cut(id, 0.37 * spline(session, id).length())),
        ("open", |session, id| session.open_curve(id)),
        ("shorten", |session, id| session.shorten(id, CurveEnd::End, 0.8 * spline(session, id).length())),
        ("extend", |session, id| session.extend(id, CurveEnd::End, 40.0, Extension::Curvature)),
        ("extend back", |session, id| session.extend(id, CurveEnd::Start, 40.0, Extension::Straight)),
        ("close", |session, id| session.close(id, 20.0)),
        ("corner", |session, id| session.toggle_corner(id, 0.45 * spline(session, id).length(), 15.0)),
        ("oversketch", |session, id| {
            let curve = spline(session, id).clone();
            let stroke = beside(&curve, 0.3 * curve.length(), 0.5 * curve.length(), 0.03 * curve.length());
            session.begin_stroke(1.0, false);
            stroke.iter().for_each(|&point| session.extend_stroke(point, None, None));
            session.finish_stroke(false);
            settle(session);
        }),
        ("pull", |session, id| {
            let curve = spline(session, id);
            let pose = curve.pose_at(0.6 * curve.length());
            let point = pose.point + fairpath_curve::Vec2::new(-pose.heading.sin(), pose.heading.cos()) * 8.0;
            session.pin(id, None, fairpath_sketch::Pin { share: 0.6, point });
            settle(session);
            // The next edit makes the pull the curve's own.
            session.cut(id, 0.15 * spline(session, id).length());
        }),
    ]
}

/// Distances for each edit over many strokes.
fn distances(strokes: &[Vec<Point>]) -> Vec<(&'static str, Vec<f64>)> {
    let of_edit = |(name, edit): (&'static str, fn(&mut Session, CurveId))| {
        let mut all = Vec::new();
        for points in strokes {
            let (mut session, ids) = session_of(std::slice::from_ref(points));
            let before = spline(&session, ids[0]).clone();
            edit(&mut session, ids[0]);
            let curves: Vec<CurveId> = session.drawing().curves().iter().map(|curve| curve.id).collect();
            // What cannot be done to such a curve changes nothing.
            if curves.len() == 1 && spline(&session, curves[0]) == &before {
                continue;
            }
            all.extend(curves.into_iter().map(|id| refitted_apart(&session, id)));
        }
        (name, all)
    };
    edits().into_iter().map(of_edit).collect()
}

#[test]
fn refitting_after_an_edit_stays_near_the_edited_curve() {
    for (edit, distances) in distances(&shapes()) {
        assert!(!distances.is_empty(), "{edit}");
        let largest = distances.iter().copied().fold(0.0, f64::max);
        eprintln!("{edit:12} {} curves, largest distance {largest:.2} px", distances.len());
        // As far as a fit is from its stroke without a word about it.
        assert!(largest < 7.0, "{edit}: {distances:?}");
    }
}

#[test]
fn refitting_edited_curves_of_the_corpus_stays_near_them() {
    let Some(strokes) = corpus("synthetic.json") else { return };
    let strokes: Vec<Vec<Point>> = strokes.into_iter().map(|stroke| stroke.points).collect();
    for (edit, mut distances) in distances(&strokes) {
        distances.sort_by(f64::total_cmp);
        let mean = distances.iter().sum::<f64>() / distances.len() as f64;
        let (median, largest) = (distances[distances.len() / 2], distances[distances.len() - 1]);
        eprintln!(
            "{edit:12} {:3} curves: mean {mean:.2} px, median {median:.2} px, largest {largest:.2} px",
            distances.len()
        );
        assert!(mean < 3.5 && largest < 8.0, "{edit}: {distances:?}");
    }
}

#[test]
fn what_no_edit_touched_keeps_its_points() {
    let (mut session, ids) = session_of(&[wave()]);
    let old = session.drawing().curve(ids[0]).unwrap().clone();
    session.extend(ids[0], CurveEnd::End, 60.0, Extension::Straight);
    let new = session.drawing().curve(ids[0]).unwrap();
    assert_eq!(new.stroke.points[..old.stroke.points.len() - 1], old.stroke.points[..old.stroke.points.len() - 1]);
    assert!(new.stroke.points.len() > old.stroke.points.len() + 10);
}

#[test]
fn the_parts_of_a_cut_share_the_points_among_them() {
    for shape in [wave(), eight()] {
        let (mut session, ids) = session_of(std::slice::from_ref(&shape));
        session.cut(ids[0], 0.4 * spline(&session, ids[0]).length());
        let mut shared = 0;
        for curve in session.drawing().curves() {
            shared += curve.stroke.points.iter().filter(|point| shape.contains(point)).count();
        }
        assert!(shared >= shape.len() - 1, "{shared} of {}", shape.len());
    }
}

/// Mean step from one point to the next, in units of the steps of the stroke: points out of order would make it large.
#[test]
fn where_a_curve_crosses_itself_points_stay_in_order() {
    let (mut session, ids) = session_of(&[eight()]);
    session.extend(ids[0], CurveEnd::Start, 30.0, Extension::Curvature);
    let points = &session.drawing().curve(ids[0]).unwrap().stroke.points;
    let largest = points.windows(2).map(|pair| (pair[1] - pair[0]).hypot()).fold(0.0, f64::max);
    assert!(largest < 20.0, "{largest}");
}

#[test]
fn where_a_stroke_comes_back_over_itself_points_stay_in_order() {
    // The stem of a letter down and up again, and on.
    let stem = crate::common::points(90, |u| match u {
        u if u < 0.3 => (300.0, 300.0 + 500.0 * u),
        u if u < 0.6 => (300.0, 450.0 - 500.0 * (u - 0.3)),
        u => (300.0 + 250.0 * (u - 0.6), 300.0 + 300.0 * (u - 0.6) * (u - 0.6)),
    });
    let (mut session, ids) = session_of(std::slice::from_ref(&stem));
    session.extend(ids[0], CurveEnd::End, 30.0, Extension::Curvature);
    let points = &session.drawing().curve(ids[0]).unwrap().stroke.points;
    // Just where it turns, two points may come in either order.
    let moved = stem.iter().zip(points).filter(|(before, after)| before != after).count();
    assert!(moved <= 3, "{moved}");
    assert!(refitted_apart(&session, ids[0]) < 3.0);
}

#[test]
fn a_curve_that_was_cut_open_stays_open_where_it_was_cut() {
    let (mut session, ids) = session_of(&[ring()]);
    assert!(spline(&session, ids[0]).is_closed());
    session.cut(ids[0], 120.0);
    let cut = spline(&session, ids[0]).start_pose().point;
    session.select(Some(ids[0]), false);
    session.set_neatening(Neatening { fairness: 0.6, ..session.neatening().clone() });
    settle(&mut session);
    let refitted = spline(&session, ids[0]);
    assert!(!refitted.is_closed());
    for end in [refitted.start_pose().point, refitted.end_pose().point] {
        assert!((end - cut).hypot() < 4.0, "{end} {cut}");
    }
}

#[test]
fn joined_curves_are_fitted_to_both_strokes() {
    let first = crate::common::points(50, |u| (40.0 + 150.0 * u, 100.0 + 20.0 * u));
    let second = crate::common::points(50, |u| (210.0 + 150.0 * u, 122.0 - 30.0 * u * u));
    for turned in [[false, false], [true, false], [false, true], [true, true]] {
        let mut strokes = [first.clone(), second.clone()];
        strokes.iter_mut().zip(turned).filter(|(_, turned)| *turned).for_each(|(stroke, _)| stroke.reverse());
        let (mut session, ids) = session_of(&strokes);
        session.join(ids[0], ids[1], 24.0);
        assert_eq!(session.drawing().curves().len(), 1);
        assert!(refitted_apart(&session, ids[0]) < 3.0);
        let joined: &Spline = spline(&session, ids[0]);
        for end in [first[0], second[49]] {
            assert!(joined.nearest(end).distance < 3.0);
        }
    }
}

//! What the method saw and decided on its way, for pictures of it.

use super::compose::Profile;
use super::ground::Ground;
use crate::clean::Cleaned;
use crate::conclude::restored;
use fairpath_curve::{Point, Segment};

/// Every intermediate result of a fit in curvature space, as the paper's figures 4, 7 and 10 show them, in the unit and frame of the stroke.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CurvatureStages {
    /// The cleaned points.
    pub points: Vec<Point>,
    /// Whether the stroke was taken as closed.
    pub closed: bool,
    /// The estimated curvature along the stroke (section 4.1): a run for each stretch between corners. A smoothly closed stroke has one,
    /// which begins where its profile does.
    pub places: Vec<Vec<CurvaturePlace>>,
    /// The connected linear pieces (section 4.2): for each stretch the places at which they begin and end.
    pub profiles: Vec<Vec<CurvaturePlace>>,
    /// The curve of those pieces as they are, laid over the stroke as a whole, each limb about the end of the one before
    /// (sections 4.4 and 5.1): what the paper gives back.
    pub laid: Vec<Segment>,
}

/// A point of curvature space.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurvaturePlace {
    /// Arc length along the stroke.
    pub s: f64,
    /// Curvature, left positive.
    pub kappa: f64,
}

impl CurvatureStages {
    pub(super) fn of(ground: &Ground, profiles: &[&Profile], laid: &[Segment], cleaned: &Cleaned) -> Self {
        let ring = ground.is_ring();
        let begin = profiles[0].knots[0];
        let place =
            |s: f64, kappa: f64| CurvaturePlace { s: (s - begin) * cleaned.scale, kappa: kappa / cleaned.scale };
        let length = ground.length();
        let places = |stretch: &super::ground::Stretch| {
            let mut out: Vec<CurvaturePlace> = stretch
                .places
                .iter()
                .map(|p| place(if ring && p.s < begin { p.s + length } else { p.s }, p.kappa))
                .collect();
            out.sort_by(|a, b| a.s.total_cmp(&b.s));
            out
        };
        Self {
            points: cleaned.points.iter().map(|p| cleaned.restore(*p)).collect(),
            closed: ground.is_closed(),
            places: ground.stretches.iter().map(places).collect(),
            profiles: profiles
                .iter()
                .map(|p| p.knots.iter().zip(&p.kappas).map(|(&s, &kappa)| place(s, kappa)).collect())
                .collect(),
            laid: laid.iter().map(|s| restored(s, cleaned)).collect(),
        }
    }

    /// The stages of the reversed stroke as those of the stroke.
    pub(super) fn turned_round(&mut self) {
        self.points.reverse();
        let end = self.profiles.last().and_then(|p| p.last()).map_or(0.0, |p| p.s);
        for runs in [&mut self.places, &mut self.profiles] {
            runs.reverse();
            for run in runs {
                run.reverse();
                for p in run {
                    *p = CurvaturePlace { s: end - p.s, kappa: -p.kappa };
                }
            }
        }
        self.laid = self.laid.iter().rev().map(Segment::reversed).collect();
    }
}

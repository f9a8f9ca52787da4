//! What would have to give where not all limits can be kept.

use super::demand::{Demand, apart, number};
use std::fmt;

/// What kind of limit would have to give.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ShortfallKind {
    /// The greatest grade; needed and limit are rises for a metre.
    Grade,
    /// The least K over a crest, m for each percent.
    CrestK,
    /// The least K in a sag, m for each percent.
    SagK,
    /// A demand that contradicts others however steep and bent the roads may be; needed and limit are its height, m, its grade, or for a meeting the difference
    /// of the heights, m.
    Demand(Demand),
}

/// A limit that would have to give.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Shortfall {
    /// What kind of limit.
    pub kind: ShortfallKind,
    /// On which road.
    pub road: usize,
    /// The road's name.
    pub road_name: String,
    /// Where it begins to be missed, m.
    pub from_m: f64,
    /// Where that ends, m; less than where it begins if that is beyond the seam of a closed road.
    pub to_m: f64,
    /// What it would have to be. The needed values of all shortfalls together make heights possible; each alone need not.
    pub needed: f64,
    /// What it is.
    pub limit: f64,
    /// Because of what, the strongest first.
    pub because: Vec<Demand>,
}

impl fmt::Display for Shortfall {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "road {:?}, ", self.road_name)?;
        if self.from_m == self.to_m {
            write!(f, "station {} m: ", number(self.from_m))?;
        } else {
            write!(f, "stations {} to {} m: ", number(self.from_m), number(self.to_m))?;
        }
        let [needed, limit] = apart(self.needed, self.limit);
        let what = match &self.kind {
            ShortfallKind::Grade => "the grade",
            ShortfallKind::CrestK => "K over the crest",
            ShortfallKind::SagK => "K in the sag",
            ShortfallKind::Demand(demand) => {
                write!(f, "it is to {}", demand.asks(self.road))?;
                self.reasons(f, [", which contradicts that ", " and that "], |demand| {
                    let place = demand.place();
                    if demand.stations_on(self.road).is_empty() {
                        format!("road {:?} is to {}", place.name, demand.asks(place.road))
                    } else {
                        format!("it is to {}", demand.asks(self.road))
                    }
                })?;
                return write!(f, "; with all the values that are told, {needed} would do instead of {limit}");
            }
        };
        write!(f, "{what} would have to be {needed}")?;
        self.reasons(f, [" to ", " and to "], |demand| demand.asks(self.road))?;
        match self.kind {
            ShortfallKind::Grade => write!(f, "; {limit} is allowed"),
            _ => write!(f, "; it must be at least {limit}"),
        }
    }
}

impl Shortfall {
    fn reasons(
        &self,
        f: &mut fmt::Formatter<'_>,
        [before, between]: [&str; 2],
        say: impl Fn(&Demand) -> String,
    ) -> fmt::Result {
        for (i, demand) in self.because.iter().enumerate() {
            let before = if i == 0 { before } else { between };
            write!(f, "{before}{}", say(demand))?;
        }
        Ok(())
    }
}

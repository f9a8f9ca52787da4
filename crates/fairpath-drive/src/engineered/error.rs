//! Why a network of roads has no heights.

use super::shortfall::Shortfall;
use thiserror::Error;

/// Why a network of roads has no heights.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EngineeredError {
    /// What was told of it cannot be meant; these are all the places.
    #[error("the network cannot be understood: {}", listed(problems))]
    Invalid {
        /// What is wrong where.
        problems: Vec<InputProblem>,
    },
    /// The limits contradict each other; these are the ones that would have to give.
    #[error("the limits cannot all be kept: {}", listed(shortfalls))]
    Infeasible {
        /// What would have to give where.
        shortfalls: Vec<Shortfall>,
    },
    /// Rounding kept the solver from an answer, which happens with numbers of very different size.
    #[error(
        "no heights were found for the roads {roads:?}, nor what keeps them from having any ({status}); lengths, limits and weights differ too much in size"
    )]
    Unsettled {
        /// The roads of the part of the network that has no answer.
        roads: Vec<usize>,
        /// What the solver said last.
        status: String,
    },
}

/// Something that cannot be meant.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} is {found}; {needs}")]
#[non_exhaustive]
pub struct InputProblem {
    /// Where it stands, as in `roads[2].limits.crest_k_m`.
    pub field: String,
    /// What stands there.
    pub found: f64,
    /// What should.
    pub needs: &'static str,
}

fn listed<T: std::fmt::Display>(items: &[T]) -> String {
    items.iter().map(T::to_string).collect::<Vec<_>>().join("; ")
}

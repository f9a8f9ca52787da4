//! Heights of roads as engineers give them: a network of roads with their ground, limits and crossings comes in, for each road the elevation of least
//! earthwork within all limits goes out, or which limits cannot be kept, where and because of what.
//!
//! # The model
//!
//! A road rises along tangents that are joined by parabolic vertical curves (AASHTO, *A Policy on Geometric Design of Highways and Streets*, 7th edition,
//! 2018, section 3.4.6). Over equal intervals of the road this is a quadratic B-spline z(s) with coefficients c: on each interval the second derivative is
//! constant,
//!
//! > z″ = (cᵢ − 2 cᵢ₊₁ + cᵢ₊₂) / h²,
//!
//! and between the knots the grade is linear, with (cᵢ₊₁ − cᵢ) / h at the knots (de Boor, *A Practical Guide to Splines*, 1978, chapter X). So finitely many
//! linear inequalities are exactly what is asked for:
//!
//! - *Grade.* |cᵢ₊₁ − cᵢ| ≤ h · grade at every knot.
//! - *Vertical curves.* A parabola that turns the grade by A percent over L metres has K = L / A, which is 1 / (100 |z″|): −1 / (100 K) ≤ z″ ≤ 1 / (100 K)
//!   with the K of crests and that of sags.
//! - *Fixed points, meetings, clearances.* Height and grade at a station are linear in three coefficients.
//! - *Bounds over a range.* The Bézier points of each parabola, cut off at the ends of the range, keep the bound, so all of the parabola does. In a sag it
//!   may stay off a lowest height by up to h² / (800 K) that way: 6 mm for 10 m and K = 20.
//! - *Closed courses.* The coefficients run round, so height, grade and K hold over the seam.
//!
//! A cross-section whose middle is d above or below the ground has the area W |d| + S d², with a platform of width W and sides that run S metres for each
//! metre of rise. Each interval is cut into two cells; d is the mean of z − ground over a cell, and the earth of a cell is its length times the area there,
//! times what a cubic metre of cut or of fill counts. That is less than the true volume only in a cell in which the road crosses the ground or the
//! ground is rough; [`Earthwork`] measures the true one. What it costs to be above and below the ground makes this a convex quadratic program:
//! any minimum is the least of all. [`STIFFNESS_M4`] times ∫ z″² ds is added, and next to nothing for being off the ground, so that where no earthwork counts
//! (bridges, tunnels) the road is still one definite curve.
//!
//! The program is solved by the primal-dual interior-point method of Goulart and Chen (*Clarabel: An interior-point solver for conic programs with
//! quadratic objectives*, 2024), separately for each part of the network that hangs together. There are some twenty steps, and a step takes time proportional to the number of knots,
//! since what is tied to a coefficient are its neighbours; crossings tie more together. Where rounding keeps it from an end, the authors' own program is asked, which takes many
//! times as long.
//! Only additions, multiplications, divisions and square roots are on its way to the result, in an order that depends on the input alone.
//!
//! # How well limits are kept
//!
//! The program is solved with limits that are tighter by [`MARGIN`], so that a check against the limits themselves holds for every number of the result. Where
//! nothing is left within these, it is solved with limits wider by as much, and [`EngineeredHeights::strict`] is false. Only where that has no solution either
//! are the limits [`Infeasible`](EngineeredError::Infeasible).
//!
//! All statements are about curves with these knots: a vertical curve begins and ends at knots, so where the room is scarce a smaller knot spacing can
//! keep limits that a larger one cannot.

mod components;
mod demand;
mod earthwork;
mod elastic;
mod error;
mod general;
mod interior;
mod network;
mod program;
mod shortfall;
mod solve;
mod spline;
mod validate;

pub use demand::{Demand, NamedPoint};
pub use error::{EngineeredError, InputProblem};
pub use network::{
    ClearanceAt, EarthworkSection, EngineeredNetwork, EngineeredRoad, FixedPoint, GradeLimits, HeightBound, MeetAt,
    RoadPoint, WeightedStretch,
};
pub use shortfall::{Shortfall, ShortfallKind};
pub use solve::{Earthwork, EngineeredHeights, MARGIN, Margin, STIFFNESS_M4};

//! A raster in longitudes and latitudes becomes one in metres: in the zone of UTM of its middle, on a square grid in the largest upright rectangle within it,
//! so that no voids arise at its edges.

use super::TerrainOptions;
use super::epsg;
use super::projection::{ProjectionError, Projector};
use super::raster::{Plane, Raster, check_size};
use crate::error::Fault;
use crate::geodetic::wrapped;
use fairpath_curve::Point;
use fairpath_drive::Samples;
use fairpath_fit::Warning;

/// Longest way round the globe, degrees of longitude: at its ends, eleven degrees from the middle of a zone at most, lengths are up to 1.8 % too long.
const WIDEST_DEGREES: f64 = 16.0;

/// UTM ends there, degrees of latitude.
const NORTHERNMOST_DEGREES: f64 = 84.0;

/// Points on each edge of the source at most; between two of them an edge of the widest source bends by less than a metre.
const EDGE_POINTS: usize = 4096;

/// Rounds in which the sides of the rectangle are moved outwards until the edges stop them. Each leaves a share of the last one's move that is the slope of the
/// edges, a quarter at most: after 24 nothing is left of a degree.
const ROUNDS: usize = 24;

/// Where a sample comes from is computed exactly for every so many samples each way, or every half as many and so on, until the error is small enough.
const COARSEST: usize = 64;

/// Largest error of what is interpolated between them, in cells of the source. Measured at the middles of all squares and their sides, where it is largest while
/// the map is a quadratic; half of what is promised, a hundredth, is left for what it is beyond that.
const ERROR_CELLS: f64 = 0.005;

/// The raster in metres, and what is to be said about it.
pub(super) fn to_utm(source: &Raster, datum: &str, options: &TerrainOptions) -> Result<(Raster, Warning), Fault> {
    let globe = Globe::new(source)?;
    let (projection, code) = epsg::utm(globe.middle);
    let projector = Projector::between(&projection, datum, [0.0; 2]).map_err(beyond)?;
    let edges = globe.edges(&projector)?;
    let ([west, south], [east, north]) = rectangle(&edges);
    let share = (east - west) * (north - south) / edges.area();
    if !(west < east && south < north) {
        return Err(Fault::new("the grid", "no upright rectangle lies within it; reproject it to a plane in metres"));
    }
    let spacing = match options.spacing_m {
        Some(spacing) => spacing,
        None => globe.ground_spacing(&projector)?,
    };
    let cells = [(east - west) / spacing, (north - south) / spacing];
    // Beyond what fits it becomes the largest number there is, which no limit lets through.
    let size = cells.map(|cells| (cells as usize).saturating_add(1));
    let count = check_size(size, &options.limits)?;
    // In the middle of the rectangle.
    let corner = [0, 1].map(|k| [west, south][k] + 0.5 * (cells[k] - (size[k] - 1) as f64) * spacing);
    let target = Target { projector, globe, size, corner, spacing };
    let places = target.places()?;
    let samples = match &source.samples {
        Samples::F32(heights) => {
            let mut out = Vec::with_capacity(count);
            places.visit(size, |place| out.push(bilinear(heights, source.size, place) as f32));
            Samples::F32(out)
        }
        Samples::F64(heights) => {
            let mut out = Vec::with_capacity(count);
            places.visit(size, |place| out.push(bilinear(heights, source.size, place)));
            Samples::F64(out)
        }
    };
    let text = format!(
        "longitudes and latitudes were projected to UTM (EPSG:{code}) and heights resampled every {spacing} m; the upright rectangle within is {:.1} % of it",
        100.0 * share
    );
    let warning = Warning { code: "projected".into(), text };
    let plane = Plane::Projected { projection, epsg: Some(code) };
    Ok((Raster { size, samples, corner, step: [spacing; 2], plane, warnings: Vec::new() }, warning))
}

fn beyond(error: ProjectionError) -> Fault {
    Fault::new("the grid", error)
}

/// Where the samples of the source lie, degrees.
#[derive(Clone, Copy, Debug)]
struct Globe {
    size: [usize; 2],
    corner: [f64; 2],
    step: [f64; 2],
    /// Longitude within ±180.
    middle: [f64; 2],
}

impl Globe {
    fn new(source: &Raster) -> Result<Self, Fault> {
        let span = [0, 1].map(|k| (source.size[k] - 1) as f64 * source.step[k]);
        let [longitude, latitude] = [0, 1].map(|k| source.corner[k] + 0.5 * span[k]);
        let (south, north) = (source.corner[1], source.corner[1] + span[1]);
        let advice = "cut a part out, or reproject it to a plane in metres";
        if !(south >= -NORTHERNMOST_DEGREES && north <= NORTHERNMOST_DEGREES) {
            let problem = format!(
                "it reaches from latitude {south:?} to {north:?}, beyond ±{NORTHERNMOST_DEGREES} where UTM ends; {advice}"
            );
            return Err(Fault::new("the grid", problem));
        }
        if !(span[0] <= WIDEST_DEGREES && longitude.abs() <= 720.0) {
            let problem = format!(
                "it is {:?} degrees of longitude wide from {:?}, and more than {WIDEST_DEGREES} make no plane; {advice}",
                span[0], source.corner[0]
            );
            return Err(Fault::new("the grid", problem));
        }
        let middle = [wrapped(longitude), latitude];
        Ok(Self { size: source.size, corner: source.corner, step: source.step, middle })
    }

    /// The longitude and latitude at a column and row, degrees.
    fn degrees(&self, place: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| self.corner[k] + place[k] * self.step[k])
    }

    /// The column and row at a longitude and latitude.
    fn place(&self, [longitude, latitude]: [f64; 2]) -> [f64; 2] {
        // From the middle, wherever the count of degrees begins.
        let half = 0.5 * (self.size[0] - 1) as f64;
        [half + wrapped(longitude - self.middle[0]) / self.step[0], (latitude - self.corner[1]) / self.step[1]]
    }

    fn edges(&self, projector: &Projector) -> Result<Edges, Fault> {
        let [last_column, last_row] = self.size.map(|n| (n - 1) as f64);
        let along = |count: usize, place: &dyn Fn(f64) -> [f64; 2]| -> Result<Vec<[f64; 2]>, Fault> {
            let points = (count - 1).min(EDGE_POINTS);
            let at = |i: usize| {
                let degrees = self.degrees(place(i as f64 / points as f64));
                projector.point(degrees).map(|p| [p.x, p.y]).map_err(beyond)
            };
            (0..=points).map(at).collect()
        };
        Ok(Edges {
            west: along(self.size[1], &|t| [0.0, t * last_row])?,
            east: along(self.size[1], &|t| [last_column, t * last_row])?,
            south: along(self.size[0], &|t| [t * last_column, 0.0])?,
            north: along(self.size[0], &|t| [t * last_column, last_row])?,
        })
    }

    /// The spacing of a square grid with as many samples to the area as there are in the middle, m, to three digits.
    fn ground_spacing(&self, projector: &Projector) -> Result<f64, Fault> {
        let at = |across: f64, up: f64| {
            let [columns, rows] = self.size.map(|n| 0.5 * (n - 1) as f64);
            projector.point(self.degrees([columns + across, rows + up])).map_err(beyond)
        };
        // Half a step to each side: every grid reaches that far.
        let (right, up) = (at(0.5, 0.0)? - at(-0.5, 0.0)?, at(0.0, 0.5)? - at(0.0, -0.5)?);
        let spacing = (right.hypot() * up.hypot()).sqrt();
        if !(spacing > 0.0 && spacing.is_finite()) {
            return Err(Fault::new("the grid", "its samples lie at one place in the plane; are its steps in degrees?"));
        }
        let digit = 10_f64.powi(spacing.log10().floor() as i32 - 2);
        // Divided by a power of ten and not multiplied by its inverse, so that it prints as it is.
        Ok(if digit < 1.0 {
            (spacing / digit).round() / (1.0 / digit).round()
        } else {
            (spacing / digit).round() * digit
        })
    }
}

/// The edges of the source in the plane, m: from the south or from the west.
struct Edges {
    west: Vec<[f64; 2]>,
    east: Vec<[f64; 2]>,
    south: Vec<[f64; 2]>,
    north: Vec<[f64; 2]>,
}

impl Edges {
    /// The area between them, m².
    fn area(&self) -> f64 {
        let round = self.south.iter().chain(&self.east).chain(self.north.iter().rev()).chain(self.west.iter().rev());
        let ahead = round.clone().skip(1).chain(self.south.first());
        0.5 * round.zip(ahead).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>()
    }
}

/// South-west and north-east of an upright rectangle within the edges of which no side can be moved outwards.
fn rectangle(edges: &Edges) -> ([f64; 2], [f64; 2]) {
    let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
    let mut ys = [innermost(&edges.south, 1, everywhere, f64::max), innermost(&edges.north, 1, everywhere, f64::min)];
    let mut xs = [0.0; 2];
    for _ in 0..ROUNDS {
        xs = [innermost(&edges.west, 0, ys, f64::max), innermost(&edges.east, 0, ys, f64::min)];
        ys = [innermost(&edges.south, 1, xs, f64::max), innermost(&edges.north, 1, xs, f64::min)];
    }
    ([xs[0], ys[0]], [xs[1], ys[1]])
}

/// The coordinate `k` of an edge where it reaches furthest inwards, within a range of its other coordinate.
fn innermost(edge: &[[f64; 2]], k: usize, [low, high]: [f64; 2], further: fn(f64, f64) -> f64) -> f64 {
    let other = 1 - k;
    let mut found = f64::NAN;
    for pair in edge.windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if to[other] < low || from[other] > high {
            continue;
        }
        for bound in [low, high] {
            let along = ((bound - from[other]) / (to[other] - from[other])).clamp(0.0, 1.0);
            // NaN where the bound is infinite and the edge has no length there.
            if along.is_finite() {
                found = further(found, from[k] + along * (to[k] - from[k]));
            }
        }
    }
    if found.is_nan() { edge.iter().map(|p| p[k]).fold(found, further) } else { found }
}

/// The grid that is made, and where each of its samples comes from.
struct Target {
    projector: Projector,
    globe: Globe,
    size: [usize; 2],
    corner: [f64; 2],
    spacing: f64,
}

impl Target {
    /// Column and row of the source, not whole, for a column and row of the target.
    fn place(&self, [column, row]: [f64; 2]) -> Result<[f64; 2], Fault> {
        let plane = Point::new(self.corner[0] + column * self.spacing, self.corner[1] + row * self.spacing);
        Ok(self.globe.place(self.projector.longitude_latitude(plane).map_err(beyond)?))
    }

    /// These for all samples, within [`ERROR_CELLS`], from as few computed exactly as that allows.
    fn places(&self) -> Result<Places, Fault> {
        let mut every = COARSEST;
        loop {
            let places = self.places_every(every)?;
            if every == 1 || self.is_within(&places)? {
                return Ok(places);
            }
            every /= 2;
        }
    }

    fn places_every(&self, every: usize) -> Result<Places, Fault> {
        let knots = self.size.map(|n| (n - 1).div_ceil(every) + 1);
        let mut exact = Vec::with_capacity(knots[0] * knots[1]);
        for row in 0..knots[1] {
            for column in 0..knots[0] {
                exact.push(self.place([column, row].map(|k| (k * every) as f64))?);
            }
        }
        Ok(Places { every, knots: knots[0], exact })
    }

    fn is_within(&self, places: &Places) -> Result<bool, Fault> {
        let half = 0.5 * places.every as f64;
        let rows = places.exact.len() / places.knots;
        for row in 0..rows {
            for column in 0..places.knots {
                let [x, y] = [column, row].map(|k| (k * places.every) as f64);
                for middle in [[x + half, y], [x, y + half], [x + half, y + half]] {
                    if column + 1 == places.knots && middle[0] > x || row + 1 == rows && middle[1] > y {
                        continue;
                    }
                    let (exact, found) = (self.place(middle)?, places.at(middle));
                    if !((exact[0] - found[0]).hypot(exact[1] - found[1]) <= ERROR_CELLS) {
                        return Ok(false);
                    }
                }
            }
        }
        Ok(true)
    }
}

/// Columns and rows of the source, exact at some samples of the target.
struct Places {
    /// Samples of the target from one to the next, each way.
    every: usize,
    /// How many there are in a row.
    knots: usize,
    exact: Vec<[f64; 2]>,
}

impl Places {
    /// Interpolated for a column and row of the target.
    fn at(&self, target: [f64; 2]) -> [f64; 2] {
        let every = self.every as f64;
        let rows = self.exact.len() / self.knots;
        let [column, row] = target.map(|t| (t / every) as usize);
        let (column, row) = (column.min(self.knots.saturating_sub(2)), row.min(rows.saturating_sub(2)));
        let [u, v] = [target[0] / every - column as f64, target[1] / every - row as f64];
        let i = row * self.knots + column;
        let line = |i: usize| mixed(self.exact[i], self.exact[i + 1], u);
        mixed(line(i), line(i + self.knots), v)
    }

    /// All of them, row by row.
    fn visit(&self, [columns, rows]: [usize; 2], mut visit: impl FnMut([f64; 2])) {
        for row in 0..rows {
            let mut column = 0;
            while column < columns {
                // A line of them within one square is straight: two mean all.
                let last = (column + self.every).min(columns);
                let (from, to) =
                    (self.at([column as f64, row as f64]), self.at([(column + self.every) as f64, row as f64]));
                for c in column..last {
                    visit(mixed(from, to, (c - column) as f64 / self.every as f64));
                }
                column = last;
            }
        }
    }
}

fn mixed(from: [f64; 2], to: [f64; 2], t: f64) -> [f64; 2] {
    [from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])]
}

/// The height at a column and row that are not whole.
fn bilinear<T: Copy + Into<f64>>(heights: &[T], [columns, rows]: [usize; 2], place: [f64; 2]) -> f64 {
    let split = |at: f64, count: usize| {
        let at = at.clamp(0.0, (count - 1) as f64);
        let cell = (at as usize).min(count - 2);
        (cell, at - cell as f64)
    };
    let ((column, u), (row, v)) = (split(place[0], columns), split(place[1], rows));
    let i = row * columns + column;
    let line = |i: usize| {
        let (west, east): (f64, f64) = (heights[i].into(), heights[i + 1].into());
        west + u * (east - west)
    };
    let (south, north) = (line(i), line(i + columns));
    south + v * (north - south)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet of that size whose heights are columns plus a thousand rows, at a corner.
    fn sheet(side: usize, corner: [f64; 2]) -> Raster {
        let step = [1.0 / (side - 1) as f64; 2];
        let height = |i: usize| (i % side) as f64 + 1000.0 * (i / side) as f64;
        let samples = Samples::F64((0..side * side).map(height).collect());
        let plane = Plane::Geographic { projection: super::super::hgt::WGS84.into() };
        Raster { size: [side; 2], samples, corner, step, plane, warnings: Vec::new() }
    }

    #[test]
    fn every_sample_comes_from_within_a_hundredth_of_a_cell_of_its_place() {
        // North and south, at the edge of a zone, over the date line, far north.
        for corner in [[1.0, 42.0], [-70.0, -34.5], [5.0, 60.0], [179.5, -17.0], [20.2, 82.9], [8.5, -0.5]] {
            let source = sheet(151, corner);
            let (made, warning) = to_utm(&source, super::super::hgt::WGS84, &TerrainOptions::default()).unwrap();
            let Plane::Projected { projection, epsg } = &made.plane else { panic!("{:?}", made.plane) };
            assert!(warning.text.contains(&epsg.unwrap().to_string()), "{}", warning.text);
            let projector = Projector::between(projection, super::super::hgt::WGS84, made.corner).unwrap();
            let globe = Globe::new(&source).unwrap();
            for i in 0..made.samples.len() {
                let [column, row] = [i % made.size[0], i / made.size[0]].map(|k| k as f64);
                let on_globe =
                    projector.longitude_latitude(Point::new(column * made.step[0], row * made.step[1])).unwrap();
                let [c, r] = globe.place(on_globe);
                // Within the source, so that nothing had to be made up.
                assert!(c > -1e-3 && c < 150.001 && r > -1e-3 && r < 150.001, "{corner:?}: {c} {r}");
                let height = made.samples.get(i);
                let found_row = ((height - c) / 1000.0 - r).abs();
                assert!(found_row < 0.01, "{corner:?}: {found_row} rows");
            }
        }
    }

    #[test]
    fn columns_are_as_exact_as_rows() {
        let mut source = sheet(301, [14.0, 47.0]);
        source.samples = Samples::F64((0..301 * 301).map(|i| (i % 301) as f64).collect());
        let (made, _) = to_utm(&source, super::super::hgt::WGS84, &TerrainOptions::default()).unwrap();
        let Plane::Projected { projection, .. } = &made.plane else { panic!("{:?}", made.plane) };
        let projector = Projector::between(projection, super::super::hgt::WGS84, made.corner).unwrap();
        for i in 0..made.samples.len() {
            let at = Point::new((i % made.size[0]) as f64 * made.step[0], (i / made.size[0]) as f64 * made.step[1]);
            let [longitude, _] = projector.longitude_latitude(at).unwrap();
            assert!((made.samples.get(i) - 300.0 * (longitude - 14.0)).abs() < 0.01);
        }
    }

    #[test]
    fn the_rectangle_is_within_the_edges_and_touches_them_on_all_sides() {
        // A square of 100, turned by 0.1: no upright rectangle of these proportions within it has more than 1 / (1 + sin 0.2) of its area.
        let (sin, cos) = 0.1_f64.sin_cos();
        let turned = |x: f64, y: f64| [x * cos - y * sin, x * sin + y * cos];
        let edge = |from: [f64; 2], to: [f64; 2]| -> Vec<[f64; 2]> {
            (0..=10).map(|i| mixed(from, to, f64::from(i) / 10.0)).map(|p| turned(p[0], p[1])).collect()
        };
        let corners = [[0.0, 0.0], [100.0, 0.0], [0.0, 100.0], [100.0, 100.0]];
        let edges = Edges {
            west: edge(corners[0], corners[2]),
            east: edge(corners[1], corners[3]),
            south: edge(corners[0], corners[1]),
            north: edge(corners[2], corners[3]),
        };
        assert!((edges.area() - 1e4).abs() < 1e-6);
        let (low, high) = rectangle(&edges);
        let area = (high[0] - low[0]) * (high[1] - low[1]);
        assert!((area / 1e4 - 1.0 / (1.0 + 0.2_f64.sin())).abs() < 1e-6, "{area}");
        let back = |p: [f64; 2]| [p[0] * cos + p[1] * sin, p[1] * cos - p[0] * sin];
        for corner in [low, high, [low[0], high[1]], [high[0], low[1]]] {
            let [x, y] = back(corner);
            assert!(x.min(y).min(100.0 - x).min(100.0 - y).abs() < 1e-9, "{corner:?}");
        }
    }

    #[test]
    fn what_makes_no_plane_is_refused_with_advice() {
        let refused = |corner: [f64; 2], step: f64| {
            let mut source = sheet(11, corner);
            source.step = [step; 2];
            match to_utm(&source, super::super::hgt::WGS84, &TerrainOptions::default()) {
                Err(Fault::Malformed { problem, .. }) => problem,
                other => panic!("{:?}", other.map(|(raster, _)| raster.size)),
            }
        };
        assert!(refused([0.0, 80.0], 1.0).contains("beyond ±84"));
        assert!(refused([0.0, 0.0], 2.0).contains("20.0 degrees of longitude"));
        assert!(refused([1e9, 0.0], 0.1).contains("degrees of longitude"));
    }
}

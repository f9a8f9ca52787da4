//! The terrain in pieces that are drawn as fine as they are near: a piece, its level and its neighbours' levels come in, triangles go out that meet those of the
//! neighbours vertex by vertex.

use super::heightfield::Heightfield;
use super::pyramid::Cells;
use fairpath_shape::Mesh;

/// Side of a chunk, cells.
pub const CHUNK: usize = 64;

/// The coarsest level: one cell over the whole chunk.
pub const COARSEST: u8 = 6;

/// How coarse the four neighbours of a chunk are drawn; where there is no neighbour, any level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NeighbourLevels {
    /// Towards negative x.
    pub west: u8,
    /// Towards positive x.
    pub east: u8,
    /// Towards negative y.
    pub south: u8,
    /// Towards positive y.
    pub north: u8,
}

impl NeighbourLevels {
    /// All the same.
    #[must_use]
    pub fn all(level: u8) -> Self {
        Self { west: level, east: level, south: level, north: level }
    }
}

impl Heightfield {
    /// How many chunks lie beside and above each other; those at the east and north may be smaller.
    #[must_use]
    pub fn chunks(&self) -> [usize; 2] {
        self.size().map(|count| (count - 1).div_ceil(CHUNK))
    }

    /// The cells of a chunk.
    #[must_use]
    pub fn chunk_cells(&self, chunk: [usize; 2]) -> Cells {
        let [columns, rows] = self.size();
        let range = |chunk: usize, count: usize| [chunk * CHUNK, ((chunk + 1) * CHUNK).min(count - 1)];
        Cells { columns: range(chunk[0], columns), rows: range(chunk[1], rows) }
    }

    /// How far the triangles of a level lie above or below the samples at most, m; it does not fall as levels become coarser.
    ///
    /// Time is proportional to the cells of the chunk times the levels.
    #[must_use]
    pub fn chunk_errors_m(&self, chunk: [usize; 2]) -> [f64; COARSEST as usize + 1] {
        let Cells { columns, rows } = self.chunk_cells(chunk);
        let mut errors = [0.0_f64; COARSEST as usize + 1];
        for level in 1..errors.len() {
            let (xs, ys) = (marks(columns, level as u8), marks(rows, level as u8));
            let mut worst = errors[level - 1];
            for y in ys.windows(2) {
                for x in xs.windows(2) {
                    let corner = |i: usize, j: usize| self.sample([x[i], y[j]]);
                    let [sw, se, nw, ne] = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
                    for row in y[0]..=y[1] {
                        let v = (row - y[0]) as f64 / (y[1] - y[0]) as f64;
                        for column in x[0]..=x[1] {
                            let u = (column - x[0]) as f64 / (x[1] - x[0]) as f64;
                            // The diagonal goes from south-west to north-east.
                            let shown = if u >= v {
                                sw + u * (se - sw) + v * (ne - se)
                            } else {
                                sw + v * (nw - sw) + u * (ne - nw)
                            };
                            worst = worst.max((self.sample([column, row]) - shown).abs());
                        }
                    }
                }
            }
            errors[level] = worst;
        }
        errors
    }

    /// The triangles of a chunk at a level. Along an edge behind which the neighbour is coarser they use only the vertices that it has there, so that no crack
    /// opens and no vertex lies on another one's edge.
    ///
    /// Levels beyond [`COARSEST`] are taken for it.
    #[must_use]
    pub fn chunk_mesh(&self, chunk: [usize; 2], level: u8, neighbours: NeighbourLevels) -> Mesh {
        let Cells { columns, rows } = self.chunk_cells(chunk);
        let (xs, ys) = (marks(columns, level), marks(rows, level));
        let (last_x, last_y) = (xs.len() - 1, ys.len() - 1);
        // For each vertex the one that is used in its place: another one only on the edges.
        let west = snapped(&ys, rows, neighbours.west);
        let east = snapped(&ys, rows, neighbours.east);
        let south = snapped(&xs, columns, neighbours.south);
        let north = snapped(&xs, columns, neighbours.north);
        let used = |i: usize, j: usize| {
            let row = match i {
                0 => west[j],
                _ if i == last_x => east[j],
                _ => j,
            };
            let column = match j {
                0 => south[i],
                _ if j == last_y => north[i],
                _ => i,
            };
            [column, row]
        };
        let mut mesh = Mesh::default();
        let mut numbers = vec![u32::MAX; xs.len() * ys.len()];
        let mut vertex = |mesh: &mut Mesh, [i, j]: [usize; 2]| {
            let number = &mut numbers[j * xs.len() + i];
            if *number == u32::MAX {
                *number = mesh.vertices.len() as u32;
                let at = [xs[i], ys[j]];
                let place = self.place(at);
                mesh.vertices.push([place.x, place.y, self.sample(at)]);
                mesh.normals.push(self.normal(at));
            }
            *number
        };
        for j in 0..last_y {
            for i in 0..last_x {
                let corners = [used(i, j), used(i + 1, j), used(i + 1, j + 1), used(i, j + 1)];
                for triangle in [[0, 1, 2], [0, 2, 3]] {
                    let [a, b, c] = triangle.map(|corner| corners[corner]);
                    // Where an edge is coarser, some triangles have shrunk to nothing.
                    if a != b && b != c && c != a {
                        let triangle = [a, b, c].map(|corner| vertex(&mut mesh, corner));
                        mesh.triangles.push(triangle);
                    }
                }
            }
        }
        mesh
    }

    /// The unit vector that stands on the terrain at a sample, by the slopes to both sides.
    fn normal(&self, [column, row]: [usize; 2]) -> [f64; 3] {
        let [columns, rows] = self.size();
        let spacing = self.spacing_m();
        let (w, e) = (column.saturating_sub(1), (column + 1).min(columns - 1));
        let (s, n) = (row.saturating_sub(1), (row + 1).min(rows - 1));
        let x = (self.sample([w, row]) - self.sample([e, row])) / ((e - w) as f64 * spacing.x);
        let y = (self.sample([column, s]) - self.sample([column, n])) / ((n - s) as f64 * spacing.y);
        let length = (x * x + y * y + 1.0).sqrt();
        [x / length, y / length, 1.0 / length]
    }
}

/// The samples at which a level has vertices: every so many, and the last one.
fn marks([first, last]: [usize; 2], level: u8) -> Vec<usize> {
    let step = 1_usize << level.min(COARSEST);
    (first..last).step_by(step).chain([last]).collect()
}

/// For each mark of an edge the one that is used where the neighbour has the vertices of `level`: itself, or the last one before it that both have.
fn snapped(marks: &[usize], [first, last]: [usize; 2], level: u8) -> Vec<usize> {
    let step = 1_usize << level.min(COARSEST);
    let both = |mark: usize| mark == last || (mark - first).is_multiple_of(step);
    let mut before = 0;
    (0..marks.len())
        .map(|i| {
            if both(marks[i]) {
                before = i;
            }
            before
        })
        .collect()
}

//! Road networks on a terrain (McCrae, *Sketch-based path design*, 2008, chapter 3), without a window.
//!
//! | to … | use |
//! | --- | --- |
//! | have a terrain: of samples, or of nobody's survey | [`Heightfield`], [`fill_voids`], [`SyntheticTerrain`], [`Terrain`] |
//! | ask it for heights, slopes and what a ray meets | [`Heightfield::height`], [`Heightfield::smooth_height`], [`Heightfield::slope`], [`Terrain::hit`] |
//! | change it | [`Terrain::change`] |
//! | draw it as fine as it is near | [`Heightfield::chunk_mesh`], [`Heightfield::chunk_errors_m`] |
//! | give a path its elevation | [`Profile`], [`smoothed`] |
//! | find the heights at which paths pass over and under each other | [`CrossingHeights`] |
//! | give roads the heights of least earthwork within limits of grade and K | [`EngineeredNetwork`] |
//!
//! x is east, y north and z up, in metres from an origin of the terrain's own. Nothing here reads a file or a clock or starts a thread, and all results are the
//! same bits on every platform.
//!
//! ```
//! use fairpath_curve::Point;
//! use fairpath_drive::{Landscape, Ray, SyntheticTerrain, Terrain};
//!
//! let islands = SyntheticTerrain { landscape: Landscape::Islands, size: 257, cell_m: 8.0, seed: 7 };
//! let terrain = Terrain::new(islands.build()?);
//! let down = Ray { origin: [1000.0, 900.0, 5000.0], direction: [0.0, 0.0, -1.0] };
//! let hit = terrain.hit(&down).expect("it is aimed at the terrain");
//! assert_eq!(hit[2], terrain.field().height(Point::new(1000.0, 900.0)));
//! # Ok::<(), fairpath_drive::TerrainError>(())
//! ```

mod course;
mod document;
mod engineered;
mod furniture;
mod ground;
mod groups;
mod heights;
mod lists;
mod network;
mod playback;
mod profile;
mod range;
mod rules;
mod scene;
mod section;
mod smoothing;
mod sparse;
mod survey;
mod terrain;

pub use document::{
    Command, CommandError, CrossingSet, Document, FoliageRegion, LaidTerrain, NoFiles, Outcome, PathResult, RawLayout,
    RawSample, Results, Settings, SketchAs, State, TerrainSource, Terrains,
};
pub use engineered::{
    ClearanceAt, Demand, Earthwork, EarthworkSection, EngineeredError, EngineeredHeights, EngineeredNetwork,
    EngineeredRoad, FixedPoint, GradeLimits, HeightBound, InputProblem, MARGIN, Margin, MeetAt, NamedPoint, RoadPoint,
    STIFFNESS_M4, Shortfall, ShortfallKind, WeightedStretch,
};
pub use furniture::{Pillar, Sign, SignKind, Tree, pillars};
pub use ground::{
    CrossSection, EarthworkOptions, FineGrid, Ground, MassHaul, Side, Soil, SoilRegion, Soils, TileIndex, areas_m2_at,
    mass_haul, volumes_m3,
};
pub use heights::{CrossingHeights, HeightError, HeightPoint, Heights, Over, PathPoints};
pub use network::{
    Arm, Carrier, Choice, Crossing, DrawnHeights, HeightMode, Junction, Meeting, Path, PathId, PathPlace, SketchScale,
    SketchedPlan, SpeedZone, Structure, StructureLimits, Turning, Unordered, Way,
};
pub use playback::{
    COMFORTABLE_M_S2, Camera, CameraTrack, Drive, DriveError, Moment, Play, PlayError, drive, smooth_speeds,
};
pub use profile::{Elevation, Knot, Profile, ProfileError};
pub use range::OutOfRange;
pub use rules::{Breach, DesignRules, Rule, SpeedRule};
pub use scene::{Finish, Instances, Part, Placement, Scene, SceneOptions};
pub use section::{Crosses, Lane, LaneKind, Marking, Material, Piece, Section, SectionError};
pub use smoothing::smoothed;
pub use terrain::{
    CHUNK, COARSEST, Cells, GeoReference, Heightfield, Landscape, MOST_HEIGHT_M, MOST_SAMPLES, NeighbourLevels, Ray,
    Samples, SyntheticTerrain, Terrain, TerrainError, VoidReport, WaterBody, Waters, fill_voids,
};

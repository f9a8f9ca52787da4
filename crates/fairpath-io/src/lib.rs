//! Readers and writers of strokes and clothoid splines, readers of terrains, writers of surfaces, and pictures of all.
//!
//! | task | use |
//! | --- | --- |
//! | read strokes (JSON, SVG, CSV and blank-separated text, InkML, GPX, GeoJSON) | [`read_strokes`], [`read_strokes_from`] |
//! | write strokes (JSON, SVG, text) | [`write_strokes`], [`encode_strokes`] |
//! | read splines (JSON, our SVG, CSV) | [`read_splines`], [`read_splines_from`] |
//! | write splines (JSON, SVG, CSV, DXF, PNG) | [`write_splines`], [`encode_splines`] |
//! | read French curves (JSON, splines, drawings), write them | [`read_templates`], [`write_templates`] |
//! | the sets of French curves that come along | [`shipped_templates`] |
//! | draw splines, a contact sheet, the steps of a fit, French curves and their pieces | [`picture`] |
//! | compare methods on the same strokes, as a page of HTML | [`Comparison`] |
//! | read edits of splines (JSON) | [`read_edits`], [`read_edits_from`] |
//! | write surfaces (glTF, OBJ, PNG) | [`write_surfaces`], [`encode_surfaces`] |
//! | read terrains (GeoTIFF, SRTM, PNG, ESRI ASCII grid, raw; in ZIP archives too) | [`read_terrain`], [`read_terrain_from`] |
//! | tell where on the globe a place of a terrain lies, and back | [`Projector`], [`longitude_latitude`], [`point_at`] |
//! | convert | read splines and write them |
//! | write any file whole or not at all | [`write_whole`] |
//! | bound what a hostile file may cost | [`Limits`] in [`ReadOptions`] |
//! | JSON schemas of the formats | [`strokes_schema`], [`spline_schema`], [`templates_schema`], [`edits_schema`] |
//!
//! Numbers are f64 all the way and are printed so that they read back to the same bits, except in pictures and where a curve is
//! approximated, which is always within a stated tolerance. The direction of y is a label ([`YAxis`]): nothing is flipped unasked.
//! Errors name the file, the place in it and what was expected; what could be read or written only in part comes back as a list of
//! warnings.
//!
//! ```
//! use fairpath_curve::{Continuity, Point, Segment, Spline};
//! use fairpath_io::{ReadOptions, SplineEntry, SplineFile, SplineFormat, WriteOptions};
//!
//! let line = Segment::line(Point::new(0.0, 0.0), 0.0, 10.0);
//! let arc = Segment::arc(line.end(), 0.0, 15.0, 0.1);
//! let spline = Spline::new(vec![line, arc], vec![Continuity::G1], false)?;
//! let entry = SplineEntry { name: "hook".into(), method: "by-hand".into(), spline, report: None, templates: None, warnings: vec![] };
//! let file = SplineFile { splines: vec![entry], ..SplineFile::default() };
//!
//! let svg = fairpath_io::encode_splines(&file, SplineFormat::Svg, None, &WriteOptions::default())?;
//! let back = fairpath_io::read_splines_from(&svg.bytes[..], "hook.svg", None, &ReadOptions::default())?;
//! assert_eq!(back, file);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod atomic;
mod comparison;
mod drawable;
mod drawn_spline;
mod drive;
mod edits;
mod error;
mod geodetic;
mod gltf;
mod input;
mod limits;
mod listed;
mod mesh_gltf;
mod mesh_obj;
pub mod picture;
mod schema;
mod spline_csv;
mod spline_dxf;
mod spline_file;
mod spline_json;
mod spline_svg;
mod splines;
mod stroke_file;
mod strokes;
mod strokes_geojson;
mod strokes_gpx;
mod strokes_inkml;
mod strokes_json;
mod strokes_svg;
mod strokes_text;
mod surfaces;
mod svg_geometry;
mod templates;
mod templates_json;
mod terrain;
mod unit;
mod xml;

pub use atomic::write_whole;
pub use comparison::{ComparedMethod, Comparison, MethodSummary};
pub use drive::{
    DriveExport, DriveScript, DriveView, ExportFormat, MOST_PIXELS, OpenedDrive, PathSummary, ScriptCommand,
    encode_drive, encode_drive_picture, encode_earthwork, encode_moments, encode_project, open_drive,
    read_drive_script_from, summaries,
};
pub use edits::{Edit, Through, read_edits, read_edits_from};
pub use error::Error;
pub use limits::{Limits, ReadOptions};
pub use schema::{drive_script_schema, edits_schema, spline_schema, strokes_schema, templates_schema};
pub use spline_dxf::{DxfEntities, DxfOptions};
pub use spline_file::{Failure, Milliseconds, SplineEntry, SplineFile, SplineReport, UsedPiece, UsedTemplates};
pub use splines::{
    Encoded, SplineFormat, WriteOptions, encode_splines, read_splines, read_splines_from, write_splines,
};
pub use stroke_file::StrokeFile;
pub use strokes::{StrokeFormat, encode_strokes, read_strokes, read_strokes_from, write_strokes};
pub use surfaces::{SurfaceEntry, SurfaceFile, SurfaceFormat, encode_surfaces, write_surfaces};
pub use templates::{
    SHIPPED_TEMPLATES, TemplateFile, TemplateOptions, encode_templates, read_templates, read_templates_from,
    shipped_templates, write_templates,
};
pub use terrain::{
    ProjectionError, Projector, RawLayout, RawSample, TerrainFile, TerrainFormat, TerrainOptions, longitude_latitude,
    point_at, read_terrain, read_terrain_from,
};
pub use unit::{Unit, YAxis};

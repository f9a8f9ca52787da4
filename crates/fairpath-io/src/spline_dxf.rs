//! Splines as DXF of AutoCAD 2000 (AC1015): lines and arcs as they are, clothoids as arcs within a tolerance.
//!
//! Default is one `LWPOLYLINE` for each spline, its arcs as bulges: the chain stays one object that a CAM program can follow and an editor
//! can pick, and its bulge arcs are as true as `ARC` entities. Separate `LINE` and `ARC` entities are offered for programs without bulges.
//! Each spline has a layer of its own, named after it. Reference: Autodesk, "DXF Reference" (2000), and its group codes.
//!
//! Frame: DXF's y axis points up. Coordinates of a y-down file are written as they are, so that numbers agree between all our files;
//! the drawing then appears mirrored, which a comment in the file and a warning say. `flip_y` negates y instead.

use crate::drawable::{check_drawable, check_tolerance};
use crate::error::Error;
use crate::spline_file::SplineFile;
use crate::splines::Encoded;
use crate::unit::{Unit, YAxis};
use fairpath_curve::{Kind, Segment, Similarity, Spline};
use fairpath_fit::Warning;
use std::collections::HashSet;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt::{Display, Write};

/// What a spline becomes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum DxfEntities {
    /// One `LWPOLYLINE` with bulges.
    #[default]
    Polyline,
    /// A `LINE` or `ARC` for every piece.
    Separate,
}

/// How to write DXF.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DxfOptions {
    /// Largest distance between a clothoid and the arcs that stand for it, in the file's unit. Default 0.01.
    pub tolerance: f64,
    /// What a spline becomes. Default one polyline.
    pub entities: DxfEntities,
    /// Whether y is negated, which shows a y-down drawing upright. Default no.
    pub flip_y: bool,
}

impl Default for DxfOptions {
    fn default() -> Self {
        Self { tolerance: 0.01, entities: DxfEntities::Polyline, flip_y: false }
    }
}

pub(crate) fn write(file: &SplineFile, options: &DxfOptions) -> Result<Encoded, Error> {
    check_drawable(file, "DXF")?;
    check_tolerance(options.tolerance, "DXF")?;
    let mut layers = Layers::default();
    let chains: Vec<(String, Spline)> = file
        .splines
        .iter()
        .map(|entry| {
            let arcs = entry.spline.to_arcs(options.tolerance);
            let arcs = if options.flip_y { arcs.transformed(&Similarity::mirror(0.0)) } else { arcs };
            (layers.name(&entry.name), arcs)
        })
        .collect();
    let mirrored = file.y == YAxis::Down && !options.flip_y;
    let mut dxf = Dxf::default();
    dxf.comment("fairpath");
    if mirrored {
        dxf.comment(
            "y points down in these coordinates: the drawing is mirrored; write with flip_y to have it upright",
        );
    }
    dxf.header(file.unit);
    dxf.tables(&chains);
    dxf.blocks();
    dxf.begin("ENTITIES");
    for (layer, chain) in &chains {
        match options.entities {
            DxfEntities::Polyline => dxf.polyline(layer, chain),
            DxfEntities::Separate => chain.segments().iter().for_each(|s| dxf.piece(layer, s)),
        }
    }
    dxf.end();
    dxf.objects();
    dxf.pair(0, "EOF");
    let mut warnings = Vec::new();
    if mirrored && !chains.is_empty() {
        warnings.push(Warning {
            code: "y-down-in-dxf".into(),
            text: "y points down in this file and up in DXF: the drawing is mirrored there unless flip_y is set".into(),
        });
    }
    Ok(Encoded { bytes: dxf.text.into_bytes(), warnings })
}

/// Names of layers: without the signs that DXF forbids, not too long, unique without regard to case.
#[derive(Default)]
struct Layers {
    taken: HashSet<String>,
}

impl Layers {
    fn name(&mut self, name: &str) -> String {
        let forbidden = |c: char| c.is_control() || "<>/\\\":;?*|=`,".contains(c) || !c.is_ascii();
        let clean: String = name.trim().chars().map(|c| if forbidden(c) { '_' } else { c }).take(200).collect();
        let clean = if clean.is_empty() || clean == "0" { "spline".to_owned() } else { clean };
        let mut unique = clean.clone();
        let mut n = 1;
        while !self.taken.insert(unique.to_ascii_lowercase()) {
            n += 1;
            unique = format!("{clean}-{n}");
        }
        unique
    }
}

/// The text being written, and the next free handle.
struct Dxf {
    text: String,
    next_handle: u64,
}

impl Default for Dxf {
    fn default() -> Self {
        // Handles below are those of the fixed objects.
        Self { text: String::new(), next_handle: 0x100 }
    }
}

/// Handles of the fixed objects: tables, block records, blocks, dictionaries.
mod handle {
    pub(super) const VPORT: &str = "8";
    pub(super) const LTYPE: &str = "5";
    pub(super) const LAYER: &str = "2";
    pub(super) const STYLE: &str = "3";
    pub(super) const VIEW: &str = "6";
    pub(super) const UCS: &str = "7";
    pub(super) const APPID: &str = "9";
    pub(super) const DIMSTYLE: &str = "A";
    pub(super) const BLOCK_RECORD: &str = "1";
    pub(super) const BY_BLOCK: &str = "14";
    pub(super) const BY_LAYER: &str = "15";
    pub(super) const CONTINUOUS: &str = "16";
    pub(super) const LAYER_0: &str = "10";
    pub(super) const STANDARD: &str = "11";
    pub(super) const ACAD: &str = "12";
    pub(super) const VPORT_ACTIVE: &str = "94";
    pub(super) const DIM_STANDARD: &str = "27";
    pub(super) const MODEL_SPACE: &str = "1F";
    pub(super) const PAPER_SPACE: &str = "1B";
    pub(super) const MODEL_BLOCK: &str = "20";
    pub(super) const MODEL_END: &str = "21";
    pub(super) const PAPER_BLOCK: &str = "1C";
    pub(super) const PAPER_END: &str = "1D";
    pub(super) const ROOT: &str = "C";
    pub(super) const GROUPS: &str = "D";
}

impl Dxf {
    fn pair(&mut self, code: u32, value: impl Display) {
        writeln!(self.text, "{code:>3}\n{value}").expect("writing to a String does not fail");
    }

    fn pairs(&mut self, pairs: &[(u32, &str)]) {
        for (code, value) in pairs {
            self.pair(*code, value);
        }
    }

    /// A number, with a point, that reads back to the same f64.
    fn number(&mut self, code: u32, value: f64) {
        self.pair(code, format_args!("{value:?}"));
    }

    fn handle(&mut self) -> String {
        self.next_handle += 1;
        format!("{:X}", self.next_handle)
    }

    fn comment(&mut self, text: &str) {
        self.pair(999, text);
    }

    fn begin(&mut self, section: &str) {
        self.pairs(&[(0, "SECTION"), (2, section)]);
    }

    fn end(&mut self) {
        self.pair(0, "ENDSEC");
    }

    fn header(&mut self, unit: Unit) {
        // AutoCAD's codes of $INSUNITS; pixels have none.
        let (code, metric) = match unit {
            Unit::Px | Unit::Pt => (0, true),
            Unit::In => (1, false),
            Unit::Ft => (2, false),
            Unit::Mm => (4, true),
            Unit::Cm => (5, true),
            Unit::M => (6, true),
            Unit::Km => (7, true),
        };
        self.begin("HEADER");
        self.pairs(&[(9, "$ACADVER"), (1, "AC1015"), (9, "$DWGCODEPAGE"), (3, "ANSI_1252")]);
        self.pairs(&[(9, "$HANDSEED"), (5, "FFFFFFFF"), (9, "$INSUNITS")]);
        self.pair(70, code);
        self.pairs(&[(9, "$MEASUREMENT"), (70, if metric { "1" } else { "0" })]);
        self.end();
    }

    fn table(&mut self, name: &str, handle: &str, count: usize) {
        self.pairs(&[(0, "TABLE"), (2, name), (5, handle), (330, "0"), (100, "AcDbSymbolTable")]);
        self.pair(70, count);
        if name == "DIMSTYLE" {
            self.pair(100, "AcDbDimStyleTable");
        }
    }

    fn record(&mut self, kind: &str, handle: &str, owner: &str, class: &str, name: &str) {
        let code = if kind == "DIMSTYLE" { 105 } else { 5 };
        self.pairs(&[(0, kind), (code, handle), (330, owner), (100, "AcDbSymbolTableRecord"), (100, class), (2, name)]);
    }

    fn end_table(&mut self) {
        self.pair(0, "ENDTAB");
    }

    fn tables(&mut self, chains: &[(String, Spline)]) {
        self.begin("TABLES");
        self.table("VPORT", handle::VPORT, 1);
        self.view_port(chains);
        self.end_table();
        self.table("LTYPE", handle::LTYPE, 3);
        let types = [
            (handle::BY_BLOCK, "ByBlock", ""),
            (handle::BY_LAYER, "ByLayer", ""),
            (handle::CONTINUOUS, "Continuous", "Solid line"),
        ];
        for (handle, name, text) in types {
            self.record("LTYPE", handle, handle::LTYPE, "AcDbLinetypeTableRecord", name);
            self.pairs(&[(70, "0"), (3, text), (72, "65"), (73, "0"), (40, "0.0")]);
        }
        self.end_table();
        self.table("LAYER", handle::LAYER, chains.len() + 1);
        self.layer(handle::LAYER_0, "0");
        for (layer, _) in chains {
            let handle = self.handle();
            self.layer(&handle, layer);
        }
        self.end_table();
        self.table("STYLE", handle::STYLE, 1);
        self.record("STYLE", handle::STANDARD, handle::STYLE, "AcDbTextStyleTableRecord", "Standard");
        self.pairs(&[(70, "0"), (40, "0.0"), (41, "1.0"), (50, "0.0"), (71, "0"), (42, "2.5"), (3, "txt"), (4, "")]);
        self.end_table();
        self.table("VIEW", handle::VIEW, 0);
        self.end_table();
        self.table("UCS", handle::UCS, 0);
        self.end_table();
        self.table("APPID", handle::APPID, 1);
        self.record("APPID", handle::ACAD, handle::APPID, "AcDbRegAppTableRecord", "ACAD");
        self.pair(70, 0);
        self.end_table();
        self.table("DIMSTYLE", handle::DIMSTYLE, 1);
        self.record("DIMSTYLE", handle::DIM_STANDARD, handle::DIMSTYLE, "AcDbDimStyleTableRecord", "Standard");
        self.pairs(&[(70, "0"), (340, handle::STANDARD)]);
        self.end_table();
        self.table("BLOCK_RECORD", handle::BLOCK_RECORD, 2);
        for (handle, name) in [(handle::MODEL_SPACE, "*Model_Space"), (handle::PAPER_SPACE, "*Paper_Space")] {
            self.record("BLOCK_RECORD", handle, handle::BLOCK_RECORD, "AcDbBlockTableRecord", name);
        }
        self.end_table();
        self.end();
    }

    /// The window that a CAD program opens with: all of the drawing.
    fn view_port(&mut self, chains: &[(String, Spline)]) {
        let shown = chains.iter().map(|(_, c)| c.bounding_box()).reduce(|a, b| a.union(b));
        let shown = shown.unwrap_or(kurbo::Rect::new(0.0, 0.0, 1.0, 1.0));
        let height = 1.1 * shown.height().max(shown.width());
        let height = if height > 0.0 { height } else { 1.0 };
        self.record("VPORT", handle::VPORT_ACTIVE, handle::VPORT, "AcDbViewportTableRecord", "*Active");
        self.pair(70, 0);
        let fixed = [(10, 0.0), (20, 0.0), (11, 1.0), (21, 1.0), (12, shown.center().x), (22, shown.center().y)];
        let view =
            [(16, 0.0), (26, 0.0), (36, 1.0), (17, 0.0), (27, 0.0), (37, 0.0), (40, height), (41, 1.0), (42, 50.0)];
        for (code, value) in fixed.into_iter().chain(view) {
            self.number(code, value);
        }
    }

    fn layer(&mut self, handle: &str, name: &str) {
        self.record("LAYER", handle, handle::LAYER, "AcDbLayerTableRecord", name);
        self.pairs(&[(70, "0"), (62, "7"), (6, "Continuous"), (370, "-3"), (390, "F")]);
    }

    fn blocks(&mut self) {
        self.begin("BLOCKS");
        let blocks = [
            (handle::MODEL_BLOCK, handle::MODEL_END, handle::MODEL_SPACE, "*Model_Space"),
            (handle::PAPER_BLOCK, handle::PAPER_END, handle::PAPER_SPACE, "*Paper_Space"),
        ];
        for (begin, end, owner, name) in blocks {
            self.pairs(&[
                (0, "BLOCK"),
                (5, begin),
                (330, owner),
                (100, "AcDbEntity"),
                (8, "0"),
                (100, "AcDbBlockBegin"),
            ]);
            self.pairs(&[(2, name), (70, "0"), (10, "0.0"), (20, "0.0"), (30, "0.0"), (3, name), (1, "")]);
            self.pairs(&[(0, "ENDBLK"), (5, end), (330, owner), (100, "AcDbEntity"), (8, "0"), (100, "AcDbBlockEnd")]);
        }
        self.end();
    }

    fn objects(&mut self) {
        self.begin("OBJECTS");
        self.pairs(&[(0, "DICTIONARY"), (5, handle::ROOT), (330, "0"), (100, "AcDbDictionary"), (281, "1")]);
        self.pairs(&[(3, "ACAD_GROUP"), (350, handle::GROUPS)]);
        self.pairs(&[(0, "DICTIONARY"), (5, handle::GROUPS), (330, handle::ROOT), (100, "AcDbDictionary"), (281, "1")]);
        self.end();
    }

    fn entity(&mut self, kind: &str, layer: &str) {
        let handle = self.handle();
        self.pairs(&[(0, kind), (5, &handle), (330, handle::MODEL_SPACE), (100, "AcDbEntity"), (8, layer)]);
    }

    /// Lines and arcs as one polyline. The bulge of an arc is the tangent of a quarter of its turning.
    fn polyline(&mut self, layer: &str, chain: &Spline) {
        let pieces: Vec<Segment> = chain.segments().iter().flat_map(at_most_quarter_turns).collect();
        let closed = chain.is_closed();
        let vertices = pieces.len() + usize::from(!closed);
        self.entity("LWPOLYLINE", layer);
        self.pair(100, "AcDbPolyline");
        self.pair(90, vertices);
        self.pair(70, u8::from(closed));
        for piece in &pieces {
            self.number(10, piece.start.x);
            self.number(20, piece.start.y);
            if piece.kind() != Kind::Line {
                self.number(42, (0.25 * piece.turning()).tan());
            }
        }
        if let (false, Some(last)) = (closed, pieces.last()) {
            let end = last.end();
            self.number(10, end.x);
            self.number(20, end.y);
        }
    }

    /// One line or arc as an entity of its own. DXF's arcs run counter-clockwise, in degrees.
    fn piece(&mut self, layer: &str, piece: &Segment) {
        if piece.kind() == Kind::Line {
            self.entity("LINE", layer);
            self.pair(100, "AcDbLine");
            let end = piece.end();
            for (code, value) in
                [(10, piece.start.x), (20, piece.start.y), (30, 0.0), (11, end.x), (21, end.y), (31, 0.0)]
            {
                self.number(code, value);
            }
            return;
        }
        let radius = 1.0 / piece.kappa0;
        let normal = kurbo::Vec2::from_angle(piece.heading + FRAC_PI_2);
        let centre = piece.start + normal * radius;
        self.entity("ARC", layer);
        self.pair(100, "AcDbCircle");
        for (code, value) in [(10, centre.x), (20, centre.y), (30, 0.0), (40, radius.abs())] {
            self.number(code, value);
        }
        self.pair(100, "AcDbArc");
        let angle = |heading: f64| (heading - FRAC_PI_2.copysign(radius)).rem_euclid(TAU).to_degrees();
        let (start, end) = (angle(piece.heading), angle(piece.end_heading()));
        let (start, end) = if radius > 0.0 { (start, end) } else { (end, start) };
        let whole = piece.turning().abs() >= TAU;
        self.number(50, if whole { 0.0 } else { start });
        self.number(51, if whole { 360.0 } else { end });
    }
}

/// The piece, cut where an arc turns by more than a quarter: bulges near infinity (a full turn) are ill-defined.
fn at_most_quarter_turns(piece: &Segment) -> Vec<Segment> {
    let count = (piece.turning().abs() / FRAC_PI_2 - 1e-9).ceil().max(1.0);
    let at = |i: f64| if i == count { piece.length } else { piece.length * (i / count) };
    if count == 1.0 {
        return vec![*piece];
    }
    (0..count as u64).map(|i| piece.subsegment(at(i as f64), at(i as f64 + 1.0))).collect()
}

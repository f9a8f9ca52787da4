//! Round trips of generated files, bit for bit, and readers that meet any bytes at all.

#[path = "common/chain.rs"]
mod chain;

use chain::chain;
use fairpath_curve::{Continuity, Point, Spline};
use fairpath_fit::Stroke;
use fairpath_io::{
    ReadOptions, SplineEntry, SplineFile, SplineFormat, StrokeFile, StrokeFormat, TemplateOptions, Unit, WriteOptions,
    YAxis, encode_splines, encode_strokes, read_splines_from, read_strokes_from, read_templates_from,
};
use proptest::collection::vec;
use proptest::prelude::*;

/// Any finite number, subnormal ones and negative zero included.
fn number() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![NORMAL | SUBNORMAL | ZERO | POSITIVE | NEGATIVE, -1e4..1e4, (-1e9..1e9).prop_map(|v: f64| v + 1e-3)]
}

/// Names of all sorts of signs.
fn name() -> impl Strategy<Value = String> {
    prop_oneof!["[a-z]{1,5}/[0-9]", any::<String>(), "[\\x00-\\x7f]{0,12}", "[<>&\"'#;,\n\r\t \\]]{0,8}"]
}

fn stroke() -> impl Strategy<Value = Stroke> {
    (name(), vec([number(), number(), number(), number()], 1..20), any::<(bool, bool)>()).prop_map(
        |(name, rows, (timed, pressed))| Stroke {
            name,
            points: rows.iter().map(|r| Point::new(r[0], r[1])).collect(),
            times_s: if timed { rows.iter().map(|r| r[2]).collect() } else { Vec::new() },
            pressures: if pressed { rows.iter().map(|r| r[3]).collect() } else { Vec::new() },
        },
    )
}

fn unit() -> impl Strategy<Value = Unit> {
    proptest::sample::select(Unit::ALL.to_vec())
}

fn y_axis() -> impl Strategy<Value = YAxis> {
    proptest::sample::select(vec![YAxis::Down, YAxis::Up])
}

fn stroke_file() -> impl Strategy<Value = StrokeFile> {
    (unit(), y_axis(), vec(stroke(), 0..5)).prop_map(|(unit, y, strokes)| {
        let mut file = StrokeFile::new(strokes);
        (file.unit, file.y) = (unit, y);
        file.warnings.clear();
        file
    })
}

/// Curvatures near zero and not, lengths small and large, headings beyond whole turns.
fn spline() -> impl Strategy<Value = Spline> {
    let kappa = || prop_oneof![Just(0.0), -1.0..1.0_f64, -1e-12..1e-12_f64];
    let length = prop_oneof![1e-6..1.0_f64, 1.0..100.0_f64];
    let start = (-1e5..1e5_f64, -1e5..1e5_f64);
    (start, -20.0..20.0_f64, vec((length, kappa(), kappa()), 1..8), any::<bool>()).prop_filter_map(
        "the joins hold",
        |(start, heading, mut pieces, smooth)| {
            if smooth {
                for i in 1..pieces.len() {
                    pieces[i].1 = pieces[i - 1].2;
                }
            }
            let segments = chain(start, heading, &pieces);
            let join = if smooth { Continuity::G2 } else { Continuity::G1 };
            let joins = vec![join; segments.len() - 1];
            Spline::new(segments, joins, false).ok()
        },
    )
}

fn spline_file() -> impl Strategy<Value = SplineFile> {
    (unit(), y_axis(), vec((name(), spline()), 0..4)).prop_map(|(unit, y, splines)| SplineFile {
        unit,
        y,
        splines: splines
            .into_iter()
            .map(|(name, spline)| SplineEntry {
                name,
                method: String::new(),
                spline,
                report: None,
                templates: None,
                warnings: Vec::new(),
            })
            .collect(),
        ..SplineFile::default()
    })
}

/// The bits of all numbers, which tell −0 from 0.
fn stroke_bits(file: &StrokeFile) -> Vec<Vec<u64>> {
    let of = |s: &Stroke| {
        let points = s.points.iter().flat_map(|p| [p.x, p.y]);
        points.chain(s.times_s.iter().copied()).chain(s.pressures.iter().copied()).map(f64::to_bits).collect()
    };
    file.strokes.iter().map(of).collect()
}

fn spline_bits(file: &SplineFile) -> Vec<Vec<u64>> {
    let of = |e: &SplineEntry| {
        let numbers = |s: &fairpath_curve::Segment| [s.start.x, s.start.y, s.heading, s.length, s.kappa0, s.kappa1];
        e.spline.segments().iter().flat_map(numbers).map(f64::to_bits).collect()
    };
    file.splines.iter().map(of).collect()
}

const SPLINE_FORMATS: [SplineFormat; 3] = [SplineFormat::Json, SplineFormat::Svg, SplineFormat::Csv];

/// Reads the bytes as everything; what comes out does not matter, only that something does.
fn read_as_everything(bytes: &[u8]) {
    let mut options = ReadOptions::default();
    options.limits.max_points = 100_000;
    options.limits.max_nodes = 10_000;
    for format in StrokeFormat::ALL.map(Some).into_iter().chain([None]) {
        let _ = read_strokes_from(bytes, "any", format, &options);
    }
    for format in SPLINE_FORMATS.map(Some).into_iter().chain([None]) {
        let _ = read_splines_from(bytes, "any", format, &options);
    }
    let mut templates = TemplateOptions::default();
    templates.read = options;
    let _ = read_templates_from(bytes, "any", &templates);
}

proptest! {
    #[test]
    fn strokes_survive_json(file in stroke_file()) {
        let bytes = encode_strokes(&file, StrokeFormat::Json).unwrap();
        let back = read_strokes_from(&bytes[..], "it", None, &ReadOptions::default()).unwrap();
        prop_assert_eq!(stroke_bits(&back), stroke_bits(&file));
        prop_assert_eq!(back, file);
    }

    #[test]
    fn strokes_survive_text(mut file in stroke_file()) {
        file.strokes.retain(|s| !s.times_s.is_empty() || s.pressures.is_empty());
        if file.strokes.is_empty() {
            return Ok(());
        }
        let bytes = encode_strokes(&file, StrokeFormat::Text).unwrap();
        let back = read_strokes_from(&bytes[..], "it", None, &ReadOptions::default()).unwrap();
        prop_assert_eq!(stroke_bits(&back), stroke_bits(&file));
        prop_assert_eq!(back, file);
    }

    #[test]
    fn points_of_strokes_survive_svg(mut file in stroke_file()) {
        for s in &mut file.strokes {
            s.times_s.clear();
            s.pressures.clear();
        }
        let bytes = encode_strokes(&file, StrokeFormat::Svg).unwrap();
        let back = read_strokes_from(&bytes[..], "it", None, &ReadOptions::default());
        // The page of points that are farther apart than the largest number has no size.
        let far = file.strokes.iter().flat_map(|s| &s.points).any(|p| p.x.abs().max(p.y.abs()) > 1e300);
        prop_assume!(!far || back.is_ok());
        let back = back.unwrap();
        prop_assert_eq!((back.unit, back.y), (file.unit, file.y));
        prop_assert_eq!(stroke_bits(&back), stroke_bits(&file));
    }

    #[test]
    fn splines_survive_json_and_svg(file in spline_file()) {
        for format in [SplineFormat::Json, SplineFormat::Svg] {
            let bytes = encode_splines(&file, format, None, &WriteOptions::default()).unwrap().bytes;
            let back = read_splines_from(&bytes[..], "it", None, &ReadOptions::default()).unwrap();
            prop_assert_eq!(spline_bits(&back), spline_bits(&file));
            prop_assert_eq!(&back, &file);
        }
    }

    #[test]
    fn splines_survive_csv(file in spline_file()) {
        let bytes = encode_splines(&file, SplineFormat::Csv, None, &WriteOptions::default()).unwrap().bytes;
        let back = read_splines_from(&bytes[..], "it", None, &ReadOptions::default()).unwrap();
        prop_assert_eq!(spline_bits(&back), spline_bits(&file));
        prop_assert_eq!(&back, &file);
    }

    #[test]
    fn splines_can_be_written_as_dxf_and_png(file in spline_file()) {
        for format in [SplineFormat::Dxf, SplineFormat::Png] {
            let mut options = WriteOptions::default();
            options.picture.size_px = 100.0;
            prop_assert!(encode_splines(&file, format, None, &options).is_ok());
        }
    }

    #[test]
    fn any_bytes_are_read_or_refused(bytes in vec(any::<u8>(), 0..200)) {
        read_as_everything(&bytes);
    }

    #[test]
    fn any_text_of_familiar_pieces_is_read_or_refused(pieces in vec(proptest::sample::select(PIECES.to_vec()), 0..30)) {
        read_as_everything(pieces.concat().as_bytes());
    }

    #[test]
    fn a_file_cut_off_or_with_a_byte_changed_is_read_or_refused(file in spline_file(), at in any::<prop::sample::Index>(), byte in any::<u8>()) {
        for format in SPLINE_FORMATS {
            let mut bytes = encode_splines(&file, format, None, &WriteOptions::default()).unwrap().bytes;
            let at = at.index(bytes.len());
            read_as_everything(&bytes[..at]);
            bytes[at] = byte;
            read_as_everything(&bytes);
        }
    }
}

/// What the formats are made of.
const PIECES: [&str; 60] = [
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"format\":\"fairpath-strokes\"",
    "\"format\":\"fairpath-spline\"",
    "\"version\":1",
    "\"strokes\":",
    "\"splines\":",
    "\"points\":",
    "\"segments\":",
    "\"joins\":",
    "\"name\":\"a\"",
    "\"closed\":true",
    "1e308",
    "-0",
    "0.5",
    "1e-320",
    "null",
    "NaN",
    "\n",
    "\r\n",
    "\t",
    " ",
    ";",
    "#",
    "x,y\n",
    "1 2\n",
    "<svg>",
    "</svg>",
    "<svg viewBox=\"0 0 1 1\" width=\"1mm\">",
    "<g transform=\"",
    "rotate(1e300)",
    "scale(0)",
    "matrix(1 2 3 4 5 6)",
    "\">",
    "</g>",
    "<path d=\"",
    "M0 0",
    "A1 1 0 1 1 2 2",
    "C1 2 3 4 5 6",
    "q1 2 3 4",
    "t1e9 1",
    "z",
    "\"/>",
    "<use id=\"u\" href=\"#u\"/>",
    "<symbol id=\"s\">",
    "</symbol>",
    "<use href=\"#s\" width=\"1e200\"/>",
    "<ink>",
    "</ink>",
    "<trace>",
    "</trace>",
    "'1\"2!3",
    "<traceFormat><channel name=\"X\"/><channel name=\"Y\"/></traceFormat>",
    "<!ENTITY a \"b\">",
    "&a;",
    "\u{feff}",
];

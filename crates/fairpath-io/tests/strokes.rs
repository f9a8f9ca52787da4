//! Strokes from every format, as the contract in FORMATS says, and the messages for what breaks it.

use fairpath_curve::Point;
use fairpath_fit::Stroke;
use fairpath_io::{
    Error, Limits, ReadOptions, StrokeFile, StrokeFormat, Unit, YAxis, encode_strokes, read_strokes_from,
};
use std::io::Read;

fn read(text: impl AsRef<[u8]>, format: Option<StrokeFormat>) -> Result<StrokeFile, Error> {
    read_strokes_from(text.as_ref(), "drawing", format, &ReadOptions::default())
}

fn good(text: &str) -> StrokeFile {
    read(text, None).unwrap_or_else(|e| panic!("{text:?}: {e}"))
}

fn message(text: impl AsRef<[u8]>, format: StrokeFormat) -> String {
    read(text, Some(format)).expect_err("this must be refused").to_string()
}

fn points(stroke: &Stroke) -> Vec<(f64, f64)> {
    stroke.points.iter().map(|p| (p.x, p.y)).collect()
}

fn names(file: &StrokeFile) -> Vec<&str> {
    file.strokes.iter().map(|s| s.name.as_str()).collect()
}

#[test]
fn json_gives_points_times_pressures_and_the_frame() {
    let file = good(
        r#"{"format":"fairpath-strokes","version":1,"unit":"mm","dpi":100,"y":"up","source":{"who":["me"]},
           "strokes":[{"name":"a/1","points":[[1,2],[3.5,-4e-3]]},{"name":"b","points":[[1,2,0.5],[3,4,0.5]]},
                      {"name":"c","points":[[1,2,0,0.25]],"tool":"pen"},{"name":"d","points":[[1,2,null,1]]},{"name":"e","points":[]}]}"#,
    );
    assert_eq!((file.unit, file.y, file.dpi), (Unit::Mm, YAxis::Up, Some(100.0)));
    assert_eq!(names(&file), ["a/1", "b", "c", "d", "e"]);
    assert_eq!(points(&file.strokes[0]), [(1.0, 2.0), (3.5, -4e-3)]);
    assert_eq!(file.strokes[1].times_s, [0.5, 0.5]);
    assert_eq!((&file.strokes[2].pressures[..], &file.strokes[3].times_s[..]), (&[0.25][..], &[][..]));
    assert!(file.strokes[4].points.is_empty());
}

#[test]
fn json_that_breaks_the_rules_is_refused_with_its_place() {
    let wrap = |points: &str| {
        format!(
            "{{\"format\":\"fairpath-strokes\",\"version\":1,\"strokes\":[\n{{\"name\":\"a\",\"points\":{points}}}]}}"
        )
    };
    let cases = [
        ("", "empty"),
        ("{", "cut off"),
        ("{}", "missing field `format`"),
        ("[1,2]", "expected an object"),
        (r#"{"format":"fairpath-spline","version":1}"#, "convert them instead"),
        (r#"{"format":"fairpath-strokes","version":2,"strokes":[]}"#, "version 2 is not known"),
        (r#"{"format":"fairpath-strokes","version":1,"unit":"elephant","strokes":[]}"#, "`px`"),
        (&wrap("[[1]]"), "line 2, column 25, stroke 0 \"a\": invalid length 1"),
        (&wrap("[[1]]"), "expected a point [x,y]"),
        (&wrap("[[1,2],[1,2,3]]"), "different lengths"),
        (&wrap("[[1,2,null]]"), "null"),
        (&wrap("[[1,2,3,4,5]]"), "expected a point"),
        (&wrap("[[1,NaN]]"), "line 2"),
        (&wrap("[[1,1e999]]"), "out of range"),
        (&wrap("[[1,null]]"), "invalid type: null"),
        (&wrap("[[1,2]]}}"), "line 2"),
        (&format!("{}{}", "[".repeat(100_000), "]".repeat(100_000)), "line 1"),
    ];
    for (text, expected) in cases {
        let message = message(text, StrokeFormat::Json);
        assert!(message.contains(expected) && message.starts_with("drawing: "), "{text:.80}: {message}");
    }
}

#[test]
fn bytes_that_are_no_text_are_refused_with_their_place() {
    for format in [StrokeFormat::Json, StrokeFormat::Svg, StrokeFormat::InkMl] {
        assert!(message(b"<svg>\n\xff", format).contains("line 2, byte 6: the text is not UTF-8"));
        assert!(message(b" \r\n\t", format).contains("the file is empty"));
        assert!(message(b"\0\0\0\0", format).contains("line 1"));
    }
}

#[test]
fn names_are_made_unique_in_the_order_of_the_file() {
    let file = good(
        r#"{"format":"fairpath-strokes","version":1,"strokes":[{"name":"a","points":[]},{"name":"a#2","points":[]},
           {"name":"a","points":[]},{"name":"a","points":[]},{"points":[]}]}"#,
    );
    assert_eq!(names(&file), ["a", "a#2", "a#3", "a#4", "stroke/4"]);
    assert_eq!(file.warnings.len(), 2);
    assert!(file.warnings.iter().all(|w| w.code == "renamed"));
}

#[test]
fn text_is_read_with_any_separator_header_comment_and_line_end() {
    let plain = "1 2\n3 4\n\n5 6\n";
    let variants = [
        plain.to_owned(),
        plain.replace(' ', ","),
        plain.replace(' ', ", "),
        plain.replace(' ', ";"),
        plain.replace(' ', "\t"),
        plain.replace('\n', "\r\n"),
        format!("\u{feff}{plain}"),
        format!("x,y\n{plain}"),
        format!("# made by hand\n{plain}\n\n\n"),
        format!("\n\n{plain}"),
        plain.replace("\n\n", "\n   \n# the next one\n\n"),
        plain.trim_end().to_owned(),
        plain.replace(' ', ",").replace("2\n", "2,\n"),
        plain.replace("1 2", "\"1\",\"2\""),
    ];
    for text in variants {
        let file = good(&text);
        assert_eq!(names(&file), ["stroke/0", "stroke/1"], "{text:?}");
        assert_eq!(points(&file.strokes[0]), [(1.0, 2.0), (3.0, 4.0)], "{text:?}");
        assert_eq!(points(&file.strokes[1]), [(5.0, 6.0)], "{text:?}");
    }
}

#[test]
fn text_carries_times_pressures_and_names() {
    let file =
        good("# unit: m\n# y: up\n# name: first stroke\n0 0 0.0 0.5\n1 0 0.1 0.75\n# name: \"second\\n\"\n1 1\n");
    assert_eq!((file.unit, file.y), (Unit::M, YAxis::Up));
    assert_eq!(names(&file), ["first stroke", "second\n"]);
    assert_eq!(file.strokes[0].times_s, [0.0, 0.1]);
    assert_eq!(file.strokes[0].pressures, [0.5, 0.75]);
}

#[test]
fn text_with_a_header_goes_by_the_names_of_its_columns() {
    let file = good("time_ms,Pressure,tilt,Y,X\n500,0.25,left,2,1\n1500,0.75,right,4,3\n");
    assert_eq!(points(&file.strokes[0]), [(1.0, 2.0), (3.0, 4.0)]);
    assert_eq!(file.strokes[0].times_s, [0.5, 1.5]);
    assert_eq!(file.strokes[0].pressures, [0.25, 0.75]);
    assert_eq!(file.warnings[0].text, "columns left out: tilt");
    let file = read("lon;lat\n1;2\n", Some(StrokeFormat::Text)).unwrap();
    assert_eq!(points(&file.strokes[0]), [(1.0, 2.0)]);
}

#[test]
fn text_that_is_no_point_is_refused_with_its_line() {
    let cases: [(&[u8], &str); 14] = [
        (b"1 2\nnan 3\n", "line 2: column 1 is \"nan\", not a finite number"),
        (b"1 2\n3 inf\n", "line 2: column 2 is \"inf\""),
        (b"1 2\n3 1e400\n", "line 2: column 2"),
        (b"1 2\nhello world\n", "line 2: column 1 is \"hello\""),
        (b"x y\na b\n1 2\n", "line 2"),
        (b"x,y,t\n1,2\n", "line 2: 2 columns where the header has 3"),
        (b"x,y\n1,2,3\n", "line 2: there are more than the header's 2 columns"),
        (b"1 2\n3\n", "line 2: there is one number only"),
        (b"1 2\n3 4 5\n", "3 numbers where the stroke's first line has 2"),
        (b"1 2 3 4 5\n", "more than four"),
        (b"1,,2\n", "column 2 is empty"),
        (b"1 2\n\xff\xfe 3\n", "line 2: the text is not UTF-8"),
        (b"1 2\n3 4\0\n", "line 2: there is a zero byte"),
        (b"# nothing\n\n", "there is no stroke"),
    ];
    for (text, expected) in cases {
        let message = message(text, StrokeFormat::Text);
        assert!(message.contains(expected), "{:?}: {message}", String::from_utf8_lossy(text));
    }
}

#[test]
fn svg_gives_every_subpath_with_transforms_applied() {
    let file = good(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">
          <defs><path id="hidden" d="M0 0L1 1"/></defs>
          <g transform="translate(10 20)"><g transform="scale(2)">
            <path id="two" d="m1,1 2,0 v3 z m5 5 l1 0"/>
            <polyline points="0,0 1,1 2,0"/>
            <polygon id="tri" points="0 0 1 0 0 1"/>
            <line x1="1" y1="2" x2="3" y2="4"/>
            <path display="none" d="M0 0L1 1"/><path style="fill:red; display : none" d="M0 0L1 1"/>
            <rect width="5" height="5"/><path d="M 1 1"/><path d=""/>
          </g></g>
          <use id="again" href="#hidden" x="5" y="6"/>
        </svg>"##,
    );
    assert_eq!(names(&file), ["two/0", "two/1", "polyline/2", "tri", "line/4", "again/hidden"]);
    let expect: [&[(f64, f64)]; 6] = [
        &[(12.0, 22.0), (16.0, 22.0), (16.0, 28.0), (12.0, 22.0)],
        &[(22.0, 32.0), (24.0, 32.0)],
        &[(10.0, 20.0), (12.0, 22.0), (14.0, 20.0)],
        &[(10.0, 20.0), (12.0, 20.0), (10.0, 22.0), (10.0, 20.0)],
        &[(12.0, 24.0), (16.0, 28.0)],
        &[(5.0, 6.0), (6.0, 7.0)],
    ];
    for (stroke, expect) in file.strokes.iter().zip(expect) {
        assert_eq!(points(stroke), expect, "{}", stroke.name);
    }
    assert_eq!(file.warnings.len(), 1);
    assert!(file.warnings[0].text.contains("1 <rect>"));
}

#[test]
fn svg_curves_are_flattened_within_the_tolerance() {
    let text = r#"<svg><path d="M100 0A100 100 0 1 1 -100 0 A100 100 0 0 1 100 0Z"/><path d="M0 0C0 100 100 100 100 0S200-100 200 0Q250 50 300 0T400 0"/></svg>"#;
    for tolerance in [1.0, 0.01, 1e-5] {
        let mut options = ReadOptions::default();
        options.flatten_tolerance = tolerance;
        let file = read_strokes_from(text.as_bytes(), "drawing", None, &options).unwrap();
        let circle = &file.strokes[0].points;
        for pair in circle.windows(2) {
            let middle = pair[0].midpoint(pair[1]).to_vec2().hypot();
            assert!((middle - 100.0).abs() <= 1.01 * tolerance, "{tolerance}: {middle}");
        }
        assert_eq!(circle.first(), circle.last());
        assert!(circle.len() < 40 + (400.0 / tolerance.sqrt()) as usize);
        let wave = &file.strokes[1].points;
        assert!(
            [(0.0, 0.0), (100.0, 0.0), (200.0, 0.0), (300.0, 0.0), (400.0, 0.0)]
                .iter()
                .all(|p| wave.contains(&Point::from(*p)))
        );
    }
}

#[test]
fn svg_arcs_without_a_size_are_lines() {
    for radii in ["0 5", "5 0", "1e-320 1e-320", "1 1e-300", "1e-300 1"] {
        let file =
            good(&format!("<svg><path d=\"M1 1A{radii} 0 0 1 3 5\"/><path d=\"M1 1A{radii} 0 0 1 1 1h1\"/></svg>"));
        assert_eq!(points(&file.strokes[0]), [(1.0, 1.0), (3.0, 5.0)], "{radii}");
        assert_eq!(file.strokes[1].points.last(), Some(&Point::new(2.0, 1.0)), "{radii}");
    }
}

#[test]
fn svg_lengths_and_view_boxes_give_unit_and_scale() {
    let frame = |attributes: &str| {
        let file = good(&format!("<svg {attributes}><line x2=\"10\" y2=\"20\"/></svg>"));
        (file.unit, points(&file.strokes[0])[1])
    };
    assert_eq!(frame(""), (Unit::Px, (10.0, 20.0)));
    assert_eq!(frame("viewBox=\"-5 -5 100 100\""), (Unit::Px, (10.0, 20.0)));
    assert_eq!(frame("width=\"200\" height=\"300\" viewBox=\"7 7 100 100\""), (Unit::Px, (20.0, 40.0)));
    assert_eq!(frame("width=\"76.2mm\" height=\"50.8mm\" viewBox=\"0 0 76.2 50.8\""), (Unit::Mm, (10.0, 20.0)));
    assert_eq!(frame("width=\"100%\" viewBox=\"0 0 76.2 50.8\""), (Unit::Px, (10.0, 20.0)));
    let (unit, (x, _)) = frame("width=\"10in\" height=\"10in\"");
    assert!(unit == Unit::In && (x - 10.0 / 96.0).abs() < 1e-15);
    let inner = good(
        "<svg><svg x=\"5\" y=\"5\" width=\"40\" height=\"20\" viewBox=\"0 0 10 10\"><line x2=\"10\" y2=\"10\"/></svg></svg>",
    );
    assert_eq!(points(&inner.strokes[0]), [(15.0, 5.0), (35.0, 25.0)]);
}

#[test]
fn svg_keeps_every_bit_of_large_coordinates() {
    let file = good("<svg><path d=\"M1000000000.001 -999999999.999L1000000000.0012 0.1\"/></svg>");
    assert_eq!(points(&file.strokes[0]), [(1000000000.001, -999999999.999), (1000000000.0012, 0.1)]);
}

#[test]
fn svg_that_breaks_the_rules_is_refused_with_line_and_element() {
    let cases = [
        ("<svg><path d=\"M0 0", "cut off"),
        ("<html/>", "expected <svg>"),
        ("<svg>\n<path id=\"p\" d=\"M0 0L1\"/></svg>", "line 2, <path id=\"p\">: the path data are faulty"),
        ("<svg><path d=\"L1 1\"/></svg>", "path data"),
        ("<svg><path d=\"M0 0A1e-300 1e300 0 0 1 1 1\"/></svg>", "beyond"),
        ("<svg><polyline points=\"1 2 3\"/></svg>", "expected an even count"),
        ("<svg><polyline points=\"1 2 x\"/></svg>", "points are faulty"),
        ("<svg><g transform=\"rotate(\"><line/></g></svg>", "transform is faulty"),
        ("<svg><path d=\"M0 0C1e200 0 0 0 1 1\"/></svg>", "beyond"),
        ("<svg><g transform=\"scale(1e300)\"><path d=\"M0 0L1e300 1\"/></g></svg>", "not finite"),
        ("<svg><use href=\"#x\"/></svg>", "no element has that id"),
        ("<svg><use href=\"other.svg#x\"/></svg>", "outside the file"),
        ("<svg><g id=\"a\"><use href=\"#a\"/></g></svg>", "break the circle"),
        ("<svg><g id=\"a\"><use href=\"#b\"/></g><g id=\"b\"><use href=\"#a\"/></g></svg>", "break the circle"),
        ("<svg width=\"0\" viewBox=\"0 0 1 1\"/>", "expected positive lengths"),
    ];
    for (text, expected) in cases {
        let message = message(text, StrokeFormat::Svg);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn inkml_gives_traces_in_the_unit_of_their_channels() {
    let file = good(
        r##"<ink xmlns="http://www.w3.org/2003/InkML"><definitions><context xml:id="c"><inkSource xml:id="s"><traceFormat>
          <channel name="X" type="decimal" units="mm"/><channel name="Y" type="decimal" units="mm" orientation="-ve"/>
          <channel name="F" type="integer" max="1023"/><channel name="T" units="ms"/></traceFormat></inkSource></context></definitions>
          <traceGroup contextRef="#c"><trace xml:id="t0">1.5 2 1023 0, 3 4 0 250,</trace>
          <trace type="penUp">0 0 0 0</trace><trace>5 6 341 1000</trace></traceGroup></ink>"##,
    );
    assert_eq!((file.unit, file.y), (Unit::Mm, YAxis::Up));
    assert_eq!(names(&file), ["t0", "trace/1"]);
    assert_eq!(points(&file.strokes[0]), [(1.5, 2.0), (3.0, 4.0)]);
    assert_eq!(file.strokes[0].pressures, [1.0, 0.0]);
    assert_eq!(file.strokes[0].times_s, [0.0, 0.25]);
    assert_eq!(file.warnings.len(), 1);
}

#[test]
fn inkml_differences_are_decoded_as_in_the_standards_example() {
    // The example of section 3.2.1 of the recommendation, and the points that it says it means.
    let file =
        good("<ink><trace>1125 18432,'23'43,\"7\"-8,3-5,7 -3,6 2,6 8,3 6 T</trace></ink>".replace(" T", "").as_str());
    let expect = [
        (1125.0, 18432.0),
        (1148.0, 18475.0),
        (1178.0, 18510.0),
        (1211.0, 18540.0),
        (1251.0, 18567.0),
        (1297.0, 18596.0),
        (1349.0, 18633.0),
        (1404.0, 18676.0),
    ];
    assert_eq!(points(&file.strokes[0]), expect);
}

#[test]
fn inkml_continuations_are_one_stroke_and_unknown_pressures_are_scaled() {
    let file = good(
        r##"<ink><traceFormat><channel name="X"/><channel name="Y"/><channel name="F"/></traceFormat>
          <trace xml:id="a" continuation="begin">0 0 100,1 0 200</trace>
          <trace xml:id="b" continuation="end" priorRef="#a">2 0 400</trace></ink>"##,
    );
    assert_eq!(names(&file), ["a"]);
    assert_eq!(file.strokes[0].pressures, [0.25, 0.5, 1.0]);
    assert_eq!(file.warnings[0].code, "pressure-scaled");
}

#[test]
fn inkml_that_breaks_the_rules_is_refused_with_line_element_and_point() {
    let cases = [
        ("<ink>\n<trace id=\"q\">1 2, 3</trace></ink>", "line 2, <trace id=\"q\">, point 1: 1 values, expected 2"),
        ("<ink><trace>1 2 3</trace></ink>", "more than 2 values"),
        ("<ink><trace>1 zwei</trace></ink>", "\"zwei\" is no value"),
        ("<ink><trace>1 1e999</trace></ink>", "not a finite number"),
        ("<ink><traceFormat><channel name=\"X\"/></traceFormat><trace>1</trace></ink>", "no channel Y"),
        ("<svg/>", "expected <ink>"),
        ("<ink><trace>1 2", "cut off"),
    ];
    for (text, expected) in cases {
        let message = message(text, StrokeFormat::InkMl);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

// ---- GPX and GeoJSON ------------------------------------------------------------------------------------------------

const GPX: &str = r#"<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1">
  <wpt lat="46" lon="8"/>
  <trk><name>ridge</name>
    <trkseg>
      <trkpt lat="46.000" lon="8.000"><ele>500</ele><time>2024-05-17T08:30:00Z</time></trkpt>
      <trkpt lat="46.001" lon="8.000"><time>2024-05-17T08:30:10.5Z</time></trkpt>
    </trkseg>
    <trkseg><trkpt lat="46.001" lon="8.002"/><trkpt lat="46.000" lon="8.002"/></trkseg>
  </trk>
  <rte><rtept lat="46" lon="8.001"/><rtept lat="46.001" lon="8.001"/></rte>
</gpx>"#;

#[test]
fn gpx_tracks_and_routes_are_strokes_in_metres_with_y_up() {
    let file = read(GPX, None).unwrap();
    let names: Vec<&str> = file.strokes.iter().map(|s| s.name.as_str()).collect();
    assert_eq!(names, ["ridge/0", "ridge/1", "route/1"]);
    assert_eq!((file.unit, file.y), (Unit::M, YAxis::Up));
    assert_eq!((&file.strokes[0].times_s[..], file.strokes[1].times_s.len()), (&[0.0, 10.5][..], 0));
    // A thousandth of a degree: 111.15 m of meridian and 77.46 m of parallel at 46 degrees.
    let [a, b] = [0, 1].map(|i| file.strokes[0].points[i]);
    assert!((b.y - a.y - 111.15).abs() < 0.01 && (b.y + a.y).abs() < 1e-3, "{a:?} {b:?}");
    assert!((file.strokes[1].points[1].x - a.x - 2.0 * 77.46).abs() < 0.02, "{:?}", file.strokes[1].points);
    assert!(
        file.warnings.iter().any(|w| w.code == "projected" && w.text.contains("longitude 8.001")),
        "{:?}",
        file.warnings
    );
}

#[test]
fn geojson_lines_and_rings_are_strokes_under_the_names_of_their_features() {
    let text = r#"{"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"name": "road", "lanes": 2}, "geometry":
            {"type": "LineString", "coordinates": [[179.999, 10, 3], [-179.999, 10]]}},
        {"type": "Feature", "id": 7, "properties": null, "geometry":
            {"type": "Polygon", "coordinates": [[[180, 10], [180.001, 10], [180.001, 10.001], [180, 10]]]}},
        {"type": "Feature", "properties": {}, "geometry": null},
        {"type": "Feature", "properties": {}, "geometry": {"type": "Point", "coordinates": [0, 0]}}]}"#;
    for format in [None, Some(StrokeFormat::GeoJson), Some(StrokeFormat::Json)] {
        let file = read(text, format).unwrap();
        let names: Vec<&str> = file.strokes.iter().map(|s| s.name.as_str()).collect();
        assert_eq!(names, ["road", "7"]);
        // Across the 180th meridian it is as near as it is.
        let road = &file.strokes[0].points;
        assert!((road[1].x - road[0].x - 219.3).abs() < 0.1, "{road:?}");
        let codes: Vec<&str> = file.warnings.iter().map(|w| w.code.as_str()).collect();
        assert_eq!(codes, ["points-left-out", "projected"]);
    }
}

#[test]
fn faults_of_gpx_and_geojson_say_where_and_what_to_do() {
    let gpx = [
        ("<gpx><trk><trkseg><trkpt lat=\"1\"/></trkseg></trk></gpx>", "line 1, <trkpt>: there is no attribute lon"),
        ("<gpx><trk><trkseg><trkpt lat=\"one\" lon=\"2\"/></trkseg></trk></gpx>", "lat=\"one\" is no number"),
        ("<gpx><trk><trkseg><trkpt lat=\"5e6\" lon=\"2\"/></trkseg></trk></gpx>", "swapped, or in metres"),
        ("<gpx><trk><trkseg><trkpt lat=\"1\" lon=\"NaN\"/></trkseg></trk></gpx>", "longitude NaN is not within"),
        (
            "<gpx><trk><trkseg><trkpt lat=\"1\" lon=\"2\"><time>noon</time></trkpt></trkseg></trk></gpx>",
            "expected one such as 2024",
        ),
        ("<gpx><wpt lat=\"1\" lon=\"2\"/></gpx>", "no track or route"),
        ("<svg/>", "expected <gpx>"),
        ("<gpx><trk>", "cut off"),
    ];
    for (text, expected) in gpx {
        let message = message(text, StrokeFormat::Gpx);
        assert!(message.contains(expected), "{text}: {message}");
    }
    let line = |coordinates: &str| format!("{{\"type\":\"LineString\",\"coordinates\":{coordinates}}}");
    let geojson = [
        (line("[[1,2],[3]]"), "LineString, position 1: expected [longitude, latitude]"),
        (line("[[1,2],[\"3\",4]]"), "expected coordinates: numbers in lists"),
        (line("[1,2]"), "position 0: expected [longitude, latitude]"),
        (line("[[2600000,1200000]]"), "latitude 1200000 is not within"),
        (line("[[-170,0],[0,0],[170,0]]"), "split the file"),
        ("{\"type\":\"LineString\",\"coordinates\":[[1,2],[3".into(), "cut off"),
        ("{\"type\":\"LineString\"}".into(), "there are no coordinates"),
        ("{\"type\":\"Circle\"}".into(), "\"Circle\" is no type of GeoJSON"),
        ("{\"type\":\"FeatureCollection\",\"features\":[]}".into(), "no line or polygon"),
        (
            "{\"type\":\"LineString\",\"coordinates\":[[1,2],[3,4]],\"crs\":{\"properties\":{\"name\":\"EPSG:2056\"}}}"
                .into(),
            "reproject the file to WGS 84",
        ),
    ];
    for (text, expected) in geojson {
        let message = message(&text, StrokeFormat::GeoJson);
        assert!(message.contains(expected), "{text}: {message}");
    }
}

#[test]
fn the_content_tells_the_format_where_the_name_does_not() {
    let cases = [
        ("  \n{", Some(StrokeFormat::Json)),
        ("\u{feff}<?xml version=\"1.0\"?><svg>", Some(StrokeFormat::Svg)),
        ("<inkml:ink xmlns:inkml=\"x\">", Some(StrokeFormat::InkMl)),
        ("<?xml version=\"1.0\"?>\n<gpx version=\"1.1\">", Some(StrokeFormat::Gpx)),
        ("{\"type\": \"FeatureCollection\",", Some(StrokeFormat::GeoJson)),
        ("{\"type\": \"fairpath-strokes\", \"LineString\"", Some(StrokeFormat::Json)),
        ("-1 2", Some(StrokeFormat::Text)),
        ("x,y", Some(StrokeFormat::Text)),
        ("hello", None),
        ("", None),
    ];
    for (text, format) in cases {
        assert_eq!(StrokeFormat::from_content(text.as_bytes()), format, "{text}");
    }
    assert!(read("hello", None).unwrap_err().to_string().contains("fairpath-strokes 1"));
    assert!(read("", None).unwrap_err().to_string().contains("the file is empty"));
    assert!(read(b"\xff\xfe1\x002\x00", Some(StrokeFormat::Json)).unwrap_err().to_string().contains("UTF-16"));
    assert_eq!(StrokeFormat::from_path("a/b.SVG".as_ref()), Some(StrokeFormat::Svg));
}

/// Gives the same byte for ever.
struct Endless(u8);

impl Read for Endless {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        buffer.fill(self.0);
        Ok(buffer.len())
    }
}

#[test]
fn an_endless_line_and_an_endless_file_are_refused_early() {
    let options = ReadOptions::default();
    let error = read_strokes_from(Endless(b'1'), "pipe", Some(StrokeFormat::Text), &options).unwrap_err().to_string();
    assert!(error.contains("line 1") && error.contains("max_line_bytes"), "{error}");
    let mut options = ReadOptions::default();
    options.limits.max_bytes = 1 << 20;
    for format in [StrokeFormat::Json, StrokeFormat::Svg, StrokeFormat::InkMl] {
        let error = read_strokes_from(Endless(b' '), "pipe", Some(format), &options).unwrap_err().to_string();
        assert!(error.contains("more than 1048576 bytes") && error.contains("max_bytes"), "{error}");
    }
}

#[test]
fn limits_on_points_strokes_elements_and_depth_hold() {
    let mut options = ReadOptions::default();
    options.limits.max_points = 4;
    options.limits.max_items = 2;
    options.limits.max_nodes = 50;
    options.limits.max_depth = 8;
    let json = |strokes: &str| format!("{{\"format\":\"fairpath-strokes\",\"version\":1,\"strokes\":[{strokes}]}}");
    let cases = [
        (json("{\"points\":[[1,2],[1,2],[1,2],[1,2],[1,2]]}"), "max_points"),
        (json("{\"points\":[]},{\"points\":[]},{\"points\":[]}"), "max_items"),
        ("1 2\n1 2\n1 2\n1 2\n1 2\n".into(), "max_points"),
        ("1 2\n\n1 2\n\n1 2\n".into(), "max_items"),
        ("<svg><path d=\"M0 0C0 1 1 1 1 0\"/></svg>".into(), "max_points"),
        (format!("<svg>{}</svg>", "<g/>".repeat(60)), "max_nodes"),
        (format!("<svg>{}</svg>", "<path d=\"M1 1z\"/>".repeat(3)), "max_items"),
        (format!("{}{}", "<svg>".repeat(10), "</svg>".repeat(10)), "max_depth"),
        ("<ink><trace>1 2,1 2,1 2,1 2,1 2</trace></ink>".into(), "max_points"),
    ];
    for (text, limit) in cases {
        let error = read_strokes_from(text.as_bytes(), "drawing", None, &options).unwrap_err();
        assert!(matches!(&error, Error::OverLimit { limit: l, .. } if *l == limit), "{text}: {error}");
    }
    assert_ne!(options.limits, Limits::default());
}

#[test]
fn svg_bombs_are_refused() {
    let mut levels =
        String::from("<svg xmlns:xlink=\"http://www.w3.org/1999/xlink\"><g id=\"l0\"><line x2=\"1\"/></g>");
    for i in 1..40 {
        let uses = format!("<use xlink:href=\"#l{}\"/>", i - 1).repeat(10);
        levels += &format!("<g id=\"l{i}\">{uses}</g>");
    }
    let message_of = |text: &str| message(text, StrokeFormat::Svg);
    let mut options = ReadOptions::default();
    options.limits.max_nodes = 100_000;
    let error = read_strokes_from(format!("{levels}</svg>").as_bytes(), "bomb", None, &options).unwrap_err();
    assert!(error.to_string().contains("max_nodes"), "{error}");
    let laughs = "<!DOCTYPE svg [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;&a;&a;&a;\">]><svg><text>&b;</text></svg>";
    assert!(message_of(laughs).contains("entity"), "{}", message_of(laughs));
    let long = "x".repeat(1 << 20);
    let quadratic = format!("<!DOCTYPE svg [<!ENTITY a '{long}'>]><svg>{}</svg>", "<text>&a;</text>".repeat(1000));
    assert!(message_of(&quadratic).contains("max_bytes"));
    let mut options = ReadOptions::default();
    options.limits.max_bytes = 1 << 20;
    let idle = "M1 1".repeat(10_000);
    let busy = format!("<svg><path id=\"p\" d=\"{idle}\"/>{}</svg>", "<use href=\"#p\"/>".repeat(10_000));
    let error = read_strokes_from(busy.as_bytes(), "bomb", None, &options).unwrap_err();
    assert!(error.to_string().contains("counting every use"), "{error}");
    let deep = format!("{}{}", "<g>".repeat(100_000), "</g>".repeat(100_000));
    assert!(message_of(&format!("<svg>{deep}</svg>")).contains("max_depth"));
    let external =
        "<!DOCTYPE svg [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><svg><text>&x;</text><line x2=\"1\"/></svg>";
    assert!(read(external, None).is_err());
    let harmless =
        "<!DOCTYPE svg [<!ENTITY ns \"http://www.w3.org/2000/svg\">]><svg xmlns=\"&ns;\"><line x2=\"1\"/></svg>";
    assert_eq!(good(harmless).strokes.len(), 1);
}

#[test]
fn a_million_points_are_read_from_every_format() {
    let n = 1_000_000;
    let points: Vec<Point> = (0..n).map(|i| Point::new(f64::from(i) * 0.001 + 1e9, f64::from(i % 7) * 1e-3)).collect();
    let file = StrokeFile::new(vec![Stroke::new("long", points)]);
    for format in [StrokeFormat::Json, StrokeFormat::Text, StrokeFormat::Svg] {
        let bytes = encode_strokes(&file, format).unwrap();
        assert_eq!(read(&bytes, Some(format)).unwrap().strokes, file.strokes, "{format:?}");
    }
}

#[test]
fn what_a_format_cannot_hold_is_refused_when_writing() {
    let nan = StrokeFile::new(vec![Stroke::new("bad", vec![Point::new(0.0, f64::NAN)])]);
    let ragged = StrokeFile::new(vec![Stroke { times_s: vec![1.0], ..Stroke::new("bad", vec![Point::ZERO; 2]) }]);
    for format in [StrokeFormat::Json, StrokeFormat::Svg, StrokeFormat::Text] {
        for file in [&nan, &ragged] {
            let error = encode_strokes(file, format).unwrap_err().to_string();
            assert!(error.contains("stroke \"bad\""), "{error}");
        }
    }
    assert!(encode_strokes(&StrokeFile::default(), StrokeFormat::InkMl).is_err());
}

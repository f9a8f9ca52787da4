//! Terrains and the globe, against PROJ 9.7 (pyproj 3.7.2, whose numbers these are), and every plane of the register that can be computed.

use fairpath_curve::Point;
use fairpath_drive::GeoReference;
use fairpath_io::{ProjectionError, Projector, longitude_latitude, point_at};
use proptest::prelude::*;

fn at(projection: &str, origin_m: [f64; 2]) -> GeoReference {
    GeoReference { projection: projection.into(), epsg: None, origin_m }
}

/// Projection, longitude, latitude, easting, northing.
const KNOWN: [(&str, f64, f64, f64, f64); 11] = [
    ("+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs", 1.5, 42.5, 376_749.548_0, 4_706_383.170_5),
    ("+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs", 3.0, 0.0, 500_000.0, 0.0),
    ("+proj=utm +zone=31 +datum=WGS84 +units=m +no_defs", 0.5, 60.0, 360_577.911_5, 6_654_046.023_8),
    ("+proj=utm +zone=33 +south +datum=WGS84 +units=m +no_defs", 15.7, -33.3, 565_169.536_5, 6_315_235.654_4),
    ("+proj=utm +zone=17 +datum=WGS84 +units=m +no_defs", -79.387_139, 43.642_567, 630_084.300_8, 4_833_438.585_7),
    ("+proj=utm +zone=15 +datum=NAD83 +units=m +no_defs", -93.5, 46.5, 461_634.080_7, 5_149_724.792_8),
    // France, in its middle and at its edge.
    (LAMBERT_93, 2.2945, 48.8584, 648_237.301_5, 6_862_271.681_6),
    (LAMBERT_93, 7.4, 43.7, 1_054_581.295_4, 6_298_878.124_6),
    (
        "+proj=merc +a=6378137 +b=6378137 +lon_0=0 +units=m +nadgrids=@null +no_defs",
        7.4,
        43.7,
        823_764.231_9,
        5_419_133.259_4,
    ),
    (
        "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80 +towgs84=0,0,0 +units=m",
        10.0,
        50.0,
        4_321_000.0,
        2_987_510.567_0,
    ),
    // Antarctica.
    (
        "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=0 +k=1 +datum=WGS84 +units=m",
        10.0,
        -80.0,
        189_134.027_6,
        1_072_632.372_3,
    ),
];

const LAMBERT_93: &str =
    "+proj=lcc +lat_1=49 +lat_2=44 +lat_0=46.5 +lon_0=3 +x_0=700000 +y_0=6600000 +ellps=GRS80 +towgs84=0,0,0 +units=m";

#[test]
fn places_are_where_proj_has_them() {
    for (projection, longitude, latitude, east, north) in KNOWN {
        let reference = at(projection, [0.0; 2]);
        let found = point_at(&reference, [longitude, latitude]).unwrap();
        // The numbers above have four digits.
        assert!((found - Point::new(east, north)).hypot() < 1e-4, "{projection}: {found:?}");
        let [lambda, phi] = longitude_latitude(&reference, Point::new(east, north)).unwrap();
        assert!((lambda - longitude).abs().max((phi - latitude).abs()) < 2e-9, "{projection}: {lambda} {phi}");
    }
}

#[test]
fn datums_are_shifted_as_proj_does() {
    // Switzerland, Germany and Bohemia; PROJ's own way there and back is off by millimetres, since it loses the height between.
    for (projection, place, east, north) in [
        (
            "+proj=somerc +lat_0=46.95240555555556 +lon_0=7.439583333333333 +k_0=1 +x_0=2600000 +y_0=1200000 +ellps=bessel +towgs84=674.374,15.056,405.346,0,0,0,0 +units=m",
            [7.4386, 46.951],
            2_599_997.532_4,
            1_199_990.799_4,
        ),
        (
            "+proj=tmerc +lat_0=0 +lon_0=9 +k=1 +x_0=3500000 +y_0=0 +ellps=bessel +towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7 +units=m",
            [9.5, 51.2],
            3_535_021.036_1,
            5_674_015.079_9,
        ),
        (
            "+proj=krovak +lat_0=49.5 +lon_0=24.83333333333333 +alpha=30.28813972222222 +k=0.9999 +x_0=0 +y_0=0 +ellps=bessel +towgs84=589,76,480,0,0,0,0 +units=m",
            [14.42, 50.087],
            -742_911.810_7,
            -1_043_059.581_0,
        ),
    ] {
        let found = point_at(&at(projection, [0.0; 2]), place).unwrap();
        assert!((found - Point::new(east, north)).hypot() < 2e-3, "{projection}: {found:?}");
    }
}

#[test]
fn a_transverse_mercator_of_its_own_is_as_exact_as_utm_far_from_its_meridian() {
    // The grid of Great Britain without its datum, 3.5 and 4 degrees from its middle.
    let reference = at(
        "+proj=tmerc +lat_0=49 +lon_0=-2 +k=0.9996012717 +x_0=400000 +y_0=-100000 +ellps=airy +units=m +no_defs",
        [0.0; 2],
    );
    for (place, east, north) in
        [([1.5, 52.2], 639_144.711_9, 261_571.398_4), ([-6.0, 57.0], 157_112.381_0, 796_967.406_4)]
    {
        let found = point_at(&reference, place).unwrap();
        assert!((found - Point::new(east, north)).hypot() < 1e-4, "{found:?}");
    }
}

#[test]
fn what_is_no_plane_in_metres_is_refused_and_says_what_to_do() {
    for (projection, said) in [
        ("", "expected a PROJ string"),
        ("+proj=longlat +datum=WGS84", "no projection to a plane"),
        ("+proj=utm +zone=99", "+proj=utm +zone=99"),
        ("+proj=utm +zone=31 +units=us-ft", "its unit is"),
        ("+proj=nzmg +lat_0=-41 +lon_0=173", "nzmg"),
        ("+proj=utm +zone=31 +nadgrids=/etc/hostname", "not read"),
    ] {
        match Projector::new(&at(projection, [0.0; 2])) {
            Err(error @ ProjectionError::Unknown { .. }) => assert!(error.to_string().contains(said), "{error}"),
            other => panic!("{projection}: {other:?}"),
        }
    }
    assert!(Projector::new(&at("+proj=utm +zone=31", [f64::NAN, 0.0])).is_err());
    let reference = at("+proj=utm +zone=31 +datum=WGS84", [0.0; 2]);
    for odd in [[f64::NAN, 0.0], [0.0, 1e9], [1e300, 0.0]] {
        assert!(matches!(point_at(&reference, odd), Err(ProjectionError::Beyond { .. })), "{odd:?}");
        assert!(longitude_latitude(&reference, Point::new(f64::INFINITY, odd[1])).is_err());
    }
}

#[test]
fn every_plane_of_the_register_goes_there_and_back_or_says_why_not() {
    let (mut computed, mut exact) = (0_u32, 0_u32);
    for code in 0..=u16::MAX {
        let Some(definition) = crs_definitions::from_code(code) else { continue };
        let metres = definition.proj4.replace("+units=us-ft", "+units=m").replace("+units=ft", "+units=m");
        let Ok(projector) = Projector::new(&at(&metres, [0.0; 2])) else { continue };
        computed += 1;
        // Some 50 km from where the plane has its origin, which a few have far from where they are used.
        let number = |key: &str| {
            let value = metres.split_ascii_whitespace().find_map(|word| word.strip_prefix(key));
            value.and_then(|value| value.parse::<f64>().ok())
        };
        let utm = metres.contains("+proj=utm");
        let east = number("+x_0=").unwrap_or(if utm { 500_000.0 } else { 0.0 }) + 3e4;
        let north = number("+y_0=").unwrap_or(if utm { 5e6 } else { 0.0 }) + 4e4;
        let point = Point::new(east, north);
        let back = projector.longitude_latitude(point).and_then(|place| projector.point(place));
        exact += u32::from(back.is_ok_and(|back| (back - point).hypot() < 1e-6));
    }
    assert!(computed > 4500, "{computed}");
    assert!(f64::from(exact) > 0.99 * f64::from(computed), "{exact} of {computed}");
}

proptest! {
    #[test]
    fn a_point_of_a_zone_there_and_back_is_the_same_within_a_micrometre(
        zone in 1_u32..=60,
        south in any::<bool>(),
        east in 1e5..9e5,
        north in 1e4..9.3e6,
        x in -1e5..1e5,
        y in -1e5..1e5,
    ) {
        let half = if south { " +south" } else { "" };
        let reference = at(&format!("+proj=utm +zone={zone}{half} +datum=WGS84 +units=m +no_defs"), [east - x, north - y]);
        let projector = Projector::new(&reference).unwrap();
        let point = Point::new(x, y);
        let place = projector.longitude_latitude(point).unwrap();
        let back = projector.point(place).unwrap();
        prop_assert!((back - point).hypot() < 1e-6, "{point:?} {back:?}");
    }

    #[test]
    fn no_text_makes_it_fall_over(text in "( ?\\+(proj|zone|lat_0|lon_0|lat_1|k|x_0|ellps|a|b|rf|towgs84|units|datum|pm|axis|to_meter)=(utm|lcc|tmerc|omerc|[0-9.,-]{0,6}|m|wsu|1e99|nan))*", x in any::<f64>()) {
        let text = format!("+proj=lcc {text}");
        if let Ok(projector) = Projector::new(&at(&text, [0.0; 2])) {
            let _ = projector.longitude_latitude(Point::new(x, 1.0));
            let _ = projector.point([x, 1.0]);
            let _ = projector.longitude_latitude(Point::new(5e5, 1.0)).and_then(|place| projector.point(place));
        }
    }
}

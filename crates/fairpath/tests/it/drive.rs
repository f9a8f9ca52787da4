//! Roads on a terrain: scripts, projects, exports, checks and drives.

use super::{Ran, root, run, run_in};
use std::fs;
use std::io::BufReader;
use std::path::Path;
use tempfile::tempdir;

/// A script in a folder: two roads over hills that cross above each other.
fn script(folder: &Path) {
    let text = r#"{"format":"fairpath-drive-script","version":1,"commands":[
        {"do":"terrain","synthetic":"hills","size":257,"cell_m":4.0,"seed":5},
        {"do":"sketch","name":"a","points_m":[[100,500],[400,520],[900,480]]},
        {"do":"sketch","name":"b","points_m":[[500,100],[520,500],[480,900]]},
        {"do":"crossing","near_m":[520,510],"set":"over","path":"a"},
        {"do":"foliage","lasso_m":[[400,400],[600,400],[600,600],[400,600]],"density":0.5}]}"#;
    fs::write(folder.join("roads.json"), text).unwrap();
}

fn ran(folder: &Path, args: &[&str]) -> Ran {
    run_in(folder, args)
}

#[test]
fn a_script_gives_a_table_a_project_and_every_export() {
    let folder = tempdir().unwrap();
    script(folder.path());
    let exports = ["o.xodr", "o.xml", "o.glb", "o.csv"];
    let mut args = vec!["drive", "run", "roads.json", "--project", "o.fairpath"];
    for export in exports {
        args.extend(["--export", export]);
    }
    let table = ran(folder.path(), &args).ended(0);
    let lines: Vec<&str> = table.text().lines().collect();
    assert_eq!(lines.len(), 3, "{}", table.text());
    assert!(lines[0].starts_with("path") && lines[0].contains("max grade %") && lines[0].contains("cut m3"));
    assert!(lines[1].starts_with("a ") && lines[2].starts_with("b "));
    for export in exports {
        assert!(fs::metadata(folder.path().join(export)).unwrap().len() > 1000, "{export}");
    }
    // A terrain of nobody's survey lies nowhere on the globe.
    let refused = ran(folder.path(), &["drive", "run", "roads.json", "--export", "o.geojson"]).ended(2);
    assert!(refused.err.contains("lies nowhere on the globe"), "{}", refused.err);
    assert!(!folder.path().join("o.geojson").exists());
}

#[test]
fn a_project_opens_to_the_same_bytes() {
    let folder = tempdir().unwrap();
    script(folder.path());
    ran(folder.path(), &["drive", "run", "roads.json", "--project", "a.fairpath"]).ended(0);
    let again = ran(folder.path(), &["drive", "run", "a.fairpath", "--project", "b.fairpath"]).ended(0);
    assert_eq!(again.err, "");
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert!(bytes("a.fairpath") == bytes("b.fairpath"));
    // What was saved with the commands is compared with what follows from them.
    let changed = String::from_utf8(bytes("a.fairpath")).unwrap().replacen("\"seed\": 5", "\"seed\": 6", 1);
    fs::write(folder.path().join("c.fairpath"), changed).unwrap();
    let warned = ran(folder.path(), &["drive", "run", "c.fairpath"]).ended(0);
    assert!(warned.err.contains("not what was saved"), "{}", warned.err);
}

#[test]
fn a_project_finds_its_terrain_from_another_folder_and_standard_input_is_read_once() {
    let folder = tempdir().unwrap();
    let (scripts, projects) = (folder.path().join("scripts"), folder.path().join("projects/mine"));
    fs::create_dir_all(&scripts).unwrap();
    fs::create_dir_all(&projects).unwrap();
    let rows: Vec<String> =
        (0..40).map(|r| (0..40).map(|c| (r + c).to_string()).collect::<Vec<_>>().join(" ")).collect();
    let head = "ncols 40\nnrows 40\nxllcenter 0\nyllcenter 0\ncellsize 10\n";
    fs::write(scripts.join("hill.asc"), format!("{head}{}\n", rows.join("\n"))).unwrap();
    let text = r#"{"format":"fairpath-drive-script","version":1,"commands":[
        {"do":"terrain","file":"hill.asc"},
        {"do":"sketch","name":"a","points_m":[[50,200],[200,210],[350,190]]}]}"#;
    fs::write(scripts.join("a.json"), text).unwrap();
    let table =
        ran(folder.path(), &["drive", "run", "scripts/a.json", "--project", "projects/mine/a.fairpath"]).ended(0);
    let again = ran(&projects, &["drive", "run", "a.fairpath"]).ended(0);
    assert_eq!(again.text(), table.text());
    assert!(!again.err.contains("not what was saved"), "{}", again.err);
    // From standard input files lie beside the present folder; a project there is for a program alone.
    let piped = |folder: &Path, bytes: &[u8], args: &[&str]| {
        use std::io::Write;
        let mut child = super::command(args).current_dir(folder).stdin(std::process::Stdio::piped()).spawn().unwrap();
        child.stdin.take().unwrap().write_all(bytes).unwrap();
        child.wait_with_output().unwrap()
    };
    let project = fs::read(projects.join("a.fairpath")).unwrap();
    let out = piped(&projects, &project, &["drive", "run", "-", "--project", "-"]);
    assert!(out.status.success() && out.stdout == project, "{}", String::from_utf8_lossy(&out.stderr));
    let out = piped(&scripts, text.as_bytes(), &["drive", "run", "-"]);
    assert!(out.status.success() && out.stdout == table.out, "{}", String::from_utf8_lossy(&out.stderr));
}

#[test]
fn a_check_names_path_station_value_and_limit() {
    let folder = tempdir().unwrap();
    let text = r#"{"format":"fairpath-drive-script","version":1,"commands":[
        {"do":"terrain","synthetic":"hills","size":129,"cell_m":4.0,"seed":5},
        {"do":"sketch","name":"bend","points_m":[[100,100],[200,100],[220,110],[225,130],[225,300]],"min_radius_m":15},
        {"do":"speed","path":"bend","kmh":80}]}"#;
    fs::write(folder.path().join("bend.json"), text).unwrap();
    let checked = ran(folder.path(), &["drive", "check", "bend.json"]).ended(0);
    let radius = checked.text().lines().find(|l| l.contains("radius")).expect("the bend is too tight for 80 km/h");
    // 80² / 127 (0.08 + 0.14) m.
    assert!(radius.starts_with("bend") && radius.contains("229.1") && radius.ends_with("m"), "{radius}");
    ran(folder.path(), &["drive", "check", "bend.json", "--strict"]).ended(1);
}

#[test]
fn a_drive_is_told_over_time() {
    let folder = tempdir().unwrap();
    script(folder.path());
    let args = ["drive", "play", "roads.json", "--path", "a", "--step", "0.5", "--camera", "chase"];
    let driven = ran(folder.path(), &args).ended(0);
    let rows: Vec<Vec<f64>> =
        driven.text().lines().skip(1).map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    assert!(rows.len() > 50 && rows.iter().all(|row| row.len() == 15));
    for pair in rows.windows(2) {
        let [a, b] = [&pair[0], &pair[1]];
        let (time, way) = (b[0] - a[0], b[1] - a[1]);
        assert!(time > 0.0 && way > 0.0);
        // No faster than 60 km/h, and no gain or loss beyond what is comfortable.
        assert!(b[8] <= 60.0 / 3.6 + 1e-9 && (b[8] - a[8]).abs() <= 1.2 * time + 1e-9, "{a:?} {b:?}");
        assert!((way / time - 0.5 * (a[8] + b[8])).abs() < 0.2, "{a:?} {b:?}");
    }
    let wrong = ran(folder.path(), &["drive", "play", "roads.json", "--path", "c"]).ended(2);
    assert!(wrong.err.contains("there is no path \"c\"; there are a, b"), "{}", wrong.err);
}

#[test]
fn earthwork_adds_up_to_the_table() {
    let folder = tempdir().unwrap();
    script(folder.path());
    let rows = ran(folder.path(), &["drive", "earthwork", "roads.json", "--path", "a", "--every", "50"]).ended(0);
    let rows: Vec<Vec<&str>> = rows.text().lines().skip(1).map(|line| line.split(',').collect()).collect();
    let sum = |i: usize| rows.iter().map(|row| row[i].parse::<f64>().unwrap()).sum::<f64>();
    let table = ran(folder.path(), &["drive", "run", "roads.json"]).ended(0);
    let cells: Vec<&str> = table.text().lines().nth(1).unwrap().split_whitespace().collect();
    // path, length, curves, radius, grade, lowest, highest, cut, fill
    assert!(rows.len() > 10 && rows.iter().all(|row| row[0] == "a"));
    assert_eq!([sum(3), sum(4)].map(|x| format!("{x:.0}")), [cells[7], cells[8]]);
}

#[test]
fn bad_scripts_are_refused_by_place_and_nothing_is_written() {
    let folder = tempdir().unwrap();
    let head = r#"{"format":"fairpath-drive-script","version":1,"commands":["#;
    let hills = r#"{"do":"terrain","synthetic":"hills","size":65,"cell_m":8.0}"#;
    let cases = [
        (String::new(), "the file is empty"),
        (r#"{"format":"fairpath-edits","version":1,"commands":[]}"#.to_owned(), "expected \"fairpath-drive-script\""),
        (format!("{head}]}}"), "it lays no terrain"),
        (format!("{head}{{\"do\":\"fly\"}}]}}"), "command 1 (fly)"),
        (format!("{head}{{\"do\":\"sketch\",\"points_m\":[[0,0],[9,9]]}}]}}"), "there is no terrain yet"),
        (format!("{head}{{\"do\":\"terrain\",\"file\":\"no.tif\"}}]}}"), "no.tif"),
        (format!("{head}{hills},{{\"do\":\"sketch\",\"points_m\":[[0,0]]}}]}}"), "command 2 (sketch)"),
        (format!("{head}{hills},{{\"do\":\"sketch\",\"points_m\":[[1e300,0],[1,1]]}}]}}"), "within ±1e9 m"),
        (format!("{head}{hills},{{\"do\":\"sketch\",\"points_m\":[[5,5],[5,5]]}}]}}"), "becomes no path"),
        (
            format!("{head}{hills},{{\"do\":\"speed\",\"path\":\"x\",\"kmh\":50}}]}}"),
            "there is no path \"x\"; there are none",
        ),
        (format!("{head}{hills},{hills}]}}"), "there is a terrain already"),
        (format!("{head}{hills},{{\"do\":\"crossing\",\"near_m\":[9,9],\"set\":\"over\"}}]}}"), "no crossing"),
        (
            format!("{head}{hills},{{\"do\":\"foliage\",\"lasso_m\":[[0,0],[9,0],[9,9]],\"density\":7}}]}}"),
            "density is 7; expected 0 to 1",
        ),
        (
            format!("{head}{hills},{{\"do\":\"sketch\",\"section\":\"moat\",\"points_m\":[[9,9],[99,99]]}}]}}"),
            "two-lane, four-lane",
        ),
        (
            format!("{head}{hills},{{\"do\":\"sketch\",\"name\":\" \",\"points_m\":[[9,9],[99,99]]}}]}}"),
            "must not be empty",
        ),
        (format!("{head}{hills},{{\"do\":\"play\",\"path\":\"x\"}}]}}"), "command 2 (play): there is no path \"x\""),
        (format!("{head}{hills},{{\"do\":\"import\",\"file\":\"l.csv\",\"only\":\"x\"}}]}}"), "is named \"x\""),
        (
            format!("{head}{hills},{{\"do\":\"import\",\"file\":\"l.csv\",\"offset_m\":[9000,0]}}]}}"),
            "none of its 1 lines lies on the terrain",
        ),
        (format!("{head}{hills},{{\"do\":\"import\",\"file\":\"l.csv\",\"shortest_m\":900}}]}}"), "shortest_m"),
        (format!("{head}{hills},{{\"do\":\"import\",\"file\":\"l.gpx\"}}]}}"), "lies nowhere on the globe"),
        (head.to_owned(), "cut off"),
    ];
    fs::write(folder.path().join("l.csv"), "100 100\n200 110\n300 100\n").unwrap();
    let gpx = r#"<gpx><trk><trkseg><trkpt lon="1" lat="42"/><trkpt lon="1.01" lat="42"/></trkseg></trk></gpx>"#;
    fs::write(folder.path().join("l.gpx"), gpx).unwrap();
    for (text, said) in cases {
        fs::write(folder.path().join("s.json"), &text).unwrap();
        let refused = ran(folder.path(), &["drive", "run", "s.json", "--project", "p.fairpath"]).ended(2);
        assert!(refused.err.contains(said), "{text}: {}", refused.err);
        assert!(!folder.path().join("p.fairpath").exists());
    }
    let refused = ran(folder.path(), &["drive", "run", "s.json", "--export", "a.doc"]).ended(2);
    assert!(refused.err.contains("xodr, xml, glb, geojson, csv"), "{}", refused.err);
}

/// Lines of every kind lie where they were drawn, in metres with y to the north.
#[test]
fn imports_come_in_metres_the_right_way_up() {
    let folder = tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("plain.csv", "100 100\n200 100\n300 150\n");
    write("feet.csv", "# unit: ft\n# y: up\n400 400\n700 400\n1000 500\n");
    write(
        "down.svg",
        r#"<svg xmlns="http://www.w3.org/2000/svg"><polyline points="100 -300 200 -300 300 -350"/></svg>"#,
    );
    let import = |file: &str| format!("{{\"do\":\"import\",\"file\":\"{file}\",\"name\":\"{file}\"}}");
    let script = format!(
        "{{\"format\":\"fairpath-drive-script\",\"version\":1,\"commands\":[{{\"do\":\"terrain\",\"synthetic\":\"hills\",\"size\":129,\"cell_m\":4.0}},{},{},{}]}}",
        import("plain.csv"),
        import("feet.csv"),
        import("down.svg"),
    );
    write("s.json", &script);
    ran(folder.path(), &["drive", "run", "s.json", "--export", "o.csv"]).ended(0);
    let table = fs::read_to_string(folder.path().join("o.csv")).unwrap();
    for (name, begin, end) in [
        ("plain.csv", [100.0, 100.0], [300.0, 150.0]),
        ("feet.csv", [121.92, 121.92], [304.8, 152.4]),
        ("down.svg", [100.0, 300.0], [300.0, 350.0]),
    ] {
        let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
        let own: Vec<_> = rows.iter().filter(|row| row[0] == name).collect();
        for (row, place) in [(own[0], begin), (own[own.len() - 1], end)] {
            let at = [2, 3].map(|i| row[i].parse::<f64>().unwrap());
            assert!((0..2).all(|i| (at[i] - place[i]).abs() < 3.0), "{name}: {at:?} for {place:?}");
        }
    }
}

/// Bare numbers are a terrain once a script says what they are.
#[test]
fn raw_terrains_are_told_by_the_script() {
    let folder = tempdir().unwrap();
    // A slope that rises by 2 m from one column to the next.
    let numbers: Vec<u8> =
        (0..60).flat_map(|_| (0..80_u16).flat_map(|column| (200 + 2 * column).to_be_bytes())).collect();
    fs::write(folder.path().join("t.raw"), numbers).unwrap();
    let script = |raw: &str| {
        let text = format!(
            "{{\"format\":\"fairpath-drive-script\",\"version\":1,\"commands\":[{{\"do\":\"terrain\",\"file\":\"t.raw\",\"cell_m\":10.0{raw}}},{{\"do\":\"sketch\",\"name\":\"a\",\"points_m\":[[100,300],[700,300]]}}]}}"
        );
        fs::write(folder.path().join("s.json"), text).unwrap();
    };
    script(r#","raw":{"columns":80,"rows":60,"sample":"u16","big_endian":true}"#);
    ran(folder.path(), &["drive", "run", "s.json", "--export", "o.csv"]).ended(0);
    let table = fs::read_to_string(folder.path().join("o.csv")).unwrap();
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|l| l.split(',').skip(1).filter_map(|x| x.parse().ok()).collect()).collect();
    // x, and the ground below it.
    assert!(rows.len() > 50 && rows.iter().all(|row| (row[4] - (200.0 + 0.2 * row[1])).abs() < 1e-3), "{table}");
    for (raw, said) in [("", "(`raw`)"), (r#","raw":{"columns":80,"rows":61,"sample":"u16"}"#, "are 9760")] {
        script(raw);
        let refused = ran(folder.path(), &["drive", "run", "s.json"]).ended(2);
        assert!(refused.err.contains(said), "{}", refused.err);
    }
}

/// A picture shows what there is where it is: asphalt on green ground below a sky, and the driver's road in the middle.
#[test]
fn pictures_show_the_network_from_four_places() {
    let folder = tempdir().unwrap();
    script(folder.path());
    let (width, height) = (320, 200);
    for camera in ["birdseye", "midway", "closeup", "driver"] {
        let args = ["drive", "render", "roads.json", "-o", "p.png", "--camera", camera, "--size", "320x200"];
        ran(folder.path(), &args).ended(0);
        let file = fs::File::open(folder.path().join("p.png")).unwrap();
        let mut reader = png::Decoder::new(BufReader::new(file)).read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        assert_eq!((info.width, info.height, info.color_type), (width, height, png::ColorType::Rgb));
        let colour = |x: u32, y: u32| {
            let at = 3 * (y * width + x) as usize;
            [0, 1, 2].map(|k| i32::from(bytes[at + k]))
        };
        let all: Vec<[i32; 3]> =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| colour(x, y)).collect();
        let share = |is: &dyn Fn(&[i32; 3]) -> bool| all.iter().filter(|c| is(c)).count() as f64 / all.len() as f64;
        let green = share(&|[r, g, b]| *g > r + 12 && *g > b + 12);
        let asphalt = share(&|[r, g, b]| (r - g).abs() < 16 && (g - b).abs() < 16 && *r < 110);
        assert!(green > 0.1, "{camera}: {green} of it is green");
        // From high above a road is thinner than a pixel.
        assert!(asphalt > if camera == "driver" { 0.15 } else { 0.0003 }, "{camera}: {asphalt} of it is asphalt");
        if camera == "driver" {
            let [r, g, b] = colour(width / 2, height - 2);
            assert!((r - g).abs() < 16 && (g - b).abs() < 16 && r < 130, "{r} {g} {b}");
            let [r, _, b] = colour(width / 2, 1);
            assert!(b > r, "the sky is {r}, {b}");
        }
    }
    for (size, said) in [("0x10", "1 to 8192 pixels"), ("9000x10", "1 to 8192 pixels"), ("10", "such as 1280x720")] {
        let args = ["drive", "render", "roads.json", "-o", "no.png", "--size", size];
        let refused = ran(folder.path(), &args).ended(2);
        assert!(refused.err.contains(said), "{}", refused.err);
        assert!(!folder.path().join("no.png").exists());
    }
}

#[test]
fn where_there_is_no_path_formats_that_need_one_say_so() {
    let folder = tempdir().unwrap();
    let text = r#"{"format":"fairpath-drive-script","version":1,"commands":[
        {"do":"terrain","synthetic":"hills","size":65,"cell_m":4.0}]}"#;
    fs::write(folder.path().join("s.json"), text).unwrap();
    let refused = ran(folder.path(), &["drive", "run", "s.json", "--export", "o.xodr"]).ended(2);
    assert!(refused.err.contains("OpenDRIVE has at least one"), "{}", refused.err);
    assert!(!folder.path().join("o.xodr").exists());
    ran(folder.path(), &["drive", "run", "s.json", "--export", "o.xml", "--export", "o.glb"]).ended(0);
    let landxml = fs::read_to_string(folder.path().join("o.xml")).unwrap();
    assert!(!landxml.contains("<Alignments"));
}

#[test]
fn the_examples_run_on_real_terrains() {
    let data = root().join("../shared/data");
    if !data.is_dir() && std::env::var_os("CI").is_none() {
        return;
    }
    let pass = run(&["drive", "run", "examples/drive/pass-road.json"]).ended(0);
    let line = pass.text().lines().nth(1).unwrap().to_owned();
    let cells: Vec<&str> = line.split_whitespace().collect();
    // The name has two words; the length is that of the road in OpenStreetMap.
    let length: f64 = cells[2].parse().unwrap();
    assert!((length - 5490.0).abs() < 60.0, "{line}");
}

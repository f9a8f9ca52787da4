//! The number of threads changes nothing but the time.

use super::{command, folder, root, run};
use std::fs;

#[test]
fn any_number_of_threads_gives_the_same_bytes() {
    let inputs = ["examples/hello.json", "examples/leaf.svg", "examples/spiral.csv", "examples/note.inkml"];
    let fit = |threads: &str, format: &str| {
        let mut args = vec!["fit"];
        args.extend(inputs);
        args.extend(["-o", "-", "--format", format, "--no-times", "--threads", threads]);
        run(&args).ended(0).out
    };
    for (format, others) in [("json", &["0", "2", "7"][..]), ("csv", &["3"]), ("dxf", &["5"])] {
        let one = fit("1", format);
        for threads in others {
            assert!(fit(threads, format) == one, "{threads} threads, {format}");
        }
    }
}

#[test]
fn times_are_all_that_differs_between_runs() {
    let fit = || {
        let mut file = run(&["fit", "examples/hello.json", "-o", "-", "--format", "json"]).ended(0).json();
        for spline in file["splines"].as_array_mut().unwrap() {
            spline["report"].as_object_mut().unwrap().remove("ms").expect("times are reported");
        }
        file
    };
    assert_eq!(fit(), fit());
}

#[test]
fn a_network_is_the_same_with_any_number_of_threads() {
    let folder = folder();
    let names = ["net.xodr", "net.glb", "net.xml", "net.csv", "net.geojson"];
    let exports = |threads: &str| -> Vec<Vec<u8>> {
        let script = root().join("examples/drive/farm.json");
        let mut args = vec!["drive", "run", script.to_str().expect("a path in UTF-8")];
        args.extend(names.iter().flat_map(|name| ["--export", name]));
        let output = command(&args).current_dir(folder.path()).env("RAYON_NUM_THREADS", threads).output();
        let output = output.expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        names.iter().map(|name| fs::read(folder.path().join(name)).expect("it was written")).collect()
    };
    let one = exports("1");
    assert!(one.iter().all(|bytes| bytes.len() > 100));
    for threads in ["2", "5"] {
        for (name, (a, b)) in names.iter().zip(one.iter().zip(exports(threads))) {
            assert!(*a == b, "{threads} threads, {name}");
        }
    }
}

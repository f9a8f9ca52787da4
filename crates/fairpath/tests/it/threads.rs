//! The number of threads changes nothing but the time.

use super::run;

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

//! A file has its name only when it is whole.

use crate::support::*;
use std::fs;

#[test]
fn a_plot_is_a_picture_of_the_kind_asked_for() {
    let folder = folder("plot_kinds");
    file(&folder, "small.toml", SMALL);
    for name in ["a.svg", "a.png"] {
        let output = starl(&folder, &["run", "small.toml", "--quiet", "--plot", name]);
        assert_eq!(status(&output), 0, "{}", stderr(&output));
    }
    let svg = fs::read_to_string(folder.join("a.svg")).expect("the picture was drawn");
    assert!(svg.contains("<svg") && svg.trim_end().ends_with("</svg>"));
    assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
    for name in ["holonomic0", "holonomic1"] {
        assert!(svg.contains(name), "the legend names {name}");
    }
    let png = fs::read(folder.join("a.png")).expect("the picture was drawn");
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!(&png[png.len() - 8..png.len() - 4], b"IEND");
    assert_eq!(names(&folder), ["a.png", "a.svg", "small.toml"]);
}

#[test]
fn a_run_that_cannot_start_keeps_existing_files() {
    let folder = folder("plot_kept");
    file(&folder, "small.toml", SMALL);
    file(&folder, "a.svg", "a picture of before");
    let output = starl(
        &folder,
        &[
            "run",
            "small.toml",
            "--plot",
            "a.svg",
            "--trace",
            "none/a.mcap",
        ],
    );
    assert_eq!(status(&output), 2);
    let kept = fs::read_to_string(folder.join("a.svg")).expect("it is still there");
    assert_eq!(kept, "a picture of before");
    assert_eq!(names(&folder), ["a.svg", "small.toml"]);
}

#[test]
fn two_outputs_do_not_share_a_file() {
    let folder = folder("plot_shared");
    for trace in ["a.svg", "./a.svg", "../plot_shared/a.svg"] {
        let arguments = ["run", "race", "--plot", "a.svg", "--trace", trace];
        let output = starl(&folder, &arguments);
        assert_eq!(status(&output), 2, "{trace}");
        assert!(
            stderr(&output).contains("the same file"),
            "{trace}: {}",
            stderr(&output)
        );
    }
}

#[test]
fn inputs_of_a_run_are_not_overwritten() {
    let folder = folder("output_reads");
    let scenario = SMALL.replace("[world]", "[world]\nfiles = [\"some.wpt\"]");
    file(&folder, "small.toml", &scenario);
    file(&folder, "some.wpt", "// nothing\n");
    file(&folder, "faults.toml", "");
    for trace in ["small.toml", "some.wpt", "./faults.toml"] {
        let arguments = ["run", "small.toml", "--faults", "faults.toml"];
        let output = starl(&folder, &[&arguments[..], &["--trace", trace]].concat());
        assert_eq!(status(&output), 2, "{trace}");
        assert!(
            stderr(&output).contains("the run reads this file"),
            "{trace}: {}",
            stderr(&output)
        );
    }
    let kept = fs::read_to_string(folder.join("small.toml")).expect("it is still there");
    assert_eq!(kept, scenario);
    assert_eq!(names(&folder), ["faults.toml", "small.toml", "some.wpt"]);
}

/// A program that violates its property.
const VIOLATED: &str = "program Small\n\nn: Int = 0\n\nstep: enum {begin, end} = begin\n\ngo()\n    pre n < 3\n    \
                        eff n += 1\n\nalways small: n < 2\n";

#[test]
fn neither_a_drawing_nor_a_counterexample_takes_the_place_of_its_program() {
    let folder = folder("output_program");
    file(&folder, "small.starl", VIOLATED);
    for arguments in [
        ["explain", "small.starl", "--output", "small.starl"],
        ["explore", "small.starl", "--save", "./small.starl"],
        ["explore", "small.starl", "--save", "small.starl"],
    ] {
        let output = starl(&folder, &arguments);
        assert_eq!(status(&output), 2, "{arguments:?}");
        let told = stderr(&output);
        assert!(told.contains("the run reads this file"), "{told}");
    }
    let kept = fs::read_to_string(folder.join("small.starl")).expect("it is still there");
    assert_eq!(kept, VIOLATED);
    assert_eq!(names(&folder), ["small.starl"]);
}

#[test]
fn a_counterexample_that_cannot_be_saved_leaves_the_report() {
    let folder = folder("output_report");
    file(&folder, "small.starl", VIOLATED);
    // The name of a counterexample is longer, too long for a file.
    let target = format!("{}.toml", "y".repeat(240));
    let scenario = "program = \"small.starl\"\n[[robots]]\nmodel = \"create\"\n";
    file(&folder, &target, scenario);
    let arguments = ["test", &target, "--profile", "calm", "--seeds", "1"];
    let output = starl(&folder, &arguments);
    let (told, trouble) = (stdout(&output), stderr(&output));
    assert_eq!(status(&output), 1, "{trouble}");
    assert!(trouble.contains("cannot be written"), "{trouble}");
    assert!(told.contains("to find it again: "), "{told}");
}

#[test]
fn a_read_only_file_is_kept() {
    let folder = folder("output_read_only");
    let path = file(&folder, "a.mcap", "a trace of before");
    let mut permissions = fs::metadata(&path).expect("it is there").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).expect("it is the test's own");
    let output = starl(&folder, &["run", "race", "--trace", "a.mcap"]);
    assert_eq!(status(&output), 2);
    assert!(stderr(&output).contains("a.mcap: cannot be written"));
    let kept = fs::read_to_string(path).expect("it is still there");
    assert_eq!(kept, "a trace of before");
}

#[cfg(unix)]
#[test]
fn a_link_remains_a_link() {
    let folder = folder("output_link");
    file(&folder, "real.svg", "a picture of before");
    std::os::unix::fs::symlink("real.svg", folder.join("a.svg")).expect("links can be made");
    let output = starl(&folder, &["run", "race", "--quiet", "--plot", "a.svg"]);
    assert_eq!(stderr(&output), "");
    let link = fs::symlink_metadata(folder.join("a.svg")).expect("it is still there");
    assert!(link.is_symlink());
    let real = fs::read_to_string(folder.join("real.svg")).expect("it is there");
    assert!(real.contains("<svg"), "{real}");
}

#[cfg(target_os = "linux")]
#[test]
fn output_that_cannot_be_written_is_reported() {
    let folder = folder("output_full");
    for arguments in [&["run", "race", "--json"][..], &["list"]] {
        let full = fs::File::options().write(true).open("/dev/full");
        let output = command(&folder, arguments)
            .stdout(full.expect("Linux has one"))
            .output()
            .expect("the command was built");
        assert_eq!(status(&output), 2, "{arguments:?}");
        let text = stderr(&output);
        assert!(
            text.contains("standard output") && text.contains("full"),
            "{arguments:?}: {text}"
        );
    }
}

#[cfg(unix)]
#[test]
fn a_closed_reader_is_not_an_error() {
    use std::process::Stdio;
    let folder = folder("output_closed");
    let mut run = command(&folder, &["run", "race", "--duration", "1s"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the command was built");
    drop(run.stdout.take());
    let output = run.wait_with_output().expect("it ends");
    assert_eq!((status(&output), stderr(&output)), (1, String::new()));
}

#[test]
#[cfg(unix)]
fn a_trace_can_go_through_a_pipe_to_a_program_that_reads_it() {
    let folder = folder("trace_through_pipe");
    file(&folder, "small.toml", SMALL);
    let run = |trace: &str| starl(&folder, &["run", "small.toml", "--quiet", "--trace", trace]);
    assert_eq!(status(&run("file.mcap")), 0);
    let pipe = folder.join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()));
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe).expect("the pipe can be read")
    });
    let output = run("pipe");
    // If the run has not opened the pipe, its reader must not wait for it.
    let _ = fs::File::options().read(true).write(true).open(&pipe);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    let whole = fs::read(folder.join("file.mcap")).expect("the trace was written");
    let read = reader.join().expect("the reader ends");
    assert_eq!(read.len(), whole.len(), "the same trace");
}

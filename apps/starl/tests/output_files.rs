//! A file has its name only when it is whole.

mod support;
use std::fs;
use support::*;

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
fn a_run_that_cannot_start_leaves_what_was_there() {
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
    let output = starl(
        &folder,
        &["run", "race", "--plot", "a.svg", "--trace", "a.svg"],
    );
    assert_eq!(status(&output), 2);
    assert!(
        stderr(&output).contains("the same file"),
        "{}",
        stderr(&output)
    );
}

//! `starl fmt` formats programs, and never loses one.

use crate::support::*;
use std::fs;
use std::path::Path;

const UNTIDY: &str = "program Untidy\nx :Int=0   // a comment\nstep( )\n  pre x<3\n  eff x+=1\n";
const TIDY: &str =
    "program Untidy\n\nx: Int = 0  // a comment\n\nstep()\n    pre x < 3\n    eff x += 1\n";
const BROKEN: &str = "program Broken\nx :Int=0\nstep( )\n  pre (x<3\n  eff x+=1\n";

fn content(folder: &Path, name: &str) -> String {
    fs::read_to_string(folder.join(name)).expect("it is there")
}

#[test]
fn a_file_is_formatted_in_place() {
    let folder = folder("fmt_file");
    file(&folder, "untidy.starl", UNTIDY);
    let output = starl(&folder, &["fmt", "untidy.starl"]);
    assert_eq!(stdout(&output), "formatted untidy.starl\n");
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(content(&folder, "untidy.starl"), TIDY);
    assert_eq!(names(&folder), ["untidy.starl"], "nothing else is left");
    let again = starl(&folder, &["fmt", "untidy.starl"]);
    assert_eq!((status(&again), stdout(&again)), (0, String::new()));
}

#[test]
fn check_lists_files_that_would_change_and_changes_nothing() {
    let folder = folder("fmt_check");
    file(&folder, "tidy.starl", TIDY);
    file(&folder, "untidy.starl", UNTIDY);
    let output = starl(&folder, &["fmt", "--check", "."]);
    assert_eq!(stdout(&output), "untidy.starl\n");
    assert_eq!(status(&output), 1);
    assert_eq!(content(&folder, "untidy.starl"), UNTIDY);
    let tidy = starl(&folder, &["fmt", "--check", "tidy.starl"]);
    assert_eq!((status(&tidy), stdout(&tidy)), (0, String::new()));
}

#[test]
fn standard_input_goes_to_standard_output() {
    let folder = folder("fmt_input");
    for text in [UNTIDY, TIDY] {
        let output = starl_reading(&folder, &["fmt", "-"], text);
        assert_eq!((status(&output), stdout(&output).as_str()), (0, TIDY));
    }
    let check = starl_reading(&folder, &["fmt", "--check", "-"], UNTIDY);
    assert_eq!(stdout(&check), "standard input\n");
    assert_eq!(status(&check), 1);
}

#[test]
fn a_file_with_syntax_errors_is_not_changed() {
    let folder = folder("fmt_broken");
    file(&folder, "broken.starl", BROKEN);
    file(&folder, "untidy.starl", UNTIDY);
    let output = starl(&folder, &["fmt", "broken.starl", "untidy.starl"]);
    assert_eq!(status(&output), 1);
    let text = stderr(&output);
    assert!(text.contains("error[E0109]"), "{text}");
    assert!(
        text.contains("broken.starl: has errors, and is left as it is"),
        "{text}"
    );
    assert_eq!(content(&folder, "broken.starl"), BROKEN);
    assert_eq!(content(&folder, "untidy.starl"), TIDY);
}

#[test]
fn broken_standard_input_gives_nothing() {
    let folder = folder("fmt_broken_input");
    let output = starl_reading(&folder, &["fmt", "-"], BROKEN);
    assert_eq!((status(&output), stdout(&output)), (1, String::new()));
}

#[cfg(unix)]
#[test]
fn permissions_and_links_are_kept() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = folder("fmt_permissions");
    let path = file(&folder, "untidy.starl", UNTIDY);
    fs::set_permissions(&path, fs::Permissions::from_mode(0o750)).expect("it is ours");
    symlink("untidy.starl", folder.join("link.starl")).expect("a link can be made");
    let output = starl(&folder, &["fmt", "link.starl"]);
    assert_eq!(status(&output), 0, "{}", stderr(&output));
    assert_eq!(content(&folder, "untidy.starl"), TIDY);
    let mode = fs::metadata(&path).expect("it is there").permissions();
    assert_eq!(mode.mode() & 0o777, 0o750);
    let link = fs::symlink_metadata(folder.join("link.starl")).expect("it is there");
    assert!(link.file_type().is_symlink());
}

#[cfg(unix)]
#[test]
fn a_file_that_cannot_be_written_is_reported() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder("fmt_read_only");
    let path = file(&folder, "untidy.starl", UNTIDY);
    fs::set_permissions(&path, fs::Permissions::from_mode(0o444)).expect("it is ours");
    let output = starl(&folder, &["fmt", "untidy.starl", "missing.starl"]);
    assert_eq!(status(&output), 2);
    let text = stderr(&output);
    assert!(
        text.contains("untidy.starl: cannot be written: permission denied"),
        "{text}"
    );
    assert!(text.contains("missing.starl: cannot be read"), "{text}");
    assert_eq!(content(&folder, "untidy.starl"), UNTIDY);
    assert_eq!(names(&folder), ["untidy.starl"]);
}

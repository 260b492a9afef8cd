//! Jumps go where their condition says.

use crate::machine_support::{int, of_floats};
use starl_lang::machine::Fault;

/// Whether the jump is made.
fn jumps(jump: &str, arguments: &[i64]) -> bool {
    let body = format!("{jump} @there\n int r0 0\n jump @end\nthere:\n int r0 1\nend:");
    int(&body, arguments) == Ok(1)
}

fn jumps_floats(jump: &str, arguments: &[f64]) -> bool {
    let body = format!("{jump} @there\n int r0 0\n jump @end\nthere:\n int r0 1\nend:");
    of_floats(&body, arguments) == Ok(1)
}

#[test]
fn on_truth() {
    assert!(jumps("jump", &[]));
    for condition in [0, 1] {
        assert_eq!(jumps("jump_if r0", &[condition]), condition != 0);
        assert_eq!(jumps("jump_unless r0", &[condition]), condition == 0);
    }
}

#[test]
fn on_ints() {
    for (left, right) in [(1, 2), (2, 1), (2, 2), (-3, 3), (i64::MIN, i64::MAX)] {
        let pair = [left, right];
        assert_eq!(jumps("jump_if_equal r0 r1", &pair), left == right);
        assert_eq!(jumps("jump_if_not_equal r0 r1", &pair), left != right);
        assert_eq!(jumps("jump_if_less r0 r1", &pair), left < right);
        assert_eq!(jumps("jump_if_less_equal r0 r1", &pair), left <= right);
    }
    for left in [-6, -5, -4, 0, i64::MAX] {
        assert_eq!(jumps("jump_if_equal_constant r0 -5", &[left]), left == -5);
        assert_eq!(
            jumps("jump_if_not_equal_constant r0 -5", &[left]),
            left != -5
        );
        assert_eq!(jumps("jump_if_less_constant r0 -5", &[left]), left < -5);
        assert_eq!(
            jumps("jump_unless_less_constant r0 -5", &[left]),
            left >= -5
        );
    }
}

#[test]
fn on_floats() {
    for (left, right) in [(1.0, 2.0), (2.0, 1.0), (2.0, 2.0), (f64::NAN, 1.0)] {
        let pair = [left, right];
        let (less, less_equal) = (left < right, left <= right);
        assert_eq!(jumps_floats("jump_if_less_float r0 r1", &pair), less);
        assert_eq!(jumps_floats("jump_unless_less_float r0 r1", &pair), !less);
        assert_eq!(
            jumps_floats("jump_if_less_equal_float r0 r1", &pair),
            less_equal
        );
        assert_eq!(
            jumps_floats("jump_unless_less_equal_float r0 r1", &pair),
            !less_equal
        );
    }
}

#[test]
fn a_loop_counts_up_to_its_limit() {
    let body = "copy r3 r0\n int r2 0\nagain:\n add_int r2 r2 r3\n loop r3 r1 @again\n copy r0 r2";
    assert_eq!(int(body, &[3, 6]), Ok(3 + 4 + 5));
    // Its body runs once before it looks at the limit.
    assert_eq!(int(body, &[3, 0]), Ok(3));
    let overflow = "again:\n loop r0 r1 @again";
    assert_eq!(int(overflow, &[i64::MAX, i64::MAX]), Err(Fault::Overflow));
}

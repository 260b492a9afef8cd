//! Instructions on lists.

use crate::machine_support::{call, ints, numbers, program};
use starl_lang::machine::{Fault, List, Object};

const DECLARATIONS: &str = "
type Text
type List[Int]
type List[Float]
type List[Point]
type List[{name: type0, place: Point}]
type Set[Int]
";

/// Runs a body on the list in `b0`, with three Ints in `r0` to `r2` and a second list in `b1`; returns the list.
fn list(body: &str, arguments: [i64; 3], lists: [&[i64]; 2]) -> Result<Vec<i64>, Fault> {
    let code = format!(
        "{DECLARATIONS} function test function (Int, Int, Int, type1, type1) (type1) \
         registers 8 objects 4\n{body}\n return #1 #4"
    );
    match call(
        &program(&code),
        &arguments.map(|n| n as u64),
        &lists.map(ints),
    ) {
        Ok((_, objects)) => Ok(numbers(&objects[0])),
        Err(error) => Err(error.fault),
    }
}

fn scalar(body: &str, arguments: [i64; 3], lists: [&[i64]; 2]) -> Result<i64, Fault> {
    let code = format!(
        "{DECLARATIONS} function test function (Int, Int, Int, type1, type1) (Int) \
         registers 8 objects 4\n{body}\n return_scalar r0 #4"
    );
    match call(
        &program(&code),
        &arguments.map(|n| n as u64),
        &lists.map(ints),
    ) {
        Ok((scalars, _)) => Ok(scalars[0] as i64),
        Err(error) => Err(error.fault),
    }
}

fn out_of_range(index: i64, length: u32) -> Fault {
    Fault::IndexOutOfRange { index, length }
}

#[test]
fn elements() {
    let three: [&[i64]; 2] = [&[10, 20, 30], &[]];
    assert_eq!(scalar("list_get b0 r0 r0 b0", [2, 0, 0], three), Ok(30));
    assert_eq!(
        list("list_set b0 r0 r1 b0", [1, 7, 0], three),
        Ok(vec![10, 7, 30])
    );
    assert_eq!(
        list("list_add b0 r0 b0 type1", [5, 0, 0], three),
        Ok(vec![10, 20, 30, 5])
    );
    assert_eq!(
        list("list_insert b0 r0 r1 b0 type1", [0, 7, 0], three),
        Ok(vec![7, 10, 20, 30])
    );
    assert_eq!(
        list("list_insert b0 r0 r1 b0 type1", [3, 7, 0], three),
        Ok(vec![10, 20, 30, 7])
    );
    assert_eq!(
        list("list_remove_at b0 r0", [1, 0, 0], three),
        Ok(vec![10, 30])
    );
    assert_eq!(scalar("size r0 b0", [0; 3], three), Ok(3));
    assert_eq!(scalar("size r0 b1", [0; 3], three), Ok(0));
}

#[test]
fn indices_out_of_range() {
    let three: [&[i64]; 2] = [&[10, 20, 30], &[]];
    for index in [-1, 3, i64::MAX, i64::MIN] {
        for body in [
            "list_get b0 r0 r0 b0",
            "list_set b0 r0 r1 b0",
            "list_remove_at b0 r0",
        ] {
            let result = list(&format!("{body}\n"), [index, 0, 0], three);
            assert_eq!(result, Err(out_of_range(index, 3)), "{body}");
        }
    }
    let insert = list("list_insert b0 r0 r1 b0 type1", [4, 0, 0], three);
    assert_eq!(insert, Err(out_of_range(4, 3)));
    let empty = scalar(
        "clear_object b0 type1\n list_get b0 r0 r0 b0",
        [0; 3],
        three,
    );
    assert_eq!(empty, Err(out_of_range(0, 0)));
}

#[test]
fn whole_lists() {
    let lists: [&[i64]; 2] = [&[3, 1, 2, 1], &[9, 8]];
    assert_eq!(
        list("list_append b0 b1", [0; 3], lists),
        Ok(vec![3, 1, 2, 1, 9, 8])
    );
    assert_eq!(
        list("list_append b0 b0", [0; 3], lists),
        Ok(vec![3, 1, 2, 1, 3, 1, 2, 1])
    );
    assert_eq!(
        list("clear_object b0 type1\n list_append b0 b1", [0; 3], lists),
        Ok(vec![9, 8])
    );
    assert_eq!(list("list_reverse b0", [0; 3], lists), Ok(vec![1, 2, 1, 3]));
    assert_eq!(
        list("list_sort b0 type1", [0; 3], lists),
        Ok(vec![1, 1, 2, 3])
    );
    assert_eq!(
        list("list_slice b0 r0 r1", [1, 3, 0], lists),
        Ok(vec![1, 2])
    );
    assert_eq!(
        list(
            "list_sort_by b0 b1 type1",
            [0; 3],
            [&[7, 5, 6, 8], &[2, 1, 2, 1]]
        ),
        Ok(vec![5, 8, 7, 6])
    );
    assert_eq!(
        list("list_sort_by b0 b1 type1", [0; 3], lists),
        Ok(vec![1, 3]),
        "only the first two have a key"
    );
    assert_eq!(list("list_slice b0 r0 r1", [4, 4, 0], lists), Ok(vec![]));
    assert_eq!(
        list("list_slice b0 r0 r1", [2, 5, 0], lists),
        Err(out_of_range(5, 4))
    );
    assert_eq!(
        list("list_slice b0 r0 r1", [3, 2, 0], lists),
        Err(out_of_range(2, 4))
    );
    assert_eq!(
        list("list_slice b0 r0 r1", [-1, 2, 0], lists),
        Err(out_of_range(-1, 4))
    );
}

#[test]
fn finding() {
    let lists: [&[i64]; 2] = [&[3, 1, 2, 1], &[]];
    let found = "list_find r3 b0 r0 b0 type1\n multiply_constant r3 r3 10\n add_int r0 r3 r4";
    assert_eq!(scalar(found, [1, 0, 0], lists), Ok(11));
    assert_eq!(scalar(found, [2, 0, 0], lists), Ok(12));
    assert_eq!(scalar(found, [7, 0, 0], lists), Ok(0));
}

#[test]
fn sums() {
    assert_eq!(scalar("sum_int r0 b0", [0; 3], [&[3, -1, 2], &[]]), Ok(4));
    assert_eq!(scalar("sum_int r0 b1", [0; 3], [&[3, -1, 2], &[]]), Ok(0));
    assert_eq!(
        scalar("sum_int r0 b0", [0; 3], [&[i64::MAX, 1], &[]]),
        Err(Fault::Overflow)
    );
    let code = format!(
        "{DECLARATIONS} function test function (type2) (Float) registers 1 objects 1\n\
         sum_float r0 b0\n return_scalar r0 #1"
    );
    let floats = List::of_scalars([0.5f64, 0.25].map(f64::to_bits).to_vec());
    let (sum, _) = call(&program(&code), &[], &[floats.into()]).expect("no error");
    assert_eq!(f64::from_bits(sum[0]), 0.75);
}

#[test]
fn order_and_equality() {
    for (left, right) in [
        (&[1, 2][..], &[1, 2][..]),
        (&[1, 2], &[1, 3]),
        (&[1], &[1, 0]),
        (&[], &[-1]),
    ] {
        let equal = scalar("equal_object r0 b0 b1 type1", [0; 3], [left, right]);
        assert_eq!(equal, Ok(i64::from(left == right)));
        let less = scalar("less_object r0 b0 b1 type1", [0; 3], [left, right]);
        assert_eq!(less, Ok(i64::from(left < right)));
    }
}

#[test]
fn a_changed_copy_leaves_the_original() {
    let body = "copy_object b2 b0\n list_set b2 r0 r1 b0\n list_get b0 r0 r0 b0";
    assert_eq!(scalar(body, [0, 99, 0], [&[1, 2], &[]]), Ok(1));
    let body = "move_object b2 b0\n size r0 b0\n size r1 b2\n multiply_constant r1 r1 10\n add_int r0 r0 r1";
    assert_eq!(scalar(body, [0; 3], [&[1, 2], &[]]), Ok(20));
}

#[test]
fn elements_of_several_scalars_and_objects() {
    // Adds ("a", (x, x, x)) and ("b", (y, y, y)), puts the second in place of the first, reads it.
    let code = format!(
        "{DECLARATIONS} text \"a\"\n text \"b\"\n\
         function test function (Float, Float) (Point, type0) registers 8 objects 3\n\
         copy r4 r0\n copy r5 r0\n copy r6 r0\n load_text b1 t0\n clear_object b2 type4\n\
         list_add b2 r4 b1 type4\n\
         copy r4 r1\n copy r5 r1\n copy r6 r1\n load_text b1 t1\n list_add b2 r4 b1 type4\n\
         int r7 0\n list_set b2 r7 r4 b1\n\
         load_text b1 t0\n list_get b2 r7 r0 b0\n return #1 #3"
    );
    let arguments = [1.5f64, 2.5].map(f64::to_bits);
    let (scalars, objects) = call(&program(&code), &arguments, &[]).expect("no error");
    assert_eq!(scalars, [2.5f64.to_bits(); 3]);
    assert_eq!(objects, [Object::from("b")]);
}

#[test]
fn sorting_keeps_the_order_of_equals_and_sets_lose_them() {
    let body = "set_of_list b1 b0 type5\n list_of_set b0 b1 type1";
    assert_eq!(
        list(body, [0; 3], [&[3, 1, 2, 1, 3], &[]]),
        Ok(vec![1, 2, 3])
    );
    let empty = "clear_object b0 type1\n set_of_list b1 b0 type5\n list_of_set b0 b1 type1";
    assert_eq!(list(empty, [0; 3], [&[3], &[]]), Ok(vec![]));
}

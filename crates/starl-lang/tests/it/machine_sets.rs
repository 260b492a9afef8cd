//! Instructions on sets: elements are there once and in order.

use crate::machine_support::{call, ints, numbers, program};
use starl_core::Random;
use starl_lang::machine::List;
use std::collections::BTreeSet;

const DECLARATIONS: &str = "type Set[Int]\n type Set[Point]\n";

fn set(body: &str, element: i64, sets: [&[i64]; 2]) -> Vec<i64> {
    let code = format!(
        "{DECLARATIONS} function test function (Int, type0, type0) (type0) registers 2 objects 2\n\
         {body}\n return #1 #2"
    );
    let (_, objects) = call(&program(&code), &[element as u64], &sets.map(ints)).expect("no error");
    numbers(&objects[0])
}

fn contains(element: i64, elements: &[i64]) -> bool {
    let code = format!(
        "{DECLARATIONS} function test function (Int, type0) (Bool) registers 2 objects 1\n\
         set_contains r0 b0 r0 b0 type0\n return_scalar r0 #1"
    );
    let (scalars, _) =
        call(&program(&code), &[element as u64], &[ints(elements)]).expect("no error");
    scalars[0] == 1
}

#[test]
fn adding_and_removing() {
    let add = "set_add b0 r0 b0 type0";
    assert_eq!(set(add, 2, [&[], &[]]), [2]);
    assert_eq!(set(add, 2, [&[1, 3], &[]]), [1, 2, 3]);
    assert_eq!(set(add, 3, [&[1, 3], &[]]), [1, 3]);
    assert_eq!(set(add, -3, [&[1, 3], &[]]), [-3, 1, 3]);
    let remove = "set_remove b0 r0 b0 type0";
    assert_eq!(set(remove, 1, [&[1, 3], &[]]), [3]);
    assert_eq!(set(remove, 2, [&[1, 3], &[]]), [1, 3]);
    assert!(set(&format!("clear_object b0 type0\n {remove}"), 2, [&[1], &[]]).is_empty());
    for element in 0..5 {
        assert_eq!(contains(element, &[1, 3]), [1, 3].contains(&element));
        assert!(!contains(element, &[]));
    }
}

#[test]
fn two_sets() {
    let (unite, intersect, subtract) = (
        "set_unite b0 b1 type0",
        "set_intersect b0 b1 type0",
        "set_subtract b0 b1 type0",
    );
    let mut random = Random::keyed(1, &[0]);
    for _ in 0..100 {
        let mut draw = || -> BTreeSet<i64> {
            let count = random.below(8);
            (0..count)
                .map(|_| i64::from(random.below(10)) - 5)
                .collect()
        };
        let (left, right) = (draw(), draw());
        let lists: [Vec<i64>; 2] = [&left, &right].map(|set| set.iter().copied().collect());
        let run = |body| set(body, 0, [&lists[0], &lists[1]]);
        let sorted = |set: BTreeSet<i64>| -> Vec<i64> { set.into_iter().collect() };
        assert_eq!(run(unite), sorted(&left | &right));
        assert_eq!(run(intersect), sorted(&left & &right));
        assert_eq!(run(subtract), sorted(&left - &right));
    }
    assert_eq!(set("set_intersect b0 b0 type0", 0, [&[1, 2], &[]]), [1, 2]);
    assert!(set("set_subtract b0 b0 type0", 0, [&[1, 2], &[]]).is_empty());
}

#[test]
fn points_are_ordered_by_their_coordinates() {
    let code = format!(
        "{DECLARATIONS} function test function (Point, Point, Point, Point) (type1) \
         registers 12 objects 1\n\
         clear_object b0 type1\n set_add b0 r0 b0 type1\n set_add b0 r3 b0 type1\n\
         set_add b0 r6 b0 type1\n set_add b0 r9 b0 type1\n return #1 #1"
    );
    // As bits, negative numbers would come last, and the two zeros would differ.
    let points = [
        [1.0, 0.0, 0.0],
        [-2.0, 5.0, 0.0],
        [-0.0, 1.0, 0.0],
        [0.0, 1.0, -0.0],
    ];
    let arguments: Vec<u64> = points.iter().flatten().map(|c: &f64| c.to_bits()).collect();
    let (_, objects) = call(&program(&code), &arguments, &[]).expect("no error");
    let scalars = objects[0].list().map(List::scalars).expect("a set");
    let coordinates: Vec<f64> = scalars.iter().map(|&bits| f64::from_bits(bits)).collect();
    assert_eq!(coordinates, [-2.0, 5.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]);
}

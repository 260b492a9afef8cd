//! The functions of the standard library with more than linear cost still end in one activation for fleets and shapes
//! of ordinary size.

use crate::robot_support::World;
use starl_lang::check::{StandardLibraries, check};
use starl_lang::compile::compile;
use starl_lang::robot::Code;

/// Runs statements once, on the first of so many robots; gives what became of it.
fn run(robots: u32, import: &str, statements: &str) -> Option<String> {
    let text = format!(
        "program Example\n\nimport {import}\n\nfunction around(i: Int) -> Point = Point(cos(2.4 * Float(i)), sin(2.4 * Float(i))) * sqrt(Float(i))\n\ninit\n{statements}"
    );
    let checked = check(&text, &StandardLibraries);
    assert_eq!(checked.diagnostics(), [], "{text}");
    let bytecode = compile(&checked).unwrap_or_else(|problems| panic!("{problems:?}"));
    let code = Code::load(bytecode).unwrap_or_else(|error| panic!("{error}"));
    let world = World::of(&code, robots);
    world.failure(0).map(String::from)
}

#[test]
fn the_hull_of_two_hundred_points() {
    let statements = "    let hull = geometry.hull([around(i) for i in 0..200])\n    if hull.size() < 3 or hull.size() > 50 then fail(String(hull.size()))\n";
    assert_eq!(run(1, "geometry", statements), None);
}

#[test]
fn a_hundred_points_by_distance() {
    let statements = "    let sorted = geometry.by_distance([around(i) for i in 0..100], Point(0.0, 0.0))\n    if sorted[99] != around(99) then fail(String(sorted))\n";
    assert_eq!(run(1, "geometry", statements), None);
}

#[test]
fn places_for_fifty_robots() {
    let statements = "    let all = [r for r in peers]\n    let positions = {all[i]: around(i) for i in 0..50}\n    let given = fleet.places(positions, [around(i) * 2.0 for i in 0..50])\n    if given.size() != 50 then fail(String(given))\n";
    assert_eq!(run(50, "fleet", statements), None);
}

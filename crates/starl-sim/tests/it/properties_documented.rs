//! Every property that is checked has its section in the reference, and every section its property.

use starl_sim::Scenario;
use starl_sim::properties::{Setting, checkers};

const REFERENCE: &str = include_str!("../../../../docs/reference/properties.md");

#[test]
fn the_reference_has_a_section_for_each_property() {
    let setting = Setting {
        walls: 0,
        bodies: Vec::new(),
        obstacles: Vec::new(),
    };
    let checked: Vec<&str> = checkers(&Scenario::default(), &setting)
        .iter()
        .flat_map(|checker| checker.properties())
        .copied()
        .collect();
    let sections = REFERENCE.lines().filter_map(|line| {
        let name = line.strip_prefix("## `")?;
        name.strip_suffix('`')
    });
    assert_eq!(sections.collect::<Vec<_>>(), checked);
}

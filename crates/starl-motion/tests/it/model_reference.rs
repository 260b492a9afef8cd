//! The reference page on models lists every parameter of every model as the code has it.

use starl_motion::models::KINDS;

const PAGE: &str = include_str!("../../../../docs/reference/models.md");

#[test]
fn every_parameter_is_documented_with_its_default_and_range() {
    for kind in KINDS {
        let heading = format!("\n## {}\n", kind.name);
        let (_, rest) = PAGE.split_once(&heading).expect(kind.name);
        let section = rest.split("\n## ").next().unwrap_or(rest);
        let rows = section.lines().filter(|line| line.starts_with("| `"));
        assert_eq!(rows.count(), kind.fields.len(), "{}", kind.name);
        for field in kind.fields {
            let row = format!(
                "| `{}` | {} | {} | {} to {} |",
                field.name, field.unit, field.default, field.low, field.high
            );
            assert!(section.contains(&row), "{}: no row {row}", kind.name);
        }
    }
}

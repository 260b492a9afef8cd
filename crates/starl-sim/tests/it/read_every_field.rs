//! Every field of the schema makes a difference to the scenario that is read.

use crate::reading::{self, fields};
use starl_sim::read::{self, Override};

#[test]
fn every_field_makes_a_difference() {
    let files = fields::files();
    let read = |set: Option<&(String, String)>| {
        let mut request = reading::request(fields::FULL, &[]);
        request.overrides = set
            .iter()
            .map(|(path, value)| Override::named("--set", path, value))
            .collect();
        match read::scenario(&request, &files) {
            Ok(resolved) => format!("{:#?}", resolved.scenario),
            Err(problems) => panic!("{set:?}: {problems}"),
        }
    };
    let plain = read(None);
    let mut count = 0;
    fields::walk(&mut |path, field| {
        let set = fields::sample(path, field);
        assert!(read(Some(&set)) != plain, "{set:?} changes nothing");
        count += 1;
    });
    assert!(count > 90, "only {count} fields were tried");
}

//! `docs/reference/scenario.md` lists exactly the fields that the reader knows, with their kinds and
//! defaults. `BLESS=1` rewrites its tables.

#![allow(clippy::disallowed_methods)] // the test reads files

use starl_sim::read::schema::{Field, Kind, SCENARIO};

/// The tables of fields, each with the path it belongs to; the whole scenario's first.
fn tables(path: &str, fields: &'static [Field], out: &mut Vec<(String, String)>) {
    let mut table =
        "| field | holds | default | meaning |\n| --- | --- | --- | --- |\n".to_string();
    for Field {
        name,
        kind,
        default,
        about,
    } in fields
    {
        let (kind, default) = (kind.describe(), default.describe());
        table += &format!("| `{name}` | {kind} | {default} | {about} |\n");
    }
    let place = out.len();
    out.push((path.to_string(), table));
    for field in fields
        .iter()
        .filter(|field| !field.kind.fields().is_empty())
    {
        let name = match field.kind {
            Kind::Tables(_) => format!("[[{}]]", field.name),
            _ => field.name.to_string(),
        };
        let below = match path {
            "" => name,
            path => format!(
                "{}.{name}",
                path.trim_start_matches('[').trim_end_matches(']')
            ),
        };
        let below = match field.kind {
            Kind::Tables(_) => format!("[[{}]]", below.replace(['[', ']'], "")),
            _ => below,
        };
        // Corners are the same everywhere and are described in the text.
        if !field
            .kind
            .fields()
            .iter()
            .all(|field| matches!(field.name, "low" | "high"))
        {
            tables(&below, field.kind.fields(), out);
        }
    }
    assert!(place < out.len());
}

#[test]
fn the_reference_lists_every_field() {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../docs/reference/scenario.md"
    );
    let mut page = std::fs::read_to_string(path).unwrap();
    let mut expected = Vec::new();
    tables("", SCENARIO, &mut expected);
    let write = std::env::var_os("BLESS").is_some();
    let mut markers = 0;
    for (name, table) in &expected {
        let marker = format!(
            "<!-- fields of {} -->\n",
            if name.is_empty() { "a scenario" } else { name }
        );
        let begin = page
            .find(&marker)
            .unwrap_or_else(|| panic!("the page has no {marker}"))
            + marker.len();
        let length: usize = page[begin..]
            .lines()
            .take_while(|line| line.starts_with('|'))
            .map(|line| line.len() + 1)
            .sum();
        if write {
            page.replace_range(begin..begin + length, table);
        }
        let found = &page[begin..begin + if write { table.len() } else { length }];
        assert_eq!(found, table, "the table after {marker}");
        markers += 1;
    }
    assert_eq!(
        page.matches("<!-- fields of ").count(),
        markers,
        "a table of no section"
    );
    if write {
        std::fs::write(path, page).unwrap();
    }
}

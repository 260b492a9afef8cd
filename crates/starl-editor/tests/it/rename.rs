//! A rename changes every name of one thing and nothing else, or is refused with the reason.

use crate::support::{Beside, at_cursor, cursor, edited};
use starl_editor::{Analysis, RenameError};
use starl_lang::check::{Libraries, StandardLibraries};

/// The text after renaming what is at the cursor, or why it keeps its name.
fn renamed_with(text: &str, name: &str, libraries: &dyn Libraries) -> Result<String, RenameError> {
    let (text, at) = cursor(text);
    let analysis = Analysis::new(&text, libraries);
    let found = analysis.renameable(at)?;
    let renamed = analysis.rename(found.symbol, name, libraries)?;
    let own = renamed.iter().find(|file| file.file == 0);
    Ok(own.map_or(text.clone(), |file| edited(&text, &file.edits)))
}

fn renamed(text: &str, name: &str) -> Result<String, RenameError> {
    renamed_with(text, name, &StandardLibraries)
}

fn refused(text: &str, name: &str) -> String {
    renamed(text, name)
        .expect_err("it keeps its name")
        .to_string()
}

const COUNTER: &str = "program P
limit_of: Int = 3
count$0: Int = 0
/// count
go()
    pre count < limit_of
    eff count += 1; emit(\"count\", count = count)
invariant few: forall r: r.count <= 3
";

#[test]
fn all_names_of_a_variable_change() {
    let after = "program P
limit_of: Int = 3
number: Int = 0
/// count
go()
    pre number < limit_of
    eff number += 1; emit(\"count\", count = number)
invariant few: forall r: r.number <= 3
";
    assert_eq!(renamed(COUNTER, "number").as_deref(), Ok(after));
}

#[test]
fn to_its_own_name_changes_nothing() {
    let same = COUNTER.replace("$0", "");
    assert_eq!(renamed(COUNTER, "count"), Ok(same));
}

#[test]
fn invalid_names_are_rejected() {
    for name in ["", "1a", "a b", "a-b", "\u{e4}", "a\n"] {
        let reason = refused(COUNTER, name);
        assert!(reason.contains("is not a name"), "{reason}");
    }
    assert_eq!(refused(COUNTER, "if"), "`if` is a keyword");
    assert_eq!(refused(COUNTER, "_"), "`_` stands for an unused value");
}

#[test]
fn a_name_that_is_taken_is_refused() {
    assert_eq!(
        refused(COUNTER, "limit_of"),
        "`count` cannot become `limit_of`: the name `limit_of` is taken (line 3)"
    );
    let reason = refused(COUNTER, "Point");
    assert!(reason.contains("`Point` is a built-in name"), "{reason}");
}

#[test]
fn a_name_that_would_hide_another_is_refused() {
    let text = "program P\nfunction double(x: Int) -> Int\n    let y$0 = x + x\n    return y + x\n";
    assert_eq!(
        refused(text, "x"),
        "`y` cannot become `x`: the name `x` is taken (line 3)"
    );
}

#[test]
fn a_name_that_captures_others_is_rejected() {
    let text = "program P\nenum A {one, two}\nenum B {three$0, four}\na: A = two\ngo()\n    eff emit(\"x\", a = one, b = four); a = two\n    pre a == two\nb: B = three\n";
    let reason = refused(text, "one");
    assert!(
        reason.contains("several enums have a variant `one`"),
        "{reason}"
    );
    // A variable that every program has would be hidden without a word.
    let text =
        "program P\nfast$0: Bool\ngo()\n    pre not fast and heading > 0.0\n    eff fast = true\n";
    let reason = refused(text, "heading");
    assert!(
        reason.starts_with("`fast` cannot become `heading`"),
        "{reason}"
    );
}

#[test]
fn a_local_and_a_variant_do_not_get_mixed_up() {
    let text = "program P\nenum Location {init, pick}\nloc: Location = init\ngo()\n    pre loc == init\n    eff\n        let n$0 = 3\n        loc = pick\n        log(\"{}\", n)\n";
    assert_eq!(
        refused(text, "pick").split(':').next(),
        Some("`n` cannot become `pick`")
    );
}

#[test]
fn built_in_names_cannot_be_renamed() {
    let reason = refused("program P\nx: Float = ab$0s(2.0)\n", "b");
    assert_eq!(reason, "this is a name that every program has");
    let reason = refused("program P\nx: Si$0de? = bumped\n", "b");
    assert_eq!(reason, "`Side` is a name that every program has");
    let reason = refused("program P\nrole a\n    go()\n        eff ro$0le = a\n", "b");
    assert_eq!(reason, "`role` is a name that every program has");
    let reason = refused("program P\nimport geo$0metry\n", "b");
    assert_eq!(reason, "the library `geometry` has the name of its file");
    assert_eq!(
        refused("program P\n$0\n", "b"),
        "there is no known name here"
    );
}

#[test]
fn an_input_is_renamed_in_every_role_except_the_input_of_waypoints() {
    let text = "program P\non input go$0(to: Point)\n    log(\"{}\", to)\nrole a\n    on input go(to: Point)\n        log(\"a {}\", to)\n";
    let after = "program P\non input walk(to: Point)\n    log(\"{}\", to)\nrole a\n    on input walk(to: Point)\n        log(\"a {}\", to)\n";
    assert_eq!(renamed(text, "walk").as_deref(), Ok(after));
    let reason = refused("program P\non input way_$0points()\n    stop()\n", "b");
    assert_eq!(
        reason,
        "`way_points` is an input that every program may hear"
    );
}

#[test]
fn a_field_of_an_input_keeps_its_name_where_another_role_would_differ() {
    let text = "program P\non input go(to$0: Point)\n    log(\"{}\", to)\n";
    let after = "program P\non input go(place: Point)\n    log(\"{}\", place)\n";
    assert_eq!(renamed(text, "place").as_deref(), Ok(after));
    let role = "role a\n    on input go(to: Point)\n        log(\"a {}\", to)\n";
    let reason = refused(&[text, role].concat(), "place");
    assert!(reason.contains("have different fields"), "{reason}");
}

#[test]
fn a_name_of_unknown_meaning_is_not_renamed() {
    let text = "program P\ncount$0: Int = 0\ngo()\n    eff count = 1\n) count +\nstop_it()\n    eff count = 1\n";
    let reason = refused(text, "number");
    assert!(reason.ends_with("fix the errors first"), "{reason}");
}

#[test]
fn errors_elsewhere_do_not_matter() {
    let text = "program P\ncount$0: Int = 0\ngo()\n    eff count = 1; other = 2\n";
    let after = "program P\nnumber: Int = 0\ngo()\n    eff number = 1; other = 2\n";
    assert_eq!(renamed(text, "number").as_deref(), Ok(after));
}

#[test]
fn fields_parameters_and_roles() {
    let text = "program P\nrecord R {x$0: Int}\nr: R = R(x = 1)\ngo()\n    eff r.x = r.x + 1\n";
    let after = "program P\nrecord R {amount: Int}\nr: R = R(amount = 1)\ngo()\n    eff r.amount = r.amount + 1\n";
    assert_eq!(renamed(text, "amount").as_deref(), Ok(after));
    let text = "program P\nfunction f(a: Int) -> Int = a$0\nx: Int = f(a = 2)\n";
    let after = "program P\nfunction f(bit: Int) -> Int = bit\nx: Int = f(bit = 2)\n";
    assert_eq!(renamed(text, "bit").as_deref(), Ok(after));
    let text = "program P\nrole a\n    go()\n        eff role = b\nrole b$0\n    back()\n        eff role = a\n";
    let after = "program P\nrole a\n    go()\n        eff role = follower\nrole follower\n    back()\n        eff role = a\n";
    assert_eq!(renamed(text, "follower").as_deref(), Ok(after));
}

#[test]
fn in_libraries_too() {
    let tools = "library tools\nconst one = 1\nconst two = one + one\n";
    let beside = [("tools", tools)];
    let libraries = Beside(&beside);
    let (text, at) = cursor("program P\nimport tools\nx: Int = tools.on$0e\n");
    let analysis = Analysis::new(&text, &libraries);
    let found = analysis.renameable(at).expect("it can be renamed");
    let renamed = analysis
        .rename(found.symbol, "unit", &libraries)
        .expect("it is renamed");
    let texts: Vec<String> = (renamed.iter())
        .map(|file| {
            let source = &analysis.checked.files[file.file as usize].source;
            edited(source, &file.edits)
        })
        .collect();
    assert_eq!(
        texts,
        [
            "program P\nimport tools\nx: Int = tools.unit\n",
            "library tools\nconst unit = 1\nconst two = unit + unit\n"
        ]
    );
    let reason = analysis
        .rename(found.symbol, "two", &libraries)
        .expect_err("it is taken");
    assert!(
        reason
            .to_string()
            .contains("the name `two` is taken (line 3 of `tools`)"),
        "{reason}"
    );
}

#[test]
fn the_place_that_is_renamed_is_the_whole_name() {
    let (analysis, found) = at_cursor("program P\ncou$0nt: Int\n");
    assert_eq!(found.site.span.of(analysis.text()), "count");
}

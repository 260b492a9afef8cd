//! Every name leads to its declaration, and the declaration to all names.

use crate::support::{Beside, analysis, at_cursor, cursor};
use starl_editor::Analysis;
use starl_lang::diagnostic::Span;

/// The text with `«»` around what the name at the cursor leads to and `‹›` around its other names.
fn marked(text: &str) -> String {
    let (analysis, found) = at_cursor(text);
    let definition = analysis.definition(found.symbol);
    let source = analysis.text();
    let (mut marked, mut done) = (String::new(), 0);
    for name in analysis.references(found.symbol) {
        let Span { start, end } = name.site.span;
        assert_eq!(name.is_definition, Some(name.site) == definition);
        let (left, right) = if name.is_definition {
            ("«", "»")
        } else {
            ("‹", "›")
        };
        marked += &source[done..start as usize];
        marked += left;
        marked += &source[start as usize..end as usize];
        marked += right;
        done = end as usize;
    }
    marked + &source[done..]
}

#[test]
fn of_a_variable() {
    let text = "program P\nloc: Int = 0\ngo()\n    pre l$0oc < 3\n    eff loc += 1\ninvariant a: forall r: r.loc < 3 and loc_ok\nloc_ok: Bool\n";
    assert_eq!(
        marked(text),
        "program P\n«loc»: Int = 0\ngo()\n    pre ‹loc› < 3\n    eff ‹loc› += 1\ninvariant a: forall r: r.‹loc› < 3 and loc_ok\nloc_ok: Bool\n"
    );
}

#[test]
fn of_variants_with_and_without_their_enum() {
    let text = "program P\nenum E {one, two}\ne: E = on$0e\nf: enum {one, three} = one\ngo()\n    pre e == one\n    eff e = E.one; f = one\n";
    assert_eq!(
        marked(text),
        "program P\nenum E {«one», two}\ne: E = ‹one›\nf: enum {one, three} = one\ngo()\n    pre e == ‹one›\n    eff e = E.‹one›; f = one\n"
    );
}

#[test]
fn of_fields_also_where_they_are_given_by_name() {
    let text = "program P\nrecord R {x: Int, y: Point}\nr: R\ngo()\n    eff r = R(x$0 = 1, y = position); r.x += r.y.x_count()\n";
    let found = marked(text);
    assert_eq!(
        found,
        "program P\nrecord R {«x»: Int, y: Point}\nr: R\ngo()\n    eff r = R(‹x› = 1, y = position); r.‹x› += r.y.x_count()\n"
    );
}

#[test]
fn of_messages_primitives_and_shared_variables() {
    let text = "program P\nmessage M(a: Int)\nradio = Broadcast()\ngo()\n    eff radio.broadcast(M$0(1))\non M(from, a)\n    log(\"{}\", a)\n";
    assert!(marked(text).contains("message «M»(a: Int)"));
    assert!(marked(text).contains("on ‹M›(from, a)"));
    let text = "program P\nradio = Broadcast()\ngo()\n    eff rad$0io.broadcast(1)\non radio.failed(n)\n    log(\"{}\", n)\n";
    assert!(marked(text).contains("on ‹radio›.failed"));
    let text = "program P\nallread pos[RobotId]: Point\ngo()\n    eff po$0s[me] = position\nsee()\n    pre some p = pos[me] and p.x > 0.0\n    eff log(\"{}\", p)\n";
    assert_eq!(marked(text).matches("‹pos›[me]").count(), 2);
}

#[test]
fn of_locals_of_the_same_name_each_its_own() {
    let text = "program P\nfunction f(x: Int) -> Int = x\ngo()\n    eff\n        for x in 0..3\n            log(\"{}\", x$0)\n        for x in 0..4\n            log(\"{}\", f(x = x))\n";
    let found = marked(text);
    assert!(found.contains("for «x» in 0..3\n            log(\"{}\", ‹x›)"));
    assert_eq!(found.matches('‹').count(), 1);
    let text = text.replace("$0", "").replace("f(x =", "f(x$0 =");
    assert!(marked(&text).contains("f(«x»: Int) -> Int = ‹x›"));
    assert!(marked(&text).contains("f(‹x› = x)"));
}

#[test]
fn of_a_name_bound_in_a_guard() {
    let text = "program P\nspot: Point?\ngo()\n    pre some p = spot and p.x > 0.0\n    eff log(\"{}\", p$0)\n";
    assert!(marked(text).contains("some «p» = spot and ‹p›.x"));
}

#[test]
fn of_roles_as_values() {
    let text = "program P\nrole leader\n    go()\n        eff role = $0follower\nrole follower\n    back()\n        pre role == follower\n        eff role = leader\n";
    let found = marked(text);
    assert!(found.contains("role «follower»"));
    assert!(found.contains("eff role = ‹follower›"));
    assert!(found.contains("pre role == ‹follower›"));
}

#[test]
fn of_a_declaration_in_a_library() {
    let (text, at) =
        cursor("program P\nimport tools\nx: tools.Pair\ny: Int = tools.tw$0ice(a = 2)\n");
    let tools = "library tools\nrecord Pair {left: Int, right: Int}\nfunction twice(a: Int) -> Int = a + a\nfunction four() -> Int = twice(2)\n";
    let beside = [("tools", tools)];
    let analysis = Analysis::new(&text, &Beside(&beside));
    let found = analysis.occurrence(at).expect("there is a name");
    let site = analysis.definition(found.symbol).expect("it is declared");
    assert_eq!(analysis.checked.files[site.file as usize].name, "tools");
    assert_eq!(site.span.of(tools), "twice");
    let names = analysis.references(found.symbol);
    let own = names.iter().filter(|name| name.site.file == 0).count();
    assert_eq!((own, names.len()), (1, 3));
    for (word, kind) in [("tools.Pair", "Pair"), ("a = 2", "a")] {
        let at =
            text.find(word).expect("the word is there") + word.find(kind).expect("it is in it");
        let found = analysis.occurrence(at as u32).expect("there is a name");
        let site = analysis.definition(found.symbol).expect("it is declared");
        assert_eq!((site.file > 1, site.span.of(tools)), (true, kind));
    }
    let library = text.find("tools").expect("it is imported") as u32;
    let found = analysis.occurrence(library).expect("there is a name");
    let names = analysis.references(found.symbol);
    assert_eq!(
        names.len(),
        4,
        "import, two uses and the library's own name"
    );
}

#[test]
fn built_in_names_have_none() {
    let (analysis, found) = at_cursor("program P\nx: Float = ab$0s(2.0)\n");
    assert_eq!(analysis.definition(found.symbol), None);
}

#[test]
fn of_a_declaration_of_the_prelude() {
    let (analysis, found) = at_cursor("program P\nx: Si$0de? = bumped\n");
    let site = analysis.definition(found.symbol).expect("it is declared");
    assert_eq!(analysis.checked.files[site.file as usize].name, "prelude");
}

#[test]
fn names_in_declarations_with_errors_are_known() {
    let analysis =
        analysis("program P\nloc: Int = 0\ngo()\n    eff loc = \"a\"; loc = loc + unknown\n");
    let names = analysis.occurrences().iter();
    let text = analysis.text();
    let found: Vec<_> = names.map(|name| name.site.span.of(text)).collect();
    assert_eq!(found, ["P", "loc", "Int", "go", "loc", "loc", "loc"]);
}

//! The canonical layout: texts before and after formatting.

use starl_editor::format::format;
use starl_lang::check::STANDARD;

#[track_caller]
fn check(before: &str, after: &str) {
    assert_eq!(format(before), after);
    assert_eq!(format(after), after, "once more");
}

#[test]
fn blocks_are_indented_by_four_spaces() {
    check(
        "program P\nrun()\n  pre a\n  eff\n     if b\n       f()\n     else\n       g()\n",
        "program P\n\nrun()\n    pre a\n    eff\n        if b\n            f()\n        else\n            g()\n",
    );
}

#[test]
fn tabs_become_spaces() {
    check(
        "program P\n\nrun()\n\teff\n\t\tf()\n",
        "program P\n\nrun()\n    eff\n        f()\n",
    );
}

#[test]
fn operators_stand_apart_and_brackets_do_not() {
    check(
        "program P\n\nconst x=-  1+ 2*( 3 )\ny :List [ Int ] ?=[ 1,2 ]\nz=F ( a=1 )\nconst r = not  a in 0 .. 5\n",
        "program P\n\nconst x = -1 + 2 * (3)\ny: List[Int]? = [1, 2]\nz = F(a = 1)\nconst r = not a in 0..5\n",
    );
}

#[test]
fn stable_variables_begin_with_the_word() {
    check(
        "program P\n\nstable   left :Int=3\nstable loc:enum{a,b}\nstable:Bool\n",
        "program P\n\nstable left: Int = 3\nstable loc: enum {a, b}\nstable: Bool\n",
    );
}

#[test]
fn maps_sets_and_optionals() {
    check(
        "program P\n\nconst a = { 1:2 , 3 : 4 }\nconst b = { : }\nconst c = x ! . y [ 0 ] !\n",
        "program P\n\nconst a = {1: 2, 3: 4}\nconst b = {:}\nconst c = x!.y[0]!\n",
    );
}

#[test]
fn one_empty_line_is_around_a_block() {
    check(
        "program P\nx: Int\ny: Int\nrun()\n    eff f()\non M(a)\n    g()\n\n\n\nz: Int\n",
        "program P\n\nx: Int\ny: Int\n\nrun()\n    eff f()\n\non M(a)\n    g()\n\nz: Int\n",
    );
}

#[test]
fn empty_lines_are_single_and_never_begin_a_block() {
    check(
        "\n\nprogram P\n\n\n\nx: Int\n\ny: Int\n\nrun()\n\n    pre a\n\n    eff\n\n        f()\n\n\n        g()\n\n\n",
        "program P\n\nx: Int\n\ny: Int\n\nrun()\n    pre a\n    eff\n        f()\n\n        g()\n",
    );
}

#[test]
fn comments_stay_with_their_declarations() {
    check(
        "program P\n// of x\nx: Int\n// of run\nrun()\n  // of pre\n  pre a\n  eff\n    f()\n    // last\n// of y\ny: Int\n",
        "program P\n\n// of x\nx: Int\n\n// of run\nrun()\n    // of pre\n    pre a\n    eff\n        f()\n        // last\n\n// of y\ny: Int\n",
    );
}

#[test]
fn comments_at_the_ends_of_lines_are_aligned() {
    check(
        "program P\n\nx: Int // one\nlonger: Int     // two\ny: Int\nz: Int// three\n",
        "program P\n\nx: Int       // one\nlonger: Int  // two\ny: Int\nz: Int  // three\n",
    );
}

#[test]
fn continued_lines_are_indented_by_one_more_level() {
    check(
        "program P\n\nrun()\n    pre a and\n     b or\n          c\n    eff\n        if a and\n         b\n            f()\n        x = 1 +\n           2\n",
        "program P\n\nrun()\n    pre a and\n        b or\n        c\n    eff\n        if a and\n                b\n            f()\n        x = 1 +\n            2\n",
    );
}

#[test]
fn lines_in_brackets_are_indented_by_their_depth() {
    check(
        "program P\n\nconst x = f(\n  1,\n      [\n 2,\n   3\n  ],\n)\nrecord R {\n  a: Int,\n  }\n",
        "program P\n\nconst x = f(\n    1,\n    [\n        2,\n        3\n    ],\n)\nrecord R {\n    a: Int,\n}\n",
    );
}

#[test]
fn a_continued_effect_is_aligned() {
    check(
        "program P\n\nrun()\n    eff a = 1;b = 2\n          c = 3\n",
        "program P\n\nrun()\n    eff a = 1; b = 2\n        c = 3\n",
    );
}

#[test]
fn an_input_stands_like_a_function() {
    check(
        "program P\non   input  go (to :Point,fast:Bool ,)\n  stop( )\non input(x)\n  stop()\n",
        "program P\n\non input go(to: Point, fast: Bool,)\n    stop()\n\non input(x)\n    stop()\n",
    );
}

#[test]
fn line_ends_of_other_systems_become_plain() {
    check(
        "program P\r\n\r\nx: Int // a\r\n",
        "program P\n\nx: Int  // a\n",
    );
}

#[test]
fn a_declaration_with_errors_stays_as_it_is() {
    check(
        "program P\nx:Int\nrun()\n  pre  a  =  1\n  eff f( )\n\n\ny:Int\n",
        "program P\n\nx: Int\nrun()\n  pre  a  =  1\n  eff f( )\n\ny: Int\n",
    );
}

#[test]
fn an_empty_text_stays_empty() {
    check("", "");
    check("\n\n", "");
    check("// only this", "// only this\n");
}

#[test]
fn the_standard_library_is_formatted() {
    for (name, text) in STANDARD {
        assert_eq!(format(text), *text, "{name}");
    }
}

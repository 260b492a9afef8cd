//! The verifier refuses what breaks a rule, and says which.

use crate::machine_support::{self, RACE, every::EVERY, load};
use starl_lang::machine::LoadError;

/// Why a program is refused.
fn reason(text: &str) -> String {
    match load(text) {
        Ok(_) => format!("it was taken:\n{text}"),
        Err(error) => error.to_string(),
    }
}

/// Why a function's body is refused, which has an Int in `r0`, a list of Ints in `b0`, a text in
/// `b1`, out of 6 and 4 registers.
fn body(body: &str) -> String {
    reason(&format!(
        "type Text\n type List[Int]\n type Set[Int]\n type Map[Int, type0]\n type Area\n type List[Float]\n\
         enum E a b\n constant 5\n text \"x\"\n variable number Int\n variable list type1\n\
         import position query () (Point)\n import act () ()\n\
         function test procedure (Int, type1, type0) () registers 6 objects 4\n\
         {body}\n return #0 #4"
    ))
}

fn refused(text: &str, expected: &str) {
    let found = body(text);
    assert!(
        found.ends_with(expected),
        "{text}: expected `{expected}`, found `{found}`"
    );
}

#[test]
fn good_programs_are_taken() {
    assert!(load(RACE).is_ok());
    assert!(load(EVERY).is_ok(), "{}", reason(EVERY));
}

#[test]
fn registers() {
    refused(
        "copy r6 r0",
        "a register is beyond those that the function has",
    );
    refused(
        "copy r1 r6",
        "a register is beyond those that the function has",
    );
    refused(
        "copy_point r1 r4",
        "a register is beyond those that the function has",
    );
    refused(
        "copy_block r0 r0 #7",
        "a register is beyond those that the function has",
    );
    refused(
        "copy r1 r2",
        "a register is read that may not have been written",
    );
    refused(
        "copy_point r1 r0",
        "a register is read that may not have been written",
    );
    refused(
        "copy_object b4 b0",
        "an object register is beyond those that the function has",
    );
    refused(
        "copy_object b2 b3",
        "an object register is read that may not have been written",
    );
}

#[test]
fn registers_written_on_one_way_only() {
    let unwritten = "a register is read that may not have been written";
    refused("jump_if r0 @skip\n int r1 5\nskip:\n copy r2 r1", unwritten);
    refused(
        "again:\n jump_if r0 @use\n int r1 5\n jump @again\nuse:\n copy r2 r1",
        unwritten,
    );
    let object = "an object register is read that may not have been written";
    refused(
        "jump_if r0 @skip\n copy_object b2 b0\nskip:\n copy_object b3 b2",
        object,
    );
    let either =
        "copy_object b2 b0\n jump_if r0 @skip\n copy_object b2 b1\nskip:\n copy_object b3 b2";
    refused(either, object);
}

#[test]
fn types_of_objects() {
    let wrong = "an object is not of the type that the instruction works on";
    for instruction in [
        "append_text b0 b1",
        "append_text b1 b0",
        "append_scalar b0 r0 int",
        "contains_text r1 b0 b1",
        "split_text b2 b1 b1 type1",
        "match_text r1 b0 b1 end",
        "change_text b2 b0 trim",
        "replace_text b2 b1 b1 b0",
        "join_texts b2 b1 b1",
        "number_of_text r1 b1 bool",
        "list_add b1 r0 b0 type1",
        "list_add b0 r0 b0 type5",
        "list_add b1 r0 b0 type0",
        "list_get b1 r0 r1 b0",
        "list_set b1 r0 r0 b0",
        "list_append b0 b1",
        "list_sort b0 type5",
        "list_sort_by b0 b1 type1",
        "list_sort_by b1 b0 type1",
        "list_reverse b1",
        "sum_float r1 b0",
        "sum_int r1 b1",
        "set_of_list b2 b0 type1",
        "set_of_list b2 b1 type2",
        "list_of_set b2 b0 type1",
        "set_add b0 r0 b0 type1",
        "set_unite b0 b0 type1",
        "map_put b0 r0 b1 type3",
        "map_at b0 r0 b0 r1 b2 type1",
        "map_add b0 r0 b1 r0 type3",
        "map_add_constant b0 r0 b1 1 type3",
        "map_keys b2 b0 type2",
        "polygon b2 b0",
        "area_contains r1 b0 r0",
        "store_object s0 b1",
        "equal_object r1 b0 b1 type1",
    ] {
        let text = match instruction.starts_with("area") {
            true => format!("copy r1 r0\n copy r2 r0\n {instruction}"),
            false => instruction.into(),
        };
        refused(&text, wrong);
    }
    refused(
        "copy_object s0 b1",
        "a state variable is written with an object of another type",
    );
    refused("clear_object b2 type6", "there is no such type");
    refused(
        "clear_object b2 type3\n map_put b2 r0 b0 type3",
        "an object register does not hold the type that is needed",
    );
}

#[test]
fn indices() {
    refused("load_constant r1 c1", "there is no such constant");
    refused("load_text b2 t1", "there is no such text");
    refused("load r1 v1", "there is no such scalar in the state");
    refused("load_point r1 v0", "there is no such scalar in the state");
    refused(
        "store v4294967295 r0",
        "there is no such scalar in the state",
    );
    refused("copy_object b2 s1", "there is no such object in the state");
    refused("append_variant b1 r0 enum1", "there is no such enum");
    refused("call r0 b0 f1", "there is no such function");
    refused("call_host r0 b0 h2", "there is no such import");
}

#[test]
fn calls() {
    refused(
        "call r1 b0 f0",
        "a register is read that may not have been written",
    );
    refused(
        "call r0 b1 f0",
        "an object register does not hold the type that is needed",
    );
    refused(
        "call_host r4 b0 h0",
        "a register is beyond those that the function has",
    );
    refused(
        "int r1 1\n call_host r0 b0 h1\n copy r2 r1",
        "a register is read that may not have been written",
    );
}

#[test]
fn ends() {
    refused(
        "return #1 #4",
        "a return keeps more or fewer objects than there are results",
    );
    refused(
        "return #0 #3",
        "a return does not empty the function's object registers",
    );
    refused(
        "return_scalar r0 #4",
        "the function's result is not one scalar",
    );
    refused(
        "return_false #4",
        "only guards may return false without their bindings",
    );
    let endless = "function f function () () registers 1 objects 0\n int r0 1";
    assert!(reason(endless).ends_with("the function continues past its end"));
    let missing = "function f function () (Int) registers 1 objects 0\n return #0 #0";
    assert!(reason(missing).ends_with("a register is read that may not have been written"));
}

#[test]
fn each_kind_of_function_has_its_permissions() {
    let cases = [
        (
            "function",
            "load r0 v0",
            "the function may not read the state",
        ),
        (
            "function",
            "size r0 s0",
            "the function may not read the state",
        ),
        (
            "function",
            "call_host r0 b0 h0",
            "the function may not call this import",
        ),
        (
            "guard",
            "int r0 1\n store v0 r0",
            "the function may not change the state",
        ),
        (
            "guard",
            "list_reverse s0",
            "the function may not change the state",
        ),
        (
            "guard",
            "clear_object s0 type0",
            "the function may not change the state",
        ),
        (
            "guard",
            "call_host r0 b0 h1",
            "the function may not call this import",
        ),
        (
            "guard",
            "call r0 b0 f1",
            "the function may not call a function of that kind",
        ),
        (
            "guard",
            "int r0 1\n load_other r0 r0 v0",
            "only properties may read the states of other robots",
        ),
        (
            "property",
            "load r0 v0",
            "the function may not read the state",
        ),
        (
            "property",
            "load_object b0 s0",
            "the function may not read the state",
        ),
        (
            "property",
            "call_host r0 b0 h1",
            "the function may not call this import",
        ),
        (
            "procedure",
            "call r0 b0 f2",
            "the function may not call a function of that kind",
        ),
    ];
    for (kind, instruction, expected) in cases {
        let found = reason(
            &format!(
                "type List[Int]\n variable number Int\n variable list type0\n\
             import query query () ()\n import act () ()\n\
             function test {kind} () () registers 4 objects 1\n {instruction}\n return #0 #1\n\
             function procedure procedure () () registers 1 objects 0\n return #0 #0\n\
             function guard guard () (Bool) registers 1 objects 0\n return_false #0"
            )
            .replace("import query query", "import position query")
            .replace("import act", "import expensive"),
        );
        assert!(found.ends_with(expected), "{kind} {instruction}: {found}");
    }
}

#[test]
fn entry_points() {
    let guard = "function g guard () (Bool, Int) registers 2 objects 0\n return_false #0\n";
    let effect = "function e procedure (Int) () registers 2 objects 0\n return #0 #0\n";
    let good = format!("action a f0 f1\n{guard}{effect}");
    assert!(load(&good).is_ok());
    for (text, expected) in [
        (
            good.replace("f0 f1", "f1 f0"),
            "an entry point is of the wrong kind",
        ),
        (good.replace("f0 f1", "f0 f2"), "there is no such function"),
        (
            good.replace("(Int) ()", "(Float) ()"),
            "a guard's bindings are not the effect's arguments",
        ),
        (
            good.replace("(Int) ()", "(Int, Int) ()"),
            "a guard's bindings are not the effect's arguments",
        ),
        (
            format!("start f1\n{good}"),
            "the start has arguments or results",
        ),
        (
            format!("handler M primitive 0 f1\n{good}"),
            "there is no such primitive",
        ),
        (
            format!("handler go input f1\n{good}"),
            "an input has other fields than its handler",
        ),
        (
            format!("handler go input f1 to speed\n{good}"),
            "an input has other fields than its handler",
        ),
        (
            format!("property p 1 always f1\n{good}"),
            "an entry point is of the wrong kind",
        ),
        (
            format!(
                "property p 1 always f2\n{good}function p property () (Bool) registers 1 objects 0\n int r0 1\n return #0 #0"
            ),
            "a property does not take robots and give a Bool",
        ),
    ] {
        let found = reason(&text);
        assert!(found.ends_with(expected), "{text}\n{found}");
    }
}

#[test]
fn types_and_headers() {
    for (text, expected) in [
        (
            "type List[type0]",
            "an object type refers to itself, a later one or none",
        ),
        (
            "type List[type1]\n type Text",
            "an object type refers to itself, a later one or none",
        ),
        (
            "variable x type0",
            "an object type refers to itself, a later one or none",
        ),
        ("variable x enum0", "there is no such enum"),
        (
            "function f function () () registers 257 objects 0\n return #0 #0",
            "a function has too many registers",
        ),
        (
            "function f function () () registers 1 objects 129\n return #0 #129",
            "a function has too many registers",
        ),
        (
            "function f function (Point) () registers 2 objects 0\n return #0 #0",
            "a function has too few registers for its arguments or results",
        ),
        (
            "function f function () () registers 1 objects 0",
            "functions do not follow one another",
        ),
    ] {
        let found = reason(text);
        assert!(found.ends_with(expected), "{text}\n{found}");
    }
    let twice =
        "function f function () () registers 1 objects 0\n span 0 1 2\n span 0 3 4\n return #0 #0";
    let after = "function f function () () registers 1 objects 0\n return #0 #0\n span 0 1 2";
    for text in [twice, after] {
        assert!(reason(text).ends_with("spans are not in ascending order or beyond the code"));
    }
    let deep: String = (1..40)
        .map(|index| format!("type List[type{}]\n", index - 1))
        .collect();
    assert!(reason(&format!("type Text\n{deep}")).ends_with("a type is nested too deeply"));
    let wide = vec!["Point"; 90].join(", ");
    let wide = format!("function f function ({wide}) () registers 256 objects 0\n return #0 #0");
    assert!(reason(&wide).ends_with("a value has too many parts for the registers"));
}

#[test]
fn jumps_stay_in_their_function() {
    let mut bytecode = starl_lang::machine::assemble(RACE).expect("it is well written");
    let jump = bytecode
        .code
        .iter_mut()
        .find_map(|instruction| match instruction {
            starl_lang::machine::Instruction::JumpIfStateNot { target, .. } => Some(target),
            _ => None,
        });
    jump.expect("there is one").0 = 0;
    let result = starl_lang::machine::Program::load(bytecode, &machine_support::resolve);
    assert!(
        result
            .err()
            .is_some_and(|error| error.to_string().ends_with("a jump leaves the function"))
    );
}

#[test]
fn imports_must_be_there() {
    let unknown = load("import teleport () ()").map(|_| ());
    assert_eq!(unknown, Err(LoadError::UnknownImport("teleport".into())));
}

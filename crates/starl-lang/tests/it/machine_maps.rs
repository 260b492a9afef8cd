//! Instructions on maps, beside `BTreeMap`.

use crate::machine_support::{call, program};
use starl_core::Random;
use starl_lang::machine::{Fault, Object, Program};
use std::collections::BTreeMap;

const DECLARATIONS: &str = "
type Text
type Map[Int, type0]
type Set[Int]
type List[type0]
type Map[type0, Int]
";

/// A program whose only function takes a map from Int to Text in `b0`, a text in `b1`, an Int in `r0`.
fn with(results: &str, body: &str, keep: u8) -> Program {
    program(&format!(
        "{DECLARATIONS} function test function (Int, type1, type0) {results} registers 8 objects 6\n\
         {body}\n return #{keep} #6"
    ))
}

#[test]
fn as_the_standard_map() {
    let put = with("(type1)", "move_object b2 b1\n map_put b0 r0 b2 type1", 1);
    let remove = with("(type1)", "map_remove b0 r0 b0 type1", 1);
    let contains = with("(Bool)", "map_contains r0 b0 r0 b0 type1", 0);
    let get = with(
        "(Bool, type0)",
        "map_get b0 r0 b0 r1 b0 type1\n copy r0 r1",
        1,
    );
    let at = with("(type0)", "map_at b0 r0 b0 r1 b0 type1", 1);
    let size = with("(Int)", "size r0 b0", 0);

    let mut random = Random::keyed(2, &[0]);
    let mut map = Object::EMPTY;
    let mut standard: BTreeMap<i64, String> = BTreeMap::new();
    for turn in 0..300 {
        let key = i64::from(random.below(12)) - 6;
        let text = format!("text {turn}");
        let run = |program: &Program| {
            let objects = [map.clone(), Object::from(text.as_str())];
            call(program, &[key as u64], &objects).map_err(|error| error.fault)
        };
        let found = standard.get(&key).map(String::as_str);
        assert_eq!(
            run(&contains).expect("no error").0,
            [u64::from(found.is_some())]
        );
        let (present, value) = run(&get).expect("no error");
        assert_eq!(present, [u64::from(found.is_some())]);
        assert_eq!(value[0].text(), found.unwrap_or_default());
        match found {
            Some(text) => assert_eq!(run(&at).expect("no error").1[0].text(), text),
            None => assert_eq!(run(&at), Err(Fault::KeyMissing)),
        }
        assert_eq!(run(&size).expect("no error").0, [standard.len() as u64]);
        let changed = if random.chance(0.6) {
            let changed = run(&put).expect("no error").1;
            standard.insert(key, text.clone());
            changed
        } else {
            let changed = run(&remove).expect("no error").1;
            standard.remove(&key);
            changed
        };
        map = changed[0].clone();
    }
    // Entries, keys and values come in ascending order of the keys.
    let entry = with(
        "(Int, type0)",
        "map_entry b0 r0 r1 b1\n copy r0 r1\n move_object b0 b1",
        1,
    );
    let keys = with("(Int)", "map_keys b2 b0 type2\n list_get b2 r0 r0 b0", 0);
    let values = with(
        "(type0)",
        "map_values b2 b0 type3\n list_get b2 r0 r0 b0",
        1,
    );
    for (index, (key, text)) in standard.iter().enumerate() {
        let run = |program| {
            call(program, &[index as u64], &[map.clone(), Object::EMPTY]).expect("no error")
        };
        let (scalars, objects) = run(&entry);
        assert_eq!(
            (scalars[0] as i64, objects[0].text()),
            (*key, text.as_str())
        );
        assert_eq!(run(&keys).0[0] as i64, *key);
        assert_eq!(run(&values).1[0].text(), text);
    }
    let beyond = call(&entry, &[standard.len() as u64], &[map, Object::EMPTY]);
    let length = standard.len() as u32;
    let index = i64::from(length);
    assert_eq!(
        beyond.map_err(|e| e.fault),
        Err(Fault::IndexOutOfRange { index, length })
    );
}

#[test]
fn keys_may_be_texts() {
    let code = program(&format!(
        "{DECLARATIONS} function test function (type0, type0) (Int, Int, type0) registers 8 objects 4\n\
         clear_object b2 type4\n\
         int r0 1\n move_object b3 b0\n copy_object b0 b3\n map_put b2 r0 b0 type4\n\
         int r0 2\n map_put b2 r0 b1 type4\n\
         int r0 3\n map_put b2 r0 b0 type4\n\
         int r2 0\n map_entry b2 r2 r0 b0\n size r1 b2\n return #1 #4"
    ));
    let (scalars, objects) = call(&code, &[], &["b".into(), "a".into()]).expect("no error");
    assert_eq!((scalars[0], scalars[1], objects[0].text()), (2, 2, "a"));
}

#[test]
fn keys_and_values_are_copies() {
    let body = "map_keys b2 b0 type2\n map_put b0 r0 b1 type1\n size r0 b2";
    assert_eq!(
        call(&with("(Int)", body, 0), &[5], &[Object::EMPTY, "x".into()])
            .expect("no error")
            .0,
        [0]
    );
}

#[test]
fn counting_is_as_in_the_standard_map() {
    let declarations = "type Text\ntype Map[Int, Int]\ntype Map[type0, Int]\n";
    let by_number = program(&format!(
        "{declarations}function numbers function (Int, Int, type1) (type1) registers 4 objects 2\n\
         map_add b0 r0 b0 r1 type1\n map_add_constant b0 r0 b0 -2 type1\n return #1 #2"
    ));
    let by_text = program(&format!(
        "{declarations}function texts function (Int, Int, type2, type0) (type2) registers 4 objects 3\n\
         map_add b0 r0 b1 r1 type2\n map_add_constant b0 r0 b1 -2 type2\n return #1 #3"
    ));
    let names: Vec<Object> = (0..40)
        .map(|k| format!("name {k}").as_str().into())
        .collect();
    let mut random = Random::keyed(3, &[0]);
    let mut standard: BTreeMap<i64, i64> = BTreeMap::new();
    let (mut numbers, mut texts) = (Object::EMPTY, Object::EMPTY);
    for _ in 0..2_000 {
        let (key, amount) = (i64::from(random.below(40)), i64::from(random.below(9)));
        *standard.entry(key).or_default() += amount - 2;
        // Texts are looked up by the object that is the key, and by others with the same characters.
        let name = match random.chance(0.5) {
            true => names[key as usize].clone(),
            false => format!("name {key}").as_str().into(),
        };
        let run = |code: &Program, objects: &[Object]| {
            let (_, objects) = call(code, &[key as u64, amount as u64], objects).expect("no error");
            objects[0].clone()
        };
        let held = numbers.clone();
        let before = held.map().map(|map| map.values().scalars().to_vec());
        numbers = run(&by_number, &[numbers]);
        texts = run(&by_text, &[texts, name]);
        let after = held.map().map(|map| map.values().scalars().to_vec());
        assert_eq!(before, after, "a copy keeps what it has");
    }
    let sums: Vec<u64> = standard.values().map(|sum| *sum as u64).collect();
    let values = |map: &Object| map.map().expect("a map").values().scalars().to_vec();
    assert_eq!(values(&numbers), sums);
    let named = standard
        .iter()
        .map(|(k, sum)| (format!("name {k}"), *sum as u64));
    let named: BTreeMap<String, u64> = named.collect();
    assert_eq!(values(&texts), named.into_values().collect::<Vec<u64>>());
}

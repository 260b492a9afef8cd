//! Maps: literals, entries, methods.

use starl_lang::machine::Fault;

use super::support::{effect, faults, values};

const DECLARATIONS: &str = "
m: Map[String, Int] = {\"b\": 2, \"a\": 1}
e: Map[Int, Point]
p: Map[Int, Point] = {1: Point(1.0, 2.0)}
n: Map[Int, Map[String, List[Int]]] = {1: {\"x\": [1, 2]}}
k: String = \"a\"";

#[test]
fn reading() {
    values(
        DECLARATIONS,
        &[
            ("m", "{\"a\": 1, \"b\": 2}"),
            ("e", "{:}"),
            ("{1: k, 0: k + k}", "{0: \"aa\", 1: \"a\"}"),
            ("{1: 1, 1: 2}", "{1: 2}"),
            ("m[\"b\"]", "2"),
            ("m[k] + 1", "2"),
            ("p[1].y", "2.0"),
            ("n[1][\"x\"][1]", "2"),
            ("m.size()", "2"),
            ("m.get(k)", "1"),
            ("m.get(\"c\")", "none"),
            ("m.get(\"c\") ?? 0", "0"),
            ("p.get(1)!.x", "1.0"),
            ("p.get(2)", "none"),
            ("m.keys()", "{\"a\", \"b\"}"),
            ("m.values()", "[1, 2]"),
            ("m.values().sum()", "3"),
            ("m.contains(\"a\")", "true"),
            ("e.contains(1)", "false"),
            ("{:} == m", "false"),
        ],
    );
}

#[test]
fn changing() {
    let body = "
m[\"c\"] = 3
m[k] += 10
m.remove(\"b\")
m.remove(\"z\")
log(\"{}\", m)
e[4] = Point(1.0, 1.0)
e[4].x = 5.0
e[2] = e[4] * 2.0
log(\"{}\", e)
n[1][\"x\"].add(3)
n[1][\"y\"] = [4]
n[2] = {:}
n[2][\"z\"] = n[1][\"x\"]
n[1][\"x\"][0] -= 1
log(\"{}\", n)
let c = m
c[\"a\"] = 0
log(\"{} {}\", c, m)";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let expected = [
        "{\"a\": 11, \"c\": 3}",
        "{2: (10.0, 2.0, 0.0), 4: (5.0, 1.0, 0.0)}",
        "{1: {\"x\": [0, 2, 3], \"y\": [4]}, 2: {\"z\": [1, 2, 3]}}",
        "{\"a\": 0, \"c\": 3} {\"a\": 11, \"c\": 3}",
    ];
    assert_eq!(told, expected.map(|text| format!("log({text:?})")));
}

#[test]
fn counting() {
    let body = "
m[k] = (m.get(k) ?? 0) + m[\"b\"]
m[\"z\"] += 5
let amount = m[k]
m[k] += amount
m[\"y\"] = (m.get(\"z\") ?? 0) + 1
m[\"x\"] = (m.get(\"w\") ?? 0) + 1
m[\"v\"] = (m.get(\"w\") ?? 1) + 1
m[k] += -100000
log(\"{}\", m)
let c = {7: {1: 1}}
c[7][1] += amount
c[7][2] += 70000
c[7][3] = (c[7].get(3) ?? 0) + 2
log(\"{}\", c)
let o: Map[Int, Int?] = {1: 4, 2: none}
o[3] = (o.get(1) ?? 0) + 1
o[4] = (o.get(2) ?? 0) + 1
log(\"{}\", o)
let f: Map[Int, Float] = {:}
f[1] = (f.get(1) ?? 0.0) + 0.5
f[1] = (f.get(1) ?? 0.0) + 0.5
log(\"{}\", f)
let keys = [\"key \" + String(i) for i in 0..20]
let counts = [{key: 0 for key in keys}, {key: 0 for key in keys}]
for i in 0..9
    for key in keys
        counts[0][key] += i
        counts[1][key] = (counts[1].get(key) ?? 0) + i
        counts[0][\"key \" + String(i)] += 1
        counts[1][\"key \" + String(i)] += 1
log(\"{} {}\", counts[0] == counts[1], counts[0].values())";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let expected = [
        "{\"a\": -99994, \"b\": 2, \"v\": 2, \"x\": 1, \"y\": 6, \"z\": 5}",
        "{7: {1: 4, 2: 70000, 3: 2}}",
        "{1: 4, 2: none, 3: 5, 4: 1}",
        "{1: 1.0}",
        "true [56, 56, 36, 36, 36, 36, 36, 36, 36, 36, 36, 36, 56, 56, 56, 56, 56, 56, 56, 36]",
    ];
    assert_eq!(told, expected.map(|text| format!("log({text:?})")));
    faults(
        DECLARATIONS,
        &[("m[k] = 9223372036854775807; m[k] += 1", 1, Fault::Overflow)],
    );
}

#[test]
fn a_key_that_is_not_there() {
    faults(
        DECLARATIONS,
        &[
            ("log(\"{}\", m[\"z\"])", 1, Fault::KeyMissing),
            ("m[\"z\"] *= 1", 1, Fault::KeyMissing),
            ("e[1].x += 1.0", 1, Fault::KeyMissing),
            ("n[7][\"x\"] += [1]", 1, Fault::KeyMissing),
            ("n[1][\"q\"].remove(1)", 1, Fault::KeyMissing),
            ("e[1].x = 1.0", 1, Fault::KeyMissing),
            ("m[k] = 1\nn[7][\"x\"] = []", 2, Fault::KeyMissing),
        ],
    );
}

#[test]
fn adding_to_a_missing_key_starts_from_the_default() {
    let body = "
m[\"z\"] += 2
m[\"z\"] += 2
m[\"y\"] -= m.size()
e[7] += Point(1.0, 0.0)
n[1][\"q\"].add(3)
n[1][\"r\"] += [4, 5]
log(\"{} {} {}\", m, e, n)
let sets: Map[Bool, Set[Int]] = {:}
for i in 0..4
    sets[i % 2 == 0].add(i)
let texts: Map[Int, String] = {:}
let spans: Map[RobotId, Duration] = {:}
let rows: List[Map[Int, Int]] = [{:}]
texts[1] += \"a\"
spans[me] += 2s
rows[0][5] += rows[0].size()
log(\"{} {} {} {}\", sets, texts, spans[me], rows)";
    let told = effect(DECLARATIONS, body.trim()).unwrap();
    let expected = [
        "{\"a\": 1, \"b\": 2, \"y\": -3, \"z\": 4} {7: (1.0, 0.0, 0.0)} \
         {1: {\"q\": [3], \"r\": [4, 5], \"x\": [1, 2]}}",
        "{false: {1, 3}, true: {0, 2}} {1: \"a\"} 2s [{5: 0}]",
    ];
    assert_eq!(told, expected.map(|text| format!("log({text:?})")));
}

#[test]
fn a_text_in_a_variable_is_a_key() {
    let body = "
let key = \"a\"
m[key] = m.size()
m[key] += 10
key += \"b\"
m[key] = key.size() + m.size()
for k in [\"c\", \"a\", \"c\"]
    m[k] = (m.get(k) ?? 0) + 1
log(\"{}\", m)";
    let told = effect("m: Map[String, Int]", body.trim()).unwrap();
    assert_eq!(
        told,
        ["log(\"{\\\"a\\\": 11, \\\"ab\\\": 3, \\\"c\\\": 2}\")"]
    );
}

#[test]
fn keys_with_and_without_gaps_are_found() {
    let body = "
for i in 0..40
    m[i - 20] = i
    if i % 3 == 0 then n[i * i - 100] = i
let sum = 0
for i in -30..30
    sum += m.get(i) ?? 1000
    sum += n.get(i) ?? 100000
m.remove(0)
for i in -2..3
    sum += m.get(i) ?? 1000000
log(\"{} {}\", sum, m.size())";
    let told = effect("m: Map[Int, Int]\nn: Map[Int, Int]", body.trim()).unwrap();
    let n: Vec<i64> = (0..40).filter(|i| i % 3 == 0).collect();
    let read = |i: i64| {
        n.iter()
            .find(|n| *n * *n - 100 == i)
            .copied()
            .unwrap_or(100_000)
    };
    let sum: i64 = (-30..30)
        .map(|i| if (-20..20).contains(&i) { i + 20 } else { 1000 } + read(i))
        .sum();
    let sum = sum + 18 + 19 + 1_000_000 + 21 + 22;
    assert_eq!(told, [format!("log(\"{sum} 39\")")]);
}

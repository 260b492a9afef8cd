//! Points and areas.

use starl_lang::machine::Fault;

use super::support::{effect, faults, values};

const DECLARATIONS: &str = "p: Point = Point(3.0, 4.0)\nq: Point = Point(1.0, 2.0, 3.0)\nk: Float = 2.0\nps: List[Point] = [p, q]";

#[test]
fn arithmetic() {
    values(
        DECLARATIONS,
        &[
            ("p", "(3.0, 4.0, 0.0)"),
            ("p + q", "(4.0, 6.0, 3.0)"),
            ("p - q", "(2.0, 2.0, -3.0)"),
            ("-q", "(-1.0, -2.0, -3.0)"),
            ("q * 2.0", "(2.0, 4.0, 6.0)"),
            ("2.0 * q", "(2.0, 4.0, 6.0)"),
            ("k * q", "(2.0, 4.0, 6.0)"),
            ("q / k", "(0.5, 1.0, 1.5)"),
            ("(p + q) * k - q / k", "(7.5, 11.0, 4.5)"),
            ("p.x", "3.0"),
            ("p.y + q.z", "7.0"),
            ("(p + q).y", "6.0"),
            ("ps[1].z", "3.0"),
            ("Point(p.y, p.x)", "(4.0, 3.0, 0.0)"),
            ("Point(k, k + 1.0, k * k)", "(2.0, 3.0, 4.0)"),
            ("Point(y = 1.0, x = 2.0)", "(2.0, 1.0, 0.0)"),
            ("distance(p, Point(0.0, 0.0))", "5.0"),
            ("bearing(Point(1.0, 1.0), Point(1.0, 5.0)) == 90deg", "true"),
            ("bearing(q, q + Point(1.0, 0.0))", "0.0"),
            ("p == Point(3.0, 4.0)", "true"),
            ("p != q", "true"),
            ("p == q", "false"),
            ("p in ps", "true"),
            ("-p in ps", "false"),
        ],
    );
}

#[test]
fn areas() {
    let declarations = "square: Area = polygon([Point(0.0, 0.0), Point(1.0, 0.0), Point(1.0, 1.0), Point(0.0, 1.0)])";
    values(
        declarations,
        &[
            ("square.contains(Point(0.5, 0.5))", "true"),
            ("square.contains(Point(1.5, 0.5))", "false"),
            (
                "circle(Point(0.0, 0.0), 1m).contains(Point(0.5, 0.5))",
                "true",
            ),
            (
                "circle(Point(0.0, 0.0), 50cm).contains(Point(0.5, 0.5))",
                "false",
            ),
            ("not square.contains(Point(0.5, 2.0))", "true"),
        ],
    );
    let rows = [
        (
            "log(\"{}\", circle(Point(0.0, 0.0), -1.0).contains(Point(0.0, 0.0)))",
            1,
            Fault::ConversionOutOfRange,
        ),
        (
            "let one = [Point(0.0, 0.0)]\nsquare = polygon(one)",
            2,
            Fault::ConversionOutOfRange,
        ),
    ];
    faults(declarations, &rows);
}

#[test]
fn parts_can_be_changed() {
    let told = effect(
        DECLARATIONS,
        "p.x = p.y\np.y = p.x + 1.0\np.z -= 2.0\nps[0].y *= 2.0\nlet r = q\nlog(\"{} {} {}\", p, ps[0], r)",
    );
    assert_eq!(
        told.unwrap(),
        ["log(\"(4.0, 5.0, -2.0) (3.0, 8.0, 0.0) (1.0, 2.0, 3.0)\")"]
    );
}

#[test]
fn a_local_made_of_its_own_parts() {
    let told = effect(
        "",
        "let p = Point(1.0, 2.0, 3.0)\np = Point(p.y, p.z, p.x)\np = p + p * p.x\nlog(\"{}\", p)",
    );
    assert_eq!(told.unwrap(), ["log(\"(6.0, 9.0, 3.0)\")"]);
}

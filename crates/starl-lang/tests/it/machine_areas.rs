//! Instructions on areas.

use crate::machine_support::{call, program};
use starl_core::{Area, Point};
use starl_lang::machine::{Fault, List, Object, Program};

fn with(signature: &str, body: &str) -> Program {
    program(&format!(
        "type Area\n type List[Point]\n type Text\n\
         function test function {signature} registers 8 objects 2\n{body}"
    ))
}

#[test]
fn circles() {
    let circle = with("(Point, Float) (type0)", "circle b0 r0 r3\n return #1 #2");
    let arguments = [1.0, 2.0, 0.0, 0.5].map(f64::to_bits);
    let (_, objects) = call(&circle, &arguments, &[]).expect("no error");
    let expected = Area::Circle {
        center: Point::planar(1.0, 2.0),
        radius: 0.5,
    };
    assert_eq!(objects[0].area(), Some(&expected));
    for radius in [-1.0, f64::NAN, f64::INFINITY] {
        let arguments = [1.0, 2.0, 0.0, radius].map(f64::to_bits);
        let fault = call(&circle, &arguments, &[]).map_err(|error| error.fault);
        assert_eq!(fault, Err(Fault::ConversionOutOfRange));
    }
}

#[test]
fn polygons() {
    let polygon = with("(type1) (type0)", "polygon b0 b0\n return #1 #2");
    let corners = [
        Point::planar(0.0, 0.0),
        Point::planar(2.0, 0.0),
        Point::planar(0.0, 2.0),
    ];
    let (_, objects) = call(&polygon, &[], &[List::of_points(&corners).into()]).expect("no error");
    let contains = with(
        "(Point, type0) (Bool)",
        "area_contains r0 b0 r0\n return_scalar r0 #2",
    );
    for (x, y, inside) in [(0.5, 0.5, 1), (1.5, 1.5, 0), (0.0, 2.0, 1)] {
        let point = [x, y, 0.0].map(f64::to_bits);
        let (scalars, _) = call(&contains, &point, &objects).expect("no error");
        assert_eq!(scalars, [inside], "({x}, {y})");
        let (scalars, _) = call(&contains, &point, &[Object::EMPTY]).expect("no error");
        assert_eq!(scalars, [0], "nothing lies in no area");
    }
    let few = List::of_points(&corners[..1]).into();
    let fault = call(&polygon, &[], &[few]).map_err(|error| error.fault);
    assert_eq!(fault, Err(Fault::ConversionOutOfRange));
}

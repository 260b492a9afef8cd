//! Assignments: to variables of every kind, in the order that the language says.

use starl_lang::machine::Fault;

use super::support::{Robot, effect};

#[test]
fn locals_and_variables_do_not_share() {
    let body = "
let b = a
b.add(4)
a.add(5)
let c = b
b = []
log(\"{} {} {}\", a, b, c)
let x = i
i = 7
x += 1
log(\"{} {}\", x, i)
let y: Float = 1.0
y = y + y * y
y -= 0.5
y *= 4.0
log(\"{}\", y)";
    let told = effect("a: List[Int] = [1]\ni: Int = 3", body.trim()).unwrap();
    assert_eq!(
        told,
        ["log(\"[1, 5] [] [1, 4]\")", "log(\"4 7\")", "log(\"6.0\")"]
    );
}

#[test]
fn indices_are_evaluated_before_the_value() {
    // Draws of random numbers are recorded in their order.
    let body = "
a[random_int(0, 1)] = random_int(1, 2)
a[random_int(2, 3)] += random_int(3, 4)
n[random_int(4, 5)][random_int(5, 6)] = random_int(6, 7)
m[random_int(7, 8)] = random_int(8, 9)
m[random_int(9, 10)] += 1
n[random_int(10, 11)].insert(random_int(11, 12), random_int(12, 13))";
    let told = effect(
        "a: List[Int] = [1]\nn: List[List[Int]] = [[1]]\nm: Map[Int, Int]",
        body.trim(),
    );
    let told = told.unwrap();
    let expected: Vec<String> = (0..13)
        .map(|k| format!("random_int({k}, {})", k + 1))
        .collect();
    assert_eq!(told, expected);
}

#[test]
fn the_value_is_evaluated_before_the_write() {
    let mut robot = Robot::started(
        "program Test\na: List[Int] = [1]\ngo()\n    eff\n        a[9] = random_int(0, 1)\n",
    );
    let stopped = robot.action("go").expect_err("the index is outside");
    assert_eq!(
        stopped.fault,
        Fault::IndexOutOfRange {
            index: 9,
            length: 1
        }
    );
    assert_eq!(robot.told(), ["random_int(0, 1)"]);
}

#[test]
fn many_variables() {
    // More objects than operands can name, and more scalars than guards can test at once.
    let variables: String = (0..300)
        .map(|k| format!("n{k}: Int = {k}\nl{k}: List[Int] = [{k}]\ns{k}: String = \"{k}\"\n"))
        .collect();
    let source = format!(
        "program Test\n{variables}
go()
    pre n299 == 299 and l299[0] == 299 and s0 == \"0\" and not (n299 == 0)
    eff
        l299.add(n299)
        l299[0] += 1
        s299 += s298
        l298 = l299 + l1
        n299 = l299.size()
        l250[0] = l299[0]
        for x in l299
            l299.remove(x)
        log(\"{{}} {{}} {{}} {{}} {{}}\", l299, s299, l298, n299, l250)
"
    );
    let mut robot = Robot::started(&source);
    assert!(robot.action("go").unwrap());
    assert_eq!(robot.told(), ["log(\"[] 299298 [300, 299, 1] 2 [300]\")"]);
    assert!(!robot.action("go").unwrap());
}

#[test]
fn fields_deep_in_lists_of_variables_out_of_reach() {
    let variables: String = (0..130).map(|k| format!("l{k}: List[R]\n")).collect();
    let source = format!(
        "program Test\nrecord R {{tags: List[Int], at: Point}}\n{variables}
go()
    eff
        l129.add(R([1], Point(1.0, 1.0)))
        l129[0].tags.add(2)
        l129[0].tags[0] = 5
        l129[0].at.x = 3.0
        log(\"{{}}\", l129)
"
    );
    let mut robot = Robot::started(&source);
    robot.action("go").unwrap();
    assert_eq!(
        robot.told(),
        ["log(\"[(tags = [5, 2], at = (3.0, 1.0, 0.0))]\")"]
    );
}

//! Built-in functions and names.

use super::Purity::{self, Effect, Property, Pure, Query};
use super::Signature;

words! {
    /// A built-in function or name.
    Builtin,
    /// All built-in functions and names.
    BUILTINS,
    /// Where it may stand.
    purity: Purity;

    // The robot.
    Me = "me: RobotId" Query "This robot's number."
    Position = "position: Point" Query "The estimated position of this robot, metres."
    Heading = "heading: Float" Query "The estimated heading, radians from the x axis."
    Velocity = "velocity: Point" Query "The estimated velocity, metres per second."
    Now = "now: Time" Query "The time on this robot's clock."
    Peers = "peers: Set[RobotId]" Query "All known robots of the fleet, including this one. Robots that join are added; robots that leave or crash stay."
    RobotName = "robot_name(robot: RobotId) -> String" Query "The text `robot` and the robot's number, such as `robot0`; not its name in the scenario."
    Bumped = "bumped: Side?" Query "The side of the bumper that is pressed; none if it is not pressed."
    Ranges = "ranges: List[Float]" Query "The readings of the proximity sensor, metres: the first straight ahead, the others evenly spaced from there to the left, all around."
    Detected = "detected: List[Detection]" Query "The things and robots in sight, nearest first."
    Things = "things: List[Thing]" Query "The things in sight, nearest first."
    Holding = "holding: Int?" Query "The number of the thing that the robot holds; none if it does not hold one."
    ThingName = "thing_name(thing: Int) -> String" Query "The name of the thing with this number; an empty text if it is unknown."

    AtomicBlocked = "atomic_blocked: Bool" Query "Whether the last action with `atomic` cannot continue because no majority of the robots answers."

    // The run.
    Undisturbed = "undisturbed: Duration" Property "The time since the start or since the last fault began or ended, whichever is shorter; zero while the network is partitioned, a motor is stuck or sensors are frozen."
    Uncorrupted = "uncorrupted: Duration" Property "The time since the start or since a fault last overwrote the state of robots, whichever is shorter."
    Majority = "majority: Bool" Property "Whether more than half of the robots that run the program have been up at every moment; a restarted robot counts again after 10 s."
    Crashed = "crashed: Int" Property "The number of robots that run the program and are down or blocked by a robot that is down."

    // Input.
    WayPoints = "way_points() -> List[Point]" Query "The waypoints of the scenario, in their order."
    WayPoint = "way_point(name: String) -> Point?" Query "The waypoint with this name."
    WayPointGroup = "way_point_group(group: Int) -> List[Point]" Query "The waypoints of one group of the scenario, in their order."
    Obstacles = "obstacles() -> Obstacles" Query "The obstacles that the robot knows."
    AreasOf = "areas_of(obstacles: Obstacles) -> List[Area]" Query "The floor area of each obstacle."
    WithArea = "with_area(obstacles: Obstacles, area: Area) -> Obstacles" Query "The obstacles and one more over this area, without an upper end."

    // Numbers.
    Pi = "pi: Float" Pure "The ratio of a circle's circumference to its diameter."
    Abs = "abs(x: N) -> N" Pure "The absolute value; a run-time error for the smallest Int."
    Min = "min(a: M, b: M) -> M" Pure "The smaller value."
    Max = "max(a: M, b: M) -> M" Pure "The greater value."
    Clamp = "clamp(x: M, low: M, high: M) -> M" Pure "`x` limited to the range from `low` to `high`."
    Sqrt = "sqrt(x: Float) -> Float" Pure "The square root."
    Sin = "sin(angle: Float) -> Float" Pure "The sine."
    Cos = "cos(angle: Float) -> Float" Pure "The cosine."
    Tan = "tan(angle: Float) -> Float" Pure "The tangent."
    Atan2 = "atan2(y: Float, x: Float) -> Float" Pure "The angle of the point (x, y), in (-pi, pi]."
    Exp = "exp(x: Float) -> Float" Pure "The exponential function."
    LogE = "log_e(x: Float) -> Float" Pure "The natural logarithm."
    Pow = "pow(base: Float, exponent: Float) -> Float" Pure "The base to the power of the exponent."
    Round = "round(x: Float) -> Int" Pure "The nearest Int, with halves away from zero; a run-time error if out of range."
    Floor = "floor(x: Float) -> Int" Pure "The greatest Int not above `x`."
    Ceil = "ceil(x: Float) -> Int" Pure "The smallest Int not below `x`."
    ToFloat = "Float(x: Int) -> Float" Pure "The Float nearest to the Int."
    ToInt = "Int(x: F) -> Int" Pure "The Float without its fraction, a run-time error if out of range; or the number of the robot, as in `robot_name`: robots are numbered from 0 in the order of the scenario."
    ToString = "String(x: Any) -> String" Pure "The value as text."

    // Geometry.
    MakePoint = "Point(x: Float, y: Float, z?: Float) -> Point" Pure "A point, metres; `z` is 0 if omitted."
    Distance = "distance(a: Point, b: Point) -> Float" Pure "The distance between two points, metres."
    Bearing = "bearing(from: Point, to: Point) -> Float" Pure "The direction from one point to another, radians from the x axis."
    Circle = "circle(center: Point, radius: Float) -> Area" Pure "The circle around a point."
    Polygon = "polygon(corners: List[Point]) -> Area" Pure "The convex polygon with these corners."

    // Chance. Each call moves on the robot's stream of random numbers.
    Random = "random(low: Float, high: Float) -> Float" Effect "A random number from `low` to below `high`; `low` if `high` is not greater."
    RandomInt = "random_int(low: Int, high: Int) -> Int" Effect "A random number from `low` to below `high`."
    Choose = "choose(list: List[T]) -> T?" Effect "A random element; none for an empty list."

    // Telling.
    Emit = "emit(name: String, fields = ...)" Effect "Records an event of the program."
    Log = "log(format: String, ...)" Effect "Writes a line to the log; each `{}` stands for the next value."
    DrawPoint = "draw_point(label: String, at: Point)" Effect "Draws a point in the viewer; a later mark with the same label replaces it."
    DrawLine = "draw_line(label: String, points: List[Point])" Effect "Draws a line through points."
    DrawCircle = "draw_circle(label: String, center: Point, radius: Float)" Effect "Draws a circle."
    DrawText = "draw_text(label: String, at: Point)" Effect "Writes the label at a point."
    DrawNothing = "draw_nothing(label: String)" Effect "Removes the mark with the label."
    Finish = "finish()" Effect "Declares that the program has reached its goal."
    Fail = "fail(text: String)" Effect "Declares that the program has failed, with the reason."
    Take = "take(thing: Int)" Effect "Picks up the thing with this number if it is within reach and the robot does not hold one; `holding` shows the result."
    PutDown = "put_down()" Effect "Puts down the thing that the robot holds, at the robot's position."
    Stop = "stop()" Effect "Stops the robot where it is."

    // Commands of robot models. Each holds until another follows, and ends trips of ReachAvoid.
    DriveStraight = "drive_straight(speed: Float)" Effect "Drives straight ahead at `speed` m/s, backwards if it is negative."
    DriveTurn = "drive_turn(rate: Float)" Effect "Turns on the spot at `rate` rad/s, to the left if it is positive."
    DriveCurve = "drive_curve(speed: Float, radius: Float)" Effect "Drives along a circle of `radius` metres at `speed` m/s; its centre is on the left if the radius is positive."
    DriveWheels = "drive_wheels(left: Float, right: Float)" Effect "Turns the wheels of a robot with two driven wheels at these rim speeds, m/s."
    DriveCar = "drive_car(speed: Float, angle: Float)" Effect "Drives a car at `speed` m/s with its front wheels at `angle` radians, to the left if it is positive."
    DriveVelocity = "drive_velocity(velocity: Point, yaw_rate?: Float)" Effect "Moves a robot that can move in any direction: `velocity` in m/s along the axes of the world, `yaw_rate` in rad/s, 0 if omitted."
    DriveAttitude = "drive_attitude(yaw_rate: Float, pitch: Float, roll: Float, gaz: Float)" Effect "Flies a drone in this attitude: `yaw_rate` in rad/s, nose down by `pitch` and right side down by `roll` radians, rising at `gaz` m/s."
    TakeOff = "take_off()" Effect "Makes a drone rise from the ground to the safe height."
    Hover = "hover()" Effect "Makes a drone hold its position in the air."
    Land = "land()" Effect "Makes a drone sink to the ground and stop its rotors."
}

impl Builtin {
    /// The one with this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let has_name = |builtin: &&Self| Signature::name_of(builtin.text()) == name;
        BUILTINS.iter().find(has_name).copied()
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        Signature::name_of(self.text())
    }
}

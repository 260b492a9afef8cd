//! Built-in functions and names.

use super::Purity::{self, Effect, Property, Pure, Query};
use super::Signature;

macro_rules! builtins {
    ($($name:ident = $signature:literal $purity:ident $doc:literal)+) => {
        /// A built-in function or name.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Builtin {
            $(#[doc = $doc] $name,)+
        }

        /// All built-in functions and names.
        pub const BUILTINS: &[Builtin] = &[$(Builtin::$name,)+];

        impl Builtin {
            /// Its signature, as text.
            #[must_use]
            pub const fn text(self) -> &'static str {
                match self {
                    $(Self::$name => $signature,)+
                }
            }

            /// Where it may stand.
            #[must_use]
            pub const fn purity(self) -> Purity {
                match self {
                    $(Self::$name => $purity,)+
                }
            }

            /// The documentation shown to users.
            #[must_use]
            pub const fn documentation(self) -> &'static str {
                match self {
                    $(Self::$name => $doc,)+
                }
            }
        }
    };
}

builtins! {
    // The robot.
    Me = "me: RobotId" Query "This robot's number."
    Position = "position: Point" Query "Where this robot believes to be, metres."
    Heading = "heading: Float" Query "Where it looks, radians from the x axis."
    Velocity = "velocity: Point" Query "How it moves, metres per second."
    Now = "now: Time" Query "The time on its clock."
    Peers = "peers: Set[RobotId]" Query "All robots of the fleet that are known, this one too."
    RobotName = "robot_name(robot: RobotId) -> String" Query "What a robot is called."
    Bumped = "bumped: Side?" Query "Where something touches the robot; none if nothing does."
    Ranges = "ranges: List[Float]" Query "What the proximity sensors measure, metres: the first straight ahead, the others from there to the left, evenly all around."
    Detected = "detected: List[Detection]" Query "The things and robots in sight, nearest first."
    Things = "things: List[Thing]" Query "The things in sight, nearest first."
    Holding = "holding: Int?" Query "The number of the thing that the robot holds; none if it holds nothing."
    ThingName = "thing_name(thing: Int) -> String" Query "The name of the thing with this number; an empty text if there is none."

    AtomicBlocked = "atomic_blocked: Bool" Query "Whether the action with `atomic` that this robot waits for, or has run, cannot go on: no majority of the robots answers."

    // The run.
    Undisturbed = "undisturbed: Duration" Property "How long it is since the start and since the last fault began or was fixed; zero while the network is parted, a motor is stuck or sensors are frozen."
    Uncorrupted = "uncorrupted: Duration" Property "How long it is since the start and since a fault last overwrote the state of robots at random."
    Majority = "majority: Bool" Property "Whether more than half of the robots that run the program have been up at every moment; one that has restarted counts again after 10 s."
    Crashed = "crashed: Int" Property "How many of the robots that run the program are down."

    // Input.
    WayPoints = "way_points() -> List[Point]" Query "The waypoints of the scenario, in their order."
    WayPoint = "way_point(name: String) -> Point?" Query "The waypoint with this name."
    WayPointGroup = "way_point_group(group: Int) -> List[Point]" Query "The waypoints of one group of the scenario, in their order."
    Obstacles = "obstacles() -> Obstacles" Query "The obstacles that the robot knows."
    AreasOf = "areas_of(obstacles: Obstacles) -> List[Area]" Query "The ground that each obstacle takes."
    WithArea = "with_area(obstacles: Obstacles, area: Area) -> Obstacles" Query "The obstacles and one more, as high as the sky."

    // Numbers.
    Pi = "pi: Float" Pure "The ratio of a circle's circumference to its diameter."
    Abs = "abs(x: N) -> N" Pure "The number without its sign; the least Int is a run-time error."
    Min = "min(a: M, b: M) -> M" Pure "The lesser."
    Max = "max(a: M, b: M) -> M" Pure "The greater."
    Clamp = "clamp(x: M, low: M, high: M) -> M" Pure "`x`, but no less than `low` and no more than `high`."
    Sqrt = "sqrt(x: Float) -> Float" Pure "The square root."
    Sin = "sin(angle: Float) -> Float" Pure "The sine."
    Cos = "cos(angle: Float) -> Float" Pure "The cosine."
    Tan = "tan(angle: Float) -> Float" Pure "The tangent."
    Atan2 = "atan2(y: Float, x: Float) -> Float" Pure "The angle of the point (x, y), in (-pi, pi]."
    Exp = "exp(x: Float) -> Float" Pure "The exponential function."
    LogE = "log_e(x: Float) -> Float" Pure "The natural logarithm."
    Pow = "pow(base: Float, exponent: Float) -> Float" Pure "The base to the power of the exponent."
    Round = "round(x: Float) -> Int" Pure "The nearest Int; halves away from zero. Out of range is a run-time error."
    Floor = "floor(x: Float) -> Int" Pure "The greatest Int that is not greater."
    Ceil = "ceil(x: Float) -> Int" Pure "The least Int that is not less."
    ToFloat = "Float(x: Int) -> Float" Pure "The Int as a Float, the nearest one."
    ToInt = "Int(x: Float) -> Int" Pure "The Float without its fraction. Out of range is a run-time error."
    ToString = "String(x: Any) -> String" Pure "The value as text."

    // Geometry.
    MakePoint = "Point(x: Float, y: Float, z?: Float) -> Point" Pure "A point, metres; `z` is 0 if it is left out."
    Distance = "distance(a: Point, b: Point) -> Float" Pure "How far apart two points are, metres."
    Bearing = "bearing(from: Point, to: Point) -> Float" Pure "The direction from one point to another, radians from the x axis."
    Circle = "circle(center: Point, radius: Float) -> Area" Pure "The circle around a point."
    Polygon = "polygon(corners: List[Point]) -> Area" Pure "The convex polygon with these corners."

    // Chance. Each call moves on the robot's stream of random numbers.
    Random = "random(low: Float, high: Float) -> Float" Effect "A random number from `low` to below `high`."
    RandomInt = "random_int(low: Int, high: Int) -> Int" Effect "A random number from `low` to below `high`."
    Choose = "choose(list: List[T]) -> T?" Effect "A random element; none of an empty list."

    // Telling.
    Emit = "emit(name: String, fields = ...)" Effect "Records an event of the program."
    Log = "log(format: String, ...)" Effect "Writes a line to the log; each `{}` stands for the next value."
    DrawPoint = "draw_point(label: String, at: Point)" Effect "Draws a point for the viewer; a later mark with the label replaces it."
    DrawLine = "draw_line(label: String, points: List[Point])" Effect "Draws a line through points."
    DrawCircle = "draw_circle(label: String, center: Point, radius: Float)" Effect "Draws a circle."
    DrawText = "draw_text(label: String, at: Point)" Effect "Writes the label at a point."
    DrawNothing = "draw_nothing(label: String)" Effect "Takes the mark with the label away."
    Finish = "finish()" Effect "Says that the program has reached its goal."
    Fail = "fail(text: String)" Effect "Says that the program cannot go on, and why."
    Take = "take(thing: Int)" Effect "Takes hold of the thing with this number, if it is within reach and the robot holds nothing; `holding` tells whether it worked."
    PutDown = "put_down()" Effect "Puts down the thing that the robot holds, where the robot is."
    Stop = "stop()" Effect "Stops the robot where it is."

    // Commands of robot models. Each holds until another follows, and ends trips of ReachAvoid.
    DriveStraight = "drive_straight(speed: Float)" Effect "Drives straight ahead at `speed` m/s, backwards if it is negative."
    DriveTurn = "drive_turn(rate: Float)" Effect "Turns on the spot at `rate` rad/s, to the left if it is positive."
    DriveCurve = "drive_curve(speed: Float, radius: Float)" Effect "Drives along a circle of `radius` metres at `speed` m/s; its centre is on the left if the radius is positive."
    DriveWheels = "drive_wheels(left: Float, right: Float)" Effect "Turns the wheels of a robot with two driven wheels at these rim speeds, m/s."
    DriveCar = "drive_car(speed: Float, angle: Float)" Effect "Drives a car at `speed` m/s with its front wheels at `angle` radians, to the left if it is positive."
    DriveVelocity = "drive_velocity(velocity: Point, yaw_rate?: Float)" Effect "Moves a robot that can move in any direction: `velocity` in m/s along the axes of the world, `yaw_rate` in rad/s, 0 if it is left out."
    DriveAttitude = "drive_attitude(yaw_rate: Float, pitch: Float, roll: Float, gaz: Float)" Effect "Flies a drone in this attitude: `yaw_rate` in rad/s, nose down by `pitch` and right side down by `roll` radians, rising at `gaz` m/s."
    TakeOff = "take_off()" Effect "A drone rises from the ground to the safe height."
    Hover = "hover()" Effect "A drone holds its position in the air."
    Land = "land()" Effect "A drone sinks to the ground and stops its rotors."
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

    /// Its signature.
    #[must_use]
    pub fn signature(self) -> Signature {
        Signature::read(self.text())
    }
}

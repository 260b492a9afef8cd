//! The driver of ROS 2 robots passes the suite on the emulated one, and tests of its own.

use starl_core::{Command, Estimate, Obstacle, Point, Pose};
use starl_emulate::conformance::{CHECKS, Rig};
use starl_emulate::ros2::{EmulatedRos2, Ros2Setup, router};
use starl_emulate::{BodyHandle, Noise, World};
use starl_motion::models::by_name;
use starl_node::Device;
use starl_node::motors::PositionSource;
use starl_ros2::graph::Qos;
use starl_ros2::message::{LaserScan, Message};
use starl_ros2::node::Context;
use starl_ros2::{Ros2Options, Ros2Robot};
use std::net::TcpListener;
use std::rc::Rc;
use std::sync::atomic::{AtomicU16, Ordering};
use std::sync::{Arc, Mutex};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A free endpoint, given once, and below those that the system gives to sockets that ask for any.
fn endpoint() -> String {
    static GIVEN: AtomicU16 = AtomicU16::new(0);
    let start = 24_000 + (std::process::id() % 40) as u16 * 50;
    loop {
        let port = start + GIVEN.fetch_add(1, Ordering::Relaxed);
        if TcpListener::bind(("127.0.0.1", port)).is_ok() {
            return format!("tcp/127.0.0.1:{port}");
        }
    }
}

struct Robot {
    driver: Ros2Robot,
    body: BodyHandle,
    emulated: EmulatedRos2,
    context: Context,
}

/// A robot in the namespace `/r1`, which stands at (-1, 2) and faces 0.7 rad to the left.
fn robot(model: &str, stamped: bool, world: &World) -> Robot {
    let endpoint = endpoint();
    let start = Pose::level(Point::planar(-1.0, 2.0), 0.7);
    let body = world.add("r1", by_name(model).unwrap(), start).unwrap();
    let limits = body.model().limits();
    let options = Ros2Options {
        router: endpoint.clone(),
        namespace: "/r1".to_string(),
        speed: limits.speed,
        turn_rate: limits.turn_rate,
        ..Ros2Options::default()
    };
    // A robot that is switched on later than its driver is found too.
    let driver = Ros2Robot::connect(&options).unwrap();
    let context = router(&endpoint, 0).unwrap();
    let setup = Ros2Setup {
        namespace: "/r1".to_string(),
        stamped,
        ..Ros2Setup::default()
    };
    let emulated = EmulatedRos2::start(body.clone(), &context, &setup).unwrap();
    Robot {
        driver,
        body,
        emulated,
        context,
    }
}

fn rig(model: &str, stamped: bool) -> Rig {
    let Robot {
        driver,
        body,
        emulated,
        context,
    } = robot(model, stamped, &World::new(Vec::new(), Noise::NONE));
    let emulated = Rc::new(emulated);
    let line = emulated.clone();
    Rig {
        device: Box::new(driver),
        body,
        noise: Box::new(move |bytes| line.interfere(bytes).unwrap()),
        watchdog: Some(Duration::from_millis(500)),
        keep: Box::new((emulated, context)),
    }
}

fn conforms(model: &'static str, stamped: bool) {
    let checks: Vec<_> = CHECKS
        .iter()
        .map(|&(name, check)| (name, std::thread::spawn(move || check(rig(model, stamped)))))
        .collect();
    for (name, check) in checks {
        let measured = check
            .join()
            .unwrap()
            .unwrap_or_else(|failure| panic!("{name}: {failure}"));
        println!("{model} {name}: {measured}");
    }
}

#[test]
fn create_conforms() {
    conforms("create", false);
}

#[test]
fn differential_that_takes_stamped_velocities_conforms() {
    conforms("differential", true);
}

/// Asks again and again until there is an answer, for 20 s at most.
fn wait<T>(mut ask: impl FnMut() -> Option<T>) -> T {
    let limit = Instant::now() + Duration::from_secs(20);
    loop {
        if let Some(answer) = ask() {
            return answer;
        }
        assert!(Instant::now() < limit, "there is no answer");
        sleep(Duration::from_millis(20));
    }
}

#[test]
fn localisation_is_the_true_pose_while_the_robot_drives_a_curve() {
    let mut robot = robot("create", false, &World::new(Vec::new(), Noise::NONE));
    let mut localisation = robot.driver.localisation();
    let curve = Command::Curve {
        speed: 0.2,
        radius: 0.5,
    };
    let mut drive = |body: &BodyHandle| {
        let _ = robot.driver.drive(&curve, &Estimate::default());
        let (_, pose) = localisation.poll().ok()??;
        Some((pose, body.state().pose))
    };
    wait(|| drive(&robot.body).filter(|_| robot.body.odometer().distance > 0.8));
    for _ in 0..5 {
        let (pose, truth) = wait(|| drive(&robot.body));
        let error = pose.position.distance(truth.position);
        assert!(error < 0.05, "{pose:?} instead of {truth:?}");
    }
}

#[test]
fn laser_sees_a_wall_where_it_is() {
    // Straight ahead of the robot's start the wall is 2 m / cos(0.7) away.
    let wall = Obstacle::cuboid(Point::new(1.0, 0.0, 0.0), Point::new(1.5, 20.0, 1.0));
    let robot = robot("create", false, &World::new(vec![wall], Noise::NONE));
    let scans = Arc::new(Mutex::new(None));
    let node = robot.context.node("/r1", "viewer").unwrap();
    let seen = scans.clone();
    let subscription = node.subscribe("scan", Qos::SENSOR_DATA, move |scan: LaserScan| {
        *seen.lock().unwrap() = Some(scan);
    });
    let _subscription = subscription.unwrap();
    let scan = wait(|| scans.lock().unwrap().take());
    let expected = 2.0 / 0.7_f32.cos();
    assert!(
        (scan.ranges[0] - expected).abs() < 0.01,
        "{}",
        scan.ranges[0]
    );
    let behind = scan.ranges[scan.ranges.len() / 2];
    assert!(behind.is_infinite(), "{behind}");
    assert!(LaserScan::decode(&scan.encode()) == Some(scan));
}

#[test]
fn a_robot_that_disappears_is_reported_and_taken_back() {
    let Robot {
        mut driver,
        body,
        emulated,
        context,
    } = robot("create", false, &World::new(Vec::new(), Noise::NONE));
    wait(|| driver.read().ok().flatten());
    drop(emulated);
    let fault = wait(|| driver.read().err()).to_string();
    assert!(fault.contains("no odometry comes on /r1/odom"), "{fault}");
    let setup = Ros2Setup {
        namespace: "/r1".to_string(),
        stamped: true,
        ..Ros2Setup::default()
    };
    let _emulated = EmulatedRos2::start(body.clone(), &context, &setup).unwrap();
    let straight = Command::Straight { speed: 0.3 };
    wait(|| {
        let _ = driver.drive(&straight, &Estimate::default());
        (body.state().twist.linear.length() > 0.2).then_some(())
    });
}

#[test]
fn a_missing_router_and_a_bad_name_are_reported() {
    let options = Ros2Options {
        router: endpoint(),
        ..Ros2Options::default()
    };
    let mut driver = Ros2Robot::connect(&options).unwrap();
    let fault = wait(|| driver.read().err()).to_string();
    assert!(fault.contains("no Zenoh router answers"), "{fault}");
    for (router, namespace, message) in [
        ("nowhere", "", "router: "),
        ("tcp/127.0.0.1:1", "/a*", "namespace: \"/a*\" is not a name"),
    ] {
        let options = Ros2Options {
            router: router.to_string(),
            namespace: namespace.to_string(),
            ..Ros2Options::default()
        };
        let fault = Ros2Robot::connect(&options).unwrap_err().to_string();
        assert!(fault.contains(message), "{fault}");
    }
}

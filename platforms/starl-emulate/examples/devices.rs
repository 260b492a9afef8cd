//! Starts one emulated device of each kind in one world, for programs in other languages to drive.
//!
//! `devices FOLDER` prints a line of JSON that says where the devices are, and answers each line on its standard input
//! with a line of the time in seconds and of true poses by name: `{"seconds": t, "r1": [x, y, z, yaw], ...}`, metres and
//! radians. It ends with its input.

use starl_core::{Obstacle, Point, Pose};
use starl_create::Generation;
use starl_emulate::ardrone::EmulatedArdrone;
use starl_emulate::crazyflie::EmulatedCrazyflie;
use starl_emulate::create::{EmulatedCreate, model};
use starl_emulate::mavlink::EmulatedVehicle;
use starl_emulate::natnet::{Cameras, EmulatedNatNet};
use starl_emulate::vrpn::EmulatedVrpn;
use starl_emulate::{Noise, World};
use starl_mavlink::Autopilot;
use starl_motion::models::by_name;
use std::error::Error;
use std::io::{BufRead, stdin};
use std::net::SocketAddr;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let folder: PathBuf = std::env::args_os()
        .nth(1)
        .ok_or("usage: devices FOLDER")?
        .into();
    let wall = Obstacle::cuboid(Point::new(0.2, -0.5, 0.0), Point::new(4.0, -0.3, 0.4));
    let world = World::new(vec![wall], Noise::NONE);
    let start = Pose::level(Point::planar(1.0, -2.0), 0.5);
    let body = world.add("create", model(Generation::Create2), start)?;
    let create = EmulatedCreate::start(body, Some(&folder.join("create")))?;
    let hangar = Pose::level(Point::planar(-3.0, 1.0), -0.4);
    let body = world.add("drone", by_name("drone").ok_or("no model")?, hangar)?;
    let any: SocketAddr = "127.0.0.1:0".parse()?;
    let drone = EmulatedArdrone::start(body, any, any)?;
    let natnet = |version| {
        let cameras = Cameras {
            version,
            ..Cameras::default()
        };
        EmulatedNatNet::start(world.clone(), any, cameras)
    };
    let (natnet_3, natnet_4) = (natnet((3, 1))?, natnet((4, 1))?);
    let vrpn = EmulatedVrpn::start(world.clone(), any)?;
    let vehicle = |name, autopilot, y| {
        let start = Pose::level(Point::planar(-20.0, y), 0.3);
        let body = world.add(name, by_name("drone").ok_or("no model")?, start)?;
        EmulatedVehicle::start(body, autopilot, any, None).map_err(Box::<dyn Error>::from)
    };
    let px4 = vehicle("px4", Autopilot::Px4, 0.0)?;
    let ardupilot = vehicle("ardupilot", Autopilot::ArduPilot, 20.0)?;
    let shelf = Pose::level(Point::planar(20.0, 20.0), 1.2);
    let body = world.add("crazyflie", by_name("drone").ok_or("no model")?, shelf)?;
    let crazyflie = EmulatedCrazyflie::start(body, any)?;
    #[cfg(feature = "ros2")]
    let (_ros2, ros2_port) = ros2(&world)?;
    #[cfg(not(feature = "ros2"))]
    let ros2_port = 0;
    let ports = [
        ("ros2", SocketAddr::new(any.ip(), ros2_port)),
        ("commands", drone.commands()),
        ("navdata", drone.navdata()?),
        ("natnet_3", natnet_3.address()),
        ("natnet_4", natnet_4.address()),
        ("vrpn", vrpn.address()),
        ("crazyflie", crazyflie.address()?),
        ("px4", px4.address()?),
        ("ardupilot", ardupilot.address()?),
    ];
    let ports = ports.map(|(name, address)| format!(", {name:?}: {}", address.port()));
    println!(r#"{{"create": {:?}{}}}"#, create.path(), ports.concat());
    for line in stdin().lock().lines() {
        line?;
        let poses: Vec<String> = world
            .poses()
            .into_iter()
            .map(|(name, pose)| {
                let Point { x, y, z } = pose.position;
                format!("{name:?}: [{x}, {y}, {z}, {}]", pose.yaw)
            })
            .collect();
        let seconds = world.elapsed().seconds();
        println!(r#"{{"seconds": {seconds}, {}}}"#, poses.join(", "));
    }
    Ok(())
}

/// Two ROS 2 robots at a router of their own: `/twist` takes `Twist`, `/stamped` takes `TwistStamped`.
#[cfg(feature = "ros2")]
fn ros2(world: &World) -> Result<(Box<dyn std::any::Any>, u16), Box<dyn Error>> {
    use starl_emulate::ros2::{EmulatedRos2, Ros2Setup, router};
    let port = std::net::TcpListener::bind("127.0.0.1:0")?
        .local_addr()?
        .port();
    let context = router(&format!("tcp/127.0.0.1:{port}"), 0)?;
    let robot = |name: &str, model, y, stamped| {
        let start = Pose::level(Point::planar(40.0, y), 0.8);
        let body = world.add(name, by_name(model).ok_or("no model")?, start)?;
        let setup = Ros2Setup {
            namespace: format!("/{name}"),
            stamped,
            ..Ros2Setup::default()
        };
        EmulatedRos2::start(body, &context, &setup).map_err(Box::<dyn Error>::from)
    };
    let robots = [
        robot("twist", "create", 0.0, false)?,
        robot("stamped", "differential", 3.0, true)?,
    ];
    Ok((Box::new((robots, context)), port))
}

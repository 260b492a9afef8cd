//! Drives a robot along a curve for three seconds: `drive ROUTER NAMESPACE`.
//!
//! At the end it prints where the robot is by its odometry, from where it stood, and by its localisation on the map: x, y
//! and yaw of each, in metres and radians.

use starl_core::{Command, Estimate, Pose};
use starl_node::motors::PositionSource;
use starl_node::{Device, Reading};
use starl_ros2::frames::inside;
use starl_ros2::{Ros2Options, Ros2Robot};
use std::error::Error;
use std::thread::sleep;
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut next = || arguments.next().ok_or("usage: drive ROUTER NAMESPACE");
    let options = Ros2Options {
        router: next()?,
        namespace: next()?,
        ..Ros2Options::default()
    };
    let mut robot = Ros2Robot::connect(&options)?;
    let mut localisation = robot.localisation();
    let (mut odometry, mut on_map) = (Pose::default(), None);
    let mut listen = |robot: &mut Ros2Robot| -> Result<bool, Box<dyn Error>> {
        sleep(Duration::from_millis(20));
        let reading = robot.read()?;
        if let Some(Reading {
            moved: Some(moved),
            turned: Some(turned),
            ..
        }) = reading
        {
            odometry = inside(&odometry, &Pose::level(moved, turned));
        }
        on_map = localisation.poll()?.map(|(_, pose)| pose).or(on_map);
        Ok(reading.is_some())
    };
    while !listen(&mut robot)? {}
    let begun = Instant::now();
    let curve = Command::Curve {
        speed: 0.2,
        radius: 0.8,
    };
    while begun.elapsed() < Duration::from_secs(3) {
        robot.drive(&curve, &Estimate::default())?;
        listen(&mut robot)?;
    }
    robot.stop()?;
    let stopped = Instant::now();
    while stopped.elapsed() < Duration::from_millis(500) {
        listen(&mut robot)?;
    }
    for pose in [odometry, on_map.ok_or("no position on the map has come")?] {
        println!("{} {} {}", pose.position.x, pose.position.y, pose.yaw);
    }
    Ok(())
}

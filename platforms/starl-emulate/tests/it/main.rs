//! The tests of `starl-emulate`, in one binary so that they link once.

mod ardrone_conforms;
mod bodies_conform;
mod crazyflie_conforms;
mod create_conforms;
mod mavlink_conforms;
mod natnet_follows;
#[cfg(feature = "ros2")]
mod ros2_conforms;
mod vrpn_follows;
mod world;

//! Decoding the messages and the tokens of ROS 2 robots never panics, and takes no more memory than the message is long;
//! what is understood comes back the same.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_ros2::graph::topic_of_token;
use starl_ros2::message::{LaserScan, Message, Odometry, Transforms, Twist, TwistStamped};

/// NaN is not equal to itself, so texts are compared.
fn returns<M: Message + std::fmt::Debug>(bytes: &[u8]) -> Option<M> {
    let understood = M::decode(bytes)?;
    let again = M::decode(&understood.encode()).expect("it was encoded here");
    assert_eq!(format!("{again:?}"), format!("{understood:?}"));
    Some(understood)
}

fuzz_target!(|bytes: &[u8]| {
    returns::<Twist>(bytes);
    returns::<TwistStamped>(bytes);
    returns::<Odometry>(bytes);
    if let Some(Transforms(transforms)) = returns(bytes) {
        assert!(72 * transforms.len() <= bytes.len());
    }
    if let Some(LaserScan { ranges, .. }) = returns(bytes) {
        assert!(4 * ranges.len() <= bytes.len());
    }
    if let Ok(token) = std::str::from_utf8(bytes) {
        let _ = topic_of_token(token);
    }
});

//! Decoding the messages and the tokens of ROS 2 robots never panics, and takes no more memory than the message is long;
//! what is understood comes back the same.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_core::Pose;
use starl_ros2::graph::topic_of_token;
use starl_ros2::message::{LaserScan, Message, Odometry, Transforms, Twist, TwistStamped};

/// Texts are compared, since NaN is not equal to itself. Orientations are sent as quaternions and read as angles, so they
/// come back within an error of rounding, perhaps by other angles.
fn returns<M: Message + std::fmt::Debug>(
    bytes: &[u8],
    poses: fn(&mut M) -> Vec<&mut Pose>,
) -> Option<M> {
    let mut understood = M::decode(bytes)?;
    let mut again = M::decode(&understood.encode()).expect("it was encoded here");
    for (sent, came) in poses(&mut understood).into_iter().zip(poses(&mut again)) {
        let pairs = sent.quaternion().into_iter().zip(came.quaternion());
        let alike = pairs.map(|(one, two)| one * two).sum::<f64>().abs();
        assert!((alike - 1.0).abs() < 1e-9, "{sent:?} came back as {came:?}");
        *came = Pose {
            position: came.position,
            ..*sent
        };
    }
    assert_eq!(format!("{again:?}"), format!("{understood:?}"));
    Some(understood)
}

fuzz_target!(|bytes: &[u8]| {
    returns::<Twist>(bytes, |_| Vec::new());
    returns::<TwistStamped>(bytes, |_| Vec::new());
    returns::<Odometry>(bytes, |odometry| vec![&mut odometry.pose]);
    let transforms = returns::<Transforms>(bytes, |transforms| {
        transforms.0.iter_mut().map(|one| &mut one.pose).collect()
    });
    if let Some(Transforms(transforms)) = transforms {
        assert!(72 * transforms.len() <= bytes.len());
    }
    if let Some(LaserScan { ranges, .. }) = returns(bytes, |_| Vec::new()) {
        assert!(4 * ranges.len() <= bytes.len());
    }
    if let Ok(token) = std::str::from_utf8(bytes) {
        let _ = topic_of_token(token);
    }
});

//! The bytes and names of ROS 2: the examples of its documents, what is encoded is decoded, and any bytes are taken.

use starl_core::{Point, Pose, Random};
use starl_ros2::graph::{self, NodeName, Qos, Role, Topic, topic_of_token};
use starl_ros2::message::{
    Header, LaserScan, Message, Odometry, Transform, Transforms, Twist, TwistStamped,
};

fn header(frame: &str) -> Header {
    Header {
        seconds: -7,
        nanoseconds: 999_999_999,
        frame: frame.to_string(),
    }
}

fn twist() -> Twist {
    Twist {
        linear: Point::new(0.5, -0.25, 0.125),
        angular: Point::new(0.0, 0.0, -1.5),
    }
}

fn odometry() -> Odometry {
    Odometry {
        header: header("odom"),
        child: "base_link".to_string(),
        pose: Pose::level(Point::new(1.0, 2.0, 0.0), 0.0),
        twist: twist(),
    }
}

fn transforms() -> Transforms {
    let transform = |child: &str| Transform {
        header: header("map"),
        child: child.to_string(),
        pose: Pose::level(Point::new(-1.0, 0.5, 0.0), 0.0),
    };
    // Names of every length modulo the alignment of what follows.
    Transforms(["", "a", "ab", "abc", "abcd"].map(transform).to_vec())
}

fn scan() -> LaserScan {
    LaserScan {
        header: header("laser"),
        first: -3.0,
        step: 0.5,
        nearest: 0.1,
        farthest: 8.0,
        period: 0.1,
        ranges: vec![1.0, f32::INFINITY, 2.5],
    }
}

#[test]
fn a_twist_has_the_bytes_of_plain_cdr() {
    let bytes = twist().encode();
    assert_eq!(bytes[..4], [0, 1, 0, 0]);
    assert_eq!(bytes[4..12], 0.5_f64.to_le_bytes());
    assert_eq!(bytes[44..], (-1.5_f64).to_le_bytes());
    assert_eq!(bytes.len(), 4 + 6 * 8);
}

#[test]
fn values_are_aligned_to_their_size() {
    let stamped = TwistStamped {
        header: header("abc"),
        twist: twist(),
    };
    let bytes = stamped.encode();
    // Seconds, nanoseconds, the length of the name with its zero, the name, and then a number of eight bytes.
    assert_eq!(bytes[12..20], *b"\x04\0\0\0abc\0");
    assert_eq!(bytes[20..28], 0.5_f64.to_le_bytes());
    let longer = TwistStamped {
        header: header("abcd"),
        ..stamped
    };
    assert_eq!(longer.encode()[28..36], 0.5_f64.to_le_bytes());
}

fn returns<M: Message + PartialEq + std::fmt::Debug>(message: &M) {
    assert_eq!(M::decode(&message.encode()).as_ref(), Some(message));
}

#[test]
fn messages_are_decoded_as_they_were() {
    returns(&twist());
    returns(&TwistStamped {
        header: header("base_link"),
        twist: twist(),
    });
    returns(&odometry());
    returns(&transforms());
    returns(&scan());
}

/// Cut anywhere, a message makes no sense.
fn refuses_parts<M: Message>(message: &M) {
    let bytes = message.encode();
    for length in 0..bytes.len() {
        assert!(M::decode(&bytes[..length]).is_none(), "{length} bytes");
    }
}

#[test]
fn parts_of_messages_are_refused() {
    refuses_parts(&twist());
    refuses_parts(&odometry());
    refuses_parts(&transforms());
}

#[test]
fn a_rotation_that_is_none_is_refused() {
    let mut bytes = odometry().encode();
    // The quaternion is 0, 0, 0, 1.
    let one = bytes
        .windows(8)
        .position(|eight| eight == 1.0_f64.to_le_bytes());
    let w = one.unwrap() + 6 * 8;
    assert_eq!(bytes[w..w + 8], 1.0_f64.to_le_bytes());
    bytes[w..w + 8].copy_from_slice(&0.0_f64.to_le_bytes());
    assert_eq!(Odometry::decode(&bytes), None);
}

#[test]
fn any_bytes_are_taken_without_panic() {
    let messages = [
        twist().encode(),
        odometry().encode(),
        transforms().encode(),
        scan().encode(),
    ];
    let mut random = Random::keyed(5, &[]);
    for round in 0..40_000_usize {
        let mut bytes = messages[round % messages.len()].clone();
        if round % 3 == 0 {
            bytes = (0..random.below(400))
                .map(|_| random.bits() as u8)
                .collect();
            bytes.splice(..bytes.len().min(4), [0, 1, 0, 0]);
        } else {
            for _ in 0..1 + random.below(8) {
                let at = random.below(bytes.len() as u32) as usize;
                bytes[at] = random.bits() as u8;
            }
            bytes.truncate(random.below(2 * bytes.len() as u32) as usize);
        }
        let _ = Twist::decode(&bytes);
        let _ = TwistStamped::decode(&bytes);
        let _ = Odometry::decode(&bytes);
        let _ = LaserScan::decode(&bytes);
        if let Some(Transforms(all)) = Transforms::decode(&bytes) {
            assert!(all.len() * 72 <= bytes.len());
        }
        let _ = topic_of_token(&String::from_utf8_lossy(&bytes));
    }
}

fn node() -> NodeName {
    NodeName {
        domain: 2,
        session: "aac3178e146ba6f1fc6e6a4085e77f21".to_string(),
        number: 0,
        namespace: String::new(),
        name: "listener".to_string(),
    }
}

fn chatter() -> Topic {
    Topic {
        name: "/chatter".to_string(),
        kind: "std_msgs::msg::dds_::String_".to_string(),
        hash: "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18".to_string(),
    }
}

/// The examples of rmw_zenoh's design document, with the default number of messages kept.
#[test]
fn names_are_those_of_rmw_zenoh() {
    let node = node();
    let session = &node.session;
    assert_eq!(
        node.token(),
        format!("@ros2_lv/2/{session}/0/0/NN/%/%/listener")
    );
    let topic = chatter();
    let Topic { kind, hash, .. } = &topic;
    let token = node.endpoint_token(10, Role::Subscription, &topic, Qos::DEFAULT);
    assert_eq!(
        token,
        format!("@ros2_lv/2/{session}/0/10/MS/%/%/listener/%chatter/{kind}/{hash}/::,10:,:,:,,")
    );
    assert_eq!(topic_of_token(&token), Some(topic.clone()));
    assert_eq!(topic_of_token(&node.token()), None);
    assert_eq!(topic.key(0), format!("0/chatter/{kind}/{hash}"));
    assert_eq!(Qos::SENSOR_DATA.to_string(), "2::,5:,:,:,,");
}

#[test]
fn namespaces_are_parts_of_names() {
    let node = NodeName {
        namespace: "/a/r1".to_string(),
        ..node()
    };
    assert!(node.token().ends_with("/NN/%/%a%r1/listener"));
    assert_eq!(graph::full_name("/a/r1", "odom"), "/a/r1/odom");
    assert_eq!(graph::full_name("/a/r1", "/tf"), "/tf");
    assert!(graph::is_name("/a/r1") && graph::is_name("_b"));
    for bad in ["", "/", "/a//b", "/a/", "1a", "/a*", "a b", "a%b"] {
        assert!(!graph::is_name(bad), "{bad:?}");
    }
}

#[test]
fn an_attachment_has_33_bytes() {
    let bytes = graph::attachment(1, 2, [7; 16]);
    assert_eq!(bytes.len(), 33);
    assert_eq!(bytes[..8], 1_u64.to_le_bytes());
    assert_eq!(bytes[8..17], [2, 0, 0, 0, 0, 0, 0, 0, 16]);
    assert_eq!(bytes[17..], [7; 16]);
}

//! Names in the graph of ROS 2, as rmw_zenoh puts them into the keys of Zenoh.
//!
//! A topic's messages are put under `DOMAIN/TOPIC/TYPE/HASH`. Each node, publisher and subscription declares a
//! liveliness token under `@ros2_lv`, by which others know that it is there, and what it speaks. A `/` in a part of a
//! token is written as `%`.

use std::fmt;

/// The space of liveliness tokens.
const TOKENS: &str = "@ros2_lv";

/// Bytes of the number of a publisher.
pub const GID_LENGTH: usize = 16;

/// How a topic is delivered. Other policies have their defaults: volatile, the last messages are kept, no deadline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Qos {
    /// Whether messages are delivered reliably.
    pub reliable: bool,
    /// How many messages are kept.
    pub depth: u32,
}

impl Qos {
    /// Of topics in general.
    pub const DEFAULT: Qos = Qos {
        reliable: true,
        depth: 10,
    };
    /// Of sensors: late data is useless.
    pub const SENSOR_DATA: Qos = Qos {
        reliable: false,
        depth: 5,
    };
    /// Of transforms.
    pub const TRANSFORMS: Qos = Qos {
        reliable: true,
        depth: 100,
    };
}

/// As in a token: policies that have their defaults are left out.
impl fmt::Display for Qos {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let reliability = if self.reliable { "" } else { "2" };
        write!(f, "{reliability}::,{}:,:,:,,", self.depth)
    }
}

/// The part of an endpoint in a topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It sends.
    Publisher,
    /// It receives.
    Subscription,
}

impl Role {
    fn code(self) -> &'static str {
        match self {
            Role::Publisher => "MP",
            Role::Subscription => "MS",
        }
    }
}

/// A topic with the type of its messages.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Topic {
    /// Its full name, e.g. `/r1/cmd_vel`.
    pub name: String,
    /// The type of its messages.
    pub kind: String,
    /// The hash of the type.
    pub hash: String,
}

impl Topic {
    /// The key of its messages.
    pub fn key(&self, domain: u32) -> String {
        let name = self.name.trim_start_matches('/');
        format!("{domain}/{name}/{}/{}", self.kind, self.hash)
    }
}

/// A node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NodeName {
    /// The domain, 0 unless robots are kept apart by it.
    pub domain: u32,
    /// The number of its session, hexadecimal.
    pub session: String,
    /// Its number in the session.
    pub number: u32,
    /// Its namespace, e.g. `/r1`; empty for none.
    pub namespace: String,
    /// Its own name.
    pub name: String,
}

impl NodeName {
    /// The token of the node.
    pub fn token(&self) -> String {
        self.of_entity(self.number, "NN")
    }

    /// The token of one of its endpoints.
    pub fn endpoint_token(&self, number: u32, role: Role, topic: &Topic, qos: Qos) -> String {
        let entity = self.of_entity(number, role.code());
        let Topic { name, kind, hash } = topic;
        format!("{entity}/{}/{kind}/{hash}/{qos}", mangled(name))
    }

    fn of_entity(&self, number: u32, code: &str) -> String {
        let NodeName {
            domain,
            session,
            number: node,
            namespace,
            name,
        } = self;
        let namespace = mangled(namespace);
        // There is no enclave: the fleet's link is protected, the robot's own network is not ours.
        format!("{TOKENS}/{domain}/{session}/{node}/{number}/{code}/%/{namespace}/{name}")
    }
}

/// A pattern that matches the tokens of all endpoints of a topic with this role.
pub fn any_token(domain: u32, role: Role, topic: &str) -> String {
    let code = role.code();
    let topic = mangled(topic);
    format!("{TOKENS}/{domain}/*/*/*/{code}/*/*/*/{topic}/*/*/*")
}

/// The topic in an endpoint's token; `None` if it is not such a token.
pub fn topic_of_token(token: &str) -> Option<Topic> {
    let parts: Vec<&str> = token.split('/').collect();
    let [TOKENS, .., name, kind, hash, _qos] = *parts.as_slice() else {
        return None;
    };
    (parts.len() == 13).then(|| Topic {
        name: name.replace('%', "/"),
        kind: kind.to_string(),
        hash: hash.to_string(),
    })
}

/// A name in a namespace; a name that begins with `/` is not in it.
pub fn full_name(namespace: &str, name: &str) -> String {
    match name.starts_with('/') {
        true => name.to_string(),
        false => format!("{namespace}/{name}"),
    }
}

/// Whether ROS allows a name: words of letters, digits and `_` that do not begin with a digit, with `/` between them.
pub fn is_name(name: &str) -> bool {
    let is_word = |word: &str| {
        let mut letters = word.bytes();
        let first = letters.next();
        first.is_some_and(|first| first.is_ascii_alphabetic() || first == b'_')
            && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == b'_')
    };
    name.strip_prefix('/')
        .unwrap_or(name)
        .split('/')
        .all(is_word)
}

fn mangled(name: &str) -> String {
    match name {
        "" => "%".to_string(),
        _ => name.replace('/', "%"),
    }
}

/// The attachment of a message: its number from 1, the time when it was sent, and the number of its publisher.
pub fn attachment(number: u64, unix_ns: u64, gid: [u8; GID_LENGTH]) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(17 + GID_LENGTH);
    bytes.extend(number.to_le_bytes());
    bytes.extend(unix_ns.to_le_bytes());
    bytes.push(GID_LENGTH as u8);
    bytes.extend(gid);
    bytes
}

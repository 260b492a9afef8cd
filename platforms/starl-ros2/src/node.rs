//! A node of ROS 2 in a session of Zenoh: publishers, subscriptions, and the liveliness tokens by which others see them.

use crate::graph::{self, GID_LENGTH, NodeName, Qos, Role, Topic};
use crate::message::Message;
use starl_zenoh::{ZenohError, ZenohOptions};
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::Subscriber;
use zenoh::qos::CongestionControl;
use zenoh::sample::SampleKind;
use zenoh::{Session, Wait};

/// A session and the nodes in it. Clones are the same session, which ends with the last of them and of their nodes.
#[derive(Clone, Debug)]
pub struct Context {
    session: Session,
    domain: u32,
    /// The number of the next node or endpoint.
    next: Arc<AtomicU32>,
}

impl Context {
    /// Opens a session in a domain. A client waits until its router is there.
    ///
    /// # Errors
    /// If an endpoint is malformed or cannot be listened on.
    pub fn open(options: &ZenohOptions, domain: u32) -> Result<Context, ZenohError> {
        Ok(Context {
            session: starl_zenoh::session(options)?,
            domain,
            next: Arc::default(),
        })
    }

    /// The same session, for nodes of another domain.
    pub fn in_domain(&self, domain: u32) -> Context {
        Context {
            domain,
            ..self.clone()
        }
    }

    /// Adds a node with this name to a namespace, e.g. `/r1`; an empty one is none.
    ///
    /// # Errors
    /// If the session is closed.
    pub fn node(&self, namespace: &str, name: &str) -> Result<Node, ZenohError> {
        let name = NodeName {
            domain: self.domain,
            session: self.session.zid().to_string(),
            number: self.number(),
            namespace: namespace.to_string(),
            name: name.to_string(),
        };
        Ok(Node {
            _token: self
                .session
                .liveliness()
                .declare_token(name.token())
                .wait()?,
            name,
            context: self.clone(),
        })
    }

    fn number(&self) -> u32 {
        self.next.fetch_add(1, Ordering::Relaxed)
    }
}

/// A node. Its name disappears from the graph when this is dropped.
#[derive(Debug)]
pub struct Node {
    context: Context,
    name: NodeName,
    _token: LivelinessToken,
}

impl Node {
    /// A name in the node's namespace.
    pub fn full_name(&self, name: &str) -> String {
        graph::full_name(&self.name.namespace, name)
    }

    /// A publisher of messages of this type.
    ///
    /// # Errors
    /// If the session is closed, or the topic's name cannot be one.
    pub fn publish<M: Message>(&self, topic: &str, qos: Qos) -> Result<Publisher, ZenohError> {
        self.publish_as(self.topic::<M>(topic), qos)
    }

    /// A publisher of a topic whose type is known by its name alone.
    ///
    /// # Errors
    /// If the session is closed, or the topic's name cannot be one.
    pub fn publish_as(&self, topic: Topic, qos: Qos) -> Result<Publisher, ZenohError> {
        let session = &self.context.session;
        let number = self.context.number();
        let mut gid: [u8; GID_LENGTH] = session.zid().to_le_bytes();
        for (byte, own) in gid.iter_mut().rev().zip(number.to_le_bytes()) {
            *byte ^= own;
        }
        Ok(Publisher {
            key: topic.key(self.context.domain),
            gid,
            sent: AtomicU64::new(0),
            _token: self.declare(number, Role::Publisher, &topic, qos)?,
            session: session.clone(),
        })
    }

    /// Hands each message of a topic to `take`. Messages that make no sense are left out. Robots with a version of ROS
    /// that has no hashes of types are heard too.
    ///
    /// # Errors
    /// If the session is closed, or the topic's name cannot be one.
    pub fn subscribe<M: Message>(
        &self,
        topic: &str,
        qos: Qos,
        take: impl Fn(M) + Send + Sync + 'static,
    ) -> Result<Subscription, ZenohError> {
        let topic = self.topic::<M>(topic);
        let number = self.context.number();
        let any = Topic {
            hash: "*".to_string(),
            ..topic.clone()
        };
        let subscriber = self
            .context
            .session
            .declare_subscriber(any.key(self.context.domain));
        let subscriber = subscriber.callback(move |sample| {
            if let Some(message) = M::decode(&sample.payload().to_bytes()) {
                take(message);
            }
        });
        Ok(Subscription {
            _subscriber: subscriber.wait()?,
            _token: Some(self.declare(number, Role::Subscription, &topic, qos)?),
        })
    }

    /// Tells `change` of every endpoint of a topic with this role that appears or disappears, by its token; at first of
    /// those that are there.
    ///
    /// # Errors
    /// If the session is closed, or the topic's name cannot be one.
    pub fn watch(
        &self,
        role: Role,
        topic: &str,
        change: impl Fn(&str, bool) + Send + Sync + 'static,
    ) -> Result<Subscription, ZenohError> {
        let tokens = graph::any_token(self.context.domain, role, &self.full_name(topic));
        let liveliness = self.context.session.liveliness();
        let subscriber = liveliness.declare_subscriber(tokens).history(true);
        let subscriber = subscriber
            .callback(move |sample| change(sample.key_expr(), sample.kind() == SampleKind::Put));
        Ok(Subscription {
            _subscriber: subscriber.wait()?,
            _token: None,
        })
    }

    fn topic<M: Message>(&self, name: &str) -> Topic {
        Topic {
            name: self.full_name(name),
            kind: M::TYPE.to_string(),
            hash: M::HASH.to_string(),
        }
    }

    fn declare(
        &self,
        number: u32,
        role: Role,
        topic: &Topic,
        qos: Qos,
    ) -> Result<LivelinessToken, ZenohError> {
        let token = self.name.endpoint_token(number, role, topic, qos);
        Ok(self
            .context
            .session
            .liveliness()
            .declare_token(token)
            .wait()?)
    }
}

/// Sends the messages of one topic.
#[derive(Debug)]
pub struct Publisher {
    session: Session,
    key: String,
    gid: [u8; GID_LENGTH],
    sent: AtomicU64,
    _token: LivelinessToken,
}

impl Publisher {
    /// Sends a message. It is lost if the network is congested.
    ///
    /// # Errors
    /// If the session is closed.
    pub fn put(&self, message: &impl Message) -> Result<(), ZenohError> {
        self.put_bytes(message.encode())
    }

    /// Sends the bytes of a message.
    ///
    /// # Errors
    /// If the session is closed.
    pub fn put_bytes(&self, bytes: Vec<u8>) -> Result<(), ZenohError> {
        let since = SystemTime::now().duration_since(UNIX_EPOCH);
        let now = since.unwrap_or_default().as_nanos() as u64;
        let number = 1 + self.sent.fetch_add(1, Ordering::Relaxed);
        let put = self.session.put(&self.key, bytes);
        put.attachment(graph::attachment(number, now, self.gid))
            .congestion_control(CongestionControl::Drop)
            .express(true)
            .wait()?;
        Ok(())
    }
}

/// Hears the messages of one topic, or of its endpoints, until it is dropped.
#[derive(Debug)]
pub struct Subscription {
    _subscriber: Subscriber<()>,
    _token: Option<LivelinessToken>,
}

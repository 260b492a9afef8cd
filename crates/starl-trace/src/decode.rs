//! Events from JSON: the other half of [`crate::encode`].
//!
//! Files are untrusted: a missing or duplicate member, or one of a wrong type, is an error with a reason, never a
//! panic. Unknown members are ignored, by the version policy.

use crate::Topic;
use crate::error::Malformed;
use crate::json::from_base64;
use crate::wire;
use serde::Deserialize;
use starl_core::event::{DropReason, Hit, Level, Mark, Name};
use starl_core::event::{Fault, PrimitiveEvent};
use starl_core::{Destination, Event, Intervention, Payload, Point, Port, Pose, RobotId};

/// A decoded message: on which robot, and what happened. The error names the problem.
type Decoded = Result<(Option<RobotId>, Event), Malformed>;

/// Reads the message of a topic that carries events.
pub(crate) fn event(topic: Topic, text: &[u8]) -> Decoded {
    match topic {
        Topic::Pose => pose(text).map(|(robot, pose)| (robot, Event::Moved(pose))),
        Topic::Estimate => pose(text).map(|(robot, pose)| (robot, Event::Estimated(pose))),
        Topic::Sent => sent(text),
        Topic::Delivered => delivered(text),
        Topic::Dropped => dropped(text),
        Topic::Collision => collision(text),
        Topic::Action => action(text),
        Topic::Program => program(text),
        Topic::Primitive => primitive(text),
        Topic::Log => log(text),
        Topic::Mark => mark(text),
        Topic::Fault => fault(text),
        Topic::Discovered => discovered(text),
        Topic::Status => status(text),
        Topic::Violation => violation(text),
        Topic::Thing => thing(text),
        Topic::Intervention => intervention(text),
        Topic::Summary => Err("a summary is not an event".into()),
    }
}

/// Reads JSON; the error names the place in the message.
pub(crate) fn parse<'a, T: Deserialize<'a>>(text: &'a [u8]) -> Result<T, Malformed> {
    Ok(serde_json::from_slice(text)?)
}

fn pose(text: &[u8]) -> Result<(Option<RobotId>, Pose), Malformed> {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        x: f64,
        y: f64,
        z: f64,
        yaw: f64,
        pitch: f64,
        roll: f64,
    }
    let Message {
        robot,
        x,
        y,
        z,
        yaw,
        pitch,
        roll,
    } = parse(text)?;
    Ok((
        robot,
        Pose {
            position: starl_core::Point::new(x, y, z),
            yaw,
            pitch,
            roll,
        },
    ))
}

fn sent(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message<'a> {
        robot: Option<RobotId>,
        sequence: u32,
        to: Option<RobotId>,
        port: Port,
        payload: std::borrow::Cow<'a, str>,
    }
    let message: Message<'_> = parse(text)?;
    let bytes = from_base64(&message.payload).ok_or("the payload is not base64")?;
    let event = Event::Sent {
        sequence: message.sequence,
        destination: message.to.map_or(Destination::All, Destination::Robot),
        port: message.port,
        payload: Payload::from_vec(bytes),
    };
    Ok((message.robot, event))
}

fn delivered(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        from: RobotId,
        sequence: u32,
    }
    let Message {
        robot,
        from,
        sequence,
    } = parse(text)?;
    Ok((robot, Event::Delivered { from, sequence }))
}

fn dropped(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        from: RobotId,
        to: Option<RobotId>,
        sequence: u32,
        reason: DropReason,
    }
    let Message {
        robot,
        from,
        to,
        sequence,
        reason,
    } = parse(text)?;
    Ok((
        robot,
        Event::Dropped {
            from,
            to,
            sequence,
            reason,
        },
    ))
}

fn collision(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        with_robot: Option<RobotId>,
        with_obstacle: Option<u32>,
    }
    let message: Message = parse(text)?;
    let with = match (message.with_robot, message.with_obstacle) {
        (Some(robot), None) => Hit::Robot(robot),
        (None, Some(index)) => Hit::Obstacle(index),
        _ => return Err("needs either `with_robot` or `with_obstacle`".into()),
    };
    Ok((message.robot, Event::Collided { with }))
}

fn action(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        name: String,
    }
    let Message { robot, name } = parse(text)?;
    Ok((robot, Event::Action(name.into())))
}

fn program(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        name: String,
        fields: Vec<wire::Field>,
    }
    let Message {
        robot,
        name,
        fields,
    } = parse(text)?;
    Ok((
        robot,
        Event::Program {
            name: name.into(),
            fields: wire::fields(fields)?,
        },
    ))
}

fn primitive(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        primitive: String,
        port: Port,
        name: String,
        fields: Vec<wire::Field>,
    }
    let message: Message = parse(text)?;
    let fields = wire::fields(message.fields)?;
    let event = Event::Primitive {
        port: message.port,
        event: PrimitiveEvent::named(message.primitive, message.name, fields),
    };
    Ok((message.robot, event))
}

fn log(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        level: Level,
        text: String,
    }
    let Message { robot, level, text } = parse(text)?;
    Ok((
        robot,
        Event::Log {
            level,
            text: text.into(),
        },
    ))
}

fn mark(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        label: String,
        #[serde(flatten)]
        shape: wire::Mark,
    }
    let Message {
        robot,
        label,
        shape,
    } = parse(text)?;
    let mark = Mark {
        label: label.into(),
        shape: shape.try_into()?,
    };
    Ok((robot, Event::Draw(mark)))
}

fn fault(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        text: String,
    }
    let Message { robot, text } = parse(text)?;
    Ok((robot, Event::Fault(Fault::named(text.into()))))
}

fn discovered(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        obstacle: wire::Obstacle,
    }
    let Message { robot, obstacle } = parse(text)?;
    Ok((robot, Event::Discovered(obstacle.try_into()?)))
}

fn status(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        status: String,
        reason: Option<Name>,
    }
    let message: Message = parse(text)?;
    let event = match (message.status.as_str(), message.reason) {
        ("finished", None) => Event::Finished,
        ("failed", Some(reason)) => Event::Failed(reason),
        _ => return Err("needs the status `finished`, or `failed` and a reason".into()),
    };
    Ok((message.robot, event))
}

fn thing(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        thing: u32,
        put_down: Option<Point>,
    }
    let Message {
        robot,
        thing,
        put_down,
    } = parse(text)?;
    let event = match put_down {
        None => Event::Took(thing),
        Some(position) => Event::PutDown { thing, position },
    };
    Ok((robot, event))
}

fn intervention(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        intervention: String,
    }
    let Message {
        robot,
        intervention,
    } = parse(text)?;
    let intervention: Box<Intervention> = serde_json::from_str(&intervention)?;
    if !intervention.is_valid() {
        return Err("the intervention has a place or shape that no world can have".into());
    }
    Ok((robot, Event::Intervention(intervention)))
}

fn violation(text: &[u8]) -> Decoded {
    #[derive(Deserialize)]
    struct Message {
        robot: Option<RobotId>,
        property: String,
        text: String,
    }
    let Message {
        robot,
        property,
        text,
    } = parse(text)?;
    Ok((
        robot,
        Event::Violated {
            property: property.into(),
            text: text.into(),
        },
    ))
}

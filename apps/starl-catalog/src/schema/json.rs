//! JSON whose members keep their order.

use serde::{Serialize, Serializer};
use serde_json::Value;

/// A value of JSON whose members keep their order.
#[derive(Clone, Debug, PartialEq)]
pub enum Json {
    /// Where order does not matter.
    Value(Value),
    /// A list of such values.
    List(Vec<Json>),
    /// Members in order.
    Object(Object),
}

/// The members of an object, in order.
#[derive(Clone, Debug, std::default::Default, PartialEq)]
pub struct Object(Vec<(String, Json)>);

impl Object {
    /// The members of an object.
    pub(super) fn of(value: Value) -> Object {
        let Value::Object(members) = value else {
            return Object::default();
        };
        let members = members.into_iter();
        Object(members.map(|(name, value)| (name, value.into())).collect())
    }

    pub(super) fn put(&mut self, name: &str, value: impl Into<Json>) {
        self.0.push((name.to_string(), value.into()));
    }

    pub(super) fn extend(&mut self, other: Object) {
        self.0.extend(other.0);
    }
}

impl From<Value> for Json {
    fn from(value: Value) -> Json {
        Json::Value(value)
    }
}

impl From<Object> for Json {
    fn from(object: Object) -> Json {
        Json::Object(object)
    }
}

impl Serialize for Json {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Json::Value(value) => value.serialize(serializer),
            Json::List(list) => serializer.collect_seq(list),
            Json::Object(Object(members)) => {
                serializer.collect_map(members.iter().map(|(name, value)| (name, value)))
            }
        }
    }
}

//! Values too large or too variable for registers: texts, collections, areas, obstacles.
//!
//! An object is a value. Copies share its body until one of them is changed, which then gets a body
//! of its own. An object without a body is the empty text or collection, so that a state full of
//! empty collections needs no memory but its own.

use crate::machine::types::{Layout, Parts};
use crate::machine::value::list::{self, Item, WORD};
use crate::machine::value::map;
use alloc::string::String;
use core::cmp::Ordering;
use core::num::NonZeroUsize;
use serde::{Deserialize, Serialize};
use starl_core::{Area, Digest, Shape};
use triomphe::Arc;

/// A text, collection, area or obstacles; one word.
///
/// The reference count has no weak references. So a change of an element finds out whether it is the only holder by
/// reading a number, without an atomic exchange.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Object(Option<Arc<Body>>);

/// The content of an object.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Body {
    /// Characters.
    Text(String),
    /// A list, or a set: a list in ascending order without repetitions.
    List(List),
    /// A map.
    Map(Map),
    /// A region.
    Area(Area),
    /// Obstacles.
    Obstacles(starl_core::motion::Obstacles),
}

/// A row of values of the language.
pub type List = list::List<Object>;

/// One value, borrowed.
pub type Block<'a> = list::Block<'a, Object>;

/// Values of the language by their keys.
pub type Map = map::Map<Object>;

impl Object {
    /// The empty text, list, set or map; no area, no obstacles.
    pub const EMPTY: Object = Object(None);

    /// Its content; none if it is empty.
    #[inline]
    pub fn body(&self) -> Option<&Body> {
        self.0.as_deref()
    }

    /// The characters of a text.
    pub fn text(&self) -> &str {
        match self.body() {
            Some(Body::Text(text)) => text,
            _ => "",
        }
    }

    /// The elements of a list or set; none if it is empty.
    #[inline]
    pub fn list(&self) -> Option<&List> {
        match self.body() {
            Some(Body::List(list)) => Some(list),
            _ => None,
        }
    }

    /// The entries of a map; none if it is empty.
    pub fn map(&self) -> Option<&Map> {
        match self.body() {
            Some(Body::Map(map)) => Some(map),
            _ => None,
        }
    }

    /// The region.
    pub fn area(&self) -> Option<&Area> {
        match self.body() {
            Some(Body::Area(area)) => Some(area),
            _ => None,
        }
    }

    /// The list, mutable; created for blocks of this layout if the object is empty; none if the object is not a list.
    pub fn list_mut(&mut self, layout: &Layout) -> Option<&mut List> {
        let new = || Arc::new(Body::List(List::new(layout)));
        match Arc::make_mut(self.0.get_or_insert_with(new)) {
            Body::List(list) => Some(list),
            _ => None,
        }
    }

    /// A list to be changed if there is one.
    pub fn existing_list_mut(&mut self) -> Option<&mut List> {
        match Arc::make_mut(self.0.as_mut()?) {
            Body::List(list) => Some(list),
            _ => None,
        }
    }

    /// The list, mutable, if this is its only holder.
    #[inline]
    pub fn own_list_mut(&mut self) -> Option<&mut List> {
        match Arc::get_mut(self.0.as_mut()?)? {
            Body::List(list) => Some(list),
            _ => None,
        }
    }

    /// The map, mutable; created for these layouts if the object is empty; none if the object is not a map.
    pub fn map_mut(&mut self, parts: &Parts) -> Option<&mut Map> {
        let new = || Arc::new(Body::Map(Map::empty(parts)));
        match Arc::make_mut(self.0.get_or_insert_with(new)) {
            Body::Map(map) => Some(map),
            _ => None,
        }
    }

    /// The map, mutable, if there is one and no other object shares it.
    #[inline]
    pub fn own_map_mut(&mut self) -> Option<&mut Map> {
        match Arc::get_mut(self.0.as_mut()?)? {
            Body::Map(map) => Some(map),
            _ => None,
        }
    }

    /// The text, mutable; created if the object is empty; none if the object is not a text.
    pub fn text_mut(&mut self) -> Option<&mut String> {
        let new = || Arc::new(Body::Text(String::new()));
        match Arc::make_mut(self.0.get_or_insert_with(new)) {
            Body::Text(text) => Some(text),
            _ => None,
        }
    }

    /// How many elements, entries or characters there are.
    pub fn size(&self) -> usize {
        match self.body() {
            None | Some(Body::Area(_)) => 0,
            Some(Body::Text(text)) => text.chars().count(),
            Some(Body::List(list)) => list.len(),
            Some(Body::Map(map)) => map.len(),
            Some(Body::Obstacles(obstacles)) => obstacles.len(),
        }
    }

    /// The size as if nothing were shared, bytes.
    #[inline]
    pub fn bytes(&self) -> usize {
        // Most registers and many variables are empty.
        self.body().map_or(0, Body::bytes)
    }

    /// The order of two objects of one type; areas and obstacles have none and are equal only if
    /// they are the same.
    pub fn compare(&self, other: &Object, kind: u16, types: &[Parts]) -> Ordering {
        let Some(parts) = types.get(usize::from(kind)) else {
            return Ordering::Equal;
        };
        match (self.body(), other.body()) {
            (None, None) => Ordering::Equal,
            (Some(Body::List(left)), Some(Body::List(right))) => {
                left.compare(right, &parts.element, types)
            }
            (Some(Body::Map(left)), Some(Body::Map(right))) => left.compare(right, parts, types),
            (Some(Body::Area(left)), Some(Body::Area(right))) => order_of(left == right),
            (Some(Body::Obstacles(left)), Some(Body::Obstacles(right))) => order_of(left == right),
            (Some(Body::Text(left)), Some(Body::Text(right))) => left.cmp(right),
            _ => self.filled().cmp(&other.filled()),
        }
    }

    /// Whether there is anything in it.
    fn filled(&self) -> bool {
        match self.body() {
            None => false,
            Some(Body::Text(text)) => !text.is_empty(),
            Some(Body::Area(_)) => true,
            Some(_) => self.size() > 0,
        }
    }

    /// Folds the value into a digest; equal values give equal digests.
    pub fn digest(&self, digest: &mut Digest) {
        match self.body() {
            _ if !self.filled() => digest.word(0),
            None => {}
            Some(Body::Text(text)) => {
                digest.word(1);
                digest.bytes(text.as_bytes());
            }
            Some(Body::List(list)) => digest_blocks(digest, list.len(), list.iter()),
            Some(Body::Map(map)) => {
                digest.word(3);
                digest_blocks(digest, map.len(), map.iter().map(|[key, _]| key));
                digest_blocks(digest, map.len(), map.iter().map(|[_, value]| value));
            }
            Some(Body::Area(area)) => {
                digest.word(4);
                digest.bytes(&starl_core::message::encode(area));
            }
            Some(Body::Obstacles(obstacles)) => {
                digest.word(5);
                digest.bytes(&starl_core::message::encode(obstacles));
            }
        }
    }
}

impl Item for Object {
    #[inline]
    fn bytes(&self) -> usize {
        Object::bytes(self)
    }

    #[inline]
    fn text(&self) -> &str {
        Object::text(self)
    }

    #[inline]
    fn address(&self) -> Option<NonZeroUsize> {
        self.0
            .as_ref()
            .and_then(|body| NonZeroUsize::new(Arc::as_ptr(body).addr()))
    }

    #[inline]
    fn compare(&self, other: &Object, kind: u16, types: &[Parts]) -> Ordering {
        Object::compare(self, other, kind, types)
    }
}

impl Body {
    /// The size as if nothing were shared, bytes.
    fn bytes(&self) -> usize {
        match self {
            Body::Text(text) => 4 * WORD + text.len(),
            Body::List(list) => list.bytes(),
            Body::Map(map) => map.bytes(),
            Body::Area(Area::Polygon(polygon)) => 4 * WORD + 3 * WORD * polygon.vertices().len(),
            Body::Area(_) => 8 * WORD,
            Body::Obstacles(obstacles) => {
                let corners = obstacles.iter().map(|obstacle| match &obstacle.shape {
                    Shape::Polygon { base, .. } => base.vertices().len(),
                    _ => 0,
                });
                4 * WORD + 8 * WORD * obstacles.len() + 3 * WORD * corners.sum::<usize>()
            }
        }
    }
}

/// Folds a row of values into a digest.
fn digest_blocks<'a>(digest: &mut Digest, length: usize, blocks: impl Iterator<Item = Block<'a>>) {
    digest.word(2);
    digest.word(length as u64);
    for block in blocks {
        block.scalars.iter().for_each(|&word| digest.word(word));
        block.objects.iter().for_each(|o| o.digest(digest));
    }
}

fn order_of(equal: bool) -> Ordering {
    if equal {
        Ordering::Equal
    } else {
        Ordering::Less
    }
}

/// Bit for bit: unlike in [`Object::compare`], 0.0 and -0.0 differ and NaN equals itself.
impl PartialEq for Object {
    fn eq(&self, other: &Object) -> bool {
        match (&self.0, &other.0) {
            (Some(left), Some(right)) if Arc::ptr_eq(left, right) => true,
            (Some(left), Some(right)) => match (&**left, &**right) {
                (Body::Text(left), Body::Text(right)) => left == right,
                (Body::List(left), Body::List(right)) => left.same(right),
                (Body::Map(left), Body::Map(right)) => left.same(right),
                (Body::Area(left), Body::Area(right)) => left == right,
                (Body::Obstacles(left), Body::Obstacles(right)) => left == right,
                _ => !self.filled() && !other.filled(),
            },
            _ => !self.filled() && !other.filled(),
        }
    }
}

impl Eq for Object {}

impl From<Body> for Object {
    fn from(body: Body) -> Object {
        Object(Some(Arc::new(body)))
    }
}

impl From<List> for Object {
    fn from(list: List) -> Object {
        Body::List(list).into()
    }
}

impl From<&str> for Object {
    fn from(text: &str) -> Object {
        Body::Text(text.into()).into()
    }
}

impl From<Area> for Object {
    fn from(area: Area) -> Object {
        Body::Area(area).into()
    }
}

impl From<starl_core::motion::Obstacles> for Object {
    fn from(obstacles: starl_core::motion::Obstacles) -> Object {
        Body::Obstacles(obstacles).into()
    }
}

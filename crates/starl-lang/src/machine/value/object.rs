//! Values too large or too variable for registers: texts, collections, areas, obstacles.
//!
//! An object is a value. Copies share its body until one of them is changed, which then gets a body
//! of its own. An object without a body is the empty text or collection, so that a state full of
//! empty collections needs no memory but its own.

use crate::machine::types::{Layout, Parts};
use crate::machine::value::index::{Found, Index};
use crate::machine::value::list::{self, Item, WORD};
use alloc::string::String;
use core::cmp::Ordering;
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

/// Keys in ascending order without repetitions, and at the same index the value of each. Both are
/// objects that hold lists, so that they can be had without copying.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Map {
    /// The keys.
    keys: Object,
    /// The values.
    values: Object,
    #[serde(skip)]
    pub(super) index: Index,
}

impl Map {
    /// A map of these keys, which are in ascending order without repetitions, and the values at the same indices.
    pub fn new(keys: impl Into<Object>, values: impl Into<Object>) -> Map {
        Map {
            keys: keys.into(),
            values: values.into(),
            index: Index::default(),
        }
    }

    /// The keys, a list.
    #[inline]
    pub fn keys(&self) -> &Object {
        &self.keys
    }

    /// The values, a list.
    #[inline]
    pub fn values(&self) -> &Object {
        &self.values
    }

    /// The values, to be changed: there must be one for each key afterwards.
    #[inline]
    pub fn values_mut(&mut self) -> &mut Object {
        &mut self.values
    }

    /// Both, to be changed in the same way.
    pub fn parts_mut(&mut self) -> (&mut Object, &mut Object) {
        self.index.forget();
        (&mut self.keys, &mut self.values)
    }

    /// The value of a hashed key, if it is found without a search and is scalars alone.
    #[inline]
    pub fn scalars_of(&self, key: Block<'_>) -> Option<&[u64]> {
        let at = self.index.find(self.keys.list()?, key).at()?;
        self.values.list()?.scalars_at(at)
    }

    /// As [`Map::scalars_of`], to be changed; none if the values have another holder.
    #[inline]
    pub fn scalars_of_mut(&mut self, key: Block<'_>) -> Option<&mut [u64]> {
        let at = self.index.find(self.keys.list()?, key).at()?;
        self.values.own_list_mut()?.scalars_at_mut(at)
    }

    /// The index of a key.
    #[inline]
    pub fn find(&self, key: Block<'_>, parts: &Parts, types: &[Parts]) -> Option<usize> {
        let keys = self.keys.list()?;
        let found = match parts.has_hashed_keys {
            true => self.index.find(keys, key),
            false => Found::Unknown,
        };
        match found {
            Found::At(at) => Some(at),
            Found::Nowhere => None,
            Found::Unknown => keys.search(key, &parts.element, types).ok(),
        }
    }
}

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

    /// The map, mutable; created if the object is empty; none if the object is not a map.
    pub fn map_mut(&mut self) -> Option<&mut Map> {
        let new = || Arc::new(Body::Map(Map::default()));
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
            Some(Body::Map(map)) => map.keys.size(),
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
            (Some(Body::Map(left)), Some(Body::Map(right))) => {
                let keys = lists(&left.keys, &right.keys, &parts.element, types);
                keys.then_with(|| lists(&left.values, &right.values, &parts.value, types))
            }
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
            Some(Body::List(list)) => {
                digest.word(2);
                digest.word(list.len() as u64);
                for block in list.iter() {
                    block.scalars.iter().for_each(|&word| digest.word(word));
                    block.objects.iter().for_each(|o| o.digest(digest));
                }
            }
            Some(Body::Map(map)) => {
                digest.word(3);
                map.keys.digest(digest);
                map.values.digest(digest);
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
    fn is_shared(&self, other: &Object) -> bool {
        matches!((&self.0, &other.0), (Some(left), Some(right)) if Arc::ptr_eq(left, right))
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
            Body::Map(map) => 4 * WORD + map.keys.bytes() + map.values.bytes(),
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

/// The order of two objects that hold lists.
fn lists(left: &Object, right: &Object, layout: &Layout, types: &[Parts]) -> Ordering {
    match (left.list(), right.list()) {
        (Some(left), Some(right)) => left.compare(right, layout, types),
        _ => left.size().cmp(&right.size()),
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
                (Body::Map(left), Body::Map(right)) => {
                    left.keys == right.keys && left.values == right.values
                }
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

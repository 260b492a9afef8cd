//! Variables of a state by name: for parameters, and for inspecting a state.

use crate::machine::program::Program;
use crate::machine::types::{Layout, Type};
use crate::machine::value::object::Object;
use crate::machine::value::state::State;
use crate::machine::value::tree::Value;
use alloc::vec::Vec;
use core::ops::Range;
use starl_core::Payload;

/// Where a variable lies in the state.
struct Place<'a> {
    kind: &'a Type,
    scalars: Range<usize>,
    objects: Range<usize>,
}

impl Program {
    fn places(&self) -> impl Iterator<Item = (&str, Place<'_>)> {
        let mut next = (0, 0);
        self.bytecode.variables.iter().map(move |variable| {
            let layout = Layout::of([&variable.kind]);
            let (scalar, object) = next;
            next = (scalar + layout.scalars.len(), object + layout.objects.len());
            let place = Place {
                kind: &variable.kind,
                scalars: scalar..next.0,
                objects: object..next.1,
            };
            (&variable.name[..], place)
        })
    }

    /// The values of all variables of a state, with their names and in their order. A variable whose scalars are not a
    /// value of its type, for instance after a fault, is omitted.
    pub fn values<'a>(&'a self, state: &'a State) -> impl Iterator<Item = (&'a str, Value)> + 'a {
        self.values_where(state, |_, _| true)
    }

    /// The same, of the variables with scalars and objects for which `is_meant` is true.
    pub fn values_where<'a>(
        &'a self,
        state: &'a State,
        is_meant: impl Fn(&Range<usize>, &Range<usize>) -> bool + 'a,
    ) -> impl Iterator<Item = (&'a str, Value)> + 'a {
        let places = self.places();
        let places = places.filter(move |(_, place)| is_meant(&place.scalars, &place.objects));
        places.filter_map(|(name, place)| {
            let scalars = state.scalars.get(place.scalars)?;
            let objects = state.objects.get(place.objects)?;
            Some((name, Value::read(self, place.kind, scalars, objects)?))
        })
    }

    /// The values of the stable variables of a state as bytes, in the order of the variables.
    pub fn encode_stable<'a>(&'a self, state: &'a State) -> impl Iterator<Item = Payload> + 'a {
        let variables = self.bytecode.variables.iter().zip(self.places());
        let stable = variables.filter(|(variable, _)| variable.is_stable);
        stable.filter_map(|(_, (_, place))| {
            let scalars = state.scalars.get(place.scalars)?;
            let objects = state.objects.get(place.objects)?;
            self.encode(core::slice::from_ref(place.kind), scalars, objects)
        })
    }

    /// The value of a variable of a state.
    pub fn get(&self, state: &State, name: &str) -> Option<Value> {
        let mut values = self.values(state);
        values
            .find(|(found, _)| *found == name)
            .map(|(_, value)| value)
    }

    /// Gives a variable of a state a value; false if there is no such variable, or the value is not of its type.
    /// Parameters must be set before the program's start.
    #[must_use]
    pub fn set(&self, state: &mut State, name: &str, value: &Value) -> bool {
        let Some((_, place)) = self.places().find(|(found, _)| *found == name) else {
            return false;
        };
        let (mut scalars, mut objects): (Vec<u64>, Vec<Object>) = Default::default();
        if !value.write(self, place.kind, &mut scalars, &mut objects) {
            return false;
        }
        let to = state.scalars.get_mut(place.scalars);
        let to_objects = state.objects.get_mut(place.objects);
        match (to, to_objects) {
            (Some(to), Some(to_objects)) => {
                to.copy_from_slice(&scalars);
                to_objects.clone_from_slice(&objects);
                true
            }
            _ => false,
        }
    }
}

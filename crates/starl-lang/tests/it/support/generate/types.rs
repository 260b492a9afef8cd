//! Random types, and of which of them a value can be made.

use super::Generator;
use super::model::Type;

impl Generator<'_> {
    /// Any type that a declaration may have.
    pub(super) fn any_type(&mut self, depth: u32) -> Type {
        use Type::{Area, Bool, Duration, Float, Int, Obstacles, Point, Robot, String, Time};
        let kinds = if depth == 0 { 12 } else { 20 };
        match self.choices.below(kinds) {
            0 => Int,
            1 => Bool,
            2 => Float,
            3 => String,
            4 => Point,
            5 => Duration,
            6 => self.some_enum(),
            7 | 8 => self.some_record(),
            9 => [Time, Robot][self.choices.below(2)].clone(),
            10 => [Robot, Area, Obstacles][self.choices.below(3)].clone(),
            11 => Int,
            12 | 13 => Type::list(self.any_type(depth - 1)),
            14 => Type::set(self.key_type()),
            15 => {
                let key = self.key_type();
                Type::map(key, self.any_type(depth - 1))
            }
            16 | 17 => Type::optional(self.any_type(depth - 1)),
            _ => {
                let count = 2 + self.choices.below(2);
                Type::Tuple((0..count).map(|_| self.any_type(depth - 1)).collect())
            }
        }
    }

    /// A type whose values can be keys.
    pub(super) fn key_type(&mut self) -> Type {
        use Type::{Bool, Duration, Int, Point, Robot, String, Time};
        match self.choices.below(11) {
            10 => self.ordered_tuple(),
            0 | 1 => Int,
            2 | 3 => String,
            4 => [Bool, Duration][self.choices.below(2)].clone(),
            5 => Point,
            6 => [Robot, Time][self.choices.below(2)].clone(),
            7 => self.some_enum(),
            _ => {
                let record = self.some_record();
                if self.model.is_key(&record) {
                    record
                } else {
                    Int
                }
            }
        }
    }

    /// A pair that can be a key, and that `<` compares.
    pub(super) fn ordered_tuple(&mut self) -> Type {
        use Type::{Duration, Int, Robot, String};
        let parts = [Int, String, Robot, Duration];
        let mut part = || parts[self.choices.below(4)].clone();
        Type::Tuple(vec![part(), part()])
    }

    /// A type of which a value can be made here.
    pub(super) fn made_type(&mut self, depth: u32) -> Type {
        let ty = self.any_type(depth);
        if self.can_make(&ty) { ty } else { Type::Int }
    }

    /// The same of keys.
    pub(super) fn made_key(&mut self) -> Type {
        let ty = self.key_type();
        if self.can_make(&ty) { ty } else { Type::Int }
    }

    fn some_enum(&mut self) -> Type {
        let named: Vec<usize> = (0..self.model.enums.len())
            .filter(|number| self.model.enums[*number].name.is_some())
            .collect();
        Type::Enum(named[self.choices.below(named.len())])
    }

    fn some_record(&mut self) -> Type {
        Type::Record(self.choices.below(self.model.records.len()))
    }

    /// Whether a value of the type can be had here.
    pub(super) fn can_make(&self, ty: &Type) -> bool {
        self.can_write(ty) || !self.readable(ty).is_empty()
    }

    /// Whether a value of the type can be written here: of times, robots and obstacles none is.
    pub(super) fn can_write(&self, ty: &Type) -> bool {
        match ty {
            Type::Time | Type::Robot | Type::Obstacles => false,
            Type::Record(number) => {
                let mut fields = self.model.records[*number].fields.iter();
                fields.all(|field| self.can_make(&field.ty))
            }
            Type::Tuple(parts) => parts.iter().all(|part| self.can_make(part)),
            Type::List(part) | Type::Set(part) | Type::Optional(part) => self.can_make(part),
            Type::Map(key, value) => self.can_make(key) && self.can_make(value),
            _ => true,
        }
    }
}

//! Compiled programs do what the language says: source text in, values and calls of the robot out.

mod support;

mod assignments;
mod comparisons;
mod comprehensions;
mod conditions;
mod every_checked_program;
mod fuel;
mod functions;
mod guards;
mod handlers;
mod limits;
mod listings;
mod lists;
mod logs;
mod loops;
mod maps;
mod numbers;
mod optionals;
mod order;
mod points;
mod primitives;
mod properties;
mod records;
mod robot_functions;
mod roles;
mod sets;
mod shared;
mod start;
mod texts;
mod times;
mod tuples;

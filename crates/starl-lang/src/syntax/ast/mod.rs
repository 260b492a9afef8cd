//! A typed view of the tree: a type for each kind of node, with its parts by name.
//!
//! Every part may be missing, because the tree is also made of texts with errors. A part that occurs
//! more often than the grammar allows is given once, the first.

mod collection;
mod data;
mod declaration;
mod expression;
mod item;
mod literal;
mod node;
mod operator;
mod statement;
mod types;

pub use collection::*;
pub use data::*;
pub use declaration::*;
pub use expression::*;
pub use item::{Documented, Item, Named};
pub use literal::*;
pub use node::{AstNode, Name};
pub use operator::{AssignOperator, BinaryOperator, PrefixOperator};
pub use statement::*;
pub use types::*;

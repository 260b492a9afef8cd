//! A typed view of the tree: a type for each kind of node, with its parts by name.
//!
//! Every part may be missing, because the tree is also made of texts with errors. A part that occurs
//! more often than the grammar allows is given once, the first.

mod declaration;
mod expression;
mod item;
mod node;
mod operator;
mod statement;
mod types;

pub use declaration::*;
pub use expression::*;
pub use item::{Documented, Item, Named};
pub use node::{AstNode, Name};
pub use operator::{AssignOperator, BinaryOperator, PrefixOperator};
pub use statement::*;
pub use types::*;

//! The trace format of StarL: one MCAP file with all events of a run, for replay, for external checks, and for viewing
//! in Foxglove.
//!
//! [`Writer`] writes records and views of them; [`Reader`] reads the records exactly; [`Comparison`] finds the first
//! difference of two runs. `docs/reference/trace.md` describes the format, topic by topic.
//!
//! The file begins with the metadata record `starl` and attachments that together are the [`Header`]; then chunks of
//! messages follow; the last message, on `/starl/summary`, is the [`Summary`]. Everything under `/starl/` is a record
//! of the run, one topic for each kind of event; all other topics are views.

mod compare;
mod container;
mod decode;
mod encode;
mod error;
mod fields;
mod header;
mod json;
mod list;
mod output;
mod reader;
mod schema;
mod summary;
mod topic;
mod views;
mod wire;
mod writer;

pub use compare::{Comparison, Difference, first_difference};
pub use error::{Progress, TraceError, WriteError};
pub use header::{FORMAT_VERSION, Header, RobotEntry};
pub use list::{json_bytes, json_list};
pub use reader::{Inputs, Item, Reader, Trace, read};
pub use summary::{Outcome, Summary};
pub use topic::Topic;
pub use views::ViewOptions;
pub use writer::Writer;

//! The commands that serve the page, in a build without the feature `web`: all are refused.

use crate::args::{PageArguments, RunArguments, ViewArguments};
use crate::console;
use crate::failure::Failure;
use starl_catalog::programs::Registry;

pub fn serve_page(_: &PageArguments) -> Result<bool, Failure> {
    refuse()
}

pub fn serve_run(_: &RunArguments, _: &Registry) -> Result<bool, Failure> {
    refuse()
}

pub fn serve_view(_: &ViewArguments, _: &Registry) -> Result<bool, Failure> {
    refuse()
}

fn refuse() -> Result<bool, Failure> {
    Err(Failure(format!(
        "this {} was built without the server of the page; build it with the feature `web`",
        console::command()
    )))
}

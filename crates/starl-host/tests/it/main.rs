//! The tests of `starl-host`, in one binary so that they link once.

mod conforms;
mod journal_bytes;
mod journal_damage;
mod journal_gives_back_views;
mod nodes_show_lives;
mod refused_command;
mod replay_finds_differences;
mod support;

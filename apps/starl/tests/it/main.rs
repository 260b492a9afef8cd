//! The tests of `starl`, in one binary so that they link once.

mod bad_input;
mod bench_workloads;
mod check_programs;
#[cfg(unix)]
mod cluster_option;
mod compare_command;
mod diagram_command;
mod exit_status;
mod explain_program;
mod explore_programs;
mod first_program;
#[cfg(feature = "fleet")]
mod fleet;
#[cfg(all(unix, feature = "zenoh"))]
mod fleet_certificates;
#[cfg(feature = "fleet")]
mod fleet_orders;
mod format_programs;
mod interrupted_run;
mod json_report;
mod learned_policy;
mod list_what_there_is;
mod lsp;
mod lsp_agrees_with_pages;
mod lsp_files;
mod lsp_support;
mod output_files;
mod reference_of_the_command;
mod replay_robot;
mod replay_trace;
mod run_log;
mod run_programs;
mod same_seed_same_run;
mod schema_command;
mod support;
mod sweep_command;
mod test_command;
mod trace_is_never_lost;
mod verify_laws;
mod verify_trace;
#[cfg(feature = "web")]
mod web_bad_clients;
#[cfg(feature = "web")]
mod web_command;
#[cfg(feature = "web")]
mod web_engine;
#[cfg(feature = "web")]
mod web_guard;
#[cfg(feature = "web")]
mod web_support;
#[cfg(feature = "web")]
mod web_trace;

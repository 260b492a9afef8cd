//! The bounds that the command line gives.

use crate::args::ExploreArguments;
use crate::failure::Failure;
use crate::target;
use starl_core::Duration;
use starl_explore::{Bounds, Clocks};

/// Reads them.
pub fn read(arguments: &ExploreArguments) -> Result<Bounds, Failure> {
    let clocks = match &arguments.tick {
        None => Clocks::Still,
        Some(tick) => {
            let tick = duration("--tick", tick)?;
            let time = duration("--time", &arguments.time)?;
            Clocks::Ticking {
                tick,
                ticks: ticks(time, tick)?.saturating_add(arguments.warm_up.unwrap_or_default()),
                skew: arguments.skew,
                delay: arguments.delay,
            }
        }
    };
    Ok(Bounds {
        losses: arguments.loss,
        duplicates: arguments.duplicates,
        any_copies: arguments.any_copies,
        crashes: arguments.crashes,
        suspicions: arguments.suspicions,
        timers: arguments.timers,
        clocks,
        depth: arguments.depth,
        most_states: arguments.most_states,
    })
}

/// Reads how long the search may take.
pub fn within(arguments: &ExploreArguments) -> Result<Duration, Failure> {
    duration("--within", &arguments.within)
}

fn duration(option: &str, text: &str) -> Result<Duration, Failure> {
    match target::span(option, text)? {
        Duration::ZERO => Err(Failure(format!(
            "{option}: give a time above zero, such as 500ms"
        ))),
        span => Ok(span),
    }
}

fn ticks(time: Duration, tick: Duration) -> Result<u16, Failure> {
    u16::try_from(time.0.div_ceil(tick.0))
        .map_err(|_| Failure("--time: is more than 65535 ticks; make ticks longer".into()))
}

//! Answers requests natively as the WebAssembly module does, one in each line of the standard input, so that the
//! two can be compared.

use starl_catalog::service::Service;
use std::io::{self, BufRead, Write};

fn main() -> io::Result<()> {
    let mut host = Service::default();
    let mut output = io::stdout().lock();
    for line in io::stdin().lock().lines() {
        output.write_all(&host.answer(line?.as_bytes()))?;
        output.write_all(b"\n")?;
    }
    Ok(())
}

//! Reading a trace never panics, and what can be read can be written and read again, the same.
//!
//! Checksums would stop nearly all inputs at the door. A checksum of zero means that none was made, so
//! each input is also read with its checksums taken away. Seeds: any traces, e.g. what the example
//! `every_event` of `starl-trace` writes.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_trace::{Summary, Trace, ViewOptions, Writer, first_difference, read};

fuzz_target!(|bytes: &[u8]| {
    check(bytes);
    check(&without_checksums(bytes));
});

fn check(bytes: &[u8]) {
    let Ok(Trace {
        header,
        records,
        summary,
    }) = read(bytes)
    else {
        return;
    };
    let mut writer = Writer::new(Vec::new(), &header, &ViewOptions::default()).expect("finite");
    for record in &records {
        writer.write(record).expect("finite");
    }
    let again = read(&writer.finish(&summary.outcome).expect("memory")).expect("just written");
    assert_eq!(again.header, header);
    assert_eq!(first_difference(records, again.records), None);
    // Inputs are not records, and were not written again.
    let without_inputs = Summary {
        inputs: 0,
        ..summary
    };
    assert_eq!(again.summary, without_inputs);
}

/// The file with every checksum set to zero: of chunks, attachments, the data section and the footer.
fn without_checksums(bytes: &[u8]) -> Vec<u8> {
    let mut file = bytes.to_vec();
    let mut at = 8;
    while let Some(head) = file.get(at..).and_then(|rest| rest.first_chunk::<9>()) {
        let length = u64::from_le_bytes([
            head[1], head[2], head[3], head[4], head[5], head[6], head[7], head[8],
        ]);
        let body = at + 9;
        let Some(end) = usize::try_from(length)
            .ok()
            .and_then(|length| body.checked_add(length))
        else {
            break;
        };
        let checksum = match head[0] {
            0x06 => Some(body + 24),
            0x02 | 0x09 => end.checked_sub(4),
            0x0f => Some(body),
            _ => None,
        };
        if let Some(checksum) = checksum.and_then(|at| file.get_mut(at..at + 4)) {
            checksum.fill(0);
        }
        at = end;
    }
    file
}

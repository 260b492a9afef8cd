//! Reading a damaged file ends in one clear error, and never in a panic.

use crate::common;
use starl_core::Random;
use starl_trace::{Reader, TraceError, ViewOptions, Writer, read};

#[test]
fn a_truncated_file_is_distinguished_from_a_complete_one() {
    let file = common::file(&ViewOptions::default());
    let header_end = Reader::new(file.as_slice()).unwrap().progress().offset;
    let all = common::records().len() as u64;
    for length in (0..file.len()).step_by(7) {
        let error = read(&file[..length]).unwrap_err();
        match &error {
            TraceError::NotMcap => assert_eq!(length, 0),
            TraceError::Truncated(progress) => {
                assert_eq!(progress.offset, length as u64);
                assert!(progress.records == 0 || progress.records == all);
                assert_eq!(progress.last.is_some(), progress.records > 0);
                assert!(progress.records == 0 || length as u64 > header_end);
            }
            other => panic!("cut to {length} bytes: {other:?}"),
        }
        assert!(!error.to_string().is_empty());
    }
}

#[test]
fn records_before_the_cut_can_be_read() {
    // Long enough for several chunks.
    let mut writer = Writer::new(Vec::new(), &common::header(), &ViewOptions::none()).unwrap();
    let records = common::records();
    let total = 300 * records.len();
    for record in records.iter().cycle().take(total) {
        writer.write(record).unwrap();
    }
    let file = writer.finish(&common::outcome()).unwrap();
    let cut = file.len() * 2 / 3;
    let mut reader = Reader::new(&file[..cut]).unwrap();
    let mut readable = 0;
    let error = loop {
        match reader.next().expect("an error comes before the end") {
            Ok(record) => {
                assert_eq!(record, records[readable % records.len()]);
                readable += 1;
            }
            Err(error) => break error,
        }
    };
    assert!(
        readable > total / 3 && readable < total,
        "{readable} of {total}"
    );
    assert!(reader.next().is_none(), "nothing comes after an error");
    let text = error.to_string();
    assert!(text.starts_with("the trace is truncated"), "{text}");
    assert!(
        text.contains(&format!("after {readable} records")),
        "{text}"
    );
}

#[test]
fn an_unfinished_run_is_detected_by_the_missing_end_record() {
    let mut file = Vec::new();
    let mut writer = Writer::new(&mut file, &common::header(), &ViewOptions::default()).unwrap();
    for record in common::records() {
        writer.write(&record).unwrap();
    }
    drop(writer);
    let error = read(&file).unwrap_err();
    assert!(
        matches!(error, TraceError::NoEnd(progress) if progress.records > 0),
        "{error:?}"
    );
    assert!(error.to_string().contains("no end record"), "{error}");
}

#[test]
fn no_flipped_bit_goes_unnoticed() {
    let file = common::file(&ViewOptions::default());
    let mut random = Random::keyed(7, &[1]);
    for round in 0..5_000 {
        let mut damaged = file.clone();
        let at = random.below(file.len() as u32) as usize;
        damaged[at] ^= 1 << random.below(8);
        assert!(
            read(&damaged).is_err(),
            "round {round}: the flip at byte {at} was not noticed"
        );
    }
}

#[test]
fn checksums_taken_away_leave_errors_or_other_traces_but_no_panic() {
    // A checksum of zero means that none was made: what follows meets the decoders unchecked.
    let file = common::file(&ViewOptions::none());
    let mut random = Random::keyed(8, &[2]);
    let checksums: Vec<usize> = common::checksums(&file);
    assert!(checksums.len() >= 6, "{checksums:?}");
    let mut failures = 0;
    for _ in 0..5_000 {
        let mut damaged = file.clone();
        for &at in &checksums {
            damaged[at..at + 4].fill(0);
        }
        for _ in 0..1 + random.below(4) {
            let at = random.below(file.len() as u32) as usize;
            damaged[at] = match random.below(4) {
                0 => 0,
                1 => 0xff,
                2 => b"{}[]\",:0123456789eE-.nulltrue"[random.below(29) as usize],
                _ => random.below(256) as u8,
            };
        }
        failures += u32::from(read(&damaged).is_err());
    }
    assert!(failures > 1_500, "only {failures} were noticed");
}

#[test]
fn bytes_of_any_kind_are_refused() {
    let mut random = Random::keyed(9, &[3]);
    for length in 0..2_000 {
        let mut bytes: Vec<u8> = (0..length).map(|_| random.below(256) as u8).collect();
        assert!(read(&bytes).is_err());
        let start = b"\x89MCAP0\r\n";
        let shared = start.len().min(bytes.len());
        bytes[..shared].copy_from_slice(&start[..shared]);
        assert!(read(&bytes).is_err());
    }
}

#[test]
fn foreign_files_are_distinguished_from_damaged_ones() {
    assert_eq!(read(b"").unwrap_err(), TraceError::NotMcap);
    assert_eq!(read(b"#!/bin/sh\n").unwrap_err(), TraceError::NotMcap);
    let mut other = mcap::Writer::new(std::io::Cursor::new(Vec::new())).unwrap();
    let schema = other.add_schema("x", "jsonschema", b"{}").unwrap();
    other
        .add_channel(schema, "/starl/pose", "json", &Default::default())
        .unwrap();
    other.finish().unwrap();
    let other = other.into_inner().into_inner();
    assert_eq!(read(&other).unwrap_err(), TraceError::NotStarl);
}

#[test]
fn a_trace_of_another_version_is_refused_by_its_number() {
    let mut other = mcap::Writer::new(std::io::Cursor::new(Vec::new())).unwrap();
    let metadata = [("format_version".to_string(), "2".to_string())].into();
    other
        .write_metadata(&mcap::records::Metadata {
            name: "starl".into(),
            metadata,
        })
        .unwrap();
    other.finish().unwrap();
    let error = read(&other.into_inner().into_inner()).unwrap_err();
    assert_eq!(error, TraceError::Version { found: "2".into() });
    assert!(error.to_string().contains("format version 2"), "{error}");
}

#[test]
fn a_claimed_length_costs_no_memory() {
    let mut file = b"\x89MCAP0\r\n".to_vec();
    file.push(0x0c);
    file.extend(u64::MAX.to_le_bytes());
    assert!(matches!(
        read(&file).unwrap_err(),
        TraceError::TooLong {
            length: u64::MAX,
            ..
        }
    ));
    file.truncate(9);
    file.extend((1u64 << 30).to_le_bytes());
    assert!(matches!(read(&file).unwrap_err(), TraceError::Truncated(_)));
}

//! Inputs of robots travel beside the records, and readers of records do not notice them.

use crate::common;
use starl_core::{Record, Time};
use starl_trace::{Inputs, Item, Reader, TraceError, ViewOptions, Writer, read};

/// All records, with a message of inputs after each.
fn with_inputs() -> Vec<u8> {
    let mut writer = Writer::new(Vec::new(), &common::header(), &ViewOptions::default()).unwrap();
    writer.expect_inputs(7).unwrap();
    for (record, inputs) in common::records().iter().zip(inputs()) {
        writer.write(record).unwrap();
        writer.inputs(inputs.at, &inputs.data).unwrap();
    }
    writer.finish(&common::outcome()).unwrap()
}

fn inputs() -> Vec<Inputs> {
    let records = common::records().into_iter().zip(0u8..);
    let inputs = records.map(|(record, number)| Inputs {
        at: record.at,
        data: vec![number; usize::from(number) % 5],
    });
    inputs.collect()
}

#[test]
fn inputs_are_read_back_in_order() {
    let file = with_inputs();
    let mut reader = Reader::new(file.as_slice()).unwrap();
    let mut items = std::iter::from_fn(|| reader.next_item().map(Result::unwrap));
    for (record, inputs) in common::records().into_iter().zip(inputs()) {
        assert_eq!(items.next(), Some(Item::Record(record)));
        assert_eq!(items.next(), Some(Item::Inputs(inputs)));
    }
    assert_eq!(items.next(), None);
    assert_eq!(reader.inputs_version(), Some(7));
    let summary = reader.summary().unwrap();
    assert_eq!(summary.inputs, inputs().len() as u64);
    assert_eq!(summary.records, common::records().len() as u64);
}

#[test]
fn a_reader_of_records_leaves_them_out() {
    let trace = read(&with_inputs()).unwrap();
    assert_eq!(trace.records, common::records());
    let file = with_inputs();
    let records: Vec<Record> = Reader::new(file.as_slice())
        .unwrap()
        .map(Result::unwrap)
        .collect();
    assert_eq!(records, common::records());
}

#[test]
fn other_libraries_read_them() {
    let file = with_inputs();
    let mut found = 0;
    for message in mcap::MessageStream::new(&file).unwrap() {
        let message = message.unwrap();
        if message.channel.topic != "/starl/inputs" {
            continue;
        }
        assert_eq!(message.channel.message_encoding, "postcard");
        assert_eq!(message.channel.metadata["version"], "7");
        let schema = message.channel.schema.as_ref().unwrap();
        assert_eq!(
            (schema.name.as_str(), schema.encoding.as_str()),
            ("starl.Inputs", "")
        );
        assert_eq!(*message.data, *inputs()[found].data);
        found += 1;
    }
    assert_eq!(found, inputs().len());
}

#[test]
fn traces_without_inputs_do_not_mention_them() {
    let mut writer = Writer::new(Vec::new(), &common::header(), &ViewOptions::default()).unwrap();
    writer.inputs(Time::ZERO, b"left out").unwrap();
    let file = writer.finish(&common::outcome()).unwrap();
    let mut reader = Reader::new(file.as_slice()).unwrap();
    assert!(reader.next_item().is_none());
    assert_eq!(reader.inputs_version(), None);
    assert!(!file.windows(12).any(|text| text == b"starl.Inputs"));
}

/// The topic is renamed in the file, so that its messages are those of an unknown channel.
#[test]
fn inputs_that_are_missing_are_noticed() {
    let mut file = with_inputs();
    let places: Vec<usize> = (0..file.len() - 13)
        .filter(|&at| &file[at..at + 13] == b"/starl/inputs")
        .collect();
    for at in places {
        file[at..at + 13].copy_from_slice(b"/starl/inputz");
    }
    for at in common::checksums(&file) {
        file[at..at + 4].fill(0);
    }
    match read(&file).unwrap_err() {
        TraceError::Message { topic, what, .. } => {
            assert_eq!(topic, "/starl/summary");
            assert!(what.contains("messages of inputs"), "{what}");
        }
        other => panic!("{other}"),
    }
}

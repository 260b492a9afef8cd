//! However early a writer stops, its output and its unfinished messages make a readable trace.

use crate::common;
use starl_core::Record;
use starl_trace::{Reader, TraceError, ViewOptions, Writer};
use std::cell::RefCell;
use std::io;
use std::rc::Rc;

/// A file that its writer and the test share.
#[derive(Clone, Default)]
struct Shared(Rc<RefCell<Vec<u8>>>);

impl io::Write for Shared {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.borrow_mut().extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Everything that can be read of a file, and why not more.
fn readable(file: &[u8]) -> (Vec<Record>, TraceError) {
    let mut reader = Reader::new(file).unwrap();
    let mut records = Vec::new();
    loop {
        match reader.next().expect("an error comes before the end") {
            Ok(record) => records.push(record),
            Err(error) => return (records, error),
        }
    }
}

#[test]
fn every_record_so_far_can_be_read_at_any_time() {
    let file = Shared::default();
    let (header, options) = (common::header(), ViewOptions::default());
    let mut writer = Writer::new(file.clone(), &header, &options).unwrap();
    let records = common::records();
    // Long enough for several chunks.
    let total = 400 * records.len();
    let mut given = 0;
    let mut chunks = 0;
    for (count, record) in records.iter().cycle().take(total).enumerate() {
        if count % 977 == 0 {
            let whole = [file.0.borrow().as_slice(), writer.unfinished()].concat();
            let (found, error) = readable(&whole);
            assert_eq!(found.len(), count);
            assert!(found.iter().eq(records.iter().cycle().take(count)));
            assert!(error.is_missing_end(), "{error}");
            chunks += usize::from(file.0.borrow().len() > given);
            given = file.0.borrow().len();
        }
        writer.write(record).unwrap();
    }
    assert!(chunks > 3, "{chunks}");
}

#[test]
fn later_output_replaces_unfinished_messages() {
    let file = Shared::default();
    let (header, options) = (common::header(), ViewOptions::default());
    let mut writer = Writer::new(file.clone(), &header, &options).unwrap();
    let before = file.0.borrow().len();
    let (mut most, mut closed) = (0, false);
    for record in common::records().iter().cycle() {
        most = most.max(writer.unfinished().len());
        writer.write(record).unwrap();
        let more = file.0.borrow().len() - before;
        if more > 0 {
            assert!(more > most, "{more} bytes after {most} unfinished ones");
            closed = true;
            break;
        }
    }
    assert!(closed);
}

#[test]
fn only_a_missing_end_is_not_damage() {
    let file = common::file(&ViewOptions::default());
    let (_, cut) = readable(&file[..file.len() - 100]);
    assert!(cut.is_missing_end());
    let mut damaged = file.clone();
    let middle = file.len() / 2;
    damaged[middle] ^= 1;
    let (_, error) = readable(&damaged);
    assert!(!error.is_missing_end(), "{error}");
}

//! A random stream that is stored and read back continues where it was.

use starl_core::Random;
use starl_core::message::{decode, encode};

#[test]
fn a_stored_stream_continues_where_it_was() {
    let mut random = Random::keyed(7, &[1, 2]);
    for draws in 0..40u32 {
        match draws % 4 {
            0 => drop(random.bits()),
            1 => drop(random.uniform()),
            2 => drop(random.normal(0.0, 1.0)),
            _ => drop(random.below(10)),
        }
        let mut stored: Random = decode(&encode(&random)).expect("it can be read back");
        assert_eq!(stored, random);
        assert_eq!(stored.preview(), random.preview(), "after {draws} draws");
        assert_eq!(stored.bits(), random.clone().bits());
    }
}

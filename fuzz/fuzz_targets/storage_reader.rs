//! Opening a robot's storage never panics, whatever its file contains, and a storage that opens can be written and holds
//! what was written.

#![no_main]

use libfuzzer_sys::fuzz_target;
use starl_node::Storage;

fuzz_target!(|bytes: &[u8]| {
    let path = std::env::temp_dir().join(format!("starl-fuzz-{}", std::process::id()));
    std::fs::write(&path, bytes).expect("the folder can be written to");
    if let Ok(storage) = Storage::open(&path) {
        let saved = format!("{:?}", storage.saved());
        drop(storage);
        let again = Storage::open(&path).expect("it has just been opened");
        assert_eq!(format!("{:?}", again.saved()), saved);
    }
    std::fs::remove_file(&path).expect("it is there");
});

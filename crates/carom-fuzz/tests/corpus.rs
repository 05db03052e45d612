//! Cases that once broke a promise keep it.

use std::path::Path;

use carom_fuzz::{Known, TARGETS};

#[test]
fn what_once_broke_a_promise_keeps_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for target in &TARGETS {
        for Known { path, case } in Known::of(target, &folder).unwrap() {
            let answer = target.try_case(&case);
            assert!(answer.is_ok(), "{}: {}", path.display(), answer.unwrap_err());
        }
    }
}

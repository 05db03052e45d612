//! Cases that once broke a promise keep it.

use std::path::Path;

use carom_fuzz::{Known, TARGETS};

#[test]
fn what_once_broke_a_promise_keeps_it() {
    let mut tried = 0;
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus");
    for target in &TARGETS {
        for Known { path, case } in Known::of(target, &folder).unwrap() {
            let fault = target.try_case(&case).err().filter(|fault| !fault.is_limit());
            assert_eq!(fault, None, "{}", path.display());
            tried += 1;
        }
    }
    assert!(tried > 0, "the corpus is not where it should be");
}

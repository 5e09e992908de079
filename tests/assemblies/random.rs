//! Random assemblies for which something was mended; the soak test has many more.

use bodies::assembly::assembly;
use support::{encode, run};

#[test]
fn a_pin_in_plates_is_read_alike_in_every_run() {
    // Of points at one angle from the middle of a face, spade took some in the order of a hash table.
    let pin = assembly(40);
    let input = encode(&pin.body, pin.encoding);
    let read = || run("symdetect", &["--allow-asymmetric"], &input).success();
    let first = read();
    for _ in 0..7 {
        assert!(first == read(), "another run wrote other bytes");
    }
}

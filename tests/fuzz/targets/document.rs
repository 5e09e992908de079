#![no_main]

use fuzz::plan::Plan;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|plan: Plan| {
    fuzz::limited(1 << 15, || {
        fuzz::check_document(&plan.document(), plan.turn)
    });
});

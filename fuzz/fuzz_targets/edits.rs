//! See `lumbre_testkit::fuzzing`.
#![no_main]
libfuzzer_sys::fuzz_target!(init: drop(std::panic::take_hook()), |data: &[u8]| {
    lumbre_testkit::fuzzing::Target::Edits.run(data);
});

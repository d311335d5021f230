//! See `lumbre_testkit::fuzzing`. A panic inside a foreign decoder is caught by the reader and is no fault: the hook that would
//! end the process at once is taken off. One that leaves the reader still ends it.
#![no_main]
libfuzzer_sys::fuzz_target!(init: drop(std::panic::take_hook()), |data: &[u8]| {
    lumbre_testkit::fuzzing::Target::WebP.run(data);
});

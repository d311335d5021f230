//! Replays what the fuzzers kept: `fuzz/corpus/TARGET/*`. Every input returns, within five seconds; each target accepts at least
//! one of its inputs and refuses another, or the corpus would prove nothing.

use lumbre_testkit::fuzzing::Target;
use std::path::Path;
use std::time::{Duration, Instant};

#[test]
fn every_input_returns() {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus");
    for target in Target::ALL {
        let folder = corpus.join(target.name());
        let mut inputs: Vec<_> = std::fs::read_dir(&folder)
            .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
            .map(|entry| entry.unwrap().path())
            .collect();
        inputs.sort();
        let mut accepted = 0;
        for input in &inputs {
            let bytes = std::fs::read(input).unwrap();
            let start = Instant::now();
            accepted += usize::from(target.run(&bytes));
            let took = start.elapsed();
            assert!(took < Duration::from_secs(5), "{}: {took:?}", input.display());
        }
        println!("{}: {accepted} of {} accepted", target.name(), inputs.len());
        assert!(accepted > 0 && accepted < inputs.len(), "{}: {accepted} accepted", target.name());
    }
}

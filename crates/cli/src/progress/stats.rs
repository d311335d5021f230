//! `--stats`: what a render took, as a table.

use super::{Finish, plain};
use crate::memory::human;
use lumbre::PassTime;

/// What is only looked up when it is asked for.
#[derive(Clone, Debug)]
pub(crate) struct Stats {
    pub(crate) memory: Memory,
    /// By the clock of a GPU; empty without one.
    pub(crate) passes: Vec<PassTime>,
}

/// Bytes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Memory {
    pub(crate) scene: u64,
    pub(crate) acceleration: u64,
    /// With the error estimate.
    pub(crate) film: u64,
    /// The most that the process has held; `None` where the system does not say.
    pub(crate) peak: Option<u64>,
}

impl Stats {
    /// How many rays, of all kinds, a camera sample takes on average.
    pub(super) fn rays_per_sample(&self, f: &Finish) -> f64 {
        let done = f.outcome.progress;
        done.rays as f64 / done.samples.max(1) as f64
    }

    /// Names and values in two columns, values flush right.
    pub(super) fn table(&self, f: &Finish) -> Vec<String> {
        let (done, m) = (&f.outcome, &self.memory);
        let speed = |n: u64| plain::millions_per_second(n, done.seconds);
        let seconds = |s: f64| format!("{s:.2} s");
        let fixed = [
            ("load", seconds(f.load_seconds)),
            ("build", seconds(f.build_seconds)),
            ("render", seconds(done.seconds)),
            ("write", seconds(f.write_seconds)),
            ("memory of the scene", human(m.scene)),
            ("of the acceleration structure", human(m.acceleration)),
            ("of the film", human(m.film)),
            ("at most, in all", m.peak.map_or_else(|| "not known".into(), human)),
            ("samples per pixel", done.spp.to_string()),
            ("camera samples", plain::count(done.progress.samples)),
            ("rays", plain::count(done.progress.rays)),
            ("rays per camera sample", format!("{:.2}", self.rays_per_sample(f))),
            ("Msamples/s", format!("{:.2}", speed(done.progress.samples))),
            ("Mrays/s", format!("{:.2}", speed(done.progress.rays))),
            ("estimated error", plain::error(done.error)),
        ];
        let passes = self
            .passes
            .iter()
            .map(|p| (format!("GPU ms of `{}`, {} times", p.name, p.count), format!("{:.3}", p.mean_ms())));
        let rows: Vec<(String, String)> =
            fixed.map(|(name, value)| (name.to_string(), value)).into_iter().chain(passes).collect();
        let width = |texts: &mut dyn Iterator<Item = &str>| texts.map(str::len).max().unwrap_or(0);
        let names = width(&mut rows.iter().map(|r| r.0.as_str()));
        let values = width(&mut rows.iter().map(|r| r.1.as_str()));
        rows.iter().map(|(name, value)| format!("  {name:names$}  {value:>values$}")).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::finished;
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let memory = Memory { scene: 5 << 20, acceleration: 1 << 30, film: 1000, peak: None };
        let trace = PassTime { name: "trace", count: 8, total_ms: 10.0 };
        let stats = Stats { memory, passes: vec![trace] };
        let table = stats.table(&finished());
        assert!(table.iter().all(|l| l.len() == table[0].len()), "{table:#?}");
        let row = |name: &str| table.iter().find(|l| l.contains(name)).unwrap();
        assert!(row("of the acceleration").ends_with(" 1.0 GiB") && row("at most").ends_with(" not known"));
        assert!(row("rays per camera sample").ends_with(" 2.25"));
        assert!(row("GPU ms of `trace`, 8 times").ends_with(" 1.250"));
    }
}

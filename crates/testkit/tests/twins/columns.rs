//! Comparing what two sides computed, number by number: an output is a row of 32-bit words, a column some neighbouring words of each.

use bytemuck::Pod;
use std::ops::Range;

/// Some floats of an output and how near both sides must be: |a - b| <= absolute + relative max(|a|, |b|). Infinities and numbers that are no
/// numbers must be the same on both sides.
pub(crate) struct Column {
    pub(crate) name: &'static str,
    pub(crate) words: Range<usize>,
    pub(crate) absolute: f32,
    pub(crate) relative: f32,
}

/// The next `count` words after those of the column before.
pub(crate) struct Columns {
    all: Vec<Column>,
    width: usize,
}

impl Columns {
    pub(crate) fn new() -> Self {
        Columns { all: Vec::new(), width: 0 }
    }

    /// The next `count` words, with their tolerance.
    pub(crate) fn then(mut self, name: &'static str, count: usize, absolute: f32, relative: f32) -> Self {
        let words = self.width..self.width + count;
        self.width = words.end;
        self.all.push(Column { name, words, absolute, relative });
        self
    }

    /// The next `count` words, integers or floats that must have the same bits.
    pub(crate) fn exact(self, name: &'static str, count: usize) -> Self {
        self.then(name, count, -1.0, 0.0)
    }

    /// For each column in how many rows both sides are further apart than they may be. Prints the first of each.
    pub(crate) fn differing<O: Pod>(&self, rust: &[O], gpu: &[O]) -> Vec<(&'static str, usize)> {
        assert_eq!(
            (rust.len(), size_of::<O>()),
            (gpu.len(), 4 * self.width),
            "columns are not those of the output"
        );
        let (a, b): (&[u32], &[u32]) = (bytemuck::cast_slice(rust), bytemuck::cast_slice(gpu));
        let rows = || a.chunks_exact(self.width).zip(b.chunks_exact(self.width)).enumerate();
        let count = |column: &Column| {
            let far = rows().filter(|(_, (a, b))| {
                let pairs = a[column.words.clone()].iter().zip(&b[column.words.clone()]);
                !pairs.into_iter().all(|(a, b)| column.near(*a, *b))
            });
            let mut far = far.peekable();
            if let Some((row, (a, b))) = far.peek() {
                let show = |w: &[u32]| w.iter().map(|w| f32::from_bits(*w)).collect::<Vec<_>>();
                let (a, b) = (&a[column.words.clone()], &b[column.words.clone()]);
                println!("{} of {row}: {:?} here, {:?} there", column.name, show(a), show(b));
            }
            (column.name, far.count())
        };
        self.all.iter().map(count).collect()
    }

    /// Fails if any column differs in more than `share` of the rows.
    pub(crate) fn assert_near<O: Pod>(&self, rust: &[O], gpu: &[O], share: f64) {
        let differing = self.differing(rust, gpu);
        let most = (share * rust.len() as f64) as usize;
        assert!(differing.iter().all(|(_, n)| *n <= most), "of {} differ: {differing:?}", rust.len());
    }

    /// Fails unless `column` differs in more than half of the rows: what a disturbed twin must lead to.
    pub(crate) fn assert_far<O: Pod>(&self, column: &str, rust: &[O], gpu: &[O]) {
        let differing = self.differing(rust, gpu);
        let found = differing.iter().find(|(name, _)| *name == column).expect("such a column").1;
        assert!(found > rust.len() / 2, "{column}: only {found} of {} differ", rust.len());
    }
}

impl Column {
    fn near(&self, a: u32, b: u32) -> bool {
        if a == b {
            return true;
        }
        let (a, b) = (f32::from_bits(a), f32::from_bits(b));
        if self.absolute < 0.0 {
            return false;
        }
        if a.is_nan() || b.is_nan() {
            return a.is_nan() && b.is_nan();
        }
        a == b || (a - b).abs() <= self.absolute + self.relative * a.abs().max(b.abs())
    }
}

/// Numbers for inputs: a stream of its own for each row.
pub(crate) struct Numbers {
    row: u32,
    next: u32,
}

impl Numbers {
    pub(crate) fn new(row: u32) -> Self {
        Numbers { row, next: 0 }
    }

    pub(crate) fn word(&mut self) -> u32 {
        self.next += 1;
        lumbre_core::hash::hash_combine(lumbre_core::hash::hash_u32(self.row), self.next)
    }

    /// In [0, 1).
    pub(crate) fn unit(&mut self) -> f32 {
        lumbre_core::hash::to_unit(self.word())
    }

    pub(crate) fn pair(&mut self) -> [f32; 2] {
        [self.unit(), self.unit()]
    }

    /// Between two numbers.
    pub(crate) fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    /// From `low` to `high`, evenly in the logarithm.
    pub(crate) fn scale(&mut self, low: f32, high: f32) -> f32 {
        (low.ln() + (high / low).ln() * self.unit()).exp()
    }

    /// Below `n`.
    pub(crate) fn below(&mut self, n: u32) -> u32 {
        self.word() % n
    }

    /// A unit vector.
    pub(crate) fn direction(&mut self) -> [f32; 3] {
        lumbre_core::warp::uniform_sphere(self.pair()).to_array()
    }

    /// One of these.
    pub(crate) fn one_of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len() as u32) as usize]
    }
}

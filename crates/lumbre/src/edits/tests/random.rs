//! Random edits, the same in every run.

use super::{camera, items, scene, values};
use crate::edits::Kind;
use crate::edits::{Edits, Item, Value};
use glam::Vec3;
use lumbre_core::Rgb;
use lumbre_scene::EnvironmentMap;

/// A small generator of numbers (SplitMix64, Steele et al. 2014).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    pub(super) fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
    /// Any finite number in a range, small ones as often as large ones.
    fn number(&mut self, [a, b]: [f32; 2]) -> f32 {
        loop {
            let v = f32::from_bits(self.next() as u32);
            let even = a + (b - a) * (self.next() as f32 / u64::MAX as f32);
            let v = if self.below(2) == 0 { v } else { even };
            if v >= a && v <= b {
                return v;
            }
        }
    }
    fn value(&mut self, kind: &Kind) -> Value {
        let listed = values(kind);
        match *kind {
            _ if self.below(4) == 0 => listed[self.below(listed.len())].clone(),
            Kind::Number { range, .. } => Value::Number(self.number(range)),
            Kind::Whole { range: [a, b], .. } => {
                Value::Whole(a + (self.next() % (u64::from(b - a) + 1)) as u32)
            }
            Kind::Color { most } => Value::Color(Rgb::from_array([(); 3].map(|()| self.number([0.0, most])))),
            Kind::Vector { range, .. } => {
                Value::Vector(Vec3::from_array([(); 3].map(|()| self.number(range))))
            }
            _ => listed[self.below(listed.len())].clone(),
        }
    }
}

/// Some twenty changes all over the scene.
pub(super) fn edits(random: &mut Random) -> Edits {
    let base = scene();
    let mut edits = Edits { scene: "random.glb".into(), ..Edits::default() };
    let items = items(&mut edits);
    for _ in 0..20 {
        let item = items[random.below(items.len())];
        let rows = edits.rows(&base, &camera(), item).unwrap();
        let row = &rows[random.below(rows.len())];
        // Eye and target at one point are refused.
        let set = edits.set(&base, item, row.name, random.value(&row.kind));
        assert!(set.is_ok() || ["eye", "target"].contains(&row.name), "{set:?}");
    }
    edits
}

/// A file for the sky is always there.
fn apply(edits: &Edits, base: &lumbre_scene::Scene) -> Result<lumbre_scene::Scene, crate::edits::EditsError> {
    let map = EnvironmentMap { width: 1, height: 1, pixels: vec![Rgb::WHITE].into() };
    edits.apply_with(base, Some(&map))
}

#[test]
fn texts_bring_them_back() {
    let mut random = Random(1);
    for _ in 0..500 {
        let edits = edits(&mut random);
        let text = edits.to_text();
        let back = Edits::parse(&text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_eq!(back, edits, "{text}");
        assert_eq!(back.to_text(), text);
        let base = scene();
        match (apply(&edits, &base), apply(&back, &base)) {
            (Ok(a), Ok(b)) => assert_eq!(format!("{a:?}"), format!("{b:?}"), "to the bit"),
            (a, b) => assert_eq!(a.err(), b.err()),
        }
    }
}

#[test]
fn applied_twice_is_applied_once() {
    let mut random = Random(2);
    let (mut n, base) = (0, scene());
    while n < 200 {
        let mut edits = edits(&mut random);
        // What is added would be added again, what is switched off is not found again, and what moves the parent of a light, or of
        // what holds it, moves it on.
        edits.remove_light(&base, Item::Added(0)).unwrap();
        let off = |i: u32| apply(&edits, &base).is_ok_and(|s| s.nodes[i as usize].light.is_none());
        if [1, 2, 3, 4, 6].into_iter().any(off) {
            continue;
        }
        let Ok(once) = apply(&edits, &base) else { continue };
        let twice = apply(&edits, &once).unwrap();
        n += 1;
        assert_eq!(twice.materials, once.materials);
        assert_eq!(twice.environment.background, once.environment.background);
        for (a, b) in twice.nodes.iter().zip(&once.nodes) {
            assert_eq!((a.visible, a.light.is_some()), (b.visible, b.light.is_some()));
        }
    }
}

#[test]
fn undo_is_a_stack_of_clones() {
    let mut random = Random(3);
    let base = scene();
    let mut stack = vec![Edits::default()];
    for _ in 0..50 {
        let mut next = stack.last().unwrap().clone();
        let all = items(&mut Edits::default());
        let item = all[random.below(all.len())];
        let Ok(rows) = next.rows(&base, &camera(), item) else { continue };
        let row = &rows[random.below(rows.len())];
        next.set(&base, item, row.name, random.value(&row.kind)).unwrap();
        stack.push(next);
    }
    for pair in stack.windows(2).rev() {
        // Redo gives what was undone.
        assert_eq!(Edits::parse(&pair[1].to_text()).unwrap(), pair[1]);
        assert_eq!(Edits::parse(&pair[0].to_text()).unwrap(), pair[0]);
    }
    assert!(stack.len() > 30);
}

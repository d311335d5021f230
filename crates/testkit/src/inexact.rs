//! SPIR-V as a device runs it that computes no better than Vulkan asks: quotients off by up to 2.5 units in the last place, roots by up to 4.5
//! (as the reciprocal of a reciprocal root), reciprocal roots by 2, numbers below the normal ones taken for 0, and quotients of divisors
//! above 2¹²⁶ lost. (Vulkan 1.2, "Precision and Operation of SPIR-V Instructions".) lavapipe rounds correctly and keeps small numbers, cards do
//! not: this way tests on lavapipe see what cards may do. Contraction of products and sums is left out.

use std::collections::HashMap;

/// Opcodes of SPIR-V.
mod op {
    pub(super) const EXT_INST: u32 = 12;
    pub(super) const TYPE_BOOL: u32 = 20;
    pub(super) const TYPE_INT: u32 = 21;
    pub(super) const TYPE_FLOAT: u32 = 22;
    pub(super) const TYPE_VECTOR: u32 = 23;
    pub(super) const CONSTANT: u32 = 43;
    pub(super) const CONSTANT_COMPOSITE: u32 = 44;
    pub(super) const FUNCTION: u32 = 54;
    pub(super) const LOAD: u32 = 61;
    pub(super) const COMPOSITE_EXTRACT: u32 = 81;
    pub(super) const BITCAST: u32 = 124;
    pub(super) const I_ADD: u32 = 128;
    pub(super) const F_ADD: u32 = 129;
    pub(super) const I_SUB: u32 = 130;
    pub(super) const F_SUB: u32 = 131;
    pub(super) const I_MUL: u32 = 132;
    pub(super) const F_MUL: u32 = 133;
    pub(super) const F_DIV: u32 = 136;
    pub(super) const U_MOD: u32 = 137;
    pub(super) const VECTOR_TIMES_SCALAR: u32 = 142;
    pub(super) const DOT: u32 = 148;
    pub(super) const SELECT: u32 = 169;
    pub(super) const I_EQUAL: u32 = 170;
    pub(super) const U_GREATER_EQUAL: u32 = 174;
    pub(super) const SHIFT_RIGHT: u32 = 194;
    pub(super) const AND: u32 = 199;
}

/// Instructions of GLSL.std.450.
mod ext {
    pub(super) const SQRT: u32 = 31;
    pub(super) const INVERSE_SQRT: u32 = 32;
    pub(super) const LENGTH: u32 = 66;
    pub(super) const NORMALIZE: u32 = 69;
}

const EXPONENT: u32 = 0x7f80_0000;
const SIGN: u32 = 0x8000_0000;
/// 2¹²⁶.
const LARGEST_DIVISOR: u32 = 0x7e80_0000;

/// The module with every result disturbed as the device may.
///
/// # Panics
/// If it is no SPIR-V.
pub fn inexact(spirv: &[u8]) -> Vec<u8> {
    let words: Vec<u32> =
        spirv.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    assert_eq!(words[0], 0x0723_0203, "no SPIR-V");
    let mut module = Module::new(words[3]);
    let (header, mut rest) = words.split_at(5);
    while let Some(first) = rest.first() {
        let (instruction, after) = rest.split_at((first >> 16) as usize);
        module.take(instruction);
        rest = after;
    }
    let all = [&header[..3], &[module.bound], &header[4..], &module.before, &module.declared, &module.code];
    all.into_iter().flatten().flat_map(|w| w.to_le_bytes()).collect()
}

/// A module on its way through.
struct Module {
    bound: u32,
    /// What stands before the first function; then what was added to that; then the functions.
    before: Vec<u32>,
    declared: Vec<u32>,
    code: Vec<u32>,
    in_code: bool,
    /// The id of each type and constant, by its words without the id.
    ids: HashMap<Vec<u32>, u32>,
    /// How many floats a type has, where it is one float or a vector of them.
    floats: HashMap<u32, u32>,
}

impl Module {
    fn new(bound: u32) -> Self {
        Module {
            bound,
            before: Vec::new(),
            declared: Vec::new(),
            code: Vec::new(),
            in_code: false,
            ids: HashMap::new(),
            floats: HashMap::new(),
        }
    }

    fn fresh(&mut self) -> u32 {
        self.bound += 1;
        self.bound - 1
    }

    /// Copies an instruction, disturbed if it computes.
    fn take(&mut self, words: &[u32]) {
        let op = words[0] & 0xffff;
        self.in_code |= op == op::FUNCTION;
        if !self.in_code {
            self.note(op, words);
            return self.before.extend(words);
        }
        let Some((count, roundings)) = self.disturbs(op, words) else { return self.code.extend(words) };
        let mut copy = words.to_vec();
        copy[2] = self.fresh();
        self.code.extend(&copy);
        let mut raw = copy[2];
        if op == op::F_DIV {
            raw = self.without_large_divisors((words[1], count), raw, words[4]);
        }
        self.disturb((words[1], count), raw, (words[2], roundings));
    }

    /// Remembers types and constants.
    fn note(&mut self, op: u32, words: &[u32]) {
        match op {
            op::TYPE_BOOL | op::TYPE_INT | op::TYPE_FLOAT | op::TYPE_VECTOR => {
                let key: Vec<u32> = std::iter::once(op).chain(words[2..].iter().copied()).collect();
                let single = op == op::TYPE_FLOAT && words[2] == 32;
                if single || (op == op::TYPE_VECTOR && self.floats.get(&words[2]) == Some(&1)) {
                    self.floats.insert(words[1], if single { 1 } else { words[3] });
                }
                self.ids.insert(key, words[1]);
            }
            op::CONSTANT | op::CONSTANT_COMPOSITE => {
                let key = [&[op, words[1]], &words[3..]].concat();
                self.ids.insert(key, words[2]);
            }
            _ => {}
        }
    }

    /// Of an instruction with floats for a result: how many, and by how many units in the last place they may be off beyond rounding.
    fn disturbs(&self, op: u32, words: &[u32]) -> Option<(u32, u32)> {
        let roundings = match op {
            op::F_DIV => 2,
            op::EXT_INST => match words[4] {
                ext::SQRT | ext::LENGTH => 4,
                ext::INVERSE_SQRT => 1,
                ext::NORMALIZE => 2,
                _ => 0,
            },
            op::F_ADD
            | op::F_SUB
            | op::F_MUL
            | op::DOT
            | op::VECTOR_TIMES_SCALAR
            | op::LOAD
            | op::COMPOSITE_EXTRACT => 0,
            _ => return None,
        };
        Some((*self.floats.get(&words[1])?, roundings))
    }

    /// The id of a type or constant, declared if it is not yet.
    fn declare(&mut self, op: u32, operands: &[u32]) -> u32 {
        let key = [&[op], operands].concat();
        if let Some(id) = self.ids.get(&key) {
            return *id;
        }
        let id = self.fresh();
        // The result comes after the type, where there is one.
        let typed = usize::from(matches!(op, op::CONSTANT | op::CONSTANT_COMPOSITE));
        let head = (operands.len() as u32 + 2) << 16 | op;
        self.declared.push(head);
        self.declared.extend(&operands[..typed]);
        self.declared.push(id);
        self.declared.extend(&operands[typed..]);
        self.ids.insert(key, id);
        id
    }

    fn vector_of(&mut self, element: u32, count: u32) -> u32 {
        if count == 1 { element } else { self.declare(op::TYPE_VECTOR, &[element, count]) }
    }

    fn uints(&mut self, count: u32) -> u32 {
        let uint = self.declare(op::TYPE_INT, &[32, 0]);
        self.vector_of(uint, count)
    }

    fn bools(&mut self, count: u32) -> u32 {
        let bool = self.declare(op::TYPE_BOOL, &[]);
        self.vector_of(bool, count)
    }

    /// As many times the same number.
    fn constant(&mut self, value: u32, count: u32) -> u32 {
        let uint = self.uints(1);
        let one = self.declare(op::CONSTANT, &[uint, value]);
        if count == 1 {
            return one;
        }
        let uints = self.uints(count);
        let operands: Vec<u32> = std::iter::once(uints).chain((0..count).map(|_| one)).collect();
        self.declare(op::CONSTANT_COMPOSITE, &operands)
    }

    /// Adds an instruction with a new result.
    fn emit(&mut self, op: u32, kind: u32, operands: &[u32]) -> u32 {
        let id = self.fresh();
        self.emit_as(op, kind, id, operands);
        id
    }

    fn emit_as(&mut self, op: u32, kind: u32, id: u32, operands: &[u32]) {
        self.code.extend([(operands.len() as u32 + 3) << 16 | op, kind, id]);
        self.code.extend(operands);
    }

    /// Quotients of divisors that have no normal reciprocal: 0 (or no number) with the sign of the dividend lost.
    fn without_large_divisors(&mut self, (kind, count): (u32, u32), quotient: u32, divisor: u32) -> u32 {
        let (uints, bools) = (self.uints(count), self.bools(count));
        let (magnitude, limit) = (self.constant(!SIGN, count), self.constant(LARGEST_DIVISOR, count));
        let bits = self.emit(op::BITCAST, uints, &[divisor]);
        let magnitude = self.emit(op::AND, uints, &[bits, magnitude]);
        let large = self.emit(op::U_GREATER_EQUAL, bools, &[magnitude, limit]);
        let zero = self.constant(0, count);
        let zero = self.emit(op::BITCAST, kind, &[zero]);
        self.emit(op::SELECT, kind, &[large, zero, quotient])
    }

    /// The result `raw` as `id`: off by up to so many units, by a hash of its bits; 0 where it is below the normal numbers.
    fn disturb(&mut self, (kind, count): (u32, u32), raw: u32, (id, roundings): (u32, u32)) {
        let (uints, bools) = (self.uints(count), self.bools(count));
        let [exponent, sign, zero] = [EXPONENT, SIGN, 0].map(|value| self.constant(value, count));
        let bits = self.emit(op::BITCAST, uints, &[raw]);
        let mut moved = bits;
        if roundings > 0 {
            let constants = [0x9e37_79b1, 20, 2 * roundings + 1, roundings];
            let [factor, shift, choices, middle] = constants.map(|value| self.constant(value, count));
            let hash = self.emit(op::I_MUL, uints, &[bits, factor]);
            let hash = self.emit(op::SHIFT_RIGHT, uints, &[hash, shift]);
            let hash = self.emit(op::U_MOD, uints, &[hash, choices]);
            moved = self.emit(op::I_ADD, uints, &[bits, hash]);
            moved = self.emit(op::I_SUB, uints, &[moved, middle]);
        }
        let of = self.emit(op::AND, uints, &[bits, exponent]);
        let is_infinite = self.emit(op::I_EQUAL, bools, &[of, exponent]);
        let kept = self.emit(op::SELECT, uints, &[is_infinite, bits, moved]);
        let is_small = self.emit(op::I_EQUAL, bools, &[of, zero]);
        let signed_zero = self.emit(op::AND, uints, &[bits, sign]);
        let result = self.emit(op::SELECT, uints, &[is_small, signed_zero, kept]);
        self.emit_as(op::BITCAST, kind, id, &[result]);
    }
}

//! JSON text as a tree that knows its lines, and back: for a file that people write, where a message must say the place, a key that stands
//! twice is a mistake, and a number must come back as it was written. Numbers stay text until it is known what they are meant to be; what
//! goes by way of double precision may come back as another `f32`. (Bray 2017, RFC 8259.)

use std::borrow::Cow;
use std::collections::HashSet;

/// Objects and lists inside one another: the format needs four.
const DEEPEST: u32 = 8;
/// Values in a list: the format needs three.
const LONGEST: usize = 16;

/// A value, and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Json<'a> {
    /// From 1.
    pub(super) line: u32,
    pub(super) node: Node<'a>,
}

#[derive(Clone, Debug)]
pub(super) enum Node<'a> {
    Null,
    Flag(bool),
    /// As it is written.
    Number(&'a str),
    Text(Cow<'a, str>),
    List(Vec<Json<'a>>),
    /// In the order of the text; no key is there twice.
    Object(Vec<(Cow<'a, str>, Json<'a>)>),
}

impl Json<'_> {
    /// The finite number that stands here.
    pub(super) fn number(&self) -> Option<f32> {
        if let Node::Number(text) = self.node {
            text.parse().ok().filter(|v: &f32| v.is_finite())
        } else {
            None
        }
    }

    /// The three numbers that stand here.
    pub(super) fn numbers(&self) -> Option<[f32; 3]> {
        let Node::List(list) = &self.node else { return None };
        let numbers: Option<Vec<f32>> = list.iter().map(Json::number).collect();
        numbers?.try_into().ok()
    }
}

/// What is wrong with a text, and where.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Wrong {
    pub(super) line: u32,
    pub(super) reason: String,
}

/// Parses a whole text. Memory and time are bounded by its length, and nesting by a constant.
pub(super) fn parse(text: &str) -> Result<Json<'_>, Wrong> {
    let mut parser = Parser { text, at: 0, line: 1, depth: 0 };
    let json = parser.value()?;
    parser.skip_space();
    if parser.at < text.len() { Err(parser.wrong("more than one value")) } else { Ok(json) }
}

struct Parser<'a> {
    text: &'a str,
    at: usize,
    line: u32,
    depth: u32,
}

impl<'a> Parser<'a> {
    fn wrong(&self, reason: impl Into<String>) -> Wrong {
        Wrong { line: self.line, reason: reason.into() }
    }

    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    fn skip_space(&mut self) {
        while let Some(byte) = self.peek().filter(|b| b" \t\r\n".contains(b)) {
            self.line += u32::from(byte == b'\n');
            self.at += 1;
        }
    }

    /// What stands there, for messages.
    fn found(&self) -> String {
        self.text[self.at..].chars().next().map_or_else(|| "the end".into(), |c| format!("{c:?}"))
    }

    /// Whether this comes next; then it is passed.
    fn passes(&mut self, byte: u8) -> bool {
        self.skip_space();
        let there = self.peek() == Some(byte);
        self.at += usize::from(there);
        there
    }

    fn value(&mut self) -> Result<Json<'a>, Wrong> {
        self.skip_space();
        let line = self.line;
        let node = match self.peek() {
            Some(b'{') => self.nested(Self::object)?,
            Some(b'[') => self.nested(Self::list)?,
            Some(b'"') => Node::Text(self.string()?),
            Some(b'-' | b'0'..=b'9') => Node::Number(self.number()?),
            _ => self.word()?,
        };
        Ok(Json { line, node })
    }

    fn nested(&mut self, read: fn(&mut Self) -> Result<Node<'a>, Wrong>) -> Result<Node<'a>, Wrong> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err(self.wrong(format!("more than {DEEPEST} lists and objects inside one another")));
        }
        self.at += 1;
        let node = read(self)?;
        self.depth -= 1;
        Ok(node)
    }

    fn list(&mut self) -> Result<Node<'a>, Wrong> {
        let mut list = Vec::new();
        if self.passes(b']') {
            return Ok(Node::List(list));
        }
        loop {
            if list.len() == LONGEST {
                return Err(self.wrong(format!("a list of more than {LONGEST} values")));
            }
            list.push(self.value()?);
            if self.passes(b']') {
                return Ok(Node::List(list));
            }
            self.comma("]")?;
        }
    }

    fn object(&mut self) -> Result<Node<'a>, Wrong> {
        let (mut members, mut keys) = (Vec::new(), HashSet::new());
        if self.passes(b'}') {
            return Ok(Node::Object(members));
        }
        loop {
            self.skip_space();
            if self.peek() != Some(b'"') {
                return Err(self.wrong(format!("expected a key in quotes, found {}", self.found())));
            }
            let key = self.string()?;
            if !keys.insert(key.clone()) {
                return Err(self.wrong(format!("the key {key:?} is there twice")));
            }
            if !self.passes(b':') {
                return Err(self.wrong(format!("expected `:` after a key, found {}", self.found())));
            }
            members.push((key, self.value()?));
            if self.passes(b'}') {
                return Ok(Node::Object(members));
            }
            self.comma("}")?;
        }
    }

    fn comma(&mut self, or: &str) -> Result<(), Wrong> {
        if self.passes(b',') {
            return Ok(());
        }
        Err(self.wrong(format!("expected `,` or `{or}`, found {}", self.found())))
    }

    fn word(&mut self) -> Result<Node<'a>, Wrong> {
        let rest = &self.text[self.at..];
        for (word, node) in [("true", Node::Flag(true)), ("false", Node::Flag(false)), ("null", Node::Null)] {
            if rest.starts_with(word) {
                self.at += word.len();
                return Ok(node);
            }
        }
        Err(self.wrong(format!("expected a value, found {}", self.found())))
    }

    /// `-`? (`0` | [1-9][0-9]*) (`.` [0-9]+)? ([eE] [+-]? [0-9]+)?
    fn number(&mut self) -> Result<&'a str, Wrong> {
        let start = self.at;
        self.at += usize::from(self.peek() == Some(b'-'));
        let leading_zero = self.peek() == Some(b'0');
        let whole = self.digits();
        let mut sound = whole > 0 && !(leading_zero && whole > 1);
        if self.peek() == Some(b'.') {
            self.at += 1;
            sound &= self.digits() > 0;
        }
        if let Some(b'e' | b'E') = self.peek() {
            self.at += 1;
            self.at += usize::from(matches!(self.peek(), Some(b'+' | b'-')));
            sound &= self.digits() > 0;
        }
        let number = &self.text[start..self.at];
        if sound { Ok(number) } else { Err(self.wrong(format!("{number} is not a number in JSON"))) }
    }

    fn digits(&mut self) -> usize {
        let count = self.text.as_bytes()[self.at..].iter().take_while(|b| b.is_ascii_digit()).count();
        self.at += count;
        count
    }

    fn string(&mut self) -> Result<Cow<'a, str>, Wrong> {
        self.at += 1;
        let start = self.at;
        let mut unescaped: Option<String> = None;
        loop {
            let plain = self.at;
            let stop =
                self.text.as_bytes()[plain..].iter().position(|b| matches!(b, b'"' | b'\\' | 0..=0x1f));
            self.at = stop.map_or(self.text.len(), |n| plain + n);
            let part = &self.text[plain..self.at];
            match self.peek() {
                Some(b'"') => {
                    self.at += 1;
                    return Ok(match unescaped {
                        None => Cow::Borrowed(&self.text[start..self.at - 1]),
                        Some(text) => Cow::Owned(text + part),
                    });
                }
                Some(b'\\') => {
                    self.at += 1;
                    let character = self.escape()?;
                    let text = unescaped.get_or_insert_default();
                    text.push_str(part);
                    text.push(character);
                }
                Some(_) => {
                    return Err(self.wrong("a string goes on beyond its line, or holds a control character"));
                }
                None => return Err(self.wrong("a string does not end")),
            }
        }
    }

    /// What follows a backslash.
    fn escape(&mut self) -> Result<char, Wrong> {
        let byte = self.peek();
        self.at += usize::from(byte.is_some_and(|b| b.is_ascii()));
        Ok(match byte {
            Some(b @ (b'"' | b'\\' | b'/')) => char::from(b),
            Some(b'b') => '\u{8}',
            Some(b'f') => '\u{c}',
            Some(b'n') => '\n',
            Some(b'r') => '\r',
            Some(b't') => '\t',
            Some(b'u') => self.unicode()?,
            _ => return Err(self.wrong("an unknown escape in a string")),
        })
    }

    /// Four hexadecimal digits, or two pairs of them for a character beyond 16 bits.
    fn unicode(&mut self) -> Result<char, Wrong> {
        let first = self.hex()?;
        let mut code = first;
        if (0xd800..0xdc00).contains(&first) && self.text[self.at..].starts_with("\\u") {
            self.at += 2;
            let second = self.hex()?;
            if (0xdc00..0xe000).contains(&second) {
                code = 0x10000 + ((first - 0xd800) << 10) + (second - 0xdc00);
            }
        }
        char::from_u32(code).ok_or_else(|| self.wrong("half a character in a string"))
    }

    fn hex(&mut self) -> Result<u32, Wrong> {
        let digits =
            self.text.as_bytes().get(self.at..self.at + 4).filter(|d| d.iter().all(u8::is_ascii_hexdigit));
        let digits = digits.ok_or_else(|| self.wrong("expected four hexadecimal digits after \\u"))?;
        self.at += 4;
        Ok(digits.iter().fold(0, |code, d| 16 * code + char::from(*d).to_digit(16).unwrap_or(0)))
    }
}

/// The shortest text that is read as this number again.
pub(super) fn number_text(v: f32) -> String {
    if v == 0.0 || (1e-5..1e9).contains(&v.abs()) { v.to_string() } else { format!("{v:e}") }
}

/// A string with its quotes.
pub(super) fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if u32::from(c) < 0x20 => out.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

/// Objects inside one another, written with two more spaces for each.
#[derive(Debug, Default)]
pub(super) struct Writer {
    out: String,
    depth: usize,
    /// Something stands before the next member.
    comma: bool,
}

impl Writer {
    /// A member whose value is given as JSON.
    pub(super) fn member(&mut self, key: &str, value: &str) {
        self.begin(key);
        self.out.push_str(value);
        self.comma = true;
    }

    /// A member that is an object.
    pub(super) fn object(&mut self, key: &str, fill: impl FnOnce(&mut Self)) {
        self.begin(key);
        self.braces(fill);
    }

    /// The outermost object, and a line's end.
    pub(super) fn document(fill: impl FnOnce(&mut Self)) -> String {
        let mut writer = Writer::default();
        writer.braces(fill);
        writer.out.push('\n');
        writer.out
    }

    fn braces(&mut self, fill: impl FnOnce(&mut Self)) {
        self.out.push('{');
        (self.depth, self.comma) = (self.depth + 1, false);
        fill(self);
        self.depth -= 1;
        if self.comma {
            self.line();
        }
        self.out.push('}');
        self.comma = true;
    }

    fn begin(&mut self, key: &str) {
        if self.comma {
            self.out.push(',');
        }
        self.line();
        self.out.push_str(&quoted(key));
        self.out.push_str(": ");
    }

    fn line(&mut self) {
        self.out.push('\n');
        self.out.extend(std::iter::repeat_n("  ", self.depth));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(text: &str) -> String {
        let Wrong { line, reason } = parse(text).unwrap_err();
        format!("{line}: {reason}")
    }

    #[test]
    fn values_know_their_lines() {
        let json = parse(
            "\n{\"a\": [1,\n -2.5e-3, 0],\r\n \"b\\u00e4\\n\\ud83d\\ude00\": {\"c\": true}, \"d\":null}\n",
        )
        .unwrap();
        let Node::Object(members) = &json.node else { panic!() };
        let lines: Vec<(&str, u32)> = members.iter().map(|(k, v)| (k.as_ref(), v.line)).collect();
        assert_eq!((json.line, lines), (2, vec![("a", 2), ("bä\n😀", 4), ("d", 4)]));
        assert_eq!(members[0].1.numbers(), Some([1.0, -2.5e-3, 0.0]));
        assert!(matches!(members[2].1.node, Node::Null));
    }

    #[test]
    fn what_is_no_json_is_refused_with_its_line() {
        for (text, says) in [
            ("", "1: expected a value, found the end"),
            ("{\"a\": 1\n\"b\": 2}", "2: expected `,` or `}`, found '\"'"),
            ("{\"a\": 1,}", "1: expected a key in quotes, found '}'"),
            ("{a: 1}", "1: expected a key in quotes, found 'a'"),
            ("{\"a\" 1}", "1: expected `:` after a key, found '1'"),
            ("{\"a\": 1, \"\\u0061\": 2}", "1: the key \"a\" is there twice"),
            ("[1 2]", "1: expected `,` or `]`, found '2'"),
            ("[1,", "1: expected a value, found the end"),
            ("1 2", "1: more than one value"),
            ("// no", "1: expected a value, found '/'"),
            ("nan", "1: expected a value, found 'n'"),
            ("01", "1: 01 is not a number in JSON"),
            ("1.", "1: 1. is not a number in JSON"),
            ("-", "1: - is not a number in JSON"),
            ("1e", "1: 1e is not a number in JSON"),
            ("\"a", "1: a string does not end"),
            ("\"a\nb\"", "1: a string goes on beyond its line, or holds a control character"),
            ("\"\\x\"", "1: an unknown escape in a string"),
            ("\"\\", "1: an unknown escape in a string"),
            ("\"\\ü\"", "1: an unknown escape in a string"),
            ("\"\\u12", "1: expected four hexadecimal digits after \\u"),
            ("\"\\u12ü\"", "1: expected four hexadecimal digits after \\u"),
            ("\"\\ud800\"", "1: half a character in a string"),
            ("\"\\ud800\\u0041\"", "1: half a character in a string"),
        ] {
            assert_eq!(wrong(text), says, "{text}");
        }
    }

    #[test]
    fn bombs_do_not_go_off() {
        assert!(wrong(&"[".repeat(1 << 20)).contains("more than 8 lists"));
        assert!(wrong(&"{\"a\":".repeat(1 << 20)).contains("more than 8 lists"));
        assert!(wrong(&format!("[{}1]", "1,".repeat(1 << 20))).contains("more than 16 values"));
        assert!(parse(&format!("\"{}\"", "\\\\".repeat(1 << 20))).is_ok());
    }

    #[test]
    fn numbers_come_back() {
        let mut bits: u32 = 12345;
        for _ in 0..200_000 {
            bits = bits.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            let v = f32::from_bits(bits ^ (bits >> 15));
            if v.is_finite() {
                let text = number_text(v);
                assert_eq!(parse(&text).unwrap().number().map(f32::to_bits), Some(v.to_bits()), "{text}");
            }
        }
        let texts = [0.0, -0.0, 1.0, 0.1, 16777217.0, 1e-5, 9e-6, 1e9, f32::MAX].map(number_text);
        assert_eq!(texts, ["0", "-0", "1", "0.1", "16777216", "0.00001", "9e-6", "1e9", "3.4028235e38"]);
        assert_eq!(parse("1e39").unwrap().number(), None);
    }

    #[test]
    fn strings_come_back() {
        for text in ["", "a", "\"\\/", "\n\r\t\u{0}\u{1f}\u{7f}", "ä😀"] {
            let quoted = quoted(text);
            let Node::Text(back) = parse(&quoted).unwrap().node else { panic!() };
            assert_eq!(back, text, "{quoted}");
        }
    }

    #[test]
    fn objects_are_indented() {
        let text = Writer::document(|w| {
            w.member("a", "1");
            w.object("b", |w| w.object("c", |_| ()));
            w.member("d", "[1, 2]");
        });
        assert_eq!(text, "{\n  \"a\": 1,\n  \"b\": {\n    \"c\": {}\n  },\n  \"d\": [1, 2]\n}\n");
        assert_eq!(Writer::document(|_| ()), "{}\n");
    }
}

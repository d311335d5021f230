//! Lines and words of OBJ and MTL, which share their form (Wavefront Technologies 1995): statements of one line, a backslash at
//! the end of a line to continue it, `#` for comments.

use std::borrow::Cow;
use std::io::BufRead;

/// Takes the lines off a text one by one.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    /// Lines of the file that were taken; a continued line counts as many as it takes there.
    pub(super) taken: usize,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        Lines { rest: text, taken: 0 }
    }

    /// The next line without its end, and the number of its first line in the file, from 1.
    #[inline]
    pub(super) fn next(&mut self) -> Option<(usize, Cow<'a, [u8]>)> {
        let line = self.physical()?;
        let number = self.taken;
        match line.strip_suffix(b"\\") {
            None => Some((number, Cow::Borrowed(line))),
            Some(begin) => Some((number, Cow::Owned(self.continued(begin)))),
        }
    }

    /// A line of the file, without LF or CR LF.
    #[inline]
    fn physical(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.taken += 1;
        let all = self.rest;
        // Reading from memory does not fail.
        let length = self.rest.skip_until(b'\n').unwrap_or(all.len());
        let line = &all[..length];
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        Some(line.strip_suffix(b"\r").unwrap_or(line))
    }

    fn continued(&mut self, begin: &[u8]) -> Vec<u8> {
        let mut whole = begin.to_vec();
        while let Some(line) = self.physical() {
            whole.push(b' ');
            match line.strip_suffix(b"\\") {
                Some(part) => whole.extend_from_slice(part),
                None => {
                    whole.extend_from_slice(line);
                    break;
                }
            }
        }
        whole
    }
}

#[inline]
fn is_blank(b: u8) -> bool {
    matches!(b, b' ' | b'\t' | b'\r' | 0x0b | 0x0c)
}

/// The first word of a line and what follows it.
#[inline]
pub(super) fn split_word(line: &[u8]) -> (&[u8], &[u8]) {
    let begin = line.iter().position(|&b| !is_blank(b)).unwrap_or(line.len());
    let line = &line[begin..];
    let end = line.iter().position(|&b| is_blank(b)).unwrap_or(line.len());
    line.split_at(end)
}

/// The words of a line, up to a comment.
pub(super) struct Words<'a>(pub(super) &'a [u8]);

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    #[inline]
    fn next(&mut self) -> Option<&'a [u8]> {
        let (word, rest) = split_word(self.0);
        self.0 = rest;
        if word.is_empty() || word[0] == b'#' { None } else { Some(word) }
    }
}

/// Without blanks at its ends.
pub(super) fn trim(text: &[u8]) -> &[u8] {
    let begin = text.iter().position(|&b| !is_blank(b)).unwrap_or(text.len());
    let end = text.iter().rposition(|&b| !is_blank(b)).map_or(begin, |at| at + 1);
    &text[begin..end]
}

/// Bytes as text: UTF-8, or else each byte as the character of that number (Latin-1), as old programs wrote names. Either way
/// different bytes stay different names.
pub(super) fn text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}

/// A name that fills the rest of a line: blanks and `#` may be parts of it.
pub(super) fn name(rest: &[u8]) -> String {
    text(trim(rest))
}

/// A word cut short for a message.
pub(super) fn shown(word: &[u8]) -> String {
    format!("{:?}", text(&word[..word.len().min(40)]))
}

/// A number, correctly rounded. What programs print instead of one (`nan`, `1.#IND`, `-nan(ind)`) is not a number but no error:
/// it is left to the caller, who knows whether it matters.
#[inline]
pub(super) fn number(word: &[u8]) -> Result<f32, String> {
    // A word of digits is UTF-8.
    if let Some(value) = std::str::from_utf8(word).ok().and_then(|w| w.parse::<f32>().ok()) {
        return Ok(value);
    }
    let lower = word.to_ascii_lowercase();
    if lower.contains(&b'#') || lower.windows(3).any(|w| w == b"nan" || w == b"ind") {
        return Ok(f32::NAN);
    }
    Err(format!("{} is no number", shown(word)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<(usize, String)> {
        let mut lines = Lines::new(text.as_bytes());
        std::iter::from_fn(|| lines.next().map(|(n, l)| (n, name(&l)))).collect()
    }

    #[test]
    fn lines_end_and_continue() {
        let of = |list: &[(usize, &str)]| list.iter().map(|(n, s)| (*n, (*s).into())).collect::<Vec<_>>();
        assert_eq!(lines("a\r\nb\n\nc"), of(&[(1, "a"), (2, "b"), (3, ""), (4, "c")]));
        assert_eq!(lines("a \\\n b\\\r\nc\nd\n"), of(&[(1, "a   b c"), (4, "d")]));
        assert_eq!(lines("a\\"), of(&[(1, "a")]));
        assert_eq!(lines(""), []);
    }

    #[test]
    fn words_end_at_a_comment_and_names_do_not() {
        let words: Vec<_> = Words(b" 1\t2  # 3").collect();
        assert_eq!(words, [b"1", b"2"]);
        assert_eq!(name(b"  _Material #25 \t"), "_Material #25");
        assert_eq!(name("ñandú".as_bytes()), "ñandú");
        assert_eq!(name(&[0xf1, b'a']), "ña");
    }

    #[test]
    fn numbers_are_exact_and_nonsense_is_told_from_what_is_not_finite() {
        assert_eq!(number(b"0.1"), Ok(0.1));
        assert_eq!(number(b"-1.5E-3"), Ok(-0.0015));
        assert_eq!(number(b"+.5"), Ok(0.5));
        assert_eq!(number(b"3."), Ok(3.0));
        // Halfway between two floats in 7 digits, decided by the 25th.
        assert_eq!(number(b"16777217.0000000000000001"), Ok(16_777_218.0));
        assert_eq!(number(b"16777217"), Ok(16_777_216.0));
        assert_eq!(number(b"1e400"), Ok(f32::INFINITY));
        for odd in ["nan", "-nan(ind)", "1.#IND", "-1.#QNAN00"] {
            assert!(number(odd.as_bytes()).unwrap().is_nan(), "{odd}");
        }
        assert_eq!(number(b"1,5"), Err("\"1,5\" is no number".into()));
    }
}

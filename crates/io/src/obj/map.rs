//! The statements of MTL that name a picture: options, then a file name that may hold blanks.

use super::text::{name, number, shown, split_word, text, trim};

/// A picture and how it is used.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    /// As the file writes it.
    pub(super) name: String,
    /// The line it stands on.
    pub(super) line: usize,
    /// `-s`: factors on u and v.
    pub(super) scale: [f32; 2],
    /// `-o`: added to u and v after that.
    pub(super) offset: [f32; 2],
    /// `-bm`: strength of a bump or normal map.
    pub(super) strength: f32,
    /// `-clamp on`: the edge goes on outside.
    pub(super) clamp: bool,
    /// `-imfchan`: which channel is meant where one number is wanted.
    pub(super) channel: Option<Channel>,
}

/// A number from a texel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Channel {
    /// 0 red, 1 green, 2 blue, 3 alpha.
    One(u8),
    /// Of red, green and blue.
    Luminance,
}

/// Reads what follows the keyword on `line`. `odd` is told of options that are left out.
pub(super) fn parse(rest: &[u8], line: usize, mut odd: impl FnMut(String)) -> Result<Map, String> {
    let mut map = Map {
        name: String::new(),
        line,
        scale: [1.0; 2],
        offset: [0.0; 2],
        strength: 1.0,
        clamp: false,
        channel: None,
    };
    let mut rest = trim(rest);
    loop {
        let (word, after) = split_word(rest);
        let Some(after) = option(&mut map, word, after, &mut odd)? else { break };
        rest = trim(after);
    }
    // Some programs write it last.
    if let Some(at) = rest.windows(5).rposition(|w| w == b" -bm ")
        && let Ok(strength) = number(trim(&rest[at + 5..]))
    {
        map.strength = strength;
        rest = &rest[..at];
    }
    let quoted = rest.strip_prefix(b"\"").and_then(|r| r.strip_suffix(b"\""));
    map.name = name(quoted.unwrap_or(rest));
    if map.name.is_empty() { Err("names no file".into()) } else { Ok(map) }
}

/// Takes in an option; returns what follows its values. `None`: the word is none, so it begins the file name.
fn option<'a>(
    map: &mut Map,
    word: &[u8],
    rest: &'a [u8],
    odd: &mut impl FnMut(String),
) -> Result<Option<&'a [u8]>, String> {
    let (value, after) = split_word(rest);
    let not_read = |what: &[u8]| format!("the option {} of a map is not supported", shown(what));
    match word {
        b"-s" => return Ok(Some(numbers(rest, &mut map.scale))),
        b"-o" => return Ok(Some(numbers(rest, &mut map.offset))),
        b"-t" => {
            odd(not_read(word));
            return Ok(Some(numbers(rest, &mut [0.0; 2])));
        }
        b"-bm" => map.strength = number(value)?,
        b"-clamp" => map.clamp = value == b"on",
        b"-imfchan" => {
            map.channel = match value {
                b"r" => Some(Channel::One(0)),
                b"g" => Some(Channel::One(1)),
                b"b" => Some(Channel::One(2)),
                b"m" => Some(Channel::One(3)),
                b"l" => Some(Channel::Luminance),
                _ => {
                    odd(format!("the channel {} of a map is not supported", shown(value)));
                    None
                }
            }
        }
        b"-mm" => {
            let (gain, after) = split_word(after);
            if (number(value), number(gain)) != (Ok(0.0), Ok(1.0)) {
                odd(not_read(word));
            }
            return Ok(Some(after));
        }
        // Hints for the filters of other programs.
        b"-blendu" | b"-blendv" | b"-boost" | b"-texres" => {}
        b"-cc" | b"-type" | b"-colorspace" => {
            if value != b"off" {
                odd(not_read(word));
            }
        }
        _ => return Ok(None),
    }
    Ok(Some(after))
}

/// Takes one to three numbers; the first two go into `out`, which keeps what is not given. Returns what follows.
fn numbers<'a>(rest: &'a [u8], out: &mut [f32; 2]) -> &'a [u8] {
    let mut rest = rest;
    for count in 0..3 {
        let (word, after) = split_word(rest);
        // A file may be called 2.png: only a word that is a number as a whole is one.
        let Some(value) = text(word).parse::<f32>().ok().filter(|v| v.is_finite()) else { break };
        if let Some(slot) = out.get_mut(count) {
            *slot = value;
        }
        rest = after;
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(rest: &str) -> (Map, Vec<String>) {
        let mut odd = Vec::new();
        let map = parse(rest.as_bytes(), 7, |what| odd.push(what)).unwrap();
        (map, odd)
    }

    #[test]
    fn names_may_hold_blanks_and_look_like_numbers() {
        for (rest, name) in [
            ("wood.png", "wood.png"),
            ("  Old Wood #2.png \t", "Old Wood #2.png"),
            ("\"Old Wood.png\"", "Old Wood.png"),
            ("-s 2 2 2 2 planks.png", "2 planks.png"),
            ("-o 1 1 1.png", "1.png"),
            ("-blendu on -clamp off -mm 0 1 -texres 512 C:\\a b\\c.png", "C:\\a b\\c.png"),
            ("-dark-.png", "-dark-.png"),
            ("ñandú.png", "ñandú.png"),
        ] {
            let (map, odd) = read(rest);
            assert_eq!((map.name.as_str(), map.line), (name, 7), "{rest}");
            assert_eq!(odd, Vec::<String>::new(), "{rest}");
        }
        assert!(parse(b"-s 1 1 1", 1, |_| ()).is_err() && parse(b"", 1, |_| ()).is_err());
    }

    #[test]
    fn options_are_honoured_or_told() {
        let (map, odd) = read("-s 2 3 4 -o 0.5 -bm 0.25 -clamp on -imfchan m a.png");
        assert_eq!((map.scale, map.offset, map.strength), ([2.0, 3.0], [0.5, 0.0], 0.25));
        assert_eq!((map.clamp, map.channel, odd.len()), (true, Some(Channel::One(3)), 0));
        assert_eq!(read("a b.png -bm 0.3").0.strength, 0.3);
        assert_eq!(read("a b.png -bm 0.3").0.name, "a b.png");
        let (map, odd) = read("-t 1 1 1 -cc on -mm 0.1 2 -imfchan z a.png");
        assert_eq!((map.name.as_str(), odd.len()), ("a.png", 4));
        assert!(parse(b"-bm x a.png", 1, |_| ()).is_err());
    }
}

//! `cargo xtask typos`: known misspellings in .rs, .md and .toml files, by the dictionary of the `typos` program.
//! British and American spellings are both right. Words that only look wrong are listed in `xtask/typos-allow.txt`.

use crate::tree;
use std::collections::HashSet;

/// Letters of the shortest word that is checked: two letters are an abbreviation.
const SHORTEST: usize = 3;

/// Checks the whole tree.
///
/// # Errors
/// One line per misspelling.
pub(crate) fn run() -> Result<(), String> {
    let list = tree::read(&tree::root().join("xtask/typos-allow.txt"))?;
    let allowed = allowed_words(&list);
    let mut found = Vec::new();
    for (path, text) in tree::text_files(&["rs", "md", "toml"])? {
        for (i, line) in text.lines().enumerate() {
            for (word, right) in misspelt(line, &allowed) {
                found.push(format!("{path}:{}: \"{word}\" should be {}", i + 1, right.join(" or ")));
            }
        }
    }
    if found.is_empty() { Ok(()) } else { Err(found.join("\n")) }
}

/// One lower-case word per line; `#` begins a comment.
fn allowed_words(list: &str) -> HashSet<String> {
    let words = list.lines().map(|l| l.split('#').next().unwrap_or_default().trim());
    words.filter(|w| !w.is_empty()).map(str::to_lowercase).collect()
}

/// The misspelt words of a line with their corrections.
fn misspelt<'a>(line: &'a str, allowed: &HashSet<String>) -> Vec<(&'a str, Vec<&'static str>)> {
    words(line)
        .filter(|word| word.chars().count() >= SHORTEST && !allowed.contains(&word.to_lowercase()))
        .filter_map(|word| {
            let corrections = typos_dict::WORD.find(&word.into())?;
            Some((word, corrections.to_vec()))
        })
        .collect()
}

/// The words of a line, identifiers split at `_` and before capitals. What touches a digit is no word but a name, a number
/// or a hash.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !c.is_alphanumeric())
        .filter(|run| !run.contains(|c: char| !c.is_alphabetic()))
        .flat_map(split_capitals)
}

/// `TwoWords` as `Two`, `Words`; `HTMLPage` as `HTML`, `Page`.
fn split_capitals(run: &str) -> Vec<&str> {
    let chars: Vec<(usize, char)> = run.char_indices().collect();
    let mut starts = vec![0];
    for i in 1..chars.len() {
        let after_lower = chars[i].1.is_uppercase() && chars[i - 1].1.is_lowercase();
        let before_lower = chars[i].1.is_uppercase() && chars.get(i + 1).is_some_and(|c| c.1.is_lowercase());
        if after_lower || before_lower {
            starts.push(chars[i].0);
        }
    }
    let ends = starts[1..].iter().copied().chain([run.len()]);
    starts.iter().zip(ends).map(|(start, end)| &run[*start..end]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    // Assembled at compile time, so that this file passes its own check.
    const WRONG: &str = concat!("reci", "eve");

    #[test]
    fn a_misspelling_is_found_in_text_and_in_names() {
        let none = HashSet::new();
        for line in
            [format!("to {WRONG} it"), format!("let {WRONG}_all = 1;"), format!("struct Recv{}", capital())]
        {
            let found = misspelt(&line, &none);
            assert_eq!(found.len(), 1, "{line}");
            assert_eq!(found[0].1, ["receive"]);
        }
        assert!(misspelt("to receive the colour or color, fo", &none).is_empty());
    }

    fn capital() -> String {
        format!("R{}", &WRONG[1..])
    }

    #[test]
    fn the_list_allows_words() {
        let allowed = allowed_words(&format!("# why\n{WRONG} # a name\n\n"));
        assert!(misspelt(WRONG, &allowed).is_empty());
        assert_eq!(allowed.len(), 1);
    }

    #[test]
    fn words_split_where_readers_split_them() {
        let split: Vec<&str> = words("fooBar HTMLPage snake_case 0xbeef v2x SHOUT l'été").collect();
        assert_eq!(split, ["foo", "Bar", "HTML", "Page", "snake", "case", "SHOUT", "l", "été"]);
    }
}

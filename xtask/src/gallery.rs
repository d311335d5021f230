//! `cargo xtask gallery [PART…]`: draws the pictures of `docs/gallery.md` again.
//!
//! The page shows each picture with the command that draws it; this chore reads those commands, so that page and pictures cannot
//! drift apart. `$LUMBRE_SCENES` in a command is the folder of test scenes: the variable of that name, or `../shared/scenes`.

use crate::{command, tree};

/// The page, from the workspace root.
const PAGE: &str = "docs/gallery.md";

/// Runs every command of the page that contains one of `parts`, or all if there are none.
///
/// # Errors
/// The command that failed; a `parts` that is in none.
pub(crate) fn run(parts: &[String]) -> Result<(), String> {
    let page = tree::read(&tree::root().join(PAGE))?;
    let scenes = std::env::var("LUMBRE_SCENES").unwrap_or_else(|_| "../shared/scenes".to_owned());
    let all = commands(&page)?;
    let chosen: Vec<_> =
        all.iter().filter(|c| parts.is_empty() || parts.iter().any(|p| c.join(" ").contains(p))).collect();
    if chosen.is_empty() {
        return Err(format!("{PAGE}: no command contains {}", parts.join(" or ")));
    }
    for (i, words) in chosen.iter().enumerate() {
        eprintln!("{} of {}: {}", i + 1, chosen.len(), words.join(" "));
        let mut args: Vec<String> = ["--release", "-p", "lumbre-cli", "--"].map(String::from).into();
        args.extend(words.iter().map(|w| w.replace("$LUMBRE_SCENES", &scenes)));
        command::cargo("run", &args, &[])?;
    }
    Ok(())
}

/// The `lumbre …` lines of the page's code blocks, as words after `lumbre`. A backslash at the end continues a line, quotes hold
/// blanks together.
fn commands(page: &str) -> Result<Vec<Vec<String>>, String> {
    let mut out = Vec::new();
    let mut inside = false;
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            inside = !inside;
        } else if let Some(rest) = line.strip_prefix("lumbre ").filter(|_| inside) {
            let mut whole = rest.to_owned();
            while whole.ends_with('\\') {
                whole.pop();
                whole.push_str(lines.next().unwrap_or_default());
            }
            out.push(words(&whole)?);
        }
    }
    Ok(out)
}

fn words(line: &str) -> Result<Vec<String>, String> {
    let mut out = Vec::new();
    let (mut word, mut quoted, mut any) = (String::new(), false, false);
    for c in line.chars() {
        match c {
            '"' => (quoted, any) = (!quoted, true),
            c if c.is_whitespace() && !quoted => {
                if any || !word.is_empty() {
                    out.push(std::mem::take(&mut word));
                }
                any = false;
            }
            c => word.push(c),
        }
    }
    if quoted {
        return Err(format!("{PAGE}: a quote is not closed: {line}"));
    }
    if any || !word.is_empty() {
        out.push(word);
    }
    Ok(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_stand_in_code_blocks() {
        let page = "lumbre render no\n```\nlumbre render \"$LUMBRE_SCENES/a b.glb\" \\\n  -o c.png\nls\n```\nlumbre no\n";
        let found = commands(page).unwrap();
        assert_eq!(found, [["render", "$LUMBRE_SCENES/a b.glb", "-o", "c.png"]]);
        assert!(commands("```\nlumbre render \"a\n```\n").is_err());
    }
}

//! What there is to say of a render: what it aims at, what ended it, samples that were no numbers, sums that ran out of range.

use crate::console;
use crate::progress::plain::{duration, error};
use lumbre::core::Film;
use lumbre::{Ended, Outcome, Targets};
use std::env;
use std::ffi::OsString;
use std::path::Path;

/// Most samples that are named.
const NAMED: usize = 3;

/// Says what was chosen for a user who chose nothing.
pub(super) fn chosen(targets: &Targets) {
    let error = targets.error.map(|e| format!("error {e}"));
    let spp = targets.spp.map(|n| format!("{n} samples per pixel"));
    let time = targets.time.map(|t| duration(t.as_secs_f64()));
    let aims: Vec<String> = [error, spp, time].into_iter().flatten().collect();
    console::note(format_args!("target: {}, whichever comes first", aims.join(", ")));
}

/// Says why it stopped, where that was not clear from the beginning, and how good the picture is.
pub(super) fn ended(outcome: &Outcome, targets: &Targets) {
    let why = match outcome.ended {
        Ended::Cancelled | Ended::Failed => return,
        Ended::Spp if targets.time.is_none() && targets.error.is_none() => "",
        Ended::Spp => "all samples taken: ",
        Ended::Time => "time is up: ",
        Ended::Error => "good enough: ",
    };
    let error = error(outcome.error);
    console::note(format_args!("{why}{} samples per pixel, estimated error {error}", outcome.spp));
}

/// Reports on a film; returns how many sums ran out of range.
pub(super) fn film(film: &Film) -> u64 {
    let count = film.non_finite_count();
    if count > 0 {
        console::warning(format_args!(
            "{count} samples were not finite and count as black; to see how one comes about:"
        ));
        let base = replay_base(env::args_os().collect());
        for n in film.non_finite().iter().take(NAMED) {
            let [row, column] = n.row_column;
            console::note(format_args!("  {base} --pixel {column},{row} --sample {}", n.sample));
        }
    }
    let saturated: u64 = film.pixels().iter().map(|p| u64::from(p.saturated())).sum();
    if saturated > 0 {
        let pixels = film.pixels().iter().filter(|p| p.saturated() > 0).count();
        console::warning(format_args!(
            "{pixels} pixels are brighter than the film can hold: {saturated} sums stopped at their limit"
        ));
    }
    saturated
}

/// Says where to look for reasons if the picture is black all over.
pub(super) fn black(film: &Film, scene: &Path) {
    if lumbre::output::is_black(film) {
        let scene = quoted(&scene.to_string_lossy());
        console::note(format_args!("the picture is black all over; `lumbre info {scene}` looks for reasons"));
    }
}

/// The command line without its outputs, quoted for a shell.
fn replay_base(args: Vec<OsString>) -> String {
    let mut words = Vec::new();
    let mut args = args.into_iter().map(|a| a.to_string_lossy().into_owned());
    while let Some(arg) = args.next() {
        if arg == "-o" || arg == "--output" {
            args.next();
        } else if !(arg.starts_with("--output=") || arg.starts_with("-o")) {
            words.push(quoted(&arg));
        }
    }
    words.join(" ")
}

fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.into()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_replay_command_is_the_same_but_for_outputs() {
        let line = |words: &[&str]| replay_base(words.iter().map(OsString::from).collect());
        let words =
            ["lumbre", "render", "my scene.glb", "-o", "a.png", "-ob.exr", "--output=c.png", "--seed", "3"];
        assert_eq!(line(&words), "lumbre render 'my scene.glb' --seed 3");
        assert_eq!(
            line(&["l", "render", "it's.glb", "--sky", "#ff0000"]),
            r"l render 'it'\''s.glb' --sky '#ff0000'"
        );
    }
}

//! A display without a screen, and pictures of what stands on it.

use lumbre::io::write_png;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use tempfile::TempDir;

/// An X server. It ends when this is dropped.
pub(crate) struct Display {
    server: Child,
    /// Columns and rows.
    pub(crate) size: [u32; 2],
    /// As `DISPLAY` has it.
    pub(crate) name: String,
    /// Where the server keeps its picture.
    picture: TempDir,
}

impl Display {
    /// Starts one; `None`, said by name, where that or the hand that moves the mouse is not installed.
    pub(crate) fn start(size: [u32; 2]) -> Option<Self> {
        let missing = ["Xvfb", "xdotool"].into_iter().find(|program| {
            let found =
                Command::new(program).arg("-version").stdout(Stdio::null()).stderr(Stdio::null()).status();
            found.is_err()
        });
        if let Some(program) = missing {
            let required = std::env::var("LUMBRE_REQUIRE_WINDOW").is_ok_and(|v| v == "1");
            assert!(!required, "LUMBRE_REQUIRE_WINDOW=1, but there is no {program}");
            println!("skipped: no {program}");
            return None;
        }
        let picture = tempfile::tempdir().unwrap();
        let screen = format!("{}x{}x24", size[0], size[1]);
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-screen", "0", &screen, "-fbdir"])
            .arg(picture.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        BufReader::new(server.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.trim().is_empty(), "Xvfb has no display for us");
        Some(Display { server, size, name: format!(":{}", number.trim()), picture })
    }

    /// Writes what stands on the display.
    pub(crate) fn photograph(&self, path: &Path) {
        let bytes = std::fs::read(self.picture.path().join("Xvfb_screen0")).unwrap();
        write_png(path, self.size[0], self.size[1], &pixels(&bytes, self.size)).unwrap();
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// Red, green, blue of each pixel of an X window dump (XWDFile.h): a header of big-endian words, a table of colours, and rows of 32 bits
/// a pixel, blue first.
fn pixels(dump: &[u8], size: [u32; 2]) -> Vec<u8> {
    let word = |i: usize| u32::from_be_bytes(dump[4 * i..][..4].try_into().unwrap()) as usize;
    let (header, version, width, height) = (word(0), word(1), word(4), word(5));
    let (bits, row, colors) = (word(11), word(12), word(19));
    assert_eq!((version, bits, [width as u32, height as u32]), (7, 32, size));
    let rows = dump[header + 12 * colors..].chunks_exact(row).take(height);
    rows.flat_map(|row| row[..4 * width].chunks_exact(4).flat_map(|p| [p[2], p[1], p[0]])).collect()
}

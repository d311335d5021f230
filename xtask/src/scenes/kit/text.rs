//! Digits and capitals drawn by strokes: straight lines and arcs of our own, in a cell one unit high.

use glam::DVec2;
use std::f64::consts::FRAC_PI_2;

/// Lettering: the centre lines of its strokes, x to the right, y downwards, one unit high.
pub(crate) struct Text {
    strokes: Vec<Vec<DVec2>>,
    /// Width of the whole.
    pub(crate) width: f64,
}

impl Text {
    /// Distance from a point to the nearest centre line.
    pub(crate) fn distance(&self, p: DVec2) -> f64 {
        let segments = self.strokes.iter().flat_map(|s| s.windows(2));
        let distance = |w: &[DVec2]| {
            let along = w[1] - w[0];
            let t = ((p - w[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            (w[0] + along * t - p).length()
        };
        segments.map(distance).fold(f64::MAX, f64::min)
    }
}

/// The letters of `text` side by side. Panics on characters other than digits, capitals, space, hyphen and point.
pub(crate) fn lettering(text: &str) -> Text {
    let mut out = Text { strokes: Vec::new(), width: 0.0 };
    for (i, letter) in text.chars().enumerate() {
        if i > 0 {
            out.width += 0.26;
        }
        let (width, strokes) = glyph(letter);
        let x = DVec2::new(out.width, 0.0);
        out.strokes.extend(strokes.into_iter().map(|s| s.into_iter().map(|p| p + x).collect()));
        out.width += width;
    }
    out
}

type Stroke = Vec<DVec2>;

fn line(points: &[[f64; 2]]) -> Stroke {
    points.iter().map(|p| DVec2::from(*p)).collect()
}

/// Arc of an ellipse from quarter `from` to quarter `to` of a turn; 0 points right, 1 down.
fn arc([x, y]: [f64; 2], [rx, ry]: [f64; 2], from: f64, to: f64) -> Stroke {
    let steps = ((to - from).abs() * 6.0).ceil() as usize;
    let at = |i: usize| {
        let (s, c) = libm::sincos(FRAC_PI_2 * (from + (to - from) * i as f64 / steps as f64));
        DVec2::new(x + rx * c, y + ry * s)
    };
    (0..=steps).map(at).collect()
}

/// Width of most letters, and half of it.
const W: f64 = 0.56;
const H: f64 = W / 2.0;

/// The stem at the left of many letters.
fn stem() -> Stroke {
    line(&[[0.0, 0.0], [0.0, 1.0]])
}

/// A bowl to the right of the stem, around height `y`.
fn bowl(y: f64, r: f64) -> Stroke {
    let mut stroke = line(&[[0.0, y - r]]);
    stroke.extend(arc([W - r, y], [r, r], -1.0, 1.0));
    stroke.extend(line(&[[0.0, y + r]]));
    stroke
}

/// Width and strokes of a letter.
fn glyph(letter: char) -> (f64, Vec<Stroke>) {
    if letter.is_ascii_digit() { digit(letter) } else { capital(letter) }
}

fn digit(letter: char) -> (f64, Vec<Stroke>) {
    let strokes = match letter {
        '0' => vec![arc([H, 0.5], [H, 0.5], 0.0, 4.0)],
        '1' => return (0.3, vec![line(&[[0.0, 0.25], [0.25, 0.0], [0.25, 1.0]])]),
        '2' => {
            let mut top = arc([H, H], [H, H], -2.0, 0.4);
            top.extend(line(&[[0.0, 1.0], [W, 1.0]]));
            vec![top]
        }
        '3' => vec![arc([H, 0.25], [H * 0.9, 0.25], -1.9, 1.0), arc([H, 0.75], [H, 0.25], -1.0, 1.9)],
        '4' => vec![line(&[[W, 0.68], [0.0, 0.68], [0.4, 0.0], [0.4, 1.0]])],
        '5' => {
            let mut stroke = line(&[[W * 0.93, 0.0], [0.06, 0.0], [0.03, 0.43]]);
            stroke.extend(arc([H * 0.95, 0.68], [H * 1.05, 0.32], -1.55, 1.75));
            vec![stroke]
        }
        '6' => vec![arc([H, 0.7], [H, 0.3], 0.0, 4.0), arc([W * 0.98, 0.72], [W * 0.98, 0.72], 2.0, 2.85)],
        '7' => vec![line(&[[0.0, 0.0], [W, 0.0], [0.18, 1.0]])],
        '8' => vec![arc([H, 0.24], [H * 0.86, 0.24], 0.0, 4.0), arc([H, 0.74], [H, 0.26], 0.0, 4.0)],
        '9' => vec![arc([H, 0.3], [H, 0.3], 0.0, 4.0), arc([W * 0.02, 0.28], [W * 0.98, 0.72], 0.0, 0.85)],
        _ => panic!("no strokes for {letter:?}"),
    };
    (W, strokes)
}

fn capital(letter: char) -> (f64, Vec<Stroke>) {
    let strokes = match letter {
        'A' => vec![line(&[[0.0, 1.0], [H, 0.0], [W, 1.0]]), line(&[[0.1, 0.66], [W - 0.1, 0.66]])],
        'B' => vec![stem(), bowl(0.24, 0.24), bowl(0.74, 0.26)],
        'C' => vec![arc([0.32, 0.5], [0.32, 0.5], -0.55, -3.45)],
        'D' => {
            let mut stroke = line(&[[0.0, 0.0], [0.12, 0.0]]);
            stroke.extend(arc([0.12, 0.5], [W - 0.12, 0.5], -1.0, 1.0));
            stroke.extend(line(&[[0.0, 1.0]]));
            vec![stem(), stroke]
        }
        'E' => {
            vec![line(&[[W, 0.0], [0.0, 0.0], [0.0, 1.0], [W, 1.0]]), line(&[[0.0, 0.48], [W * 0.85, 0.48]])]
        }
        'F' => vec![line(&[[W, 0.0], [0.0, 0.0], [0.0, 1.0]]), line(&[[0.0, 0.48], [W * 0.85, 0.48]])],
        'G' => {
            let mut stroke = arc([0.32, 0.5], [0.32, 0.5], -0.55, -4.0);
            stroke.extend(line(&[[0.64, 0.55], [0.38, 0.55]]));
            return (0.64, vec![stroke]);
        }
        'H' => vec![stem(), line(&[[W, 0.0], [W, 1.0]]), line(&[[0.0, 0.48], [W, 0.48]])],
        'I' => return (0.0, vec![stem()]),
        'J' => {
            let mut stroke = line(&[[0.44, 0.0]]);
            stroke.extend(arc([0.22, 0.76], [0.22, 0.24], 0.0, 2.0));
            return (0.44, vec![stroke]);
        }
        'K' => vec![stem(), line(&[[W, 0.0], [0.0, 0.6]]), line(&[[0.2, 0.4], [W, 1.0]])],
        'L' => return (0.48, vec![line(&[[0.0, 0.0], [0.0, 1.0], [0.48, 1.0]])]),
        'M' => return (0.7, vec![line(&[[0.0, 1.0], [0.0, 0.0], [0.35, 0.6], [0.7, 0.0], [0.7, 1.0]])]),
        'N' => vec![line(&[[0.0, 1.0], [0.0, 0.0], [W, 1.0], [W, 0.0]])],
        'O' => vec![arc([H, 0.5], [H, 0.5], 0.0, 4.0)],
        'P' => vec![stem(), bowl(0.27, 0.27)],
        'Q' => vec![arc([H, 0.5], [H, 0.5], 0.0, 4.0), line(&[[0.34, 0.75], [W, 1.05]])],
        'R' => vec![stem(), bowl(0.27, 0.27), line(&[[0.26, 0.54], [W, 1.0]])],
        'S' => {
            let mut stroke = arc([H, 0.25], [H, 0.25], -0.25, -3.0);
            stroke.extend(arc([H, 0.75], [H, 0.25], -1.0, 1.75));
            vec![stroke]
        }
        'T' => vec![line(&[[0.0, 0.0], [W, 0.0]]), line(&[[H, 0.0], [H, 1.0]])],
        'U' => {
            let mut stroke = line(&[[0.0, 0.0]]);
            stroke.extend(arc([H, 0.72], [H, 0.28], 2.0, 0.0));
            stroke.extend(line(&[[W, 0.0]]));
            vec![stroke]
        }
        'V' => vec![line(&[[0.0, 0.0], [H, 1.0], [W, 0.0]])],
        'W' => return (0.8, vec![line(&[[0.0, 0.0], [0.2, 1.0], [0.4, 0.2], [0.6, 1.0], [0.8, 0.0]])]),
        'X' => vec![line(&[[0.0, 0.0], [W, 1.0]]), line(&[[W, 0.0], [0.0, 1.0]])],
        'Y' => vec![line(&[[0.0, 0.0], [H, 0.5], [W, 0.0]]), line(&[[H, 0.5], [H, 1.0]])],
        'Z' => vec![line(&[[0.0, 0.0], [W, 0.0], [0.0, 1.0], [W, 1.0]])],
        '-' => return (0.3, vec![line(&[[0.0, 0.52], [0.3, 0.52]])]),
        '.' => return (0.0, vec![line(&[[0.0, 0.98], [0.0, 1.0]])]),
        ' ' => return (0.3, Vec::new()),
        _ => panic!("no strokes for {letter:?}"),
    };
    (W, strokes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_stay_in_their_cells_and_differ() {
        let mut seen: Vec<String> = Vec::new();
        for letter in ('0'..='9').chain('A'..='Z').filter(|c| *c != 'O') {
            let (width, strokes) = glyph(letter);
            for p in strokes.iter().flatten() {
                assert!(p.x > -0.02 && p.x < width + 0.02 && p.y > -0.02 && p.y < 1.06, "{letter} at {p}");
            }
            let drawn = format!("{strokes:?}");
            assert!(!seen.contains(&drawn), "{letter} looks like another");
            seen.push(drawn);
        }
    }

    #[test]
    fn distance_is_measured_to_the_stroke() {
        let one = lettering("I");
        assert_eq!((one.distance(DVec2::new(0.25, 0.5)), one.distance(DVec2::new(0.0, 1.5))), (0.25, 0.5));
        assert!((lettering("II").width - 0.26).abs() < 1e-12);
    }
}

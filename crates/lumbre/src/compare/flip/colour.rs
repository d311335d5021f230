//! The colour spaces of FLIP (Andersson et al. 2020, section 4.1): linear Rec. 709 to the opponent space YCxCz, where
//! contrast sensitivity is filtered, and to Hunt-adjusted L*a*b*, where colours are compared.

/// Linear Rec. 709 to CIE XYZ: the published rationals of the sRGB primaries with D65 white.
const RGB_TO_XYZ: [[f32; 3]; 3] = [
    [10_135_552.0 / 24_577_794.0, 8_788_810.0 / 24_577_794.0, 4_435_075.0 / 24_577_794.0],
    [2_613_072.0 / 12_288_897.0, 8_788_810.0 / 12_288_897.0, 887_015.0 / 12_288_897.0],
    [1_425_312.0 / 73_733_382.0, 8_788_810.0 / 73_733_382.0, 70_074_185.0 / 73_733_382.0],
];

/// The inverse of `RGB_TO_XYZ`.
const XYZ_TO_RGB: [[f32; 3]; 3] = [
    [3.241_003_3, -1.537_398_9, -0.498_615_86],
    [-0.969_224_3, 1.875_930_1, 0.041_554_224],
    [0.055_639_423, -0.204_011_2, 1.057_148_9],
];

/// XYZ of the white (1, 1, 1): the row sums of `RGB_TO_XYZ`.
const WHITE: [f32; 3] = [0.950_428_5, 1.0, 1.088_900_4];

fn transform(m: &[[f32; 3]; 3], v: [f32; 3]) -> [f32; 3] {
    m.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
}

/// XYZ over the white's, so that white is (1, 1, 1).
fn relative_xyz(rgb: [f32; 3]) -> [f32; 3] {
    let xyz = transform(&RGB_TO_XYZ, rgb);
    [xyz[0] / WHITE[0], xyz[1] / WHITE[1], xyz[2] / WHITE[2]]
}

/// L*a*b*'s three differences; YCxCz is the same without the cube root.
fn opponent(f: [f32; 3]) -> [f32; 3] {
    [116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])]
}

/// Linear Rec. 709 to YCxCz: Y in [-16, 100].
pub(super) fn rgb_to_ycxcz(rgb: [f32; 3]) -> [f32; 3] {
    opponent(relative_xyz(rgb))
}

/// The inverse of `rgb_to_ycxcz`.
pub(super) fn ycxcz_to_rgb(c: [f32; 3]) -> [f32; 3] {
    let y = (c[0] + 16.0) / 116.0;
    let x = y + c[1] / 500.0;
    let z = y - c[2] / 200.0;
    transform(&XYZ_TO_RGB, [x * WHITE[0], y * WHITE[1], z * WHITE[2]])
}

/// The Y of YCxCz scaled to [0, 1]: relative luminance, in which features are found.
pub(super) fn unit_luminance(y: f32) -> f32 {
    (y + 16.0) / 116.0
}

/// Linear Rec. 709 to L*a*b* (CIE 1976) with a* and b* scaled by L*/100, since a dim colour looks less colourful (Hunt
/// 1952).
pub(super) fn rgb_to_hunt_lab(rgb: [f32; 3]) -> [f32; 3] {
    const DELTA: f32 = 6.0 / 29.0;
    let f = relative_xyz(rgb)
        .map(|t| if t > DELTA * DELTA * DELTA { t.cbrt() } else { t / (3.0 * DELTA * DELTA) + 4.0 / 29.0 });
    let [l, a, b] = opponent(f);
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// HyAB distance (Abasi et al. 2020): city block in lightness, Euclidean in chroma.
pub(super) fn hyab(p: [f32; 3], q: [f32; 3]) -> f32 {
    let (a, b) = (p[1] - q[1], p[2] - q[2]);
    (p[0] - q[0]).abs() + (a * a + b * b).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn white_and_black_have_no_chroma() {
        for (v, l) in [(0.0, 0.0), (1.0, 100.0)] {
            let lab = rgb_to_hunt_lab([v; 3]);
            assert!((lab[0] - l).abs() < 1e-3 && lab[1].abs() < 1e-3 && lab[2].abs() < 1e-3, "{lab:?}");
            assert!((unit_luminance(rgb_to_ycxcz([v; 3])[0]) - v).abs() < 1e-6);
        }
    }

    #[test]
    fn ycxcz_inverts() {
        for rgb in [[0.0, 0.0, 0.0], [1.0, 0.2, 0.7], [0.01, 0.9, 0.3]] {
            let back = ycxcz_to_rgb(rgb_to_ycxcz(rgb));
            assert!((0..3).all(|c| (back[c] - rgb[c]).abs() < 2e-6), "{rgb:?} {back:?}");
        }
    }

    #[test]
    fn lab_of_the_red_primary() {
        // CIE L*a*b* of sRGB red, D65: (53.24, 80.09, 67.20), known to every colour calculator.
        let [l, a, b] = rgb_to_hunt_lab([1.0, 0.0, 0.0]);
        let scale = 0.01 * l;
        assert!(
            (l - 53.24).abs() < 0.02 && (a / scale - 80.09).abs() < 0.05 && (b / scale - 67.20).abs() < 0.05
        );
    }
}

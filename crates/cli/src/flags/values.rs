//! Values on the command line: text to numbers within bounds, and what to say when it is neither.

use lumbre::core::Rgb;
use lumbre::core::color::{Exposure, srgb_decode_table};
use lumbre::core::film::Crop;
use lumbre::core::math::Vec3;
use lumbre::core::settings::RenderSettings;
use lumbre::output::Look;
use lumbre::scene::Sun;
use lumbre::{Aperture, Focus};
use std::fmt;
use std::path::Path;
use std::time::Duration;

/// Columns and rows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Size(pub(crate) [u32; 2]);

/// Most columns or rows.
pub(crate) const MAX_SIDE: u32 = 32_768;

/// `WxH`.
pub(crate) fn size(text: &str) -> Result<Size, String> {
    let (w, h) = text.split_once(['x', 'X']).ok_or("expected WxH, such as 1280x720")?;
    let side = |s: &str| match s.parse() {
        Ok(n) if (1..=MAX_SIDE).contains(&n) => Ok(n),
        _ => Err(format!("{s:?} is not a number from 1 to {MAX_SIDE}")),
    };
    Ok(Size([side(w)?, side(h)?]))
}

/// `x,y`.
pub(crate) fn pixel(text: &str) -> Result<[u32; 2], String> {
    let part = |s: &str| s.trim().parse().map_err(|_| format!("{s:?} is not a number from 0"));
    let (x, y) = text.split_once(',').ok_or("expected X,Y, such as 310,204")?;
    Ok([part(x)?, part(y)?])
}

/// A finite number.
pub(crate) fn finite(text: &str) -> Result<f32, String> {
    let number = text.trim().parse::<f32>().ok().filter(|v| v.is_finite());
    number.ok_or_else(|| format!("{text:?} is not a number"))
}

/// A finite number above 0.
pub(crate) fn positive(text: &str) -> Result<f32, String> {
    finite(text).and_then(|v| if v > 0.0 { Ok(v) } else { Err(format!("{text} is not above 0")) })
}

/// A number within bounds that make sense.
fn between(text: &str, bounds: std::ops::RangeInclusive<f32>) -> Result<f32, String> {
    let number = positive(text)?;
    let (least, most) = (bounds.start(), bounds.end());
    if bounds.contains(&number) {
        Ok(number)
    } else {
        Err(format!("{text} is not within {least} and {most}"))
    }
}

/// A finite number that is not negative.
pub(crate) fn not_negative(text: &str) -> Result<f32, String> {
    finite(text).and_then(|v| if v >= 0.0 { Ok(v) } else { Err(format!("{text} is negative")) })
}

fn numbers(text: &str) -> Result<Vec<f32>, String> {
    text.split(',').map(finite).collect()
}

/// Numbers as they stand on the command line.
pub(crate) fn joined(numbers: &[f32]) -> String {
    let words: Vec<String> = numbers.iter().map(f32::to_string).collect();
    words.join(",")
}

/// The name of a file without its folders, which tell of the machine and not of the picture.
pub(crate) fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// `x,y,z`.
pub(crate) fn vec3(text: &str) -> Result<Vec3, String> {
    match numbers(text)?[..] {
        [x, y, z] => Ok(Vec3::new(x, y, z)),
        _ => Err("expected three numbers X,Y,Z".into()),
    }
}

/// Vertical field of view, degrees.
pub(crate) fn fov(text: &str) -> Result<f32, String> {
    let degrees = finite(text)?;
    // Beyond this the tangent of half of it is no use any more.
    if (0.001..=179.9).contains(&degrees) {
        Ok(degrees)
    } else {
        Err("the field of view lies between 0 and 180 degrees".into())
    }
}

/// `f/N` or a diameter in metres.
pub(crate) fn aperture(text: &str) -> Result<Aperture, String> {
    match text.trim().strip_prefix(['f', 'F']).and_then(|t| t.strip_prefix('/')) {
        Some(number) => between(number, 1e-3..=1e6).map(Aperture::FNumber),
        None => between(text, 1e-6..=1e3)
            .map(Aperture::Diameter)
            .map_err(|e| format!("{e}; expected f/N, such as f/2.8, or the diameter of the lens in metres")),
    }
}

/// `auto` or a distance in metres.
pub(crate) fn focus(text: &str) -> Result<Focus, String> {
    match text {
        "auto" => Ok(Focus::Auto),
        _ => between(text, 1e-4..=1e9)
            .map(Focus::Distance)
            .map_err(|e| format!("{e}; expected `auto` or metres")),
    }
}

/// `X,Y,W,H`.
pub(crate) fn crop(text: &str) -> Result<Crop, String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
    match numbers.as_deref() {
        Ok(&[x, y, w, h]) if w > 0 && h > 0 => Ok(Crop { origin: [x, y], size: [w, h] }),
        _ => Err("expected X,Y,W,H in pixels, such as 320,180,640,360".into()),
    }
}

/// `--max-depth`; `None`: unlimited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Depth(pub(crate) Option<u32>);

impl fmt::Display for Depth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            None => f.write_str("unlimited"),
            Some(n) => n.fmt(f),
        }
    }
}

/// `N|unlimited`.
pub(crate) fn depth(text: &str) -> Result<Depth, String> {
    let bound = RenderSettings::DEPTH_BOUND;
    match (text, text.parse()) {
        ("unlimited", _) => Ok(Depth(None)),
        (_, Ok(n)) if n <= bound => Ok(Depth(Some(n))),
        _ => Err(format!("expected `unlimited` or a number up to {bound}")),
    }
}

/// `--roulette`; `None`: off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Roulette(pub(crate) Option<u32>);

impl fmt::Display for Roulette {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            None => f.write_str("off"),
            Some(n) => n.fmt(f),
        }
    }
}

/// `N|off`.
pub(crate) fn roulette(text: &str) -> Result<Roulette, String> {
    match (text, text.parse()) {
        ("off", _) => Ok(Roulette(None)),
        (_, Ok(n)) => Ok(Roulette(Some(n))),
        _ => Err("expected `off` or a number from 0".into()),
    }
}

/// `--exposure`.
pub(crate) fn exposure(text: &str) -> Result<Exposure, String> {
    match text {
        "auto" => Ok(Exposure::Auto),
        "thesis" => Ok(Exposure::Thesis),
        // Beyond this the factor is no finite number.
        _ => match text.trim().parse::<f32>() {
            Ok(ev) if ev.abs() <= 100.0 => Ok(Exposure::Ev(ev)),
            _ => Err("expected `auto`, `thesis` or stops from -100 to 100".into()),
        },
    }
}

/// `--vignette`.
pub(crate) fn vignette(text: &str) -> Result<f32, String> {
    finite(text).and_then(|v| if (0.0..=1.0).contains(&v) { Ok(v) } else { Err("expected 0 to 1".into()) })
}

/// `--aberration`, per cent.
pub(crate) fn aberration(text: &str) -> Result<f32, String> {
    let most = Look::MAX_ABERRATION;
    let in_range =
        |v: f32| if v.abs() <= most { Ok(v) } else { Err(format!("expected -{most} to {most} per cent")) };
    finite(text).and_then(in_range)
}

/// `--sky`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Sky {
    Color(Rgb),
    Gradient,
    Off,
}

impl fmt::Display for Sky {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Sky::Color(c) => f.write_str(&joined(&c.to_array())),
            Sky::Gradient => f.write_str("gradient"),
            Sky::Off => f.write_str("off"),
        }
    }
}

/// `R,G,B|#rrggbb|gradient|off`.
pub(crate) fn sky(text: &str) -> Result<Sky, String> {
    match text {
        "gradient" => Ok(Sky::Gradient),
        "off" => Ok(Sky::Off),
        _ => color(text).map(Sky::Color),
    }
}

fn color(text: &str) -> Result<Rgb, String> {
    let wrong = || "expected `gradient`, `off`, R,G,B (linear, none negative) or #rrggbb (sRGB)".to_string();
    if let Some(hex) = text.strip_prefix('#') {
        let digits = hex.len() == 6 && hex.bytes().all(|b| b.is_ascii_hexdigit());
        let code = u32::from_str_radix(hex, 16).ok().filter(|_| digits).ok_or_else(wrong)?;
        let channel = |shift: u32| srgb_decode_table()[(code >> shift) as usize & 255];
        return Ok(Rgb::new(channel(16), channel(8), channel(0)));
    }
    match numbers(text).map_err(|_| wrong())?[..] {
        [r, g, b] if r >= 0.0 && g >= 0.0 && b >= 0.0 => Ok(Rgb::new(r, g, b)),
        _ => Err(wrong()),
    }
}

/// `--sun`: degrees and lux.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SunFlag {
    pub(crate) elevation_deg: f32,
    pub(crate) azimuth_deg: f32,
    pub(crate) strength: f32,
}

impl fmt::Display for SunFlag {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&joined(&[self.elevation_deg, self.azimuth_deg, self.strength]))
    }
}

/// `ELEV,AZIM[,STRENGTH]`.
pub(crate) fn sun(text: &str) -> Result<SunFlag, String> {
    let (elevation_deg, azimuth_deg, strength) = match numbers(text)?[..] {
        [e, a] => (e, a, Sun::STRENGTH),
        [e, a, s] => (e, a, s),
        _ => return Err("expected ELEV,AZIM or ELEV,AZIM,STRENGTH".into()),
    };
    if !(-90.0..=90.0).contains(&elevation_deg) {
        return Err("the elevation lies between -90 and 90 degrees".into());
    }
    if strength < 0.0 {
        return Err("the strength is negative".into());
    }
    Ok(SunFlag { elevation_deg, azimuth_deg, strength })
}

/// A number of bytes, with K, M, G or T for powers of 1024.
pub(crate) fn bytes(text: &str) -> Result<u64, String> {
    let number = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let shift = match text[number.len()..].to_ascii_uppercase().as_str() {
        "" | "B" => Some(0),
        "K" | "KB" | "KIB" => Some(10),
        "M" | "MB" | "MIB" => Some(20),
        "G" | "GB" | "GIB" => Some(30),
        "T" | "TB" | "TIB" => Some(40),
        _ => None,
    };
    let count = number.parse::<u64>().ok().zip(shift).and_then(|(n, shift)| n.checked_mul(1 << shift));
    count.ok_or_else(|| format!("{text:?} is not a size such as 800M or 16G"))
}

/// A length of time, such as `30s`, `1.5min` or `1h30min`: numbers with units, added up.
pub(crate) fn duration(text: &str) -> Result<Duration, String> {
    let wrong = || format!("{text:?} is not a time such as 30s, 500ms, 1.5min or 1h30min");
    let (mut rest, mut seconds) = (text.trim(), 0.0);
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.').ok_or_else(wrong)?;
        let (number, unit) = rest.split_at(digits);
        let letters = unit.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(unit.len());
        let (unit, after) = unit.split_at(letters);
        let one = match unit {
            "ms" => 1e-3,
            "s" => 1.0,
            "min" | "m" => 60.0,
            "h" => 3600.0,
            _ => return Err(wrong()),
        };
        seconds += number.parse::<f64>().map_err(|_| wrong())? * one;
        rest = after;
    }
    // Beyond a century it is a mistake.
    if seconds > 0.0 && seconds < 3.2e9 { Ok(Duration::from_secs_f64(seconds)) } else { Err(wrong()) }
}

/// An error that a picture may have: above 0.
pub(crate) fn error(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|v| v.is_finite() && *v > 0.0);
    number.ok_or_else(|| format!("{text:?} is not a number above 0, such as 0.005"))
}

/// A number of things.
pub(crate) fn count(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("{text:?} is not a number from 0"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_pixels_are_bounded() {
        assert_eq!(size("1280x720"), Ok(Size([1280, 720])));
        for wrong in ["", "12", "0x5", "5x0", "-1x5", "32769x1", "1x99999999999", "1x2x3", "ax2"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
        assert_eq!(pixel("3,4"), Ok([3, 4]));
        assert!(pixel("-3,4").is_err() && pixel("3").is_err());
    }

    #[test]
    fn vectors_may_be_negative_but_are_numbers() {
        assert_eq!(vec3("-1,2.5,3e2"), Ok(Vec3::new(-1.0, 2.5, 300.0)));
        for wrong in ["1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "a,b,c", ""] {
            assert!(vec3(wrong).is_err(), "{wrong}");
        }
        assert!(fov("0").is_err() && fov("180").is_err() && fov("45") == Ok(45.0));
    }

    #[test]
    fn limits_have_words() {
        assert_eq!(depth("unlimited"), Ok(Depth(None)));
        assert_eq!(depth("0"), Ok(Depth(Some(0))));
        assert!(depth("70000").is_err() && depth("off").is_err() && depth("-1").is_err());
        assert_eq!(roulette("off"), Ok(Roulette(None)));
        assert_eq!(roulette("3"), Ok(Roulette(Some(3))));
        assert!(roulette("unlimited").is_err());
        assert_eq!(Depth(None).to_string() + &Roulette(Some(3)).to_string(), "unlimited3");
    }

    #[test]
    fn colours_are_linear_or_srgb() {
        assert_eq!(sky("0.5,1,2"), Ok(Sky::Color(Rgb::new(0.5, 1.0, 2.0))));
        let Ok(Sky::Color(c)) = sky("#ff8000") else { panic!() };
        assert!(c.r == 1.0 && (c.g - 0.2159).abs() < 1e-4 && c.b == 0.0);
        for wrong in ["#ff80", "#ff80001", "#gg0000", "#+f0000", "-1,0,0", "1,2", "blue"] {
            assert!(sky(wrong).is_err(), "{wrong}");
        }
        assert_eq!((sky("gradient"), sky("off")), (Ok(Sky::Gradient), Ok(Sky::Off)));
    }

    #[test]
    fn the_sun_has_a_place_and_a_strength() {
        let s = sun("-5,200").unwrap();
        assert_eq!((s.elevation_deg, s.azimuth_deg, s.strength), (-5.0, 200.0, Sun::STRENGTH));
        assert_eq!(sun("45,-30,100").unwrap().strength, 100.0);
        for wrong in ["91,0", "45", "45,0,-1", "45,0,1,2"] {
            assert!(sun(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn times_have_units_and_errors_are_positive() {
        let ms = |t: &str| duration(t).map(|d| d.as_millis()).map_err(drop);
        assert_eq!(
            ["250ms", "30s", "1.5min", "2m", "1h"].map(ms),
            [250, 30_000, 90_000, 120_000, 3_600_000].map(Ok)
        );
        assert_eq!(ms("1h30min"), Ok(5_400_000));
        for wrong in ["", "30", "s", "-1s", "1d", "1s2", "1.2.3s", "0s", "1e99s", "99999999h", "3 s", "nans"]
        {
            assert!(duration(wrong).is_err(), "{wrong}");
        }
        assert_eq!(error("5e-3"), Ok(0.005));
        assert!(["0", "-1", "nan", "inf", "x"].into_iter().all(|t| error(t).is_err()));
    }

    #[test]
    fn lenses_have_bounds() {
        assert_eq!((vignette("0.5"), vignette("1")), (Ok(0.5), Ok(1.0)));
        assert_eq!((aberration("-50"), aberration("1.5")), (Ok(-50.0), Ok(1.5)));
        assert!(vignette("1.1").is_err() && vignette("-0.1").is_err() && vignette("nan").is_err());
        assert!(aberration("51").is_err() && aberration("inf").is_err());
    }

    #[test]
    fn exposures_and_sizes_of_memory() {
        assert_eq!(exposure("-1.5"), Ok(Exposure::Ev(-1.5)));
        assert_eq!((exposure("auto"), exposure("thesis")), (Ok(Exposure::Auto), Ok(Exposure::Thesis)));
        assert!(exposure("nan").is_err() && exposure("1000").is_err());
        assert_eq!((bytes("7"), bytes("2k"), bytes("3GiB")), (Ok(7), Ok(2048), Ok(3 << 30)));
        for wrong in ["", "x", "-1", "1.5G", "99999999999T", "5 apples"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }
}

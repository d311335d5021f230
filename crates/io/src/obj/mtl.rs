//! MTL, the materials of OBJ (Wavefront Technologies 1995), with the keys for physically based shading that many programs add.
//! Only reads what is written; what it means is for `material.rs`.

use super::map::{self, Map};
use super::text::{Lines, Words, name, number, shown, split_word};
use lumbre_core::Rgb;

/// Materials of one library. A file of a few bytes for each would fill the memory with them.
const MOST_MATERIALS: usize = 1 << 16;

/// A material as a library writes it. What is not written is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Mtl {
    pub(super) name: String,
    /// Line of its `newmtl`.
    pub(super) line: usize,
    pub(super) kd: Option<Rgb>,
    pub(super) ks: Option<Rgb>,
    pub(super) ke: Option<Rgb>,
    pub(super) tf: Option<Rgb>,
    pub(super) ns: Option<f32>,
    pub(super) ni: Option<f32>,
    pub(super) d: Option<f32>,
    pub(super) tr: Option<f32>,
    pub(super) illum: Option<i32>,
    pub(super) pr: Option<f32>,
    pub(super) pm: Option<f32>,
    pub(super) ps: Option<f32>,
    pub(super) pc: Option<f32>,
    pub(super) pcr: Option<f32>,
    pub(super) aniso: Option<f32>,
    pub(super) anisor: Option<f32>,
    pub(super) map_kd: Option<Map>,
    pub(super) map_ks: Option<Map>,
    pub(super) map_ke: Option<Map>,
    pub(super) map_d: Option<Map>,
    pub(super) map_pr: Option<Map>,
    pub(super) map_pm: Option<Map>,
    pub(super) bump: Option<Map>,
    pub(super) norm: Option<Map>,
}

impl Mtl {
    /// All pictures it names.
    pub(super) fn maps(&self) -> impl Iterator<Item = &Map> {
        let color = [&self.map_kd, &self.map_ks, &self.map_ke, &self.map_d];
        let others = [&self.map_pr, &self.map_pm, &self.bump, &self.norm];
        color.into_iter().chain(others).flatten()
    }

    /// The places of all of them.
    pub(super) fn maps_mut(&mut self) -> [&mut Option<Map>; 8] {
        let Mtl { map_kd, map_ks, map_ke, map_d, map_pr, map_pm, bump, norm, .. } = self;
        [map_kd, map_ks, map_ke, map_d, map_pr, map_pm, bump, norm]
    }
}

/// Reads a library. Lines that cannot be read are told to `odd` with their number and left out: a wrong material must not
/// keep a mesh from being drawn.
pub(super) fn parse(text: &[u8], mut odd: impl FnMut(usize, String)) -> Vec<Mtl> {
    let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
    let mut out: Vec<Mtl> = Vec::new();
    let mut lines = Lines::new(text);
    while let Some((line, content)) = lines.next() {
        let (key, rest) = split_word(&content);
        if key.is_empty() || key[0] == b'#' {
            continue;
        }
        if key.eq_ignore_ascii_case(b"newmtl") {
            if out.len() == MOST_MATERIALS {
                odd(line, format!("materials after the first {MOST_MATERIALS} are not read"));
                break;
            }
            out.push(Mtl { name: name(rest), line, ..Mtl::default() });
            continue;
        }
        let Some(current) = out.last_mut() else {
            odd(line, format!("the statement {} stands before any material", shown(key)));
            continue;
        };
        if let Err(why) = statement(current, key, rest, line, &mut |why| odd(line, why)) {
            odd(line, why);
        }
    }
    out
}

/// Keys in small letters: programs disagree on `map_Bump`, `map_bump` and `Tf`.
fn statement(
    m: &mut Mtl,
    key: &[u8],
    rest: &[u8],
    line: usize,
    odd: &mut dyn FnMut(String),
) -> Result<(), String> {
    let mut map = |slot: &mut Option<Map>| -> Result<(), String> {
        *slot = Some(map::parse(rest, line, &mut *odd)?);
        Ok(())
    };
    match key.to_ascii_lowercase().as_slice() {
        b"kd" => m.kd = Some(color(rest)?),
        b"ks" => m.ks = Some(color(rest)?),
        b"ke" => m.ke = Some(color(rest)?),
        b"tf" => m.tf = Some(color(rest)?),
        b"ns" => m.ns = Some(value(rest)?),
        b"ni" => m.ni = Some(value(rest)?),
        b"d" => m.d = Some(value(without_halo(rest))?),
        b"tr" => m.tr = Some(value(rest)?),
        b"illum" => m.illum = Some(value(rest)? as i32),
        b"pr" => m.pr = Some(value(rest)?),
        b"pm" => m.pm = Some(value(rest)?),
        b"ps" => m.ps = Some(value(rest)?),
        b"pc" => m.pc = Some(value(rest)?),
        b"pcr" => m.pcr = Some(value(rest)?),
        b"aniso" => m.aniso = Some(value(rest)?),
        b"anisor" => m.anisor = Some(value(rest)?),
        b"map_kd" => map(&mut m.map_kd)?,
        b"map_ks" => map(&mut m.map_ks)?,
        b"map_ke" => map(&mut m.map_ke)?,
        b"map_d" => map(&mut m.map_d)?,
        b"map_pr" => map(&mut m.map_pr)?,
        b"map_pm" => map(&mut m.map_pm)?,
        b"map_bump" | b"bump" => map(&mut m.bump)?,
        b"norm" | b"map_norm" | b"map_kn" => map(&mut m.norm)?,
        // Ambient light is what a path tracer computes; sharpness is that of reflection maps.
        b"ka" | b"map_ka" | b"sharpness" | b"map_aat" => {}
        _ => odd(format!("the statement {} is not supported and is skipped", shown(key))),
    }
    Ok(())
}

/// `r g b`, or one number for all three. Other ways to write a colour are named in the error.
fn color(rest: &[u8]) -> Result<Rgb, String> {
    let mut words = Words(rest);
    let first = words.next().ok_or("has no colour")?;
    if first == b"xyz" || first == b"spectral" {
        return Err(format!("colours as {} are not supported", shown(first)));
    }
    let r = finite(first)?;
    let g = words.next().map_or(Ok(r), finite)?;
    let b = words.next().map_or(Ok(g), finite)?;
    Ok(Rgb::new(r, g, b))
}

fn value(rest: &[u8]) -> Result<f32, String> {
    finite(Words(rest).next().ok_or("has no value")?)
}

fn finite(word: &[u8]) -> Result<f32, String> {
    let value = number(word)?;
    if value.is_finite() { Ok(value) } else { Err(format!("{} is no finite number", shown(word))) }
}

/// `d -halo 0.5` lets the middle of a thing through more than its edge; here all of it alike.
fn without_halo(rest: &[u8]) -> &[u8] {
    let (word, after) = split_word(rest);
    if word == b"-halo" { after } else { rest }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_are_read_and_what_is_odd_is_told() {
        let text = "Kd 1 1 1\nnewmtl  old wood #2 \n  Kd 0.1 0.2 .3 # brown\r\n\tKs 0.5\nNs 32\nillum 2\n\
            d -halo 0.25\nTr 0.5\nmap_kd -s 2 2 2 wood 2.png\nNi x\nKe xyz 1 2 3\nfoo 1\nNs\nPr nan\n\
            newmtl next\nPm 1\nbump a.png\n";
        let mut odd = Vec::new();
        let list = parse(text.as_bytes(), |line, why| odd.push(format!("{line}: {why}")));
        assert_eq!(list.len(), 2);
        let m = &list[0];
        assert_eq!((m.name.as_str(), m.line), ("old wood #2", 2));
        assert_eq!(m.kd, Some(Rgb::new(0.1, 0.2, 0.3)));
        assert_eq!(m.ks, Some(Rgb::splat(0.5)));
        assert_eq!((m.ns, m.illum, m.d, m.tr), (Some(32.0), Some(2), Some(0.25), Some(0.5)));
        assert_eq!(m.map_kd.as_ref().unwrap().name, "wood 2.png");
        assert_eq!((m.ni, m.ke, m.pr), (None, None, None));
        assert_eq!((list[1].name.as_str(), list[1].pm, list[1].maps().count()), ("next", Some(1.0), 1));
        assert_eq!(
            odd,
            [
                "1: the statement \"Kd\" stands before any material",
                "10: \"x\" is no number",
                "11: colours as \"xyz\" are not supported",
                "12: the statement \"foo\" is not supported and is skipped",
                "13: has no value",
                "14: \"nan\" is no finite number",
            ]
        );
    }

    #[test]
    fn a_flood_of_materials_ends() {
        let mut odd = 0;
        assert_eq!(parse(&b"newmtl a\n".repeat(70_000), |_, _| odd += 1).len(), MOST_MATERIALS);
        assert_eq!(odd, 1);
    }
}

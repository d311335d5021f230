//! Textures, and how they are looked up on the CPU.

use super::CompiledScene;
use super::material::TextureUse;
use bytemuck::{Pod, Zeroable};
use lumbre_core::Rgb;
use lumbre_core::color::srgb_decode_table;

/// Values of [`TextureRecord::wrap_s`] and `wrap_t`.
pub mod wrap {
    /// The image again.
    pub const REPEAT: u32 = 0;
    /// Mirrored.
    pub const MIRRORED_REPEAT: u32 = 1;
    /// The edge texel.
    pub const CLAMP_TO_EDGE: u32 = 2;
}

/// A texture: a range of texels and how to read it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub struct TextureRecord {
    /// First of `texels`.
    pub first_texel: u32,
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Along u: one of [`wrap`].
    pub wrap_s: u32,
    /// Along v: one of [`wrap`].
    pub wrap_t: u32,
    /// 1: the nearest texel; 0: bilinear.
    pub nearest: u32,
}

/// Four channels, linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rgba {
    /// Colour.
    pub rgb: Rgb,
    /// Alpha.
    pub a: f32,
}

/// How the colour of a texel is coded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// R, G, B by the sRGB curve; alpha linear.
    Srgb,
    /// All linear.
    Linear,
}

/// The texel index for one that lies at most a texel outside the range that [`reduced`] leaves.
#[inline]
fn wrapped(i: i32, n: i32, mode: u32) -> i32 {
    let turn = |i: i32, n: i32| {
        if i < 0 {
            i + n
        } else if i >= n {
            i - n
        } else {
            i
        }
    };
    match mode {
        wrap::CLAMP_TO_EDGE => i.clamp(0, n - 1),
        wrap::MIRRORED_REPEAT => {
            let m = turn(i, 2 * n);
            if m < n { m } else { 2 * n - 1 - m }
        }
        _ => turn(i, n),
    }
}

/// A coordinate within one period of its wrap mode, so that large ones keep their fraction: [0, 1], or [0, 2] mirrored. What is not
/// finite becomes 0.
#[inline]
fn reduced(x: f32, mode: u32) -> f32 {
    let x = match mode {
        wrap::CLAMP_TO_EDGE => x.clamp(-1.0, 2.0),
        wrap::MIRRORED_REPEAT => x - 2.0 * (0.5 * x).floor(),
        _ => x - x.floor(),
    };
    if x.is_finite() { x } else { 0.0 }
}

/// Floor of a small number, without a call where the processor has no instruction for it.
#[inline]
fn floor(x: f32) -> i32 {
    let i = x as i32;
    i - i32::from((i as f32) > x)
}

impl CompiledScene {
    /// The value of a texture at texture coordinates, v down; bilinear between texel centres, decoded before filtering.
    /// White where there is none.
    #[inline]
    pub fn texture(&self, texture: &TextureUse, uv: &[[f32; 2]; 2], encoding: Encoding) -> Rgba {
        if texture.is_none() {
            return Rgba { rgb: Rgb::WHITE, a: 1.0 };
        }
        self.lookup(&self.textures[texture.texture as usize], texture.uv(uv), encoding)
    }

    fn lookup(&self, t: &TextureRecord, [u, v]: [f32; 2], encoding: Encoding) -> Rgba {
        let (w, h) = (t.width as i32, t.height as i32);
        let texel = |x: i32, y: i32| {
            let at = wrapped(y, h, t.wrap_t) * w + wrapped(x, w, t.wrap_s);
            decode(self.texels[t.first_texel as usize + at as usize], encoding)
        };
        let (x, y) = (reduced(u, t.wrap_s) * w as f32, reduced(v, t.wrap_t) * h as f32);
        if t.nearest == 1 {
            return texel(floor(x), floor(y));
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j) = (floor(x), floor(y));
        let (fx, fy) = (x - i as f32, y - j as f32);
        let mix = |p: Rgba, q: Rgba, t: f32| Rgba { rgb: p.rgb.lerp(q.rgb, t), a: p.a + (q.a - p.a) * t };
        let top = mix(texel(i, j), texel(i + 1, j), fx);
        let bottom = mix(texel(i, j + 1), texel(i + 1, j + 1), fx);
        mix(top, bottom, fy)
    }
}

#[inline]
fn decode(texel: u32, encoding: Encoding) -> Rgba {
    let [r, g, b, a] = texel.to_le_bytes();
    let linear = |v: u8| f32::from(v) * (1.0 / 255.0);
    let rgb = match encoding {
        Encoding::Srgb => {
            let table = srgb_decode_table();
            Rgb::new(table[r as usize], table[g as usize], table[b as usize])
        }
        Encoding::Linear => Rgb::new(linear(r), linear(g), linear(b)),
    };
    Rgba { rgb, a: linear(a) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(wrap: u32, nearest: u32) -> CompiledScene {
        let texels = vec![0xff00_00ff, 0x8000_ff00, 0xff00_0000, 0xffff_ffff];
        let record =
            TextureRecord { first_texel: 0, width: 2, height: 2, wrap_s: wrap, wrap_t: wrap, nearest };
        CompiledScene { texels: texels.into(), textures: vec![record], ..CompiledScene::default() }
    }

    fn at(s: &CompiledScene, u: f32, v: f32) -> Rgba {
        let used = TextureUse { texture: 0, ..TextureUse::default() };
        s.texture(&used, &[[u, v], [0.0; 2]], Encoding::Linear)
    }

    #[test]
    fn texels_lie_where_gltf_says() {
        let s = scene(wrap::REPEAT, 1);
        assert_eq!(at(&s, 0.25, 0.25).rgb, Rgb::new(1.0, 0.0, 0.0));
        assert_eq!(at(&s, 0.75, 0.25).rgb, Rgb::new(0.0, 1.0, 0.0));
        assert_eq!(at(&s, 0.25, 0.75).rgb, Rgb::BLACK);
        assert_eq!(at(&s, 1000.75, -7.25).rgb, Rgb::WHITE);
    }

    #[test]
    fn wrapping_and_filtering() {
        let centre = at(&scene(wrap::REPEAT, 0), 0.5, 0.5);
        assert_eq!(centre.rgb, Rgb::new(0.5, 0.5, 0.25));
        assert_eq!(at(&scene(wrap::CLAMP_TO_EDGE, 0), -3.0, -3.0).rgb, Rgb::new(1.0, 0.0, 0.0));
        assert_eq!(at(&scene(wrap::MIRRORED_REPEAT, 1), -0.25, 0.25).rgb, Rgb::new(1.0, 0.0, 0.0));
        assert_eq!(at(&scene(wrap::REPEAT, 1), -0.25, 0.25).rgb, Rgb::new(0.0, 1.0, 0.0));
        for mode in [wrap::REPEAT, wrap::MIRRORED_REPEAT, wrap::CLAMP_TO_EDGE] {
            for u in [f32::NAN, f32::INFINITY, -1e30, 1e30, -1e-9, 1.0, 0.999_999_94, 2.0, -0.0] {
                for nearest in [0, 1] {
                    assert!(at(&scene(mode, nearest), u, u).rgb.is_finite(), "{mode} {u}");
                }
            }
        }
    }
}

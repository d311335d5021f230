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

#[inline]
fn wrapped(i: i32, n: i32, mode: u32) -> i32 {
    match mode {
        wrap::CLAMP_TO_EDGE => i.clamp(0, n - 1),
        wrap::MIRRORED_REPEAT => {
            let m = i.rem_euclid(2 * n);
            if m < n { m } else { 2 * n - 1 - m }
        }
        _ => i.rem_euclid(n),
    }
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
        // Reduced first, so that large coordinates keep their fraction; NaN becomes 0.
        let reduce = |x: f32, mode: u32| match mode {
            wrap::CLAMP_TO_EDGE => x.clamp(-1.0, 2.0),
            _ => x - 2.0 * (0.5 * x).floor(),
        };
        let (x, y) = (reduce(u, t.wrap_s) * w as f32, reduce(v, t.wrap_t) * h as f32);
        if t.nearest == 1 {
            return texel(x.floor() as i32, y.floor() as i32);
        }
        let (x, y) = (x - 0.5, y - 0.5);
        let (i, j) = (x.floor() as i32, y.floor() as i32);
        let (fx, fy) = (x - x.floor(), y - y.floor());
        let mix = |p: Rgba, q: Rgba, t: f32| Rgba { rgb: p.rgb.lerp(q.rgb, t), a: p.a + (q.a - p.a) * t };
        let top = mix(texel(i, j), texel(i + 1, j), fx);
        let bottom = mix(texel(i, j + 1), texel(i + 1, j + 1), fx);
        let out = mix(top, bottom, fy);
        if out.rgb.r.is_nan() { texel(0, 0) } else { out }
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
        CompiledScene { texels, textures: vec![record], ..CompiledScene::default() }
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
        assert!(at(&scene(wrap::REPEAT, 0), f32::NAN, f32::INFINITY).rgb.is_finite());
    }
}

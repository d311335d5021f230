//! Images to texels, textures to records.

use super::{CompileError, Earlier, check, index32};
use crate::compiled::CompiledScene;
use crate::compiled::texture::{TextureRecord, wrap};
use crate::{Filter, Image, Scene, Wrap};
use std::sync::Arc;

pub(super) fn compile(
    scene: &Scene,
    earlier: Option<&Earlier<'_>>,
    out: &mut CompiledScene,
) -> Result<(), CompileError> {
    let first_texels = places(scene)?;
    out.texels = match earlier {
        Some(earlier) => earlier.compiled.texels.clone(),
        None => texels(&scene.images),
    };
    for (i, t) in scene.textures.iter().enumerate() {
        check(Some(t.image.0), scene.images.len(), "image", || format!("/textures/{i}"))?;
        let image = &scene.images[t.image.index()];
        out.textures.push(TextureRecord {
            first_texel: first_texels[t.image.index()],
            width: image.width,
            height: image.height,
            wrap_s: wrap_code(t.wrap_s),
            wrap_t: wrap_code(t.wrap_t),
            nearest: u32::from(t.filter == Filter::Nearest),
        });
    }
    Ok(())
}

/// The first texel of each image, once their sizes are found to be right.
fn places(scene: &Scene) -> Result<Vec<u32>, CompileError> {
    let mut first_texels = Vec::with_capacity(scene.images.len());
    let mut texels = 0;
    for (i, image) in scene.images.iter().enumerate() {
        let count = image.width as usize * image.height as usize;
        if count == 0 || image.rgba8.len() != 4 * count {
            return Err(CompileError::Invalid {
                place: format!("/images/{i}"),
                message: format!(
                    "{}x{} texels need {} bytes, there are {}",
                    image.width,
                    image.height,
                    4 * count,
                    image.rgba8.len()
                ),
            });
        }
        first_texels.push(index32(texels, "texels")?);
        texels += count;
    }
    index32(texels, "texels")?;
    Ok(first_texels)
}

/// The texels of all images, one after another.
fn texels(images: &[Image]) -> Arc<[u32]> {
    let count = images.iter().map(|i| i.rgba8.len() / 4).sum();
    // Written in place: a copy from a vector would take the memory of all texels once more.
    let mut texels: Arc<[u32]> = std::iter::repeat_n(0, count).collect();
    let mut rest = Arc::get_mut(&mut texels).expect("nobody shares it yet");
    for image in images {
        let (own, others) = rest.split_at_mut(image.rgba8.len() / 4);
        for (texel, c) in own.iter_mut().zip(image.rgba8.chunks_exact(4)) {
            *texel = u32::from_le_bytes([c[0], c[1], c[2], c[3]]);
        }
        rest = others;
    }
    texels
}

fn wrap_code(w: Wrap) -> u32 {
    match w {
        Wrap::Repeat => wrap::REPEAT,
        Wrap::MirroredRepeat => wrap::MIRRORED_REPEAT,
        Wrap::ClampToEdge => wrap::CLAMP_TO_EDGE,
    }
}

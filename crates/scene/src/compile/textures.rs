//! Images to texels, textures to records.

use super::{CompileError, check, index32};
use crate::compiled::CompiledScene;
use crate::compiled::texture::{TextureRecord, wrap};
use crate::{Filter, Scene, Wrap};

pub(super) fn compile(scene: &Scene, out: &mut CompiledScene) -> Result<(), CompileError> {
    let mut first_texels = Vec::with_capacity(scene.images.len());
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
        first_texels.push(index32(out.texels.len(), "texels")?);
        out.texels.extend(image.rgba8.chunks_exact(4).map(|c| u32::from_le_bytes([c[0], c[1], c[2], c[3]])));
    }
    index32(out.texels.len(), "texels")?;
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

fn wrap_code(w: Wrap) -> u32 {
    match w {
        Wrap::Repeat => wrap::REPEAT,
        Wrap::MirroredRepeat => wrap::MIRRORED_REPEAT,
        Wrap::ClampToEdge => wrap::CLAMP_TO_EDGE,
    }
}

//! Kinds of images: each is read by its first bytes and gives the texels that its own encoder meant. The KTX2 files in
//! `data` were made with Basis Universal 2.1; the PNG beside each is what its own decoder makes of it.

use crate::common::{Gltf, png};
use image::{ExtendedColorType, ImageFormat};
use lumbre_io::{IoError, Limits, LoadOptions, load_scene, read_linear_image};
use serde_json::json;

const W: u32 = 14;
const H: u32 = 10;

/// Columns, rows, texels.
type Texels = (u32, u32, Vec<u8>);

/// A scene whose material shows these images, each as the texture of the extension that names it, or as `source`.
fn scene(images: &[(&str, &[u8])]) -> Gltf {
    let mut g = Gltf::triangle();
    let uv = g.f32s("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    g.primitive()["attributes"]["TEXCOORD_0"] = json!(uv);
    images.iter().for_each(|(_, bytes)| g.image("image/any", bytes));
    let mut texture = json!({});
    for (i, (extension, _)) in images.iter().enumerate() {
        match *extension {
            "" => texture["source"] = json!(i),
            name => texture["extensions"][name] = json!({"source": i}),
        }
    }
    g.doc["textures"] = json!([texture]);
    g.material(json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}))
}

/// What a scene makes of an image's bytes.
fn read(bytes: &[u8]) -> Result<Texels, IoError> {
    let image = scene(&[("", bytes)]).load()?.scene.images[0].clone();
    Ok((image.width, image.height, image.rgba8))
}

fn data(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/tests/io/data/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// Texels that all differ, with alpha.
fn picture(channels: usize) -> Vec<u8> {
    (0..W * H)
        .flat_map(|i| [i as u8, (i * 7) as u8, 255 - i as u8, 40 + i as u8].into_iter().take(channels))
        .collect()
}

fn rgba(channels: usize) -> Vec<u8> {
    let full = |t: &[u8]| [t[0], t[1], t[2], t.get(3).copied().unwrap_or(255)];
    picture(channels).chunks_exact(channels).flat_map(full).collect()
}

fn encoded(format: ImageFormat, channels: usize) -> Vec<u8> {
    let color = if channels == 4 { ExtendedColorType::Rgba8 } else { ExtendedColorType::Rgb8 };
    let mut out = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut out, &picture(channels), W, H, color, format).unwrap();
    out.into_inner()
}

/// A KTX2 of one level; `descriptor` describes its format.
fn ktx2(format: u32, scheme: u32, descriptor: &[u8], level: &[u8], inflated: usize) -> Vec<u8> {
    let mut out = b"\xabKTX 20\xbb\r\n\x1a\n".to_vec();
    let words = [format, 1, W, H, 0, 0, 1, 1, scheme, 104, descriptor.len() as u32, 0, 0, 0, 0, 0, 0];
    words.iter().for_each(|w| out.extend(w.to_le_bytes()));
    let start = (104 + descriptor.len()).next_multiple_of(16);
    [start, level.len(), inflated].iter().for_each(|&n| out.extend((n as u64).to_le_bytes()));
    out.extend(descriptor);
    out.resize(start, 0);
    out.extend(level);
    out
}

fn u32_at(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

/// The descriptor of a KTX2, and its first level.
fn parts(file: &[u8]) -> (&[u8], &[u8]) {
    let (at, length) = (u32_at(file, 48), u32_at(file, 52));
    let (level, bytes) = (u32_at(file, 80), u32_at(file, 88));
    (&file[at..at + length], &file[level..level + bytes])
}

fn zlib(bytes: &[u8]) -> Vec<u8> {
    miniz_oxide::deflate::compress_to_vec_zlib(bytes, 6)
}

/// The blocks of a UASTC file, and its descriptor.
fn uastc() -> (Vec<u8>, Vec<u8>) {
    let file = data("uastc.ktx2");
    let (descriptor, squeezed) = parts(&file);
    let mut blocks = Vec::new();
    let mut decoder = ruzstd::decoding::StreamingDecoder::new(squeezed).unwrap();
    std::io::Read::read_to_end(&mut decoder, &mut blocks).unwrap();
    assert_eq!(blocks.len(), 4 * 3 * 16);
    (descriptor.to_vec(), blocks)
}

#[test]
fn webp_bmp_and_tga() {
    for channels in [3, 4] {
        for format in [ImageFormat::WebP, ImageFormat::Bmp, ImageFormat::Tga, ImageFormat::Png] {
            let have = read(&encoded(format, channels)).unwrap_or_else(|e| panic!("{format:?}: {e}"));
            assert_eq!(have, (W, H, rgba(channels)), "{format:?} of {channels} channels");
        }
    }
}

/// TGA of other makes: runs, a map of colours, grey, 16 bits, from the bottom up.
#[test]
fn tga_of_all_kinds() {
    let header = |kind: u8, map: [u8; 3], depth: u8, descriptor: u8| {
        let mut h = vec![0, u8::from(map[0] > 0), kind, 0, 0, map[0], 0, map[1]];
        h.extend([0, 0, 0, 0, 2, 0, 2, 0, depth, descriptor]);
        h
    };
    const TOP: u8 = 0x20;
    let two = |bytes: Vec<u8>| {
        read(&bytes).map(|(w, h, texels)| {
            assert_eq!((w, h), (2, 2));
            texels
        })
    };
    // Blue, green, red; a run of three red texels, then one blue.
    let mut runs = header(10, [0; 3], 24, TOP);
    runs.extend([0x82, 0, 0, 255, 0x00, 255, 0, 0]);
    let red_and_blue =
        [[255, 0, 0, 255]; 3].into_iter().chain([[0, 0, 255, 255]]).flatten().collect::<Vec<u8>>();
    assert_eq!(two(runs).unwrap(), red_and_blue);
    // The same from a map.
    let mut mapped = header(1, [2, 24, 0], 8, TOP);
    mapped.extend([0, 0, 255, 255, 0, 0, 0, 0, 0, 1]);
    assert_eq!(two(mapped).unwrap(), red_and_blue);
    // From the bottom up, as most are.
    let mut grey = header(3, [0; 3], 8, 0);
    grey.extend([1, 2, 3, 4]);
    let texel = |v: u8| [v, v, v, 255];
    assert_eq!(two(grey).unwrap(), [3, 4, 1, 2].into_iter().flat_map(texel).collect::<Vec<u8>>());
}

#[test]
fn what_is_no_tga_is_not_taken_for_one() {
    for bytes in [&b"hello, this is some text that is no image"[..], &[0; 64], b"", b"\0\0\x02", &[1; 64]] {
        let e = read(bytes).unwrap_err().to_string();
        assert!(e.contains("not an image of a known kind"), "{e}");
    }
}

#[test]
fn sixteen_bits_become_eight() {
    let texels: Vec<u8> =
        (0..4u16).flat_map(|i| [i * 16_000, 65_535 - i * 10_000, 257]).flat_map(u16::to_ne_bytes).collect();
    let mut out = std::io::Cursor::new(Vec::new());
    image::write_buffer_with_format(&mut out, &texels, 2, 2, ExtendedColorType::Rgb16, ImageFormat::Png)
        .unwrap();
    let want: Vec<u8> = (0..4u32)
        .flat_map(|i| {
            [i * 16_000, 65_535 - i * 10_000, 257, 65_535].map(|v| ((v * 255 + 32_767) / 65_535) as u8)
        })
        .collect();
    assert_eq!(read(&out.into_inner()).unwrap(), (2, 2, want));
}

#[test]
fn basis_is_what_its_own_decoder_says() {
    for name in ["etc1s", "etc1s_alpha_mips", "uastc", "uastc_zstd"] {
        let want = read(&data(&format!("{name}.png"))).unwrap();
        assert_eq!(want.0, W);
        assert_eq!(read(&data(&format!("{name}.ktx2"))).unwrap(), want, "{name}");
    }
    let (descriptor, blocks) = uastc();
    let want = read(&data("uastc.png")).unwrap();
    let size = blocks.len();
    assert_eq!(read(&ktx2(0, 0, &descriptor, &blocks, size)).unwrap(), want);
    assert_eq!(read(&ktx2(0, 3, &descriptor, &zlib(&blocks), size)).unwrap(), want);
}

#[test]
fn uncompressed_ktx2() {
    let (descriptor, _) = uastc();
    let texels = picture(4);
    let pick = |channels: &[usize]| -> Vec<u8> {
        texels.chunks_exact(4).flat_map(|t| channels.iter().map(|&c| t[c])).collect()
    };
    let seen = |channels: &[usize]| -> Vec<u8> {
        let one =
            |t: &[u8]| [0, 1, 2, 3].map(|c| if channels.contains(&c) { t[c] } else { [0, 0, 0, 255][c] });
        texels.chunks_exact(4).flat_map(one).collect()
    };
    // Vulkan's numbers of R8, R8G8, R8G8B8, B8G8R8, R8G8B8A8 and B8G8R8A8, each plain and sRGB.
    let formats: [([u32; 2], &[usize]); 6] = [
        ([9, 15], &[0]),
        ([16, 22], &[0, 1]),
        ([23, 29], &[0, 1, 2]),
        ([30, 36], &[2, 1, 0]),
        ([37, 43], &[0, 1, 2, 3]),
        ([44, 50], &[2, 1, 0, 3]),
    ];
    for (numbers, channels) in formats {
        let level = pick(channels);
        for format in numbers {
            let file = ktx2(format, 0, &descriptor, &level, level.len());
            assert_eq!(read(&file).unwrap(), (W, H, seen(channels)), "{format}");
            let file = ktx2(format, 3, &descriptor, &zlib(&level), level.len());
            assert_eq!(read(&file).unwrap(), (W, H, seen(channels)), "{format}, zlib");
        }
    }
}

#[test]
fn wrong_ktx2_is_refused() {
    let (descriptor, blocks) = uastc();
    let level = picture(4);
    let file = ktx2(37, 0, &descriptor, &level, level.len());
    let error = |bytes: &[u8]| read(bytes).unwrap_err().to_string();
    let with = |at: usize, value: u32| {
        let mut bytes = file.clone();
        bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
        error(&bytes)
    };
    assert!(
        with(12, 98)
            .ends_with("not supported: KTX2 texels of the Vulkan format 98; Basis and 8-bit ones are read")
    );
    for (at, value) in [(24, 0), (28, 1), (32, 2), (36, 6)] {
        assert!(with(at, value).contains("not supported: KTX2 textures other than"), "{at}");
    }
    assert!(with(20, 1 << 20).contains("image side 1048576 exceeds the limit"));
    assert!(
        with(20, 32_768).contains("its data is damaged: the image takes 1310720 bytes, but there are 560")
    );
    assert!(with(44, 9).contains("not supported: this KTX2's kind of supercompression"));
    assert!(with(44, 2).contains("its data is damaged"));
    assert!(with(44, 3).contains("its data is damaged"));
    // What inflates to more or less than the image takes.
    for size in [level.len() - 1, level.len() + 1, 50_000_000] {
        let file = ktx2(37, 3, &descriptor, &zlib(&vec![0; size]), level.len());
        assert!(error(&file).contains("its data is damaged"), "{size}");
    }
    let blocks = &blocks[16..];
    assert!(error(&ktx2(0, 0, &descriptor, blocks, blocks.len())).contains("the image takes 192 bytes"));
    assert!(
        error(b"\xabKTX 11\xbb\r\n\x1a\n")
            .ends_with("not supported: KTX (version 1) images; PNG, JPEG, WebP, KTX2, BMP and TGA are read")
    );
}

#[test]
fn truncated_images_are_errors() {
    let files = [
        ("etc1s", data("etc1s.ktx2"), 0),
        ("etc1s with alpha", data("etc1s_alpha_mips.ktx2"), 0),
        ("uastc", data("uastc_zstd.ktx2"), 0),
        // Its last bytes are padding.
        ("webp", encoded(ImageFormat::WebP, 4), 4),
        ("bmp", encoded(ImageFormat::Bmp, 4), 0),
        // It ends with a footer that is not needed.
        ("tga", encoded(ImageFormat::Tga, 4), 26),
    ];
    for (name, bytes, spare) in files {
        for n in 0..bytes.len() - spare {
            assert!(read(&bytes[..n]).is_err(), "{name}: {n} of {} bytes are enough", bytes.len());
        }
    }
}

#[test]
fn extensions_name_the_image_first() {
    let plain = png(1, 1, &[1, 2, 3, 255]);
    let webp = encoded(ImageFormat::WebP, 4);
    let basis = data("uastc.ktx2");
    let names = |images: &[(&str, &[u8])]| {
        let scene = scene(images).scene();
        assert_eq!(scene.images.len(), 1, "what is not shown is not decoded");
        scene.images[0].rgba8.clone()
    };
    let (of_webp, of_basis) = (rgba(4), read(&data("uastc.png")).unwrap().2);
    assert_eq!(names(&[("", &plain), ("EXT_texture_webp", &webp)]), of_webp);
    assert_eq!(names(&[("", &plain), ("KHR_texture_basisu", &basis)]), of_basis);
    assert_eq!(names(&[("EXT_texture_webp", &webp)]), of_webp);
    assert_eq!(names(&[("KHR_texture_basisu", &basis)]), of_basis);
    assert_eq!(names(&[("KHR_texture_basisu", &basis), ("EXT_texture_webp", &webp)]), of_webp);
    assert_eq!(names(&[("", &plain)]), [1, 2, 3, 255]);

    let mut g = scene(&[("EXT_texture_webp", &webp)]);
    g.doc["extensionsRequired"] = json!(["EXT_texture_webp"]);
    assert_eq!(g.load().unwrap().warnings, Vec::<String>::new());
    g.doc["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = json!(3);
    let place = "scene.gltf: /textures/0/extensions/EXT_texture_webp";
    assert_eq!(g.error(), format!("{place}/source: refers to image 3, but there are 1"));
    g.doc["textures"][0]["extensions"]["EXT_texture_webp"] = json!(3);
    assert_eq!(g.error(), format!("{place}: should be an object"));
    g.doc["textures"][0]["extensions"] = json!({"MSFT_texture_dds": {"source": 0}});
    assert_eq!(g.error(), "scene.gltf: /textures/0: not supported: the extension MSFT_texture_dds");
}

/// A few bytes may say a plain picture, but not one of any size.
#[test]
fn small_files_of_large_images_are_refused() {
    let plain = [0; 4 * 30 * 20];
    let mut webp = std::io::Cursor::new(Vec::new());
    let color = ExtendedColorType::Rgba8;
    image::write_buffer_with_format(&mut webp, &plain, 30, 20, color, ImageFormat::WebP).unwrap();
    let webp = webp.into_inner();
    assert_eq!(read(&webp).unwrap(), (30, 20, plain.to_vec()));
    assert_eq!(webp[20], 0x2f, "a lossless stream, which says its size in 14 bits each");
    let sized = |side: u32| {
        let mut webp = webp.clone();
        let bits = u32::from_le_bytes(webp[21..25].try_into().unwrap()) & !0x0fff_ffff;
        webp[21..25].copy_from_slice(&(bits | (side - 1) | ((side - 1) << 14)).to_le_bytes());
        let mut basis = data("etc1s.ktx2");
        basis[20..24].copy_from_slice(&side.to_le_bytes());
        basis[24..28].copy_from_slice(&side.to_le_bytes());
        [webp, basis]
    };
    for bytes in sized(16_383) {
        let want = format!("16383 x 16383 pixels cannot be held by {} bytes", bytes.len());
        let e = read(&bytes).unwrap_err().to_string();
        assert!(e.ends_with(&want), "{e}");
    }
}

#[test]
fn sizes_are_checked_before_decoding() {
    let folder = tempfile::tempdir().unwrap();
    let small = Limits { max_image_bytes: 4 * 100, ..Limits::default() };
    for (name, bytes) in [
        ("a.webp", encoded(ImageFormat::WebP, 4)),
        ("a.bmp", encoded(ImageFormat::Bmp, 4)),
        ("a.tga", encoded(ImageFormat::Tga, 4)),
        ("a.ktx2", data("etc1s.ktx2")),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let e = read_linear_image(&path, None, &small).unwrap_err().to_string();
        assert!(e.contains("decoded image size") && e.ends_with("exceeds the limit of 400"), "{e}");
        assert_eq!(
            read_linear_image(&path, None, &Limits::default()).unwrap().pixels.len(),
            (W * H) as usize
        );
        let path = folder.path().join("scene.gltf");
        std::fs::write(&path, scene(&[("", &std::fs::read(folder.path().join(name)).unwrap())]).text())
            .unwrap();
        let options = LoadOptions { limits: small.clone(), ..LoadOptions::default() };
        assert!(load_scene(&path, &options).unwrap_err().to_string().contains("decoded image size"));
    }
}

//! Damaged files: whatever bits are turned, swapped or cut, a reader returns; it neither panics nor hangs nor takes more than a
//! gibibyte, within the limits that users have. The mutations are the same in every run.

#[path = "../io/common/mod.rs"]
mod common;

use common::Gltf;
use lumbre_core::Rgb;
use lumbre_io::{
    ExrImage, ExrLayer, IoError, Limits, LoadOptions, load_scene, read_environment, read_exr,
    read_linear_image, write_exr, write_png,
};
use serde_json::{Value, json};
use std::path::Path;
use std::time::{Duration, Instant};

/// Mutations of each file, of which there are some forty; set `LUMBRE_MUTATIONS` for more.
fn rounds() -> u64 {
    std::env::var("LUMBRE_MUTATIONS").ok().and_then(|v| v.parse().ok()).unwrap_or(300)
}

/// A small generator of numbers (SplitMix64, Steele et al. 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
}

/// One to four changes of a kind that breaks parsers.
fn mutate(original: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = original.to_vec();
    for _ in 0..=random.below(4) {
        if bytes.is_empty() {
            break;
        }
        let at = random.below(bytes.len());
        match random.below(7) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes[at] = [0, 1, 0x7f, 0x80, 0xff][random.below(5)],
            2 => bytes.truncate(at),
            // A whole number at an end of its range.
            3 => {
                let value = [0, 1, 0x7fff_ffff, 0x8000_0000, 0xffff_ffff, 0x0001_0000][random.below(6)];
                let value =
                    if random.below(2) == 0 { u32::to_le_bytes(value) } else { u32::to_be_bytes(value) };
                for (b, v) in bytes[at..].iter_mut().zip(value) {
                    *b = v;
                }
            }
            4 => {
                let (from, len) = (random.below(bytes.len()), random.below(64));
                let part = bytes[from..bytes.len().min(from + len)].to_vec();
                for (b, v) in bytes[at..].iter_mut().zip(part) {
                    *b = v;
                }
            }
            5 => drop(bytes.drain(at..original.len().min(at + random.below(16)).min(bytes.len()).max(at))),
            // A digit of the JSON.
            _ => {
                if let Some(digit) = bytes[at..].iter_mut().find(|b| b.is_ascii_digit()) {
                    *digit = b'0' + random.below(10) as u8;
                }
            }
        }
    }
    bytes
}

/// Reads every mutation of `original`; at least one must be refused, or the mutations would prove nothing.
fn survive<T>(name: &str, original: &[u8], read: impl Fn(&Path) -> Result<T, IoError>) {
    survive_with(mutate, name, original, read);
}

/// Other digits and signs in a text, one to four: the form stays sound, so that what lies behind the parser is reached.
fn change_numbers(original: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = original.to_vec();
    let places: Vec<usize> = (0..bytes.len()).filter(|&i| bytes[i].is_ascii_digit()).collect();
    for _ in 0..=random.below(4) {
        let at = places[random.below(places.len())];
        bytes[at] = b"0123456789-e"[random.below(12)];
    }
    bytes
}

fn survive_with<T>(
    mutate: fn(&[u8], &mut Random) -> Vec<u8>,
    name: &str,
    original: &[u8],
    read: impl Fn(&Path) -> Result<T, IoError>,
) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, original).unwrap();
    assert!(read(&path).is_ok(), "the sound {name} does not open");
    let mut random = Random(original.len() as u64);
    let (mut refused, n) = (0, rounds());
    for i in 0..n {
        let bytes = mutate(original, &mut random);
        std::fs::write(&path, &bytes).unwrap();
        let start = Instant::now();
        let result = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| read(&path)));
        let took = start.elapsed();
        assert!(took < MOST_TIME, "mutation {i} of {name} takes {took:?}");
        match result {
            Ok(Ok(_)) => {}
            Ok(Err(e)) => {
                refused += 1;
                let message = e.to_string();
                let stem = name.split('.').next().unwrap();
                assert!(message.contains(stem) && !message.contains('\n'), "{message}");
            }
            Err(_) => panic!("mutation {i} of {name} panics"),
        }
    }
    let peak = peak_memory();
    println!("{name}: {refused} of {n} refused; {:.0?} MiB", peak.map(|b| b >> 20));
    assert!(refused > 0);
    assert!(peak.unwrap_or(0) < MOST_MEMORY, "{name}: {peak:?} bytes");
}

/// Within this a reader returns.
const MOST_TIME: Duration = Duration::from_secs(5);
/// The process stays below this, all its tests at once.
const MOST_MEMORY: u64 = 1 << 30;

/// The most memory that the process has had so far, bytes; `None` where the system does not tell (all but Linux).
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    line.trim().strip_suffix("kB")?.trim().parse().ok().map(|kib: u64| kib << 10)
}

/// Those that users have: what a small damaged file can ask for must be bounded by its own size.
fn limits() -> Limits {
    Limits::default()
}

fn rich_scene() -> Gltf {
    let mut g = Gltf::triangle();
    let uv = g.f32s("VEC2", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let normal = g.f32s("VEC3", &[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0]);
    let at = g.u16s(&[1]);
    let with = g.f32s("VEC3", &[7.0, 8.0, 9.0]);
    let view = |a: usize| g.doc["accessors"][a]["bufferView"].clone();
    g.doc["accessors"][0]["sparse"] = json!({
        "count": 1,
        "indices": {"bufferView": view(at), "componentType": 5123},
        "values": {"bufferView": view(with)}
    });
    let texels: Vec<u8> = (0..256).map(|i| i as u8).collect();
    g.image("image/png", &common::png(8, 8, &texels));
    g.primitive()["attributes"] = json!({"POSITION": 0, "TEXCOORD_0": uv, "NORMAL": normal});
    let places = g.f32s("VEC3", &[1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    let turns = g.raw(5120, "VEC4", 2, &[0, 0, 0, 127, 127, 0, 0, 0]);
    g.doc["accessors"][turns]["normalized"] = json!(true);
    let instances = json!({"attributes": {"TRANSLATION": places, "ROTATION": turns}});
    g.doc["nodes"] = json!([
        {"children": [1, 2]}, {"mesh": 0, "scale": [1, 2, 3], "extensions": {"EXT_mesh_gpu_instancing": instances}},
        {"camera": 0, "children": [3, 4]}, {"camera": 1}, {"mesh": 0, "weights": [0.25]}
    ]);
    g.doc["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 2, "znear": 0, "zfar": 9}}
    ]);
    g.primitive()["targets"] = json!([{"POSITION": 0, "NORMAL": normal}]);
    g.doc["meshes"][0]["weights"] = json!([0.5]);
    g.doc["extensions"] = json!({"KHR_materials_variants": {"variants": [{"name": "a"}, {"name": "b"}]}});
    g.primitive()["extensions"] =
        json!({"KHR_materials_variants": {"mappings": [{"material": 0, "variants": [0, 1]}]}});
    let mut g = g.material(json!({
        "pbrMetallicRoughness": {"baseColorTexture": {
            "index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}
        }},
        "extensions": {
            "KHR_materials_volume": {"thicknessFactor": 1, "attenuationColor": [1, 0.5, 0.25]},
            "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0, "scale": 0.5}},
            "KHR_materials_iridescence": {"iridescenceFactor": 1, "iridescenceThicknessTexture": {"index": 0}}
        }
    }));
    g.doc["materials"].as_array_mut().unwrap().push(json!({"extensions": {
        "KHR_materials_pbrSpecularGlossiness": {"specularGlossinessTexture": {"index": 0}, "glossinessFactor": 0.5},
        "KHR_materials_sheen": {"sheenColorFactor": [0.5, 0.25, 1], "sheenRoughnessFactor": 0.5},
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 2},
        "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 0.5}
    }}));
    g
}

/// A smooth picture with some noise, so that every coding has something to do.
fn picture(n: u32) -> Vec<Rgb> {
    let mut random = Random(1);
    (0..n * n).map(|i| Rgb::splat((i % n) as f32) + Rgb::splat((random.next() % 100) as f32 * 0.01)).collect()
}

#[test]
fn gltf_and_glb() {
    let variant = Some("b".into());
    let options = LoadOptions { limits: limits(), variant, ..LoadOptions::default() };
    // A scene that loads must also compile, or say why not.
    let read = |path: &Path| load_scene(path, &options).map(|l| lumbre_scene::compile(&l.scene).map(|_| ()));
    survive("scene.gltf", rich_scene().text().as_bytes(), read);
    survive("scene.glb", &rich_scene().glb(), read);
    // Without data URIs every digit of the text means something.
    let mut g = rich_scene();
    g.doc["buffers"] = json!([{"byteLength": g.bytes.len()}]);
    g.doc["images"] = json!([]);
    g.doc["textures"] = json!([]);
    g.doc["materials"] = json!([{}]);
    let text = g.doc.to_string();
    let glb = |text: &[u8]| Gltf::wrap(text, &g.bytes);
    let read = |path: &Path| {
        let text = std::fs::read(path).unwrap();
        let path = path.with_extension("glb");
        std::fs::write(&path, glb(&text)).unwrap();
        read(&path)
    };
    survive_with(change_numbers, "scene.json", text.as_bytes(), read);
}

/// Every statement of OBJ and of MTL, the pictures of the maps beside them.
const OBJ: &str = "mtllib scene.mtl other.mtl\no a\nv 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0\nv 0 1 0.5 \\\n 0 0 1\n\
    v 2 2 0\nvt 0 0\nvt 1 0\nvt 0.5 1\nvn 0 0 1\nvn 0 1 0\ng b c\nusemtl m\ns 1\nf 1/1/1 2/2/1 3/3/2\n\
    f -1/-1 -2/-2 -3/-3 -4/-1 -5/-3\nusemtl n\ns off\nf 1//1 2//2 4//1\nf 1 2 3 4 5\nl 1 2\np 1\n\
    usemtl water\ns 2\nf 4 3 2\n";
const MTL: &str = "newmtl m\nKd 0.5 0.4 0.3\nKs 0.1 0.2 0.3\nKe 1 2 3\nNs 32\nNi 1.5\nd 0.75\nillum 2\n\
    map_Kd -s 2 3 -o 0.5 0.25 -clamp on a.png\nmap_d -imfchan r a.png\nmap_Ke a.png\nbump -bm 0.5 a.png\n\
    newmtl n\nPr 0.5\nPm 1\nPc 0.5\nPcr 0.1\nPs 0.2\nmap_Pr a.png\nmap_Pm a.png\nnorm a.png\nTr 0.5\n\
    newmtl water\nTf 0.5 0.5 0.5\nillum 7\n";

#[test]
fn obj_and_mtl() {
    let options = LoadOptions { limits: limits(), ..LoadOptions::default() };
    let beside =
        |path: &Path, name: &str, bytes: &[u8]| std::fs::write(path.with_file_name(name), bytes).unwrap();
    let picture = common::png(4, 4, &[77; 64]);
    let read = |path: &Path| load_scene(path, &options).map(|l| lumbre_scene::compile(&l.scene).map(|_| ()));
    for mutate in [mutate, change_numbers] {
        let read_obj = |path: &Path| {
            beside(path, "scene.mtl", MTL.as_bytes());
            beside(path, "a.png", &picture);
            read(path)
        };
        survive_with(mutate, "scene.obj", OBJ.as_bytes(), read_obj);
        // A library never keeps a mesh from being drawn: what is counted as refused here is what it warns of.
        let read_mtl = |path: &Path| {
            beside(path, "scene.obj", OBJ.as_bytes());
            beside(path, "a.png", &picture);
            let loaded = load_scene(path.with_extension("obj"), &options)?;
            lumbre_scene::compile(&loaded.scene).unwrap();
            let told = loaded.warnings.len() > 3;
            if told { load_scene(path.with_file_name("scene.none"), &options).map(|_| ()) } else { Ok(()) }
        };
        survive_with(mutate, "scene.mtl", MTL.as_bytes(), read_mtl);
    }
}

#[test]
fn ply_and_stl() {
    let options = LoadOptions { limits: limits(), ..LoadOptions::default() };
    let read = |path: &Path| load_scene(path, &options).map(|l| lumbre_scene::compile(&l.scene).map(|_| ()));
    let header = |format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
             property list uchar short odd\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
             element face 2\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    let rows = "0 0 0 1 7 1 2 3\n1 0 0 0 1 2 3\n1 1 0 2 7 7 1 2 3\n0 1 0 0 1 2 3\n3 0 1 2\n4 0 1 2 3\n";
    let text = header("ascii") + rows;
    survive("a.ply", text.as_bytes(), read);
    survive_with(change_numbers, "a.ply", text.as_bytes(), read);
    for (order, big) in [("binary_little_endian", false), ("binary_big_endian", true)] {
        let mut bytes = header(order).into_bytes();
        let word = |v: [u8; 4]| if big { [v[3], v[2], v[1], v[0]] } else { v };
        for i in 0..4 {
            let place = [(i % 2) as f32, (i / 2) as f32, 0.0];
            place.iter().for_each(|v| bytes.extend(word(v.to_le_bytes())));
            bytes.extend([1, 0, 9, 1, 2, 3]);
        }
        for face in [&[0, 1, 2][..], &[0, 1, 3, 2]] {
            bytes.push(face.len() as u8);
            face.iter().for_each(|v: &i32| bytes.extend(word(v.to_le_bytes())));
        }
        survive("b.ply", &bytes, read);
    }
    let facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
    survive("a.stl", format!("solid a\n{facet}{facet}endsolid\n").as_bytes(), read);
    let mut binary = vec![b'x'; 80];
    binary.extend(2u32.to_le_bytes());
    binary.extend((0..100u8).map(|i| i % 3));
    survive("b.stl", &binary, read);
}

#[test]
fn png_and_jpeg() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let rgb: Vec<u8> = picture(24).iter().flat_map(|p| p.to_array().map(|c| c as u8 * 9)).collect();
    write_png(&path, 24, 24, &rgb).unwrap();
    let read = |path: &Path| read_linear_image(path, None, &limits());
    survive("a.png", &std::fs::read(&path).unwrap(), read);
    let mut jpeg = std::io::Cursor::new(Vec::new());
    let color = image::ExtendedColorType::Rgb8;
    image::write_buffer_with_format(&mut jpeg, &rgb, 24, 24, color, image::ImageFormat::Jpeg).unwrap();
    survive("a.jpg", &jpeg.into_inner(), read);
}

fn data(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/tests/io/data/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

#[test]
fn webp_bmp_tga_and_ktx2() {
    let read = |path: &Path| read_linear_image(path, None, &limits());
    let rgb: Vec<u8> = picture(24).iter().flat_map(|p| p.to_array().map(|c| c as u8 * 9)).collect();
    for (name, format) in [
        ("a.webp", image::ImageFormat::WebP),
        ("a.bmp", image::ImageFormat::Bmp),
        ("a.tga", image::ImageFormat::Tga),
    ] {
        let mut file = std::io::Cursor::new(Vec::new());
        let color = image::ExtendedColorType::Rgb8;
        image::write_buffer_with_format(&mut file, &rgb, 24, 24, color, format).unwrap();
        survive(name, &file.into_inner(), read);
    }
    for name in ["etc1s.ktx2", "etc1s_alpha_mips.ktx2", "uastc.ktx2"] {
        survive(name, &data(name), read);
    }
}

/// Mutates only the streams: what is around them is mutated by the test of plain scenes.
#[test]
fn draco_and_meshopt() {
    let options = LoadOptions { limits: limits(), ..LoadOptions::default() };
    let compile =
        |path: &Path| load_scene(path, &options).map(|l| lumbre_scene::compile(&l.scene).map(|_| ()));
    let cases = |name: &str| -> Vec<Value> { serde_json::from_slice(&data(name)).unwrap() };
    let survive_in = |case: &Value, scene: fn(&Value, &[u8]) -> Gltf| {
        let name = format!("{}.stream", case["name"].as_str().unwrap());
        survive(&name, &common::unbase64(&case["stream"]), |path| {
            let g = scene(case, &std::fs::read(path).unwrap());
            let path = path.with_extension("glb");
            std::fs::write(&path, g.glb()).unwrap();
            compile(&path)
        });
    };
    cases("draco.json").iter().for_each(|case| survive_in(case, common::draco_scene));
    cases("meshopt.json").iter().for_each(|case| survive_in(case, common::meshopt_scene));
}

#[test]
fn hdr() {
    // Runs and lists, then plain pixels with old runs.
    let mut bytes = b"#?RADIANCE\nEXPOSURE=2\nFORMAT=32-bit_rle_rgbe\n\n-Y 24 +X 24\n".to_vec();
    let mut random = Random(2);
    for y in 0..24 {
        if y % 2 == 0 {
            bytes.extend([2, 2, 0, 24]);
            for _ in 0..4 {
                bytes.extend([128 + 14, random.next() as u8, 10]);
                bytes.extend((0..10).map(|_| random.next() as u8));
            }
        } else {
            bytes.extend([9, 8, 7, 130, 1, 1, 1, 20]);
            bytes.extend((0..3).flat_map(|_| [5, 4, 3, random.next() as u8]));
        }
    }
    survive("a.hdr", &bytes, |path| read_environment(path, &limits()));
}

#[test]
fn exr() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let layers = vec![ExrLayer::rgb("", picture(24).into_iter(), false)];
    let metadata = vec![("seed".into(), "7".into())];
    let image = ExrImage { width: 24, height: 24, layers, metadata, ..ExrImage::default() };
    write_exr(&path, image).unwrap();
    survive("a.exr", &std::fs::read(&path).unwrap(), |path| read_exr(path, &limits()));
}

/// The codings that this program does not write but reads.
#[test]
fn exr_of_other_codings() {
    use exr::prelude::*;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("b.exr");
    let pixels = picture(24);
    for (i, compression) in [
        Compression::Uncompressed,
        Compression::RLE,
        Compression::ZIP1,
        Compression::PIZ,
        Compression::PXR24,
        Compression::B44,
        Compression::DWAA(None),
        Compression::DWAB(None),
    ]
    .into_iter()
    .enumerate()
    {
        let channel = |name: &str, at: usize| {
            AnyChannel::new(name, FlatSamples::F16(pixels.iter().map(|p| f16::from_f32(p[at])).collect()))
        };
        let list = [("R", 0), ("G", 1), ("B", 2)].map(|(n, at)| channel(n, at));
        let tiled = i % 2 == 0;
        let blocks = if tiled { Blocks::Tiles(Vec2(16, 16)) } else { Blocks::ScanLines };
        let encoding = Encoding { compression, blocks, line_order: LineOrder::Increasing };
        let layer = Layer::new(
            (24, 24),
            LayerAttributes::default(),
            encoding,
            AnyChannels::sort(list.into_iter().collect()),
        );
        Image::from_layer(layer).write().to_file(&path).unwrap();
        println!("{compression}");
        survive("b.exr", &std::fs::read(&path).unwrap(), |path| read_exr(path, &limits()));
    }
}

//! Pictures out and in again.

use lumbre_core::Rgb;
use lumbre_core::color::srgb_decode;
use lumbre_io::{
    ErrorKind, ExrImage, ExrLayer, ExrWindow, Limits, read_environment, read_exr, read_linear_image,
    write_exr, write_png,
};
use std::fs;
use std::path::Path;

fn limits() -> Limits {
    Limits::default()
}

/// A picture whose texels all differ.
fn pixels(n: usize) -> Vec<Rgb> {
    (0..n).map(|i| Rgb::new(i as f32 * 0.37, 1000.0 / (i as f32 + 1.0), (i * i) as f32 * 1e-3)).collect()
}

fn exr(width: u32, height: u32) -> ExrImage {
    let p = pixels((width * height) as usize);
    let depth: Vec<f32> = p.iter().map(|c| c.g + 0.5).collect();
    let alpha = vec![1.0; p.len()];
    let mut beauty = ExrLayer::rgb("", p.iter().copied(), false);
    beauty.channels.push(("A".into(), alpha));
    let count = |i: u32| u32::MAX - 3 * i;
    ExrImage {
        width,
        height,
        window: Some(ExrWindow { picture: [width + 5, height + 9], origin: [5, 2] }),
        whole: vec![("counts.S".into(), (0..width * height).map(count).collect())],
        layers: vec![
            beauty,
            ExrLayer::rgb("albedo", p.iter().map(|c| *c * 0.5), false),
            ExrLayer { name: "depth".into(), channels: vec![("Z".into(), depth)] },
            ExrLayer::rgb("normal", p.iter().map(|c| *c * -1.0), true),
        ],
        metadata: [("samples", "64"), ("seed", "7"), ("scene", "cañón"), ("a", "1"), ("b", "2"), ("c", "")]
            .map(|(k, v)| (k.to_string(), v.to_string()))
            .to_vec(),
    }
}

#[test]
fn exr_comes_back_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    // Odd sizes, and rows beyond one block of 16.
    for (w, h) in [(1, 1), (7, 3), (33, 50)] {
        let mut image = exr(w, h);
        image.layers[0].channels[0].1[0] = f32::NAN;
        image.layers[0].channels[1].1[0] = f32::NEG_INFINITY;
        write_exr(&path, image.clone()).unwrap();
        let mut back = read_exr(&path, &limits()).unwrap();
        assert!(back.layers[0].channels[0].1[0].is_nan());
        back.layers[0].channels[0].1[0] = 0.0;
        image.layers[0].channels[0].1[0] = 0.0;
        image.metadata.sort();
        assert_eq!(back, image, "{w} x {h}");
    }
}

#[test]
fn exr_layers_are_read_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    write_exr(&path, exr(5, 4)).unwrap();
    let want = pixels(20);
    let read = |layer| read_linear_image(&path, layer, &limits()).unwrap().pixels;
    assert_eq!(read(None), want);
    assert_eq!(read(Some("")), want);
    assert_eq!(read(Some("albedo")), want.iter().map(|c| *c * 0.5).collect::<Vec<_>>());
    assert_eq!(read(Some("normal")), want.iter().map(|c| *c * -1.0).collect::<Vec<_>>());
    assert_eq!(read(Some("depth")), want.iter().map(|c| Rgb::splat(c.g + 0.5)).collect::<Vec<_>>());
    let whole: Vec<Rgb> = (0..20).map(|i| Rgb::splat((u32::MAX - 3 * i) as f32)).collect();
    assert_eq!(read(Some("counts")), whole, "whole numbers too");
    let e = read_linear_image(&path, Some("nothing"), &limits()).unwrap_err();
    assert_eq!(e.kind(), ErrorKind::BadData);
    let want =
        r#"has no layer "nothing" with colours; its layers are "", "albedo", "counts", "depth", "normal""#;
    assert!(e.to_string().ends_with(want), "{e}");
}

/// What other programs go by: names in the header, one part, scan lines, ZIP.
#[test]
fn exr_header_says_what_other_programs_look_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    write_exr(&path, exr(5, 4)).unwrap();
    let meta = exr::meta::MetaData::read_from_file(&path, true).unwrap();
    assert_eq!(meta.headers.len(), 1);
    assert!(!meta.requirements.has_multiple_layers && !meta.requirements.is_single_layer_and_tiled);
    let header = &meta.headers[0];
    assert_eq!(header.compression, exr::prelude::Compression::ZIP16);
    let names: Vec<_> = header.channels.list.iter().map(|c| c.name.to_string()).collect();
    let want = [
        "A", "B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "counts.S", "depth.Z", "normal.X",
        "normal.Y", "normal.Z",
    ];
    assert_eq!(names, want);
    for channel in &header.channels.list {
        use exr::prelude::SampleType::{F32, U32};
        let whole = channel.name == *"counts.S";
        assert_eq!(channel.sample_type, if whole { U32 } else { F32 });
    }
    let data = header.own_attributes.layer_position;
    let display = header.shared_attributes.display_window;
    assert_eq!((data.0, data.1, header.layer_size.0, header.layer_size.1), (5, 2, 5, 4));
    assert_eq!((display.position.0, display.position.1, display.size.0, display.size.1), (0, 0, 10, 13));
    assert_eq!(header.own_attributes.software_name.as_ref().unwrap().to_string(), "Lumbre");
    let red = header.shared_attributes.chromaticities.unwrap().red;
    assert_eq!((red.0, red.1), (0.64, 0.33));
}

#[test]
fn the_same_exr_is_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = |i: usize| {
        let path = folder.path().join(format!("{i}.exr"));
        write_exr(&path, exr(40, 40)).unwrap();
        fs::read(path).unwrap()
    };
    let first = bytes(0);
    // Six custom attributes have 720 orders.
    assert!((1..8).all(|i| bytes(i) == first));
}

#[test]
fn exr_that_cannot_be_written_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    fs::write(&path, "old").unwrap();
    let refused = |image: ExrImage, why: &str| {
        let e = write_exr(&path, image).unwrap_err();
        assert_eq!(e.kind(), ErrorKind::CannotWrite);
        assert!(e.to_string().contains(why), "{e}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    };
    let layer = |name: &str, channel: &str, n: usize| ExrImage {
        width: 2,
        height: 2,
        layers: vec![ExrLayer { name: name.into(), channels: vec![(channel.into(), vec![0.0; n])] }],
        ..ExrImage::default()
    };
    refused(layer("", "R", 3), "channel \"R\" has 3 values for 2 x 2 pixels");
    refused(layer("", "", 4), "cannot name a channel");
    refused(layer("日本", "R", 4), "cannot name a channel");
    refused(ExrImage { layers: vec![], ..layer("", "R", 4) }, "there is no channel to write");
    refused(ExrImage { width: 0, ..layer("", "R", 0) }, "has 0 values");
    let mut twice = layer("", "R", 4);
    twice.layers.push(twice.layers[0].clone());
    refused(twice, "two channels R");
    let reserved = ExrImage { metadata: vec![("channels".into(), "x".into())], ..layer("", "R", 4) };
    refused(reserved, "reserved");
}

#[test]
fn exr_of_other_programs() {
    use exr::prelude::*;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.exr");
    // Halves in tiles, a smaller window inside a larger one, and two parts.
    let channel = |name: &str, v: f32| AnyChannel::new(name, FlatSamples::F16(vec![f16::from_f32(v); 6]));
    let layer = |name: &str, names: [&str; 3]| {
        let list = names.iter().zip([0.25, 0.5, -1.0]).map(|(n, v)| channel(n, v)).collect();
        let encoding = Encoding { blocks: Blocks::Tiles(Vec2(2, 2)), ..Encoding::SMALL_FAST_LOSSLESS };
        Layer::new((3, 2), LayerAttributes::named(name), encoding, AnyChannels::sort(list))
    };
    let layers = vec![layer("extra", ["X", "Y", "Z"]), layer("main", ["R", "G", "B"])];
    let image = Image::from_layers(ImageAttributes::with_size((10, 10)), layers);
    image.write().to_file(&path).unwrap();
    let back = read_exr(&path, &limits()).unwrap();
    let names: Vec<_> = back.layers.iter().map(|l| l.name.as_str()).collect();
    assert_eq!((back.width, back.height, &names[..]), (3, 2, &["extra", "main"][..]));
    let main = read_linear_image(&path, Some("main"), &limits()).unwrap();
    assert_eq!(main.pixels, [Rgb::new(0.25, 0.5, -1.0); 6]);
}

#[test]
fn png_comes_back_and_is_taken_as_srgb() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.png");
    let rgb: Vec<u8> = (0..60).map(|i| (i * 4) as u8).collect();
    write_png(&path, 5, 4, &rgb).unwrap();
    assert_eq!(image::open(&path).unwrap().into_rgb8().into_raw(), rgb);
    let back = read_linear_image(&path, None, &limits()).unwrap();
    assert_eq!((back.width, back.height), (5, 4));
    for (p, code) in back.pixels.iter().zip(rgb.chunks(3)) {
        assert_eq!(p.to_array(), [0, 1, 2].map(|k| srgb_decode(f32::from(code[k]) / 255.0)));
    }
    let e = write_png(&path, 5, 5, &rgb).unwrap_err();
    assert_eq!(e.kind(), ErrorKind::CannotWrite);
    assert!(e.to_string().ends_with("cannot write: 5 x 5 pixels take 75 bytes, not 60"), "{e}");
    assert!(write_png(&path, 0, 0, &[]).is_err());
    let e = read_linear_image(&path, Some("albedo"), &limits()).unwrap_err();
    assert!(e.to_string().contains("only EXR files have layers"));
}

#[test]
fn sixteen_bit_png_keeps_its_depth() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wide.png");
    let image = image::ImageBuffer::<image::Rgb<u16>, _>::from_raw(1, 1, vec![0x8001u16, 3, 0xffff]).unwrap();
    image.save(&path).unwrap();
    let p = read_linear_image(&path, None, &limits()).unwrap().pixels[0];
    assert_eq!(p.to_array(), [0x8001u16, 3, 0xffff].map(|v| srgb_decode(f32::from(v) / 65535.0)));
}

/// A Radiance file with this size line and these bytes.
fn hdr(path: &Path, header: &str, size: &str, data: &[u8]) {
    let text = format!("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n{header}\n{size}\n");
    fs::write(path, [text.as_bytes(), data].concat()).unwrap();
}

#[test]
fn hdr_in_its_three_codings() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hdr");
    let read = |path: &Path| read_linear_image(path, None, &limits()).unwrap().pixels;
    // 128 + 1 as exponent: the mantissas over 256, times two.
    let (a, b) = ([128, 64, 0, 129], [1, 2, 4, 137]);
    let (ca, cb) = (Rgb::new(1.0, 0.5, 0.0), Rgb::new(2.0, 4.0, 8.0));
    hdr(&path, "", "-Y 1 +X 2", &[a, b].concat());
    assert_eq!(read(&path), [ca, cb]);
    // 1 1 1 n repeats; a second one counts in 256s.
    hdr(&path, "", "-Y 1 +X 262", &[a, [1, 1, 1, 4], [1, 1, 1, 1], b].concat());
    let old = read(&path);
    assert_eq!((old[0], old[260], old[261]), (ca, ca, cb));
    // By component: three times a, six times b, each component in a run and a list.
    let mut rows = Vec::new();
    for _ in 0..2 {
        rows.extend([2, 2, 0, 9]);
        for (x, y) in a.into_iter().zip(b) {
            rows.extend([131, x, 6, y, y, y, y, y, y]);
        }
    }
    hdr(&path, "", "-Y 2 +X 9", &rows);
    let new = read(&path);
    assert_eq!((new[2], new[3], new[8], new[9], new[17]), (ca, cb, cb, ca, cb));
    // Exponent 0 is black, whatever the mantissa.
    hdr(&path, "", "-Y 1 +X 1", &[9, 9, 9, 0]);
    assert_eq!(read(&path), [Rgb::BLACK]);
}

#[test]
fn hdr_exposure_and_orientation() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hdr");
    let four = [[128, 0, 0, 129], [0, 128, 0, 129], [0, 0, 128, 129], [128, 128, 128, 129]].concat();
    let [r, g, b, w] =
        [Rgb::new(1.0, 0.0, 0.0), Rgb::new(0.0, 1.0, 0.0), Rgb::new(0.0, 0.0, 1.0), Rgb::WHITE];
    let read = |header: &str, size: &str| {
        hdr(&path, header, size, &four);
        read_linear_image(&path, None, &limits())
    };
    assert_eq!(read("", "-Y 2 +X 2").unwrap().pixels, [r, g, b, w]);
    assert_eq!(read("", "+Y 2 +X 2").unwrap().pixels, [b, w, r, g]);
    assert_eq!(read("", "-Y 2 -X 2").unwrap().pixels, [g, r, w, b]);
    let exposed = read("# a comment\nEXPOSURE=4\nSOFTWARE=x=y\nEXPOSURE= 0.5\n", "-Y 2 +X 2").unwrap();
    assert_eq!(exposed.pixels[3], Rgb::splat(0.5));
    for (header, size) in [
        ("", "+X 2 -Y 2"),
        ("", "-Y 2 +X"),
        ("", "-Y two +X 2"),
        ("", "-Y 0 +X 2"),
        ("", "-Y 2 +X 99999999999"),
        ("", "-Y 4000000000 +X 4000000000"),
        ("", "-Y 3 +X 2"),
        ("EXPOSURE=0\n", "-Y 2 +X 2"),
        ("EXPOSURE=x\n", "-Y 2 +X 2"),
        ("FORMAT=32-bit_rle_xyze\n", "-Y 2 +X 2"),
    ] {
        let e = read(header, size).expect_err(size);
        assert_eq!(e.kind(), ErrorKind::BadData, "{e}");
    }
}

#[test]
fn environments_are_made_sound() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("env.exr");
    let bad = [f32::NAN, f32::INFINITY, -1.0, 2.0];
    let p: Vec<Rgb> = (0..8).map(|i| Rgb::new(1.0, *bad.get(i).unwrap_or(&0.5), 3.0)).collect();
    let layers = vec![ExrLayer::rgb("", p.iter().copied(), false)];
    write_exr(&path, ExrImage { width: 4, height: 2, layers, ..ExrImage::default() }).unwrap();
    let env = read_environment(&path, &limits()).unwrap();
    let green: Vec<f32> = env.map.pixels.iter().map(|p| p.g).collect();
    assert_eq!(green, [0.0, 0.0, 0.0, 2.0, 0.5, 0.5, 0.5, 0.5]);
    assert_eq!(env.map.pixels[0], Rgb::new(1.0, 0.0, 3.0));
    assert_eq!(env.warnings.len(), 1);
    assert!(env.warnings[0].starts_with("3 of 8 texels"), "{}", env.warnings[0]);
}

#[test]
fn sizes_are_checked_before_anything_is_decoded() {
    let folder = tempfile::tempdir().unwrap();
    let small = Limits { max_image_side: 16, ..Limits::default() };
    let tight = Limits { max_image_bytes: 100, ..Limits::default() };
    let (png, exr_path, hdr_path) =
        (folder.path().join("a.png"), folder.path().join("a.exr"), folder.path().join("a.hdr"));
    write_png(&png, 17, 1, &[0; 51]).unwrap();
    write_exr(&exr_path, exr(17, 1)).unwrap();
    hdr(&hdr_path, "", "-Y 1 +X 17", &[0; 68]);
    for path in [&png, &exr_path, &hdr_path] {
        assert!(read_linear_image(path, None, &limits()).is_ok(), "{}", path.display());
        for (l, what) in [(&small, "image side 17 exceeds"), (&tight, "decoded image size")] {
            let e = read_linear_image(path, None, l).unwrap_err();
            assert_eq!(e.kind(), ErrorKind::BadData);
            assert!(e.to_string().contains(what), "{e}");
        }
    }
    // A header that claims 16384² pixels over no data.
    let mut lying = fs::read(&png).unwrap();
    lying[16..24].copy_from_slice(&[0, 0, 64, 0, 0, 0, 64, 0]);
    let crc = crc32(&lying[12..29]);
    lying[29..33].copy_from_slice(&crc.to_be_bytes());
    fs::write(&png, lying).unwrap();
    let e = read_linear_image(&png, None, &limits()).unwrap_err();
    assert!(e.to_string().contains("16384 x 16384 pixels cannot be held by"), "{e}");
}

/// The checksum of PNG chunks (ISO 3309).
fn crc32(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(!0u32, |crc, &b| {
        (0..8).fold(crc ^ u32::from(b), |c, _| if c & 1 == 1 { 0xedb8_8320 ^ (c >> 1) } else { c >> 1 })
    })
}

//! Pictures for displays, and Radiance HDR: what is in the files.

use lumbre_core::Rgb;
use lumbre_io::{DisplayImage, ErrorKind, Limits, LinearImage, Picture, read_linear_image};
use std::fs;

fn gradient(has_alpha: bool) -> DisplayImage {
    let (width, height) = (40, 24);
    let channels = if has_alpha { 4 } else { 3 };
    let bytes = (0..width * height).flat_map(|i| [i % width * 6, i / width * 10, 128, i % 256]);
    let bytes = bytes.enumerate().filter(|(i, _)| i % 4 < channels).map(|(_, v)| v as u8).collect();
    DisplayImage { width, height, has_alpha, bytes }
}

#[test]
fn png_says_srgb_and_keeps_alpha() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    for has_alpha in [false, true] {
        let image = gradient(has_alpha);
        Picture::Png(&image).write(&path).unwrap();
        let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).unwrap()));
        let mut reader = decoder.read_info().unwrap();
        assert_eq!(reader.info().srgb, Some(png::SrgbRenderingIntent::Perceptual));
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut bytes).unwrap();
        let color = if has_alpha { png::ColorType::Rgba } else { png::ColorType::Rgb };
        assert_eq!((info.width, info.height, info.color_type), (40, 24, color));
        assert_eq!(bytes, image.bytes, "straight, as they were given");
    }
}

#[test]
fn jpeg_is_close_and_better_at_a_higher_quality() {
    let folder = tempfile::tempdir().unwrap();
    let error_and_size = |quality: u8| {
        let path = folder.path().join(format!("{quality}.jpg"));
        let image = gradient(false);
        Picture::Jpeg(&image, quality).write(&path).unwrap();
        let png = folder.path().join("a.png");
        Picture::Png(&image).write(&png).unwrap();
        let read = |p: &std::path::Path| read_linear_image(p, None, &Limits::default()).unwrap().pixels;
        let differences = read(&path).into_iter().zip(read(&png)).map(|(a, b)| (a - b).luminance().abs());
        (differences.sum::<f32>() / (40.0 * 24.0), fs::metadata(&path).unwrap().len())
    };
    let ((coarse, small), (fine, large)) = (error_and_size(10), error_and_size(92));
    assert!(fine < 0.01 && coarse > 2.0 * fine && small < large, "{coarse} {small}, {fine} {large}");
    let e = Picture::Jpeg(&gradient(true), 92).write(folder.path().join("b.jpg")).unwrap_err();
    assert!(e.to_string().ends_with("a JPEG has no alpha"), "{e}");
    assert!(!folder.path().join("b.jpg").exists());
}

#[test]
fn hdr_keeps_radiance_to_eight_bits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hdr");
    // Narrower rows than 8 pixels are not run-length encoded.
    for (width, height) in [(40, 24), (5, 3)] {
        let value = |i: u32| Rgb::new(1e-5, 0.37 * i as f32, 5e6 / (1 + i) as f32);
        let pixels: Vec<Rgb> = (0..width * height).map(value).collect();
        let image = LinearImage { width, height, pixels };
        Picture::Hdr(&image).write(&path).unwrap();
        let again = read_linear_image(&path, None, &Limits::default()).unwrap();
        assert_eq!((again.width, again.height), (width, height));
        for (a, b) in image.pixels.iter().zip(&again.pixels) {
            let quantum = a.max_component() / 128.0;
            assert!((*a - *b).to_array().iter().all(|d| d.abs() <= quantum), "{a:?} {b:?}");
        }
    }
    let flat = LinearImage { width: 1000, height: 20, pixels: vec![Rgb::splat(0.5); 20_000] };
    Picture::Hdr(&flat).write(&path).unwrap();
    assert!(fs::metadata(&path).unwrap().len() < 4 * 20_000 / 10, "runs are short");
}

#[test]
fn pictures_that_make_no_sense_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a");
    let short = DisplayImage { bytes: vec![0; 7], ..gradient(false) };
    let empty = LinearImage { width: 0, height: 4, pixels: vec![] };
    for picture in [Picture::Png(&short), Picture::Jpeg(&short, 90), Picture::Hdr(&empty)] {
        assert_eq!(picture.write(&path).unwrap_err().kind(), ErrorKind::CannotWrite);
        assert!(names(folder.path()).is_empty());
    }
}

fn names(folder: &std::path::Path) -> Vec<std::ffi::OsString> {
    fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name()).collect()
}

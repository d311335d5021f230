//! Files: what they look like, what is refused and how, and that damaged ones do no harm.

use super::random::{Random, edits};
use super::{camera, scene};
use crate::edits::{Edits, Item, Value};
use lumbre_io::ErrorKind;
use lumbre_scene::{MaterialId, Scene};
use std::time::{Duration, Instant};

/// The example of the manual.
fn example() -> String {
    let page = include_str!("../../../../../docs/edits.md");
    let (_, rest) = page.split_once("```json\n").expect("an example");
    rest.split_once("```").expect("its end").0.to_owned()
}

#[test]
fn the_example_of_the_manual_is_sound() {
    let text = example();
    let edits = Edits::parse(&text).unwrap();
    assert_eq!(edits.to_text(), text, "and written as it would be written");
    // Each member is shown, and each table of what can be changed is complete.
    let page = include_str!("../../../../../docs/edits.md");
    let base = scene();
    let mut edits = Edits::default();
    for item in super::items(&mut edits) {
        for row in edits.rows(&base, &camera(), item).unwrap() {
            assert!(page.contains(&format!("`{}`", row.name)), "docs/edits.md lacks {}", row.name);
            for word in row.kind.words() {
                assert!(page.contains(word), "docs/edits.md lacks {word} of {}", row.name);
            }
        }
    }
}

#[test]
fn files_are_written_and_read() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("a.edits.json");
    let mut random = Random(4);
    let edits = edits(&mut random);
    edits.write(&path).unwrap();
    let back = Edits::read(&path).unwrap();
    assert_eq!(Edits { ..back }.scene, edits.scene);
    // The path of a sky is the file's own, wherever it is read from.
    let mut edits = Edits::default();
    let sky = dir.path().join("sky").join("day.hdr");
    edits.set(&Scene::default(), Item::Sky, "kind", Value::Word("file")).unwrap();
    edits.set(&Scene::default(), Item::Sky, "file", Value::Text(sky.display().to_string())).unwrap();
    edits.write(&path).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("\"file\": \"sky/day.hdr\"") || cfg!(windows), "{text}");
    assert_eq!(Edits::read(&path).unwrap(), edits);
    assert_eq!(Edits::read(&path).unwrap().sky_file(), Some(sky));
}

#[test]
fn files_that_cannot_be_are_told() {
    let dir = tempfile::tempdir().unwrap();
    let e = Edits::read(dir.path().join("none.json")).unwrap_err();
    assert_eq!(e.kind(), ErrorKind::CannotOpen);
    assert_eq!(Edits::read(dir.path()).unwrap_err().kind(), ErrorKind::CannotOpen);
    let path = dir.path().join("a.json");
    std::fs::write(&path, [b'"', 0xff, b'"']).unwrap();
    assert!(Edits::read(&path).unwrap_err().to_string().contains("no text: invalid utf-8"));
    std::fs::write(&path, "{\n  \"lumbreEdits\": 1,\n  \"camera\": {\"fov\": 200}\n}").unwrap();
    let e = Edits::read(&path).unwrap_err();
    assert_eq!(e.kind(), ErrorKind::BadData);
    let says = "a.json: line 3: /camera/fov: expected a number from 0.001 to 179.9°, not 200";
    assert!(e.to_string().ends_with(says), "{e}");
    // A gigabyte of nothing: refused by its size.
    let file = std::fs::File::create(&path).unwrap();
    file.set_len(1 << 30).unwrap();
    let start = Instant::now();
    let e = Edits::read(&path).unwrap_err();
    assert!(e.to_string().ends_with("file size 1073741824 exceeds the limit of 16777216"), "{e}");
    assert!(start.elapsed() < Duration::from_secs(1));
    assert!(Edits::default().write(dir.path().join("none/a.json")).is_err());
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    for (members, says) in [
        ("", "line 1: these are no edits of lumbre: \"lumbreEdits\": 1 is missing"),
        ("\"lumbreEdits\": 2", "line 1: /lumbreEdits: version 2 is newer than this program, which reads 1"),
        ("\"lumbreEdits\": 0", "line 1: /lumbreEdits: expected 1"),
        ("\"lumbreEdits\": \"1\"", "line 1: /lumbreEdits: expected 1"),
        ("\"camera\": {}", "line 1: these are no edits of lumbre: \"lumbreEdits\": 1 is missing"),
        (
            V,
            "/camra: there is no such key here; there are lumbreEdits, scene, camera, bookmarks, sun, sky, lights",
        ),
        (
            "\"lumbreEdits\": 1,\n\"materials\": {\"a/b\": {\"roughnes\": 1}}",
            "line 2: /materials/a~1b/roughnes: there is no such key here; there are baseColor, metallic, roughness",
        ),
        ("\"lumbreEdits\": 1, \"materials\": []", "line 1: /materials: expected an object {…}"),
        ("\"lumbreEdits\": 1, \"materials\": {\"a\": 1}", "line 1: /materials/a: expected an object {…}"),
        ("\"lumbreEdits\": 1, \"scene\": 1", "line 1: /scene: expected a string"),
        (
            "\"lumbreEdits\": 1, \"sun\": {\"elevation\": \"high\"}",
            "/sun/elevation: expected a number from -90 to 90°",
        ),
        (
            "\"lumbreEdits\": 1, \"sun\": {\"elevation\": 1e99}",
            "/sun/elevation: expected a number from -90 to 90°",
        ),
        ("\"lumbreEdits\": 1, \"sun\": {\"on\": 1}", "/sun/on: expected true or false"),
        ("\"lumbreEdits\": 1, \"sun\": {\"color\": [1, 2]}", "/sun/color: expected a colour [r, g, b]"),
        ("\"lumbreEdits\": 1, \"sun\": {\"color\": [1, 2, -1]}", "each from 0 to 1, not [1, 2, -1]"),
        ("\"lumbreEdits\": 1, \"look\": {\"tone\": \"film\"}", "expected one of \"linear\", \"srgb\""),
        (
            "\"lumbreEdits\": 1, \"look\": {\"exposure\": \"bright\"}",
            "from -100 to 100 EV or \"auto\", \"thesis\"",
        ),
        (
            "\"lumbreEdits\": 1, \"settings\": {\"maxDepth\": 1.5}",
            "/settings/maxDepth: expected a whole number",
        ),
        ("\"lumbreEdits\": 1, \"settings\": {\"seed\": -1}", "/settings/seed: expected a whole number"),
        ("\"lumbreEdits\": 1, \"camera\": {\"aperture\": \"f/0\"}", "/camera/aperture: expected \"f/2.8\""),
        (
            "\"lumbreEdits\": 1, \"camera\": {\"camera\": \"\"}",
            "/camera/camera: expected the name of a camera",
        ),
        (
            "\"lumbreEdits\": 1, \"camera\": {\"eye\": [1,2,3], \"target\": [1,2,3]}",
            "/camera/target: eye and target",
        ),
        ("\"lumbreEdits\": 1, \"bookmarks\": {\"\": {}}", "/bookmarks/: it needs a name"),
        ("\"lumbreEdits\": 1, \"lights\": {\"a\": {}, \"a\": {}}", "line 1: the key \"a\" is there twice"),
        (
            "\"lumbreEdits\": 1, \"nodes\": {\"a\": {\"scale\": [1, null, 1]}}",
            "/nodes/a/scale: expected [x, y, z]",
        ),
    ] {
        let e = Edits::parse(&format!("{{{members}}}")).unwrap_err().to_string();
        assert!(e.contains(says), "{members}\n{e}");
        assert!(!e.contains('\n'));
    }
    assert!(Edits::parse(&" ".repeat(17 << 20)).unwrap_err().to_string().contains("exceed the limit"));
}

/// A document with a key that is wrong.
const V: &str = "\"lumbreEdits\": 1, \"camra\": {}";

#[test]
fn what_the_scene_does_not_have_is_told_with_what_it_has() {
    let base = scene();
    for (members, says) in [
        (
            "\"materials\": {\"rih\": {\"unlit\": true}}",
            "/materials/rih: there is no such material; the scene has rich, plain",
        ),
        (
            "\"materials\": {\"twin\": {\"unlit\": true}}",
            "/materials/twin: 2 materials have this name: twin#2, twin#3",
        ),
        (
            "\"lights\": {\"chair\": {\"on\": false}}",
            "/lights/chair: there is no such light; the scene has bulb, spot, one",
        ),
        ("\"nodes\": {\"#7\": {\"visible\": false}}", "/nodes/#7: there is no such node"),
    ] {
        let edits = Edits::parse(&format!("{{\"lumbreEdits\": 1, {members}}}")).unwrap();
        let e = edits.apply(&base).unwrap_err().to_string();
        assert!(e.starts_with(says), "{e}");
        assert_eq!(
            edits.idle(&base).err().map(|e| e.to_string()),
            edits.apply(&base).err().map(|e| e.to_string())
        );
    }
    // By number, one of two of the same name.
    let text = "{\"lumbreEdits\": 1, \"materials\": {\"twin#3\": {\"roughness\": 0.5}}}";
    let edited = Edits::parse(text).unwrap().apply(&base).unwrap();
    assert_eq!((edited.materials[2].roughness, edited.materials[3].roughness), (1.0, 0.5));
    let mut edits = Edits::default();
    edits.set(&base, Item::Material(MaterialId(3)), "roughness", Value::Number(0.5)).unwrap();
    assert_eq!(edits, Edits::parse(text).unwrap());
}

/// Cuts, turned bits, other digits, pieces moved: whatever it is, it is read or refused with one line, and what is read can be applied or
/// refused.
#[test]
fn damaged_files_do_no_harm() {
    let mut random = Random(5);
    let base = scene();
    let (mut refused, mut unfit, rounds) = (0, 0, 3000);
    for i in 0..rounds {
        let original = if i % 3 == 0 { example() } else { edits(&mut random).to_text() };
        let bytes = damage(original.as_bytes(), &mut random);
        let text = String::from_utf8_lossy(&bytes);
        let start = Instant::now();
        match Edits::parse(&text) {
            Ok(edits) => {
                let again =
                    Edits::parse(&edits.to_text()).expect("what is read is written so that it can be read");
                assert_eq!(again, edits);
                unfit += usize::from(edits.apply(&base).is_err());
            }
            Err(e) => {
                refused += 1;
                assert!(!e.to_string().contains('\n'), "{e}");
            }
        }
        assert!(start.elapsed() < Duration::from_secs(2));
    }
    assert!(
        refused > rounds / 4 && refused < rounds && unfit > 0,
        "{refused} refused, {unfit} unfit of {rounds}"
    );
}

fn damage(original: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = original.to_vec();
    for _ in 0..=random.below(3) {
        if bytes.is_empty() {
            break;
        }
        let at = random.below(bytes.len());
        match random.below(6) {
            0 => bytes[at] ^= 1 << random.below(8),
            1 => bytes.truncate(at),
            2 => bytes[at] = b"{}[]\",:\\u0e-"[random.below(12)],
            3 => {
                let end = bytes.len().min(at + random.below(40));
                let piece = bytes[at..end].to_vec();
                let to = random.below(bytes.len());
                bytes.splice(to..to, piece);
            }
            4 => drop(bytes.drain(at..bytes.len().min(at + random.below(16)))),
            _ => {
                if let Some(digit) = bytes[at..].iter_mut().find(|b| b.is_ascii_digit()) {
                    *digit = b"0123456789-e."[random.below(13)];
                }
            }
        }
    }
    bytes
}

//! Names in OBJ and MTL never lead out of the scene's folder and those that the user named, and are told with their place.

use crate::common::png;
use crate::common::texts::Folder;
use lumbre_io::{ErrorKind, LoadOptions, Loaded, load_scene};
use std::path::{Path, PathBuf};

/// Escapes by every way that a path knows. `ABS` stands for the folder around the scene's.
const ESCAPES: &[&str] = &[
    "../secret.png",
    "../../secret.png",
    "./../secret.png",
    "sub/../../secret.png",
    "sub/../../inside/../secret.png",
    "sub/../far.png",
    "..",
    "../",
    "sub/..",
    ".././secret.png",
    "..\\secret.png",
    "sub\\..\\..\\secret.png",
    ".\\..\\secret.png",
    "\\secret.png",
    "\\\\localhost\\share\\secret.png",
    "//localhost/share/secret.png",
    "ABS/secret.png",
    "/ABS/secret.png",
    "//ABS/secret.png",
    "ABS/inside/../secret.png",
    "/dev/zero",
    "/etc/passwd",
    "file:secret.png",
    "file://ABS/secret.png",
    "FILE:///ABS/secret.png",
    "http://localhost/secret.png",
    "https://localhost/secret.png",
    "ftp://localhost/secret.png",
    "C:\\secret.png",
    "c:/secret.png",
    "C:secret.png",
    "secret.png:stream",
    "data:image/png;base64,iVBORw0KGgo=",
    "near\u{7}.png",
    ".",
    "./",
];

/// Names that are only names: MTL knows no percent code, so these lead nowhere.
const MERE_NAMES: &[&str] = &[
    "%2e%2e/secret.png",
    "..%2fsecret.png",
    "%2e%2e%2fsecret.png",
    "%2fetc%2fpasswd",
    "..%5csecret.png",
    "near.png%00.jpg",
    "~/secret.png",
    "$HOME/secret.png",
];

/// `inside/scene.obj` with its library; `secret.png` and `secret.mtl` lie outside.
fn folder(mtllib: &str, map: &str) -> Folder {
    let obj = format!("mtllib {mtllib}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl m\nf 1/1 2/1 3/1\n");
    let mtl = format!("newmtl m\nKd 0.5 0.5 0.5\n{map}\n");
    let picture = png(1, 1, &[9, 9, 9, 255]);
    Folder::new(&[
        ("inside/scene.obj", obj.as_bytes()),
        ("inside/scene.mtl", mtl.as_bytes()),
        ("inside/near.png", &picture),
        ("inside/sub/deep.png", &picture),
        ("secret.png", &picture),
        ("secret.mtl", b"newmtl m\nKd 1 0 0\n"),
        ("assets/other.png", &picture),
        ("assets/more.mtl", b"newmtl m\nKd 0 1 0\nmap_Ke other.png\n"),
    ])
}

fn load(folder: &Folder, asset_dirs: &[&str]) -> Loaded {
    let asset_dirs = asset_dirs.iter().map(|d| folder.path(d)).collect();
    let options = LoadOptions { asset_dirs, ..LoadOptions::default() };
    load_scene(folder.path("inside/scene.obj"), &options).unwrap_or_else(|e| panic!("{e}"))
}

fn absolute(form: &str, folder: &Path) -> String {
    form.replace("ABS", &folder.display().to_string())
}

#[test]
fn no_map_leads_out() {
    for form in ESCAPES.iter().chain(MERE_NAMES) {
        for key in ["map_Kd", "map_Bump -bm 1", "map_d", "norm"] {
            let f = folder("scene.mtl", "");
            let name = absolute(form, f.0.path());
            f.write("inside/scene.mtl", format!("newmtl m\nKd 0.5 0.5 0.5\n{key} {name}\n").as_bytes());
            let loaded = load(&f, &[]);
            // It draws, without any picture, and says where the name stands.
            assert_eq!(loaded.scene.images.len(), 0, "{name}");
            assert_eq!(loaded.warnings.len(), 1, "{name}: {:?}", loaded.warnings);
            let said = &loaded.warnings[0];
            assert!(said.starts_with("scene.mtl: line 3: ") && !said.contains('\n'), "{name}: {said}");
            assert_eq!(said.contains("refused path"), ESCAPES.contains(form), "{name}: {said}");
        }
    }
}

#[test]
fn no_library_leads_out() {
    for form in ESCAPES.iter().chain(MERE_NAMES) {
        let f = folder("scene.mtl", "");
        let name = absolute(form, f.0.path()).replace(".png", ".mtl");
        let obj = format!("mtllib {name}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n");
        f.write("inside/scene.obj", obj.as_bytes());
        let loaded = load(&f, &[]);
        assert_eq!(loaded.scene.materials[0].base_color.r, 0.6, "{name}");
        let said = &loaded.warnings[0];
        assert!(said.starts_with("line 1: mtllib ") && said.contains("grey"), "{name}: {said}");
    }
}

#[test]
fn a_refused_name_may_be_found_by_its_last_part() {
    for name in
        ["..\\near.png", "C:\\textures\\near.png", "../far/near.png", "/somewhere/near.png", "lost/near.png"]
    {
        let f = folder("scene.mtl", &format!("map_Kd {name}"));
        let loaded = load(&f, &[]);
        assert_eq!(loaded.scene.images.len(), 1, "{name}");
        let said = &loaded.warnings[0];
        assert!(said.starts_with("scene.mtl: line 3: "), "{said}");
        assert!(said.ends_with("inside/near.png is taken instead"), "{said}");
    }
    // Where the scene's folder has none, a named one may.
    let f = folder("scene.mtl", "map_Kd ..\\textures\\other.png");
    assert_eq!(load(&f, &[]).scene.images.len(), 0);
    let loaded = load(&f, &["assets"]);
    assert_eq!(loaded.scene.images.len(), 1);
    assert!(
        loaded.warnings[0].contains("it has a backslash") && loaded.warnings[0].contains("assets/other.png")
    );
}

#[test]
fn named_folders_are_looked_through_in_order() {
    let f = folder("scene.mtl", "map_Kd other.png\nmap_Ke sub/deep.png");
    assert_eq!(load(&f, &[]).scene.images.len(), 1);
    let loaded = load(&f, &["assets"]);
    assert_eq!((loaded.scene.images.len(), loaded.warnings), (2, vec![]));
    // A library found there names pictures beside it.
    let f = folder("more.mtl", "");
    let loaded = load(&f, &["inside/sub", "assets"]);
    assert_eq!((loaded.scene.images.len(), loaded.warnings), (1, vec![]));
    // A folder that is not there is an error of its own.
    let options =
        LoadOptions { asset_dirs: vec![PathBuf::from("/no/such/folder")], ..LoadOptions::default() };
    let e = load_scene(f.path("inside/scene.obj"), &options).unwrap_err();
    assert_eq!(
        (e.kind(), e.to_string().as_str()),
        (ErrorKind::CannotOpen, "/no/such/folder: cannot open: no such file")
    );
    let options = LoadOptions { asset_dirs: vec![f.path("secret.png")], ..LoadOptions::default() };
    let e = load_scene(f.path("inside/scene.obj"), &options).unwrap_err();
    assert_eq!(e.kind(), ErrorKind::CannotOpen);
}

#[test]
fn pictures_lie_beside_their_library() {
    let f = folder("sub/lib.mtl", "");
    f.write("inside/sub/lib.mtl", b"newmtl m\nmap_Kd deep.png\nmap_Ke near.png\n");
    let loaded = load(&f, &[]);
    assert_eq!((loaded.scene.images.len(), loaded.warnings), (2, vec![]));
}

#[cfg(unix)]
#[test]
fn no_link_leads_out_and_no_pipe_is_opened() {
    use std::os::unix::fs::symlink;
    let f = folder(
        "scene.mtl",
        "map_Kd file.png\nmap_Ks dir/secret.png\nmap_Ke device.png\nmap_d pipe.png\nbump loop.png\nnorm fair.png",
    );
    let inside = f.path("inside");
    symlink("../secret.png", inside.join("file.png")).unwrap();
    symlink(f.0.path(), inside.join("dir")).unwrap();
    symlink("/dev/zero", inside.join("device.png")).unwrap();
    symlink("loop.png", inside.join("loop.png")).unwrap();
    symlink("near.png", inside.join("fair.png")).unwrap();
    let made = std::process::Command::new("mkfifo").arg(inside.join("pipe.png")).status();
    let has_pipe = made.is_ok_and(|s| s.success());
    if !has_pipe {
        eprintln!("skipped: there is no mkfifo here");
    }
    let loaded = load(&f, &[]);
    assert_eq!(loaded.scene.images.len(), 1, "only the fair one");
    let said = |line: usize| {
        let start = format!("scene.mtl: line {line}: ");
        loaded
            .warnings
            .iter()
            .find(|w| w.starts_with(&start))
            .unwrap_or_else(|| panic!("{:?}", loaded.warnings))
    };
    for line in [3, 4, 5] {
        assert!(said(line).contains("leads out of the scene's folder through a link"), "{}", said(line));
    }
    assert!(said(6).contains(if has_pipe { "not a regular file" } else { "no such file" }), "{}", said(6));
    assert!(said(7).contains("loop.png: cannot open"), "{}", said(7));
    // A link into a folder that the user named is no way out.
    let loaded = load(&f, &["."]);
    assert!(loaded.warnings.iter().all(|w| !w.contains("file.png")), "{:?}", loaded.warnings);
}

/// Names pieced together from a line of any length, and statements of any number, cost no more than reading them.
#[test]
fn long_and_many_library_statements_are_quick() {
    let start = std::time::Instant::now();
    let words = "x ".repeat(400_000);
    let many: String = (0..50_000).map(|i| format!("mtllib a.mtl {}.mtl\n", i % 2_000)).collect();
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let text = format!("mtllib a.mtl {words}b.mtl\n{many}{triangle}");
    let (_, warnings) = Folder::new(&[("scene.obj", text.as_bytes())]).load("scene.obj");
    assert!(warnings.iter().all(|w| w.len() < 1_000));
    assert!(start.elapsed() < std::time::Duration::from_secs(5), "{:?}", start.elapsed());
}

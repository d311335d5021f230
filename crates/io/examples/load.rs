//! How long a scene takes to load: `cargo run --release -p lumbre-io --example load -- SCENE [TIMES]`. Without a scene it
//! writes an OBJ of a million triangles into the folder for temporary files and loads that.

use lumbre_io::{LoadOptions, load_scene};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Squares along each side of the made surface; two triangles each.
const SIDE: usize = 708;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut args = std::env::args().skip(1);
    let path = match args.next() {
        Some(path) => PathBuf::from(path),
        None => {
            let path = std::env::temp_dir().join("lumbre_million.obj");
            std::fs::write(&path, waves())?;
            path
        }
    };
    let times = args.next().map_or(Ok(5), |n| n.parse())?;
    for _ in 0..times {
        load(&path)?;
    }
    Ok(())
}

fn load(path: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let bytes = std::fs::metadata(path)?.len() as f64;
    let start = Instant::now();
    let loaded = load_scene(path, &LoadOptions::default())?;
    let seconds = start.elapsed().as_secs_f64();
    let primitives = || loaded.scene.meshes.iter().flat_map(|m| &m.primitives);
    let triangles: usize = primitives().map(|p| p.indices.len() / 3).sum();
    let vertices: usize = primitives().map(|p| p.positions.len()).sum();
    println!(
        "{seconds:.3} s: {triangles} triangles, {vertices} vertices, {} images, {:.1} MB of {:.0} MB/s",
        loaded.scene.images.len(),
        bytes * 1e-6,
        bytes * 1e-6 / seconds
    );
    Ok(())
}

/// A wavy surface as exporters write one: positions, texture coordinates, normals, faces with all three.
fn waves() -> String {
    let mut out = String::from("# waves\no waves\n");
    let n = SIDE + 1;
    let at = |i: usize| (i as f32 / SIDE as f32, 12.0 * i as f32 / SIDE as f32);
    for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
        let ((x, a), (z, b)) = (at(i), at(j));
        let _ = writeln!(out, "v {:.6} {:.6} {:.6}", x * 10.0, a.sin() * b.cos() * 0.5, z * 10.0);
    }
    for k in 0..n * n {
        let _ = writeln!(out, "vt {:.6} {:.6}", at(k / n).0, at(k % n).0);
    }
    for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
        let (a, b) = (at(i).1, at(j).1);
        let (x, z) = (-0.6 * a.cos() * b.cos(), 0.6 * a.sin() * b.sin());
        let length = (x * x + z * z + 1.0).sqrt();
        let _ = writeln!(out, "vn {:.4} {:.4} {:.4}", x / length, 1.0 / length, z / length);
    }
    out += "usemtl water_blue\ns 1\n";
    for (i, j) in (0..SIDE * SIDE).map(|k| (k / SIDE, k % SIDE)) {
        let [a, b, c, d] = [(0, 0), (0, 1), (1, 1), (1, 0)].map(|(di, dj)| (i + di) * n + j + dj + 1);
        let _ = writeln!(out, "f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\nf {a}/{a}/{a} {c}/{c}/{c} {d}/{d}/{d}");
    }
    out
}

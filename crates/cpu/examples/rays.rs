//! Measures the bare traversal: `rays MESH.obj RAYDIR [REPS]` builds the tree over the OBJ's triangles (`v` and `f` lines only)
//! and traces the sets `primary`, `diffuse1`, `diffuse3` and `shadow` (the last for any hit) on one thread, at each SIMD level
//! the processor has. A set is a file of rays, eight little-endian floats each: origin, t_min, direction, t_max.
//!
//! Prints the median, least and greatest millions of rays per second of the thread's own time, and the number of hits with the
//! mean `t` to compare with other programs. Compare figures of one run only: machines differ, and so do the hours of a shared one.

use glam::{Affine3A, Vec3};
use lumbre_core::Ray;
use lumbre_cpu::bvh::{Blas, InstanceDesc, SimdLevel, Tlas};
use std::sync::Arc;
use std::time::Instant;

type Mesh = (Vec<Vec3>, Vec<[u32; 3]>);

fn load_obj(path: &str) -> Mesh {
    let text = std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || words.next().and_then(|w| w.parse().ok()).expect("v x y z");
                positions.push(Vec3::new(next(), next(), next()));
            }
            Some("f") => {
                let mut next = || {
                    let word = words.next().and_then(|w| w.split('/').next());
                    word.and_then(|w| w.parse::<u32>().ok()).expect("f i j k") - 1
                };
                triangles.push([next(), next(), next()]);
            }
            _ => {}
        }
    }
    (positions, triangles)
}

fn load_rays(path: &str) -> Vec<Ray> {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let ray = |chunk: &[u8]| {
        let f = |i: usize| f32::from_le_bytes(chunk[4 * i..4 * i + 4].try_into().expect("four bytes"));
        Ray {
            origin: Vec3::new(f(0), f(1), f(2)),
            dir: Vec3::new(f(4), f(5), f(6)),
            t_min: f(3),
            t_max: f(7),
            time: 0.0,
        }
    };
    bytes.chunks_exact(32).map(ray).collect()
}

/// Seconds this thread has run: on Linux without the time others held its core.
fn thread_seconds(start: Instant) -> f64 {
    let stat = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let ns = stat.and_then(|s| s.split_ascii_whitespace().next().and_then(|w| w.parse::<f64>().ok()));
    ns.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

/// Runs `trace` (`t`, or infinity on a miss) over the rays `reps` times and prints a line.
fn measure(name: &str, rays: &[Ray], reps: usize, trace: impl Fn(&Ray) -> f32) {
    let mut rates = Vec::new();
    let (mut hits, mut sum) = (0, 0.0);
    let epoch = Instant::now();
    for _ in 0..reps {
        (hits, sum) = (0, 0.0);
        let start = thread_seconds(epoch);
        for ray in rays {
            let t = trace(ray);
            if t < 1e29 {
                hits += 1;
                sum += f64::from(t);
            }
        }
        rates.push(rays.len() as f64 / (thread_seconds(epoch) - start) / 1e6);
    }
    rates.sort_by(f64::total_cmp);
    println!(
        "  {name:<10} {:7.3} [{:.3}-{:.3}]  hits {hits} mean_t {:.5}",
        rates[reps / 2],
        rates[0],
        rates[reps - 1],
        sum / f64::from(hits.max(1))
    );
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [mesh, dir, rest @ ..] = &args[..] else { panic!("usage: rays MESH.obj RAYDIR [REPS [LEVEL]]") };
    let reps: usize = rest.first().map_or(3, |r| r.parse().expect("REPS"));
    let only = rest.get(1).map(|l| SimdLevel::parse(l).expect("LEVEL"));
    let (positions, triangles) = load_obj(mesh);

    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool of one thread");
    let epoch = Instant::now();
    let mut times = Vec::new();
    let mut blas = None;
    for _ in 0..reps.max(3) {
        let (built, seconds) = pool.install(|| {
            let start = thread_seconds(epoch);
            let blas = Blas::build(&positions, &triangles);
            (blas, thread_seconds(epoch) - start)
        });
        blas = Some(built);
        times.push(seconds * 1e3);
    }
    times.sort_by(f64::total_cmp);
    let blas = Arc::new(blas.expect("built at least once"));
    println!(
        "triangles {}  build {:.1} ms [{:.1}-{:.1}]  {:.1} MB  one thread, Mrays/s: median [min-max]",
        blas.triangle_count(),
        times[times.len() / 2],
        times[0],
        times[times.len() - 1],
        blas.memory() as f64 / 1e6
    );
    let tlas = Tlas::build(&[InstanceDesc::new(0, Affine3A::IDENTITY)], vec![blas]);
    let sets: Vec<Vec<Ray>> = ["primary", "diffuse1", "diffuse3", "shadow"]
        .iter()
        .map(|s| load_rays(&format!("{dir}/{s}.rays")))
        .collect();
    for level in SimdLevel::ALL.into_iter().filter(|&l| l.is_supported() && only.is_none_or(|o| o == l)) {
        let tlas = tlas.clone().with_level(level);
        println!("{}", level.name());
        for (name, rays) in ["primary", "diffuse1", "diffuse3"].iter().zip(&sets) {
            measure(name, rays, reps, |r| tlas.closest_hit(r, |_| true).map_or(f32::INFINITY, |h| h.t));
        }
        measure("shadow", &sets[3], reps, |r| if tlas.any_hit(r, |_| true) { 1.0 } else { f32::INFINITY });
    }
}

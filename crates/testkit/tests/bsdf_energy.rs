//! White furnace of every surface model, bounded on both sides.

use lumbre_core::Spectrum;
use lumbre_core::bsdf::{Bsdf, BsdfParams};
use lumbre_testkit::bsdf_rows;
use lumbre_testkit::furnace::{direction, furnace};

const COSINES: [f32; 6] = [1.0, 0.8, 0.5, 0.2, 0.05, 0.003];
const ROUGHNESSES: [f32; 8] = [0.0, 0.0317, 0.05, 0.15, 0.3, 0.5, 0.75, 1.0];

#[test]
fn scan() {
    for (name, f) in [
        ("metal", (|p: &mut BsdfParams| p.metallic = 1.0) as fn(&mut BsdfParams)),
        ("base", |_| ()),
        ("base ior2.4", |p| p.ior = 2.4),
        ("thin", |p| p.transmission = 1.0),
        ("solid", |p| {
            p.transmission = 1.0;
            p.thin = false
        }),
        ("solid in", |p| {
            p.transmission = 1.0;
            p.thin = false;
            p.eta = 1.0 / 1.5
        }),
        ("mix", |p| {
            p.metallic = 0.3;
            p.transmission = 0.5
        }),
    ] {
        for r in ROUGHNESSES {
            let mut p = BsdfParams { roughness: r, base_color: Spectrum::WHITE, ..Default::default() };
            f(&mut p);
            let b = Bsdf::new(&p);
            let v: Vec<String> = COSINES
                .iter()
                .map(|&c| {
                    let f = furnace(&b, direction(c, 0.4), 16384);
                    format!("{:.4} ({:.1})", f.total[0], f.largest)
                })
                .collect();
            println!("{name:12} {r:.3} {}", v.join("  "));
        }
    }
    let _ = bsdf_rows::all();
    println!("size {}", std::mem::size_of::<Bsdf>());
}

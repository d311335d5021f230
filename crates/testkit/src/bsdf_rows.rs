//! The table of surfaces that every BSDF test walks: one row per model and choice of parameters.

use lumbre_core::Spectrum;
use lumbre_core::bsdf::{
    Bsdf, BsdfParams, CoatParams, DiffuseSampling, FilmParams, GlossParams, SheenParams,
};
use lumbre_core::math::Vec3;

/// One surface under test.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// What failures call it.
    pub name: &'static str,
    /// Its parameters.
    pub params: BsdfParams,
}

impl Row {
    /// The surface.
    pub fn bsdf(&self) -> Bsdf {
        Bsdf::new(&self.params)
    }
    /// The surface seen from its other side, all axes turned: solids have the inverse index there, and no layers.
    pub fn from_behind(&self) -> Bsdf {
        Bsdf::new(&BsdfParams { eta: 1.0 / self.params.eta, inside: !self.params.inside, ..self.params })
    }
    /// Width of the microfacets.
    pub fn alpha(&self) -> f32 {
        self.params.roughness * self.params.roughness
    }
    /// True when the coat has a normal of its own: cosines to two normals are not reciprocal.
    pub fn is_tilted(&self) -> bool {
        self.params.coat.is_some_and(|c| c.normal != Vec3::Z)
    }
    /// True for the boundary of a solid that transmits.
    pub fn refracts(&self) -> bool {
        let transmits = self.params.transmission > 0.0 || self.params.diffuse_transmission > 0.0;
        transmits && self.params.metallic < 1.0 && !self.params.thin
    }
}

/// A coloured base.
const OCHRE: Spectrum = Spectrum::new(0.8, 0.45, 0.1);

fn row(name: &'static str, change: impl Fn(&mut BsdfParams)) -> Row {
    let mut params = BsdfParams { base_color: OCHRE, ..BsdfParams::default() };
    change(&mut params);
    Row { name, params }
}

/// Metals, mirrors included.
pub fn metals() -> Vec<Row> {
    let metal = |name, roughness: f32| {
        row(name, move |p| {
            p.metallic = 1.0;
            p.roughness = roughness;
        })
    };
    vec![
        metal("metal mirror", 0.0),
        // α is the smallest that counts as rough.
        metal("metal smallest alpha", 0.0317),
        metal("metal 0.1", 0.1),
        metal("metal 0.3", 0.3),
        metal("metal 0.6", 0.6),
        metal("metal 1.0", 1.0),
    ]
}

/// Opaque dielectrics.
pub fn bases() -> Vec<Row> {
    let base = |name, roughness: f32| row(name, move |p| p.roughness = roughness);
    vec![
        row("lambert", |p| p.specular = 0.0),
        row("lambert uniform", |p| {
            p.specular = 0.0;
            p.diffuse_sampling = DiffuseSampling::Uniform;
        }),
        base("plastic mirror", 0.0),
        base("plastic 0.1", 0.1),
        base("plastic 0.4", 0.4),
        base("plastic 1.0", 1.0),
        row("plastic uniform", |p| {
            p.roughness = 0.5;
            p.diffuse_sampling = DiffuseSampling::Uniform;
        }),
        row("tinted specular", |p| {
            p.roughness = 0.5;
            p.ior = 2.4;
            p.specular_color = Spectrum::new(0.2, 1.0, 9.0);
        }),
        row("weak specular", |p| {
            p.roughness = 0.7;
            p.specular = 0.3;
        }),
        row("black plastic", |p| {
            p.roughness = 0.35;
            p.base_color = Spectrum::BLACK;
        }),
        row("total specular", |p| {
            p.roughness = 0.6;
            p.ior = 0.0;
        }),
    ]
}

/// Boundaries of solids, from both sides, and thin walls.
pub fn transmissive() -> Vec<Row> {
    let solid = |name, roughness: f32, eta: f32| {
        row(name, move |p| {
            p.transmission = 1.0;
            p.thin = false;
            p.roughness = roughness;
            p.eta = eta;
        })
    };
    let thin = |name, roughness: f32| {
        row(name, move |p| {
            p.transmission = 1.0;
            p.roughness = roughness;
        })
    };
    vec![
        solid("glass", 0.0, 1.5),
        solid("glass from inside", 0.0, 1.0 / 1.5),
        solid("index matched", 0.0, 1.0),
        solid("index matched rough", 0.7, 1.0),
        solid("rough glass 0.1", 0.1, 1.5),
        solid("rough glass 0.4", 0.4, 1.5),
        solid("rough glass 1.0", 1.0, 1.5),
        solid("rough glass 0.4 from inside", 0.4, 1.0 / 1.5),
        solid("rough glass 1.0 from inside", 1.0, 1.0 / 1.5),
        solid("rough diamond 0.5", 0.5, 2.417),
        solid("rough water to glass 0.5", 0.5, 1.5 / 1.33),
        solid("rough, nearly matched", 0.8, 1.02),
        thin("thin", 0.0),
        thin("thin 0.1", 0.1),
        thin("thin 0.5", 0.5),
        thin("thin 1.0", 1.0),
    ]
}

/// Rough and transmitting diffuse bases, bare and under an interface.
pub fn diffuse() -> Vec<Row> {
    let rough = |name, diffuse_roughness: f32, specular: f32| {
        row(name, move |p| {
            p.diffuse_roughness = diffuse_roughness;
            p.specular = specular;
            p.roughness = 0.5;
        })
    };
    let leaf = |name, share: f32, specular: f32, diffuse_roughness: f32| {
        row(name, move |p| {
            p.diffuse_transmission = share;
            p.diffuse_transmission_color = Spectrum::new(0.3, 0.9, 0.2);
            p.diffuse_roughness = diffuse_roughness;
            p.specular = specular;
            p.roughness = 0.4;
        })
    };
    vec![
        rough("rough diffuse 0.3", 0.3, 0.0),
        rough("rough diffuse 1.0", 1.0, 0.0),
        rough("rough diffuse under an interface", 0.8, 1.0),
        row("rough diffuse uniform", |p| {
            p.diffuse_roughness = 0.6;
            p.specular = 0.0;
            p.diffuse_sampling = DiffuseSampling::Uniform;
        }),
        leaf("leaf, bare", 0.4, 0.0, 0.0),
        leaf("leaf, all transmitted", 1.0, 0.0, 0.0),
        leaf("leaf under an interface", 0.6, 1.0, 0.0),
        leaf("leaf, rough", 0.5, 0.0, 0.7),
        row("leaf with a smooth interface", |p| {
            p.diffuse_transmission = 0.5;
            p.roughness = 0.0;
        }),
        row("wax", |p| {
            p.diffuse_transmission = 0.7;
            p.thin = false;
            p.roughness = 0.5;
        }),
        row("wax from inside", |p| {
            p.diffuse_transmission = 0.7;
            p.thin = false;
            p.eta = 1.0 / 1.4;
            p.specular = 0.0;
        }),
        row("wax mixed with glass", |p| {
            p.diffuse_transmission = 0.7;
            p.transmission = 0.5;
            p.thin = false;
            p.roughness = 0.5;
        }),
    ]
}

/// The gloss of MTL materials.
pub fn gloss() -> Vec<Row> {
    let gloss = |name, exponent: f32, fresnel: bool| {
        row(name, move |p| {
            p.base_color = Spectrum::new(0.4, 0.3, 0.1);
            let specular = Spectrum::new(0.2, 0.5, 0.6);
            p.gloss = Some(GlossParams { specular, exponent, fresnel });
        })
    };
    vec![
        gloss("phong 0", 0.0, false),
        gloss("phong 0.4", 0.4, false),
        gloss("phong 5", 5.0, false),
        gloss("phong 60", 60.0, false),
        gloss("phong 400 with fresnel", 400.0, true),
        gloss("phong 8 with fresnel", 8.0, true),
        gloss("phong mirror", f32::INFINITY, false),
        gloss("phong mirror with fresnel", f32::INFINITY, true),
        row("phong too bright", |p| {
            p.gloss = Some(GlossParams { specular: Spectrum::WHITE, exponent: 30.0, fresnel: false });
        }),
        row("phong on a rough leaf", |p| {
            p.diffuse_roughness = 0.5;
            p.diffuse_transmission = 0.5;
            p.gloss = Some(GlossParams { specular: Spectrum::splat(0.3), exponent: 20.0, fresnel: true });
        }),
    ]
}

/// Mixtures of the models above.
pub fn mixtures() -> Vec<Row> {
    let mixed = |name, metallic: f32, transmission: f32, thin: bool, roughness: f32| {
        row(name, move |p| {
            p.metallic = metallic;
            p.transmission = transmission;
            p.thin = thin;
            p.roughness = roughness;
        })
    };
    vec![
        mixed("half metal", 0.5, 0.0, true, 0.4),
        mixed("half metal mirror", 0.5, 0.0, true, 0.0),
        mixed("half glass", 0.0, 0.5, false, 0.3),
        mixed("half glass smooth", 0.0, 0.5, false, 0.0),
        mixed("half thin smooth", 0.0, 0.5, true, 0.0),
        mixed("all three", 0.3, 0.6, false, 0.5),
        mixed("all three thin", 0.3, 0.6, true, 0.5),
        mixed("all three smooth", 0.3, 0.6, false, 0.0),
        row("metal and a rough leaf", |p| {
            p.metallic = 0.4;
            p.diffuse_transmission = 0.5;
            p.diffuse_roughness = 0.6;
            p.roughness = 0.4;
        }),
        row("metal on lambert", |p| {
            p.metallic = 0.2;
            p.specular = 0.0;
            p.roughness = 0.5;
        }),
    ]
}

/// Varnish of this roughness over the surface.
pub fn coat(roughness: f32) -> Option<CoatParams> {
    Some(CoatParams { factor: 1.0, roughness, normal: Vec3::Z })
}

/// White fibres of this roughness over the surface.
pub fn sheen(roughness: f32) -> Option<SheenParams> {
    Some(SheenParams { color: Spectrum::WHITE, roughness })
}

fn solid(p: &mut BsdfParams, roughness: f32, inside: bool) {
    p.transmission = 1.0;
    p.roughness = roughness;
    p.thin = false;
    p.inside = inside;
    p.eta = if inside { 1.0 / 1.5 } else { 1.5 };
}

fn metal(p: &mut BsdfParams, roughness: f32) {
    p.metallic = 1.0;
    p.roughness = roughness;
}

fn lambert(p: &mut BsdfParams) {
    p.specular = 0.0;
}

fn thin(p: &mut BsdfParams, roughness: f32) {
    p.transmission = 1.0;
    p.roughness = roughness;
}

/// Varnish over everything.
pub fn coats() -> Vec<Row> {
    let coated = |name, roughness: f32, base: &dyn Fn(&mut BsdfParams)| {
        row(name, |p| {
            base(p);
            p.coat = coat(roughness);
        })
    };
    vec![
        coated("smooth coat on mirror", 0.0, &|p| metal(p, 0.0)),
        coated("coat 0.3 on mirror", 0.3, &|p| metal(p, 0.0)),
        coated("smooth coat on metal 0.4", 0.0, &|p| metal(p, 0.4)),
        coated("coat 0.1 on metal 0.1", 0.1, &|p| metal(p, 0.1)),
        coated("coat 0.4 on plastic 0.4", 0.4, &|p| p.roughness = 0.4),
        coated("smooth coat on plastic mirror", 0.0, &|p| p.roughness = 0.0),
        coated("smooth coat on lambert", 0.0, &lambert),
        coated("coat 0.3 on lambert", 0.3, &lambert),
        coated("coat 1.0 on lambert", 1.0, &lambert),
        coated("smooth coat on glass", 0.0, &|p| solid(p, 0.0, false)),
        coated("coat 0.4 on glass", 0.4, &|p| solid(p, 0.0, false)),
        coated("coat 0.4 on glass from inside", 0.4, &|p| solid(p, 0.0, true)),
        coated("coat 0.6 on rough glass 0.4", 0.6, &|p| solid(p, 0.4, false)),
        coated("coat 0.6 on rough glass 0.4 from inside", 0.6, &|p| solid(p, 0.4, true)),
        coated("smooth coat on thin", 0.0, &|p| thin(p, 0.0)),
        coated("coat 0.5 on thin 0.5", 0.5, &|p| thin(p, 0.5)),
        row("half coat 0.3 on lambert", |p| {
            lambert(p);
            p.coat = Some(CoatParams { factor: 0.5, roughness: 0.3, normal: Vec3::Z });
        }),
    ]
}

/// Varnish with a normal of its own.
pub fn tilted_coats() -> Vec<Row> {
    let tilted = |name, roughness: f32, base: &dyn Fn(&mut BsdfParams)| {
        row(name, |p| {
            base(p);
            let normal = Vec3::new(0.3, -0.2, 0.9).normalize();
            p.coat = Some(CoatParams { factor: 0.8, roughness, normal });
        })
    };
    vec![
        tilted("tilted coat 0.3 on plastic 0.4", 0.3, &|p| p.roughness = 0.4),
        tilted("tilted smooth coat on metal 0.5", 0.0, &|p| metal(p, 0.5)),
        tilted("tilted coat 0.5 on thin", 0.5, &|p| thin(p, 0.0)),
        tilted("tilted coat 0.5 on glass", 0.5, &|p| solid(p, 0.0, false)),
    ]
}

/// Fibres over everything, and varnish over fibres.
pub fn sheens() -> Vec<Row> {
    let sheened = |name, roughness: f32, base: &dyn Fn(&mut BsdfParams)| {
        row(name, |p| {
            base(p);
            p.sheen = sheen(roughness);
        })
    };
    vec![
        sheened("sheen 0.05 on lambert", 0.05, &lambert),
        sheened("sheen 0.1 on lambert", 0.1, &lambert),
        sheened("sheen 0.3 on lambert", 0.3, &lambert),
        sheened("sheen 0.6 on lambert", 0.6, &lambert),
        sheened("sheen 1.0 on lambert", 1.0, &lambert),
        sheened("sheen 0.2 on black", 0.2, &|p| {
            lambert(p);
            p.base_color = Spectrum::BLACK;
        }),
        sheened("sheen 0.4 on mirror", 0.4, &|p| metal(p, 0.0)),
        sheened("sheen 0.4 on metal 0.4", 0.4, &|p| metal(p, 0.4)),
        sheened("sheen 0.5 on rough glass 0.5", 0.5, &|p| solid(p, 0.5, false)),
        sheened("sheen 0.5 on glass from inside", 0.5, &|p| solid(p, 0.0, true)),
        sheened("sheen 0.5 on thin", 0.5, &|p| thin(p, 0.0)),
        row("coloured sheen 0.3 on plastic 0.8", |p| {
            p.roughness = 0.8;
            p.sheen = Some(SheenParams { color: Spectrum::new(0.9, 0.3, 0.05), roughness: 0.3 });
        }),
        row("smooth coat on sheen 0.5 on plastic 0.5", |p| {
            p.roughness = 0.5;
            p.sheen = sheen(0.5);
            p.coat = coat(0.0);
        }),
        row("coat 0.4 on sheen 0.2 on metal and glass", |p| {
            solid(p, 0.3, false);
            p.metallic = 0.5;
            p.sheen = Some(SheenParams { color: Spectrum::new(0.2, 0.5, 0.7), roughness: 0.2 });
            p.coat = coat(0.4);
        }),
    ]
}

/// Every row with layers.
pub fn layered() -> Vec<Row> {
    [coats(), tilted_coats(), sheens()].concat()
}

/// Facets of two widths.
pub fn anisotropic() -> Vec<Row> {
    let stretched = |name, strength: f32, roughness: f32, change: fn(&mut BsdfParams)| {
        row(name, move |p| {
            p.anisotropy = strength;
            p.roughness = roughness;
            change(p);
        })
    };
    let metal = |p: &mut BsdfParams| p.metallic = 1.0;
    let thin = |p: &mut BsdfParams| p.transmission = 1.0;
    let glass = |p: &mut BsdfParams| {
        p.transmission = 1.0;
        p.thin = false;
    };
    let from_inside = |p: &mut BsdfParams| {
        p.transmission = 1.0;
        p.thin = false;
        p.eta = 1.0 / 1.5;
    };
    vec![
        stretched("brushed metal, weak", 0.3, 0.3, metal),
        stretched("brushed metal", 0.6, 0.4, metal),
        stretched("brushed metal, full", 1.0, 0.2, metal),
        stretched("brushed metal, full, fine", 1.0, 0.08, metal),
        stretched("brushed mirror", 0.5, 0.0, metal),
        stretched("mirror, hardly brushed", 0.03, 0.0, metal),
        stretched("brushed rough metal", 0.7, 0.9, metal),
        stretched("brushed plastic", 0.5, 0.3, |_| ()),
        stretched("brushed plastic, full", 1.0, 0.15, |_| ()),
        stretched("brushed plastic, rough", 0.8, 0.7, |p| p.ior = 2.0),
        stretched("brushed glass", 0.6, 0.3, glass),
        stretched("brushed glass, full", 1.0, 0.2, glass),
        stretched("brushed glass from inside", 0.6, 0.3, from_inside),
        stretched("brushed glass, nearly matched", 1.0, 0.15, |p| {
            p.transmission = 1.0;
            p.thin = false;
            p.eta = 1.1;
        }),
        stretched("brushed thin", 0.6, 0.3, thin),
        stretched("brushed thin, full", 1.0, 0.2, thin),
        stretched("brushed half metal", 0.7, 0.3, |p| p.metallic = 0.5),
    ]
}

/// Interfaces under a thin film.
pub fn films() -> Vec<Row> {
    let film = |name, [factor, ior, thickness_nm]: [f32; 3], roughness: f32, change: fn(&mut BsdfParams)| {
        row(name, move |p| {
            p.film = Some(FilmParams { factor, ior, thickness_nm });
            p.roughness = roughness;
            change(p);
        })
    };
    let metal = |p: &mut BsdfParams| p.metallic = 1.0;
    let thin = |p: &mut BsdfParams| p.transmission = 1.0;
    let glass = |p: &mut BsdfParams| {
        p.transmission = 1.0;
        p.thin = false;
    };
    let from_inside = |p: &mut BsdfParams| {
        p.transmission = 1.0;
        p.thin = false;
        p.eta = 1.0 / 1.5;
    };
    vec![
        film("film on mirror", [1.0, 1.8, 400.0], 0.0, metal),
        film("film on metal", [1.0, 1.8, 400.0], 0.4, metal),
        film("thick film on rough metal", [1.0, 1.33, 1200.0], 0.8, metal),
        film("half film on metal", [0.5, 2.4, 150.0], 0.2, metal),
        film("film on smooth plastic", [1.0, 1.33, 300.0], 0.0, |_| ()),
        film("film on plastic", [1.0, 1.8, 400.0], 0.4, |_| ()),
        film("strong film on rough plastic", [1.0, 2.4, 550.0], 0.8, |_| ()),
        film("film on weak plastic", [0.7, 2.0, 250.0], 0.3, |p| p.specular = 0.5),
        film("film on glass", [1.0, 1.33, 300.0], 0.0, glass),
        film("film on rough glass", [1.0, 2.0, 450.0], 0.4, glass),
        film("film on glass from inside", [1.0, 2.0, 450.0], 0.0, from_inside),
        film("film on rough glass from inside", [1.0, 2.0, 450.0], 0.4, from_inside),
        film("soap bubble", [1.0, 1.33, 380.0], 0.0, |p| {
            p.transmission = 1.0;
            p.ior = 1.0;
        }),
        film("film on thin", [1.0, 1.8, 350.0], 0.0, thin),
        film("film on rough thin", [1.0, 1.8, 350.0], 0.5, thin),
        film("film on brushed plastic", [1.0, 1.8, 400.0], 0.3, |p| p.anisotropy = 0.7),
        film("film on all three", [0.8, 1.6, 500.0], 0.5, |p| {
            p.metallic = 0.3;
            p.transmission = 0.6;
            p.thin = false;
        }),
    ]
}

/// Every row.
pub fn all() -> Vec<Row> {
    [metals(), bases(), diffuse(), gloss(), transmissive(), mixtures(), layered(), anisotropic(), films()]
        .concat()
}

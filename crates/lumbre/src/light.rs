//! What in a scene gives light.

use lumbre_core::Rgb;
use lumbre_scene::{Background, Environment, LightId, Material, MeshId, Scene};

/// Which kinds of light a scene has. Of surfaces and punctual lights those count that a root reaches and that are not
/// hidden.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LightKinds {
    /// A background that is not black, or a sun.
    pub distant: bool,
    /// A punctual light.
    pub punctual: bool,
    /// A surface that emits.
    pub emissive: bool,
    /// A surface that shows itself but lights nothing.
    pub unlit: bool,
}

impl LightKinds {
    /// Whether anything lights the scene; unlit surfaces do not.
    pub fn any(self) -> bool {
        self.distant || self.punctual || self.emissive
    }

    /// Whether emissive surfaces are all that lights the scene.
    pub fn only_emissive(self) -> bool {
        self.emissive && !self.distant && !self.punctual
    }
}

/// Finds the kinds of light of a scene.
pub fn light_kinds(scene: &Scene) -> LightKinds {
    let mut kinds = LightKinds { distant: environment_shines(&scene.environment), ..LightKinds::default() };
    for placed in scene.placed_nodes().into_iter().filter(|n| n.visible) {
        let node = &scene.nodes[placed.id.index()];
        kinds.punctual |= node.light.is_some_and(|l| light_shines(scene, l));
        for material in node.mesh.into_iter().flat_map(|m| materials(scene, m)) {
            kinds.unlit |= material.unlit;
            kinds.emissive |= !material.unlit && shines(material.emission);
        }
    }
    kinds
}

fn shines(c: Rgb) -> bool {
    c.max_component() > 0.0
}

fn environment_shines(environment: &Environment) -> bool {
    let background = match &environment.background {
        Background::Black => false,
        Background::Constant(c) => shines(*c),
        Background::Gradient => true,
        Background::Map(map) => map.pixels.iter().any(|p| shines(*p)),
    };
    (background && environment.strength > 0.0) || environment.sun.is_some_and(|s| shines(s.irradiance))
}

fn light_shines(scene: &Scene, light: LightId) -> bool {
    scene.lights.get(light.index()).is_some_and(|l| shines(l.intensity))
}

fn materials(scene: &Scene, mesh: MeshId) -> impl Iterator<Item = &Material> {
    let primitives = scene.meshes.get(mesh.index()).into_iter().flat_map(|m| &m.primitives);
    primitives.filter_map(|p| scene.materials.get(p.material?.index()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_scene::{Light, LightKind, Mesh, Node, Primitive, Sun};

    fn has_light(scene: &Scene) -> bool {
        light_kinds(scene).any()
    }

    #[test]
    fn every_kind_of_light_counts_and_nothing_else() {
        let mut scene = Scene::default();
        assert!(!has_light(&scene));
        scene.environment.background = Background::Constant(Rgb::BLACK);
        assert!(!has_light(&scene), "a black sky is no light");
        scene.environment.background = Background::Gradient;
        assert!(has_light(&scene));
        scene.environment.strength = 0.0;
        assert!(!has_light(&scene));
        let irradiance = Rgb::WHITE;
        scene.environment.sun = Some(Sun { elevation: 1.0, azimuth: 0.0, irradiance, angular_radius: 0.005 });
        assert!(has_light(&scene));
    }

    #[test]
    fn only_what_a_root_reaches_counts() {
        let light = Light { name: String::new(), kind: LightKind::Point, intensity: Rgb::WHITE };
        let node = Node { light: Some(LightId(0)), ..Node::default() };
        let mut scene = Scene { lights: vec![light], nodes: vec![node.clone()], ..Scene::default() };
        assert!(!has_light(&scene), "no root reaches the node");
        scene.add_root(node);
        assert_eq!(light_kinds(&scene), LightKinds { punctual: true, ..LightKinds::default() });
        scene.nodes[1].visible = false;
        assert!(!has_light(&scene), "it is hidden");
    }

    #[test]
    fn unlit_surfaces_light_nothing() {
        let mut scene = Scene::default();
        let mut material = Material { emission: Rgb::WHITE, unlit: true, ..Material::default() };
        let id = scene.add_material(material.clone());
        let primitive = Primitive { material: Some(id), ..Primitive::default() };
        let mesh = scene.add_mesh(Mesh { name: String::new(), primitives: vec![primitive] });
        scene.add_root(Node { mesh: Some(mesh), ..Node::default() });
        assert_eq!(light_kinds(&scene), LightKinds { unlit: true, ..LightKinds::default() });
        assert!(!has_light(&scene));
        material.unlit = false;
        scene.materials[0] = material;
        assert_eq!(light_kinds(&scene), LightKinds { emissive: true, ..LightKinds::default() });
        assert!(has_light(&scene) && light_kinds(&scene).only_emissive());
        scene.environment.background = Background::Gradient;
        assert!(!light_kinds(&scene).only_emissive());
    }
}

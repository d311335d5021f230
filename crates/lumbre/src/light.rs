//! Whether anything in a scene gives light.

use lumbre_core::Rgb;
use lumbre_scene::{Background, Environment, Scene};

/// Whether a scene has a light that shines: an emissive surface or a punctual light that a root reaches, a sun, or a
/// background that is not black. Unlit surfaces show themselves but light nothing, so they do not count.
pub fn has_light(scene: &Scene) -> bool {
    environment_shines(&scene.environment)
        || scene.world_nodes().iter().any(|(id, _)| node_shines(scene, id.index()))
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

fn node_shines(scene: &Scene, node: usize) -> bool {
    let node = &scene.nodes[node];
    let light = node.light.and_then(|l| scene.lights.get(l.index()));
    let mesh = node.mesh.and_then(|m| scene.meshes.get(m.index()));
    let mut materials = mesh.into_iter().flat_map(|m| &m.primitives).filter_map(|p| p.material);
    light.is_some_and(|l| shines(l.intensity))
        || materials.any(|m| scene.materials.get(m.index()).is_some_and(|m| shines(m.emission) && !m.unlit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_scene::{Light, LightId, LightKind, Material, Mesh, Node, Primitive, Sun};

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
        assert!(has_light(&scene));
    }

    #[test]
    fn unlit_surfaces_light_nothing() {
        let mut scene = Scene::default();
        let mut material = Material { emission: Rgb::WHITE, unlit: true, ..Material::default() };
        let id = scene.add_material(material.clone());
        let primitive = Primitive { material: Some(id), ..Primitive::default() };
        let mesh = scene.add_mesh(Mesh { name: String::new(), primitives: vec![primitive] });
        scene.add_root(Node { mesh: Some(mesh), ..Node::default() });
        assert!(!has_light(&scene));
        material.unlit = false;
        scene.materials[0] = material;
        assert!(has_light(&scene));
    }
}

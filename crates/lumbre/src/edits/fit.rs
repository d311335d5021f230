//! What of the edits a scene takes, for scenes whose files change while they are edited.

use super::apply::{LIGHTS_KEY, MATERIALS_KEY, NODES_KEY};
use super::error::under;
use super::names::{Named as Kind, Names};
use super::{Edits, EditsError};
use lumbre_scene::Scene;

impl Edits {
    /// What of them decides the scene: neither camera and bookmarks nor settings and look.
    pub fn of_scene(&self) -> Edits {
        Edits {
            scene: String::new(),
            camera: Default::default(),
            bookmarks: Vec::new(),
            settings: Default::default(),
            look: Default::default(),
            ..self.clone()
        }
    }

    /// The same camera, bookmarks, settings and look; what decides the scene from others.
    #[must_use]
    pub fn with_scene_of(&self, others: &Edits) -> Edits {
        let Edits { scene, camera, bookmarks, settings, look, .. } = self.clone();
        Edits { scene, camera, bookmarks, settings, look, ..others.clone() }
    }

    /// Takes out what is said of materials, nodes and lights that the scene does not have, and says of each why.
    pub fn fit(&mut self, base: &Scene) -> Vec<EditsError> {
        let mut out = Vec::new();
        for (kind, all, member) in [
            (Kind::Nodes, &mut self.nodes, NODES_KEY),
            (Kind::Lights, &mut self.lights, LIGHTS_KEY),
            (Kind::Materials, &mut self.materials, MATERIALS_KEY),
        ] {
            let mut found = Names::of(base, kind).find(all.keys().map(|key| &**key)).into_iter();
            // Both go through the keys in their order.
            all.retain(|_, _| match found.next() {
                Some(Err(e)) => {
                    out.push(e.under(&under("", member)));
                    false
                }
                _ => true,
            });
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edits::{Item, Value};
    use lumbre_scene::{Material, MaterialId, Node, NodeId};

    fn scene(materials: &[&str]) -> Scene {
        let mut scene = Scene::default();
        for name in materials {
            scene.add_material(Material { name: name.to_string(), ..Material::default() });
        }
        scene.nodes.push(Node { name: "table".into(), ..Node::default() });
        scene
    }

    #[test]
    fn what_is_gone_is_taken_out_and_the_rest_stays() {
        let before = scene(&["brick", "wood"]);
        let mut edits = Edits::default();
        edits.set(&before, Item::Material(MaterialId(0)), "roughness", Value::Number(0.25)).unwrap();
        edits.set(&before, Item::Material(MaterialId(1)), "roughness", Value::Number(0.5)).unwrap();
        edits.set(&before, Item::Node(NodeId(0)), "visible", Value::Flag(false)).unwrap();
        edits.set(&before, Item::Settings, "maxDepth", Value::Whole(3)).unwrap();
        edits.add_light("lamp");
        let whole = edits.clone();
        assert!(edits.fit(&before).is_empty() && edits == whole);

        let after = scene(&["wood", "stone"]);
        assert!(edits.apply(&after).is_err());
        let gone = edits.fit(&after);
        assert_eq!(gone.len(), 1);
        assert!(gone[0].to_string().contains("brick"), "{}", gone[0]);
        let applied = edits.apply(&after).unwrap();
        assert_eq!((applied.materials[0].roughness, applied.materials[1].roughness), (0.5, 1.0));
        assert!(!applied.nodes[0].visible);
        assert_eq!((edits.added_lights().len(), edits.settings.clone()), (1, whole.settings.clone()));
    }

    #[test]
    fn parts_are_the_whole() {
        let base = scene(&["brick"]);
        let mut edits = Edits { scene: "a.glb".into(), ..Edits::default() };
        edits.set(&base, Item::Material(MaterialId(0)), "roughness", Value::Number(0.25)).unwrap();
        edits.set(&base, Item::Look, "exposure", Value::Number(1.0)).unwrap();
        edits.add_bookmark("view", Default::default());
        let part = edits.of_scene();
        assert_eq!(part.apply(&base).unwrap(), edits.apply(&base).unwrap());
        assert_eq!((part.look.clone(), part.bookmarks.len()), (Default::default(), 0));
        assert_eq!(edits.with_scene_of(&part), edits);
        assert_eq!(edits.with_scene_of(&Edits::default()).of_scene(), Edits::default());
    }
}

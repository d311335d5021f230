//! What the things of a scene are called in a file: by name where no other has it, otherwise by name and number, or by number alone.
//!
//! `brick` is the only thing of that name, `brick#3` the one with number 3 (from 0, among all of its kind), whose name must be `brick`, and
//! `#3` the one with number 3, whatever its name. A name that ends like a number is always written with its number: `brick#3#7`.

use super::EditsError;
use lumbre_scene::{Node, Scene};
use std::collections::HashMap;

/// The things of one kind, by number.
#[derive(Clone, Copy)]
pub(super) struct Names<'s> {
    scene: &'s Scene,
    kind: Named,
}

/// Kinds of things.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Named {
    Materials,
    Nodes,
    /// Nodes that hold a light, by their name or that of the light.
    Lights,
}

/// Of what there is, this much is listed.
const LISTED: usize = 16;

impl<'s> Names<'s> {
    pub(super) fn of(scene: &'s Scene, kind: Named) -> Self {
        Names { scene, kind }
    }

    fn count(&self) -> usize {
        if self.kind == Named::Materials { self.scene.materials.len() } else { self.scene.nodes.len() }
    }

    /// The name of a thing; `None` if that number is no such thing.
    fn name(&self, index: usize) -> Option<&'s str> {
        let node = || self.scene.nodes.get(index);
        match self.kind {
            Named::Materials => self.scene.materials.get(index).map(|m| &*m.name),
            Named::Nodes => node().map(|n| &*n.name),
            Named::Lights => node().and_then(|n| self.light_name(n)),
        }
    }

    fn light_name(&self, node: &'s Node) -> Option<&'s str> {
        let light = self.scene.lights.get(node.light?.index())?;
        Some(if node.name.is_empty() { &light.name } else { &node.name })
    }

    fn what(&self) -> [&'static str; 2] {
        match self.kind {
            Named::Materials => ["material", "materials"],
            Named::Nodes => ["node", "nodes"],
            Named::Lights => ["light", "lights"],
        }
    }

    fn all(self) -> impl Iterator<Item = (usize, &'s str)> {
        (0..self.count()).filter_map(move |i| Some((i, self.name(i)?)))
    }

    /// What a thing is called; `None` if there is none of this number.
    pub(super) fn key(self, index: usize) -> Option<String> {
        let name = self.name(index)?;
        let plain = !name.is_empty() && numbered(name).is_none();
        let unique = plain && self.all().filter(|(_, n)| *n == name).take(2).count() == 1;
        Some(if unique { name.into() } else { format!("{name}#{index}") })
    }

    /// The numbers of what is called so, for as many as there are, in one look over the scene.
    pub(super) fn find<'k>(self, keys: impl Iterator<Item = &'k str>) -> Vec<Result<usize, EditsError>> {
        let keys: Vec<&str> = keys.collect();
        let mut found: HashMap<&str, (usize, usize)> = keys.iter().map(|key| (*key, (0, 0))).collect();
        if !found.is_empty() {
            for (index, name) in self.all() {
                if let Some((first, count)) = found.get_mut(name) {
                    *first = if *count == 0 { index } else { *first };
                    *count += 1;
                }
            }
        }
        keys.into_iter().map(|key| self.pick(key, found[key])).collect()
    }

    /// The number of a key of which `count` things have the name, from `first` on.
    fn pick(self, key: &str, (first, count): (usize, usize)) -> Result<usize, EditsError> {
        if let Some((name, index)) = numbered(key)
            && self.name(index).is_some_and(|n| name.is_empty() || n == name)
        {
            return Ok(index);
        }
        let [one, many] = self.what();
        match count {
            1 => Ok(first),
            0 => {
                let keys = self.all().map(|(i, n)| if n.is_empty() { format!("#{i}") } else { n.into() });
                let reason = format!("there is no such {one}; the scene has {}", listed(keys));
                Err(EditsError::new(key, reason))
            }
            _ => {
                let same = self.all().filter(|(_, n)| *n == key).map(|(i, n)| format!("{n}#{i}"));
                Err(EditsError::new(key, format!("{count} {many} have this name: {}", listed(same))))
            }
        }
    }
}

/// The name and the number of a key that ends in one.
fn numbered(key: &str) -> Option<(&str, usize)> {
    let (name, digits) = key.rsplit_once('#')?;
    let sound = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    Some((name, digits.parse().ok().filter(|_| sound)?))
}

fn listed(mut keys: impl Iterator<Item = String>) -> String {
    let first: Vec<String> = keys.by_ref().take(LISTED).collect();
    match (first.is_empty(), keys.count()) {
        (true, _) => "none".into(),
        (_, 0) => first.join(", "),
        (_, more) => format!("{} and {more} more", first.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lumbre_scene::{Light, LightId, LightKind, Material};

    fn scene(names: &[&str]) -> Scene {
        let mut scene = Scene::default();
        for name in names {
            scene.add_material(Material { name: name.to_string(), ..Material::default() });
        }
        scene
    }

    fn find(scene: &Scene, key: &str) -> Result<usize, String> {
        let mut found = Names::of(scene, Named::Materials).find([key].into_iter());
        found.remove(0).map_err(|e| e.to_string())
    }

    #[test]
    fn keys_lead_back_to_their_things() {
        let scene =
            scene(&["brick", "wood", "brick", "", "brick#1", "#2", "wood#", "a#99999999999999999999", ""]);
        let names = Names::of(&scene, Named::Materials);
        let keys: Vec<String> = (0..9).map(|i| names.key(i).unwrap()).collect();
        let want = [
            "brick#0",
            "wood",
            "brick#2",
            "#3",
            "brick#1#4",
            "#2#5",
            "wood#",
            "a#99999999999999999999",
            "#8",
        ];
        assert_eq!(keys, want);
        let found = names.find(keys.iter().map(|k| &**k));
        assert_eq!(found.into_iter().map(Result::unwrap).collect::<Vec<_>>(), (0..9).collect::<Vec<_>>());
        assert_eq!(names.key(9), None);
        // By hand: what is no number of such a name is a name.
        assert_eq!(find(&scene, "brick#1"), Ok(4));
        assert_eq!(find(&scene, "#4"), Ok(4));
    }

    #[test]
    fn what_is_not_there_is_told_with_what_is() {
        let scene = scene(&["brick", "wood", "brick", ""]);
        assert_eq!(
            find(&scene, "brik"),
            Err("/brik: there is no such material; the scene has brick, wood, brick, #3".into())
        );
        assert_eq!(find(&scene, "brick"), Err("/brick: 2 materials have this name: brick#0, brick#2".into()));
        assert!(find(&scene, "brick#1").is_err() && find(&scene, "#4").is_err());
        let many: Vec<String> = (0..20).map(|i| i.to_string()).collect();
        let scene = self::scene(&many.iter().map(|s| &**s).collect::<Vec<_>>());
        assert!(find(&scene, "x").unwrap_err().ends_with("14, 15 and 4 more"));
        assert!(find(&Scene::default(), "x").unwrap_err().ends_with("the scene has none"));
    }

    #[test]
    fn lights_are_called_as_their_nodes_or_by_their_own_name() {
        let mut scene = Scene::default();
        let light = Light { name: "bulb".into(), kind: LightKind::Point, intensity: lumbre_core::Rgb::WHITE };
        scene.lights.push(light);
        let node = |name: &str, light| Node { name: name.into(), light, ..Node::default() };
        let lamp = Some(LightId(0));
        for (name, light) in [("lamp", None), ("lamp", lamp), ("", lamp), ("gone", Some(LightId(7)))] {
            scene.add_root(node(name, light));
        }
        let names = Names::of(&scene, Named::Lights);
        assert_eq!(
            [0, 1, 2, 3].map(|i| names.key(i)),
            [None, Some("lamp".into()), Some("bulb".into()), None]
        );
        let found = names.find(["lamp", "bulb", "#2", "gone"].into_iter());
        assert_eq!(
            found.iter().map(|f| f.as_ref().ok()).collect::<Vec<_>>(),
            [Some(&1), Some(&2), Some(&2), None]
        );
    }
}

//! Which parts of a compiled scene differ from those of another: what a backend has to bring up to date.

use super::CompiledScene;

macro_rules! parts {
    ($($(#[$doc:meta])* $part:ident $name:literal),* $(,)?) => {
        /// An array or a value of a [`CompiledScene`]: one for each of its [sections](CompiledScene::sections), in their order.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        #[repr(u8)]
        pub enum Part { $($(#[$doc])* $part),* }

        impl Part {
            /// All of them.
            pub const ALL: &[Part] = &[$(Part::$part),*];

            /// The name of its section.
            pub fn name(self) -> &'static str {
                match self { $(Part::$part => $name),* }
            }
        }
    };
}

parts! {
    /// `positions`.
    Positions "positions",
    /// `normals`.
    Normals "normals",
    /// `vertices`.
    Vertices "vertices",
    /// `triangles`.
    Triangles "triangles",
    /// `triangle_materials`.
    TriangleMaterials "triangle_materials",
    /// `meshes`.
    Meshes "meshes",
    /// `emissive_ranks`.
    EmissiveRanks "emissive_ranks",
    /// `instances`.
    Instances "instances",
    /// `transforms`.
    Transforms "transforms",
    /// `materials`.
    Materials "materials",
    /// `lobes`.
    Lobes "lobes",
    /// `textures`.
    Textures "textures",
    /// `texels`.
    Texels "texels",
    /// `lights`.
    Lights "lights",
    /// `near_light_cdf`.
    NearLightCdf "near_light_cdf",
    /// `far_light_cdf`.
    FarLightCdf "far_light_cdf",
    /// `triangle_lights`.
    TriangleLights "triangle_lights",
    /// `punctual_lights`.
    PunctualLights "punctual_lights",
    /// `sun`.
    Sun "sun",
    /// `environment`.
    Environment "environment",
    /// `environment_pixels`.
    EnvironmentPixels "environment_pixels",
    /// `environment_row_cdf`.
    EnvironmentRowCdf "environment_row_cdf",
    /// `environment_cell_cdf`.
    EnvironmentCellCdf "environment_cell_cdf",
    /// `bounds`.
    Bounds "bounds",
}

/// A set of [`Part`]s: those in which two compiled scenes differ.
#[derive(Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct SceneChanges {
    bits: u32,
}

impl SceneChanges {
    /// What makes the triangles of meshes.
    const GEOMETRY: [Part; 5] =
        [Part::Positions, Part::Normals, Part::Vertices, Part::Triangles, Part::TriangleMaterials];

    /// None.
    pub const fn none() -> Self {
        SceneChanges { bits: 0 }
    }

    /// All.
    pub const fn all() -> Self {
        SceneChanges { bits: (1 << Part::ALL.len()) - 1 }
    }

    /// Those whose bytes differ. What two scenes share is not looked at.
    pub fn between(before: &CompiledScene, after: &CompiledScene) -> Self {
        let mut changes = SceneChanges::none();
        for (&part, ((_, old), (_, new))) in
            Part::ALL.iter().zip(before.sections().iter().zip(after.sections()))
        {
            let shared = std::ptr::eq(*old, new);
            if !shared && *old != new {
                changes = changes.with(part);
            }
        }
        changes
    }

    /// With this one.
    #[must_use]
    pub const fn with(self, part: Part) -> Self {
        SceneChanges { bits: self.bits | 1 << part as u32 }
    }

    /// Those of both: of one edit and of the next.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        SceneChanges { bits: self.bits | other.bits }
    }

    /// Whether this part differs.
    pub const fn has(self, part: Part) -> bool {
        self.bits & 1 << part as u32 != 0
    }

    /// Whether any of these does.
    pub fn any(self, parts: &[Part]) -> bool {
        parts.iter().any(|&p| self.has(p))
    }

    /// Whether the triangles of meshes differ, in place or attributes.
    pub fn geometry(self) -> bool {
        self.any(&Self::GEOMETRY)
    }

    /// Whether nothing does.
    pub const fn is_empty(self) -> bool {
        self.bits == 0
    }

    /// Those that differ.
    pub fn parts(self) -> impl Iterator<Item = Part> {
        Part::ALL.iter().copied().filter(move |&p| self.has(p))
    }
}

impl std::fmt::Debug for SceneChanges {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_set().entries(self.parts()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn parts_are_the_sections() {
        let names: Vec<_> = CompiledScene::default().sections().iter().map(|(name, _)| *name).collect();
        assert_eq!(names, Part::ALL.iter().map(|p| p.name()).collect::<Vec<_>>());
        assert!(Part::ALL.iter().enumerate().all(|(i, &p)| p as usize == i && Part::ALL.len() < 32));
        assert!(Part::ALL.iter().all(|&p| SceneChanges::all().has(p) && !SceneChanges::none().has(p)));
        assert_eq!(SceneChanges::all().parts().count(), Part::ALL.len());
    }

    #[test]
    fn only_what_differs_is_named() {
        let before = CompiledScene { texels: Arc::from([1, 2]), ..CompiledScene::default() };
        assert!(SceneChanges::between(&before, &before.clone()).is_empty());
        let same = CompiledScene { texels: Arc::from([1, 2]), ..before.clone() };
        assert!(SceneChanges::between(&before, &same).is_empty(), "another array of the same content");
        let longer = CompiledScene { texels: Arc::from([1, 2, 0]), ..before.clone() };
        let mut lit = longer.clone();
        lit.sun.one_minus_cos = 0.5;
        assert_eq!(SceneChanges::between(&before, &longer), SceneChanges::none().with(Part::Texels));
        let both = SceneChanges::between(&before, &lit);
        assert_eq!(both, SceneChanges::none().with(Part::Sun).and(SceneChanges::between(&before, &longer)));
        assert!(both.any(&[Part::Sun, Part::Lobes]) && !both.geometry() && !both.any(&[Part::Lobes]));
        assert_eq!(format!("{both:?}"), "{Texels, Sun}");
    }
}

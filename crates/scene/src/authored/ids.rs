//! Indices into the vectors of a [`Scene`](crate::Scene), one type for each.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// As an index.
            #[inline]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    };
}

id!(
    /// Index into `Scene::meshes`.
    MeshId
);
id!(
    /// Index into `Scene::materials`.
    MaterialId
);
id!(
    /// Index into `Scene::textures`.
    TextureId
);
id!(
    /// Index into `Scene::images`.
    ImageId
);
id!(
    /// Index into `Scene::nodes`.
    NodeId
);
id!(
    /// Index into `Scene::cameras`.
    CameraId
);
id!(
    /// Index into `Scene::lights`.
    LightId
);

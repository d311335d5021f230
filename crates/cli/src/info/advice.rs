//! What can be done about a hint, in terms of the command line.

use lumbre::HintKind;

/// One line; `None` where the hint speaks for itself.
pub(super) fn on(kind: HintKind) -> Option<&'static str> {
    Some(match kind {
        HintKind::NothingDrawn => "give the scene triangles; points and lines are not drawn",
        HintKind::NothingInView => "--look-at X,Y,Z turns the camera, --look-from X,Y,Z moves it",
        HintKind::BackFacesOnly => "--back-faces shade shows them",
        HintKind::CameraInside => "--look-from X,Y,Z moves the camera out",
        HintKind::NoLight => {
            "lumbre render adds a gradient sky; --sky, --sun ELEV,AZIM or --env FILE.hdr choose another light"
        }
        HintKind::AllBlack => {
            "--look-from X,Y,Z looks from another side; --sky gradient, --sun ELEV,AZIM or --env FILE.hdr add light"
        }
        HintKind::LightInside => "move the lamp out, or give the mesh a transmissive material",
        HintKind::FaintEmission => "--sky gradient, --sun ELEV,AZIM or --env FILE.hdr add more light",
        HintKind::InvisibleMaterial => "raise its alpha, or make its alpha mode OPAQUE",
        HintKind::MissingTexCoords => "unwrap the mesh, or take the textures off the material",
        HintKind::Units => "glTF counts in metres: lamps, volumes and depth of field depend on it",
        HintKind::FarFromOrigin => "move the scene to the origin",
        HintKind::NonFinite | HintKind::Degenerate => return None,
    })
}

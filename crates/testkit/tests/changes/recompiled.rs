//! A scene that was compiled from an earlier one is that which is compiled from nothing, bit for bit.

use lumbre_scene::{CompileError, Compiled, CompiledScene, Part, Scene, SceneChanges, compile, recompile};
use lumbre_testkit::changing::{DEEP_EDITS, EDITS, Random, change, rich};
use std::collections::BTreeSet;
use std::sync::Arc;

type Outcome = Result<(Compiled, SceneChanges), CompileError>;
type Recompile<'a> = &'a dyn Fn(&Scene, &CompiledScene, &Scene) -> Outcome;

/// What is wrong with `recompile` at one edit.
fn faults(recompile: Recompile<'_>, before: (&Scene, &CompiledScene), after: &Scene) -> Vec<String> {
    match (recompile(before.0, before.1, after), compile(after)) {
        (Err(found), Err(expected)) if found == expected => vec![],
        (Ok((found, changes)), Ok(expected)) => {
            let (a, b) = (found.scene.sections(), expected.scene.sections());
            let differ = a.iter().zip(&b).filter(|(a, b)| a != b);
            let mut faults: Vec<String> =
                differ.map(|((name, _), _)| format!("{name} is not what compiling gives")).collect();
            if found.notes != expected.notes {
                faults.push(format!("{:?} are not the notes {:?}", found.notes, expected.notes));
            }
            let bits = |s: &CompiledScene| -> Vec<u32> {
                let mean = s.environment_mean.to_array();
                s.light_powers.iter().chain(&mean).map(|v| v.to_bits()).collect()
            };
            if bits(&found.scene) != bits(&expected.scene) {
                faults.push("powers are not what compiling gives".into());
            }
            for ((part, (_, a)), (_, b)) in Part::ALL.iter().zip(before.1.sections()).zip(b) {
                if changes.has(*part) != (a != b) {
                    faults.push(format!("{} differs, or not, against what is said", part.name()));
                }
            }
            faults
        }
        (found, expected) => vec![format!("{:?} where compiling gives {:?}", found.err(), expected.err())],
    }
}

/// Random edits one after another: what was made again is the beginning of the next. Returns the faults, the parts that changed where
/// meshes and images stayed, and how many edits could be compiled.
fn walk(recompile: Recompile<'_>, seed: u32, edits: u32) -> (Vec<String>, BTreeSet<&'static str>, u32) {
    let (mut r, mut scene) = (Random::new(seed), rich());
    let mut compiled = compile(&scene).unwrap().scene;
    let (mut found, mut changed, mut good) = (Vec::new(), BTreeSet::new(), 0);
    for i in 0..edits {
        let mut after = scene.clone();
        (0..=r.below(3)).for_each(|_| change(&mut after, &mut r));
        found.extend(
            faults(recompile, (&scene, &compiled), &after).iter().map(|f| format!("{seed}, {i}: {f}")),
        );
        if let Ok((made, changes)) = recompile(&scene, &compiled, &after) {
            if Arc::ptr_eq(&scene.meshes, &after.meshes) && Arc::ptr_eq(&scene.images, &after.images) {
                changed.extend(changes.parts().map(Part::name));
            }
            (scene, compiled, good) = (after, made.scene, good + 1);
        }
        // Back to the start before nothing is left.
        if r.below(25) == 0 {
            scene = rich();
            compiled = compile(&scene).unwrap().scene;
        }
    }
    (found, changed, good)
}

#[test]
fn random_edits() {
    let mut changed = BTreeSet::new();
    for seed in 0..6 {
        let (faults, parts, good) = walk(&recompile, seed, 200);
        assert!(faults.is_empty(), "{}", faults.join("\n"));
        assert!(good > 100, "{good} edits could be compiled");
        changed.extend(parts);
    }
    // Texels come with images.
    let all = Part::ALL.iter().filter(|&&p| p != Part::Texels).map(|p| p.name());
    assert_eq!(changed, all.collect(), "parts that edits change");
}

#[test]
fn edits_by_name() {
    let scene = rich();
    let compiled = compile(&scene).unwrap().scene;
    for (name, edit) in EDITS.iter().chain(DEEP_EDITS) {
        let mut after = scene.clone();
        edit(&mut after);
        let found = faults(&recompile, (&scene, &compiled), &after);
        assert!(found.is_empty(), "{name}: {}", found.join("\n"));
        // And back.
        let (made, changes) = recompile(&scene, &compiled, &after).unwrap();
        assert!(!changes.is_empty(), "{name} changes something");
        let found = faults(&recompile, (&after, &made.scene), &scene);
        assert!(found.is_empty(), "{name} and back: {}", found.join("\n"));
    }
}

/// What edits of an interactive program do not touch is not even copied.
#[test]
fn what_stays_is_shared() {
    let scene = rich();
    let compiled = compile(&scene).unwrap().scene;
    for (name, edit) in EDITS {
        let mut after = scene.clone();
        edit(&mut after);
        let (Compiled { scene: made, .. }, changes) = recompile(&scene, &compiled, &after).unwrap();
        assert!(Arc::ptr_eq(&made.texels, &compiled.texels), "{name}: texels");
        let shared = Arc::ptr_eq(&made.vertices, &compiled.vertices);
        assert_eq!(shared, !changes.has(Part::Vertices), "{name}: vertices");
        assert!(Arc::ptr_eq(&made.positions, &compiled.positions) || changes.geometry(), "{name}: positions");
    }
    let (made, changes) = recompile(&scene, &compiled, &scene.clone()).unwrap();
    assert!(changes.is_empty() && Arc::ptr_eq(&made.scene.lights, &compiled.lights));
}

/// Forgets a part: leaves it as it was before the edit.
fn forget(part: Part, from: &CompiledScene, to: &mut CompiledScene) {
    let from = from.clone();
    match part {
        Part::Positions => to.positions = from.positions,
        Part::Normals => to.normals = from.normals,
        Part::Vertices => to.vertices = from.vertices,
        Part::Triangles => to.triangles = from.triangles,
        Part::TriangleMaterials => to.triangle_materials = from.triangle_materials,
        Part::Meshes => to.meshes = from.meshes,
        Part::EmissiveRanks => to.emissive_ranks = from.emissive_ranks,
        Part::Instances => to.instances = from.instances,
        Part::Transforms => to.transforms = from.transforms,
        Part::Materials => to.materials = from.materials,
        Part::Lobes => to.lobes = from.lobes,
        Part::Textures => to.textures = from.textures,
        Part::Texels => to.texels = from.texels,
        Part::Lights => to.lights = from.lights,
        Part::NearLightCdf => to.near_light_cdf = from.near_light_cdf,
        Part::FarLightCdf => to.far_light_cdf = from.far_light_cdf,
        Part::TriangleLights => to.triangle_lights = from.triangle_lights,
        Part::PunctualLights => to.punctual_lights = from.punctual_lights,
        Part::Sun => to.sun = from.sun,
        Part::Environment => to.environment = from.environment,
        Part::EnvironmentPixels => to.environment_pixels = from.environment_pixels,
        Part::EnvironmentRowCdf => to.environment_row_cdf = from.environment_row_cdf,
        Part::EnvironmentCellCdf => to.environment_cell_cdf = from.environment_cell_cdf,
        Part::Bounds => to.bounds = from.bounds,
    }
}

/// The tests above would see a part that is forgotten, and one that is not named.
#[test]
fn a_part_that_is_forgotten_is_found() {
    let scene = rich();
    let compiled = compile(&scene).unwrap().scene;
    let edits: Vec<Scene> = EDITS
        .iter()
        .chain(DEEP_EDITS)
        .map(|(_, edit)| {
            let mut after = scene.clone();
            edit(&mut after);
            after
        })
        .collect();
    for &part in Part::ALL {
        let forgets = |before: &Scene, compiled: &CompiledScene, after: &Scene| {
            let (mut made, changes) = recompile(before, compiled, after)?;
            forget(part, compiled, &mut made.scene);
            Ok((made, changes))
        };
        let keeps_quiet = |before: &Scene, compiled: &CompiledScene, after: &Scene| {
            let (made, changes) = recompile(before, compiled, after)?;
            let named = changes.parts().filter(|&p| p != part);
            Ok((made, named.fold(SceneChanges::none(), SceneChanges::with)))
        };
        let seen = |wrong: Recompile<'_>| {
            edits.iter().any(|after| !faults(wrong, (&scene, &compiled), after).is_empty())
        };
        assert!(seen(&forgets), "{} can be forgotten", part.name());
        assert!(seen(&keeps_quiet), "{} need not be named", part.name());
    }
}

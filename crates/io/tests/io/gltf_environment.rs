//! Sky and sun of a glTF scene, in the extras that this project defines.

use crate::common::Gltf;
use lumbre_core::Rgb;
use lumbre_io::{LoadOptions, SceneChoice, load_scene};
use lumbre_scene::{Background, Environment, Sun};
use serde_json::{Value, json};

fn with(extras: Value) -> Gltf {
    let mut g = Gltf::triangle();
    g.doc["scenes"][0]["extras"] = extras;
    g
}

/// The environment and the warnings that the object brings.
fn load(lumbre: Value) -> (Environment, Vec<String>) {
    let loaded = with(json!({ "lumbre": lumbre })).load().unwrap();
    (loaded.scene.environment, loaded.warnings)
}

fn error(lumbre: Value) -> String {
    with(json!({ "lumbre": lumbre })).error()
}

#[test]
fn sky_and_sun_are_read() {
    let (environment, warnings) =
        load(json!({"sky": "gradient", "sun": {"elevation": 20, "azimuth": -130.5, "strength": 9}}));
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(environment.background, Background::Gradient);
    assert_eq!(environment.sun, Some(Sun::daylight(20.0, -130.5, 9.0)));
    let (environment, _) = load(json!({"sky": [0.25, 0.5, 2]}));
    assert_eq!(environment.background, Background::Constant(Rgb::new(0.25, 0.5, 2.0)));
    assert_eq!(environment.sun, None);
    let (environment, _) = load(json!({"sun": {"elevation": 55}}));
    assert_eq!(environment.sun, Some(Sun::daylight(55.0, 0.0, Sun::STRENGTH)));
    assert_eq!(environment.background, Background::Black);
}

#[test]
fn other_extras_mean_nothing() {
    for extras in
        [json!({}), json!({"sky": "gradient"}), json!([1, {"lumbre": 2}]), json!("lumbre"), json!(null)]
    {
        let loaded = with(extras).load().unwrap();
        assert_eq!((loaded.scene.environment, loaded.warnings.len()), (Environment::default(), 0));
    }
    assert_eq!(Gltf::triangle().scene().environment, Environment::default());
}

#[test]
fn the_scene_that_is_shown_brings_its_light() {
    let mut g = with(json!({"lumbre": {"sky": [1, 0, 0]}}));
    let second = json!({"nodes": [0], "extras": {"lumbre": {"sky": [0, 1, 0]}}});
    g.doc["scenes"].as_array_mut().unwrap().push(second);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.gltf");
    std::fs::write(&path, g.text()).unwrap();
    for (index, color) in [(0, Rgb::new(1.0, 0.0, 0.0)), (1, Rgb::new(0.0, 1.0, 0.0))] {
        let options = LoadOptions { scene: SceneChoice::Index(index), ..LoadOptions::default() };
        let scene = load_scene(&path, &options).unwrap().scene;
        assert_eq!(scene.environment.background, Background::Constant(color));
    }
}

#[test]
fn wrong_types_are_errors_with_their_place() {
    let cases = [
        (json!(3), ": should be an object"),
        (json!({"sky": "blue"}), "/sky: should be \"gradient\" or a list of 3 numbers"),
        (json!({"sky": [1, 2]}), "/sky: should be a list of 3 numbers"),
        (json!({"sky": [1, 2, "3"]}), "/sky/2: should be a finite number"),
        (json!({"sun": [20, 130]}), "/sun: should be an object"),
        (json!({"sun": {}}), "/sun/elevation: is missing"),
        (json!({"sun": {"elevation": "low"}}), "/sun/elevation: should be a finite number"),
        (json!({"sun": {"elevation": 20, "strength": 1e300}}), "/sun/strength: should be a finite number"),
    ];
    for (lumbre, expected) in cases {
        let message = error(lumbre);
        assert_eq!(message, format!("scene.gltf: /scenes/0/extras/lumbre{expected}"));
    }
}

#[test]
fn values_out_of_range_and_unknown_keys_are_warnings() {
    let (environment, warnings) = load(json!({
        "sky": [-1, 0.5, 1], "sun": {"elevation": 120, "strength": -3, "colour": 1}, "fog": {},
    }));
    assert_eq!(environment.background, Background::Constant(Rgb::new(0.0, 0.5, 1.0)));
    assert_eq!(environment.sun, Some(Sun::daylight(90.0, 0.0, 0.0)));
    let place = "/scenes/0/extras/lumbre";
    let expected = [
        format!("{place}/sky: negative light is set to 0 (and 1 more)"),
        format!("{place}/sun: an elevation beyond 90 degrees is clamped"),
        format!("{place}/sun: the key \"colour\" is not known and is ignored"),
        format!("{place}: the key \"fog\" is not known and is ignored"),
    ];
    assert_eq!(warnings, expected);
}

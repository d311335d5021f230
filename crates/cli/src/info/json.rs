//! The report as one JSON object.

use super::{Report, advice};
use crate::flags::values::Size;
use lumbre::SceneInfo;
use lumbre::io::{Description, Support, UsedExtension};
use lumbre::scene::Projection;
use serde_json::{Map, Value, json};

pub(super) fn of(report: &Report<'_>) -> String {
    let mut all = Map::new();
    all.insert("file".into(), json!(report.args.scene.to_string_lossy()));
    add(&mut all, file(&report.description));
    all.insert("shown_scene".into(), json!(report.shown_scene()));
    if let Some(info) = &report.info {
        add(&mut all, scene(info));
        let Size(size) = report.args.size;
        let (m, film) = (&info.memory, report.film_bytes());
        all.insert(
            "memory".into(),
            json!({ "scene": m.scene, "acceleration": m.acceleration, "film": film, "film_size": size,
                    "rendering": m.scene + m.acceleration + film, "opening": m.scene + m.opening }),
        );
    }
    Value::Object(all).to_string()
}

fn add(all: &mut Map<String, Value>, more: Value) {
    if let Value::Object(more) = more {
        all.extend(more);
    }
}

fn file(d: &Description) -> Value {
    let extension = |e: &UsedExtension| {
        let without = match e.support {
            Some(Support::Without(what)) => Some(what),
            _ => None,
        };
        json!({ "name": e.name, "required": e.required, "supported": e.support.is_some(), "without": without })
    };
    json!({
        "format": d.format,
        "file_bytes": d.file_bytes,
        "generator": d.generator,
        "extensions": d.extensions.iter().map(extension).collect::<Vec<_>>(),
        "scenes": d.scenes,
        "default_scene": d.default_scene,
        "variants": d.variants,
        "lists": d.lists.iter().map(|(what, count)| (what.to_string(), json!(count))).collect::<Map<_, _>>(),
    })
}

fn scene(info: &SceneInfo) -> Value {
    let g = &info.geometry;
    let l = &info.lights;
    json!({
        "geometry": {
            "meshes": g.meshes, "primitives": g.primitives, "instances": g.instances,
            "triangles": g.triangles, "drawn_triangles": g.drawn_triangles, "vertices": g.vertices,
            "degenerate_triangles": g.degenerate_triangles, "flat_primitives": g.flat_primitives,
        },
        "bounds": info.bounds.map(|corners| corners.map(|c| c.to_array())),
        "textures": {
            "textures": info.textures.textures, "bytes": info.textures.bytes,
            "images": info.textures.images.iter()
                .map(|i| json!({ "name": i.name, "size": i.size, "bytes": i.bytes })).collect::<Vec<_>>(),
        },
        "lights": {
            "point": l.point, "spot": l.spot, "directional": l.directional,
            "emissive_materials": l.emissive_materials, "emissive_triangles": l.emissive_triangles,
            "background": l.background, "sun": l.sun,
        },
        "materials": info.materials.iter()
            .map(|m| json!({ "name": m.name, "used": m.used, "lobes": m.lobes, "textures": m.textures }))
            .collect::<Vec<_>>(),
        "cameras": info.cameras.iter().map(|c| {
            let position = c.position.to_array();
            match c.projection {
                Projection::Perspective { yfov, aspect } => json!({ "name": c.name, "position": position,
                    "projection": "perspective", "yfov": yfov, "aspect": aspect }),
                Projection::Orthographic { xmag, ymag } => json!({ "name": c.name, "position": position,
                    "projection": "orthographic", "xmag": xmag, "ymag": ymag }),
            }
        }).collect::<Vec<_>>(),
        "notes": info.notes,
        "hints": info.hints.iter()
            .map(|h| json!({ "kind": h.kind.name(), "message": h.message, "advice": advice::on(h.kind) }))
            .collect::<Vec<_>>(),
    })
}

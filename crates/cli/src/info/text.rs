//! The report for people: a word on the left, what there is to say in lines of at most 80 columns beside it.

use super::{Report, advice};
use crate::flags::values::Size;
use crate::memory::human;
use lumbre::core::math::Vec3;
use lumbre::io::{Support, UsedExtension, one_line};
use lumbre::scene::Projection;
use lumbre::{SceneInfo, info};

/// Columns of a line, and of the word on its left.
const WIDTH: usize = 80;
const LEFT: usize = 12;
/// Most rows of a list.
const MOST: usize = 24;

pub(super) fn of(report: &Report<'_>) -> String {
    let mut page = Page::default();
    file(&mut page, report);
    if let Some(info) = &report.info {
        scene(&mut page, info);
        memory(&mut page, report, info);
        hints(&mut page, info);
    } else {
        let lists = report.description.lists.iter().filter(|(_, count)| *count > 0);
        page.say(
            "lists",
            &lists.map(|(what, count)| format!("{what} {count}")).collect::<Vec<_>>().join(", "),
        );
    }
    page.0.trim_end().to_string()
}

/// Lines with a margin for words on the left.
#[derive(Default)]
struct Page(String);

impl Page {
    /// Text behind a word, broken between its words; nothing if it is empty.
    fn say(&mut self, word: &str, text: &str) {
        self.hang(word, text, [0, 0]);
    }

    /// As `say`; the first line and those after it are set in by so much more.
    fn hang(&mut self, word: &str, text: &str, [first, rest]: [usize; 2]) {
        let mut line = format!("{word:<LEFT$}{:first$}", "");
        let mut begun = false;
        for part in one_line(text).split_inclusive(' ') {
            if begun && line.chars().count() + part.trim_end().chars().count() > WIDTH {
                self.push(&line);
                line = " ".repeat(LEFT + rest);
            }
            line.push_str(part);
            begun = true;
        }
        if begun {
            self.push(&line);
        }
    }

    /// Adds a line. Blanks that are not to break it are common ones from now on.
    fn push(&mut self, line: &str) {
        self.0.push_str(line.replace('\u{a0}', " ").trim_end());
        self.0.push('\n');
    }

    /// Rows of a list behind a word that stands once.
    fn list(&mut self, word: &str, rows: &[String]) {
        for (i, row) in rows.iter().take(MOST).enumerate() {
            self.hang(if i == 0 { word } else { "" }, row, [0, 4]);
        }
        if rows.len() > MOST {
            self.say("", &format!("and {} more; --json lists all", rows.len() - MOST));
        }
    }
}

/// A number with a space between thousands.
fn thousands(n: u64) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push('\u{a0}');
        }
        out.push(digit);
    }
    out
}

/// `1 mesh`, `2 meshes`.
fn count(n: impl TryInto<u64>, one: &str, many: &str) -> String {
    let n = n.try_into().unwrap_or(u64::MAX);
    format!("{}\u{a0}{}", thousands(n), if n == 1 { one } else { many })
}

fn named(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("  {name}") }
}

fn file(page: &mut Page, report: &Report<'_>) {
    let d = &report.description;
    page.say("file", &report.args.scene.to_string_lossy());
    let by = d.generator.as_ref().map_or_else(String::new, |g| format!(", made by {g}"));
    page.say("format", &format!("{}, {}{by}", d.format, human(d.file_bytes)));
    let extension = |e: &UsedExtension| {
        let use_ = if e.required { "required" } else { "used" };
        let verdict = match e.support {
            Some(Support::Full) => "supported".into(),
            Some(Support::Without(what)) => format!("supported, but for {what}"),
            Some(Support::NotNeeded) => "not needed for a picture".into(),
            None if e.required => "NOT SUPPORTED: the scene cannot be drawn".into(),
            None => "not supported, ignored".into(),
        };
        format!("{}  {use_}, {verdict}", e.name)
    };
    page.list("extensions", &d.extensions.iter().map(extension).collect::<Vec<_>>());
    if d.scenes.len() > 1 {
        let shown = report.shown_scene();
        let scene = |(i, name): (usize, &String)| {
            format!("{i}{}{}", named(name), if i == shown { "  (shown)" } else { "" })
        };
        page.list("scenes", &d.scenes.iter().enumerate().map(scene).collect::<Vec<_>>());
    }
    let variant = |(i, name): (usize, &String)| format!("{i}{}", named(name));
    page.list("variants", &d.variants.iter().enumerate().map(variant).collect::<Vec<_>>());
}

fn scene(page: &mut Page, info: &SceneInfo) {
    let g = &info.geometry;
    let mut parts = vec![
        count(g.meshes as u64, "mesh", "meshes"),
        count(g.instances as u64, "instance", "instances"),
        count(g.triangles, "triangle", "triangles"),
        count(g.vertices, "vertex", "vertices"),
    ];
    if g.drawn_triangles != g.triangles {
        parts[2] += &format!(" ({}\u{a0}drawn)", thousands(g.drawn_triangles));
    }
    if g.degenerate_triangles > 0 {
        parts.push(format!(
            "{}\u{a0}without\u{a0}area",
            count(g.degenerate_triangles, "triangle", "triangles")
        ));
    }
    if g.flat_primitives > 0 {
        parts.push(format!("{}\u{a0}shaded\u{a0}flat", count(g.flat_primitives as u64, "part", "parts")));
    }
    page.say("geometry", &parts.join(", "));
    if let Some([min, max]) = info.bounds {
        let size = max - min;
        page.say("size", &format!("{} x {} x {} m", short(size.x), short(size.y), short(size.z)));
        // What is nothing beside the size of the scene is rounding.
        let round = |v: f32| short(if v.abs() < 1e-6 * size.length() { 0.0 } else { v });
        let corner = |c: Vec3| format!("({},\u{a0}{},\u{a0}{})", round(c.x), round(c.y), round(c.z));
        page.say("bounds", &format!("{} to {} m", corner(min), corner(max)));
    }
    textures(page, info);
    lights(page, &info.lights);
    materials(page, info);
    cameras(page, info);
}

/// A number with four digits that count.
fn short(v: f32) -> String {
    match v.abs() {
        0.0 => "0".into(),
        a if (0.001..1e6).contains(&a) => {
            let decimals = (3 - a.log10().floor() as i32).clamp(0, 6) as usize;
            let text = format!("{v:.decimals$}");
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
        }
        _ => format!("{v:.3e}"),
    }
}

fn textures(page: &mut Page, info: &SceneInfo) {
    let t = &info.textures;
    if t.images.is_empty() {
        page.say("textures", "none");
        return;
    }
    let (textures, images) =
        (count(t.textures as u64, "texture", "textures"), count(t.images.len() as u64, "image", "images"));
    page.say("textures", &format!("{textures} of {images}, {} decoded", human(t.bytes)));
    // Sizes, the most frequent first; the images by name are for --json.
    let mut sizes: Vec<([u32; 2], u64)> = Vec::new();
    for image in &t.images {
        match sizes.iter_mut().find(|(size, _)| *size == image.size) {
            Some((_, count)) => *count += 1,
            None => sizes.push((image.size, 1)),
        }
    }
    sizes.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let row = |([w, h], n): &([u32; 2], u64)| format!("{} of {w} x {h}", thousands(*n));
    page.list("", &sizes.iter().map(row).collect::<Vec<_>>());
}

fn lights(page: &mut Page, l: &info::LightInfo) {
    let some = |n: usize, one: &str, many: &str| (n > 0).then(|| count(n as u64, one, many));
    let emissive = some(l.emissive_triangles, "emissive triangle", "emissive triangles").map(|t| {
        let of = count(l.emissive_materials as u64, "material", "materials");
        format!("{t} of {of}")
    });
    let background = match l.background {
        "none" => None,
        "map" => Some("an environment map".into()),
        other => Some(format!("a sky ({other})")),
    };
    let parts = [
        some(l.point, "point light", "point lights"),
        some(l.spot, "spot light", "spot lights"),
        some(l.directional, "directional light", "directional lights"),
        emissive,
        background,
        l.sun.then(|| "a sun".into()),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    page.say("lights", if parts.is_empty() { "none".into() } else { parts.join(", ") }.as_str());
}

fn materials(page: &mut Page, info: &SceneInfo) {
    let row = |(i, m): (usize, &info::MaterialInfo)| {
        let textures = match m.textures {
            0 => String::new(),
            n => format!("; {}", count(n as u64, "texture", "textures")),
        };
        let unused = if m.used { "" } else { "; not used" };
        let lobes: Vec<String> = m.lobes.iter().map(|l| l.replace(' ', "\u{a0}")).collect();
        let lobes = if lobes.is_empty() { "black".into() } else { lobes.join(", ") };
        format!("{i}{}  {lobes}{textures}{unused}", named(&m.name))
    };
    if info.materials.is_empty() {
        page.say("materials", "none: all is white");
    }
    page.list("materials", &info.materials.iter().enumerate().map(row).collect::<Vec<_>>());
}

fn cameras(page: &mut Page, info: &SceneInfo) {
    let row = |(i, c): (usize, &info::CameraInfo)| {
        let projection = match c.projection {
            Projection::Perspective { yfov, aspect } => {
                let shape = aspect.map_or_else(String::new, |a| format!(", {}:1", short(a)));
                format!("perspective, {}° high{shape}", short(yfov.to_degrees()))
            }
            Projection::Orthographic { xmag, ymag } => {
                format!("orthographic, {} by {} m", short(2.0 * xmag), short(2.0 * ymag))
            }
        };
        let [x, y, z] = c.position.to_array().map(short);
        format!("{i}{}  {projection}, at ({x},\u{a0}{y},\u{a0}{z})", named(&c.name))
    };
    let rows: Vec<String> = info.cameras.iter().enumerate().map(row).collect();
    if rows.is_empty() {
        page.say("cameras", "none: the whole scene is put in view");
    }
    page.list("cameras", &rows);
}

fn memory(page: &mut Page, report: &Report<'_>, info: &SceneInfo) {
    let (m, film, Size([width, height])) = (&info.memory, report.film_bytes(), report.args.size);
    let (opening, rendering) = (m.scene + m.opening, m.scene + m.acceleration + film);
    let parts = format!(
        "scene {}, trees for rays {}, picture of {width}x{height} {}",
        human(m.scene),
        human(m.acceleration),
        human(film)
    );
    let most = human(opening.max(rendering));
    page.say("memory", &format!("{most}: {parts}; while opening {}", human(opening)));
}

fn hints(page: &mut Page, info: &SceneInfo) {
    page.list("left out", &info.notes);
    if info.hints.is_empty() {
        page.say("hints", "none");
    }
    for (i, hint) in info.hints.iter().enumerate() {
        page.hang(if i == 0 { "hints" } else { "" }, &format!("- {}", hint.message), [0, 2]);
        if let Some(advice) = advice::on(hint.kind) {
            page.hang("", &format!("→ {advice}"), [2, 4]);
        }
    }
}

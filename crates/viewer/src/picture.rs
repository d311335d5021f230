//! The picture in the middle: the newest frame, what the mouse does on it, and what is drawn over it.

use crate::gizmo::{AXES, Screen};
use crate::input;
use crate::navigation::{Pose, dolly, fly, look, orbit, pan, zoom};
use crate::panels::rows::AXIS_COLORS;
use crate::state::State;
use eframe::egui::{
    self, Color32, CornerRadius, CursorIcon, PointerButton, Pos2, Rect, Response, Sense, Shape, Stroke,
    StrokeKind, TextureHandle, Ui,
};
use glam::Vec2;
use lumbre::core::camera::Projection;
use lumbre::edits::{Item, Value};

/// Points of a notch of the wheel.
const NOTCH: f32 = 40.0;
/// Turns of an orbit for a drag as long as the picture is high, radians.
const ORBIT: f32 = std::f32::consts::PI;

/// An arrow that is being dragged.
#[derive(Clone, Copy, Debug)]
struct Drag {
    item: Item,
    axis: usize,
    /// Where the arrows stood and where the mouse took one, points of the picture.
    origin: glam::Vec3,
    from: Vec2,
    /// The value that is changed, as it was.
    start: glam::Vec3,
}

/// What the picture remembers between frames.
#[derive(Default)]
pub struct Picture {
    texture: Option<TextureHandle>,
    drag: Option<Drag>,
}

impl Picture {
    /// Takes a new frame. Rough ones are smoothed, whole ones shown pixel by pixel.
    pub fn set(&mut self, window: &egui::Context, frame: &crate::sink::Shown) {
        let options =
            if frame.stats.scale > 1 { egui::TextureOptions::LINEAR } else { egui::TextureOptions::NEAREST };
        let image = frame.image.clone();
        match &mut self.texture {
            Some(texture) => texture.set(image, options),
            None => self.texture = Some(window.load_texture("picture", image, options)),
        }
    }

    /// Whether there is a frame.
    pub fn is_there(&self) -> bool {
        self.texture.is_some()
    }

    /// Shows it and obeys the mouse.
    pub fn show(&mut self, ui: &mut Ui, state: &mut State) -> Rect {
        let rect = ui.available_rect_before_wrap();
        let scale = ui.ctx().pixels_per_point();
        let size = [rect.width(), rect.height()].map(|n| (n * scale).round().clamp(0.0, 16384.0) as u32);
        // A minimised window has no size, and is to find its picture again.
        if !size.contains(&0) {
            state.size = size;
        }
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "Picture"));
        ui.painter().rect_filled(rect, CornerRadius::ZERO, Color32::from_gray(18));
        if let (Some(texture), true) = (&self.texture, state.document.is_some()) {
            if state.look().look.transparent
                || state.wanted().is_some_and(|w| w.settings.transparent_background)
            {
                checkers(ui, rect);
            }
            let all = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
            ui.painter().image(texture.id(), rect, all, Color32::WHITE);
        }
        if state.document.is_some() && rect.is_positive() {
            self.mouse(ui, &response, state, rect);
            self.overlay(ui, state, rect);
        }
        rect
    }

    fn mouse(&mut self, ui: &Ui, response: &Response, state: &mut State, rect: Rect) {
        let Some(pose) = state.pose() else { return };
        let inside = |at: Pos2| Vec2::new(at.x - rect.min.x, at.y - rect.min.y);
        let pointer = response.interact_pointer_pos();
        if response.drag_started_by(PointerButton::Primary)
            && let Some(at) = ui.input(|i| i.pointer.press_origin())
        {
            self.drag = take_arrow(state, pose, rect, inside(at));
            if self.drag.is_none() {
                state.picks.ask([0.5; 2], crate::picks::Why::Pivot);
            }
        }
        state.held = response.dragged();
        if response.drag_stopped() {
            self.drag = None;
            state.stir();
        }
        match (self.drag, pointer) {
            (Some(drag), Some(at)) if response.dragged() => move_item(state, pose, rect, drag, inside(at)),
            _ => {
                if let Some(pose) = dragged(ui, response, pose, rect) {
                    state.set_pose(pose);
                }
            }
        }
        if response.hovered() {
            wheel(ui, state);
        }
        if response.clicked()
            && let Some(at) = pointer
        {
            let place = inside(at) / Vec2::new(rect.width(), rect.height());
            match sign_at(state, rect, inside(at)).filter(|_| !state.focus_by_click) {
                Some(light) => state.obey(crate::command::Command::Pick(light), ui.ctx()),
                None => state.clicked(place.to_array(), response.double_clicked()),
            }
        }
        if state.focus_by_click && response.hovered() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
    }

    /// What is drawn over the picture: arrows at what is picked, signs of lights, the frame of what is picked.
    fn overlay(&self, ui: &Ui, state: &State, rect: Rect) {
        let Some(screen) = screen(state, rect) else { return };
        let painter = ui.painter_at(rect);
        let at = |v: Vec2| Pos2::new(rect.min.x + v.x, rect.min.y + v.y);
        if state.shown.signs && !state.shown.bare {
            for (item, place) in signs(state) {
                if let Some(place) = screen.place(place) {
                    let picked = state.selection.item == Some(item);
                    sign(&painter, at(place), picked);
                }
            }
        }
        let Some(item) = state.selection.item else { return };
        if let Some(bounds) = box_of(state, item) {
            outline(&painter, &screen, bounds, &at);
        }
        let Some(origin) = state.place_of(item) else { return };
        let hovered = ui.input(|i| i.pointer.hover_pos()).filter(|p| rect.contains(*p));
        let hovered =
            hovered.and_then(|p| screen.arrow_at(origin, Vec2::new(p.x - rect.min.x, p.y - rect.min.y)));
        let strong = self.drag.map(|d| d.axis).or(hovered);
        for (axis, ends) in screen.arrows(origin).into_iter().enumerate() {
            if let Some([a, b]) = ends {
                arrow(&painter, at(a), at(b), AXIS_COLORS[axis], strong == Some(axis));
            }
        }
    }
}

/// The camera over the picture.
fn screen(state: &State, rect: Rect) -> Option<Screen> {
    Some(Screen { camera: state.camera()?, size: Vec2::new(rect.width(), rect.height()) })
}

/// Where the mouse drags the camera to.
fn dragged(ui: &Ui, response: &Response, pose: Pose, rect: Rect) -> Option<Pose> {
    let delta = response.drag_delta();
    if delta == egui::Vec2::ZERO {
        return None;
    }
    let by = delta / rect.height().max(1.0);
    let shift = ui.input(|i| i.modifiers.shift);
    let down = |button| response.dragged_by(button);
    Some(if down(PointerButton::Middle) || (down(PointerButton::Primary) && shift) {
        pan(pose, by.x, by.y)
    } else if down(PointerButton::Secondary) {
        // What is under the mouse stays under it, in the middle of the picture.
        let height = match pose.camera.projection {
            Projection::Perspective { tan_half_fov_y } => 2.0 * tan_half_fov_y.atan(),
            Projection::Orthographic { .. } => 1.0,
        };
        look(pose, by.x * height, by.y * height)
    } else if down(PointerButton::Primary) {
        orbit(pose, -by.x * ORBIT, -by.y * ORBIT)
    } else {
        return None;
    })
}

/// The wheel: closer and back, and with Ctrl narrower and wider; while keys fly, faster and slower.
fn wheel(ui: &Ui, state: &mut State) {
    let Some(pose) = state.pose() else { return };
    let (scroll, narrower) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
    if narrower != 1.0 {
        state.set_pose(zoom(pose, 4.0 * narrower.ln()));
    } else if scroll != 0.0 {
        if ui.input(|i| input::flight(|k| i.key_down(k), i.modifiers).moves()) {
            state.speed = (state.speed * 1.1f32.powf(scroll / NOTCH)).clamp(0.01, 100.0);
            return;
        }
        let radius = state.radius();
        state.set_pose(dolly(pose, scroll / NOTCH, radius));
    }
}

/// Lets the keys that are held fly.
pub fn flown(window: &egui::Context, state: &mut State) {
    let (flight, seconds) = window.input(|i| (input::flight(|k| i.key_down(k), i.modifiers), i.stable_dt));
    if !flight.moves() {
        return;
    }
    if let Some(pose) = state.pose() {
        let (speed, radius) = (state.speed, state.radius());
        state.set_pose(fly(pose, &flight, speed, radius, seconds));
        window.request_repaint();
    }
}

/// The parameter that an arrow changes.
fn place_name(item: Item) -> &'static str {
    if let Item::Node(_) = item { "translation" } else { "position" }
}

/// The arrow under the mouse.
fn take_arrow(state: &State, pose: Pose, rect: Rect, at: Vec2) -> Option<Drag> {
    let item = state.selection.item?;
    let origin = state.place_of(item)?;
    let screen = Screen { camera: pose.camera, size: Vec2::new(rect.width(), rect.height()) };
    let axis = screen.arrow_at(origin, at)?;
    let document = state.document.as_ref()?;
    let rows = document.edits.rows(&document.base, &pose.camera, item).ok()?;
    let row = rows.into_iter().find(|r| r.name == place_name(item))?;
    let Value::Vector(start) = row.value else { return None };
    Some(Drag { item, axis, origin, from: at, start })
}

fn move_item(state: &mut State, pose: Pose, rect: Rect, drag: Drag, to: Vec2) {
    let screen = Screen { camera: pose.camera, size: Vec2::new(rect.width(), rect.height()) };
    let way = AXES[drag.axis] * screen.dragged(drag.origin, drag.axis, drag.from, to);
    let Some(document) = &state.document else { return };
    // Nodes are placed in the space of what they move with.
    let way = match drag.item {
        Item::Node(node) => document.places.parent_world(node).inverse().transform_vector3(way),
        _ => way,
    };
    let value = drag.start + way;
    if value.is_finite() {
        state.set(drag.item, place_name(drag.item), Value::Vector(value));
        state.stir();
    }
}

/// Lights that stand somewhere, with their places.
fn signs(state: &State) -> Vec<(Item, glam::Vec3)> {
    let Some(document) = &state.document else { return Vec::new() };
    let of_file = document.base.nodes.iter().enumerate().filter(|(_, n)| n.light.is_some());
    let of_file = of_file.map(|(i, _)| Item::Light(lumbre::scene::NodeId(i as u32)));
    let added = (0..document.edits.added_lights().len()).map(Item::Added);
    // Of a thousand lamps signs would hide the picture.
    of_file.chain(added).take(MOST_SIGNS).filter_map(|item| Some((item, sign_place(state, item)?))).collect()
}

/// Lights that have signs.
const MOST_SIGNS: usize = 64;

fn sign_place(state: &State, item: Item) -> Option<glam::Vec3> {
    match item {
        // As quick as can be: asked for each light and frame.
        Item::Light(node) if !is_edited(state, item) => state.document.as_ref()?.places.origin(node),
        _ => state.place_of(item),
    }
}

fn is_edited(state: &State, item: Item) -> bool {
    let changes = state.document.as_ref().and_then(|d| d.edits.changes(&d.base, item).ok().flatten());
    changes.is_some()
}

fn sign_at(state: &State, rect: Rect, at: Vec2) -> Option<Item> {
    if !state.shown.signs || state.shown.bare {
        return None;
    }
    let screen = screen(state, rect)?;
    let near = |place: glam::Vec3| screen.place(place).is_some_and(|p| p.distance(at) < 10.0);
    signs(state).into_iter().find(|(_, place)| near(*place)).map(|(item, _)| item)
}

fn box_of(state: &State, item: Item) -> Option<crate::navigation::Bounds> {
    let Item::Node(node) = item else { return None };
    let document = state.document.as_ref()?;
    document.places.bounds(&document.scene, node)
}

const PICKED: Color32 = Color32::from_rgb(255, 178, 64);

/// The corners of a box, so that what is in it stays in view.
fn outline(
    painter: &egui::Painter,
    screen: &Screen,
    bounds: crate::navigation::Bounds,
    at: &dyn Fn(Vec2) -> Pos2,
) {
    let (low, high) = (bounds.min, bounds.max);
    let corner = |i: usize| {
        let pick = |bit: usize, a: f32, b: f32| if i >> bit & 1 == 0 { a } else { b };
        glam::Vec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), pick(2, low.z, high.z))
    };
    for i in 0..8 {
        for bit in 0..3 {
            let (from, to) = (corner(i), corner(i ^ (1 << bit)));
            let ends = (screen.place(from), screen.place(from.lerp(to, 0.2)));
            if let (Some(a), Some(b)) = ends {
                painter.line_segment([at(a), at(b)], Stroke::new(1.5, PICKED));
            }
        }
    }
}

fn arrow(painter: &egui::Painter, from: Pos2, to: Pos2, color: Color32, strong: bool) {
    let width = if strong { 4.0 } else { 2.5 };
    let along = (to - from).normalized();
    let across = along.rot90();
    painter.line_segment([from, to], Stroke::new(width + 2.0, Color32::from_black_alpha(120)));
    painter.line_segment([from, to], Stroke::new(width, color));
    let head = vec![to + along * 10.0, to + across * 5.0, to - across * 5.0];
    painter.add(Shape::convex_polygon(head, color, Stroke::new(1.0, Color32::from_black_alpha(120))));
}

/// A little lamp.
fn sign(painter: &egui::Painter, at: Pos2, picked: bool) {
    let color = if picked { PICKED } else { Color32::from_rgb(255, 236, 160) };
    painter.circle(at, 5.0, color, Stroke::new(1.5, Color32::from_black_alpha(180)));
    for turn in 0..8 {
        let way = egui::Vec2::angled(turn as f32 * std::f32::consts::FRAC_PI_4);
        painter.line_segment([at + way * 7.0, at + way * 10.0], Stroke::new(1.5, color));
    }
    if picked {
        painter.rect_stroke(
            Rect::from_center_size(at, egui::Vec2::splat(26.0)),
            3.0,
            Stroke::new(1.5, PICKED),
            StrokeKind::Middle,
        );
    }
}

/// What stands behind a transparent picture.
fn checkers(ui: &Ui, rect: Rect) {
    const SIDE: f32 = 16.0;
    let painter = ui.painter_at(rect);
    painter.rect_filled(rect, CornerRadius::ZERO, Color32::from_gray(90));
    let (columns, rows) = ((rect.width() / SIDE).ceil() as u32, (rect.height() / SIDE).ceil() as u32);
    for y in 0..rows {
        for x in (y % 2..columns).step_by(2) {
            let min = rect.min + egui::vec2(x as f32, y as f32) * SIDE;
            painter.rect_filled(
                Rect::from_min_size(min, egui::Vec2::splat(SIDE)),
                CornerRadius::ZERO,
                Color32::from_gray(120),
            );
        }
    }
}

//! The player's hand at a billiard table: it aims and strikes, moves a cue ball in hand, and chooses where the tip hits.

use carom::DVec3;
use carom_billiards::{BallInHand, Game, Move, Stage};
use carom_scene::scene::Strike;
use egui::{
    Color32, CursorIcon, DragValue, Key, Painter, PointerButton, Pos2, Response, Sense, Stroke, Ui,
    Vec2,
};

use crate::aiming;
use crate::projection::Projection;

/// Distance from the cue ball within which the pointer takes it, in points.
const REACH: f32 = 12.0;

/// Largest offset of the tip from the middle, in parts of the radius.
const OFFSET: f64 = 0.5;

/// Speed at which keys move the tip, in parts of the radius a second.
const TIP_SPEED: f64 = 0.5;

/// Diameter of the cue ball on which the place of the tip is chosen, in points.
const TIP_SIZE: f32 = 34.0;

/// Largest elevation of the cue that can be chosen \[°\].
const STEEPEST: f64 = 80.0;

/// The player's hand.
#[derive(Default)]
pub struct CueHand {
    /// Offset of the tip to the right and up, in parts of the radius.
    offset: [f64; 2],
    /// Elevation of the cue \[°\].
    elevation: f64,
    /// Whether a drag moves the cue ball, where it is in hand.
    moves: bool,
    drag: Drag,
    /// Points of the path of the strike that is aimed \[m\].
    path: Vec<DVec3>,
}

/// What the pointer holds.
#[derive(Default, Clone, Copy)]
enum Drag {
    #[default]
    Nothing,
    /// The cue, with the velocity of its blow \[m/s\]; `None` on the ball.
    Cue(Option<DVec3>),
    /// The cue ball, with the last place where it may be \[m\].
    Ball(Option<DVec3>),
}

/// What the pointer did.
pub enum Played {
    Nothing,
    Holds,
    Move(Move),
}

impl CueHand {
    /// Begins a turn, with the tip in the middle; after a foul a drag moves the cue ball.
    pub fn begin_turn(&mut self, after_foul: bool) {
        *self = Self { moves: after_foul, ..Self::default() };
    }

    /// Returns whether a drag moves the cue ball.
    pub fn moves_cue_ball(&self, game: &Game) -> bool {
        self.moves && game.rack().in_hand() != BallInHand::No
    }

    /// Moves the tip by the arrow keys.
    pub fn turn_tip(&mut self, ui: &Ui) {
        let keys = [
            (Key::ArrowRight, [1.0, 0.0]),
            (Key::ArrowLeft, [-1.0, 0.0]),
            (Key::ArrowUp, [0.0, 1.0]),
            (Key::ArrowDown, [0.0, -1.0]),
        ];
        let step = TIP_SPEED * ui.input(|input| f64::from(input.stable_dt));
        for (key, [right, up]) in keys {
            if ui.input(|input| input.key_down(key) && !input.modifiers.any()) {
                let [old_right, old_up] = self.offset;
                self.set_offset([old_right + right * step, old_up + up * step]);
            }
        }
    }

    /// Sets the offset of the tip, within its largest.
    fn set_offset(&mut self, [right, up]: [f64; 2]) {
        let size = right.hypot(up);
        // A little within, so that rounding does not put it outside.
        let factor = if size > OFFSET { OFFSET * (1.0 - 1e-9) / size } else { 1.0 };
        self.offset = [right * factor, up * factor];
    }

    /// Shows the choices of the turn; returns a move that was chosen.
    pub fn choices(&mut self, ui: &mut Ui, game: &Game) -> Option<Move> {
        let rack = game.rack();
        if game.is_rolling() {
            return None;
        }
        let mut chosen = None;
        match rack.stage() {
            Stage::Answer => {
                if ui.button("Shoot").clicked() {
                    chosen = Some(Move::Answer { shoots: true });
                }
                if ui.button("Leave it").clicked() {
                    chosen = Some(Move::Answer { shoots: false });
                }
                return chosen;
            }
            Stage::AfterBreak if ui.button("Push out").clicked() => chosen = Some(Move::PushOut),
            Stage::PushOut => {
                ui.strong("Push-out");
            }
            _ => {}
        }
        if rack.in_hand() != BallInHand::No {
            ui.selectable_value(&mut self.moves, true, "Move");
            ui.selectable_value(&mut self.moves, false, "Aim");
            ui.separator();
        }
        self.choose_tip(ui);
        let elevation = DragValue::new(&mut self.elevation).range(0.0..=STEEPEST).suffix(" °");
        ui.label("Elevation");
        ui.add(elevation);
        chosen
    }

    /// Shows the cue ball from behind, on which the place of the tip is chosen.
    fn choose_tip(&mut self, ui: &mut Ui) {
        ui.label("Tip");
        let (rect, response) = ui.allocate_exact_size(Vec2::splat(TIP_SIZE), Sense::drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Slider, true, "Tip"));
        let radius = 0.5 * TIP_SIZE;
        if let Some(pointer) = response.interact_pointer_pos() {
            let way = (pointer - rect.center()) / radius;
            self.set_offset([f64::from(way.x), -f64::from(way.y)]);
        }
        let [right, up] = self.offset.map(|it| it as f32);
        let painter = ui.painter();
        painter.circle(
            rect.center(),
            radius,
            Color32::from_rgb(245, 241, 230),
            Stroke::new(1.0, Color32::GRAY),
        );
        let tip = rect.center() + Vec2::new(right, -up) * radius;
        painter.circle_filled(tip, 4.0, Color32::from_rgb(29, 78, 137));
    }

    /// Handles the pointer in the picture.
    pub fn point(
        &mut self,
        ui: &Ui,
        response: &Response,
        projection: &Projection,
        game: &Game,
    ) -> Played {
        let is_due =
            !game.is_rolling() && !matches!(game.rack().stage(), Stage::Answer | Stage::Won);
        let Some((_, ball)) = game.cue_ball().filter(|_| is_due) else {
            self.drag = Drag::Nothing;
            return Played::Nothing;
        };
        let (pointer, pressed) =
            ui.input(|input| (input.pointer.hover_pos(), input.pointer.press_origin()));
        let is_at = |place: Pos2| {
            let place_of_ball = projection.place(ball.position);
            let radius = projection.radius(ball.position, ball.radius).unwrap_or(0.0);
            place_of_ball.is_some_and(|it| it.distance(place) <= radius.max(REACH))
        };
        if response.hovered() && pointer.is_some_and(is_at) {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        if response.drag_started_by(PointerButton::Primary) && pressed.is_some_and(is_at) {
            let moves = self.moves_cue_ball(game);
            self.drag = if moves { Drag::Ball(None) } else { Drag::Cue(None) };
        }
        let is_held = response.dragged_by(PointerButton::Primary);
        let pointer = response.interact_pointer_pos().filter(|_| is_held);
        match self.drag {
            Drag::Nothing => Played::Nothing,
            Drag::Cue(last) if is_held => {
                let blow = |it| aiming::blow(projection, it, ball.position, ball.radius);
                let blow = pointer.map_or(last, blow);
                if blow != last {
                    let strike = blow.map(|blow| self.strike(blow, game));
                    self.path = strike.map(|it| game.path(&it)).unwrap_or_default();
                }
                self.drag = Drag::Cue(blow);
                Played::Holds
            }
            Drag::Ball(last) if is_held => {
                let place = pointer.and_then(|it| projection.on_level(it, ball.position.y));
                let free = place.filter(|it| game.may_place(it.x, it.z));
                self.drag = Drag::Ball(free.or(last));
                Played::Holds
            }
            Drag::Cue(blow) => self.let_go(blow.map(|it| Move::Strike(self.strike(it, game)))),
            Drag::Ball(place) => self.let_go(place.map(|it| Move::Place { x: it.x, z: it.z })),
        }
    }

    fn let_go(&mut self, wanted: Option<Move>) -> Played {
        self.drag = Drag::Nothing;
        self.path.clear();
        wanted.map_or(Played::Holds, Played::Move)
    }

    /// Returns the strike of a blow \[m/s\].
    fn strike(&self, blow: DVec3, game: &Game) -> Strike {
        Strike {
            azimuth_degrees: f64::atan2(-blow.z, blow.x).to_degrees(),
            elevation_degrees: self.elevation,
            offset: self.offset,
            ..Strike::new(blow.length().min(game.fastest_strike()))
        }
    }

    /// Draws the path of the strike, or the place of the cue ball.
    pub fn draw(&self, painter: &Painter, projection: &Projection, game: &Game) {
        match self.drag {
            Drag::Nothing => {}
            Drag::Cue(blow) => {
                let speed = blow.map(|it| it.length().min(game.fastest_strike()));
                aiming::draw_path(painter, projection, &self.path, speed);
            }
            Drag::Ball(place) => {
                let Some((place, (_, ball))) = place.zip(game.cue_ball()) else { return };
                let on_screen = projection.place(place).zip(projection.radius(place, ball.radius));
                if let Some((place, radius)) = on_screen {
                    painter.circle_stroke(place, radius, Stroke::new(2.0, Color32::WHITE));
                }
            }
        }
    }
}

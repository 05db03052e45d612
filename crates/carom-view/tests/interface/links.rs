//! Links from the interface and into it, and its calls of the host.

use std::cell::RefCell;
use std::rc::Rc;

use carom::ColliderId;
use carom_render::Picture;
use carom_session::{Command, Edit, Link, Replay};
use carom_view::{FilmMaker, Host, Inbox, ReadFile, Setup, Start};
use egui::{DroppedFileHandle, Key};
use egui_kittest::kittest::Queryable;

use crate::desk::{Desk, desk, go_to, press, scene, setup, watching};

/// Calls that a host received.
#[derive(Default)]
struct Announced {
    links: Vec<String>,
    /// Numbers of the frames of films, and the pictures' bytes.
    frames: Vec<(u32, usize)>,
    films: Vec<String>,
    /// The frame at which a film is full.
    full_at: Option<u32>,
}

/// A host that records its calls.
struct Listener(Rc<RefCell<Announced>>);

impl Host for Listener {
    fn save(&mut self, name: &str, ending: &str, _: &[u8]) -> Result<String, String> {
        Ok(format!("{name}.{ending}"))
    }

    fn read(&mut self, file: &DroppedFileHandle, inbox: &Inbox) {
        inbox.put(ReadFile { path: file.path().to_owned(), content: file.bytes() });
    }

    fn open_file(&mut self, _: &Inbox) {}

    fn begin_film(
        &mut self,
        name: &str,
        _: [u32; 2],
        _: u32,
    ) -> Result<Box<dyn FilmMaker>, String> {
        Ok(Box::new(ListenerFilm { told: Rc::clone(&self.0), name: name.to_owned() }))
    }

    fn shows_links(&self) -> bool {
        true
    }

    fn show_link(&mut self, link: &Link) {
        self.0.borrow_mut().links.push(link.to_fragment());
    }
}

struct ListenerFilm {
    told: Rc<RefCell<Announced>>,
    name: String,
}

impl FilmMaker for ListenerFilm {
    fn add(&mut self, picture: &Picture, frame: u32) -> Result<(), String> {
        let mut told = self.told.borrow_mut();
        if told.full_at.is_some_and(|full| frame >= full) {
            return Err(format!("no room for frame {frame}"));
        }
        told.frames.push((frame, picture.pixels.len()));
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<String, String> {
        self.told.borrow_mut().films.push(self.name.clone());
        Ok(self.name)
    }
}

fn listened(start: Start) -> (Desk, Rc<RefCell<Announced>>) {
    let told = Rc::<RefCell<Announced>>::default();
    let host = Box::new(Listener(Rc::clone(&told)));
    (desk(Setup { start: Some(start), host, ..setup() }), told)
}

fn link(text: &str) -> Start {
    Start::Link(Box::new(Link::parse(text).expect("a link")))
}

/// Returns the state hash at the end of a link.
fn state_of(text: &str) -> String {
    let link = Link::parse(text).expect("a link");
    let mut replay = Replay::of(&link, link.open().expect("a scene")).expect("it begins");
    let frames = replay.frame_at(link.time().expect("a time")).expect("it can be counted");
    (0..frames).for_each(|_| replay.step().expect("it goes on"));
    replay.world().state_hash().to_string()
}

fn shown_state(desk: &Desk) -> Option<String> {
    scene(desk).view().playback.state_hash.map(|hash| hash.to_string())
}

#[test]
fn a_run_opened_from_a_link_stands_at_its_time_and_shows_its_state() {
    let text = "scene=tutorial1&set=simulation.frame_time=0.01&t=1.2";
    let (mut desk, _) = listened(link(text));
    desk.run_steps(60);
    let view = scene(&desk).view();
    assert!((view.time - 1.2).abs() < 1e-9 && !view.playback.playing && view.seeking.is_none());
    assert_eq!(shown_state(&desk), Some(state_of(text)));
}

#[test]
fn the_link_in_the_dialog_leads_to_what_is_shown_changes_included() {
    let mut desk = watching("simtest1");
    go_to(&mut desk, 1.0);
    let floor: ColliderId = scene(&desk).view().setup.colliders[0].0;
    desk.state_mut().command(Command::Edit(Edit::ColliderRestitution(floor, 0.35)));
    desk.state_mut().command(Command::Play);
    desk.run_steps(4);
    press(&mut desk, Key::U);
    desk.get_by_label("Replay link");
    let view = scene(&desk).view();
    assert!(!view.playback.playing && view.time > 1.3, "{}", view.time);
    let shown = shown_state(&desk).expect("the dialog shows the state");
    // In the dialog alone: beside the time it would say nothing to most.
    assert_eq!(desk.query_all_by_label_contains(&shown).count(), 1);
    desk.get_by_label("Copy the link").click();
    desk.run_steps(1);
    let copied = copied_text(&desk).expect("something was copied");
    assert!(copied.starts_with("http://127.0.0.1:8042/#scene=simtest1&edits="), "{copied}");
    assert_eq!(state_of(&copied), shown);
}

pub fn copied_text(desk: &Desk) -> Option<String> {
    desk.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    })
}

#[test]
fn the_address_follows_what_is_shown_but_not_every_frame() {
    let (mut desk, told) = listened(link("scene=simtest1"));
    assert_eq!(told.borrow().links, ["scene=simtest1&t=0"]);
    press(&mut desk, Key::P);
    desk.run_steps(12);
    press(&mut desk, Key::P);
    desk.run_steps(8);
    let links = told.borrow().links.clone();
    assert!((3..=6).contains(&links.len()), "{links:?}");
    let last = links.last().expect("there are some");
    let time = scene(&desk).view().time;
    assert_eq!(
        Link::parse(last).expect("a link").time().map(|t| (t - time).abs() < 1e-6),
        Some(true)
    );
    desk.run_steps(12);
    assert_eq!(told.borrow().links.len(), links.len(), "nothing changes, the host gets nothing");
}

#[test]
fn a_link_to_nowhere_is_told_and_a_scene_can_be_chosen() {
    let (mut desk, _) = listened(link("scene=simtest7"));
    assert!(desk.state().is_choosing());
    desk.get_by_label_contains("simtest7");
    assert!(!desk.state().notices().any_error(), "one of them says it, not both");
    // A later choice does not follow the link.
    press(&mut desk, Key::Enter);
    press(&mut desk, Key::Enter);
    assert!(desk.state().is_choosing());
    assert!(desk.query_by_label_contains("simtest7").is_none());
}

#[test]
fn a_link_holds_where_a_hand_has_put_the_camera() {
    let camera = "camera=1,2.5,-12,0,1,0.25";
    let (mut desk, told) = listened(link(&format!("scene=simtest1&t=1&{camera}")));
    desk.run_steps(4);
    let last = || told.borrow().links.last().cloned().expect("a link");
    assert_eq!(last(), format!("scene=simtest1&t=1&{camera}"));
    // A camera turned by hand changes the link; the scene's own camera leaves none in it.
    let picture = desk.ctx.content_rect().center();
    desk.drag_at(picture);
    desk.hover_at(picture + egui::vec2(60.0, 10.0));
    desk.drop_at(picture + egui::vec2(60.0, 10.0));
    desk.run_steps(12);
    let turned = last();
    assert!(turned.contains("&camera=") && !turned.ends_with(camera), "{turned}");
    let (mut again, _) = listened(link(&turned));
    again.run_steps(4);
    let [before, after] = [&mut desk, &mut again].map(|desk| {
        desk.remove_cursor();
        desk.run_steps(2);
        let place = desk.state().place_of(0, desk.ctx.content_rect());
        place.expect("the ball is seen")
    });
    assert!(before.distance(after) < 0.1, "{before} {after}");
    press(&mut desk, Key::Num1);
    desk.run_steps(12);
    assert_eq!(last(), "scene=simtest1&t=1");
    // The view from above is a camera as well, with its own field of view.
    press(&mut desk, Key::Num3);
    desk.run_steps(12);
    let place = Link::parse(&last()).expect("a link").camera().expect("a camera");
    assert_eq!(place.vertical_fov_degrees, 35.0);
    assert!(place.position.y > place.target.y + 1.0, "{place:?}");
    assert_eq!(place.position.x, place.target.x);
}

#[test]
fn a_link_to_a_maze_is_played_and_one_with_a_time_is_watched() {
    let (desk, told) = listened(link("scene=maze"));
    assert!(desk.state().maze().is_some());
    assert_eq!(told.borrow().links, ["scene=maze"]);
    let (desk, _) = listened(link("scene=maze&t=0.1"));
    assert!(desk.state().watching().is_some());
}

#[test]
fn a_film_has_every_frame_once_and_its_last_before_it_is_complete() {
    let (mut desk, told) = listened(link("scene=simtest1&t=0"));
    press(&mut desk, Key::R);
    assert!(desk.state().is_recording());
    press(&mut desk, Key::P);
    // A quarter of a second passes before and after each of these presses.
    desk.run_steps(4);
    press(&mut desk, Key::R);
    assert!(!desk.state().is_recording());
    let told = told.borrow();
    let numbers: Vec<u32> = told.frames.iter().map(|frame| frame.0).collect();
    assert!((30..=60).contains(&numbers.len()), "{numbers:?}");
    assert!(numbers.iter().copied().eq(0..numbers.len() as u32), "{numbers:?}");
    assert!(told.frames.iter().all(|frame| frame.1 == 4 * 1280 * 720));
    assert_eq!(told.films, ["simtest1-0.000s"]);
}

#[test]
fn a_film_that_is_full_ends_there_and_says_how_long_it_is() {
    let (mut desk, told) = listened(link("scene=simtest1&t=0"));
    told.borrow_mut().full_at = Some(12);
    press(&mut desk, Key::R);
    press(&mut desk, Key::P);
    desk.run_steps(6);
    assert!(!desk.state().is_recording());
    let told = told.borrow();
    let numbers: Vec<u32> = told.frames.iter().map(|frame| frame.0).collect();
    assert_eq!(numbers, Vec::from_iter(0..12));
    assert_eq!(told.films, ["simtest1-0.000s"]);
    let texts: Vec<&str> = desk.state().notices().texts().collect();
    assert_eq!(texts, ["no room for frame 12", "saved simtest1-0.000s (0.4 s)"]);
}

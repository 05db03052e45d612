//! Links: the address, and what it unpacks to.

use carom_scene::Scene;
use carom_session::{Link, LinkSource, Replay};
use proptest::prelude::*;

use crate::case::{built_in, check_finite, soon, text};
use crate::fault::{Fault, check_error};
use crate::mutation::mutated;
use crate::target::{Answer, Target};

pub const TARGET: Target = Target {
    name: "links",
    about: "links with a few things wrong, in the address or in the scene that it holds",
    campaign: 20_000,
    cases: || prop_oneof![mutated(addresses()), mutated(built_in()).prop_map(packed)].boxed(),
    check,
};

/// Number of frames that a run takes.
const FRAMES: usize = 3;
const MOST_STEPPED: usize = 200;

/// Returns valid addresses.
fn addresses() -> Vec<Vec<u8>> {
    let written = [
        "http://127.0.0.1:8042/#scene=simtest1&rule=exact&t=0.5",
        "scene=tutorial4&set=simulation.frame_time%3D0.01&t=0.25&camera=0,1,5,0,0,0",
        "scene=cradle&set=spheres[0].velocity%3D[1,0,0]&camera=0,1,5,0,0,0,50",
        "scene=simtest3&rule=exact&beside=discrete&t=0.5",
    ];
    let held = Scene::from_toml("[[spheres]]\nradius = 1\n", "ball").map(|it| Link::to_scene(&it));
    let held = held.map(|it| it.to_fragment().into_bytes());
    written.into_iter().map(|it| it.as_bytes().to_vec()).chain(held).collect()
}

/// Returns a link that holds a scene file.
fn packed(scene: Vec<u8>) -> Vec<u8> {
    let text = text(&scene).into_owned();
    Link::new(LinkSource::File { name: "sent".to_owned(), text }).to_fragment().into_bytes()
}

fn without_camera(link: &Link) -> Link {
    let mut link = link.clone();
    link.set_camera(None);
    link
}

fn check(case: &[u8]) -> Result<Answer, Fault> {
    let Ok(link) = text(case).parse::<Link>() else {
        let error = text(case).parse::<Link>().map_or_else(|it| it.to_string(), |_| String::new());
        check_error(&error)?;
        return Ok(Answer::Refused);
    };
    // Written again, it leads to the same; cameras are rounded to what is seen.
    let again = link.to_fragment().parse::<Link>();
    // No number is one; two of that are not equal.
    let fragment = |it: &Link| without_camera(it).to_fragment();
    if again.as_ref().map(fragment).ok() != Some(fragment(&link)) {
        return Err(Fault::Law(format!("is another link when it is written: {again:?}")));
    }
    let opened = link.open().map_err(|it| it.to_string());
    let opened = opened.and_then(|scene| Replay::of(&link, scene).map_err(|it| it.to_string()));
    let mut run = match opened {
        Ok(run) => run,
        Err(error) => {
            check_error(&error)?;
            return Ok(Answer::Refused);
        }
    };
    if run.world().spheres().len() <= MOST_STEPPED {
        run.set_stop_request(Some(soon()));
        for _ in 0..FRAMES {
            match run.step() {
                Ok(()) => check_finite(run.world())?,
                Err(error) => return check_error(&error.to_string()).map(|()| Answer::Accepted),
            }
        }
    }
    Ok(Answer::Accepted)
}

//! Channels of an animation.

use std::collections::BTreeMap;
use std::ops::Range;

use super::arrays::Arrays;
use super::tracks::Track;
use crate::document::{Animation, Channel, Sampler, Target};

/// Creates the animation of these tracks, and adds its arrays. The keys of positions and rotations
/// must follow after all bytes of the arrays, in the order of the tracks. Returns `None` if nothing
/// moves.
pub(super) fn of_tracks(
    tracks: &[&Track],
    times: &[f32],
    arrays: &mut Arrays,
) -> Option<Animation> {
    let (inputs, animation) = (BTreeMap::new(), empty());
    let mut channels = Channels { arrays, times, times_view: None, inputs, animation };
    for track in tracks {
        channels.push_scales(track);
    }
    let bytes: u64 = tracks.iter().map(|track| track.bytes()).sum();
    if bytes > 0 {
        // The view of the times must come before the view that is last.
        let _ = channels.times_view();
        let view = channels.arrays.push_later(bytes);
        let mut offset = 0;
        for track in tracks {
            let keys =
                [(track.moves, "translation", "VEC3", 12), (track.turns, "rotation", "VEC4", 16)];
            for (_, path, kind, size) in keys.into_iter().filter(|it| it.0) {
                let output = channels.arrays.push_keys_in(view, offset, kind, track.len());
                let input = channels.times_of(&track.frames);
                channels.push(track.node, path, "LINEAR", [input, output]);
                offset += size * track.len() as u64;
            }
        }
    }
    let animation = channels.animation;
    (!animation.channels.is_empty()).then_some(animation)
}

fn empty() -> Animation {
    Animation { name: "run".to_owned(), channels: Vec::new(), samplers: Vec::new() }
}

struct Channels<'a> {
    arrays: &'a mut Arrays,
    /// Times of all frames \[s\].
    times: &'a [f32],
    times_view: Option<usize>,
    /// Accessors of times by range of frames.
    inputs: BTreeMap<(u32, u32), usize>,
    animation: Animation,
}

impl Channels<'_> {
    /// Adds the scales of a body, if they change or the body does not exist in all frames. Each key
    /// holds until the next.
    fn push_scales(&mut self, track: &Track) {
        let frames = self.times.len() as u32;
        let Range { start, end } = track.frames;
        if track.scales.len() == 1 && start == 0 && end == frames {
            return;
        }
        let before = (start > 0).then_some((0, [0.0; 3]));
        let after = (end < frames).then_some((end, [0.0; 3]));
        let keys = before.into_iter().chain(track.scales.iter().copied()).chain(after);
        let (at, scales): (Vec<u32>, Vec<[f64; 3]>) = keys.unzip();
        let times: Vec<f32> = at.iter().map(|&frame| self.times[frame as usize]).collect();
        let scales: Vec<[f32; 3]> = scales.iter().map(|it| it.map(|part| part as f32)).collect();
        let input = self.arrays.push_times(&times);
        let output = self.arrays.push_scales(&scales);
        self.push(track.node, "scale", "STEP", [input, output]);
    }

    /// Returns the accessor of the times of these frames.
    fn times_of(&mut self, frames: &Range<u32>) -> usize {
        let view = self.times_view();
        let (arrays, times) = (&mut *self.arrays, self.times);
        let (start, end) = (frames.start as usize, frames.end as usize);
        *self
            .inputs
            .entry((frames.start, frames.end))
            .or_insert_with(|| arrays.push_times_in(view, start, &times[start..end]))
    }

    /// Returns the view of the times of all frames.
    fn times_view(&mut self) -> usize {
        *self.times_view.get_or_insert_with(|| self.arrays.push_times_view(self.times))
    }

    fn push(&mut self, node: usize, path: &str, interpolation: &str, [input, output]: [usize; 2]) {
        let Animation { channels, samplers, .. } = &mut self.animation;
        let (sampler, interpolation) = (samplers.len(), interpolation.to_owned());
        samplers.push(Sampler { input, output, interpolation });
        channels
            .push(Channel { sampler, target: Target { node: Some(node), path: path.to_owned() } });
    }
}

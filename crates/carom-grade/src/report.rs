//! Writes the result of grading as a self-contained HTML page.

use carom::DVec3;

use crate::course::{Course, Form};
use crate::grader::Graded;
use crate::mistake::Mistake;
use crate::recorded::Recorded;
use crate::svg::{Figure, Line, Picture, escaped};
use crate::tracks::{Key, Tracks};
use crate::verdict::{Explanation, Verdict};
use crate::words::length;

const STYLE: &str = include_str!("report.css");

/// Time after a departure that figures show \[s\].
const AFTERWARDS: f64 = 1.5;

/// Half the width of the picture of the point where a run departs \[m\].
const CLOSE: f64 = 2.5;

/// Smallest distance in logarithmic figures \[m\]; smaller ones are drawn as this.
const LEAST_DISTANCE: f64 = 1e-9;

/// Content of a page.
struct Page<'a> {
    course: &'a Course,
    recorded: &'a Recorded,
    graded: &'a Graded,
    /// Index of the label that departs first, or 0.
    label: usize,
    /// Interval of time in figures \[s\].
    shown: [f64; 2],
}

/// Writes the page of a graded run.
pub fn page(course: &Course, graded: &Graded) -> String {
    let recorded = &graded.recorded;
    let verdict = &graded.verdict;
    let departed = verdict.departure.as_ref();
    let label = departed.and_then(|it| recorded.labels.iter().position(|own| *own == it.ball));
    let label = label.unwrap_or(0);
    let mut own = recorded.rows.iter().filter(|row| row.label == label).map(|row| row.time);
    let (first, last) = (own.clone().next().unwrap_or(0.0), own.next_back().unwrap_or(0.0));
    let first = departed.map_or(first, |it| first.max(it.time - 3.0));
    let end = departed.map_or_else(|| last_touch(graded, label), |it| it.time);
    let shown = [first, last.min(end + AFTERWARDS)];
    let page = Page { course, recorded, graded, label, shown };
    let name = recorded.path.file_name().unwrap_or_default().to_string_lossy();
    let title = format!("{}: {}", escaped(&name), escaped(&verdict.scene));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>{title}</title>\
         <style>{STYLE}</style></head><body><h1>{title}</h1>\n{}\n{}\n{}\n</body></html>\n",
        said(verdict),
        page.figures(),
        page.pictures()
    )
}

/// Time of the last contact of a ball under the course's rule \[s\].
fn last_touch(graded: &Graded, label: usize) -> f64 {
    let reference = &graded.reference;
    let key = graded.keys[label];
    let own = |it: &&crate::tracks::Touch| reference.ball(key, it.frame) == Some(it.ball);
    let last = reference.touches.iter().rev().find(own);
    last.map_or(1.0, |touch| reference.times[touch.frame])
}

/// Writes the verdict in words.
fn said(verdict: &Verdict) -> String {
    let class = if verdict.same { "same" } else { "differs" };
    let mut text =
        format!("<section class=\"verdict {class}\"><h2>{}</h2>", escaped(&verdict.headline()));
    for (name, value) in verdict.lines() {
        text += &format!("<p><b>{name}</b> {}</p>", escaped(&value));
    }
    text += "</section>";
    if verdict.explanations.is_empty() {
        return text;
    }
    // Wrong numbers have no formulas.
    let has_formulas = verdict.explanations.iter().any(|it| !it.cause.mistakes.is_empty());
    let formulas = if has_formulas {
        "<th>what the program does</th><th>formula</th><th>of the lecture</th>"
    } else {
        ""
    };
    text += &format!(
        "<h2>What explains it</h2><table><tr><th>cause</th>{formulas}<th>rows that follow</th>\
         <th>residual</th></tr>"
    );
    for explanation in &verdict.explanations {
        text += &row(explanation, has_formulas);
    }
    text + "</table>"
}

fn row(explanation: &Explanation, has_formulas: bool) -> String {
    let all = |formula: fn(Mistake) -> &'static str| {
        let all: Vec<String> =
            explanation.cause.mistakes.iter().map(|it| escaped(formula(it))).collect();
        all.join("<br>")
    };
    let formulas = format!(
        "<td>{}</td><td><code>{}</code></td><td><code>{}</code></td>",
        escaped(&explanation.sentence()),
        all(Mistake::wrong),
        all(Mistake::right)
    );
    let same: Vec<String> = explanation.same_as.iter().map(|it| escaped(&it.to_string())).collect();
    let same = if same.is_empty() { String::new() } else { format!(", or {}", same.join(", ")) };
    let fit = &explanation.fit;
    format!(
        "<tr><td>{}{same}</td>{}<td>{} of {}</td><td>{}</td></tr>",
        escaped(&explanation.in_a_table()),
        if has_formulas { &formulas } else { "" },
        fit.followed,
        fit.rows,
        length(fit.rms)
    )
}

impl Page<'_> {
    /// Draws the coordinates of the departing ball over time, and the distances of all balls.
    fn figures(&self) -> String {
        let ball = &self.recorded.labels[self.label];
        let mark = self.graded.verdict.departure.as_ref().map(|it| it.time);
        let mut text = "<h2>Over time</h2><p class=\"key\"><i class=\"run\"></i> the run \
                        <i class=\"right\"></i> the course's rule"
            .to_owned();
        if self.graded.explanation.is_some() {
            text += " <i class=\"why\"></i> what explains the run";
        }
        text += "</p>";
        for axis in 0..3 {
            let name = ["x", "y", "z"][axis];
            let title = format!("{name} of ball {ball}, m");
            let mut lines = vec![self.modelled("right", &self.graded.reference, axis)];
            lines.extend(self.graded.explanation.as_ref().map(|it| self.modelled("why", it, axis)));
            lines.push(Line { class: "run", points: self.measured(axis) });
            text += &Figure { title, lines, mark, logarithmic: false }.svg();
        }
        let title = "distance of each ball from the course's rule, m".to_owned();
        let mut lines: Vec<Line> =
            (0..self.recorded.labels.len()).map(|it| self.distances(it)).collect();
        let last = self.recorded.rows.last().map_or(0.0, |row| row.time);
        let tolerance = self.graded.verdict.tolerance.log10();
        let points = vec![[0.0, tolerance], [last, tolerance]];
        lines.push(Line { class: "tolerance", points });
        text + &Figure { title, lines, mark, logarithmic: true }.svg()
    }

    fn measured(&self, axis: usize) -> Vec<[f64; 2]> {
        let own = self.recorded.rows.iter().filter(|row| row.label == self.label);
        let [first, last] = self.shown;
        let shown = own.filter(|row| first <= row.time && row.time <= last);
        shown.map(|row| [row.time, row.position[axis]]).collect()
    }

    fn modelled(&self, class: &'static str, tracks: &Tracks, axis: usize) -> Line {
        let points = self.path(tracks).map(|(time, position)| [time, position[axis]]).collect();
        Line { class, points }
    }

    /// Positions of the ball in a run, frame by frame.
    fn path(&self, tracks: &Tracks) -> impl Iterator<Item = (f64, DVec3)> {
        let (key, [first, last]) = (self.key(), self.shown);
        let shown = tracks.times.iter().filter(move |time| first <= **time && **time <= last);
        shown.filter_map(move |time| Some((*time, tracks.sample(key, *time)?.position)))
    }

    fn key(&self) -> Key {
        self.graded.keys[self.label]
    }

    fn distances(&self, label: usize) -> Line {
        let key = self.graded.keys[label];
        let of_row = |row: &crate::recorded::Row| {
            let there = self.graded.reference.sample(key, row.time)?;
            let distance = there.position.distance(row.position).max(LEAST_DISTANCE);
            Some([row.time, distance.log10()])
        };
        let own = self.recorded.rows.iter().filter(|row| row.label == label);
        let class = if label == self.label { "run" } else { "other" };
        Line { class, points: own.filter_map(of_row).collect() }
    }

    /// Draws the scene from the side and from above, and the point where the run departs.
    fn pictures(&self) -> String {
        let corners = self.course.colliders.iter().flat_map(|it| corners(&it.form));
        let starts = self.course.emitters.iter().map(|it| it.ball.position);
        let balls = self.course.balls.iter().map(|it| it.position);
        let (mut least, mut most) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for point in corners.chain(starts).chain(balls) {
            (least, most) = (least.min(point), most.max(point));
        }
        (least, most) = (least - DVec3::ONE, most + DVec3::ONE);
        let mut text = "<h2>The place</h2>".to_owned();
        let (right, up) = (DVec3::Z, DVec3::Y);
        text += &self.picture("from the side: z to the right, y up", [right, up], [least, most]);
        // Seen from above, z points down in the picture.
        let (right, up) = (DVec3::X, DVec3::NEG_Z);
        text += &self.picture("from above: x to the right, z down", [right, up], [least, most]);
        let Some(departure) = &self.graded.verdict.departure else { return text };
        let there = DVec3::from_array(departure.position);
        let apart = departure.expected.map_or(DVec3::Z, |it| (DVec3::from_array(it) - there).abs());
        let (along, name) = if apart.x > apart.z { (DVec3::X, "x") } else { (DVec3::Z, "z") };
        let title = format!(
            "where ball {} departs, at {:.2} s: {name} and y",
            departure.ball, departure.time
        );
        text + &self.picture(&title, [along, DVec3::Y], [there - CLOSE, there + CLOSE])
    }

    fn picture(&self, title: &str, axes: [DVec3; 2], bounds: [DVec3; 2]) -> String {
        let flat = |point: DVec3| axes.map(|axis| point.dot(axis));
        let [first, second] = bounds.map(flat);
        let least = [0, 1].map(|axis| first[axis].min(second[axis]));
        let most = [0, 1].map(|axis| first[axis].max(second[axis]));
        let mut picture = Picture::new(title, least, most);
        for collider in &self.course.colliders {
            match collider.form {
                Form::Sphere { center, radius, .. } => {
                    picture.circle("fixed", flat(center), radius, &collider.name);
                }
                Form::Rectangle { .. } => {
                    let corners: Vec<[f64; 2]> =
                        corners(&collider.form).into_iter().map(flat).collect();
                    picture.polygon("fixed", &corners, &collider.name);
                }
            }
        }
        picture.line("right", self.path(&self.graded.reference).map(|(_, it)| flat(it)));
        let own = self.recorded.rows.iter().filter(|row| {
            row.label == self.label && self.shown[0] <= row.time && row.time <= self.shown[1]
        });
        picture.line("run", own.map(|row| flat(row.position)));
        if let Some(departure) = &self.graded.verdict.departure {
            let radius = self.course.emitters.first().map(|it| it.ball.radius);
            let radius = radius.or(self.course.balls.first().map(|it| it.radius)).unwrap_or(0.5);
            if let Some(expected) = departure.expected {
                picture.circle("right", flat(DVec3::from_array(expected)), radius, "course's rule");
            }
            picture.circle("run", flat(DVec3::from_array(departure.position)), radius, "run");
        }
        picture.finish()
    }
}

/// Corners of a surface, or of its bounding box.
fn corners(form: &Form) -> Vec<DVec3> {
    match *form {
        Form::Sphere { center, radius, .. } => vec![center - radius, center + radius],
        Form::Rectangle { center, axes, half } => {
            let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
            let corner = |[x, z]: [f64; 2]| center + x * half[0] * axes[0] + z * half[1] * axes[2];
            signs.into_iter().map(corner).collect()
        }
    }
}
